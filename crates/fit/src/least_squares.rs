//! The method of Levenberg and Marquardt, within bounds.
//!
//! A step is `-(J^T J + mu C^2)^-1 J^T r` over the parameters that no bound holds, with the lengths C of the
//! columns of J; it is cut off at the bounds. The damping `mu` follows the ratio of the gained to the
//! predicted reduction of `chi^2`. The fit has converged when the residuals are orthogonal to the tangent
//! plane: with the singular vectors U of J, `|U^T r|` is by how many standard errors, all parameters
//! together, the next step would still move them.
//!
//! # Source
//! Marquardt, J. SIAM 11 (1963), 431-441; Nielsen, *Damping parameter in Marquardt's method* (1999), for the
//! damping; Bates and Watts, Technometrics 23 (1981), 179-183, for the criterion.

use faer::Mat;

use crate::{
    Bounds, Deviations, FitProblem,
    jacobian::{Decomposed, lengths},
};

/// First damping, relative to the squared columns.
const FIRST_DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-15;
/// Damping beyond which no step helps any more.
const MOST_DAMPING: f64 = 1e12;
/// A fit that no step improves has converged all the same if it is within this many standard errors: the
/// model's own noise is all that is left.
const AT_NOISE: f64 = 1e-2;
/// Steps smaller than this part of each parameter are rounding.
const ROUNDING: f64 = 1e-14;

/// Settings of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitSettings {
    /// What is known of the standard deviations: converged is measured in them.
    pub deviations: Deviations,
    /// Converged when a further step would move the parameters by no more than this many standard errors.
    pub tolerance: f64,
    /// Most Jacobians.
    pub max_iterations: u32,
}

impl FitSettings {
    /// A tolerance of 1e-6 standard errors, and 100 iterations.
    #[must_use]
    pub fn new(deviations: Deviations) -> Self {
        Self { deviations, tolerance: 1e-6, max_iterations: 100 }
    }
}

/// How a fit ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FitEnd {
    /// At a minimum; a further step would move the parameters by so many standard errors.
    Converged {
        /// `|U^T r|`.
        distance: f64,
    },
    /// No step improves the fit, and it is no minimum either.
    Stalled {
        /// `|U^T r|`.
        distance: f64,
    },
    /// The next steps lead to where the model does not exist.
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

    /// How far a further step would still go [standard errors].
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
pub struct Fit {
    /// The parameters.
    pub parameters: Vec<f64>,
    /// `r` there.
    pub residuals: Vec<f64>,
    /// `J` there, m x n.
    pub jacobian: Mat<f64>,
    /// Which parameters are held by a bound.
    pub at_bound: Vec<bool>,
    /// Jacobians that it took.
    pub iterations: u32,
    /// How it ended.
    pub end: FitEnd,
}

impl Fit {
    /// `chi^2`.
    #[must_use]
    pub fn chi_squared(&self) -> f64 {
        sum_of_squares(&self.residuals)
    }

    /// Data less parameters that no bound holds; `None` if there are fewer data.
    #[must_use]
    pub fn freedoms(&self) -> Option<usize> {
        let free = self.at_bound.iter().filter(|held| !**held).count();
        self.residuals.len().checked_sub(free)
    }
}

/// Why there is no fit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum FitError<E: std::error::Error> {
    /// The model does not exist at the start.
    #[error("the model cannot be computed at the start: {source}")]
    Start { source: E },
    /// Residuals are there, derivatives are not.
    #[error("the derivatives of the model cannot be computed: {source}")]
    Derivatives { source: E },
    /// Some residual or derivative is not a number.
    #[error("the model gives numbers that are not finite")]
    NotFinite,
}

