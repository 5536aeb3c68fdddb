//! The follower: from one accepted point to the next.
//!
//! Its loop is short, and goes over three owners: where it is ([`PathState`]), a try (`Attempt`: the
//! candidate for the next point), and the search for a place between the two (`Locator`).
//!
//! | a try | in |
//! |---|---|
//! | predicted, corrected | `attempt.rs` |
//! | assessed: what lies between, or doubt | `assessment.rs`, `simpler.rs`, `outside.rs`, `hidden_zeros.rs` |
//! | ends at an event on its way | `fold.rs`, `branch_point.rs` with `beside.rs`, `zero.rs`, `change.rs` |
//! | ends at an end of the branch | `range_end.rs`, `closing.rs` |
//! | turns a corner, where no step is short enough | `corner.rs`, `known_corner.rs`, `root_corner.rs` |
//! | passes another such place | `sign_jump.rs`, `jump_over.rs` |

mod arrival;
mod assessment;
mod attempt;
mod beside;
mod bracket;
mod branch_point;
mod change;
mod closing;
mod corner;
mod direction;
mod fold;
mod hidden_zeros;
mod jump_over;
mod known_corner;
mod locator;
mod look_ahead;
mod outside;
mod range_end;
mod root_corner;
mod sign_jump;
mod simpler;
mod start;
mod step_control;
mod transfer;
mod undecided;
mod whole;
mod zero;

pub use direction::StartDirection;
pub use known_corner::PassedCorner;
pub use whole::{Branch, TwoSidedBranch, follow, follow_both};

use crate::{
    checkpoint::Checkpoint,
    corrector::{Candidate, CorrectorError},
    error::{PathStop, StepDoubt},
    memory::PathMemory,
    point::{ContinuationPoint, Counters},
    predictor::best_predictor,
    problem::PathProblem,
    product::{distance, product},
    settings::{ParameterRange, Settings},
    state::PathState,
    test_record::TestRecord,
};
use arrival::Arrival;
use assessment::StepAssessment;
use attempt::{Attempt, Frame};
use branch_point::arrive_at_branch_point;
use change::arrive_at_change;
use closing::arrive_at_start;
use corner::turn_corner;
use fold::arrive_at_fold;
use jump_over::jump_over;
use known_corner::{Looks, turn_known_corner};
use locator::Locator;
use outside::check_outside;
use range_end::arrive_at_end;
use root_corner::turn_root_corner;
use sign_jump::pass_sign_jump;
use simpler::check_simpler;
use step_control::{Accepted, Attempts, next_step};
use zero::{stop_at_zeros, zeros_at_once};

/// What one call of [`Follower::step`] did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepOutcome {
    /// [`Follower::current`] is a new point, and the problem was evaluated last exactly there.
    Accepted,
    /// The branch ended with the point accepted last. The problem may have been evaluated elsewhere.
    Stopped(PathStop),
}

/// Follows one path in one direction, one accepted point per call.
///
/// Events are points of their own: the step ends at a fold or branch point that lies on its way.
#[derive(Debug, Clone)]
pub struct Follower {
    frame: Frame,
    state: PathState,
    tests: TestRecord,
    counters: Counters,
    memory: PathMemory,
    /// The candidate for the next point, and its border.
    trial: Candidate,
    row: Vec<f64>,
    locator: Locator,
    /// The corner that the last step passed, where the judge computed it.
    passed: Option<PassedCorner>,
    /// It is a copy that only looks where the path goes (`look_ahead.rs`).
    looks_ahead: bool,
}

/// So many steps that come no farther than `Settings::short_step` each, on the average, end a branch: an
/// ordinary turn, whatever its size, is passed with steps that grow again.
pub const MOST_SHORT_STEPS: u64 = 5000;

/// Share of the tolerance up to which the error of a predictor does not matter.
const HARMLESS: f64 = 0.1;

impl Follower {
    /// The point accepted last; the start before the first step.
    #[must_use]
    pub fn current(&self) -> &ContinuationPoint {
        &self.state.current
    }

