//! The search for a place between the last point and the trial: where it is looked at, and what was found
//! best.

use super::{attempt::Attempt, bracket::Bracket};
use crate::{
    corrector::{Candidate, CorrectorError, Limits},
    error::StepDoubt,
    predictor::hermite,
    problem::PathProblem,
};

/// A probe may be as far off the path as this share of the bracket, as long as the sign of its value is
/// beyond doubt.
const LOOSE: f64 = 1e-4;
/// The sign is beyond doubt if the value is so many times what the correction still due may change of it.
const BEYOND_DOUBT: f64 = 20.0;
/// A probe this near an end of the step, as a share of it, does not sharpen the prediction of the next one.
const NEAR_END: f64 = 1e-3;

/// Candidates between the last point and the trial.
#[derive(Debug, Clone)]
pub(super) struct Locator {
    /// Where it is looked.
    pub probe: Candidate,
    /// What was found best so far.
    pub best: Candidate,
}

/// Where a probe is put, for a value to become zero.
pub(super) struct Probing<'a> {
    pub bracket: &'a Bracket,
    /// Magnitude of the value at which the zero counts as reached; such a probe is sharp.
    pub reached: f64,
    /// Place in the step.
    pub place: f64,
    /// The probe before was one for the same zero; it sharpens the prediction.
    pub goes_on: bool,
    /// No probe may be off the path.
    pub sharply: bool,
}

impl Locator {
    pub fn new(length: usize) -> Self {
        Self { probe: Candidate::new(length), best: Candidate::new(length) }
    }

    /// Makes the probe the trial.
    pub fn arrive(&mut self, attempt: &mut Attempt<'_>) {
        std::mem::swap(attempt.trial, &mut self.probe);
    }

    /// Corrects the probe at `σ` of the step, predicted by the interpolant through both ends of the step.
    ///
    /// * `length`: of the step, for the limits.
    pub fn probe_between(
        &mut self,
        attempt: &mut Attempt<'_>,
        length: f64,
        sigma: f64,
    ) -> Result<(), StepDoubt> {
        self.predict(attempt, sigma, false);
        self.correct(attempt, attempt.probing_limits(length)).map_err(StepDoubt::Corrector)
    }

    /// Puts the probe on the path at a place of the step to the trial, as sharply as the sign of its value
    /// needs; `None` from `value` is a zero that cannot be looked for.
    pub fn probe_toward_zero(
        &mut self,
        attempt: &mut Attempt<'_>,
        probing: &Probing<'_>,
        mut value: impl FnMut(&mut Candidate, &mut dyn PathProblem) -> Option<f64>,
    ) -> Result<f64, StepDoubt> {
        self.predict(attempt, probing.place, probing.goes_on);
        let sharp = attempt.probing_limits(attempt.step);
        let tolerance = sharp.tolerance.max(LOOSE * probing.bracket.width());
        let loose = Limits { tolerance, parameter_tolerance: f64::INFINITY, ..sharp };
        let limits = if probing.sharply { sharp } else { loose };
        self.correct(attempt, limits).map_err(StepDoubt::Corrector)?;
        let mut found = value(&mut self.probe, attempt.problem).ok_or(StepDoubt::NotLocated)?;
        let due = self.probe.correction_norm;
        let floor = attempt.settings().correction_floor;
        let in_doubt = probing.bracket.slope() * (BEYOND_DOUBT * due).max(floor);
        if due > sharp.tolerance && found.abs() <= in_doubt.max(probing.reached) {
            let (moved, effort) = (self.probe.displacement + due, self.probe.effort);
            self.probe.point.copy_from_slice(&self.probe.node.point);
            self.correct(attempt, sharp).map_err(StepDoubt::Corrector)?;
            self.probe.displacement += moved;
            self.probe.effort += effort;
            found = value(&mut self.probe, attempt.problem).ok_or(StepDoubt::NotLocated)?;
        }
        self.best.node.copy_from(&self.probe.node);
        Ok(found)
    }

    /// Whether the probe is off the path by more than a sharp one.
    pub fn probe_is_loose(&self, attempt: &Attempt<'_>) -> bool {
        self.probe.correction_norm > attempt.probing_limits(attempt.step).tolerance
    }

    /// Predicts the probe at `σ` of the step by the polynomial through both ends, and through the best probe
    /// so far if there is one (`goes_on`).
    fn predict(&mut self, attempt: &Attempt<'_>, place: f64, goes_on: bool) {
        let (length, last) = (attempt.progress(), attempt.progress_of(&self.best.node));
        let is_inside = last > NEAR_END * length && length - last > NEAR_END * length;
        self.predict_through(attempt, place, goes_on && is_inside);
    }

    /// The same, wherever the best probe lies.
    pub fn predict_through(&mut self, attempt: &Attempt<'_>, place: f64, use_best: bool) {
        let (weights, base, trial) = (&attempt.frame.weights, attempt.state.base(), &attempt.trial.node);
        let out = &mut self.probe.point;
        if use_best {
            hermite(weights, base, [trial, &self.best.node], place, out);
        } else {
            hermite(weights, base, [trial], place, out);
        }
    }

    /// Corrects the probe in the plane across the tangent at the start of the step.
    pub fn correct(&mut self, attempt: &mut Attempt<'_>, limits: Limits) -> Result<(), CorrectorError> {
        let weights = &attempt.frame.weights;
        self.probe.correct(attempt.problem, weights, attempt.row, limits, attempt.counters)
    }

    /// Evaluates the probe, with correction and direction for the border of the trial.
    pub fn linearise(&mut self, attempt: &mut Attempt<'_>) -> Result<(), CorrectorError> {
        let weights = &attempt.frame.weights;
        self.probe.linearise(attempt.problem, weights, attempt.row, attempt.counters)
    }

    /// Evaluates the best probe again, so that the problem holds the point that is accepted.
    pub fn return_to_best(&mut self, attempt: &mut Attempt<'_>) -> Result<(), StepDoubt> {
        std::mem::swap(&mut self.probe, &mut self.best);
        attempt.evaluate(&self.probe.point)
    }
}