/// Fits the parameters, from a start.
///
/// * `start`: n values, brought within the bounds.
///
/// # Errors
/// [`FitError`]; where it merely does not converge, that is the [`FitEnd`] of the result.
pub fn fit<P: FitProblem>(
    problem: &mut P,
    start: &[f64],
    bounds: &[Bounds],
    settings: &FitSettings,
) -> Result<Fit, FitError<P::Error>> {
    let parameters: Vec<f64> = start.iter().zip(bounds).map(|(value, bounds)| bounds.clamp(*value)).collect();
    let residuals = problem.residuals(&parameters).map_err(|source| FitError::Start { source })?;
    let mut search = Search::begin(problem, parameters, residuals, bounds)?;
    let (mut damping, mut growth) = (FIRST_DAMPING, 2.0);
    loop {
        let distance = search.distance();
        let reference = match settings.deviations {
            Deviations::Known => 1.0,
            Deviations::UpToFactor => search.spread(),
        };
        if distance <= settings.tolerance * reference {
            return Ok(
                search.end(FitEnd::Converged { distance: distance / reference.max(f64::MIN_POSITIVE) })
            );
        }
        if search.iterations >= settings.max_iterations {
            return Ok(search.end(FitEnd::OutOfIterations { distance: distance / reference }));
        }
        let mut refused = 0;
        loop {
            let trial = search.trial(damping, bounds);
            if trial.is_rounding || damping > MOST_DAMPING {
                let distance = distance / reference.max(f64::MIN_POSITIVE);
                let end = if distance <= AT_NOISE || search.trial(0.0, bounds).is_rounding {
                    FitEnd::Converged { distance }
                } else if refused > 0 {
                    FitEnd::Blocked { distance }
                } else {
                    FitEnd::Stalled { distance }
                };
                return Ok(search.end(end));
            }
            let residuals = problem.residuals(&trial.parameters).ok();
            refused += u32::from(residuals.is_none());
            let gained = residuals.as_ref().map_or(f64::NEG_INFINITY, |r| search.sum - sum_of_squares(r));
            if let Some(residuals) = residuals.filter(|_| gained > 0.0) {
                let ratio = gained / trial.predicted;
                damping = (damping * (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(0.1, 2.0)).max(LEAST_DAMPING);
                growth = 2.0;
                search.move_to(problem, trial.parameters, residuals, bounds)?;
                break;
            }
            damping *= growth;
            growth *= 2.0;
        }
    }
}

struct Trial {
    parameters: Vec<f64>,
    predicted: f64,
    is_rounding: bool,
}

/// A place of the search, with its Jacobian.
struct Search {
    parameters: Vec<f64>,
    residuals: Vec<f64>,
    sum: f64,
    jacobian: Mat<f64>,
    held: Vec<bool>,
    decomposed: Decomposed,
    projected: Vec<f64>,
    /// Largest lengths of the columns so far.
    scale: Vec<f64>,
    iterations: u32,
}

impl Search {
    fn begin<P: FitProblem>(
        problem: &mut P,
        parameters: Vec<f64>,
        residuals: Vec<f64>,
        bounds: &[Bounds],
    ) -> Result<Self, FitError<P::Error>> {
        let scale = vec![0.0; parameters.len()];
        Self::at(problem, parameters, residuals, bounds, scale, 1)
    }

    fn move_to<P: FitProblem>(
        &mut self,
        problem: &mut P,
        parameters: Vec<f64>,
        residuals: Vec<f64>,
        bounds: &[Bounds],
    ) -> Result<(), FitError<P::Error>> {
        let scale = std::mem::take(&mut self.scale);
        *self = Self::at(problem, parameters, residuals, bounds, scale, self.iterations + 1)?;
        Ok(())
    }

    fn at<P: FitProblem>(
        problem: &mut P,
        parameters: Vec<f64>,
        residuals: Vec<f64>,
        bounds: &[Bounds],
        scale: Vec<f64>,
        iterations: u32,
    ) -> Result<Self, FitError<P::Error>> {
        let jacobian = problem.jacobian(&parameters).map_err(|source| FitError::Derivatives { source })?;
        let gradient =
            |j: usize| -> f64 { residuals.iter().enumerate().map(|(i, r)| jacobian[(i, j)] * r).sum() };
        let held: Vec<bool> =
            (0..parameters.len()).map(|j| bounds[j].hold(parameters[j], gradient(j))).collect();
        let free =
            Mat::from_fn(
                jacobian.nrows(),
                jacobian.ncols(),
                |i, j| {
                    if held[j] { 0.0 } else { jacobian[(i, j)] }
                },
            );
        let scale: Vec<f64> = lengths(&jacobian).iter().zip(scale).map(|(l, s)| l.max(s)).collect();
        let divisors = scale.iter().map(|s| if *s > 0.0 { *s } else { 1.0 }).collect();
        let sum = sum_of_squares(&residuals);
        let decomposed = Decomposed::with_scale(&free, divisors).filter(|_| sum.is_finite());
        let decomposed = decomposed.ok_or(FitError::NotFinite)?;
        let projected = decomposed.projected(&residuals);
        Ok(Self { parameters, residuals, sum, jacobian, held, decomposed, projected, scale, iterations })
    }

    /// `|U^T r|` over the directions that the data see.
    fn distance(&self) -> f64 {
        self.projected[..self.decomposed.rank()].iter().map(|b| b * b).sum::<f64>().sqrt()
    }

    /// Standard deviation of the residuals.
    fn spread(&self) -> f64 {
        let freedoms = self.residuals.len().saturating_sub(self.parameters.len()).max(1);
        (self.sum / freedoms as f64).sqrt()
    }

    fn trial(&self, damping: f64, bounds: &[Bounds]) -> Trial {
        let step = self.decomposed.step(&self.projected, damping);
        let moved = self.parameters.iter().zip(&step).zip(bounds);
        let parameters: Vec<f64> = moved.map(|((p, d), bounds)| bounds.clamp(p + d)).collect();
        let mut pairs = parameters.iter().zip(&self.parameters);
        let is_rounding = pairs.all(|(new, old)| (new - old).abs() <= ROUNDING * old.abs());
        Trial { parameters, predicted: self.decomposed.predicted(&self.projected, damping), is_rounding }
    }

    fn end(self, end: FitEnd) -> Fit {
        Fit {
            parameters: self.parameters,
            residuals: self.residuals,
            jacobian: self.jacobian,
            at_bound: self.held,
            iterations: self.iterations,
            end,
        }
    }
}

pub(crate) fn sum_of_squares(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}
