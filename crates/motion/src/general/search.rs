//! The search of one step for the first zero of a switching function.
//!
//! The dense output is looked at with its slope at equidistant places, and in every dip between them
//! (`dip.rs`). It is a power of the step less accurate than the step itself: a flight or a contact may be
//! deeper than the error of the step and yet be missing in it, or be there alone. So in a dip that comes near
//! zero the sign at the lowest place is that of a step of the method itself to there, and the zero before it
//! that of the dense output moved to that value.

use super::{
    VectorField,
    dense::Dense,
    dip,
    stepper::Stepper,
    zero::{minimum, zero},
};

/// Parts of a step between samples.
const SAMPLES: usize = 16;
/// Share of what a switching function goes through in a step within which its dense output does not tell a
/// sign.
const NEAR: f64 = 1e-2;
/// Fraction of the step over which slopes are differences: an eighth of the distance of samples, so that they
/// have hardly more rounding than those have.
const NEARBY: f64 = 1.0 / 128.0;

/// Places and weights of the difference of fourth order.
const DIFFERENCES: [(f64, f64); 4] =
    [(-2.0, 1.0 / 12.0), (-1.0, -2.0 / 3.0), (1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0)];

/// What a step does about the boundaries of its region.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Verdict {
    /// It stays inside.
    Clear,
    /// It leaves first at this fraction of its length, through the zero of that switching function.
    Crossing { fraction: f64, switch: usize },
    /// It began on the boundary and is beyond it already at the first sample.
    TooLong { switch: usize },
}

impl Verdict {
    /// Of two switching functions.
    pub(super) fn or_earlier(self, other: Self) -> Self {
        match (self, other) {
            (Self::TooLong { .. }, _) | (_, Self::Clear) => self,
            (Self::Crossing { fraction: a, .. }, Self::Crossing { fraction: b, .. }) if a <= b => self,
            _ => other,
        }
    }
}

/// A step whose dense output is searched.
pub(super) struct Search<'a, F> {
    pub(super) field: &'a mut F,
    pub(super) stepper: &'a mut Stepper,
    pub(super) dense: &'a Dense,
    pub(super) inside: &'a [bool],
    pub(super) time: f64,
    pub(super) step: f64,
    pub(super) state: Vec<f64>,
    pub(super) values: Vec<f64>,
    /// Switching functions at the samples, one row each, and their slopes by the distance of samples.
    pub(super) samples: Vec<f64>,
    pub(super) slopes: Vec<f64>,
}

impl<F: VectorField> Search<'_, F> {
    /// Reads the dense output at the samples.
    pub(super) fn read(&mut self) {
        let switches = self.inside.len();
        self.samples.clear();
        self.slopes.clear();
        for k in 0..=SAMPLES {
            self.switching(fraction(k));
            self.samples.extend_from_slice(&self.values);
            self.slopes.resize((k + 1) * switches, 0.0);
            for (distance, weight) in DIFFERENCES {
                self.switching(fraction(k) + distance * NEARBY);
                let slopes = self.slopes[k * switches..].iter_mut().zip(&self.values);
                slopes.for_each(|(slope, value)| *slope += weight / (NEARBY * SAMPLES as f64) * value);
            }
        }
    }

    /// Writes the switching functions on the dense output.
    fn switching(&mut self, x: f64) {
        self.dense.state(x, &mut self.state);
        self.field.switching(self.time + x * self.step, &self.state, &mut self.values);
    }

    fn sign(&self, switch: usize) -> f64 {
        if self.inside[switch] { 1.0 } else { -1.0 }
    }

    /// Distance from the boundary on the dense output.
    fn distance(&mut self, switch: usize, x: f64) -> f64 {
        self.switching(x);
        self.sign(switch) * self.values[switch]
    }

    /// The same after a step of the method itself.
    fn exact_distance(&mut self, switch: usize, x: f64) -> f64 {
        let length = x * self.step;
        self.stepper.attempt_state(self.field, self.time, length, self.inside);
        self.field.switching(self.time + length, self.stepper.end_state(), &mut self.values);
        self.sign(switch) * self.values[switch]
    }

    /// The first zero of a switching function.
    ///
    /// * `fresh`: whether the step starts on it.
    pub(super) fn first_crossing(&mut self, switch: usize, fresh: bool) -> Verdict {
        let (sign, switches) = (self.sign(switch), self.inside.len());
        let row = |values: &[f64]| values.iter().skip(switch).step_by(switches).map(|x| sign * x).collect();
        let (samples, slopes): (Vec<f64>, Vec<f64>) = (row(&self.samples), row(&self.slopes));
        let spread = |of: fn(f64, f64) -> f64| samples.iter().copied().reduce(of).unwrap_or(0.0);
        let near = NEAR * (spread(f64::max) - spread(f64::min));
        let clear_start = samples[0] > 0.0 && !fresh;
        let dip = |k: usize| dip::between([samples[k], samples[k + 1]], [slopes[k], slopes[k + 1]]);
        // The last place that is inside, and the lowest value of the dense output that a step has shown to be
        // inside.
        let (mut last_inside, mut shown) = (0.0, 0.0);
        for k in 0..SAMPLES {
            if let Some(dip) = dip(k).filter(|dip| k > 0 || clear_start || dip.from > 0.0) {
                let [from, to] = [dip.from, dip.to].map(|part| fraction(k) + part * fraction(1));
                match self.dip(switch, (last_inside, from, to), near) {
                    Ok(lowest) => shown = f64::min(shown, lowest),
                    Err(None) => return Verdict::TooLong { switch },
                    Err(Some(fraction)) => return Verdict::Crossing { fraction, switch },
                }
            }
            let next = samples[k + 1];
            let decided_next = k + 1 < SAMPLES && -next < near && dip(k + 1).is_some();
            if next >= 0.0 {
                (last_inside, shown) = (fraction(k + 1), 0.0);
            } else if next < shown && !decided_next {
                if k == 0 && !clear_start {
                    return Verdict::TooLong { switch };
                }
                let fraction = zero(&mut |x| self.distance(switch, x), last_inside, fraction(k + 1));
                return Verdict::Crossing { fraction, switch };
            }
        }
        Verdict::Clear
    }

    /// Looks into a dip.
    ///
    /// * `(inside, from, to)`: a place that is inside, where the function falls, and where it has passed its
    ///   lowest place.
    ///
    /// # Returns
    /// Its lowest value on the dense output where it stays inside; else, as the error, where it leaves, or
    /// `None` where a shorter step has to tell.
    fn dip(
        &mut self,
        switch: usize,
        (inside, from, to): (f64, f64, f64),
        near: f64,
    ) -> Result<f64, Option<f64>> {
        let lowest = minimum(&mut |x| self.distance(switch, x), from, to);
        let value = self.distance(switch, lowest);
        let exact = if value.abs() < near { self.exact_distance(switch, lowest) } else { value };
        if exact >= 0.0 {
            return Ok(value);
        }
        let error = exact - value;
        let begin = [from, inside].into_iter().find(|&x| self.distance(switch, x) + error > 0.0);
        Err(begin.map(|begin| zero(&mut |x| self.distance(switch, x) + error, begin, lowest)))
    }
}

fn fraction(sample: usize) -> f64 {
    sample as f64 / SAMPLES as f64
}
