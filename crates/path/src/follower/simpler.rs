//! Jumps onto a simpler path, of which the equations know nothing: an orbit of doubled period that goes on as
//! the one that it doubled.
//!
//! The judge knows the distance `d` of a point from it. On the path `d` is as smooth as the path and zero
//! at branch points alone; after a jump it is what Newton's method left. A step in which `d` falls to a
//! hundredth, or to where it cannot be distinguished from zero, is in doubt. A step that ends so close to a
//! branch point by chance is in doubt as well, which does no harm: of a hundred steps over a branch point one
//! is halved, and the halves are beyond doubt.

use super::{arrival::Arrival, attempt::Attempt};
use crate::error::StepDoubt;

/// A distance that falls in one step to less than this share was not walked.
const FALLEN: f64 = 1e-2;
/// Corrections still due, of the tolerance at least, below which a distance is none: Newton's method leaves
/// errors of a few of them.
const NOTHING: f64 = 100.0;

/// Doubts a trial on a simpler path, unless it is the branch point where that is met.
pub(super) fn check_simpler(attempt: &mut Attempt<'_>, arrival: Arrival) -> Result<Arrival, StepDoubt> {
    if arrival.events.branch_point {
        return Ok(arrival);
    }
    // Distance that cannot be distinguished from zero at a point with this correction still due.
    let tolerance = attempt.settings().correction_tolerance;
    let indistinct = |correction_norm: f64| NOTHING * correction_norm.max(tolerance);
    let (current, judge) = (&attempt.state.current, attempt.problem.judge());
    let before = judge.distance_to_simpler(&current.point);
    // A walk that started there is not on a path of its own.
    if before <= indistinct(current.correction_norm) {
        return Ok(arrival);
    }
    let distance = judge.distance_to_simpler(&attempt.trial.point);
    if distance < indistinct(attempt.trial.correction_norm).max(FALLEN * before) {
        return Err(StepDoubt::Simpler { distance });
    }
    Ok(arrival)
}
