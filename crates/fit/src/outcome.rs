//! Settings of a fit, and its result.

use faer::Mat;

use crate::problem::Deviations;

/// Settings of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastSquaresSettings {
    /// Knowledge of the standard deviations, in which convergence is measured.
    pub deviations: Deviations,
    /// Converged when a further step would move the parameters by no more than this many standard errors.
    pub tolerance: f64,
    /// Largest number of Jacobians.
    pub max_iterations: u32,
}

impl LeastSquaresSettings {
    /// A tolerance of 1e-6 standard errors, and 100 iterations.
    #[must_use]
    pub fn new(deviations: Deviations) -> Self {
        Self { deviations, tolerance: 1e-6, max_iterations: 100 }
    }
}

/// How a fit ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FitEnd {
    /// At a minimum.
    Converged {
        /// `|U^T r|`.
        distance: f64,
    },
    /// No step improves the fit, and it is no minimum either.
    Stalled {
        /// `|U^T r|`.
        distance: f64,
    },
    /// The next steps lead to parameters for which the model does not exist.
    Blocked {
        /// `|U^T r|`.
        distance: f64,
    },
    /// There were too many iterations.
    OutOfIterations {
        /// `|U^T r|`.
        distance: f64,
    },
}

impl FitEnd {
    /// Whether it is a minimum.
    #[must_use]
    pub fn converged(&self) -> bool {
        matches!(self, Self::Converged { .. })
    }

    /// Length of the next step [standard errors].
    #[must_use]
    pub fn distance(&self) -> f64 {
        match *self {
            Self::Converged { distance }
            | Self::Stalled { distance }
            | Self::Blocked { distance }
            | Self::OutOfIterations { distance } => distance,
        }
    }
}

/// Best parameters, and the model there.
#[derive(Debug, Clone)]
pub struct LeastSquaresFit {
    /// The parameters.
    pub parameters: Vec<f64>,
    /// `r` there.
    pub residuals: Vec<f64>,
    /// `J` there, m x n.
    pub jacobian: Mat<f64>,
    /// Which parameters are held by a bound.
    pub at_bound: Vec<bool>,
    /// Number of computed Jacobians.
    pub iterations: u32,
    /// How it ended.
    pub end: FitEnd,
}

impl LeastSquaresFit {
    /// `chi^2`.
    #[must_use]
    pub fn chi_squared(&self) -> f64 {
        self.residuals.iter().map(|value| value * value).sum()
    }

    /// Number of data minus number of parameters that no bound holds; `None` if there are fewer data.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> Option<usize> {
        let free = self.at_bound.iter().filter(|held| !**held).count();
        self.residuals.len().checked_sub(free)
    }
}

/// Why there is no fit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum FitError<E: std::error::Error> {
    /// The model does not exist for the initial parameters.
    #[error("the model cannot be computed at the start: {source}")]
    Start { source: E },
    /// The residuals exist, but not the derivatives.
    #[error("the derivatives of the model cannot be computed: {source}")]
    Derivatives { source: E },
    /// Some residual or derivative is not a number.
    #[error("the model gives numbers that are not finite")]
    NotFinite,
}
