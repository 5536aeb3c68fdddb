//! How long steps with forces are tried.
//!
//! **A contact in two or three steps.** A Hertz contact of the duration T, struck and left, is about a half
//! wave. The force of a step of length h that is graded at the touch is smooth in `s = sqrt(t/h)` up to the
//! release, at `s = sqrt(T/h)`, and the nearer that is the slower its coefficients fall. So the error goes
//! with the length faster than with a fixed power: from `0.3 T` to `0.5 T` with powers from 11 down to 5. A
//! step to the release is the same seen backwards. One through the middle has a release or a touch beyond
//! either end only, and bears nearly twice the length.
//!
//! The error is relative to a bound that goes like the root of the tolerance (`step_error.rs`): two halves
//! are enough for sensitivities down to a tolerance of 2.5e-10 ([`HALF_WITH_SENSITIVITIES`]). Below that a
//! contact takes three steps: one from the touch that is as much shorter as the tolerance asks for, one
//! through the middle, and one to the release, for which as much is left as the first step bore. Where the
//! middle one does not reach so far there are more. The forecast of the release comes up to a tenth too early
//! as a rule (`forecast.rs`), so the step before the last goes somewhat farther than it says.
//!
//! **Rounding.** A contact that swallows nearly all of its impact is stiff: its damper may be 1e6 times as
//! strong as what it rests on, and what rounding leaves of the velocity makes errors that do not depend on
//! the length of the step. Shortening step after step then leads nowhere: thousands were taken where long
//! ones have no larger error. So where steps have halved over [`MANY`] of them a bold one is tried, and taken
//! if its error is within its bound; in motions that carry tangent vectors along, which cannot avoid such
//! contacts. A branch that comes to one ends there, where its contact splits, and is told to by the number of
//! steps.

use super::{
    ExactIntegrator,
    aim::Aim,
    collocation::{Grading, NODES},
    event::HOPELESS,
    run::Run,
    step_error::LONGEST_GROWTH,
};

/// Share of the length at which the error would be at its bound that is taken.
const CAUTION: f64 = 0.8;
/// Error of a graded step over half a stiff Hertz contact, relative to its bound at a tolerance of 1e-9, that
/// of its sensitivities included.
const HALF_WITH_SENSITIVITIES: f64 = 0.35;
/// The same of the state alone.
const HALF_OF_THE_STATE: f64 = 0.1;
/// Error up to which half a contact is tried at once.
const HOPEFUL: f64 = 0.7;
/// Error that is aimed at otherwise.
const AIMED_AT: f64 = 0.3;
/// Power of the length with which the error of a graded step goes where half a contact is too much.
const STEEPNESS: f64 = 6.0;
/// The same for lengths about the one that the error allows.
const GRADED_POWER: f64 = 8.0;
/// How much longer a step through the middle of a contact may be than a graded one.
const SMOOTH_BEARS: f64 = 1.6;
/// Steps over which lengths halve before a bold one is tried,
const MANY: u32 = 8;
/// and how much longer that is.
const BOLD: f64 = 4.0;
/// Part of the length of the step from the touch that one to the release bears at the same error.
const BACKWARDS: f64 = 0.94;

impl ExactIntegrator {
    /// The first try: to the release where it is expected within reach, else as far as the last step's error
    /// allows.
    pub(super) fn first_aim(&self, run: &Run, touched: Option<usize>, remaining: f64) -> Aim {
        let known = run.release.filter(|known| known.1 > run.time && self.may_come(run, known.0));
        let forecast = match known {
            Some((event, time)) => Some((event, time - run.time)),
            None => self.first_forecast(run, touched).map(|(element, time)| (self.usual_end(element), time)),
        };
        let Some((ending, time)) = forecast else {
            let length = if run.proposal > 0.0 { run.proposal } else { self.first_length(run, remaining) };
            return Aim::free(length.min(remaining));
        };
        let to_end = self.grading(run, touched, Some(ending));
        let reach = to_end.map_or(0.0, |grading| reach_of_end(run, grading));
        if time <= reach && time <= 1.2 * remaining {
            let otherwise = if run.proposal > 0.0 { run.proposal } else { 0.5 * time };
            return Aim::to_or(ending, time.min(remaining), otherwise.min(remaining));
        }
        let length = if run.proposal > 0.0 {
            before_end(run, time, to_end == Some(Grading::Release))
        } else {
            self.first_part(run) * time
        };
        Aim::free(length.min(remaining))
    }

