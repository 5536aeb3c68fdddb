//! The end of the range: the last point is solved with the parameter fixed there.

use super::{Arrival, Follower};
use crate::{
    corrector::Limits,
    error::{Doubt, StopReason},
    problem::PathProblem,
};

impl Follower {
    /// The trial of this step lies beyond an end of the range: arrives exactly at the end instead.
    pub(super) fn arrive_at_end(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
        most_earlier: usize,
    ) -> Result<Arrival, Doubt> {
        let end =
            if self.trial.parameter() > self.range.high() { self.range.high() } else { self.range.low() };
        let sigma = self.predict_at(end, step, most_earlier);
        let last = self.trial.point.len() - 1;
        self.trial.point[last] = end;
        let limits = Limits {
            max_angle: None,
            max_displacement: 0.5 * sigma.max(self.settings.min_step),
            ..self.limits(step)
        };
        self.trial
            .correct(problem, &self.weights, &self.parameter_row, limits, &mut self.state.counters)
            .map_err(Doubt::Corrector)?;
        self.trial.orient(self.state.orientation);
        self.check_end(end, step)?;
        Ok(Arrival { end: Some(StopReason::RangeEnd), ..Arrival::default() })
    }

    /// Predicts in `0 ≤ σ ≤ step` where the predictor reaches the parameter `end`, by the secant method.
    fn predict_at(&mut self, end: f64, step: f64, most_earlier: usize) -> f64 {
        let last = self.trial.point.len() - 1;
        let first = self.state.history.base().point[last];
        let mut sigma = step * ((end - first) / (self.trial.point[last] - first)).clamp(0.0, 1.0);
        for _ in 0..4 {
            self.state.history.predict(&self.weights, sigma, most_earlier, &mut self.trial.point);
            let share = (end - first) / (self.trial.point[last] - first);
            if !share.is_finite() {
                break;
            }
            sigma = (sigma * share).clamp(0.0, step);
        }
        sigma
    }

    /// The parameter moves out of the range at the end, and nothing else happens on the way.
    fn check_end(&mut self, end: f64, step: f64) -> Result<(), Doubt> {
        if self.trial.signature != self.state.current.signature && step > self.settings.signature_step {
            return Err(Doubt::Signature);
        }
        self.check_defect(step)?;
        let outwards = if end == self.range.high() { 1.0 } else { -1.0 };
        let leaves =
            self.trial.tangent_parameter() * outwards > 0.0 && self.state.parameter_sign * outwards > 0.0;
        if leaves { Ok(()) } else { Err(Doubt::HiddenFolds) }
    }
}
