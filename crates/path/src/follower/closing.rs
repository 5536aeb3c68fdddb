//! A path that comes back to its start is closed.

use super::{Arrival, Follower};
use crate::{
    error::{Doubt, StopReason},
    problem::PathProblem,
    product::{distance, product, progress},
};

/// The start and two more points are needed for a loop.
const FEWEST_POINTS: u64 = 3;
/// Cosine between the tangents at the start, left and reached.
const ALIGNED: f64 = 0.999;

impl Follower {
    /// Whether the step to the trial passes the start in the direction in which it was left.
    pub(super) fn passes_start(&mut self, step: f64) -> bool {
        let (start, weights) = (&self.state.start, &self.weights);
        let base = self.state.history.base();
        if self.state.counters.accepted < FEWEST_POINTS
            || distance(weights, &start.point, &base.point) > 2.0 * step
        {
            return false;
        }
        let sigma = progress(weights, &base.tangent, &start.point, &base.point);
        let fold_first = start.tangent_parameter() * self.state.parameter_sign < 0.0;
        let same_way = product(weights, &base.tangent, &start.tangent) > 0.0;
        if sigma <= 0.0 || sigma > self.trial_progress() || fold_first || !same_way {
            return false;
        }
        crate::predictor::hermite(weights, base, [&self.trial.node], sigma, &mut self.probe.point);
        distance(weights, &self.probe.point, &start.point) <= self.settings.allowed_displacement(step)
    }

    /// Ends the branch in the plane through the start, if the path goes through the start itself.
    pub(super) fn arrive_at_start(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
    ) -> Result<Arrival, Doubt> {
        let base = self.state.history.base();
        let sigma = progress(&self.weights, &base.tangent, &self.state.start.point, &base.point);
        self.probe_between(problem, sigma, sigma)?;
        self.probe.orient(self.state.orientation);
        std::mem::swap(&mut self.trial, &mut self.probe);
        let start = &self.state.start;
        let apart = distance(&self.weights, &self.trial.node.point, &start.point);
        let cosine = product(&self.weights, &self.trial.node.tangent, &start.tangent);
        let closed = apart <= 10.0 * self.settings.correction_tolerance && cosine > ALIGNED;
        Ok(Arrival { end: closed.then_some(StopReason::Closed), ..Arrival::default() })
    }
}
