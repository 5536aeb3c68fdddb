//! Runs meet attractors where impacts are narrow, where there are many, and their mirror images.

use std::sync::{Mutex, OnceLock};

use hammerbeam_jobs::OrbitSolver;
use hammerbeam_orbit::{Matcher, OrbitSettings};
use hammerbeam_study::StudyFile;
use hammerbeam_verification::{
    attractors::SimulationEffort,
    completeness::{Report, check_at},
    results::Results,
};
use tempfile::TempDir;

const SWITCH: &str = include_str!("../studies/micro-switch.toml");
const STOPS: &str = include_str!("../studies/symmetric-stops.toml");
const FIVE: &str = include_str!("../studies/five-attractors.toml");

fn five() -> &'static Mutex<(Results, TempDir)> {
    static RESULTS: OnceLock<Mutex<(Results, TempDir)>> = OnceLock::new();
    RESULTS.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        Mutex::new((Results::of_run(FIVE, folder.path(), 2).unwrap(), folder))
    })
}

/// Impacts span 5 kHz of 50 kHz, and the survey looks every 2.1 kHz. The study asks for up to three periods.
/// One motion of three periods is stable from 66.50 to 66.82 kHz, beside one without contact.
#[test]
fn a_stable_solution_of_three_periods_within_narrow_impacts_is_on_a_branch() {
    let folder = tempfile::tempdir().unwrap();
    let results = Results::of_run(SWITCH, folder.path(), 2).unwrap();
    let effort = SimulationEffort { states: 24, longest: 3, patience: 1200 };
    let report =
        check_at(&results, None, &[63.5e3, 63.6e3, 63.9e3, 64.7e3, 65.5e3, 66.65e3, 66.75e3], &effort, 1)
            .unwrap();
    assert!(report.found[3] >= 4, "{report:?}");
    assert!(report.missing.is_empty(), "{:?}", report.missing);
}

/// The branch spans 0.0078 Hz, half of the distance of the default search frequencies, and lies between two
/// of them.
#[test]
fn a_closed_branch_of_three_periods_between_two_frequencies_of_the_search_is_found() {
    let (system, _) = STOPS.split_once("[search]").unwrap();
    let study =
        format!("{system}[continuation]\nmax_step_hz = 0.002\n[response]\nperiod_multiples = [1, 3]\n");
    let folder = tempfile::tempdir().unwrap();
    let results = Results::of_run(&study, folder.path(), 2).unwrap();
    let effort = SimulationEffort { states: 20, longest: 3, patience: 1200 };
    let report = check_at(&results, None, &[0.1463], &effort, 1).unwrap();
    assert_eq!([report.found[1], report.found[3]], [1, 1], "{report:?}");
    assert!(report.missing.is_empty(), "{:?}", report.missing);
}

fn of_simulation(results: &Results) -> Report {
    let effort = SimulationEffort { states: 60, longest: 6, patience: 6000 };
    check_at(results, None, &[0.35, 0.5], &effort, 1).unwrap()
}

#[test]
fn all_attractors_of_a_weakly_damped_hardening_oscillator_are_on_branches() {
    let results = five().lock().unwrap();
    let report = of_simulation(&results.0);
    assert!(report.attractors() >= 8, "{report:?}");
    assert!(report.missing.is_empty(), "{:?}", report.missing);
}

/// Where `orbit` finds solutions, stable ones and saddles, the branches and their mirror images cross.
#[test]
fn branches_and_their_mirror_images_hold_all_solutions_that_a_search_at_one_frequency_finds() {
    let results = &five().lock().unwrap().0;
    let file = StudyFile::parse("study.toml", FIVE.to_owned()).unwrap();
    let solver = OrbitSolver::new(&results.model, &file.study);
    let settings = OrbitSettings::default();
    let mut compared = 0;
    for (frequency_hz, multiple) in [(0.35, 1), (0.35, 2), (0.5, 1), (0.5, 2), (0.5, 3)] {
        let on_branches = results.crossings(frequency_hz, multiple).unwrap();
        for orbit in solver.find_orbits(frequency_hz, multiple, &mut || false).unwrap().orbits {
            let (system, response) = (&results.model.system, &results.model.response);
            let matcher = Matcher::new(system, response, &orbit, &settings).unwrap();
            let apart = |(_, other): &(u32, _)| distance(&matcher, other);
            let nearest = on_branches.iter().map(apart).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-6, "{frequency_hz} Hz, {multiple} periods: {nearest:.1e}, {orbit:?}");
            compared += 1;
        }
    }
    assert!(compared >= 12, "{compared}");
}

fn distance(matcher: &Matcher<'_>, other: &hammerbeam_orbit::PeriodicSolution) -> f64 {
    matcher.distance((other.phase, &other.nodes[0]))
}
