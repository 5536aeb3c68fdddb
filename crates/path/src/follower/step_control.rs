//! Step lengths: from the angle between tangents, the corrector's displacement and its effort.
//!
//! With a predictor of error order `p` a step `f h` has `f^p` times the displacement and about `f` times the
//! angle. Aimed at is half the largest angle and a quarter of the allowed displacement.

use super::{Arrival, Attempts, Follower};
use crate::{corrector::CorrectorError, error::Doubt, predictor::order, problem::PathProblem};

/// Steps grow at most by this factor, so that after an event they stay in proportion to the distance from it.
const MOST_GROWTH: f64 = 2.0;
/// So many last corrections of the displacement are put down to rounding: steps do not shrink on account of
/// it.
const NOISE: f64 = 4.0;
const EFFORTLESS_ITERATIONS: u32 = 3;

impl Follower {
    /// Length of the first attempt at a step.
    pub(super) fn first_step(&self) -> f64 {
        let mut step = self.state.step_length.min(self.longest_step());
        if self.state.change_ahead > 0.0 {
            step = step.min((0.5 * self.state.change_ahead).max(self.settings.signature_step));
        }
        step.max(self.settings.min_step)
    }

    /// Half the way to the next change of signature at most, if the problem sees it coming.
    pub(super) fn heed_change_ahead(&mut self, problem: &(impl PathProblem + ?Sized)) {
        let distance = problem.distance_to_change(&self.state.current.tangent);
        if distance.is_finite() {
            let most = (0.5 * distance).max(self.settings.signature_step);
            self.state.step_length = self.state.step_length.min(most);
        }
    }

    /// `h ≤ max_step_length` and `h (|t_λ| + |t_λ'| h) ≤ max_parameter_step`, with `t_λ'` from the last step.
    fn longest_step(&self) -> f64 {
        let history = &self.state.history;
        let base = history.base();
        let last = base.point.len() - 1;
        let slope = base.tangent[last].abs();
        let most = self.settings.max_parameter_step;
        if history.used < 2 || !most.is_finite() {
            return self.settings.longest_step(slope);
        }
        let before = &history.nodes[1];
        let length = crate::product::distance(&self.weights, &base.point, &before.point);
        let bend = (base.tangent[last] - before.tangent[last]).abs() / length;
        let root = (slope * slope + 4.0 * bend * most).sqrt();
        self.settings.max_step_length.min(2.0 * most / (slope + root).max(f64::MIN_POSITIVE))
    }

    /// Length of the next step after an accepted one.
    pub(super) fn next_step(&self, step: f64, arrival: Arrival, angle: f64, attempts: Attempts) -> f64 {
        let by_angle = 0.5 * self.settings.max_angle / angle.max(1e-12);
        let aim = 0.25 * self.allowed_displacement(step);
        let displacement = self.trial.displacement - NOISE * self.trial.correction_norm;
        let by_displacement = (aim / displacement.max(1e-300)).powf(1.0 / order(arrival.earlier));
        let effort = if self.trial.iterations > EFFORTLESS_ITERATIONS { 0.7 } else { MOST_GROWTH };
        let hold = if attempts.rejected > 0 { 1.0 } else { MOST_GROWTH };
        let factor = by_angle.min(by_displacement).min(effort).min(hold).max(0.3);
        (step * factor).max(self.settings.min_step)
    }

    /// Length of the next attempt after a rejected one.
    ///
    /// The second rejection falls back to the next simpler predictor, the third to the tangent.
    pub(super) fn shortened(&mut self, step: f64, doubt: Doubt, attempts: &mut Attempts) -> f64 {
        attempts.rejected += 1;
        if doubt == Doubt::Signature {
            self.state.change_ahead = step;
            return 0.5 * step;
        }
        if attempts.rejected > 1 {
            attempts.most_earlier = attempts.most_earlier.saturating_sub(1);
        }
        step * match doubt {
            Doubt::Corrector(CorrectorError::Displaced { displacement, allowed }) => {
                (0.25 * allowed / displacement).powf(1.0 / order(attempts.most_earlier)).clamp(0.1, 0.5)
            }
            Doubt::Corrector(CorrectorError::Turned { angle }) | Doubt::Angle { angle } => {
                (0.5 * self.settings.max_angle / angle).clamp(0.25, 0.5)
            }
            Doubt::Corrector(_) => 0.25,
            Doubt::Retraced { .. } => {
                attempts.retraced += 1;
                0.5
            }
            _ => 0.5,
        }
    }
}
