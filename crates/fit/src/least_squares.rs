//! The method of Levenberg and Marquardt, within bounds.
//!
//! A step is `-(J^T J + mu C^2)^-1 J^T r` over the parameters that no bound holds, with the lengths C of the
//! columns of J; it is clipped at the bounds. The damping `mu` follows the ratio of the actual to the
//! predicted reduction of `chi^2`. The fit has converged when the residuals are orthogonal to the tangent
//! plane: with the singular vectors U of J, `|U^T r|` is the length of the next step of all parameters in
//! standard errors.
//!
//! # Source
//! Marquardt, J. SIAM 11 (1963), 431-441; Nielsen, *Damping parameter in Marquardt's method* (1999), for the
//! damping; Bates and Watts, Technometrics 23 (1981), 179-183, for the criterion.

use crate::{
    outcome::{FitEnd, FitError, LeastSquaresFit, LeastSquaresSettings},
    problem::{Bounds, Deviations, FitProblem},
    search::{Search, sum_of_squares},
};

/// Initial damping, relative to the squared columns.
const FIRST_DAMPING: f64 = 1e-3;
const MIN_DAMPING: f64 = 1e-15;
/// Damping above which no step improves the fit.
const MAX_DAMPING: f64 = 1e12;
/// A fit that no step improves has converged if it is within this many standard errors: only numerical noise
/// of the model remains.
const AT_NOISE: f64 = 1e-2;
/// Fits the parameters, from initial values.
///
/// * `start`: n values, clipped to the bounds.
///
/// # Errors
/// [`FitError`]; a fit that does not converge is a result with that [`FitEnd`].
pub fn fit<P: FitProblem>(
    problem: &mut P,
    start: &[f64],
    bounds: &[Bounds],
    settings: &LeastSquaresSettings,
) -> Result<LeastSquaresFit, FitError<P::Error>> {
    let parameters: Vec<f64> = start.iter().zip(bounds).map(|(value, bounds)| bounds.clamp(*value)).collect();
    let residuals = problem.residuals(&parameters).map_err(|source| FitError::Start { source })?;
    let mut search = Search::at(problem, parameters, residuals, bounds, None)?;
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
            if trial.is_rounding || damping > MAX_DAMPING {
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
                damping = (damping * (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(0.1, 2.0)).max(MIN_DAMPING);
                growth = 2.0;
                search = Search::at(problem, trial.parameters, residuals, bounds, Some(search))?;
                break;
            }
            damping *= growth;
            growth *= 2.0;
        }
    }
}
