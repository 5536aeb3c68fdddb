//! Folds, flips, Neimark-Sacker and branch points lie within their stated uncertainty of closed forms, with
//! short steps and long ones; and that is no absurdly wide one.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::{
    bilinear::Bilinear,
    events::{leaving, step_of, whole, with},
    independent::{oscillator, resting_pair, stop, together},
};
use hammerbeam_motion::Parameter;
use hammerbeam_orbit::{BranchRow, BranchWalk, ContinuationParameter, EventStatus, Events, Side, find_start};

/// Wider than that says nothing; events that are known to 1e-8 of their frequency are reported as located.
const WIDE: f64 = 2e-9;

/// An event lies within its uncertainty of where it should be.
#[track_caller]
fn check(row: &BranchRow, found: f64, expected: f64, what: &str) {
    let event = row.located.as_ref().unwrap();
    assert_eq!(event.status, EventStatus::Located, "{what}");
    let (error, stated) = ((found - expected).abs(), event.uncertainty);
    assert!(error <= stated, "{what} at {expected}: {error:.1e} off, within {stated:.1e}");
    assert!(stated < WIDE, "{what} at {expected}: within {stated:.1e}");
}

/// Events of a kind with one contact at each stop on the harmonic branch, each against the closed form of its
/// multiplier.
fn compared(
    oscillator: Bilinear,
    range_hz: (f64, f64),
    (is_wanted, multiplier): (fn(&Events) -> bool, f64),
) -> usize {
    let subject = oscillator.subject();
    let contacts = if oscillator.is_symmetric { 2 } else { 1 };
    let mut compared = 0;
    for step_hz in [2e-4, 1e-3, 4e-3] {
        let settings = step_of(step_hz);
        let start = find_start(&subject.0, &subject.1, 0.3, 1, &settings).unwrap();
        let rows = whole(&subject, &start, range_hz, &settings);
        for row in with(&rows, is_wanted).into_iter().filter(|row| row.solution.maxima.contacts == contacts) {
            let expected = oscillator.frequency_hz(multiplier, &row.solution);
            let what = format!("K = {}, gap {}, steps of {step_hz} Hz", oscillator.stiff, oscillator.gap);
            check(row, row.solution.frequency_hz, expected, &what);
            compared += 1;
        }
    }
    compared
}

#[test]
fn flips_lie_within_their_uncertainty() {
    for (stiff, gap) in [(20.0, 0.0), (12.0, 0.0), (40.0, 0.3)] {
        let compared = compared(Bilinear::one_sided(stiff, gap), (0.12, 0.5), (|events| events.flip, -1.0));
        assert!(compared >= 6, "K = {stiff}, gap {gap}: {compared}");
    }
}

#[test]
fn folds_lie_within_their_uncertainty() {
    for (stiff, gap) in [(6.0, 2.0), (40.0, 3.0), (8.0, 1.5)] {
        let compared = compared(Bilinear::one_sided(stiff, gap), (0.1, 0.5), (|events| events.fold, 1.0));
        assert_eq!(compared, 6, "two at each length of steps, K = {stiff}, gap {gap}");
    }
}

/// A pair at rest loses its damping at a ratio in closed form, whatever the oscillator beside it does.
#[test]
fn neimark_sacker_points_lie_within_their_uncertainty() {
    let (frequency_hz, range) = (0.25, (-0.02, 0.02));
    for (frequency, damper) in [(1.3, 0.01), (0.7, 0.02), (2.9, 0.003)] {
        let case = together(&[oscillator(1.0, 0.2, 1.0, stop(3.0, 0.5)), resting_pair(frequency, damper)]);
        for max_step in [1e-4, 1e-3, 5e-3] {
            let settings = step_of(max_step);
            let start = find_start(&case.0, &case.1, frequency_hz, 1, &settings).unwrap();
            let varied =
                ContinuationParameter::Other { parameter: Parameter::ADDED_DAMPING_RATIO, frequency_hz };
            let mut walk =
                BranchWalk::varying(&case.0, &case.1, &start, (varied, Side::Down, range), &settings)
                    .unwrap();
            let mut rows = vec![walk.start_row().unwrap()];
            while walk.step(&mut rows).unwrap().is_none() {}
            let points = with(&rows, |events| events.neimark_sacker);
            let [point] = points.as_slice() else { panic!("one point, not {}", points.len()) };
            let what = format!("pair of {frequency} rad/s, steps of {max_step}");
            check(point, point.parameter.unwrap(), -0.5 * damper / frequency, &what);
        }
    }
}

/// Where a motion between two stops loses its symmetry.
#[test]
fn branch_points_lie_within_their_uncertainty() {
    for (stiff, gap) in [(20.0, 0.5), (40.0, 0.2)] {
        let oscillator = Bilinear::symmetric(stiff, gap);
        let compared = compared(oscillator, (0.12, 1.0), (|events| events.branch_point, 1.0));
        assert_eq!(compared, 6, "two at each length of steps, K = {stiff}, gap {gap}");
    }
}

/// A doubled branch ends at another flip of the harmonic branch: as a branch point of its own, or at the flip
/// that is looked for on the branch of half the period.
#[test]
fn ends_of_doubled_branches_lie_within_their_uncertainty_of_flips() {
    let (mut ends, range) = (0, (0.12, 0.5));
    for (stiff, gap) in [(20.0, 0.0), (12.0, 0.0), (40.0, 0.3)] {
        let oscillator = Bilinear::one_sided(stiff, gap);
        let subject = oscillator.subject();
        for step_hz in [5e-4, 2e-3, 7e-3] {
            let settings = step_of(step_hz);
            let start = find_start(&subject.0, &subject.1, 0.3, 1, &settings).unwrap();
            let rows = whole(&subject, &start, range, &settings);
            let flips = with(&rows, |events| events.flip);
            for leaves in &flips {
                let (doubled, _) = leaving(&subject, leaves, Side::Up, range, &settings);
                let last = doubled.last().unwrap();
                let found = last.solution.frequency_hz;
                let is_near = |flip: &&&BranchRow| {
                    flip.solution.maxima.contacts == 1
                        && (found / flip.solution.frequency_hz - 1.0).abs() < 1e-4
                };
                let Some(arrives) = flips.iter().find(is_near).filter(|_| last.events.branch_point) else {
                    continue;
                };
                let expected = oscillator.frequency_hz(-1.0, &arrives.solution);
                check(last, found, expected, &format!("K = {stiff}, gap {gap}, steps of {step_hz} Hz"));
                ends += 1;
            }
        }
    }
    assert!(ends >= 12, "{ends}");
}
