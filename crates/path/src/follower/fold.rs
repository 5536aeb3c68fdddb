//! Locating a fold: the zero of `t_λ` on the way to the trial.

use super::{Arrival, Follower, bracket::Bracket};
use crate::{error::Doubt, problem::PathProblem, product::progress};

/// Enough for bisection to reach rounding, were it needed.
const MOST_PROBES: u32 = 60;

impl Follower {
    /// Ends the step at the fold before the trial: `|t_λ| ≤ fold_tolerance`, or a bracket of rounding.
    pub(super) fn arrive_at_fold(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
    ) -> Result<Arrival, Doubt> {
        let before = self.state.parameter_sign;
        let slope = self.parameter_slope();
        let start = before * (before * slope.start).max(f64::MIN_POSITIVE);
        let mut bracket = Bracket::new((0.0, start), (self.trial_progress(), slope.end));
        let mut sigma = bracket.width() * slope.root();
        for probes in 0..MOST_PROBES {
            self.probe_toward_zero(
                problem,
                step,
                (&bracket, self.settings.fold_tolerance),
                (sigma, probes > 0),
                |probe, _| Some(probe.tangent_parameter()),
            )?;
            self.check_fold_probe(step)?;
            let value = self.probe.tangent_parameter();
            bracket.narrow(sigma, value);
            if value.abs() <= self.settings.fold_tolerance
                || bracket.uncertainty(value) <= self.settings.correction_floor
            {
                break;
            }
            sigma = bracket.next();
        }
        let uncertainty = bracket.uncertainty(self.probe.tangent_parameter());
        std::mem::swap(&mut self.trial, &mut self.probe);
        if !self.range.contains(self.trial.parameter()) {
            return Err(Doubt::NotLocated);
        }
        let mut arrival = Arrival { parameter_sign: Some(-before), uncertainty, ..Arrival::default() };
        arrival.events.fold = true;
        Ok(arrival)
    }

    /// Length of the trial's step along the tangent of its base.
    pub(super) fn trial_progress(&self) -> f64 {
        let base = self.state.history.base();
        progress(&self.weights, &base.tangent, &self.trial.node.point, &base.point)
    }

    fn check_fold_probe(&mut self, step: f64) -> Result<(), Doubt> {
        if self.probe.sign * self.state.orientation < 0.0 {
            return Err(Doubt::Reversed);
        }
        let changed = self.probe.signature != self.state.current.signature;
        if changed && step > self.settings.signature_step { Err(Doubt::Signature) } else { Ok(()) }
    }
}
