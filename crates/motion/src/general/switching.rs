//! Where a step leaves the smooth region in which it began.
//!
//! Between the ends of a step a switching function is followed on the dense output: with its slope at
//! equidistant samples, in the dips between them, and by bracketing of its first zero (`search.rs`). A touch
//! is missed only where the seventh-order polynomial has two more extrema between neighbouring samples than
//! the cubic of their values and slopes.

use super::{VectorField, dense::Dense, search::Search, stepper::Stepper};

/// Parts of a step between samples.
pub(super) const SAMPLES: usize = 16;

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
    fn or_earlier(self, other: Self) -> Self {
        match (self, other) {
            (Self::TooLong { .. }, _) | (_, Self::Clear) => self,
            (Self::Crossing { fraction: a, .. }, Self::Crossing { fraction: b, .. }) if a <= b => self,
            _ => other,
        }
    }
}

/// The region in which the motion is, and how it got there.
pub(super) struct Region {
    /// For each switching function whether it is positive.
    pub(super) inside: Vec<bool>,
    /// For each switching function whether its zero is the start of the step.
    fresh: Vec<bool>,
    /// When a boundary was crossed last.
    crossed_at: f64,
    first_steps: Vec<Option<f64>>,
    state: Vec<f64>,
    values: Vec<f64>,
    samples: Vec<f64>,
    slopes: Vec<f64>,
}

impl Region {
    pub(super) fn new(dimension: usize, switches: usize) -> Self {
        Self {
            inside: vec![false; switches],
            fresh: vec![false; switches],
            crossed_at: f64::NEG_INFINITY,
            first_steps: vec![None; 2 * switches],
            state: vec![0.0; dimension],
            values: vec![0.0; switches],
            samples: Vec::new(),
            slopes: Vec::new(),
        }
    }

    fn sign(&self, switch: usize) -> f64 {
        if self.inside[switch] { 1.0 } else { -1.0 }
    }

    /// Takes the region of a state; where a switching function is zero, that of a state a moment later
    /// counts.
    pub(super) fn locate(&mut self, field: &impl VectorField, time: f64, stepper: &Stepper, moment: f64) {
        let now = self.now_and_then(field, time, stepper, moment);
        for (switch, inside) in self.inside.iter_mut().enumerate() {
            *inside = if now[switch] == 0.0 { self.values[switch] > 0.0 } else { now[switch] > 0.0 };
        }
    }

    /// The switching functions of the state; those of a moment later stand in `values` then.
    fn now_and_then(
        &mut self,
        field: &impl VectorField,
        time: f64,
        stepper: &Stepper,
        moment: f64,
    ) -> Vec<f64> {
        field.switching(time, stepper.state(), &mut self.values);
        let now = self.values.clone();
        for (i, state) in self.state.iter_mut().enumerate() {
            *state = stepper.state()[i] + moment * stepper.slope(0)[i];
        }
        field.switching(time + moment, &self.state, &mut self.values);
        now
    }

    /// Whether the step starts on a boundary.
    pub(super) fn is_fresh(&self) -> bool {
        self.fresh.contains(&true)
    }

    /// Crosses the boundary, and all others that are reached within `moment` from now: stops that act
    /// together act at one instant up to rounding. Over a moment rounding may be more than a slow switching
    /// function changes, and would send it back through the boundary that it has just crossed, again and
    /// again; so what it is a moment later follows from its rate, a difference over the longer `span`.
    /// Boundaries that are crossed one after the other at one time all stay the start of the next step.
    ///
    /// Returns a good length of the first step, if there was such a crossing before.
    pub(super) fn cross(
        &mut self,
        field: &impl VectorField,
        stepper: &Stepper,
        (time, moment, span): (f64, f64, f64),
        switch: usize,
    ) -> Option<f64> {
        let now = self.now_and_then(field, time, stepper, span);
        if time > self.crossed_at {
            self.fresh.fill(false);
        }
        self.crossed_at = time;
        let mut first_step: Option<f64> = None;
        for other in 0..self.inside.len() {
            let sign = self.sign(other);
            let change = sign * (self.values[other] - now[other]) * (moment / span);
            let meets = change < 0.0 && sign * now[other] + change < 0.0;
            if other == switch || meets {
                self.inside[other] = !self.inside[other];
                self.fresh[other] = true;
                let known = self.first_steps[2 * other + usize::from(self.inside[other])];
                first_step = first_step.into_iter().chain(known).reduce(f64::min);
            }
        }
        first_step
    }

