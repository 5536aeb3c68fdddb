//! The general integrator on fields that are no mechanical systems.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use faer::Mat;
use hammerbeam_motion::general::{
    GeneralError, GeneralSettings, Point, VectorField, integrate, sample_field,
};

/// Lorenz: `x' = sigma (y - x)`, `y' = x (rho - z) - y`, `z' = x y - beta z`; the parameter is rho.
struct Lorenz {
    rho: f64,
}

const SIGMA: f64 = 10.0;
const BETA: f64 = 8.0 / 3.0;

impl VectorField for Lorenz {
    fn dimension(&self) -> usize {
        3
    }

    fn evaluate(&mut self, at: Point<'_>, derivative: &mut [f64]) {
        let &[x, y, z] = at.state else { return };
        derivative.copy_from_slice(&[SIGMA * (y - x), x * (self.rho - z) - y, x * y - BETA * z]);
    }

    fn tangents(&mut self, at: Point<'_>, columns: &[f64], derivatives: &mut [f64]) {
        let &[x, y, z] = at.state else { return };
        for (c, d) in columns.chunks_exact(3).zip(derivatives.chunks_exact_mut(3)) {
            d[0] = SIGMA * (c[1] - c[0]);
            d[1] = c[0] * (self.rho - z) - x * c[2] - c[1];
            d[2] = c[0] * y + x * c[1] - BETA * c[2];
        }
    }

    fn add_by_parameter(&mut self, at: Point<'_>, _: &[f64], sum: &mut [f64]) {
        sum[1] += at.state[0];
    }
}

/// A field whose derivative jumps: `x' = 1`, `y' = a |x|`; the parameter is a.
struct Kink {
    a: f64,
}

impl VectorField for Kink {
    fn dimension(&self) -> usize {
        2
    }

    fn evaluate(&mut self, at: Point<'_>, derivative: &mut [f64]) {
        let sign = if at.inside[0] { 1.0 } else { -1.0 };
        derivative.copy_from_slice(&[1.0, self.a * sign * at.state[0]]);
    }

    fn tangents(&mut self, at: Point<'_>, columns: &[f64], derivatives: &mut [f64]) {
        let sign = if at.inside[0] { 1.0 } else { -1.0 };
        for (c, d) in columns.chunks_exact(2).zip(derivatives.chunks_exact_mut(2)) {
            d.copy_from_slice(&[0.0, self.a * sign * c[0]]);
        }
    }

    fn add_by_parameter(&mut self, _: Point<'_>, derivative: &[f64], sum: &mut [f64]) {
        sum[1] += derivative[1] / self.a;
    }

    fn switches(&self) -> usize {
        1
    }

    fn switching(&self, _: f64, state: &[f64], values: &mut [f64]) {
        values[0] = state[0];
    }
}

/// `x' = x^2`, which is infinite at t = 1 / x(0).
struct RunAway;

impl VectorField for RunAway {
    fn dimension(&self) -> usize {
        1
    }

    fn evaluate(&mut self, at: Point<'_>, derivative: &mut [f64]) {
        derivative[0] = at.state[0] * at.state[0];
    }

    fn tangents(&mut self, at: Point<'_>, columns: &[f64], derivatives: &mut [f64]) {
        for (column, derivative) in columns.iter().zip(derivatives) {
            *derivative = 2.0 * at.state[0] * column;
        }
    }
}

fn lorenz_end(rho: f64, state: [f64; 3]) -> Vec<f64> {
    let settings = GeneralSettings::with_tolerance(1e-13).state_only();
    integrate(&mut Lorenz { rho }, 0.0, 2.0, &state, &settings).unwrap().state
}

/// Trace of the Jacobian: `-(sigma + 1 + beta)`; the smallest singular value of the flow is near 1e-5.
#[test]
fn volumes_of_lorenz_shrink_at_a_constant_rate() {
    let settings = GeneralSettings::with_tolerance(1e-13);
    let flow = integrate(&mut Lorenz { rho: 28.0 }, 0.0, 0.8, &[1.0, 2.0, 20.0], &settings).unwrap();
    let determinant = flow.by_state.determinant();
    let expected = (-0.8 * (SIGMA + 1.0 + BETA)).exp();
    assert!((determinant / expected - 1.0).abs() < 1e-6, "{determinant:e} against {expected:e}");
}

