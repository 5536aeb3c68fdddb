//! Why a walk ended, in terms of orbits.

use hammerbeam_path::ContinuationPoint;

use crate::{
    BranchWalk, OrbitError,
    solve::evaluate,
    splitting::{self, Splitting},
};

/// Why a walk along a branch ended.
///
/// Places are frequencies [Hz], or values of the parameter where another one varies.
#[derive(Debug, Clone, PartialEq)]
pub enum StopReason {
    /// The branch left the frequency range and was cut exactly at its end.
    RangeEnd {
        /// End of the range [Hz].
        frequency_hz: f64,
    },
    /// The branch came back to its start.
    Closed,
    /// The branch came to the flip of a branch of shorter period, beyond which it returns as its own copy, shifted by excitation
    /// periods; or to a grazing beyond which it is one of shorter period.
    ShorterPeriod {
        /// Where [Hz].
        frequency_hz: f64,
        /// Whether it is a grazing.
        grazes: bool,
    },
    /// The budget of solutions is used up.
    Budget {
        /// Number of solutions.
        solutions: usize,
    },
    /// No step, however short, led to an acceptable solution.
    StepTooShort {
        /// Where [Hz].
        frequency_hz: f64,
        /// Last step tried, in the arc length of the path.
        step: f64,
        /// Residual of the last attempt.
        residual: f64,
        /// What was wrong with it.
        doubt: String,
    },
    /// However short the step, the path went on along a stretch that was already walked.
    RunsBack {
        /// Where [Hz].
        frequency_hz: f64,
        /// Arc length of the stretch that was met.
        met_arc_length: f64,
    },
    /// Beyond this place a contact opens and is pressed on again at once. With a law that remembers how a contact began, its force jumps there, and so does the motion: the branch ends.
    ContactSplits {
        /// Where [Hz].
        frequency_hz: f64,
        /// Name of the local element.
        element: String,
        /// Phase of the excitation at which that happens [cycles].
        phase: f64,
    },
    /// Thousands of steps did not get anywhere.
    Crawls {
        /// Where [Hz].
        frequency_hz: f64,
        /// So many steps.
        solutions: u64,
        /// Largest magnitude of a multiplier: where it is huge, next to no change of the frequency turns the whole orbit.
        largest_multiplier: f64,
    },
    /// The motion could not be computed.
    Motion {
        /// Where [Hz].
        frequency_hz: f64,
        /// What the integrator said.
        message: String,
    },
}

/// A point of a walk and the phase at which its orbit begins.
pub(crate) struct Place {
    /// Phase of the excitation [cycles].
    phase: f64,
    /// First node of the orbit.
    state: Vec<f64>,
    point: ContinuationPoint,
}

/// Work of a walk.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Work {
    /// Steps of the motion with forces.
    pub force_steps: u64,
    /// Shooting evaluations.
    pub evaluations: u64,
}

