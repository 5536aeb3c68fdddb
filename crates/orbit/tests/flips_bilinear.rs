//! Flips of a bilinear oscillator, against its closed form ([`bilinear`](crate::common::bilinear)).
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::{
    bilinear::Bilinear,
    events::{
        Subject, alternation, assert_same, exponent, general_multipliers, growth, leaving, settled_period,
        side, sorted, step_of, whole, with,
    },
    with_segments,
};
use hammerbeam_orbit::{
    BranchRow, EventStatus, OrbitSettings, PeriodicSolution, Side, StopReason, find_start,
};
use hammerbeam_testkit::extensive;

const OSCILLATOR: Bilinear = Bilinear::one_sided(20.0, 0.0);
/// Between the resonance and the superharmonic one, and beyond the resonance.
const RANGE: (f64, f64) = (0.12, 0.5);

fn subject() -> Subject {
    OSCILLATOR.subject()
}

fn flips(start_hz: f64, settings: &OrbitSettings) -> Vec<BranchRow> {
    let subject = subject();
    let start = find_start(&subject.0, &subject.1, start_hz, 1, settings).unwrap();
    let rows = whole(&subject, &start, RANGE, settings);
    with(&rows, |events| events.flip).into_iter().cloned().collect()
}

#[test]
fn flips_are_those_of_the_closed_form() {
    let flips = flips(0.3, &step_of(0.002));
    assert_eq!(flips.len(), 3);
    let mut compared = 0;
    for flip in flips.iter().filter(|flip| flip.solution.maxima.contacts == 1) {
        let expected = OSCILLATOR.frequency_hz(-1.0, &flip.solution);
        assert_same(&[flip.solution.frequency_hz], &[expected], 1e-8, "closed form");
        compared += 1;
    }
    assert!(compared >= 1);
}

#[test]
fn a_multiplier_is_minus_one_by_the_variational_equations_too() {
    let (system, _) = subject();
    for flip in flips(0.3, &step_of(0.002)) {
        let event = flip.located.as_ref().unwrap();
        assert_eq!(event.status, EventStatus::Located);
        let multipliers = general_multipliers(&system, &flip.solution);
        let nearest = multipliers.iter().map(|[re, im]| (re + 1.0).hypot(*im)).fold(f64::INFINITY, f64::min);
        // Both integrators to 1e-10 or so over the period.
        assert!(nearest < 1e-8, "{nearest:.1e} at {} Hz", flip.solution.frequency_hz);
    }
}

#[test]
fn flips_do_not_depend_on_step_start_or_segments() {
    let frequencies = |start_hz: f64, settings: &OrbitSettings| {
        let flips = flips(start_hz, settings);
        sorted(&flips.iter().collect::<Vec<_>>())
    };
    let expected = frequencies(0.3, &step_of(0.002));
    assert_same(&frequencies(0.3, &step_of(0.0004)), &expected, 1e-8, "shorter steps");
    assert_same(&frequencies(0.3, &step_of(0.01)), &expected, 1e-8, "longer steps");
    assert_same(&frequencies(0.47, &step_of(0.002)), &expected, 1e-8, "another start");
    for segments in [1, 3, 8] {
        let settings = OrbitSettings { max_step: 0.002, ..with_segments(segments) };
        assert_same(&frequencies(0.3, &settings), &expected, 1e-8, "segments");
    }
}

/// Near the flip the states an excitation period apart differ by the root of the distance: supercritical or
/// subcritical.
#[test]
fn orbit_of_doubled_period_grows_with_the_root_of_the_distance() {
    let subject = subject();
    for flip in flips(0.3, &step_of(0.002)) {
        let at = flip.solution.frequency_hz;
        let measure = |orbit: &PeriodicSolution| alternation(&subject.0, orbit);
        let mut points = growth(&subject, &flip, (RANGE, &step_of(1e-5)), 0.08, measure);
        points.retain(|(_, grown)| *grown > 0.005);
        assert!(points.len() > 3, "{} rows near {at} Hz", points.len());
        let found = exponent(&points);
        assert!((found - 0.5).abs() < 0.03, "exponent {found} at {at} Hz");
    }
}

