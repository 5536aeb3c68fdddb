//! A path that comes back to its start is closed.

use super::{Arrival, Follower};
use crate::{
    error::{Doubt, StopReason},
    point::ContinuationPoint,
    predictor::Node,
    problem::PathProblem,
    product::{distance, product, progress},
};

/// The start and two more points are needed for a loop.
const FEWEST_POINTS: u64 = 3;
/// Cosine between the tangents at the start, left and reached.
const ALIGNED: f64 = 0.999;

impl Follower {
    /// The image of the start that the step to the trial passes in the direction in which it was left, if
    /// there is one; the start itself is image 0.
    pub(super) fn passes_start(&mut self, problem: &(impl PathProblem + ?Sized), step: f64) -> Option<usize> {
        let start = &self.state.start;
        let base = self.state.history.base();
        let off = (start.parameter() - base.point[base.point.len() - 1]).abs();
        let far = off * self.weights[base.point.len() - 1].sqrt() > 2.0 * step;
        if self.state.counters.accepted < FEWEST_POINTS || far || !off.is_finite() {
            return None;
        }
        (0..problem.images()).find(|&image| {
            let start = self.image_of_start(problem, image);
            self.passes(&start, step)
        })
    }

    /// The start as that image.
    fn image_of_start(&self, problem: &(impl PathProblem + ?Sized), image: usize) -> Node {
        let ContinuationPoint { point, tangent, .. } = &self.state.start;
        match image {
            0 => Node { point: point.clone(), tangent: tangent.clone() },
            k => Node { point: problem.image(k, point), tangent: problem.image(k, tangent) },
        }
    }

    fn passes(&mut self, start: &Node, step: f64) -> bool {
        let weights = &self.weights;
        let base = self.state.history.base();
        if distance(weights, &start.point, &base.point) > 2.0 * step {
            return false;
        }
        let sigma = progress(weights, &base.tangent, &start.point, &base.point);
        let fold_first = start.tangent[start.tangent.len() - 1] * self.state.parameter_sign < 0.0;
        let same_way = product(weights, &base.tangent, &start.tangent) > 0.0;
        if sigma <= 0.0 || sigma > self.trial_progress() || fold_first || !same_way {
            return false;
        }
        crate::predictor::hermite(weights, base, [&self.trial.node], sigma, &mut self.probe.point);
        distance(weights, &self.probe.point, &start.point) <= self.settings.allowed_displacement(step)
    }

    /// Ends the branch in the plane through this image of the start, if the path goes through the image
    /// itself.
    pub(super) fn arrive_at_start(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        image: usize,
    ) -> Result<Arrival, Doubt> {
        let start = self.image_of_start(problem, image);
        let base = self.state.history.base();
        let sigma = progress(&self.weights, &base.tangent, &start.point, &base.point);
        self.probe_between(problem, sigma, sigma)?;
        self.probe.orient(self.state.orientation);
        std::mem::swap(&mut self.trial, &mut self.probe);
        let apart = distance(&self.weights, &self.trial.node.point, &start.point);
        let cosine = product(&self.weights, &self.trial.node.tangent, &start.tangent);
        let closed = apart <= 10.0 * self.settings.correction_tolerance && cosine > ALIGNED;
        Ok(Arrival { end: closed.then_some(StopReason::Closed), ..Arrival::default() })
    }
}
