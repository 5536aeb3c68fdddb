//! The follower: from one accepted point to the next.

mod attempt;
mod beside;
mod bracket;
mod branch_point;
mod closing;
mod corner;
mod fold;
mod judge;
mod known_corner;
mod leap;
mod look_ahead;
mod outside;
mod range_end;
mod recut;
mod rescale;
mod root_corner;
mod simpler;
mod start;
mod step_control;
mod transfer;
mod undecided;
mod whole;
mod zero;

pub use known_corner::PassedCorner;
pub use start::Direction;
pub use whole::{Branch, TwoSidedBranch, follow, follow_both};

use crate::{
    checkpoint::Checkpoint,
    corrector::Candidate,
    error::{Doubt, StopReason},
    memory::PathMemory,
    point::{ContinuationPoint, Counters, Events},
    predictor::best_predictor,
    problem::PathProblem,
    product::{distance, product},
    settings::{ParameterRange, Settings},
};

/// What one call of [`Follower::step`] did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepOutcome {
    /// [`Follower::current`] is a new point, and the problem was evaluated last exactly there.
    Accepted,
    /// The branch ended with the point accepted last. The problem may have been evaluated elsewhere.
    Stopped(StopReason),
}

/// Follows one path in one direction, one accepted point per call.
///
/// Events are points of their own: the step ends at a fold or branch point that lies on its way.
#[derive(Debug, Clone)]
pub struct Follower {
    settings: Settings,
    range: ParameterRange,
    weights: Vec<f64>,
    state: Checkpoint,
    memory: PathMemory,
    /// The candidate for the next point.
    trial: Candidate,
    /// Candidates between, while something is located.
    probe: Candidate,
    best: Candidate,
    /// `W t₀`.
    row: Vec<f64>,
    /// The border that keeps the parameter.
    parameter_row: Vec<f64>,
    /// The corner that the last step passed, where the problem computed it.
    passed: Option<PassedCorner>,
    /// It is a copy that only looks where the path goes (`look_ahead.rs`).
    looks_ahead: bool,
}

/// A candidate that is to be accepted.
#[derive(Debug, Clone, Copy, Default)]
struct Arrival {
    events: Events,
    /// The branch ends here for this reason.
    end: Option<StopReason>,
    /// Earlier nodes of the predictor, for the order in the step control.
    earlier: usize,
    /// Sign of `t_λ` from here on, if it differs from that before.
    parameter_sign: Option<f64>,
    /// The sign of the determinant changes here while the direction of travel does not.
    anchors_anew: bool,
    /// Arc length within which an event was located.
    uncertainty: f64,
    /// Test functions that have not left their last zero yet.
    zeros_near: u32,
    /// Least and most number of multipliers outside the unit circle behind the candidate, if known.
    outside: Option<(u32, u32)>,
    /// Multipliers outside beside the zero that the candidate is, if it was looked for and they are known.
    counted: Option<outside::Counted>,
}

/// What happened to the attempts at one step.
#[derive(Debug, Clone, Copy)]
struct Attempts {
    rejected: u32,
    retraced: u32,
    most_earlier: usize,
}

/// So many steps in a row that are no longer than `Settings::crawl_step` end a branch: an ordinary turn,
/// whatever its size, is passed with steps that grow again.
pub const MOST_SHORT_STEPS: u64 = 5000;

/// Share of the tolerance up to which the error of a predictor does not matter.
const HARMLESS: f64 = 0.1;

/// So many halvings of a step that meets an old stretch are enough to know that the jump was made earlier.
const MOST_RETRACED: u32 = 8;

impl Follower {
    /// The point accepted last; the start before the first step.
    #[must_use]
    pub fn current(&self) -> &ContinuationPoint {
        &self.state.current
    }

    /// Why the branch ended, if it did.
    #[must_use]
    pub fn stop_reason(&self) -> Option<StopReason> {
        self.state.stop
    }

    /// Work done since the start.
    #[must_use]
    pub fn counters(&self) -> Counters {
        self.state.counters
    }

    /// The settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The corner between the point accepted last and the one before, if the problem computed it; not known
    /// any more after a [`resume`](Self::resume).
    #[must_use]
    pub fn passed_corner(&self) -> Option<&PassedCorner> {
        self.passed.as_ref()
    }

