//! Test functions of things that stay at zero along the path.
//!
//! A test function `min_i |g_i|`, with the sign of `(-1)^k`, k the number of negative `g_i`, says nothing
//! while one of the `g_i` is zero as well as it is known: its sign is rounding. Where a path crosses a zero,
//! that is so within a tiny interval, which no point but the zero itself hits. Where it is so at two points
//! running, the `g_i` stays at zero, and its sign is no event: the function is compared without it at both.
//!
//! With the numbers u of undecided `g_i` at the last point and at the trial, `j = min(u_0, u_1)` are left out
//! at both. At a point at which there are more than before the sign of the point before is kept, and the next
//! one decides: either the function comes out of zero, on the same side or on the other one, or it stays, and
//! nothing has happened. Nor has anything where it leaves zero after a stretch of it. On the other side there
//! was a zero, perhaps before the point whose sign was taken over: then it is given just behind that point,
//! with the way back to the point before as what it is known to (`zero.rs`).
//!
//! Where the step ends at the zero of another function instead, less may be known of a function than at the
//! trial: a pair of multipliers that slides along the unit circle and becomes real at -1 is at the circle
//! right up to the flip, and off it at the trial behind. So the functions are made comparable there anew.

use super::attempt::Attempt;
use crate::{error::StepDoubt, problem::TestValue};

/// Makes the test functions of the last point and of the trial, where they were just asked for, comparable;
/// bits of those that are not.
///
/// * `but`: the function whose zero the trial is, which is compared already.
pub(super) fn leave_undecided_out(attempt: &mut Attempt<'_>, but: Option<usize>) -> Result<u32, StepDoubt> {
    let others: Vec<usize> = (0..attempt.tests.values.len()).filter(|index| but != Some(*index)).collect();
    let all_known = |index: &usize| {
        let (before, after) = (attempt.tests.values[*index], attempt.trial.tests[*index]);
        before.left_out == 0
            && before.undecided >= after.undecided
            && before.undecided.min(after.undecided) == 0
    };
    if others.iter().all(all_known) {
        return Ok(0);
    }
    let mut rule = left_out(&attempt.trial.tests);
    for &index in &others {
        rule[index] = attempt.tests.values[index].undecided.min(attempt.trial.tests[index].undecided);
    }
    let compared = but.map(|index| (index, attempt.trial.tests[index]));
    attempt.problem.tests(&rule, &mut attempt.trial.tests);
    compared.into_iter().for_each(|(index, test)| attempt.trial.tests[index] = test);
    let mut apart = compare_last_point_without(attempt, &rule)?;
    for index in others {
        let (before, after) = (attempt.tests.values[index], &mut attempt.trial.tests[index]);
        let enters = after.undecided > before.undecided;
        if enters && before.left_out == rule[index] {
            after.count = before.count;
            after.value = after.value.abs().copysign(before.value);
        }
        if enters || before.left_out != rule[index] {
            apart |= 1 << index;
        }
    }
    Ok(apart)
}

/// Asks for the test functions of the last point anew where more of them is to be left out; the problem is
/// evaluated at the trial behind. Bits of those whose sign is not known: something undecided is left in.
fn compare_last_point_without(attempt: &mut Attempt<'_>, rule: &[u32]) -> Result<u32, StepDoubt> {
    let known = &attempt.tests.values;
    if known.iter().zip(rule).all(|(before, left_out)| before.left_out >= *left_out) {
        return Ok(0);
    }
    let (mut values, mut lost): (Vec<TestValue>, u32) = (Vec::new(), 0);
    attempt.evaluate(&attempt.state.current.point)?;
    attempt.problem.tests(rule, &mut values);
    for (index, (before, value)) in attempt.tests.values.iter_mut().zip(values).enumerate() {
        if before.left_out >= rule[index] {
            continue;
        }
        // A sign that was taken over belongs to all; of fewer it is known only where none was beyond zero.
        let (taken_over, none_beyond) = (value.undecided > rule[index], before.count == 0);
        lost |= u32::from(taken_over && !none_beyond) << index;
        *before = if taken_over && none_beyond {
            TestValue { count: 0, value: value.value.abs(), ..value }
        } else {
            value
        };
    }
    attempt.return_to_trial()?;
    Ok(lost)
}

/// So many things each of these test functions leaves out.
pub(super) fn left_out(tests: &[TestValue]) -> Vec<u32> {
    tests.iter().map(|test| test.left_out).collect()
}
