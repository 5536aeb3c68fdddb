//! The interface of a model to be fitted.

use faer::Mat;

/// A model with its data: residuals as functions of the parameters.
pub trait FitProblem {
    /// Why the model cannot be evaluated.
    type Error: std::error::Error;

    /// `r_i = (y_i(p) - d_i)/s_i`, length m, always the same.
    ///
    /// # Errors
    /// The model does not exist for these parameters; the fit tries a smaller step.
    fn residuals(&mut self, parameters: &[f64]) -> Result<Vec<f64>, Self::Error>;

    /// `dr_i/dp_j`, m x n, at any parameters, often those of the last residuals.
    ///
    /// # Errors
    /// As for the residuals.
    fn jacobian(&mut self, parameters: &[f64]) -> Result<Mat<f64>, Self::Error>;
}

/// Knowledge of the standard deviations of the data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Deviations {
    /// They are known.
    Known,
    /// They are known up to a common factor, which is estimated from the residuals.
    UpToFactor,
}

/// Allowed values of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Smallest value.
    pub low: f64,
    /// Largest value.
    pub high: f64,
}

impl Bounds {
    /// No bounds.
    pub const NONE: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// The nearest value within the bounds.
    #[must_use]
    pub fn clamp(&self, value: f64) -> f64 {
        value.max(self.low).min(self.high)
    }

    /// Whether a bound holds a value that would decrease along `gradient`.
    pub(crate) fn hold(&self, value: f64, gradient: f64) -> bool {
        (value <= self.low && gradient >= 0.0) || (value >= self.high && gradient <= 0.0)
    }
}
