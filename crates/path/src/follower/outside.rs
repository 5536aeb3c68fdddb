//! How many multipliers lie outside the unit circle, and which events account for it.
//!
//! They cross the circle at a fold or branch point (one), or at a zero of a test function (one or a
//! pair). A pair that crosses it, turns real and comes back at +1 within one step leaves no trace in
//! test functions that look at pairs. But at the fold where it comes back the other one still is
//! outside, and nothing accounts for that: the step is in doubt, and its halves show it. On both sides
//! of a smooth event the number is known from the one before: it was that with or that without the
//! critical ones, and behind it is the other one. An event can be the second one of its step, as where a
//! pair leaves the circle, another one that is outside turns real, and the first comes back: so the
//! number beside a zero, where it was looked for, is compared with that at the start of the step, too.
//! Where multipliers may jump, at corners and changes of signature, nothing is asked, and the number
//! there is taken as it is; so it is in steps below [`LEAST`] of `signature_step`.

use super::{
    arrival::{Arrival, Counted},
    attempt::Attempt,
};
use crate::{error::StepDoubt, judge::Outside};

/// Share of `signature_step` down to which a step is in doubt whose events do not account for what crosses
/// the circle.
const LEAST: f64 = 0.02;

/// Doubts a step over which more multipliers cross the circle than its events say, and notes those behind the
/// trial, evaluated last.
pub(super) fn check_outside(attempt: &mut Attempt<'_>, arrival: Arrival) -> Result<Arrival, StepDoubt> {
    let here = attempt.problem.judge().outside(arrival.events);
    let Some(here) = here else { return Ok(arrival) };
    let jumps = arrival.events.corner || attempt.changes_signature();
    let before = attempt.state.outside.filter(|_| !jumps);
    let Some((least, most)) = before else {
        return Ok(Arrival { outside: Some((here.least, here.most)), ..arrival });
    };
    if attempt.step > LEAST * attempt.settings().signature_step {
        account((least, most), (here.least, here.most))?;
        if let Some(count) = arrival.counted.and_then(|counted| before_event(counted, here)) {
            account((least, most), (count, count))?;
        }
    }
    // The arms of a pitchfork touch the circle and come back.
    let returns = arrival.events.fold && arrival.events.branch_point;
    let outside = if least == most { behind(least, here, returns) } else { (here.least, here.most) };
    Ok(Arrival { outside: Some(outside), ..arrival })
}

/// Whether what lies outside at one place can be what lies outside at another, each from the least to the
/// most.
fn account(before: (u32, u32), behind: (u32, u32)) -> Result<(), StepDoubt> {
    if before.0 > behind.1 {
        Err(StepDoubt::Unaccounted { before: before.0, behind: behind.1 })
    } else if behind.0 > before.1 {
        Err(StepDoubt::Unaccounted { before: before.1, behind: behind.0 })
    } else {
        Ok(())
    }
}

/// How many lie outside right before an event, from a place beside it; `None` if that is known no better than
/// at the event.
fn before_event(counted: Counted, at: Outside) -> Option<u32> {
    if counted.before {
        return Some(counted.count);
    }
    let is_sharp = at.most - at.least == at.critical;
    let other = if counted.count == at.least { at.most } else { at.least };
    (is_sharp && (counted.count == at.least || counted.count == at.most)).then_some(other)
}

/// Least and most behind a point, where so many were outside before.
fn behind(before: u32, here: Outside, returns: bool) -> (u32, u32) {
    let sharp = here.most - here.least == here.critical;
    match before {
        _ if !sharp => (here.least, here.most),
        _ if before != here.least && before != here.most => (here.least, here.most),
        _ if returns => (before, before),
        _ if before == here.least => (here.most, here.most),
        _ => (here.least, here.least),
    }
}