impl Work {
    pub fn since(self, earlier: Self) -> Self {
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
    /// The reason, in terms of orbits.
    pub(crate) fn stop_reason(&mut self, reason: hammerbeam_path::StopReason) -> StopReason {
        let frequency_hz = self.follower.current().parameter();
        match reason {
            hammerbeam_path::StopReason::RangeEnd => StopReason::RangeEnd { frequency_hz },
            hammerbeam_path::StopReason::Closed => StopReason::Closed,
            hammerbeam_path::StopReason::StepTooShort { step, residual, doubt, .. } => {
                self.splitting(frequency_hz).unwrap_or_else(|| StopReason::StepTooShort {
                    frequency_hz,
                    step,
                    residual,
                    doubt: doubt.to_string(),
                })
            }
            hammerbeam_path::StopReason::Crawls { steps, .. } => {
                self.splitting(frequency_hz).unwrap_or_else(|| StopReason::Crawls {
                    frequency_hz,
                    solutions: steps,
                    largest_multiplier: self.largest_multiplier(),
                })
            }
            hammerbeam_path::StopReason::RunsBack { parameter, met_arc_length } => {
                StopReason::RunsBack { frequency_hz: parameter, met_arc_length }
            }
            hammerbeam_path::StopReason::EvaluationFailed { parameter, error, .. } => {
                let message = self.problem.failure().map_or_else(|| error.to_string(), ToString::to_string);
                self.splitting(frequency_hz)
                    .unwrap_or(StopReason::Motion { frequency_hz: parameter, message })
            }
            hammerbeam_path::StopReason::Budget => {
                StopReason::Budget { solutions: self.follower.counters().accepted as usize }
            }
        }
    }

    /// If the last steps were short, and a contact of the present orbit splits: the way to the border is no longer resolved.
    pub(crate) fn crawls_to_splitting(&mut self) -> Option<StopReason> {
        let short = self.follower.counters().short_in_a_row;
        if short == 0 || !short.is_multiple_of(splitting::SHORT_STEPS) {
            return None;
        }
        self.splitting(self.follower.current().parameter())
    }

    /// If the motion of the last step, which led away from `before`, took far more work than its contacts need, that of the orbit reached does, and one of its contacts begins with next to no speed.
    pub(crate) fn labours_at_splitting(
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

    /// If the multipliers of the present orbit are too large to tell on which side of a splitting it is, and one of its contacts begins with next to no speed.
    pub(crate) fn is_lost_at_splitting(
        &mut self,
        before: &Place,
        largest_multiplier: f64,
    ) -> Result<Option<StopReason>, OrbitError> {
        if largest_multiplier < splitting::UNRESOLVED {
            return Ok(None);
        }
        self.has_just_split(before)
    }

    /// If one of the contacts of the present orbit, at which the problem is evaluated again, begins with next to no speed.
    fn has_just_split(&mut self, before: &Place) -> Result<Option<StopReason>, OrbitError> {
        let present = self.place();
        let span = self.move_to_orbit(&present);
        let begin = (present.phase, present.state);
        let found =
            span.and_then(|span| splitting::find_slow_begin(self.problem.integrator(), begin, span).ok()?);
        evaluate(&mut self.problem, &present.point.point)?;
        Ok(found.map(|splitting| splits_at(before.point.parameter(), splitting)))
    }

    /// If a step has passed a splitting: the number of contacts of an element has changed since the last row, and a contact of it splits in the orbit `before` the step or in the present one, at which the
    /// problem was evaluated last.
    ///
    /// Beside a splitting two sheets of orbits lie close to one another, and a corrector may fall from one onto the other, in a step or where the orbit is cut anew. That is no way on.
    pub(crate) fn passes_splitting(&mut self, before: &Place) -> Result<Option<StopReason>, OrbitError> {
        let changed = self.elements_with_other_touches();
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

    /// Names of the elements whose laws remember impacts and whose touches are not as many as in the last row.
    fn elements_with_other_touches(&self) -> Vec<String> {
        let elements = self.problem.system().elements().iter();
        let touches = self.touches.iter().zip(self.problem.touches());
        let changed = elements
            .zip(touches)
            .filter(|(element, (row, now))| element.law.remembers_impact() && row != now);
        changed.map(|(element, _)| element.name.clone()).collect()
    }

    /// If a contact of the present orbit is about to open and to be pressed on again at once, or has just begun to.
    fn splitting(&mut self, frequency_hz: f64) -> Option<StopReason> {
        let present = self.may_split()?;
        self.splitting_of(&present).map(|splitting| splits_at(frequency_hz, splitting))
    }

    /// Where the present orbit begins, if a contact of it may split.
    pub(crate) fn may_split(&self) -> Option<Place> {
        self.problem.system().remembers_impacts().then(|| self.place())
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

    /// Largest magnitude of the multipliers of the present orbit; infinite where they cannot be had.
    fn largest_multiplier(&mut self) -> f64 {
        let point = self.follower.current().clone();
        let row = evaluate(&mut self.problem, &point.point).and_then(|()| self.row_at(&point));
        row.map_or(f64::INFINITY, |row| row.solution.largest_multiplier())
    }
}

/// Why a walk ends whose last orbit has this frequency.
fn splits_at(frequency_hz: f64, Splitting { element, phase }: Splitting) -> StopReason {
    StopReason::ContactSplits { frequency_hz, element, phase }
}