    /// Where it is.
    #[must_use]
    pub fn state(&self) -> &PathState {
        &self.state
    }

    /// The test functions at the last points.
    #[must_use]
    pub fn tests(&self) -> &TestRecord {
        &self.tests
    }

    /// Why the branch ended, if it did.
    #[must_use]
    pub fn stop_reason(&self) -> Option<PathStop> {
        self.state.stop
    }

    /// Work done since the start.
    #[must_use]
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// The settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.frame.settings
    }

    /// The corner between the point accepted last and the one before, if the judge computed it; not known any
    /// more after a [`resume`](Self::resume).
    #[must_use]
    pub fn passed_corner(&self) -> Option<&PassedCorner> {
        self.passed.as_ref()
    }

    /// All that is needed to continue later, but for the memory of the points.
    #[must_use]
    pub fn checkpoint(&self) -> Checkpoint {
        Checkpoint { state: self.state.clone(), tests: self.tests.clone(), counters: self.counters }
    }

    /// Continues from a checkpoint; then [`remember`](Self::remember) all accepted points in order.
    #[must_use]
    pub fn resume(
        problem: &mut dyn PathProblem,
        checkpoint: Checkpoint,
        range: ParameterRange,
        settings: Settings,
    ) -> Self {
        let Checkpoint { state, tests, counters } = checkpoint;
        let weights = problem.weights().to_vec();
        let length = weights.len();
        let memory_weights = problem.judge().memory_weights();
        let memory = PathMemory::new(memory_weights.as_ref().unwrap_or(&weights), &settings);
        let mut parameter_row = vec![0.0; length];
        parameter_row[length - 1] = 1.0;
        Self {
            frame: Frame { settings, range, weights, parameter_row },
            state,
            tests,
            counters,
            memory,
            trial: Candidate::new(length),
            row: vec![0.0; length],
            locator: Locator::new(length),
            passed: None,
            looks_ahead: false,
        }
    }

    /// Adds a point that was accepted before the checkpoint, in the units of the start
    /// ([`PathState::in_first_units`]), to the memory; the start comes first. It may be one of before a
    /// [`transfer`](Self::transfer).
    pub fn remember(&mut self, point: &ContinuationPoint) {
        self.memory.remember(point, &[1.0]);
    }

    /// The problem has made the units of its unknowns and equations larger.
    ///
    /// * `factors`: positive, as many in every call; unknown and equation `i` take number `i` modulo their
    ///   number, which divides that of the unknowns.
    pub fn rescale(&mut self, factors: &[f64]) {
        self.state.rescale(factors, &self.frame.weights, self.frame.settings.min_step);
    }

    /// Goes to the next point of the path.
    pub fn step(&mut self, problem: &mut dyn PathProblem) -> StepOutcome {
        self.state.stop = self.state.stop.or_else(|| self.used_up());
        if let Some(reason) = self.state.stop {
            return StepOutcome::Stopped(reason);
        }
        let evaluations = self.counters.evaluations;
        match self.next_point(problem) {
            Ok(()) => {
                self.state.current.evaluations = self.counters.evaluations - evaluations;
                StepOutcome::Accepted
            }
            Err(reason) => {
                self.state.stop = Some(reason);
                StepOutcome::Stopped(reason)
            }
        }
    }

    /// Why the branch ends here, if it has too many points, or does not get anywhere.
    fn used_up(&self) -> Option<PathStop> {
        let Counters { accepted, short_steps: steps, .. } = self.counters;
        if accepted >= self.frame.settings.max_points {
            return Some(PathStop::Budget);
        }
        let parameter = self.state.current.parameter();
        (steps >= MOST_SHORT_STEPS).then_some(PathStop::NoProgress { parameter, steps })
    }

    /// Attempts shorter and shorter steps until one is beyond doubt.
    fn next_point(&mut self, problem: &mut dyn PathProblem) -> Result<(), PathStop> {
        let mut attempts = Attempts::at(&self.frame, &self.state);
        let mut looks = Looks::at(&self.frame, &self.state);
        self.passed = None;
        loop {
            let doubt = match self.try_step(problem, attempts) {
                Ok(arrival) => {
                    self.accept(arrival, attempts.step, attempts.rejected);
                    return Ok(());
                }
                Err(doubt) => doubt,
            };
            let shorter = self.reject(doubt, &mut attempts);
            let is_too_short = shorter < self.frame.settings.min_step;
            if (looks.is_due(shorter) || is_too_short)
                && let Ok((arrival, length)) = self.pass_known_corner(problem, attempts.step)
            {
                self.accept(arrival, length, attempts.rejected);
                return Ok(());
            }
            if let Some(end) = attempts.retraces(&self.frame, &self.state, doubt, shorter) {
                return Err(end);
            }
            if is_too_short {
                let passed = self.pass_by_force(problem, attempts.step);
                let (arrival, length) = passed.ok_or_else(|| self.too_short(attempts.step, doubt))?;
                self.accept(arrival, length, attempts.rejected);
                return Ok(());
            }
            attempts.step = shorter;
        }
    }

    /// A try at a step of this length, and the search for places on its way.
    fn attempt<'a>(
        &'a mut self,
        problem: &'a mut dyn PathProblem,
        step: f64,
    ) -> (Attempt<'a>, &'a mut Locator) {
        let attempt = Attempt {
            frame: &self.frame,
            state: &self.state,
            memory: &self.memory,
            tests: &mut self.tests,
            counters: &mut self.counters,
            problem,
            trial: &mut self.trial,
            row: &mut self.row,
            step,
        };
        (attempt, &mut self.locator)
    }

    /// One try; on success the trial is the next point, and the problem evaluated there.
    fn try_step(&mut self, problem: &mut dyn PathProblem, attempts: Attempts) -> Result<Arrival, StepDoubt> {
        let arrival = self.arrive(problem, attempts)?;
        let (mut attempt, locator) = self.attempt(problem, attempts.step);
        let arrival = check_simpler(&mut attempt, arrival)?;
        let arrival = stop_at_zeros(&mut attempt, locator, arrival)?;
        check_outside(&mut attempt, arrival)
    }

    /// Predicts, corrects, judges, and locates what the path itself shows on the way.
    fn arrive(&mut self, problem: &mut dyn PathProblem, attempts: Attempts) -> Result<Arrival, StepDoubt> {
        let (mut attempt, locator) = self.attempt(problem, attempts.step);
        let earlier = attempt.predict(attempts.most_earlier);
        if !attempt.is_in_range() {
            return arrive_at_end(&mut attempt, attempts.most_earlier);
        }
        attempt.correct(attempt.limits(attempts.step))?;
        if !attempt.is_in_range() {
            return arrive_at_end(&mut attempt, attempts.most_earlier);
        }
        let mut assessment = assessment::assess(&mut attempt, locator)?;
        let turns = assessment == StepAssessment::Regular && self.turns_for_good(problem)?;
        let has_gone = turns && self.has_gone_its_way();
        if has_gone {
            assessment = StepAssessment::Fold;
        }
        let parameter_sign = (turns && !has_gone).then(|| -self.state.parameter_sign);
        let (mut attempt, locator) = self.attempt(problem, attempts.step);
        let arrival = match assessment {
            StepAssessment::Regular if attempt.changes_signature() => {
                arrive_at_change(&mut attempt, locator, earlier)
            }
            StepAssessment::Regular => Ok(Arrival { earlier, ..Arrival::default() }),
            StepAssessment::Closing(image) => arrive_at_start(&mut attempt, locator, image),
            StepAssessment::Fold => arrive_at_fold(&mut attempt, locator),
            StepAssessment::Reversed => arrive_at_branch_point(&mut attempt, locator),
        }?;
        Ok(Arrival { parameter_sign: arrival.parameter_sign.or(parameter_sign), ..arrival })
    }

    /// Gives up an attempt; length of the next one.
    fn reject(&mut self, doubt: StepDoubt, attempts: &mut Attempts) -> f64 {
        self.counters.rejected += 1;
        if doubt == StepDoubt::Signature {
            self.state.change_ahead = attempts.step;
        }
        attempts.reject(doubt, self.frame.settings.max_angle)
    }

    /// Turns a corner that the judge computes.
    fn pass_known_corner(
        &mut self,
        problem: &mut dyn PathProblem,
        step: f64,
    ) -> Result<(Arrival, f64), StepDoubt> {
        let (mut attempt, _) = self.attempt(problem, step);
        let turned = turn_known_corner(&mut attempt)?;
        let arrival = zeros_at_once(&mut attempt, turned.arrival);
        self.passed = Some(turned.corner);
        Ok((arrival, turned.length))
    }

    /// What remains to be tried when the shortest step is still in doubt: a corner, other equations on the
    /// same path, or a place that is known less well.
    fn pass_by_force(&mut self, problem: &mut dyn PathProblem, step: f64) -> Option<(Arrival, f64)> {
        let (mut attempt, locator) = self.attempt(problem, step);
        let attempt = &mut attempt;
        let (arrival, length) = turn_root_corner(attempt, locator)
            .or_else(|_| turn_corner(attempt, locator))
            .and_then(|(arrival, length)| Ok((check_simpler(attempt, arrival)?, length)))
            .or_else(|_| pass_sign_jump(attempt))
            .or_else(|_| jump_over(attempt))
            .ok()?;
        Some((zeros_at_once(attempt, arrival), length))
    }

    fn too_short(&self, step: f64, doubt: StepDoubt) -> PathStop {
        let parameter = self.state.current.parameter();
        match doubt {
            StepDoubt::Corrector(CorrectorError::Evaluation(error)) => {
                PathStop::EvaluationFailed { parameter, step, error }
            }
            _ => PathStop::StepTooShort { parameter, step, residual: self.trial.residual_norm, doubt },
        }
    }

    /// Makes the trial, evaluated last and oriented, the current point.
    fn accept(&mut self, arrival: Arrival, step: f64, rejected: u32) {
        let Self { frame, state, tests, counters, trial, .. } = self;
        let (weights, settings) = (&frame.weights, &frame.settings);
        let mut events = arrival.events;
        events.signature_change = trial.signature != state.current.signature;
        let base = state.history.base();
        let chord = distance(weights, &base.point, &trial.node.point);
        let angle = product(weights, &base.tangent, &trial.node.tangent).clamp(-1.0, 1.0).acos();
        let errors = state.history.errors(weights, &trial.node.point, &mut self.locator.probe.point);
        counters.accepted += 1;
        let made_up = (chord / settings.short_step) as u64;
        counters.short_steps = (counters.short_steps + 1).saturating_sub(made_up);
        let left = state.current.events.zeros;
        tests.go_on(&trial.tests, &trial.noted, left, arrival.zeros_near | arrival.events.zeros);
        if arrival.anchors_anew {
            state.orientation = -state.orientation;
        }
        state.parameter_sign = arrival.parameter_sign.unwrap_or(state.parameter_sign);
        state.outside = arrival.outside;
        state.stop = arrival.end;
        if events.signature_change || events.branch_point || events.corner {
            state.history.used = 0;
        }
        state.change_ahead =
            if events.signature_change { 0.0 } else { (state.change_ahead - chord).max(0.0) };
        state.history.push(&trial.node);
        // Where something else was located, the change of signature lies anywhere in the step.
        let of_change = if events.signature_change && arrival.events.any() { step } else { 0.0 };
        let arc_length = state.current.arc_length + chord * (1.0 + angle * angle / 24.0);
        let uncertainty = arrival.uncertainty.max(of_change);
        state.arrive(trial, arc_length, (events, uncertainty));
        let accepted = Accepted { trial, step, angle, earlier: arrival.earlier, rejected };
        state.step_length = next_step(frame, state, &accepted);
        let harmless = HARMLESS * settings.tolerance_at(state.step_length);
        state.most_earlier = best_predictor(&errors, state.step_length / chord, harmless);
        self.memory.remember(&state.current, &state.units);
    }
}