    /// Tells that a step was accepted which had better been of that length.
    pub(super) fn moved(&mut self, best: f64) {
        for switch in 0..self.inside.len() {
            if std::mem::take(&mut self.fresh[switch]) {
                self.first_steps[2 * switch + usize::from(self.inside[switch])] = Some(best);
            }
        }
    }

    /// Whether a boundary is near: nearer than half of the way which the switching function goes over the
    /// stages.
    pub(super) fn near_boundary(&mut self, field: &impl VectorField, stepper: &Stepper, end: f64) -> bool {
        let switches = self.inside.len();
        field.switching(end, stepper.end_state(), &mut self.values);
        (0..switches).any(|switch| {
            let stages = stepper.switching.iter().skip(switch).step_by(switches);
            let distances = stages.chain([&self.values[switch]]).map(|value| self.sign(switch) * value);
            let (lowest, highest) = distances
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (x.min(low), x.max(high)));
            lowest < 0.5 * (highest - lowest)
        })
    }

    /// Value of a switching function.
    pub(super) fn value(&mut self, field: &impl VectorField, switch: usize, time: f64, state: &[f64]) -> f64 {
        field.switching(time, state, &mut self.values);
        self.values[switch]
    }

    /// Rate of a switching function on the dense output, per unit of time.
    pub(super) fn rate(
        &mut self,
        field: &impl VectorField,
        dense: &Dense,
        (time, step): (f64, f64),
        fraction: f64,
        switch: usize,
    ) -> f64 {
        const NEARBY: f64 = 1e-4;
        let [before, after] = [fraction - NEARBY, fraction + NEARBY].map(|x| {
            dense.state(x, &mut self.state);
            field.switching(time + x * step, &self.state, &mut self.values);
            self.values[switch]
        });
        (after - before) / (2.0 * NEARBY * step)
    }

    /// Finds the first crossing of a boundary in a step.
    pub(super) fn inspect<F: VectorField>(
        &mut self,
        field: &mut F,
        (stepper, dense): (&mut Stepper, &Dense),
        (time, step): (f64, f64),
    ) -> Verdict {
        let mut search = Search {
            field,
            stepper,
            dense,
            inside: &self.inside,
            time,
            step,
            state: std::mem::take(&mut self.state),
            values: std::mem::take(&mut self.values),
            samples: std::mem::take(&mut self.samples),
            slopes: std::mem::take(&mut self.slopes),
        };
        search.read();
        let mut first = Verdict::Clear;
        for (switch, &fresh) in self.fresh.iter().enumerate() {
            let found = search.first_crossing(switch, fresh);
            first = first.or_earlier(found);
        }
        let Search { state, values, samples, slopes, .. } = search;
        (self.state, self.values, self.samples, self.slopes) = (state, values, samples, slopes);
        first
    }
}

pub(super) fn fraction(sample: usize) -> f64 {
    sample as f64 / SAMPLES as f64
}

/// Zero of a function that is not negative at `low` and negative at `high`, by the Illinois method.
pub(super) fn zero(function: &mut impl FnMut(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut at_low, mut at_high) = (function(low), function(high));
    let mut kept = 0;
    for _ in 0..60 {
        let x = (low * at_high - high * at_low) / (at_high - at_low);
        if !(x > low && x < high) || high - low < 1e-15 {
            break;
        }
        let at_x = function(x);
        if at_x >= 0.0 {
            (low, at_low) = (x, at_x);
            if kept == 1 {
                at_high *= 0.5;
            }
            kept = 1;
        } else {
            (high, at_high) = (x, at_x);
            if kept == -1 {
                at_low *= 0.5;
            }
            kept = -1;
        }
    }
    if at_low.abs() <= at_high.abs() { low } else { high }
}

/// Place of the lowest value between two places, by golden section.
pub(super) fn minimum(function: &mut impl FnMut(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let (mut a, mut b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_a, mut at_b) = (function(a), function(b));
    while high - low > 1e-8 {
        if at_a < at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - GOLDEN * (high - low);
            at_a = function(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + GOLDEN * (high - low);
            at_b = function(b);
        }
    }
    if at_a < at_b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_are_bracketed_to_rounding() {
        let x = zero(&mut |x| 0.25 - x * x * x, 0.0, 1.0);
        assert!((x - 0.25_f64.cbrt()).abs() < 1e-14);
    }

    #[test]
    fn minima_are_found_to_half_the_digits() {
        let x = minimum(&mut |x| (x - 0.3_f64).powi(2) - 1e-9, 0.0, 1.0);
        assert!((x - 0.3).abs() < 1e-7);
    }
}
