//! Zeros of test functions that leave no trace in their signs, and put a step in doubt.
//!
//! Where a parabola through three values nearly meets zero between the last two, two zeros may lie within the
//! step. So may one at whose end a function has no value any more (it is infinite), and one would have met
//! zero by the line through its last two; and one at whose end a function has a value that it had not before,
//! and one comes from zero by the line through its value there and one a little behind. Any of them:
//! functions may be the smallest of several values, and what begins or ends among them moves those behind
//! by one place. And so do zeros that undo each other, by what the judge noted: on the way to the end of
//! the step, or to the zero that was found before it.

use super::{attempt::Attempt, locator::Locator, undecided::left_out};
use crate::{error::StepDoubt, problem::TestValue};

/// A function that falls inside a step to this share of its smaller end value is looked at more closely.
const DIP: f64 = 0.5;
/// Lowest points this close to an end of the step (share of the step) belong to that end.
const EDGE: f64 = 0.02;
/// Behind a trial at which a function begins to have a value its slope is taken over this share of the step.
const BEHIND: f64 = 0.05;

/// Whether zeros lie on the way to the trial that no sign shows.
pub(super) fn hides_zeros(attempt: &mut Attempt<'_>, locator: &mut Locator) -> Result<bool, StepDoubt> {
    Ok(undoes_zeros(attempt) || ends_at_zero(attempt) || begins_at_zero(attempt, locator)?)
}

/// Whether the judge knows of zeros that undo each other on the way to the trial.
pub(super) fn undoes_zeros(attempt: &mut Attempt<'_>) -> bool {
    let judge = attempt.problem.judge();
    let same_kind = attempt.trial.signature == attempt.state.current.signature;
    same_kind && judge.hides_zeros(&attempt.tests.noted, &attempt.trial.noted)
}

/// Whether a test function may have two zeros within the step to the trial, though its count is the same on
/// both sides: the parabola through its values at the last two points and the trial comes closer to zero
/// inside the step than [`DIP`] of both ends.
pub(super) fn dips(attempt: &Attempt<'_>, index: usize) -> bool {
    let Some((earlier, behind)) = test_before(attempt, index) else { return false };
    let (before, after) = (attempt.tests.values[index], attempt.trial.tests[index]);
    if earlier.count != before.count || earlier.left_out != before.left_out {
        return false;
    }
    let ahead = attempt.progress();
    let [first, second, third] = [earlier, before, after].map(|test| test.value.abs());
    let slope = (second - first) / -behind;
    let bend = ((third - second) / ahead - slope) / (ahead - behind);
    let place = 0.5 * (behind - slope / bend);
    let inside = bend > 0.0 && (EDGE * ahead..=(1.0 - EDGE) * ahead).contains(&place);
    inside && second + place * (slope + bend * (place - behind)) < DIP * second.min(third)
}

/// A test function at the point before the last one, and how far that lies behind it, which is negative;
/// `None` where it is not known.
fn test_before(attempt: &Attempt<'_>, index: usize) -> Option<(TestValue, f64)> {
    let history = &attempt.state.history;
    let earlier = attempt.tests.before.get(index).filter(|_| history.used >= 2)?;
    Some((*earlier, attempt.progress_of(&history.nodes[1])))
}

/// Whether a test function has no value any more at the trial, and the line through the values of one of them
/// at the last two points meets zero before.
fn ends_at_zero(attempt: &Attempt<'_>) -> bool {
    let ends =
        |(before, after): (&TestValue, &TestValue)| before.value.is_finite() && !after.value.is_finite();
    if !attempt.tests.pairs(&attempt.trial.tests).any(ends) {
        return false;
    }
    let ahead = attempt.progress();
    (0..attempt.tests.values.len())
        .filter_map(|index| test_before(attempt, index).map(|before| (index, before)))
        .any(|(index, (earlier, behind))| {
            let before = attempt.tests.values[index].value.abs();
            before + (before - earlier.value.abs()) / -behind * ahead < 0.0
        })
}

/// Whether a test function has a value at the trial that it had not before, and the line through the
/// values of one of them there and a little behind comes from zero within the step.
fn begins_at_zero(attempt: &mut Attempt<'_>, locator: &mut Locator) -> Result<bool, StepDoubt> {
    let begins =
        |(before, after): (&TestValue, &TestValue)| !before.value.is_finite() && after.value.is_finite();
    if !attempt.tests.pairs(&attempt.trial.tests).any(begins) {
        return Ok(false);
    }
    locator.probe_between(attempt, attempt.step, (1.0 - BEHIND) * attempt.progress())?;
    attempt.problem.tests(&left_out(&attempt.trial.tests), &mut locator.probe.tests);
    let from_zero = |(behind, after): (&TestValue, &TestValue)| {
        after.value.abs() - (after.value.abs() - behind.value.abs()) / BEHIND < 0.0
    };
    let hides = locator.probe.tests.iter().zip(&attempt.trial.tests).any(from_zero);
    attempt.return_to_trial()?;
    Ok(hides)
}
