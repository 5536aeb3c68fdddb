//! The place of a zero between two points of the path, by few probes.
//!
//! A probe costs what a point costs, so places are guessed as well as what is known allows: by the inverse
//! polynomial through up to four values (order of convergence up to 1.93), and where that leaves the bracket
//! or did not help last time, by the Illinois variant of regula falsi, which always converges.
//!
//! # Source
//! Dowell and Jarratt, BIT 11 (1971), 168-174; inverse interpolation: Brent, *Algorithms for Minimization
//! without Derivatives* (1973), chapter 4.

use super::Follower;
use crate::{
    corrector::{Candidate, Limits},
    error::Doubt,
    predictor,
    problem::PathProblem,
    product::progress,
};

/// Values that the inverse polynomial goes through.
const MOST_KNOWN: usize = 4;
/// A probe may be as far off the path as this share of the bracket, as long as the sign of its value is
/// beyond doubt.
const LOOSE: f64 = 1e-4;
/// The sign is beyond doubt if the value is so many times what the correction still due may change of it.
const BEYOND_DOUBT: f64 = 20.0;
/// A probe this near an end of the step, as a share of it, does not sharpen the prediction of the next one.
const NEAR_END: f64 = 1e-3;

/// Bracket of a zero.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bracket {
    low: (f64, f64),
    high: (f64, f64),
    side: i32,
    /// Places and values, the newest last.
    known: Vec<(f64, f64)>,
    /// The last probe did not halve the least value.
    disappointed: bool,
}

impl Bracket {
    /// The values at the ends differ in sign.
    pub fn new(low: (f64, f64), high: (f64, f64)) -> Self {
        Self { low, high, side: 0, known: vec![low, high], disappointed: false }
    }

    pub fn width(&self) -> f64 {
        self.high.0 - self.low.0
    }

    /// Secant slope, in magnitude.
    fn slope(&self) -> f64 {
        (self.high.1 - self.low.1).abs() / self.width().max(f64::MIN_POSITIVE)
    }

    /// How far the zero can be from a place with this value: by the secant slope, but no further than the
    /// bracket reaches.
    pub fn uncertainty(&self, value: f64) -> f64 {
        (value.abs() / self.slope().max(f64::MIN_POSITIVE)).min(self.width())
    }

    /// The place of the newest probe.
    pub fn newest(&self) -> f64 {
        self.known[self.known.len() - 1].0
    }

    pub fn next(&self) -> f64 {
        let inverse = at_zero(&self.known);
        if self.known.len() > 2 && !self.disappointed && self.low.0 < inverse && inverse < self.high.0 {
            return inverse;
        }
        let share = self.low.1 / (self.low.1 - self.high.1);
        self.low.0 + self.width() * share.clamp(1e-3, 0.999)
    }