    /// The part of a contact that is tried from the touch: half of it, where that is expected to be accurate
    /// enough.
    fn first_part(&self, run: &Run) -> f64 {
        let usual = if run.sensitivity.is_some() { HALF_WITH_SENSITIVITIES } else { HALF_OF_THE_STATE };
        let error = usual * (1e-9 / self.settings.tolerance).sqrt();
        if error <= HOPEFUL { 0.5 } else { 0.5 * (AIMED_AT / error).powf(1.0 / STEEPNESS) }
    }

    /// A first guess of the step length: a part of the period of the loaded contact.
    fn first_length(&self, run: &Run, remaining: f64) -> f64 {
        let stiffest = |&e: &usize| {
            let force = self.laws[e].pressing_force(run.start[e].jet.value, run.start[e].jet.slope);
            (self.mobility[e][e] * force.slope.abs()).sqrt() + self.mobility[e][e] * force.damping.abs()
        };
        let rate = self.step.active.iter().map(stiffest).fold(2.0 / remaining, f64::max);
        1.5 / rate
    }

    /// By how much the length of the solved step may change for an error relative to its bound.
    pub(super) fn growth(&self, error: f64) -> f64 {
        CAUTION * allowed(error, self.step.grading())
    }

    /// Notes what an accepted step tells of the lengths of the next ones.
    pub(super) fn plan_next(&self, run: &mut Run, length: f64, error: f64) {
        let to_bound = allowed(error, self.step.grading());
        let mut growth = CAUTION * to_bound;
        if self.goes_on && is_bold_one_due(run, length) {
            growth = BOLD;
        }
        if self.step.grading() == Grading::Touch {
            let longest = BACKWARDS * length * to_bound.min(LONGEST_GROWTH);
            run.graded = self.resolved_length(longest);
            growth *= SMOOTH_BEARS;
        }
        run.proposal = self.resolved_length(length * growth.clamp(0.3, LONGEST_GROWTH));
    }
}

/// Notes the length of an accepted step, and says whether steps have become so much shorter that a bold one
/// is due.
fn is_bold_one_due(run: &mut Run, length: f64) -> bool {
    let (longest, since) = run.longest;
    if run.proposal == 0.0 || length >= longest {
        run.longest = (length, 0);
        return false;
    }
    run.longest.1 = since + 1;
    let due = run.longest.1 >= MANY && length < 0.5 * longest;
    if due {
        run.longest = (length, 0);
    }
    due
}

/// By how much the length of a step of that grading may change until its error has reached its bound.
fn allowed(error: f64, grading: Grading) -> f64 {
    let power = if grading == Grading::Smooth { NODES as f64 } else { GRADED_POWER };
    error.powf(-1.0 / power)
}

/// How far an end may be expected to which a step of that grading goes at once.
fn reach_of_end(run: &Run, grading: Grading) -> f64 {
    if run.proposal == 0.0 {
        f64::INFINITY
    } else if grading == Grading::Release && run.graded > 0.0 {
        (0.95 * run.graded).min(HOPELESS * run.proposal)
    } else {
        1.4 * run.proposal
    }
}

/// Length of a step before one to an end that is expected in that time, and to which a step is graded or not.
fn before_end(run: &Run, time: f64, is_graded: bool) -> f64 {
    let (rest, most) = (1.05 * time - 0.85 * run.graded, 1.1 * run.proposal);
    if is_graded && run.graded > 0.0 && rest <= most {
        rest.max(0.4 * time).min(most)
    } else if time < 2.0 * run.proposal {
        0.5 * time
    } else {
        run.proposal
    }
}
