//! van de Vorst, Fey, de Kraker, van Campen: between the stable branches, at 41 to 65 and 78 to 95 Hz, the
//! paper finds chaos.
//!
//! What simulation makes of the beam there, against shooting, which knows nothing of it: chaos where no orbit
//! is stable, quasi-periodic motion beyond the Neimark-Sacker points of the branches, and the periodic
//! windows in between. docs/validation/chaos.md has the table.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use crate::common::{ObservedSystem, extensive, paper_beam, walk};
use hammerbeam_attractor::{
    Class, Classified, Effort, LyapunovSettings, Observable, Patience, SectionMap, SweepSettings, Sweeper,
    SystemMap, classify, lyapunov,
};
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_orbit::{OrbitSettings, PeriodicSolution, Side, find_start};
use hammerbeam_verification::results::Results;

fn map(rig: &ObservedSystem, frequency_hz: f64) -> SystemMap {
    SystemMap::new(rig.system.clone(), frequency_hz, 1, ExactSettings::default()).unwrap()
}

fn effort() -> Effort {
    Effort { patience: Patience { skipped: 300, periods: 700, longest: 24 }, ..Effort::default() }
}

fn from_rest(rig: &ObservedSystem, frequency_hz: f64) -> Classified {
    let rest = vec![0.0; 2 * rig.system.dof()];
    classify(&mut map(rig, frequency_hz), 1, &rest, &effort()).unwrap()
}

/// Where chaos is looked for, in both ranges of the paper.
const CHAOTIC_HZ: [f64; 6] = [45.0, 49.0, 53.0, 83.5, 85.0, 93.0];

/// Both indicators say chaos, the interval of the largest exponent is well above zero, and the sum over all
/// exponents is the divergence.
#[test]
fn both_indicators_find_chaos_where_the_paper_does() {
    let rig = paper_beam();
    for frequency_hz in CHAOTIC_HZ {
        let found = from_rest(&rig, frequency_hz);
        assert_eq!(found.class, Class::Chaotic, "{frequency_hz} Hz");
        let largest = found.largest_exponent.unwrap();
        assert!(largest.low() > 5.0, "{frequency_hz} Hz: {largest:?}");
        assert!(found.zero_one.unwrap() > 0.9, "{frequency_hz} Hz: {:?}", found.zero_one);
        let mut map = map(&rig, frequency_hz);
        let settings = LyapunovSettings { aligning: 10, averaged: 60 };
        let spectrum = lyapunov(&mut map, found.states.last().unwrap(), settings).unwrap();
        assert!((spectrum.sum / map.divergence() - 1.0).abs() < 1e-6);
    }
}

/// A run of the study over a range about the frequency, too narrow for anything but what crosses it.
fn run_about(frequency_hz: f64) -> Results {
    let study = include_str!("../../studies/beam-with-stop.toml");
    let whole = "frequency_hz = [19.0, 110.0]";
    assert!(study.contains(whole));
    let narrow = format!("frequency_hz = [{:?}, {:?}]", frequency_hz - 0.002, frequency_hz + 0.002);
    let study = study.replace(whole, &narrow) + "\n[continuation]\nmax_step_hz = 0.004\n";
    Results::of_run(&study, tempfile::tempdir().unwrap().path(), 2).unwrap()
}

/// What a run finds there of one, two and three periods, by its search from many states, has a multiplier
/// outside the unit circle: no orbit is left for a motion to settle to. One frequency of each range;
/// `HAMMERBEAM_EXTENSIVE=1` looks at all six.
#[test]
fn no_orbit_of_the_branches_is_stable_where_chaos_is_found() {
    let looked_at = if extensive() { &CHAOTIC_HZ[..] } else { &[45.0, 85.0] };
    for &frequency_hz in looked_at {
        let results = run_about(frequency_hz);
        let mut unstable = [0; 3];
        for period_multiple in 1..=3 {
            for (branch, orbit) in results.crossings(frequency_hz, period_multiple).unwrap() {
                let [re, im] = orbit.floquet_multipliers[0];
                let found =
                    format!("{frequency_hz} Hz, branch {branch}, period {period_multiple}: {re} {im}");
                assert!(re.hypot(im) > 1.0 && !orbit.stable(), "{found}");
                unstable[period_multiple as usize - 1] += 1;
            }
        }
        // The harmonic orbit is there at every frequency, and beside it those of two or of three periods.
        assert!(unstable[0] >= 1 && unstable[1] + unstable[2] >= 1, "{frequency_hz} Hz: {unstable:?}");
    }
}

/// The orbit at the upper end of a branch that is walked from `start_hz`.
fn orbit_at(
    rig: &ObservedSystem,
    period_multiple: u32,
    start_hz: f64,
    frequency_hz: f64,
) -> PeriodicSolution {
    let settings = OrbitSettings { max_step: 0.02, ..OrbitSettings::default() };
    let start = find_start(&rig.system, &rig.response, start_hz, period_multiple, &settings).unwrap();
    let (rows, _, _) = walk(rig, &start, Side::Up, (start_hz - 0.01, frequency_hz), &settings);
    let at = rows.into_iter().map(|row| row.solution).find(|orbit| orbit.frequency_hz == frequency_hz);
    at.unwrap()
}

/// Beyond a Neimark-Sacker point the orbit has a pair of multipliers outside the unit circle, and the motion
/// goes to a torus about it.
#[test]
fn motion_beyond_neimark_sacker_points_is_quasi_periodic() {
    let rig = paper_beam();
    for (period_multiple, start_hz, frequency_hz) in [(1, 40.0, 41.0), (2, 79.5, 81.0)] {
        let orbit = orbit_at(&rig, period_multiple, start_hz, frequency_hz);
        let [re, im] = orbit.floquet_multipliers[0];
        assert!(re.hypot(im) > 1.0 && im.abs() > 0.01, "{frequency_hz} Hz: {re} {im}");
        let found = from_rest(&rig, frequency_hz);
        assert_eq!(
            found.class,
            Class::QuasiPeriodic,
            "{frequency_hz} Hz: {:?} {:?}",
            found.largest_exponent,
            found.zero_one
        );
    }
}

/// Periodic windows between the chaos: simulation and shooting find the same orbit of two periods, to the
/// eight digits to which the motion repeats.
#[test]
fn periodic_windows_are_found_by_simulation_and_by_shooting() {
    let rig = paper_beam();
    let observable =
        Observable { shape: rig.response.shape.clone(), support_ratios: rig.response.support_ratios.clone() };
    let settings = SweepSettings { effort: effort(), sampled: 16, motion: ExactSettings::default() };
    let mut sweeper = Sweeper::new(&rig.system, &observable, settings).unwrap();
    let rest = vec![0.0; map(&rig, 57.0).dimension()];
    for frequency_hz in [57.0, 60.0, 67.0, 79.0] {
        let found = sweeper.at(frequency_hz, &rest).unwrap();
        assert_eq!(found.class, Class::Periodic { period: 2 }, "{frequency_hz} Hz");
        let settings = OrbitSettings::default();
        let orbit = find_start(&rig.system, &rig.response, frequency_hz, 2, &settings).unwrap();
        assert!(orbit.stable());
        let ratio = found.max_abs_displacement / orbit.maxima.displacement;
        assert!((ratio - 1.0).abs() < 1e-6, "{frequency_hz} Hz: {ratio}");
    }
}
