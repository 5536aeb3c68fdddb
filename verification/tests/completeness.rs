//! What simulation finds is there, and nothing is there twice: the paper's beam over a part of its range,
//! where periods 1 to 4 and chaos follow each other; and a bilinear oscillator, `x'' + 0.1 x' + k(x) x =
//! cos(2 pi f t)` with `k = 1` for `x < 0` and 20 for `x > 0`, through the whole run.
//! `HAMMERBEAM_EXTENSIVE=1` looks at 200 frequencies and 100 states.
#![allow(clippy::unwrap_used, reason = "a test ends where its study is wrong")]

use std::sync::{Mutex, OnceLock};

use crate::common::extensive;
use hammerbeam_orbit::{Matcher, OrbitSettings};
use hammerbeam_verification::{
    attractors::{Random, SimulationEffort},
    completeness::check,
    results::Results,
};
use tempfile::TempDir;

const STUDY: &str = r#"
    [structure]
    kind = "lumped"
    mass = [{ name = "mass", mass_kg = 1.0 }]
    spring = [{ between = ["mass", "ground"], stiffness_n_m = 1.0 }]
    damper = [{ between = ["mass", "ground"], damping_n_s_m = 0.1 }]

    [excitation]
    kind = "force"
    at = "mass"
    amplitude_n = 1.0
    frequency_hz = [0.1, 1.0]

    [[stop]]
    at = "mass"
    law = "linear"
    stiffness_n_m = 19.0
    side = "above"

    [continuation]
    max_step_hz = 0.002

    [response]
    period_multiples = [1, 2, 3, 4, 5, 6]
    period_doubling_depth = 2
"#;

fn results() -> &'static Mutex<(Results, TempDir)> {
    static RESULTS: OnceLock<Mutex<(Results, TempDir)>> = OnceLock::new();
    RESULTS.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        Mutex::new((Results::of_run(STUDY, folder.path(), 2).unwrap(), folder))
    })
}

/// The study of the whole check ([docs](../../docs/validation/completeness.md)) over a part of the range;
/// with four search frequencies to the hertz.
fn beam() -> String {
    let whole = include_str!("../../studies/beam-with-stop-completeness.toml");
    let parts = [
        ("frequency_hz = [19.0, 110.0]", "frequency_hz = [66.0, 70.0]"),
        ("frequencies = 10920", "frequencies = 16"),
    ];
    parts.iter().fold(whole.to_owned(), |text, (of_whole, of_part)| {
        assert!(text.contains(of_whole), "{of_whole}");
        text.replace(of_whole, of_part)
    })
}

#[test]
fn every_periodic_attractor_of_the_beam_is_on_a_branch() {
    let folder = tempfile::tempdir().unwrap();
    let results = Results::of_run(&beam(), folder.path(), 2).unwrap();
    let (frequencies, states) = if extensive() { (200, 100) } else { (6, 8) };
    let effort = SimulationEffort { states, longest: 8, patience: 1200 };
    let report = check(&results, None, frequencies, &effort, 1).unwrap();
    assert!(report.attractors() > frequencies / 2, "{report:?}");
    assert!(report.missing.is_empty(), "{:?}", report.missing);
}

#[test]
fn every_periodic_attractor_of_random_motions_is_on_a_branch() {
    let guard = results().lock().unwrap();
    let (frequencies, states) = if extensive() { (200, 100) } else { (10, 8) };
    let effort = SimulationEffort { states, longest: 6, patience: 1200 };
    let report = check(&guard.0, None, frequencies, &effort, 1).unwrap();
    assert!(report.attractors() > frequencies, "{report:?}");
    assert!(report.missing.is_empty(), "{:?}", report.missing);
}

/// At random frequencies, no two of the orbits that the branches pass are the same, whatever the excitation
/// period at which they begin.
#[test]
fn no_orbit_is_on_two_branches_or_twice_on_one() {
    let guard = results().lock().unwrap();
    let results = &guard.0;
    let settings = OrbitSettings::default();
    let (mut random, mut compared) = (Random::new(7), 0);
    let [low, high] = results.range_hz;
    for _ in 0..if extensive() { 400 } else { 20 } {
        let frequency_hz = low + (high - low) * random.part();
        for multiple in [1, 2, 3, 4, 5, 6, 8, 12] {
            let orbits = results.crossings(frequency_hz, multiple).unwrap();
            for (place, (branch, orbit)) in orbits.iter().enumerate() {
                let model = &results.model;
                let matcher = Matcher::new(&model.system, &model.response, orbit, &settings).unwrap();
                for (other, second) in &orbits[place + 1..] {
                    let apart = matcher.distance((second.phase, &second.nodes[0]));
                    assert!(
                        apart > 1e-6,
                        "{frequency_hz} Hz, period {multiple}, branches {branch} and {other}: {apart:.1e}"
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 20, "{compared}");
}
