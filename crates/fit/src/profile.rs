//! Intervals from the profile of `chi^2`.
//!
//! With the parameter j held at a value, the others minimise `chi^2`; `zeta(p_j) = sign(p_j - p_j*)
//! sqrt((chi^2(p_j) - chi^2(p*))/v)` is the profile in standard errors, a straight line for a linear model.
//! The ends of the interval are where it reaches `-q` and `q`, found by the secant method from the ends to
//! first order; every fit starts from the last one.
//!
//! # Source
//! Bates and Watts (1988), section 6.1; Venzon and Moolgavkar, Appl. Stat. 37 (1988), 87-94.

use faer::Mat;

use crate::{Bounds, Fit, FitProblem, FitSettings, Inference, fit, least_squares::sum_of_squares};

/// The profile is met to this many standard errors.
const CLOSE: f64 = 1e-3;
/// Fits for an end.
const MOST_FITS: usize = 12;
/// Farthest an end is looked for, in half widths of the interval to first order.
const FARTHEST: f64 = 30.0;

/// An interval of the profile; an end is `None` where the profile does not rise so far: within the bounds,
/// within thirty half widths of the interval to first order, or because the model cannot be computed or
/// fitted there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileInterval {
    /// Lower end.
    pub low: Option<f64>,
    /// Upper end.
    pub high: Option<f64>,
}

/// The interval of parameter `index`; `None` where it has none to first order.
pub fn profile<P: FitProblem>(
    problem: &mut P,
    found: &Fit,
    inference: &Inference,
    (index, bounds): (usize, &[Bounds]),
    settings: &FitSettings,
) -> Option<ProfileInterval> {
    let error = inference.standard_errors[index].filter(|error| *error > 0.0)?;
    let variance = inference.variance.filter(|variance| *variance > 0.0)?;
    let mut walk = Profile {
        rest: others(bounds, index),
        settings: *settings,
        least: found.chi_squared(),
        variance,
        start: others(&found.parameters, index),
        index,
    };
    let half = inference.quantile * error;
    let best = found.parameters[index];
    let mut end =
        |direction: f64| walk.end(problem, best, (direction * half, inference.quantile), &bounds[index]);
    Some(ProfileInterval { low: end(-1.0), high: end(1.0) })
}

struct Profile {
    index: usize,
    rest: Vec<Bounds>,
    settings: FitSettings,
    least: f64,
    variance: f64,
    /// Best other parameters at the best fit.
    start: Vec<f64>,
}

impl Profile {
    /// Where `|zeta|` reaches the quantile.
    ///
    /// * `half`: the way to the end to first order, with its sign.
    fn end<P: FitProblem>(
        &mut self,
        problem: &mut P,
        best: f64,
        (half, quantile): (f64, f64),
        bounds: &Bounds,
    ) -> Option<f64> {
        let mut rest = self.start.clone();
        // The way as a part of the one to first order; below it zeta is too small, above it too large.
        let (mut below, mut above) = ((0.0, 0.0), None::<(f64, f64)>);
        let mut way = 1.0;
        for _ in 0..MOST_FITS {
            let value = bounds.clamp(best + way * half);
            way = (value - best) / half;
            let zeta = self.zeta(problem, value, &mut rest)?;
            if (zeta - quantile).abs() <= CLOSE {
                return Some(value);
            }
            if zeta < quantile {
                if way <= below.0 {
                    return None;
                }
                below = (way, zeta);
            } else {
                above = Some((way, zeta));
            }
            way = match above {
                Some((far, high)) => {
                    let part = (quantile - below.1) / (high - below.1);
                    below.0 + part.clamp(0.05, 0.95) * (far - below.0)
                }
                None => way * (quantile / zeta.max(0.1 * quantile)).clamp(1.02, 3.0),
            };
            if way > FARTHEST {
                return None;
            }
        }
        None
    }

    fn zeta<P: FitProblem>(&self, problem: &mut P, value: f64, rest: &mut Vec<f64>) -> Option<f64> {
        if rest.is_empty() {
            let residuals = problem.residuals(&[value]).ok()?;
            return Some(((sum_of_squares(&residuals) - self.least).max(0.0) / self.variance).sqrt());
        }
        let mut held = Held { problem, index: self.index, value };
        let fitted = fit(&mut held, rest, &self.rest, &self.settings).ok()?;
        if !fitted.end.converged() {
            return None;
        }
        rest.clone_from(&fitted.parameters);
        Some(((fitted.chi_squared() - self.least).max(0.0) / self.variance).sqrt())
    }
}

/// A problem with one parameter held.
struct Held<'a, P> {
    problem: &'a mut P,
    index: usize,
    value: f64,
}

impl<P> Held<'_, P> {
    fn all(&self, rest: &[f64]) -> Vec<f64> {
        let mut all = rest.to_vec();
        all.insert(self.index, self.value);
        all
    }
}

impl<P: FitProblem> FitProblem for Held<'_, P> {
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
