//! Reading outputs inside a force step, at any time.

use super::{
    ExactIntegrator, block::Propagator, collocation::NODES, drive::Jet, lanes::dot, recurrence::gauss_sixteen,
};

/// Radians of a block that sixteen Gauss points resolve, together with the polynomials of the step, to rounding.
const RADIANS: f64 = 4.0;

impl ExactIntegrator {
    /// Output and its derivatives at `time` after the start of the last solved step, which started from `state`.
    ///
    /// `r = r_particular + C exp(A t) x + int_0^t g(t - s) F(s) ds`, the integral by Gauss in the variable of the grading;
    /// `r''` has the term `C A B F(t)` besides.
    pub(super) fn jet_in_step(&self, state: &[f64], output: usize, time: f64) -> Jet {
        let (n, step, o) = (self.blocks.count(), &self.step, &self.outputs[output]);
        let mut jet = self.drive.jet(output, o, step.start + time);
        for i in 0..n {
            let propagator = Propagator::new(self.blocks.stiffness[i], self.blocks.damping[i], time);
            let (p, s) = propagator.apply(state[i], state[n + i]);
            jet.value += o.row[i] * p + o.row[n + i] * s;
            jet.slope += o.velocity_row[i] * p + o.velocity_row[n + i] * s;
            jet.curvature += o.acceleration_row[i] * p + o.acceleration_row[n + i] * s;
        }
        let grading = step.grading();
        let rule = grading.rule();
        let end = grading.inverse((time / step.length).min(1.0));
        let forces = |s: f64| {
            let lagrange = rule.lagrange(s);
            let force = |a: usize| (0..NODES).map(|k| lagrange[k] * step.force[a * NODES + k]).sum::<f64>();
            (0..step.active.len()).map(force).collect::<Vec<f64>>()
        };
        for &(x, weight) in gauss_sixteen() {
            let (c, slope) = grading.map(end * x);
            let measure = weight * end * slope * step.length;
            let delay = time - c * step.length;
            for (force, &element) in forces(end * x).into_iter().zip(&step.active) {
                let response = |derivative| self.impulse_response(output, element, derivative, delay);
                jet.value += measure * force * response(0);
                jet.slope += measure * force * response(1);
                jet.curvature += measure * force * response(2);
            }
        }
        for (force, &element) in forces(end).into_iter().zip(&step.active) {
            jet.curvature += self.mobility[output][element] * force;
        }
        jet
    }

    /// Takes the homogeneous block state from one time to a later one in the last solved step, forces included.
    ///
    /// `x(t) = exp(A (t - t_0)) x(t_0) + int exp(A (t - s)) B F(s) ds`, by Gauss in the variable of the grading over panels that resolve every block.
    pub(super) fn carry_in_step(&self, state: &mut [f64], from: f64, to: f64) {
        let step = &self.step;
        let (grading, length) = (step.grading(), step.length);
        let fastest = self.rates.iter().fold(0.0_f64, |fastest, rate| fastest.max(*rate));
        let panels = (fastest * (to - from) / RADIANS).ceil().max(1.0);
        let place = |time: f64| grading.inverse((time / length).clamp(0.0, 1.0));
        for panel in 0..panels as usize {
            let at = |panel: usize| from + (to - from) * panel as f64 / panels;
            let (start, end) = (at(panel), at(panel + 1));
            self.propagate(state, end - start);
            let (s_start, s_end) = (place(start), place(end));
            for &(x, weight) in gauss_sixteen() {
                let s = s_start + (s_end - s_start) * x;
                let (c, slope) = grading.map(s);
                let measure = weight * (s_end - s_start) * slope * length;
                let lagrange = grading.rule().lagrange(s);
                for (a, &element) in step.active.iter().enumerate() {
                    let force = dot(&lagrange, &step.force[a * NODES..(a + 1) * NODES]);
                    self.add_impulse(state, element, measure * force, end - c * length);
                }
            }
        }
    }

    /// Propagates the homogeneous block state over `time`.
    fn propagate(&self, state: &mut [f64], time: f64) {
        let n = self.blocks.count();
        for i in 0..n {
            let propagator = Propagator::new(self.blocks.stiffness[i], self.blocks.damping[i], time);
            (state[i], state[n + i]) = propagator.apply(state[i], state[n + i]);
        }
    }

    /// Adds what an impulse on an element has become after `time`.
    fn add_impulse(&self, state: &mut [f64], element: usize, impulse: f64, time: f64) {
        let (n, input) = (self.blocks.count(), &self.inputs[element]);
        for i in 0..n {
            let propagator = Propagator::new(self.blocks.stiffness[i], self.blocks.damping[i], time);
            let (p, s) = propagator.apply(input[i], input[n + i]);
            state[i] += impulse * p;
            state[n + i] += impulse * s;
        }
    }

    /// An output and its derivatives at `time` in the last solved step, from the homogeneous state then: with the direct part of the forces.
    pub(super) fn forced_jet(&self, state: &[f64], output: usize, time: f64) -> Jet {
        let step = &self.step;
        let mut jet = self.output_jet(state, output, step.start + time);
        let s = step.grading().inverse((time / step.length).clamp(0.0, 1.0));
        for (a, &element) in step.active.iter().enumerate() {
            jet.curvature += self.mobility[output][element] * step.interpolate(&step.force, a, s);
        }
        jet
    }

    /// Impulse response of an output to an element's force, and its derivatives by time.
    fn impulse_response(&self, output: usize, element: usize, derivative: usize, time: f64) -> f64 {
        if time <= self.series.reach() {
            return self.series.impulse_response(output, element, derivative, time);
        }
        let (n, o, input) = (self.blocks.count(), &self.outputs[output], &self.inputs[element]);
        let row = [&o.row, &o.velocity_row, &o.acceleration_row][derivative];
        let of_block = |i: usize| {
            let propagator = Propagator::new(self.blocks.stiffness[i], self.blocks.damping[i], time);
            let (p, s) = propagator.apply(input[i], input[n + i]);
            row[i] * p + row[n + i] * s
        };
        (0..n).map(of_block).sum()
    }
}
