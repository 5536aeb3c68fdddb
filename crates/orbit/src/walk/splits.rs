//! Whether a walk has come to the place where a contact splits.

use hammerbeam_path::ContinuationPoint;

use super::BranchWalk;
use crate::{
    OrbitError, StopReason,
    solve::evaluate,
    splitting::{self, Splitting},
};

/// A point of a walk and the phase at which its orbit begins.
pub(super) struct Place {
    /// Phase of the excitation [cycles].
    phase: f64,
    /// First node of the orbit.
    state: Vec<f64>,
    point: ContinuationPoint,
}

/// Work of a walk; differences of it depend on nothing but the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Work {
    /// Steps of the motion with forces.
    force_steps: u64,
    /// Shooting evaluations.
    evaluations: u64,
}

/// What is known of a walk before a step.
pub(super) struct Departure {
    /// The point that is left; `None` where no contact can split.
    pub place: Option<Place>,
    pub work: Work,
}

impl Work {
    fn since(self, earlier: Self) -> Self {
        Self {
            force_steps: self.force_steps - earlier.force_steps,
            evaluations: self.evaluations - earlier.evaluations,
        }
    }

    /// Whether an orbit with so many touches took far more steps of the motion than touches take.
    fn is_laborious(self, touches: u64) -> bool {
        self.force_steps > splitting::LABORIOUS * touches.max(1) * self.evaluations.max(1)
    }
}

impl BranchWalk {
    /// If the last steps were short, and a contact of the present orbit splits: the way to the border is no
    /// longer resolved.
    pub(super) fn crawls_to_splitting(&mut self) -> Option<StopReason> {
        let short = self.follower.counters().short_in_a_row;
        if short == 0 || !short.is_multiple_of(splitting::SHORT_STEPS) {
            return None;
        }
        self.splitting(self.follower.current().parameter())
    }

    /// If the step from `departure` has passed a splitting, or has become laborious beside one.
    pub(super) fn comes_to_splitting(
        &mut self,
        departure: &Departure,
    ) -> Result<Option<StopReason>, OrbitError> {
        let Some(before) = &departure.place else { return Ok(None) };
        let spent = self.work().since(departure.work);
        if let Some(splits) = self.passes_splitting(before)? {
            return Ok(Some(splits));
        }
        self.labours_at_splitting(before, spent)
    }

    /// If the multipliers of the present orbit are too large to tell on which side of a splitting it is, and
    /// one of its contacts begins with next to no speed.
    pub(super) fn is_lost_at_splitting(
        &mut self,
        departure: &Departure,
        largest_multiplier: f64,
    ) -> Result<Option<StopReason>, OrbitError> {
        match &departure.place {
            Some(before) if largest_multiplier >= splitting::UNRESOLVED => self.has_just_split(before),
            _ => Ok(None),
        }
    }

    /// If the motion of the last step, which led away from `before`, took far more work than its contacts
    /// need, that of the orbit reached does, and one of its contacts begins with next to no speed.
    fn labours_at_splitting(
        &mut self,
        before: &Place,
        spent: Work,
    ) -> Result<Option<StopReason>, OrbitError> {
        let touches = self.problem.touches().iter().map(|&touches| u64::from(touches)).sum();
        if !spent.is_laborious(touches) {
            return Ok(None);
        }
        let present = self.place();
        // A correction on a wrong way may have been what cost so much.
        let earlier = self.work();
        evaluate(&mut self.problem, &present.point.point)?;
        let alone = Work { evaluations: 1, ..self.work().since(earlier) };
        if !alone.is_laborious(touches) {
            return Ok(None);
        }
        self.has_just_split(before)
    }

    /// If one of the contacts of the present orbit, at which the problem is evaluated again, begins with next
    /// to no speed.
    fn has_just_split(&mut self, before: &Place) -> Result<Option<StopReason>, OrbitError> {
        let present = self.place();
        let span = self.move_to_orbit(&present);
        let begin = (present.phase, present.state);
        let found =
            span.and_then(|span| splitting::find_slow_begin(self.problem.integrator(), begin, span).ok()?);
        evaluate(&mut self.problem, &present.point.point)?;
        Ok(found.map(|splitting| splits_at(before.point.parameter(), splitting)))
    }

    /// If a step has passed a splitting: the number of contacts of an element has changed since the last row,
    /// and a contact of it splits in the orbit `before` the step or in the present one, at which the problem
    /// was evaluated last.
    ///
    /// Beside a splitting two sheets of orbits lie close to one another, and a corrector may fall from one
    /// onto the other, in a step or where the orbit is cut anew. That is no way on.
    fn passes_splitting(&mut self, before: &Place) -> Result<Option<StopReason>, OrbitError> {
        let (system, now) = (self.problem.system(), self.problem.touches());
        let changed = splitting::elements_with_other_touches(system, &self.touches, now);
        if changed.is_empty() {
            return Ok(None);
        }
        let current = self.place();
        let among = |found: Splitting| Some(found).filter(|found| changed.contains(&found.element));
        let splits = self.splitting_of(before).and_then(among);
        let splits = splits.or_else(|| self.splitting_of(&current).and_then(among));
        evaluate(&mut self.problem, &current.point.point)?;
        Ok(splits.map(|splitting| splits_at(before.point.parameter(), splitting)))
    }

    /// If a contact of the present orbit is about to open and to be pressed on again at once, or has just
    /// begun to.
    pub(crate) fn splitting(&mut self, frequency_hz: f64) -> Option<StopReason> {
        let present = self.may_split()?;
        self.splitting_of(&present).map(|splitting| splits_at(frequency_hz, splitting))
    }

    /// Where the present orbit begins, if a contact of it may split.
    pub(super) fn may_split(&self) -> Option<Place> {
        self.problem.system().remembers_impacts().then(|| self.place())
    }

    /// Work done so far.
    pub(super) fn work(&mut self) -> Work {
        let force_steps = self.problem.integrator().counts().steps;
        Work { force_steps, evaluations: self.follower.counters().evaluations }
    }

    fn place(&self) -> Place {
        let point = self.follower.current().clone();
        Place { phase: self.problem.phase(), state: self.problem.nodes(&point.point).swap_remove(0), point }
    }

    /// Where a contact of an orbit splits.
    fn splitting_of(&mut self, orbit: &Place) -> Option<Splitting> {
        let span = self.move_to_orbit(orbit)?;
        let begin = (orbit.phase, orbit.state.clone());
        splitting::find(self.problem.integrator(), begin, span).ok()?
    }

    /// Sets the parameter of an orbit; its frequency [Hz] and its excitation periods.
    fn move_to_orbit(&mut self, orbit: &Place) -> Option<(f64, f64)> {
        let point = &orbit.point.point;
        self.problem.move_to(point).ok()?;
        Some((self.problem.frequency(point), f64::from(self.problem.period_multiple())))
    }
}

/// Why a walk ends whose last orbit has this frequency.
fn splits_at(frequency_hz: f64, Splitting { element, phase }: Splitting) -> StopReason {
    StopReason::ContactSplits { frequency_hz, element, phase }
}
