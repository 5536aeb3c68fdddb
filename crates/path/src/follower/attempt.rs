//! One try at a step: a candidate ahead of the point accepted last, and what it is corrected and compared
//! with.

use crate::{
    corrector::{Candidate, CorrectorError, Limits},
    error::StepDoubt,
    memory::PathMemory,
    point::{ContinuationPoint, Counters},
    predictor::Node,
    problem::PathProblem,
    product::{add_scaled, progress, weigh},
    settings::{ParameterRange, Settings},
    state::PathState,
    test_record::TestRecord,
};

/// What does not change along the path, unless its unknowns do.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    pub settings: Settings,
    pub range: ParameterRange,
    pub weights: Vec<f64>,
    /// The border that keeps the parameter.
    pub parameter_row: Vec<f64>,
}

impl Frame {
    /// How far the corrector may move a prediction: what the settings say, but ten times what rounding left
    /// of the last correction, too. At the shortest steps that is more than a tenth of the step; without it
    /// they could not grow any more where a solution is known less well.
    pub fn allowed_displacement(&self, current: &ContinuationPoint, step: f64) -> f64 {
        let rounding = current.correction_norm.min(self.settings.correction_tolerance);
        self.settings.allowed_displacement(step).max((10.0 * rounding).min(self.settings.sheet_distance))
    }
}

/// A try at one step from where the follower is, which stays as it is.
pub(super) struct Attempt<'a> {
    pub frame: &'a Frame,
    pub state: &'a PathState,
    pub memory: &'a PathMemory,
    /// The test functions of the last point change where they are compared with fewer parts.
    pub tests: &'a mut TestRecord,
    pub counters: &'a mut Counters,
    pub problem: &'a mut dyn PathProblem,
    /// The candidate for the next point.
    pub trial: &'a mut Candidate,
    /// The border of the trial: `W t₀`, unless it was put behind a corner.
    pub row: &'a mut [f64],
    /// Length of the step.
    pub step: f64,
}

impl Attempt<'_> {
    pub fn settings(&self) -> &Settings {
        &self.frame.settings
    }

    /// Predicts the trial with at most so many earlier nodes; how many were used.
    pub fn predict(&mut self, most_earlier: usize) -> usize {
        weigh(&self.frame.weights, &self.state.base().tangent, self.row);
        let history = &self.state.history;
        history.predict(&self.frame.weights, self.step, most_earlier, &mut self.trial.point)
    }

    /// Puts the trial on the tangent, this far ahead of the last point.
    pub fn put_ahead(&mut self, distance: f64) {
        let base = self.state.history.base();
        self.trial.point.copy_from_slice(&base.point);
        add_scaled(&mut self.trial.point, distance, &base.tangent);
    }

    /// Makes the tangent at the last point the border.
    pub fn border_across(&mut self, tangent: &[f64]) {
        weigh(&self.frame.weights, tangent, self.row);
    }

    /// Corrects the trial with the present border.
    pub fn correct(&mut self, limits: Limits) -> Result<(), StepDoubt> {
        let corrected =
            self.trial.correct(self.problem, &self.frame.weights, self.row, limits, self.counters);
        corrected.map_err(StepDoubt::Corrector)
    }

    /// Corrects the trial at fixed parameter.
    pub fn correct_at_parameter(&mut self, limits: Limits) -> Result<(), StepDoubt> {
        let Frame { weights, parameter_row, .. } = self.frame;
        let corrected = self.trial.correct(self.problem, weights, parameter_row, limits, self.counters);
        corrected.map_err(StepDoubt::Corrector)
    }

    /// Evaluates the trial, with correction and direction for the present border.
    pub fn linearise(&mut self) -> Result<(), CorrectorError> {
        self.trial.linearise(self.problem, &self.frame.weights, self.row, self.counters)
    }

    /// Correction and direction for the present border at the trial, evaluated last.
    pub fn refactorise(&mut self) -> Result<(), CorrectorError> {
        self.trial.refactorise(self.problem, &self.frame.weights, self.row)
    }

    /// The same for the border that keeps the parameter.
    pub fn refactorise_at_parameter(&mut self) -> Result<(), CorrectorError> {
        self.trial.refactorise(self.problem, &self.frame.weights, &self.frame.parameter_row)
    }

    /// Evaluates the problem at a point, to no other end.
    pub fn evaluate(&mut self, point: &[f64]) -> Result<(), StepDoubt> {
        self.counters.evaluations += 1;
        self.problem.evaluate(point).map_err(|error| StepDoubt::Corrector(error.into()))
    }

    /// Evaluates the trial again, so that the problem holds the point that is accepted. Its test functions
    /// stay as they are noted: of one whose zero was located there before, the sign at the trial is rounding.
    pub fn return_to_trial(&mut self) -> Result<(), StepDoubt> {
        self.counters.evaluations += 1;
        self.problem.evaluate(&self.trial.point).map_err(|error| StepDoubt::Corrector(error.into()))
    }

    /// Length of the trial's step along the tangent of its base.
    pub fn progress(&self) -> f64 {
        self.progress_of(&self.trial.node)
    }

    /// That of another node.
    pub fn progress_of(&self, node: &Node) -> f64 {
        let base = self.state.base();
        progress(&self.frame.weights, &base.tangent, &node.point, &base.point)
    }

    /// Whether the trial has another signature than the point before.
    pub fn changes_signature(&self) -> bool {
        self.trial.signature != self.state.current.signature
    }

    /// Whether the parameter of the trial lies in the range.
    pub fn is_in_range(&self) -> bool {
        self.frame.range.contains(self.trial.parameter())
    }

    /// Arc length of an earlier stretch that runs through the oriented trial, if there is one.
    pub fn meets_earlier_stretch(&self) -> Option<f64> {
        self.memory.meets(self.trial, self.state.orientation, &self.state.units)
    }

    /// See [`Frame::allowed_displacement`].
    pub fn allowed_displacement(&self, step: f64) -> f64 {
        self.frame.allowed_displacement(&self.state.current, step)
    }

    /// What a correction over this length must keep to.
    pub fn limits(&self, length: f64) -> Limits {
        Limits { max_displacement: self.allowed_displacement(length), ..self.settings().limits(length) }
    }

    /// Events are located to a hundredth of the tolerance, as far as rounding allows.
    pub fn locating_limits(&self, length: f64) -> Limits {
        let limits = self.limits(length);
        let settings = self.settings();
        let sharp = (0.01 * settings.correction_tolerance).max(settings.correction_floor);
        Limits { tolerance: limits.tolerance.min(sharp), max_angle: None, ..limits }
    }

    /// [`locating_limits`](Self::locating_limits) for a place within a step whose ends are known.
    pub fn probing_limits(&self, length: f64) -> Limits {
        Limits { max_angle: Some(2.0 * self.settings().max_angle), ..self.locating_limits(length) }
    }
}
