//! Intervals from the profile of `chi^2`.
//!
//! With parameter j fixed at a value, the others minimise `chi^2`. The profile in standard errors is
//! `zeta(p_j) = sign(p_j - p_j*) sqrt((chi^2(p_j) - chi^2(p*))/v)`, a straight line for a linear model. The
//! ends of the interval, where it reaches `-q` and `q`, are found by the secant method from the ends to first
//! order. Each fit starts from the previous one.
//!
//! # Source
//! Bates and Watts (1988), section 6.1; Venzon and Moolgavkar, Appl. Stat. 37 (1988), 87-94.

use faer::Mat;

use crate::{
    inference::Inference,
    least_squares::fit,
    outcome::{LeastSquaresFit, LeastSquaresSettings},
    problem::{Bounds, FitProblem},
    search::sum_of_squares,
};

/// Accuracy of the profile at an end, in standard errors.
const CLOSE: f64 = 1e-3;
/// Largest number of fits for an end.
const MAX_FITS: usize = 12;
/// Largest distance of an end, in half widths of the interval to first order.
const FARTHEST: f64 = 30.0;

/// An interval from the profile. An end is `None` if the profile does not reach the quantile within the
/// bounds or within thirty half widths of the interval to first order, or if the model cannot be computed or
/// fitted there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileInterval {
    /// Lower end.
    pub low: Option<f64>,
    /// Upper end.
    pub high: Option<f64>,
}

/// The interval of parameter `index`; `None` if it has none to first order.
pub fn profile<P: FitProblem>(
    problem: &mut P,
    found: &LeastSquaresFit,
    inference: &Inference,
    (index, bounds): (usize, &[Bounds]),
    settings: &LeastSquaresSettings,
) -> Option<ProfileInterval> {
    let error = inference.standard_errors[index].filter(|error| *error > 0.0)?;
    let variance = inference.variance.filter(|variance| *variance > 0.0)?;
    let mut state = ProfileSearch {
        other_bounds: others(bounds, index),
        settings: *settings,
        least: found.chi_squared(),
        variance,
        start: others(&found.parameters, index),
        index,
    };
    let half = inference.quantile * error;
    let best = found.parameters[index];
    let mut end =
        |direction: f64| state.end(problem, best, (direction * half, inference.quantile), &bounds[index]);
    Some(ProfileInterval { low: end(-1.0), high: end(1.0) })
}

/// The search for the ends of an interval.
struct ProfileSearch {
    index: usize,
    other_bounds: Vec<Bounds>,
    settings: LeastSquaresSettings,
    /// Least `chi^2`.
    least: f64,
    variance: f64,
    /// Best other parameters at the best fit.
    start: Vec<f64>,
}

impl ProfileSearch {
    /// Where `|zeta|` reaches the quantile.
    ///
    /// * `half`: signed distance of the end to first order.
    fn end<P: FitProblem>(
        &mut self,
        problem: &mut P,
        best: f64,
        (half, quantile): (f64, f64),
        bounds: &Bounds,
    ) -> Option<f64> {
        let mut others = self.start.clone();
        // Distances relative to the one to first order: zeta is too small at `below`, too large at `above`.
        let (mut below, mut above) = ((0.0, 0.0), None::<(f64, f64)>);
        let mut distance = 1.0;
        for _ in 0..MAX_FITS {
            let value = bounds.clamp(best + distance * half);
            distance = (value - best) / half;
            let zeta = self.zeta(problem, value, &mut others)?;
            if (zeta - quantile).abs() <= CLOSE {
                return Some(value);
            }
            if zeta < quantile {
                if distance <= below.0 {
                    return None;
                }
                below = (distance, zeta);
            } else {
                above = Some((distance, zeta));
            }
            distance = match above {
                Some((far, high)) => {
                    let part = (quantile - below.1) / (high - below.1);
                    below.0 + part.clamp(0.05, 0.95) * (far - below.0)
                }
                None => distance * (quantile / zeta.max(0.1 * quantile)).clamp(1.02, 3.0),
            };
            if distance > FARTHEST {
                return None;
            }
        }
        None
    }

    /// `|zeta|` at a value of the parameter.
    ///
    /// * `others`: initial values of the other parameters, replaced by the best ones.
    fn zeta<P: FitProblem>(&self, problem: &mut P, value: f64, others: &mut Vec<f64>) -> Option<f64> {
        if others.is_empty() {
            let residuals = problem.residuals(&[value]).ok()?;
            return Some(((sum_of_squares(&residuals) - self.least).max(0.0) / self.variance).sqrt());
        }
        let mut fixed = FixedParameter { problem, index: self.index, value };
        let fitted = fit(&mut fixed, others, &self.other_bounds, &self.settings).ok()?;
        if !fitted.end.converged() {
            return None;
        }
        others.clone_from(&fitted.parameters);
        Some(((fitted.chi_squared() - self.least).max(0.0) / self.variance).sqrt())
    }
}

/// A problem with one parameter fixed.
struct FixedParameter<'a, P> {
    problem: &'a mut P,
    index: usize,
    value: f64,
}

impl<P> FixedParameter<'_, P> {
    /// All parameters.
    fn all(&self, others: &[f64]) -> Vec<f64> {
        let mut all = others.to_vec();
        all.insert(self.index, self.value);
        all
    }
}

impl<P: FitProblem> FitProblem for FixedParameter<'_, P> {
    type Error = P::Error;

    fn residuals(&mut self, parameters: &[f64]) -> Result<Vec<f64>, P::Error> {
        let all = self.all(parameters);
        self.problem.residuals(&all)
    }

    fn jacobian(&mut self, parameters: &[f64]) -> Result<Mat<f64>, P::Error> {
        let all = self.all(parameters);
        let full = self.problem.jacobian(&all)?;
        let column = |j: usize| if j < self.index { j } else { j + 1 };
        Ok(Mat::from_fn(full.nrows(), full.ncols() - 1, |i, j| full[(i, column(j))]))
    }
}

fn others<T: Copy>(values: &[T], index: usize) -> Vec<T> {
    values.iter().enumerate().filter(|(j, _)| *j != index).map(|(_, value)| *value).collect()
}
