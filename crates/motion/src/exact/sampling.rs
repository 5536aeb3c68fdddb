//! Reading outputs inside a force step, at any time.

use super::{
    ExactIntegrator,
    block::Propagator,
    collocation::{NODES, gauss_sixteen},
    drive::Jet,
};

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
        let end = grading.inverse((time / step.weights.length).min(1.0));
        let forces = |s: f64| {
            let lagrange = rule.lagrange(s);
            let force = |a: usize| (0..NODES).map(|k| lagrange[k] * step.force[a * NODES + k]).sum::<f64>();
            (0..step.active.len()).map(force).collect::<Vec<f64>>()
        };
        for &(x, weight) in gauss_sixteen() {
            let (c, slope) = grading.map(end * x);
            let measure = weight * end * slope * step.weights.length;
            let delay = time - c * step.weights.length;
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