    /// All that is needed to continue later, but for the memory of the points.
    #[must_use]
    pub fn checkpoint(&self) -> &Checkpoint {
        &self.state
    }

    /// Continues from a checkpoint; then [`remember`](Self::remember) all accepted points in order.
    #[must_use]
    pub fn resume(
        problem: &(impl PathProblem + ?Sized),
        checkpoint: Checkpoint,
        range: ParameterRange,
        settings: Settings,
    ) -> Self {
        let weights = problem.weights().to_vec();
        let length = weights.len();
        let memory = PathMemory::new(&problem.memory_weights(), &settings);
        let mut parameter_row = vec![0.0; length];
        parameter_row[length - 1] = 1.0;
        let candidate = Candidate::new(length);
        Self {
            settings,
            range,
            weights,
            state: checkpoint,
            memory,
            trial: candidate.clone(),
            probe: candidate.clone(),
            best: candidate,
            row: vec![0.0; length],
            parameter_row,
            passed: None,
            looks_ahead: false,
        }
    }

    /// Adds a point that was accepted before the checkpoint, in the units of the start
    /// ([`in_first_units`](Self::in_first_units)), to the memory; the start comes first. It may be one of
    /// before a [`transfer`](Self::transfer).
    pub fn remember(&mut self, point: &ContinuationPoint) {
        self.memory.remember(point, 1.0);
    }

    /// Goes to the next point of the path.
    pub fn step(&mut self, problem: &mut (impl PathProblem + ?Sized)) -> StepOutcome {
        if self.state.stop.is_none() && self.state.counters.accepted >= self.settings.max_points {
            self.state.stop = Some(StopReason::Budget);
        }
        let Counters { short_in_a_row: steps, .. } = self.state.counters;
        if self.state.stop.is_none() && steps >= MOST_SHORT_STEPS {
            self.state.stop = Some(StopReason::Crawls { parameter: self.state.current.parameter(), steps });
        }
        if let Some(reason) = self.state.stop {
            return StepOutcome::Stopped(reason);
        }
        let evaluations = self.state.counters.evaluations;
        match self.next_point(problem) {
            Ok(()) => {
                self.heed_change_ahead(problem);
                self.state.current.evaluations = self.state.counters.evaluations - evaluations;
                StepOutcome::Accepted
            }
            Err(reason) => {
                self.state.stop = Some(reason);
                StepOutcome::Stopped(reason)
            }
        }
    }

    /// Attempts shorter and shorter steps until one is beyond doubt.
    fn next_point(&mut self, problem: &mut (impl PathProblem + ?Sized)) -> Result<(), StopReason> {
        let mut attempts = Attempts { rejected: 0, retraced: 0, most_earlier: self.state.most_earlier };
        let mut step = self.first_step();
        let mut look = self.first_look_for_corner();
        self.passed = None;
        loop {
            let attempt = self.attempt(problem, step, attempts.most_earlier);
            let checked = attempt.and_then(|arrival| self.heed_simpler(problem, arrival));
            let checked = checked.and_then(|arrival| self.heed_zeros(problem, step, arrival));
            let doubt = match checked.and_then(|arrival| self.heed_outside(problem, step, arrival)) {
                Ok(arrival) => {
                    self.accept(arrival, step, attempts);
                    return Ok(());
                }
                Err(doubt) => doubt,
            };
            self.state.counters.rejected += 1;
            let shorter = self.shortened(step, doubt, &mut attempts);
            if shorter < look {
                look = self.next_look_for_corner(look);
                if let Ok((arrival, length)) = self.turn_known_corner(problem, step) {
                    let arrival = self.zeros_at_once(problem, arrival);
                    self.accept(arrival, length, attempts);
                    return Ok(());
                }
            }
            self.give_up_if_retraced(doubt, shorter, attempts)?;
            if shorter < self.settings.min_step {
                let (arrival, length) =
                    self.pass_by_force(problem, step).ok_or_else(|| self.too_short(step, doubt))?;
                let arrival = self.zeros_at_once(problem, arrival);
                self.accept(arrival, length, attempts);
                return Ok(());
            }
            step = shorter;
        }
    }

