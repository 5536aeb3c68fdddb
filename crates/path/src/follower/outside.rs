//! The books of stability: how many multipliers lie outside the unit circle, and which events account for it.
//!
//! They cross the circle at a fold or branch point (one), or at a zero of a test function (one or a pair). A pair that crosses it, turns real and comes back at
//! +1 within one step leaves no trace in test functions that look at pairs. But at the fold where it comes back the other one still is outside, and
//! nothing accounts for that: the step is in doubt, and its halves tell. On both sides of a smooth event the number is known from the one before: it was that with
//! or that without the critical ones, and behind it is the other one. Where multipliers may jump, at corners and changes of
//! signature, and in steps below `signature_step`, nothing is asked, and the books are opened anew.

use super::{Arrival, Follower};
use crate::{
    error::Doubt,
    problem::{Outside, PathProblem},
};

impl Follower {
    /// Doubts a step over which more multipliers cross the circle than its events say, and notes those behind the trial, evaluated last.
    pub(super) fn heed_outside(
        &self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
        arrival: Arrival,
    ) -> Result<Arrival, Doubt> {
        let Some(here) = problem.outside(arrival.events) else { return Ok(arrival) };
        let jumps = arrival.events.corner || self.changes_signature();
        let before = self.state.outside.filter(|_| !jumps);
        let Some((least, most)) = before else {
            return Ok(Arrival { outside: Some((here.least, here.most)), ..arrival });
        };
        let accounted = least <= here.most && here.least <= most;
        if !accounted && step > self.settings.signature_step {
            let behind = if least > here.most { here.most } else { here.least };
            return Err(Doubt::Unaccounted { before: if least > here.most { least } else { most }, behind });
        }
        // The arms of a pitchfork touch the circle and come back.
        let returns = arrival.events.fold && arrival.events.branch_point;
        let outside = if least == most { behind(least, here, returns) } else { (here.least, here.most) };
        Ok(Arrival { outside: Some(outside), ..arrival })
    }
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
