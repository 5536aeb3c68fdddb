//! Where a step leaves the smooth region in which it began.
//!
//! Between the ends of a step a switching function is followed on the dense output: with its slope at
//! equidistant samples, in the dips between them, and by bracketing of its first zero (`search.rs`). A touch
//! is missed only where the seventh-order polynomial has two more extrema between neighbouring samples than
//! the cubic of their values and slopes.

use super::{
    VectorField,
    dense::Dense,
    search::{Search, Verdict},
    stepper::Stepper,
};

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
