//! The same path in other equations: the determinant jumps to the other sign, the tangent does not turn.
//!
//! This happens when a problem is cut into other segments, and at grazing of laws whose force jumps. Sheets
//! that run opposite ways beside each other would look the same within one step; they must therefore be
//! excluded by a look ahead.

use super::{arrival::Arrival, assessment::check_defect, attempt::Attempt};
use crate::{corrector::Limits, error::StepDoubt};

/// How far ahead the path must go on straight, in steps.
const LOOK_AHEAD: f64 = 1e3;

/// Passes a change of signature at which the determinant changes its sign without a branch point, in a
/// step of the shortest length, and anchors the orientation anew.
///
/// # Errors
/// The path does not go on straight: the branch stops.
pub(super) fn pass_sign_jump(attempt: &mut Attempt<'_>) -> Result<(Arrival, f64), StepDoubt> {
    let step = attempt.step;
    attempt.border_across(&attempt.state.base().tangent);
    correct_ahead(attempt, LOOK_AHEAD * step)?;
    let ahead = (attempt.trial.sign, attempt.trial.signature);
    correct_ahead(attempt, step)?;
    let jumps = ahead == (attempt.trial.sign, attempt.trial.signature)
        && attempt.trial.sign * attempt.state.orientation < 0.0
        && attempt.changes_signature();
    if !jumps {
        return Err(StepDoubt::Reversed);
    }
    check_defect(attempt, step)?;
    Ok((Arrival { anchors_anew: true, ..Arrival::default() }, step))
}

/// Corrects the trial in the plane this far ahead, with the displacement allowed for the step.
fn correct_ahead(attempt: &mut Attempt<'_>, distance: f64) -> Result<(), StepDoubt> {
    attempt.put_ahead(distance);
    let bend = distance * distance;
    let allowed = attempt.settings().allowed_displacement(attempt.step) + bend;
    let limits = Limits { max_displacement: allowed, ..attempt.limits(distance) };
    attempt.correct(limits)
}