    /// What is left when the shortest step is still in doubt: a corner, other equations on the same path, or
    /// a place that is known less well.
    fn pass_by_force(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
    ) -> Option<(Arrival, f64)> {
        self.turn_root_corner(problem, step)
            .or_else(|_| self.turn_corner(problem, step))
            .and_then(|(arrival, length)| Ok((self.heed_simpler(problem, arrival)?, length)))
            .or_else(|_| self.pass_recut(problem, step))
            .or_else(|_| self.leap(problem))
            .ok()
    }

    fn give_up_if_retraced(&self, doubt: Doubt, step: f64, attempts: Attempts) -> Result<(), StopReason> {
        let Doubt::Retraced { arc_length } = doubt else { return Ok(()) };
        if step < self.settings.min_step || attempts.retraced > MOST_RETRACED {
            let parameter = self.state.current.parameter();
            return Err(StopReason::RunsBack { parameter, met_arc_length: arc_length });
        }
        Ok(())
    }

    fn too_short(&self, step: f64, doubt: Doubt) -> StopReason {
        let parameter = self.state.current.parameter();
        match doubt {
            Doubt::Corrector(crate::CorrectorError::Evaluation(error)) => {
                StopReason::EvaluationFailed { parameter, step, error }
            }
            _ => StopReason::StepTooShort { parameter, step, residual: self.trial.residual_norm, doubt },
        }
    }

    /// Makes the trial, evaluated last and oriented, the current point.
    fn accept(&mut self, arrival: Arrival, step: f64, attempts: Attempts) {
        let state = &mut self.state;
        let mut events = arrival.events;
        events.signature_change = self.trial.signature != state.current.signature;
        let base = state.history.base();
        let chord = distance(&self.weights, &base.point, &self.trial.node.point);
        let angle = product(&self.weights, &base.tangent, &self.trial.node.tangent).clamp(-1.0, 1.0).acos();
        let errors = state.history.errors(&self.weights, &self.trial.node.point, &mut self.probe.point);
        let arc_length = state.current.arc_length + chord * (1.0 + angle * angle / 24.0);
        if arrival.anchors_anew {
            state.orientation = -state.orientation;
        }
        if let Some(sign) = arrival.parameter_sign {
            state.parameter_sign = sign;
        }
        if events.signature_change || events.branch_point || events.corner {
            state.history.used = 0;
        }
        state.change_ahead =
            if events.signature_change { 0.0 } else { (state.change_ahead - chord).max(0.0) };
        state.history.push(&self.trial.node);
        state.stop = arrival.end;
        state.counters.accepted += 1;
        let is_short = chord <= self.settings.crawl_step;
        state.counters.short_in_a_row = if is_short { state.counters.short_in_a_row + 1 } else { 0 };
        state.zeros_near = arrival.zeros_near | arrival.events.zeros;
        std::mem::swap(&mut state.tests, &mut state.tests_before);
        // Where a function was zero, what was noted is its value beyond.
        let zeros = state.current.events.zeros;
        let at_zero = state.tests_before.iter_mut().enumerate().filter(|(k, _)| zeros >> k & 1 == 1);
        at_zero.for_each(|(_, test)| test.value = 0.0);
        state.tests.clone_from(&self.trial.tests);
        state.noted.clone_from(&self.trial.noted);
        state.outside = arrival.outside;
        // Where something else was located, the change of signature lies anywhere in the step.
        let of_change = if events.signature_change && arrival.events.any() { step } else { 0.0 };
        self.store(events, arrival.uncertainty.max(of_change), arc_length);
        self.state.step_length = self.next_step(step, arrival, angle, attempts);
        let next = self.state.step_length;
        let harmless = HARMLESS * self.settings.tolerance_at(next);
        self.state.most_earlier = best_predictor(&errors, next / chord, harmless);
        self.memory.remember(&self.state.current, self.state.unit);
    }

    /// Copies the trial into the current point.
    fn store(&mut self, events: Events, uncertainty: f64, arc_length: f64) {
        let orientation = self.state.orientation;
        let (current, trial) = (&mut self.state.current, &self.trial);
        current.point.copy_from_slice(&trial.point);
        current.tangent.copy_from_slice(&trial.node.tangent);
        current.arc_length = arc_length;
        current.signature = trial.signature;
        current.orientation = orientation;
        current.log_determinant = trial.log_determinant;
        current.correction_norm = trial.correction_norm;
        current.residual_norm = trial.residual_norm;
        current.events = events;
        current.uncertainty = uncertainty;
    }
}
