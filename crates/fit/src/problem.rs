//! What a model has to offer to be fitted.

use faer::Mat;

/// A model with its data: residuals over parameters.
pub trait FitProblem {
    /// Why the model cannot be evaluated somewhere.
    type Error: std::error::Error;

    /// `r_i = (y_i(p) - d_i)/s_i`, length m, always the same.
    ///
    /// # Errors
    /// The model does not exist for these parameters; the fit turns back.
    fn residuals(&mut self, parameters: &[f64]) -> Result<Vec<f64>, Self::Error>;

    /// `dr_i/dp_j`, m x n, where the residuals were asked for last or anywhere else.
    ///
    /// # Errors
    /// As for the residuals.
    fn jacobian(&mut self, parameters: &[f64]) -> Result<Mat<f64>, Self::Error>;
}

/// What is known of the standard deviations of the data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Deviations {
    /// They are what they are said to be.
    Known,
    /// They are right up to a common factor, which the residuals tell.
    UpToFactor,
}

/// Values that a parameter may take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Smallest value.
    pub low: f64,
    /// Largest value.
    pub high: f64,
}

impl Bounds {
    /// Any number.
    pub const NONE: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// The nearest value within the bounds.
    #[must_use]
    pub fn clamp(&self, value: f64) -> f64 {
        value.max(self.low).min(self.high)
    }

    /// Whether a value within them that goes against `gradient` is held by a bound.
    pub(crate) fn hold(&self, value: f64, gradient: f64) -> bool {
        (value <= self.low && gradient >= 0.0) || (value >= self.high && gradient <= 0.0)
    }
}
