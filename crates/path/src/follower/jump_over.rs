//! Jumps with a longer step over a place where no short step is beyond doubt.
//!
//! Beside a branch point the bordered matrix is nearly singular, and rounding of the residual moves corrected
//! points by more than a short step allows; so it is wherever the problem is known less well than elsewhere.
//! A longer step, straight on, may be beyond doubt where no short one is. If the sign of the determinant is
//! another one there, a branch point was passed, which is known to lie within the step.

use super::{
    arrival::Arrival,
    assessment::{check_defect, turned},
    attempt::Attempt,
    branch_point::meets_simpler,
    simpler::check_simpler,
};
use crate::{error::StepDoubt, point::PathEvents};

/// Lengths that are tried, in shortest steps.
const REACHES: [f64; 5] = [1e2, 1e3, 1e4, 1e5, 1e6];

/// A simpler path that was met within a step is no farther from its end than so many times its length.
const PASSED: f64 = 4.0;

/// Jumps over a place at which short steps fail, in a longer one.
///
/// # Errors
/// No such step goes straight on along the same arc.
pub(super) fn jump_over(attempt: &mut Attempt<'_>) -> Result<(Arrival, f64), StepDoubt> {
    for reach in REACHES {
        let length = reach * attempt.settings().min_step;
        if 0.1 * length > attempt.settings().sheet_distance {
            break;
        }
        let arrival = jump_by(attempt, length);
        if let Ok(arrival) = arrival.and_then(|arrival| check_simpler(attempt, arrival)) {
            return Ok((arrival, length));
        }
    }
    Err(StepDoubt::NotLocated)
}

fn jump_by(attempt: &mut Attempt<'_>, length: f64) -> Result<Arrival, StepDoubt> {
    attempt.border_across(&attempt.state.base().tangent);
    attempt.put_ahead(length);
    attempt.correct(attempt.limits(length))?;
    if attempt.changes_signature() {
        return Err(StepDoubt::Signature);
    }
    if !attempt.is_in_range() {
        return Err(StepDoubt::NotLocated);
    }
    // Without orienting it, the tangent goes on in the direction of the last one.
    check_defect(attempt, length)?;
    let branch_point = attempt.trial.sign * attempt.state.orientation < 0.0;
    let (before, slope) = (attempt.state.parameter_sign, attempt.trial.tangent_parameter());
    let place = attempt.trial.node.point.clone();
    let meets = branch_point && meets_simpler(attempt, &place, PASSED * length);
    let fold = meets || turned(attempt, slope);
    Ok(Arrival {
        events: PathEvents { branch_point, fold, ..PathEvents::default() },
        parameter_sign: fold.then_some(if meets { -before } else { slope.signum() }),
        anchors_anew: branch_point,
        uncertainty: length,
        ..Arrival::default()
    })
}
