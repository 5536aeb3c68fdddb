//! The state of a search for the best parameters.

use faer::Mat;

use crate::{
    jacobian::{ScaledJacobian, lengths},
    outcome::{FitEnd, FitError, LeastSquaresFit},
    problem::{Bounds, FitProblem},
};

/// Steps smaller than this part of each parameter are rounding.
const ROUNDING: f64 = 1e-14;

/// A step of the search.
pub(crate) struct Trial {
    pub(crate) parameters: Vec<f64>,
    /// Reduction of the sum of squares by the linear model.
    pub(crate) predicted: f64,
    /// Whether the step is no larger than rounding.
    pub(crate) is_rounding: bool,
}

/// The current parameters of a search, with the model and its Jacobian there.
pub(crate) struct Search {
    parameters: Vec<f64>,
    residuals: Vec<f64>,
    /// Sum of squares of the residuals.
    pub(crate) sum: f64,
    jacobian: Mat<f64>,
    /// Which parameters are held by a bound.
    held: Vec<bool>,
    decomposed: ScaledJacobian,
    projected: Vec<f64>,
    /// Largest lengths of the columns up to now.
    scale: Vec<f64>,
    pub(crate) iterations: u32,
}

impl Search {
    /// A search at given parameters.
    ///
    /// * `residuals`: those of the parameters.
    /// * `before`: the search at the previous parameters; `None` at the start.
    ///
    /// # Errors
    /// [`FitError::Derivatives`], [`FitError::NotFinite`].
    pub(crate) fn at<P: FitProblem>(
        problem: &mut P,
        parameters: Vec<f64>,
        residuals: Vec<f64>,
        bounds: &[Bounds],
        before: Option<Self>,
    ) -> Result<Self, FitError<P::Error>> {
        let (scale, iterations) = before
            .map_or_else(|| (vec![0.0; parameters.len()], 1), |before| (before.scale, before.iterations + 1));
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
        let decomposed = ScaledJacobian::with_scale(&free, divisors).filter(|_| sum.is_finite());
        let decomposed = decomposed.ok_or(FitError::NotFinite)?;
        let projected = decomposed.projected(&residuals);
        Ok(Self { parameters, residuals, sum, jacobian, held, decomposed, projected, scale, iterations })
    }

    /// `|U^T r|` over the directions that the data determine.
    pub(crate) fn distance(&self) -> f64 {
        self.projected[..self.decomposed.rank()].iter().map(|b| b * b).sum::<f64>().sqrt()
    }

    /// Standard deviation of the residuals.
    pub(crate) fn spread(&self) -> f64 {
        let degrees_of_freedom = self.residuals.len().saturating_sub(self.parameters.len()).max(1);
        (self.sum / degrees_of_freedom as f64).sqrt()
    }

    /// The step with a damping, within the bounds.
    pub(crate) fn trial(&self, damping: f64, bounds: &[Bounds]) -> Trial {
        let step = self.decomposed.step(&self.projected, damping);
        let moved = self.parameters.iter().zip(&step).zip(bounds);
        let parameters: Vec<f64> = moved.map(|((p, d), bounds)| bounds.clamp(p + d)).collect();
        let mut pairs = parameters.iter().zip(&self.parameters);
        let is_rounding = pairs.all(|(new, old)| (new - old).abs() <= ROUNDING * old.abs());
        Trial { parameters, predicted: self.decomposed.predicted(&self.projected, damping), is_rounding }
    }

    /// The fit at the current parameters.
    pub(crate) fn end(self, end: FitEnd) -> LeastSquaresFit {
        LeastSquaresFit {
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
