//! The end of the range: the last point is solved with the parameter fixed there.

use super::{arrival::Arrival, assessment::check_defect, attempt::Attempt};
use crate::{
    corrector::Limits,
    error::{PathStop, StepDoubt},
};

/// The trial of this step lies beyond an end of the range: arrives exactly at the end instead.
pub(super) fn arrive_at_end(attempt: &mut Attempt<'_>, most_earlier: usize) -> Result<Arrival, StepDoubt> {
    let range = attempt.frame.range;
    let end = if attempt.trial.parameter() > range.high() { range.high() } else { range.low() };
    let sigma = predict_at(attempt, end, most_earlier);
    let last = attempt.trial.point.len() - 1;
    attempt.trial.point[last] = end;
    let limits = Limits {
        max_angle: None,
        max_displacement: 0.5 * sigma.max(attempt.settings().min_step),
        ..attempt.limits(attempt.step)
    };
    attempt.correct_at_parameter(limits)?;
    attempt.trial.orient(attempt.state.orientation);
    check_end(attempt, end)?;
    Ok(Arrival { end: Some(PathStop::RangeEnd), ..Arrival::default() })
}

/// Predicts in `0 ≤ σ ≤ step` where the predictor reaches the parameter `end`, by the secant method.
fn predict_at(attempt: &mut Attempt<'_>, end: f64, most_earlier: usize) -> f64 {
    let (history, step) = (&attempt.state.history, attempt.step);
    let trial = &mut attempt.trial.point;
    let last = trial.len() - 1;
    let first = history.base().point[last];
    let mut sigma = step * ((end - first) / (trial[last] - first)).clamp(0.0, 1.0);
    for _ in 0..4 {
        history.predict(&attempt.frame.weights, sigma, most_earlier, trial);
        let share = (end - first) / (trial[last] - first);
        if !share.is_finite() {
            break;
        }
        sigma = (sigma * share).clamp(0.0, step);
    }
    sigma
}

/// The parameter moves out of the range at the end, and nothing else happens on the way.
fn check_end(attempt: &Attempt<'_>, end: f64) -> Result<(), StepDoubt> {
    if attempt.changes_signature() && attempt.step > attempt.settings().signature_step {
        return Err(StepDoubt::Signature);
    }
    check_defect(attempt, attempt.step)?;
    let outwards = if end == attempt.frame.range.high() { 1.0 } else { -1.0 };
    let leaves =
        attempt.trial.tangent_parameter() * outwards > 0.0 && attempt.state.parameter_sign * outwards > 0.0;
    if leaves { Ok(()) } else { Err(StepDoubt::HiddenFolds) }
}
