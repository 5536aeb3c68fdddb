//! Locating a fold: the zero of `t_λ` on the way to the trial.

use super::{Arrival, Follower};
use crate::{error::Doubt, problem::PathProblem, product::progress};

/// Enough for bisection to reach rounding, were it needed.
const MOST_PROBES: u32 = 60;

/// Bracket of a zero, narrowed by the Illinois variant of regula falsi.
///
/// # Source
/// Dowell and Jarratt, BIT 11 (1971), 168-174.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bracket {
    low: (f64, f64),
    high: (f64, f64),
    side: i32,
}

impl Bracket {
    /// The values at the ends differ in sign.
    pub fn new(low: (f64, f64), high: (f64, f64)) -> Self {
        Self { low, high, side: 0 }
    }

    pub fn width(&self) -> f64 {
        self.high.0 - self.low.0
    }

    /// How far the zero can be from a place with this value: by the secant slope, but no further than the bracket reaches.
    pub fn uncertainty(&self, value: f64) -> f64 {
        let slope = (self.high.1 - self.low.1).abs() / self.width().max(f64::MIN_POSITIVE);
        (value.abs() / slope.max(f64::MIN_POSITIVE)).min(self.width())
    }

    pub fn next(&self) -> f64 {
        let share = self.low.1 / (self.low.1 - self.high.1);
        self.low.0 + self.width() * share.clamp(1e-3, 0.999)
    }

    pub fn narrow(&mut self, place: f64, value: f64) {
        if value * self.high.1 > 0.0 {
            self.high = (place, value);
            if self.side == 1 {
                self.low.1 *= 0.5;
            }
            self.side = 1;
        } else {
            self.low = (place, value);
            if self.side == -1 {
                self.high.1 *= 0.5;
            }
            self.side = -1;
        }
    }
}

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
        for _ in 0..MOST_PROBES {
            self.probe_between(problem, step, sigma)?;
            self.check_fold_probe(step)?;
            let value = self.probe.tangent_parameter();
            bracket.narrow(sigma, value);
            if value.abs() <= self.settings.fold_tolerance
                || bracket.width() <= self.settings.correction_floor
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
