//! Locating a change of the signature, by bisection: a signature has no size.

use super::{arrival::Arrival, attempt::Attempt, locator::Locator};
use crate::error::StepDoubt;

/// Share of `signature_step` within which a change of signature is located.
const CHANGE_WIDTH: f64 = 1e-3;

/// Bisects the change of signature before the trial; its far side becomes the trial.
pub(super) fn arrive_at_change(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
    earlier: usize,
) -> Result<Arrival, StepDoubt> {
    let settings = attempt.settings();
    let sharp = (CHANGE_WIDTH * settings.signature_step).max(settings.correction_floor);
    let (mut low, mut high) = (0.0, attempt.progress());
    let mut evaluated_far = true;
    while high - low > sharp {
        let middle = 0.5 * (low + high);
        if locator.probe_between(attempt, attempt.step, middle).is_err() {
            break;
        }
        evaluated_far = locator.probe.signature != attempt.state.current.signature;
        if evaluated_far {
            locator.probe.orient(attempt.state.orientation);
            locator.arrive(attempt);
            high = middle;
        } else {
            low = middle;
        }
    }
    if !evaluated_far {
        attempt.return_to_trial()?;
    }
    Ok(Arrival { earlier, uncertainty: high - low, ..Arrival::default() })
}
