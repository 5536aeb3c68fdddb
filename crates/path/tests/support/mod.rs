//! Problems with known paths, and what the tests ask of a followed branch.
#![allow(
    dead_code,
    unused_macros,
    clippy::unwrap_used,
    reason = "each test file uses a part, and tests may panic"
)]

use hammerbeam_path::{
    Branch, ContinuationPoint, DenseProblem, ParameterRange, PathProblem, PathStop, Settings, StartDirection,
    follow,
};

/// What a problem leaves to the one in its field: all that has no default, or all but `evaluate`. It is
/// its own judge.
macro_rules! left_to {
    ($inner:tt) => {
        left_to!($inner but evaluate);
        fn evaluate(&mut self, point: &[f64]) -> Result<(), hammerbeam_path::EvaluationError> {
            self.$inner.evaluate(point)
        }
    };
    ($inner:tt but evaluate) => {
        fn unknowns(&self) -> usize {
            self.$inner.unknowns()
        }
        fn weights(&self) -> &[f64] {
            self.$inner.weights()
        }
        fn residual(&self) -> &[f64] {
            self.$inner.residual()
        }
        fn factorise(
            &mut self,
            row: &[f64],
        ) -> Result<hammerbeam_path::Determinant, hammerbeam_path::SingularJacobian> {
            self.$inner.factorise(row)
        }
        fn solve(&self, right_hand_side: &mut [f64]) {
            self.$inner.solve(right_hand_side);
        }
        fn judge(&mut self) -> &mut dyn hammerbeam_path::Judge {
            self
        }
    };
}
/// A curve in the plane of one unknown and the parameter: `(F, F_x, F_λ, signature)` at `(x, λ)`.
pub type Implicit = fn(f64, f64) -> (f64, f64, f64, u64);

/// `F(x, λ) = 0` itself, `n = 1`.
pub fn plane(f: impl Fn(f64, f64) -> (f64, f64, f64, u64) + Clone) -> impl PathProblem + Clone {
    DenseProblem::new(1, move |z: &[f64], r: &mut [f64], j: &mut [f64]| {
        let (value, dx, dl, signature) = f(z[0], z[1]);
        r[0] = value;
        j[0] = dx;
        j[1] = dl;
        signature
    })
}

/// A graph `λ = g(x)`, with `(g, g', signature)`.
pub fn graph(g: impl Fn(f64) -> (f64, f64, u64) + Clone) -> impl PathProblem + Clone {
    plane(move |x, l| {
        let (value, slope, signature) = g(x);
        (value - l, slope, -1.0, signature)
    })
}

/// `F(x_0, λ) = 0` with `n − 1` passive unknowns `x_i = sin(i + x_0) / n`, all mixed by the reflection
/// `Q = 1 − 2 v vᵀ`: `x = Q y` with `v_i ∝ 1 + sin(seed + i)`.
pub fn mixed(
    n: usize,
    seed: f64,
    f: impl Fn(f64, f64) -> (f64, f64, f64, u64) + Clone,
) -> impl PathProblem + Clone {
    let v = mirror(n, seed);
    DenseProblem::new(n, move |z: &[f64], r: &mut [f64], j: &mut [f64]| {
        let x = reflect(&v, &z[..n]);
        let (value, dx, dl, signature) = f(x[0], z[n]);
        j.fill(0.0);
        r[0] = value;
        j[0] = dx;
        j[n] = dl;
        for i in 1..n {
            r[i] = x[i] - (i as f64 + x[0]).sin() / n as f64;
            j[i * (n + 1)] = -(i as f64 + x[0]).cos() / n as f64;
            j[i * (n + 1) + i] = 1.0;
        }
        for row in j.chunks_mut(n + 1) {
            let turned = reflect(&v, &row[..n]);
            row[..n].copy_from_slice(&turned);
        }
        signature
    })
}

/// The point of [`mixed`] with this `x_0` and `λ`.
pub fn mixed_point(n: usize, seed: f64, x0: f64, parameter: f64) -> Vec<f64> {
    let x: Vec<f64> = (0..n).map(|i| if i == 0 { x0 } else { (i as f64 + x0).sin() / n as f64 }).collect();
    let mut z = reflect(&mirror(n, seed), &x);
    z.push(parameter);
    z
}

/// `x_0` of a point of [`mixed`].
pub fn unmixed(n: usize, seed: f64, z: &[f64]) -> f64 {
    reflect(&mirror(n, seed), &z[..n])[0]
}

fn mirror(n: usize, seed: f64) -> Vec<f64> {
    let v: Vec<f64> = (0..n).map(|i| 1.0 + (seed + i as f64).sin()).collect();
    let length = v.iter().map(|a| a * a).sum::<f64>().sqrt();
    v.iter().map(|a| a / length).collect()
}

fn reflect(v: &[f64], x: &[f64]) -> Vec<f64> {
    let along: f64 = v.iter().zip(x).map(|(a, b)| a * b).sum();
    x.iter().zip(v).map(|(b, a)| b - 2.0 * along * a).collect()
}

pub fn range(low: f64, high: f64) -> ParameterRange {
    ParameterRange::new(low, high).unwrap()
}

/// Default settings with this bound of the parameter step.
pub fn steps_of(max_parameter_step: f64) -> Settings {
    Settings { max_parameter_step, max_step_length: max_parameter_step.max(0.02), ..Settings::default() }
}

/// Follows with increasing parameter; panics with the reason if the start fails.
pub fn up(problem: &mut impl PathProblem, start: &[f64], low: f64, high: f64, settings: Settings) -> Branch {
    follow(problem, start, StartDirection::Increasing, range(low, high), settings).unwrap()
}

pub fn down(
    problem: &mut impl PathProblem,
    start: &[f64],
    low: f64,
    high: f64,
    settings: Settings,
) -> Branch {
    follow(problem, start, StartDirection::Decreasing, range(low, high), settings).unwrap()
}

/// Parameters of the folds in the order of travel.
pub fn folds(branch: &Branch) -> Vec<f64> {
    branch.folds().map(ContinuationPoint::parameter).collect()
}

/// The function of the points never decreases along the branch by more than the tolerance of a point.
pub fn assert_monotone(branch: &Branch, place: impl Fn(&[f64]) -> f64) {
    for pair in branch.points.windows(2) {
        let (a, b) = (place(&pair[0].point), place(&pair[1].point));
        assert!(b >= a - 2e-9, "ran back from {a} to {b} after {:?}", pair[0]);
    }
}

pub fn assert_reached_end(branch: &Branch, parameter: f64) {
    assert_eq!(branch.stop, PathStop::RangeEnd);
    assert_eq!(branch.points.last().unwrap().parameter(), parameter, "bit by bit");
}

pub fn evaluations_per_point(branch: &Branch) -> f64 {
    branch.counters.evaluations as f64 / branch.points.len() as f64
}