#[test]
fn sensitivities_of_lorenz_agree_with_differences() {
    let state = [1.0, 2.0, 20.0];
    let settings = GeneralSettings::with_tolerance(1e-12);
    let flow = integrate(&mut Lorenz { rho: 28.0 }, 0.0, 2.0, &state, &settings).unwrap();
    let close = |found: f64, above: f64, below: f64, step: f64| {
        let difference = (above - below) / (2.0 * step);
        assert!(
            (found - difference).abs() < 1e-5 * difference.abs().max(1.0),
            "{found} against {difference}"
        );
    };
    for j in 0..3 {
        let moved = |step: f64| {
            let mut state = state;
            state[j] += step;
            lorenz_end(28.0, state)
        };
        let (above, below) = (moved(1e-5), moved(-1e-5));
        (0..3).for_each(|i| close(flow.by_state[(i, j)], above[i], below[i], 1e-5));
    }
    let (above, below) = (lorenz_end(28.0 + 1e-5, state), lorenz_end(28.0 - 1e-5, state));
    (0..3).for_each(|i| close(flow.by_parameter[i], above[i], below[i], 1e-5));
}

/// `y(t) = a (x_0^2 + x(t)^2) / 2` once x has changed its sign.
#[test]
fn a_kink_is_met_exactly() {
    let flow = integrate(&mut Kink { a: 3.0 }, 0.0, 2.0, &[-0.7, 0.0], &GeneralSettings::default()).unwrap();
    assert_eq!(flow.counts.crossings, 1);
    let exact = Mat::from_fn(2, 2, |i, j| [[1.0, 0.0], [1.5 * 2.0 * (-0.7 + 1.3), 1.0]][i][j]);
    assert!((flow.state[1] - 1.5 * (0.49 + 1.69)).abs() < 1e-13, "{:?}", flow.state);
    assert!((flow.by_state - exact).norm_max() < 1e-12);
    assert!((flow.by_parameter[1] - 0.5 * (0.49 + 1.69)).abs() < 1e-13);
}

#[test]
fn work_is_the_same_in_every_run() {
    let run = || {
        let flow =
            integrate(&mut Lorenz { rho: 28.0 }, 0.0, 2.0, &[1.0, 2.0, 20.0], &GeneralSettings::default());
        let flow = flow.unwrap();
        (flow.state, flow.counts)
    };
    assert_eq!(run(), run());
}

#[test]
fn samples_include_both_ends() {
    let state = [1.0, 2.0, 20.0];
    let times = [0.0, 0.0, 0.3, 2.0];
    let settings = GeneralSettings::with_tolerance(1e-13);
    let states = sample_field(&mut Lorenz { rho: 28.0 }, (0.0, 2.0), &state, &times, &settings).unwrap();
    assert_eq!(states.len(), 4);
    assert_eq!(states[1], state);
    assert_eq!(states[3], lorenz_end(28.0, state));
}

#[test]
fn a_motion_that_runs_away_is_reported() {
    let found = integrate(&mut RunAway, 0.0, 2.0, &[1.0], &GeneralSettings::default()).unwrap_err();
    let at = match found {
        GeneralError::StepTooSmall { time, .. } | GeneralError::NotFinite { time } => time,
        _ => panic!("{found}"),
    };
    assert!((at - 1.0).abs() < 1e-6, "{at}");
}

#[test]
fn too_small_a_budget_of_steps_is_reported() {
    let settings = GeneralSettings { max_steps: 5, ..GeneralSettings::default() };
    let found = integrate(&mut Lorenz { rho: 28.0 }, 0.0, 2.0, &[1.0, 2.0, 20.0], &settings).unwrap_err();
    assert!(matches!(found, GeneralError::TooManySteps { steps: 5, time } if time < 2.0), "{found}");
}

#[test]
fn wrong_input_is_named() {
    let settings = GeneralSettings::default();
    let run = |start: f64, end: f64, state: &[f64], settings: &GeneralSettings| {
        integrate(&mut Lorenz { rho: 28.0 }, start, end, state, settings).unwrap_err().to_string()
    };
    assert_eq!(run(0.0, 1.0, &[1.0], &settings), "the state has 1 entries, the field has 3");
    assert_eq!(run(0.0, 1.0, &[1.0, f64::NAN, 0.0], &settings), "the state is NaN, must be finite");
    assert_eq!(run(1.0, 0.0, &[0.0; 3], &settings), "the end is 0, must be finite and not before the start");
    let loose = GeneralSettings::with_tolerance(0.5);
    assert_eq!(run(0.0, 1.0, &[0.0; 3], &loose), "tolerance is 5e-1, must lie between 1e-14 and 1e-2");
    let still = GeneralSettings { first_step: Some(0.0), ..settings };
    assert_eq!(run(0.0, 1.0, &[0.0; 3], &still), "the first step is 0, must be finite and positive");
}

#[test]
fn a_stretch_of_no_length_changes_nothing() {
    let flow = integrate(&mut Kink { a: 3.0 }, 1.0, 1.0, &[0.4, 0.2], &GeneralSettings::default()).unwrap();
    assert_eq!(flow.state, [0.4, 0.2]);
    assert!((flow.by_state - Mat::<f64>::identity(2, 2)).norm_max() == 0.0);
}
