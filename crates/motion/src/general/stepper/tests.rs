//! The order of the step and of its dense output.

use super::*;
use crate::general::dense::Dense;

/// `z' = -2 t z^2 p`, with the solution `1 / (1 / z_0 + p t^2)`, `p = 1`.
struct Witch;

impl VectorField for Witch {
    fn dimension(&self) -> usize {
        1
    }

    fn evaluate(&mut self, at: Point<'_>, derivative: &mut [f64]) {
        derivative[0] = -2.0 * at.time * at.state[0] * at.state[0];
    }

    fn tangents(&mut self, at: Point<'_>, columns: &[f64], derivatives: &mut [f64]) {
        for (column, derivative) in columns.iter().zip(derivatives) {
            *derivative = -4.0 * at.time * at.state[0] * column;
        }
    }

    fn add_by_parameter(&mut self, _: Point<'_>, derivative: &[f64], sum: &mut [f64]) {
        sum[0] += derivative[0];
    }
}

/// Errors of state, derivative by the state and by the parameter at t = 1, after equal steps from z(0) = 1.
fn errors(steps: usize) -> [f64; 3] {
    let mut stepper = Stepper::new(&Witch, &[1.0], true);
    let step = 1.0 / steps as f64;
    for k in 0..steps {
        let time = k as f64 * step;
        stepper.start(&mut Witch, time, &[]);
        stepper.attempt(&mut Witch, time, step, &[]);
        stepper.finish(&mut Witch, time + step, &[]);
        stepper.accept(&Witch);
    }
    let value = &stepper.value;
    [value[0] - 0.5, value[1] - 0.25, value[2] + 0.25].map(f64::abs)
}

fn slope(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).log2()
}

#[test]
fn state_and_sensitivities_converge_with_order_eight() {
    let (coarse, fine) = (errors(4), errors(8));
    for i in 0..3 {
        let order = slope(coarse[i], fine[i]);
        assert!((7.4..9.6).contains(&order), "column {i}: order {order}, {coarse:?} {fine:?}");
    }
}

#[test]
fn dense_output_converges_with_order_seven_or_better() {
    let error = |step: f64| {
        let mut stepper = Stepper::new(&Witch, &[0.5], false);
        stepper.start(&mut Witch, 1.0, &[]);
        stepper.attempt(&mut Witch, 1.0, step, &[]);
        stepper.densify(&mut Witch, 1.0, step, &[], false);
        let mut dense = Dense::new(1);
        dense.load(&stepper, step);
        let mut state = [0.0];
        let mut worst = 0.0_f64;
        for k in 0..=20 {
            let x = f64::from(k) / 20.0;
            dense.state(x, &mut state);
            worst = worst.max((state[0] - 1.0 / (1.0 + (1.0 + x * step).powi(2))).abs());
        }
        worst
    };
    let order = slope(error(0.5), error(0.25));
    assert!(order > 7.0, "local order {order}, {:e} {:e}", error(0.5), error(0.25));
}

#[test]
fn the_error_estimate_bounds_the_error_of_a_step() {
    let mut stepper = Stepper::new(&Witch, &[1.0], false);
    stepper.start(&mut Witch, 0.0, &[]);
    stepper.attempt(&mut Witch, 0.0, 0.4, &[]);
    let estimate = stepper.error(0.4, 1.0);
    let error = (stepper.end_state()[0] - 1.0 / 1.16).abs();
    assert!(error < estimate && estimate < 1e5 * error, "{error:e} against {estimate:e}");
}
