//! Least squares: damped oscillations and an offset fitted to a series.
//!
//! Parameters `p = (y0; s_m, w_m, a_m, b_m)`. Gauss-Newton with the damping of Levenberg and Marquardt: `(A +
//! mu diag A) dp = J^T r`, with `A = J^T J` and the residual `r`. `mu` is divided by ten after a step that
//! reduces the sum of squares, and multiplied by ten otherwise. The iteration ends when a step is small
//! against the standard errors, `dp^T A dp < 1e-16 r^T r`, changes samples by no more than rounding, or when
//! no step reduces the sum.

use faer::{
    Mat, Side,
    linalg::solvers::{DenseSolveCore, Solve},
};
use realfft::num_complex::Complex;

use super::model::Oscillation;
use crate::error::SignalError;

const MAX_ITERATIONS: usize = 200;

/// Fitted oscillations.
#[derive(Debug, Clone)]
pub(crate) struct DecayFit {
    pub offset: f64,
    pub oscillations: Vec<Oscillation>,
    /// Samples minus fitted values.
    pub residual: Vec<f64>,
    /// `(J^T J)^-1`; parameter 0 is the offset, then four for each oscillation: rate, frequency, cosine,
    /// sine.
    pub inverse: Mat<f64>,
}

/// Fits oscillations, starting from given ones.
///
/// # Errors
/// [`SignalError::FitNotConverged`].
pub(crate) fn fit(series: &[f64], step: f64, start: &[Oscillation]) -> Result<DecayFit, SignalError> {
    let mean = series.iter().sum::<f64>() / series.len() as f64;
    let not_converged = || SignalError::FitNotConverged { modes: start.len(), iterations: MAX_ITERATIONS };
    let rounding = 1e-26 * series.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
    let mut parameters = (mean, start.to_vec());
    let mut normal = NormalEquations::at(series, step, &parameters);
    let mut damping = 1e-3;
    for _ in 0..MAX_ITERATIONS {
        let change = normal.step(damping).ok_or_else(not_converged)?;
        if normal.predicted(&change) < 1e-16 * normal.sum + rounding {
            return normal.finish(series, step, parameters).ok_or_else(not_converged);
        }
        let trial = moved(&parameters, &change);
        let next = NormalEquations::at(series, step, &trial);
        if next.sum.is_finite() && next.sum <= normal.sum {
            (parameters, normal) = (trial, next);
            damping = (0.1 * damping).max(1e-12);
        } else if damping > 1e8 {
            // Only rounding is left.
            return normal.finish(series, step, parameters).ok_or_else(not_converged);
        } else {
            damping *= 10.0;
        }
    }
    Err(not_converged())
}

type Parameters = (f64, Vec<Oscillation>);

fn moved((offset, oscillations): &Parameters, change: &Mat<f64>) -> Parameters {
    let moved = oscillations.iter().enumerate().map(|(m, o)| {
        let by = |j: usize| change[(1 + 4 * m + j, 0)];
        Oscillation {
            rate: o.rate + by(0),
            frequency: o.frequency + by(1),
            cosine: o.cosine + by(2),
            sine: o.sine + by(3),
        }
    });
    (offset + change[(0, 0)], moved.collect())
}

/// The normal equations at given parameters.
struct NormalEquations {
    matrix: Mat<f64>,
    right: Mat<f64>,
    /// Sum of squares of the residual.
    sum: f64,
}

impl NormalEquations {
    fn at(series: &[f64], step: f64, (offset, oscillations): &Parameters) -> Self {
        let size = 1 + 4 * oscillations.len();
        let mut powers: Vec<_> = oscillations.iter().map(|o| o.powers(series.len(), step)).collect();
        let mut row = vec![1.0; size];
        let mut products = vec![0.0; size * (size + 1) / 2];
        let mut right = vec![0.0; size];
        let mut sum = 0.0;
        for (k, value) in series.iter().enumerate() {
            let time = k as f64 * step;
            let mut residual = value - offset;
            for (m, powers) in powers.iter_mut().enumerate() {
                let power = powers.next().unwrap_or_default();
                let turned = Complex::new(oscillations[m].cosine, -oscillations[m].sine) * power;
                residual -= turned.re;
                row[1 + 4 * m..5 + 4 * m].copy_from_slice(&[
                    -time * turned.re,
                    -time * turned.im,
                    power.re,
                    power.im,
                ]);
            }
            sum += residual * residual;
            let mut at = 0;
            for i in 0..size {
                right[i] += row[i] * residual;
                for j in 0..=i {
                    products[at] += row[i] * row[j];
                    at += 1;
                }
            }
        }
        let entry = |i: usize, j: usize| products[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
        Self { matrix: Mat::from_fn(size, size, entry), right: Mat::from_fn(size, 1, |i, _| right[i]), sum }
    }

    fn step(&self, damping: f64) -> Option<Mat<f64>> {
        let damped = Mat::from_fn(self.matrix.nrows(), self.matrix.ncols(), |i, j| {
            self.matrix[(i, j)] * if i == j { 1.0 + damping } else { 1.0 }
        });
        Some(scaled(&damped)?.solve(&self.right))
    }

    /// Squared change of the fitted samples by a step.
    fn predicted(&self, change: &Mat<f64>) -> f64 {
        (change.transpose() * &self.matrix * change)[(0, 0)]
    }

    fn finish(&self, series: &[f64], step: f64, (offset, oscillations): Parameters) -> Option<DecayFit> {
        let mut residual: Vec<f64> = series.iter().map(|value| value - offset).collect();
        oscillations.iter().for_each(|oscillation| oscillation.subtract(&mut residual, step));
        Some(DecayFit { offset, oscillations, residual, inverse: scaled(&self.matrix)?.inverse() })
    }
}

/// Cholesky decomposition of a symmetric positive matrix, scaled to ones on the diagonal.
struct ScaledMatrix {
    scale: Vec<f64>,
    decomposed: faer::linalg::solvers::Llt<f64>,
}

fn scaled(matrix: &Mat<f64>) -> Option<ScaledMatrix> {
    let scale: Vec<f64> = (0..matrix.nrows()).map(|i| matrix[(i, i)].sqrt().recip()).collect();
    if scale.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let unit = Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)] * scale[i] * scale[j]);
    Some(ScaledMatrix { decomposed: unit.llt(Side::Lower).ok()?, scale })
}

impl ScaledMatrix {
    fn solve(&self, right: &Mat<f64>) -> Mat<f64> {
        let right = Mat::from_fn(right.nrows(), 1, |i, _| right[(i, 0)] * self.scale[i]);
        let solved = self.decomposed.solve(&right);
        Mat::from_fn(right.nrows(), 1, |i, _| solved[(i, 0)] * self.scale[i])
    }

    fn inverse(&self) -> Mat<f64> {
        let inverse = self.decomposed.inverse();
        Mat::from_fn(self.scale.len(), self.scale.len(), |i, j| {
            inverse[(i, j)] * self.scale[i] * self.scale[j]
        })
    }
}
