//! Flips of the paper's beam, whose Hertz stop makes multipliers that change steeply: on the harmonic branch
//! from 36 to 42 Hz and on the branch of doubled period that leaves there.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::{
    beam,
    events::{alternation, assert_same, exponent, general_multipliers, growth, sorted, step_of, whole, with},
};
use hammerbeam_orbit::{BranchRow, OrbitSettings, PeriodicSolution, find_start};

const RANGE: (f64, f64) = (35.0, 44.0);

fn flips(start_hz: f64, settings: &OrbitSettings) -> Vec<BranchRow> {
    let subject = beam();
    let start = find_start(&subject.0, &subject.1, start_hz, 1, settings).unwrap();
    let rows = whole(&subject, &start, RANGE, settings);
    with(&rows, |events| events.flip).into_iter().cloned().collect()
}

fn frequencies(flips: &[BranchRow]) -> Vec<f64> {
    sorted(&flips.iter().collect::<Vec<_>>())
}

#[test]
fn a_multiplier_is_minus_one_by_the_variational_equations_too() {
    let (system, _) = beam();
    let flips = flips(36.0, &step_of(0.02));
    assert!(flips.len() >= 2, "{:?}", frequencies(&flips));
    for flip in &flips {
        let multipliers = general_multipliers(&system, &flip.solution);
        let nearest = multipliers.iter().map(|[re, im]| (re + 1.0).hypot(*im)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "{nearest:.1e} at {} Hz", flip.solution.frequency_hz);
    }
}

#[test]
fn flips_do_not_depend_on_step_start_or_segments() {
    let expected = frequencies(&flips(36.0, &step_of(0.02)));
    for (start_hz, step, segments) in [(36.0, 0.05, 1), (37.0, 0.01, 1), (36.0, 0.02, 4)] {
        let settings = OrbitSettings { max_step: step, ..crate::common::with_segments(segments) };
        assert_same(&frequencies(&flips(start_hz, &settings)), &expected, 1e-8, "steps and segments");
    }
}

#[test]
fn orbit_of_doubled_period_grows_with_the_root_of_the_distance() {
    let subject = beam();
    for flip in flips(36.0, &step_of(0.02)) {
        let measure = |orbit: &PeriodicSolution| alternation(&subject.0, orbit);
        let mut points = growth(&subject, &flip, (RANGE, &step_of(1e-3)), 0.02, measure);
        points.retain(|(_, grown)| *grown > 0.002);
        let found = exponent(&points);
        assert!(
            points.len() > 3 && (found - 0.5).abs() < 0.05,
            "{found} at {} Hz",
            flip.solution.frequency_hz
        );
    }
}
