//! Standard errors, intervals, correlation and the chi-squared test, to first order about the best
//! parameters.
//!
//! `S = v (J^T J)^-1` over the parameters that no bound holds, from the singular values of J with columns of
//! length one. Singular values below 1e-6 of the largest count as zero. The parameters in their directions
//! have no standard error; the others have the standard error of the remaining directions.

use faer::Mat;

use crate::{
    distribution::{chi_squared_tail, normal_quantile, student_quantile},
    jacobian::ScaledJacobian,
    outcome::LeastSquaresFit,
    problem::Deviations,
};

/// A parameter with a larger component than this in undetermined directions has no standard error.
const MAX_UNDETERMINED: f64 = 1e-4;

/// A confidence interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// The chi-squared test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChiSquared {
    /// `chi^2`.
    pub value: f64,
    /// Number of data minus number of parameters.
    pub degrees_of_freedom: usize,
    /// Probability that errors with the stated standard deviations give at least this value; `None` without
    /// degrees of freedom, or if the factor of the deviations was estimated from it.
    pub probability: Option<f64>,
}

/// Uncertainty of the parameters, to first order.
#[derive(Debug, Clone, PartialEq)]
pub struct Inference {
    /// Probability that an interval contains its parameter.
    pub confidence: f64,
    /// Half width of an interval in standard errors.
    pub quantile: f64,
    /// `v`: 1, or the factor of the variances estimated from the residuals; `None` if that is impossible.
    pub variance: Option<f64>,
    /// Standard error of each parameter; `None` if the data do not determine it, a bound holds it, or the
    /// variance is unknown.
    pub standard_errors: Vec<Option<f64>>,
    /// Interval of each parameter, under the same conditions.
    pub intervals: Vec<Option<Interval>>,
    /// Correlation of each pair of parameters.
    pub correlation: Vec<Vec<Option<f64>>>,
    /// The test of the residuals.
    pub chi_squared: ChiSquared,
}

impl Inference {
    /// From a fit.
    ///
    /// * `confidence`: such as 0.95.
    #[must_use]
    pub fn of(fit: &LeastSquaresFit, deviations: Deviations, confidence: f64) -> Self {
        let free: Vec<usize> = (0..fit.parameters.len()).filter(|j| !fit.at_bound[*j]).collect();
        let jacobian = Mat::from_fn(fit.residuals.len(), free.len(), |i, j| fit.jacobian[(i, free[j])]);
        let decomposed = ScaledJacobian::with_unit_columns(&jacobian);
        let rank = decomposed.as_ref().map_or(0, ScaledJacobian::rank);
        let degrees_of_freedom = fit.residuals.len().saturating_sub(rank);
        let value = fit.chi_squared();
        let (variance, quantile, probability) = match deviations {
            Deviations::Known => {
                let probability =
                    (degrees_of_freedom > 0).then(|| chi_squared_tail(value, degrees_of_freedom as f64));
                (Some(1.0), normal_quantile(confidence), probability)
            }
            Deviations::UpToFactor if degrees_of_freedom == 0 => (None, f64::NAN, None),
            Deviations::UpToFactor => (
                Some(value / degrees_of_freedom as f64),
                student_quantile(confidence, degrees_of_freedom as f64),
                None,
            ),
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
            chi_squared: ChiSquared { value, degrees_of_freedom, probability },
        }
    }
}

/// Covariance of the parameters that no bound holds.
struct Covariance<'a> {
    decomposed: Option<&'a ScaledJacobian>,
    free: &'a [usize],
    variance: Option<f64>,
}

impl Covariance<'_> {
    fn entry(&self, i: usize, j: usize) -> Option<f64> {
        let (decomposed, variance) = (self.decomposed?, self.variance?);
        let index = |parameter: usize| self.free.iter().position(|free| *free == parameter);
        let (i, j) = (index(i)?, index(j)?);
        let rank = decomposed.rank();
        let is_determined = |p: usize| {
            let within: f64 = (0..rank).map(|k| decomposed.part(p, k).powi(2)).sum();
            1.0 - within <= MAX_UNDETERMINED * MAX_UNDETERMINED
        };
        if !is_determined(i) || !is_determined(j) {
            return None;
        }
        let along = |k: usize| decomposed.part(i, k) * decomposed.part(j, k) / decomposed.singular[k].powi(2);
        let sum: f64 = (0..rank).map(along).sum();
        Some(variance * sum / (decomposed.scale[i] * decomposed.scale[j]))
    }
}
