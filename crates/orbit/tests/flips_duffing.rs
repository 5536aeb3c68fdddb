//! Flips of `x'' + 0.1 x' + x^3 = 10 cos(2 pi f t)`, Ueda's oscillator with a larger force (Ueda, J. Stat.
//! Phys. 20 (1979), 181-196), on the asymmetric pair that leaves the symmetric orbits. A spring of 1e-6 N/m
//! gives states their scale and changes nothing else.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::events::{
    Subject, alternation, assert_same, exponent, general_multipliers, growth, leaving, oscillator,
    settled_period, side, sorted, step_of, with,
};
use hammerbeam_motion::{Law, law::PowerSpring};
use hammerbeam_orbit::{BranchRow, EventStatus, OrbitSettings, PeriodicSolution, Side, find_start};

const RANGE: (f64, f64) = (0.12, 0.3);

fn subject() -> Subject {
    oscillator(1e-6, 0.1, 10.0, Law::Power(PowerSpring::cubic(1.0).unwrap()))
}

/// The asymmetric branch, from the loss of symmetry below a symmetric orbit.
fn asymmetric(start_hz: f64, settings: &OrbitSettings) -> Vec<BranchRow> {
    let subject = subject();
    let start = find_start(&subject.0, &subject.1, start_hz, 1, settings).unwrap();
    let (rows, _) = side(&subject, &start, Side::Down, RANGE, settings);
    let point = with(&rows, |events| events.branch_point)[0].clone();
    leaving(&subject, &point, Side::Up, RANGE, settings).0
}

/// Its flips; the mirror image has the same, so that the closed branch has each twice.
fn flips(start_hz: f64, settings: &OrbitSettings) -> Vec<BranchRow> {
    let rows = asymmetric(start_hz, settings);
    let mut flips: Vec<BranchRow> = with(&rows, |events| events.flip).into_iter().cloned().collect();
    flips.sort_by(|a, b| a.solution.frequency_hz.total_cmp(&b.solution.frequency_hz));
    flips
}

fn frequencies(flips: &[BranchRow]) -> Vec<f64> {
    sorted(&flips.iter().collect::<Vec<_>>())
}

#[test]
fn each_flip_comes_twice_since_the_images_have_the_same() {
    let found = frequencies(&flips(0.28, &step_of(5e-4)));
    assert_eq!(found.len(), 4, "{found:?}");
    assert_same(&[found[0], found[2]], &[found[1], found[3]], 1e-8, "mirror images");
}

#[test]
fn a_multiplier_is_minus_one_by_the_variational_equations_too() {
    let (system, _) = subject();
    for flip in flips(0.28, &step_of(5e-4)) {
        assert_eq!(flip.located.as_ref().unwrap().status, EventStatus::Located);
        let multipliers = general_multipliers(&system, &flip.solution);
        let nearest = multipliers.iter().map(|[re, im]| (re + 1.0).hypot(*im)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-8, "{nearest:.1e} at {} Hz", flip.solution.frequency_hz);
    }
}

#[test]
fn flips_do_not_depend_on_step_start_or_segments() {
    let expected = frequencies(&flips(0.28, &step_of(5e-4)));
    for (start_hz, step, segments) in [(0.28, 2e-3, 1), (0.27, 2e-4, 1), (0.28, 5e-4, 4), (0.29, 5e-4, 3)] {
        let settings = OrbitSettings { max_step: step, ..crate::common::with_segments(segments) };
        assert_same(&frequencies(&flips(start_hz, &settings)), &expected, 1e-8, "steps and segments");
    }
}

#[test]
fn orbit_of_doubled_period_grows_with_the_root_of_the_distance() {
    let subject = subject();
    for flip in flips(0.28, &step_of(5e-4)).iter().step_by(2) {
        let measure = |orbit: &PeriodicSolution| alternation(&subject.0, orbit);
        let mut points = growth(&subject, flip, (RANGE, &step_of(2e-6)), 0.06, measure);
        points.retain(|(_, grown)| *grown > 0.004);
        assert!(points.len() > 3, "{} points", points.len());
        let found = exponent(&points);
        assert!((found - 0.5).abs() < 0.03, "exponent {found} at {} Hz", flip.solution.frequency_hz);
    }
}

/// Above the upper flip motion settles to period 1, just below it to period 2.
#[test]
fn simulation_on_both_sides_settles_to_period_one_and_two() {
    let (system, _) = subject();
    let flips = flips(0.28, &step_of(5e-4));
    let flip = &flips[3].solution;
    let settle =
        |factor: f64| settled_period(&system, factor * flip.frequency_hz, &flip.nodes[0], (400, 4), 1e-6);
    assert_eq!([settle(1.005), settle(0.995)], [Some(1), Some(2)]);
}
