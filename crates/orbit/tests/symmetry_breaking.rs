//! Loss and return of symmetry of `x'' + 0.2 x' + x + x^3 = 15 cos(2 pi f t)`.
//!
//! The equation is unchanged by half an excitation period and a change of sign, `S: z(t) -> -z(t + T/2)`, so
//! an orbit is its own image or one of a pair. Where a multiplier of a symmetric orbit passes +1 without a
//! fold a pair leaves (a pitchfork): its asymmetry `|z(T/2) + z(0)|` grows with the root of the distance, and
//! the two arms are images of one another.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::events::{
    Subject, apart, assert_same, exponent, general_multipliers, growth, leaving, oscillator, step_of, whole,
    with,
};
use hammerbeam_motion::{
    Law, Stretch,
    general::{GeneralSettings, advance},
    law::PowerSpring,
};
use hammerbeam_orbit::{BranchRow, Matcher, OrbitSettings, PeriodicSolution, Side, StopReason, find_start};

/// Around the two branch points between which an asymmetric pair lives.
const RANGE: (f64, f64) = (0.09, 0.16);

fn subject() -> Subject {
    oscillator(1.0, 0.2, 15.0, Law::Power(PowerSpring::cubic(1.0).unwrap()))
}

/// The symmetric branch.
fn symmetric(settings: &OrbitSettings) -> Vec<BranchRow> {
    let subject = subject();
    let start = find_start(&subject.0, &subject.1, 0.15, 1, settings).unwrap();
    whole(&subject, &start, RANGE, settings)
}

fn branch_points(rows: &[BranchRow]) -> Vec<BranchRow> {
    let mut points: Vec<BranchRow> = with(rows, |events| events.branch_point).into_iter().cloned().collect();
    points.sort_by(|a, b| a.solution.frequency_hz.total_cmp(&b.solution.frequency_hz));
    points
}

fn frequencies(points: &[BranchRow]) -> Vec<f64> {
    points.iter().map(|row| row.solution.frequency_hz).collect()
}

/// `S` of a state at phase 0, by the general integrator.
fn image(frequency_hz: f64, state: &[f64]) -> Vec<f64> {
    let half = Stretch { frequency_hz, start: 0.0, end: 0.5 };
    let settings = GeneralSettings::with_tolerance(1e-12).state_only();
    advance(&subject().0, &half, state, &settings).unwrap().flow.state.iter().map(|z| -z).collect()
}

fn asymmetry(orbit: &PeriodicSolution) -> f64 {
    apart(&subject().0, &orbit.nodes[0], &image(orbit.frequency_hz, &orbit.nodes[0]))
}

#[test]
fn a_multiplier_is_plus_one_at_the_branch_points_and_the_orbit_symmetric() {
    let (system, _) = subject();
    let points = branch_points(&symmetric(&step_of(5e-4)));
    assert_eq!(points.len(), 2, "{:?}", frequencies(&points));
    for point in &points {
        assert!(!point.events.fold);
        assert!(point.located.as_ref().unwrap().breaks_symmetry);
        let multipliers = general_multipliers(&system, &point.solution);
        let nearest = multipliers.iter().map(|[re, im]| (re - 1.0).hypot(*im)).fold(f64::INFINITY, f64::min);
        // A branch point is known to about the root of the tolerance, and the multiplier passes +1 with
        // slopes of 1e2 per hertz.
        assert!(nearest < 2e-5, "{nearest:.1e} at {} Hz", point.solution.frequency_hz);
        assert!(asymmetry(&point.solution) < 1e-4);
    }
}

#[test]
fn branch_points_do_not_depend_on_step_or_segments() {
    let expected = frequencies(&branch_points(&symmetric(&step_of(5e-4))));
    for (segments, step) in [(1, 1e-4), (4, 5e-4), (1, 2e-3)] {
        let settings = OrbitSettings { max_step: step, ..crate::common::with_segments(segments) };
        let found = frequencies(&branch_points(&symmetric(&settings)));
        assert_same(&found, &expected, 2e-7, "segments and steps");
    }
}

/// Both arms leave, each comes back: to the start of its walk, by way of the other branch point and the other
/// arm.
#[test]
fn the_pair_is_one_closed_branch() {
    let subject = subject();
    let points = branch_points(&symmetric(&step_of(5e-4)));
    for point in &points {
        for side in [Side::Up, Side::Down] {
            let (rows, reason) = leaving(&subject, point, side, (0.05, 0.3), &step_of(5e-4));
            assert_eq!(reason, StopReason::Closed);
            let met = branch_points(&rows);
            assert_same(&frequencies(&met), &frequencies(&points), 1e-6, "branch points of the pair");
            assert!(
                met.iter().all(|row| !row.events.fold),
                "where the arms of a pitchfork meet there is no fold"
            );
        }
    }
}

#[test]
fn the_arms_are_mirror_images() {
    let subject = subject();
    let points = branch_points(&symmetric(&step_of(5e-4)));
    let near = |side| {
        let (rows, _) = leaving(&subject, &points[0], side, (0.05, 0.3), &step_of(5e-4));
        rows[..20].to_vec()
    };
    let (up, down) = (near(Side::Up), near(Side::Down));
    let settings = OrbitSettings::default();
    let mut compared = 0;
    for row in up.iter().skip(5) {
        let orbit = &row.solution;
        let matcher = Matcher::new(&subject.0, &subject.1, orbit, &settings).unwrap();
        let between = down.windows(2).find(|pair| {
            let (a, b) = (pair[0].solution.frequency_hz, pair[1].solution.frequency_hz);
            (a.min(b)..a.max(b)).contains(&orbit.frequency_hz)
        });
        let Some([a, b]) = between else { continue };
        let (a, b) = (&a.solution, &b.solution);
        let share = (orbit.frequency_hz - a.frequency_hz) / (b.frequency_hz - a.frequency_hz);
        let other: Vec<f64> = a.nodes[0].iter().zip(&b.nodes[0]).map(|(x, y)| x + share * (y - x)).collect();
        assert!(!matcher.is_near((0.0, &other)), "the arms differ");
        assert!(matcher.is_near((0.0, &image(orbit.frequency_hz, &other))), "at {} Hz", orbit.frequency_hz);
        compared += 1;
    }
    assert!(compared >= 5, "{compared}");
}

#[test]
fn asymmetry_grows_with_the_root_of_the_distance() {
    let subject = subject();
    let points = branch_points(&symmetric(&step_of(5e-4)));
    for point in &points {
        let at = point.solution.frequency_hz;
        let mut grown = growth(&subject, point, (RANGE, &step_of(1e-5)), 0.08, asymmetry);
        grown.retain(|(_, asymmetry)| *asymmetry > 0.005);
        assert!(grown.len() > 3, "{}", grown.len());
        let found = exponent(&grown);
        assert!((found - 0.5).abs() < 0.03, "exponent {found} at {at} Hz");
    }
}
