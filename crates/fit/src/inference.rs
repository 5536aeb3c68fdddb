//! Standard errors, intervals, correlation and the chi-squared test, to first order about the best
//! parameters.
//!
//! `S = v (J^T J)^-1` over the parameters that no bound holds, from the singular values of J with columns of
//! length one. Where some of these count as zero (less than 1e-6 of the largest), the parameters in their
//! directions have no standard error; the others have that of the remaining directions.

use faer::Mat;

use crate::{
    Deviations, Fit,
    distribution::{chi_squared_tail, normal_quantile, student_quantile},
    jacobian::Decomposed,
};

/// A parameter with a larger part than this in a direction that the data do not see has no standard error.
const UNSEEN: f64 = 1e-4;

/// An interval of confidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// The test of `chi^2`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChiSquared {
    /// `chi^2`.
    pub value: f64,
    /// Data less parameters.
    pub freedoms: usize,
    /// Probability that errors with the stated standard deviations alone give as much or more; `None` without
    /// freedoms, or where the factor of the deviations was estimated from it.
    pub probability: Option<f64>,
}

/// What is known of the parameters, to first order.
#[derive(Debug, Clone, PartialEq)]
pub struct Inference {
    /// Probability that an interval holds its parameter.
    pub confidence: f64,
    /// Half width of an interval in standard errors.
    pub quantile: f64,
    /// `v`: 1, or the factor of the variances that the residuals tell; `None` where they cannot.
    pub variance: Option<f64>,
    /// Of each parameter; `None` where the data do not determine it, a bound holds it, or the variance is not
    /// known.
    pub standard_errors: Vec<Option<f64>>,
    /// Of each parameter, as the standard errors.
    pub intervals: Vec<Option<Interval>>,
    /// Correlation of each two parameters.
    pub correlation: Vec<Vec<Option<f64>>>,
    /// The test of the fit.
    pub chi_squared: ChiSquared,
}

impl Inference {
    /// From a fit.
    ///
    /// * `confidence`: such as 0.95.
    #[must_use]
    pub fn of(fit: &Fit, deviations: Deviations, confidence: f64) -> Self {
        let free: Vec<usize> = (0..fit.parameters.len()).filter(|j| !fit.at_bound[*j]).collect();
        let jacobian = Mat::from_fn(fit.residuals.len(), free.len(), |i, j| fit.jacobian[(i, free[j])]);
        let decomposed = Decomposed::with_unit_columns(&jacobian);
        let rank = decomposed.as_ref().map_or(0, Decomposed::rank);
        let freedoms = fit.residuals.len().saturating_sub(rank);
        let value = fit.chi_squared();
        let (variance, quantile, probability) = match deviations {
            Deviations::Known => {
                let probability = (freedoms > 0).then(|| chi_squared_tail(value, freedoms as f64));
                (Some(1.0), normal_quantile(confidence), probability)
            }
            Deviations::UpToFactor if freedoms == 0 => (None, f64::NAN, None),
            Deviations::UpToFactor => {
                (Some(value / freedoms as f64), student_quantile(confidence, freedoms as f64), None)
            }
        };
        let covariance = Covariance { decomposed: decomposed.as_ref(), free: &free, variance };
        let count = fit.parameters.len();
        let standard_errors: Vec<Option<f64>> =
            (0..count).map(|j| covariance.entry(j, j).map(f64::sqrt)).collect();
        let interval = |(value, error): (&f64, &Option<f64>)| {
            let half = quantile * (*error)?;
            Some(Interval { low: value - half, high: value + half })
        };
        let correlation = |i: usize, j: usize| {
            let product = standard_errors[i]? * standard_errors[j]?;
            Some(if product > 0.0 { covariance.entry(i, j)? / product } else { f64::from(u8::from(i == j)) })
        };
        Self {
            confidence,
            quantile,
            variance,
            intervals: fit.parameters.iter().zip(&standard_errors).map(interval).collect(),
            correlation: (0..count).map(|i| (0..count).map(|j| correlation(i, j)).collect()).collect(),
            standard_errors,
            chi_squared: ChiSquared { value, freedoms, probability },
        }
    }
}

struct Covariance<'a> {
    decomposed: Option<&'a Decomposed>,
    free: &'a [usize],
    variance: Option<f64>,
}

impl Covariance<'_> {
    fn entry(&self, i: usize, j: usize) -> Option<f64> {
        let (decomposed, variance) = (self.decomposed?, self.variance?);
        let place = |parameter: usize| self.free.iter().position(|free| *free == parameter);
        let (i, j) = (place(i)?, place(j)?);
        let rank = decomposed.rank();
        let seen = |p: usize| {
            let within: f64 = (0..rank).map(|k| decomposed.part(p, k).powi(2)).sum();
            1.0 - within <= UNSEEN * UNSEEN
        };
        if !seen(i) || !seen(j) {
            return None;
        }
        let along = |k: usize| decomposed.part(i, k) * decomposed.part(j, k) / decomposed.singular[k].powi(2);
        let sum: f64 = (0..rank).map(along).sum();
        Some(variance * sum / (decomposed.scale[i] * decomposed.scale[j]))
    }
}
