//! A branch point to all digits, from points beside it.
//!
//! In the plane of the corrector the crossing branch leaves a branch point: rounding `r` of the residual, and
//! whatever correction stays unapplied, becomes a displacement of `r / |D|` along it, which moves the zero of
//! `D` itself. So a search that ends at `|D| = 0` knows the place to about the root of `r`. Beside it, at
//! `±w` and `±2w` with `w` a fiftieth of the step, points are sharp and `D` is smooth: the cubic polynomial
//! of the path's length over `D` through these four gives the length at `D = 0`, the Hermite polynomial
//! through the inner two the point. The quadratic polynomial through three of them tells how far that can be
//! trusted.

use super::{Follower, bracket::at_zero};
use crate::{
    predictor::{self, Node},
    problem::PathProblem,
    product::progress,
};

/// `w` as a share of the step.
const ASIDE: f64 = 0.02;

impl Follower {
    /// Makes the probe, evaluated last, the branch point at this share of the step; returns the arc length
    /// within which it lies. If points beside it do not tell, the probe stays where it was.
    pub(super) fn sharpen_branch_point(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
        share: f64,
    ) -> f64 {
        let found = self.probe.clone();
        if let Some(uncertainty) = self.place_from_beside(problem, step, share) {
            return uncertainty;
        }
        self.probe = found;
        self.state.counters.evaluations += 1;
        // It was evaluated before: this cannot fail, and if it did the next step would tell.
        let _ = problem.evaluate(&self.probe.point);
        ASIDE * self.trial_progress()
    }

    fn place_from_beside(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
        share: f64,
    ) -> Option<f64> {
        let length = self.trial_progress();
        let scale = self.trial.log_determinant.max(self.state.current.log_determinant);
        let mut beside: Vec<(Node, f64)> = Vec::new();
        for place in [-2.0, -1.0, 1.0, 2.0] {
            self.probe_between(problem, step, (share + place * ASIDE) * length).ok()?;
            if self.probe.signature != self.state.current.signature {
                return None;
            }
            let size = (self.probe.log_determinant - scale).exp();
            beside.push((self.probe.node.clone(), size * self.probe.sign * self.state.orientation));
        }
        let (low, high) = (&beside[1].0, &beside[2].0);
        let of = |node: &Node| progress(&self.weights, &low.tangent, &node.point, &low.point);
        let places: Vec<(f64, f64)> = beside.iter().map(|(node, value)| (of(node), *value)).collect();
        let falls =
            places.windows(2).all(|pair| pair[0].1 > pair[1].1) && places[1].1 > 0.0 && places[2].1 < 0.0;
        if !falls {
            return None;
        }
        let root = at_zero(&places);
        predictor::hermite(&self.weights, low, [high], root, &mut self.probe.point);
        self.state.counters.evaluations += 1;
        problem.evaluate(&self.probe.point).ok()?;
        self.probe.residual_norm = problem.residual().iter().fold(0.0, |m: f64, r| r.abs().max(m));
        if self.probe.residual_norm > self.settings.correction_tolerance.max(self.settings.residual_floor) {
            return None;
        }
        let probe = &mut self.probe;
        probe.node.point.copy_from_slice(&probe.point);
        Some((root - at_zero(&places[..3])).abs().max((root - at_zero(&places[1..])).abs()))
    }
}
