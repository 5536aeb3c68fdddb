//! Reading outputs inside a force step, at any time.

use super::{
    ExactIntegrator, collocation::NODES, drive::Jet, hole, lanes::vectorised, moments::Moments,
    recurrence::gauss_sixteen,
};
use crate::Law;

/// Radians of a block that sixteen Gauss points resolve, together with the polynomials of the step, to
/// rounding, and over which no term of the power series is larger than twice the impulse: what cancels is no
/// more than a few roundings.
const RADIANS: f64 = 2.0;

impl ExactIntegrator {
    /// Output and its derivatives at `time` after the start of the last solved step, which started from
    /// `state`.
    ///
    /// `r = r_particular + C exp(A t) x + int_0^t g(t - s) F(s) ds`, the integral by Gauss in the variable of
    /// the grading; `r''` has the term `C A B F(t)` besides.
    pub(super) fn jet_in_step(&self, state: &[f64], output: usize, time: f64) -> Jet {
        let (n, step, o) = (self.blocks.count(), &self.step, &self.outputs[output]);
        let mut jet = self.drive.jet(output, o, step.start + time);
        self.blocks.for_propagators(time, |i, propagator| {
            let (p, s) = propagator.apply(state[i], state[n + i]);
            jet.value += o.row[i] * p + o.row[n + i] * s;
            jet.slope += o.velocity_row[i] * p + o.velocity_row[n + i] * s;
            jet.curvature += o.acceleration_row[i] * p + o.acceleration_row[n + i] * s;
        });
        let end = step.grading().inverse((time / step.length).min(1.0));
        for (a, &element) in step.active.iter().enumerate() {
            let response = if step.length <= self.series.reach() {
                self.series.response(output, element, &self.moments_in_step(a, (0.0, time)))
            } else {
                self.response_in_long_step((output, element), a, time)
            };
            jet.value += response.value;
            jet.slope += response.slope;
            jet.curvature += response.curvature;
            jet.curvature += self.mobility[output][element] * step.interpolate(&step.force, a, end);
        }
        jet
    }

    /// The same of an element: of a hole its reading.
    pub(super) fn element_jet_in_step(&self, state: &[f64], element: usize, time: f64) -> Jet {
        let own = self.jet_in_step(state, element, time);
        match self.laws.get(element).and_then(Law::round_hole) {
            Some(hole) => hole::reading(hole, own, self.jet_in_step(state, element + 1, time)),
            None => own,
        }
    }

    /// Sixteen times of Gauss from one time in the last solved step to another: how long before the end they
    /// are, and the impulses of the a-th active element's force that they stand for.
    #[inline(always)]
    fn impulses_in_step(&self, a: usize, (from, to): (f64, f64)) -> ([f64; 16], [f64; 16]) {
        let step = &self.step;
        let (grading, length) = (step.grading(), step.length);
        let place = |time: f64| grading.inverse((time / length).clamp(0.0, 1.0));
        let (start, end) = (place(from), place(to));
        let (mut places, mut delays, mut impulses) = ([0.0; 16], [0.0; 16], [0.0; 16]);
        for (k, (x, weight)) in gauss_sixteen().iter().enumerate() {
            places[k] = start + (end - start) * x;
            let (c, slope) = grading.map(places[k]);
            delays[k] = to - c * length;
            impulses[k] = weight * (end - start) * slope * length;
        }
        let rule = grading.rule();
        let forces = rule.sums(&rule.expansion(&step.force[a * NODES..(a + 1) * NODES]), &places);
        (0..16).for_each(|k| impulses[k] *= forces[k]);
        (delays, impulses)
    }

    /// Moments of the a-th active element's force from one time in the last solved step to another.
    fn moments_in_step(&self, a: usize, (from, to): (f64, f64)) -> Moments {
        vectorised(
            #[inline(always)]
            || {
                let (delays, impulses) = self.impulses_in_step(a, (from, to));
                self.series.moments(&delays, impulses, to - from)
            },
        )
    }

    /// What the a-th active element's force has made of an output in a step beyond the reach of the series.
    fn response_in_long_step(&self, (output, element): (usize, usize), a: usize, time: f64) -> Jet {
        let (n, o, input) = (self.blocks.count(), &self.outputs[output], &self.inputs[element]);
        let (delays, impulses) = self.impulses_in_step(a, (0.0, time));
        let mut jet = Jet::default();
        for (delay, impulse) in delays.into_iter().zip(impulses) {
            self.blocks.for_propagators(delay, |i, propagator| {
                let (p, s) = propagator.apply(impulse * input[i], impulse * input[n + i]);
                jet.value += o.row[i] * p + o.row[n + i] * s;
                jet.slope += o.velocity_row[i] * p + o.velocity_row[n + i] * s;
                jet.curvature += o.acceleration_row[i] * p + o.acceleration_row[n + i] * s;
            });
        }
        jet
    }

    /// Takes the homogeneous block state from one time to a later one in the last solved step, forces
    /// included.
    ///
    /// `x(t) = exp(A (t - t_0)) x(t_0) + int exp(A (t - s)) B F(s) ds`, by Gauss in the variable of the
    /// grading over panels that resolve every block; there the integral is that of the power series.
    pub(super) fn carry_in_step(&self, state: &mut [f64], from: f64, to: f64) {
        let fastest = self.rates.iter().fold(0.0_f64, |fastest, rate| fastest.max(*rate));
        let panels = (fastest * (to - from) / RADIANS).ceil().max(1.0);
        for panel in 0..panels as usize {
            let at = |panel: usize| from + (to - from) * panel as f64 / panels;
            let (start, end) = (at(panel), at(panel + 1));
            self.blocks.carry(state, end - start);
            for (a, &element) in self.step.active.iter().enumerate() {
                self.series.add_response(element, &self.moments_in_step(a, (start, end)), state);
            }
        }
    }

    /// An output and its derivatives at `time` in the last solved step, from the homogeneous state then: with
    /// the direct part of the forces.
    pub(super) fn forced_jet(&self, state: &[f64], output: usize, time: f64) -> Jet {
        let step = &self.step;
        let mut jet = self.output_jet(state, output, step.start + time);
        let s = step.grading().inverse((time / step.length).clamp(0.0, 1.0));
        for (a, &element) in step.active.iter().enumerate() {
            jet.curvature += self.mobility[output][element] * step.interpolate(&step.force, a, s);
        }
        jet
    }

    /// The same of an element: of a hole its reading.
    pub(super) fn forced_element_jet(&self, state: &[f64], element: usize, time: f64) -> Jet {
        let own = self.forced_jet(state, element, time);
        match self.laws.get(element).and_then(Law::round_hole) {
            Some(hole) => hole::reading(hole, own, self.forced_jet(state, element + 1, time)),
            None => own,
        }
    }
}