    pub fn narrow(&mut self, place: f64, value: f64) {
        let least = self.known.iter().map(|(_, value)| value.abs()).fold(f64::INFINITY, f64::min);
        self.disappointed = value.abs() > 0.5 * least;
        if self.known.len() == MOST_KNOWN {
            self.known.remove(0);
        }
        self.known.push((place, value));
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

/// Place where the polynomial of the place over the value is met at zero.
pub(super) fn at_zero(known: &[(f64, f64)]) -> f64 {
    let weight = |i: usize| -> f64 {
        let others = known.iter().enumerate().filter(|(j, _)| *j != i);
        others.map(|(_, (_, value))| -value / (known[i].1 - value)).product()
    };
    known.iter().enumerate().map(|(i, (place, _))| weight(i) * place).sum()
}

impl Follower {
    /// Puts the probe on the path at this place of the step to the trial, as sharply as the sign of its value
    /// needs; `None` from `value` is a zero that cannot be looked for.
    ///
    /// * `reached`: magnitude of the value at which the zero counts as reached; such a probe is sharp.
    /// * `goes_on`: the probe before was one for the same zero; it sharpens the prediction.
    pub(super) fn probe_toward_zero<P: PathProblem + ?Sized>(
        &mut self,
        problem: &mut P,
        step: f64,
        (bracket, reached): (&Bracket, f64),
        (place, goes_on): (f64, bool),
        mut value: impl FnMut(&mut Candidate, &mut P) -> Option<f64>,
    ) -> Result<f64, Doubt> {
        self.predict_probe(place, goes_on);
        let sharp = self.probing_limits(step);
        let loose = Limits { tolerance: sharp.tolerance.max(LOOSE * bracket.width()), ..sharp };
        self.correct_probe(problem, loose)?;
        let mut found = value(&mut self.probe, problem).ok_or(Doubt::NotLocated)?;
        let due = self.probe.correction_norm;
        let in_doubt = bracket.slope() * (BEYOND_DOUBT * due).max(self.settings.correction_floor);
        if due > sharp.tolerance && found.abs() <= in_doubt.max(reached) {
            let (moved, iterations) = (self.probe.displacement + due, self.probe.iterations);
            self.probe.point.copy_from_slice(&self.probe.node.point);
            self.correct_probe(problem, sharp)?;
            self.probe.displacement += moved;
            self.probe.iterations += iterations;
            found = value(&mut self.probe, problem).ok_or(Doubt::NotLocated)?;
        }
        self.best.node.copy_from(&self.probe.node);
        Ok(found)
    }

    /// Predicts the probe at `σ` of the step by the polynomial through both ends, and through the best probe
    /// so far if there is one (`goes_on`).
    pub(super) fn predict_probe(&mut self, place: f64, goes_on: bool) {
        let (weights, base, trial) = (&self.weights, self.state.history.base(), &self.trial.node);
        let of = |point: &[f64]| progress(weights, &base.tangent, point, &base.point);
        let (length, last) = (of(&trial.point), of(&self.best.node.point));
        let out = &mut self.probe.point;
        if goes_on && last > NEAR_END * length && length - last > NEAR_END * length {
            predictor::hermite(weights, base, [trial, &self.best.node], place, out);
        } else {
            predictor::hermite(weights, base, [trial], place, out);
        }
    }

    /// Corrects the probe in the plane across the tangent at the start of the step.
    pub(super) fn correct_probe(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        limits: Limits,
    ) -> Result<(), Doubt> {
        self.probe
            .correct(problem, &self.weights, &self.row, limits, &mut self.state.counters)
            .map_err(Doubt::Corrector)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_met_exactly() {
        let cubic = |x: f64| 0.3 - 2.0 * x + 0.7 * x * x - x * x * x;
        let pairs = [1.0, 0.4, -0.6, -1.5].map(|x| (cubic(x), x));
        assert!((at_zero(&pairs) - 0.3).abs() < 1e-14);
    }

    fn probes(function: impl Fn(f64) -> f64, accuracy: f64) -> u32 {
        let mut bracket = Bracket::new((0.0, function(0.0)), (1.0, function(1.0)));
        for probe in 1..=60 {
            let place = bracket.next();
            assert!((0.0..=1.0).contains(&place));
            let value = function(place);
            bracket.narrow(place, value);
            if value.abs() <= accuracy {
                return probe;
            }
        }
        panic!("not found");
    }

    /// Smooth functions take few probes; powers far from linear ones more, and no function all of them.
    #[test]
    fn zeros_take_few_probes() {
        assert_eq!(probes(|x| 0.3 - x, 1e-12), 1);
        assert!(probes(|x| (0.5 - x).sinh(), 1e-12) <= 4);
        assert!(probes(|x| 1.0 - (1.0 + 2.0 * x).ln() * 1.4, 1e-12) <= 5);
        assert!(probes(|x| 0.01 - x * x, 1e-12) <= 10);
        assert!(probes(|x| (0.2 - x).cbrt(), 1e-6) <= 40);
    }

    /// A jump is bracketed as narrowly as is asked for.
    #[test]
    fn a_jump_is_bracketed() {
        let mut bracket = Bracket::new((0.0, 1.0), (1.0, -1.0));
        for _ in 0..40 {
            let place = bracket.next();
            bracket.narrow(place, if place < 0.37 { 1.0 } else { -1.0 });
        }
        assert!(bracket.width() < 1e-9);
    }
}
