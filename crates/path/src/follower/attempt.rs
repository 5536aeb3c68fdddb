//! One attempt at a step: predict, correct, judge, and locate what lies on the way.

use super::{Arrival, Follower, judge::Finding};
use crate::{corrector::Limits, error::Doubt, problem::PathProblem, product::weigh};

impl Follower {
    /// Tries a step of this length; on success the trial is the next point, and the problem evaluated there.
    pub(super) fn attempt(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
        most_earlier: usize,
    ) -> Result<Arrival, Doubt> {
        weigh(&self.weights, &self.state.history.base().tangent, &mut self.row);
        let earlier = self.state.history.predict(&self.weights, step, most_earlier, &mut self.trial.point);
        if !self.range.contains(self.trial.parameter()) {
            return self.arrive_at_end(problem, step, most_earlier);
        }
        let limits = self.limits(step);
        self.trial
            .correct(problem, &self.weights, &self.row, limits, &mut self.state.counters)
            .map_err(Doubt::Corrector)?;
        if !self.range.contains(self.trial.parameter()) {
            return self.arrive_at_end(problem, step, most_earlier);
        }
        let mut finding = self.judge(problem, step)?;
        if finding == Finding::Regular && self.turns_for_good(problem)? {
            finding = Finding::Fold;
        }
        match finding {
            Finding::Regular if self.changes_signature() => self.arrive_at_change(problem, step, earlier),
            Finding::Regular => Ok(Arrival { earlier, ..Arrival::default() }),
            Finding::Closing(image) => self.arrive_at_start(problem, image),
            Finding::Fold => self.arrive_at_fold(problem, step),
            Finding::Reversed => self.arrive_at_branch_point(problem, step),
        }
    }

    /// How far the corrector may move a prediction: what the settings say, but ten times what rounding left
    /// of the last correction, too. At the shortest steps that is more than a tenth of the step; without it
    /// they could not grow any more where a solution is known less well.
    pub(super) fn allowed_displacement(&self, step: f64) -> f64 {
        let rounding = self.state.current.correction_norm.min(self.settings.correction_tolerance);
        self.settings.allowed_displacement(step).max((10.0 * rounding).min(self.settings.sheet_distance))
    }

    pub(super) fn limits(&self, step: f64) -> Limits {
        Limits {
            tolerance: self.settings.tolerance_at(step),
            loose_tolerance: self.settings.loose_tolerance_at(step),
            singular_tolerance: self.settings.loose_tolerance_at(step).max(0.01 * step),
            residual_floor: self.settings.residual_floor,
            residual_tolerance: self.settings.residual_tolerance,
            residual_wanted: self.settings.residual_wanted,
            max_iterations: self.settings.max_iterations,
            max_displacement: self.allowed_displacement(step),
            max_angle: Some(self.settings.max_angle),
        }
    }

    /// Corrects the probe at `σ` of the step, predicted by the interpolant through both ends of the step.
    pub(super) fn probe_between(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
        sigma: f64,
    ) -> Result<(), Doubt> {
        self.predict_probe(sigma, false);
        self.correct_probe(problem, self.probing_limits(step))
    }

    /// [`locating_limits`](Self::locating_limits) for a place within a step whose ends are known.
    pub(super) fn probing_limits(&self, step: f64) -> Limits {
        Limits { max_angle: Some(2.0 * self.settings.max_angle), ..self.locating_limits(step) }
    }

    /// Events are located to a hundredth of the tolerance, as far as rounding allows.
    pub(super) fn locating_limits(&self, step: f64) -> Limits {
        let limits = self.limits(step);
        let sharp = (0.01 * self.settings.correction_tolerance).max(self.settings.correction_floor);
        Limits { tolerance: limits.tolerance.min(sharp), max_angle: None, ..limits }
    }
}
