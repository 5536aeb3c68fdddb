//! Locating a branch point: the zero of `D = det [R_x R_λ; (W t)ᵀ]` on the way to the trial.
//!
//! A jump to a sheet that runs the other way also changes the sign of `D`, but there `D` has no zero between:
//! the bracket shrinks and `|D|` does not. That tells the two apart.

use super::{Arrival, Follower, bracket::Bracket};
use crate::{
    corrector::CorrectorError,
    error::Doubt,
    point::Events,
    predictor,
    problem::PathProblem,
    product::{norm, scale},
};

const MOST_PROBES: u32 = 40;
/// `|D|` relative to the ends of the step at which the search ends.
const SHARP: f64 = 1e-8;
/// `|D|` relative to the ends of the step that is needed for a branch point.
const VANISHING: f64 = 1e-3;
/// If `|D|` did not fall below `JUMP_SIZE` of the ends when the bracket has this share of the step, it jumps.
const JUMP_WIDTH: f64 = 1e-2;
const JUMP_SIZE: f64 = 0.1;
/// Share of `t_λ` of the ends below which the branch point is also a fold (as on the arms of a pitchfork).
const STATIONARY: f64 = 0.02;

impl Follower {
    /// Ends the step at the branch point before the trial, keeps the direction, and anchors the orientation
    /// anew.
    pub(super) fn arrive_at_branch_point(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
    ) -> Result<Arrival, Doubt> {
        let (share, smallness) = self.search_branch_point(problem, step)?;
        if smallness > VANISHING {
            return Err(Doubt::Reversed);
        }
        let parameter_sign = self.turn_at_branch_point(share)?;
        let uncertainty = self.sharpen_branch_point(problem, step, share);
        self.interpolate_tangent(share);
        std::mem::swap(&mut self.trial, &mut self.probe);
        let events = Events { branch_point: true, fold: parameter_sign.is_some(), ..Events::default() };
        Ok(Arrival { events, parameter_sign, anchors_anew: true, uncertainty, ..Arrival::default() })
    }

    /// Leaves the point with the smallest `|D|` found in the probe, evaluated last; returns its share of the
    /// step and its `|D|` relative to the larger of those at both ends.
    fn search_branch_point(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
    ) -> Result<(f64, f64), Doubt> {
        let scale = self.trial.log_determinant.max(self.state.current.log_determinant);
        let length = self.trial_progress();
        let low = (self.state.current.log_determinant - scale).exp().max(SHARP);
        let mut bracket = Bracket::new((0.0, low), (length, -(self.trial.log_determinant - scale).exp()));
        let mut smallest = (0.0, f64::INFINITY);
        for _ in 0..MOST_PROBES {
            let sigma = bracket.next();
            match self.probe_near_branch_point(problem, step, sigma, smallest.0 > 0.0) {
                Err(CorrectorError::SingularJacobian) => {
                    return self.exactly_singular(sigma / length);
                }
                Err(error) if smallest.1 > VANISHING => return Err(Doubt::Corrector(error)),
                Err(_) => break,
                Ok(()) => {}
            }
            let size = (self.probe.log_determinant - scale).exp();
            bracket.narrow(sigma, size * self.probe.sign * self.state.orientation);
            if size < smallest.1 {
                smallest = (sigma / length, size);
                std::mem::swap(&mut self.probe, &mut self.best);
            }
            if bracket.width() < JUMP_WIDTH * length && smallest.1 > JUMP_SIZE {
                return Err(Doubt::Reversed);
            }
            if size <= SHARP || bracket.width() <= self.settings.correction_floor {
                break;
            }
        }
        self.return_to_best(problem)?;
        Ok(smallest)
    }

    /// As [`probe_between`](Self::probe_between), but the best probe so far sharpens the prediction: near the
    /// branch point the direction of the path is known only as far as the prediction is close.
    fn probe_near_branch_point(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
        sigma: f64,
        use_best: bool,
    ) -> Result<(), CorrectorError> {
        let (base, out) = (self.state.history.base(), &mut self.probe.point);
        if use_best {
            predictor::hermite(&self.weights, base, [&self.trial.node, &self.best.node], sigma, out);
        } else {
            predictor::hermite(&self.weights, base, [&self.trial.node], sigma, out);
        }
        let limits = self.locating_limits(step);
        self.probe.correct(problem, &self.weights, &self.row, limits, &mut self.state.counters)
    }

    /// The matrix could not even be factorised: the probe lies on the branch point as far as numbers tell.
    fn exactly_singular(&mut self, share: f64) -> Result<(f64, f64), Doubt> {
        if self.probe.residual_norm > self.settings.correction_tolerance {
            return Err(Doubt::NotLocated);
        }
        let probe = &mut self.probe;
        probe.node.point.copy_from_slice(&probe.point);
        probe.signature = self.state.current.signature;
        probe.correction_norm = 0.0;
        probe.log_determinant = f64::NEG_INFINITY;
        Ok((share, 0.0))
    }

    /// Evaluates the best probe again, so that the problem holds the point that is accepted.
    fn return_to_best(&mut self, problem: &mut (impl PathProblem + ?Sized)) -> Result<(), Doubt> {
        std::mem::swap(&mut self.probe, &mut self.best);
        self.state.counters.evaluations += 1;
        problem.evaluate(&self.probe.point).map_err(|error| Doubt::Corrector(error.into()))
    }

    /// New sign of `t_λ` if the parameter turns at the branch point itself.
    fn turn_at_branch_point(&self, share: f64) -> Result<Option<f64>, Doubt> {
        let (before, after) = (self.state.parameter_sign, self.trial.tangent_parameter());
        if before * after >= 0.0 {
            return Ok(None);
        }
        let first = self.state.current.tangent_parameter();
        let here = (1.0 - share) * first + share * after;
        if here.abs() <= STATIONARY * first.abs().max(after.abs()) {
            return Ok(Some(-before));
        }
        if here * before > 0.0 { Ok(None) } else { Err(Doubt::HiddenFolds) }
    }

    /// At a branch point the direction from the factorisation is that of no branch; both ends of the step
    /// have one.
    fn interpolate_tangent(&mut self, share: f64) {
        let (base, node) = (self.state.history.base(), &self.trial.node);
        let tangent = &mut self.probe.node.tangent;
        for (i, t) in tangent.iter_mut().enumerate() {
            *t = (1.0 - share) * base.tangent[i] + share * node.tangent[i];
        }
        let length = norm(&self.weights, tangent);
        scale(tangent, 1.0 / length);
    }
}