/// Both ways along the same orbits: one way holds the other half of the doubled orbit.
#[test]
fn branch_of_doubled_period_is_met_again_from_its_other_side() {
    let subject = subject();
    let flips = flips(0.3, &step_of(0.002));
    let first = &flips.iter().find(|flip| flip.solution.frequency_hz < 0.16).unwrap();
    let (up, up_end) = leaving(&subject, first, Side::Up, RANGE, &step_of(0.002));
    let (down, down_end) = leaving(&subject, first, Side::Down, RANGE, &step_of(0.002));
    let events = |rows: &[BranchRow]| sorted(&with(rows, |events| events.flip || events.fold));
    assert_same(&events(&up), &events(&down), 1e-8, "both sides");
    for end in [up_end, down_end] {
        let StopReason::ShorterPeriod { place: frequency_hz, .. } = end else { panic!("{end:?}") };
        let other = flips.iter().map(|flip| (flip.solution.frequency_hz / frequency_hz - 1.0).abs());
        // Where the doubled orbit merges, the flip is met to the square of a thousandth of the orbit.
        assert!(other.fold(f64::INFINITY, f64::min) < 1e-6, "{frequency_hz} Hz");
    }
}

/// On one side of a supercritical flip motion settles to period 1, on the other to period 2, without any
/// shooting.
#[test]
fn simulation_on_both_sides_settles_to_period_one_and_two() {
    let subject = subject();
    let flips = flips(0.3, &step_of(0.002));
    let flip = &flips.iter().find(|flip| flip.solution.frequency_hz > 0.3).unwrap().solution;
    let start = find_start(&subject.0, &subject.1, 0.36, 1, &step_of(0.002)).unwrap();
    let (rows, _) = side(&subject, &start, Side::Up, RANGE, &step_of(0.002));
    let before = rows.iter().rfind(|row| row.solution.frequency_hz < 0.98 * flip.frequency_hz).unwrap();
    let state = [before.solution.nodes[0][0] + 0.01, before.solution.nodes[0][1]];
    let settle = |frequency_hz: f64| settled_period(&subject.0, frequency_hz, &state, (250, 4), 1e-6);
    assert_eq!(settle(0.98 * flip.frequency_hz), Some(1));
    assert_eq!(settle(1.01 * flip.frequency_hz), Some(2));
}

/// A doubled branch comes back to the harmonic one in another flip of it, as sharply with long steps as with
/// short ones, and without a crowd of rows before it. By default with a third of the lengths.
#[test]
fn a_doubled_branch_ends_in_a_flip_however_long_its_steps_are() {
    let subject = subject();
    let found = flips(0.3, &step_of(0.001));
    let flips = sorted(&found.iter().collect::<Vec<_>>());
    let mut ends = 0;
    let (every, least) = if extensive() { (1, 30) } else { (3, 10) };
    for step in (1..=12).chain([30, 46, 80, 93, 97]).step_by(every) {
        let settings = step_of(2e-4 * f64::from(step));
        for flip in &found {
            let (rows, reason) = leaving(&subject, flip, Side::Up, RANGE, &settings);
            let StopReason::ShorterPeriod { place: frequency_hz, .. } = reason else { continue };
            let off =
                flips.iter().map(|flip| (flip / frequency_hz - 1.0).abs()).fold(f64::INFINITY, f64::min);
            assert!(off < 1e-10, "steps of {} Hz: {off:.1e} off", settings.max_step);
            let is_there = |row: &&BranchRow| (row.solution.frequency_hz / frequency_hz - 1.0).abs() < 2e-8;
            let there = rows.iter().filter(is_there).count();
            assert!(there <= 12, "steps of {} Hz: {there} rows beside the flip", settings.max_step);
            ends += 1;
        }
    }
    assert!(ends >= least, "{ends}");
}
