//! Directions in the space of parameters that the data do not determine.
//!
//! Two scalings of the Jacobian at the best parameters `p*` answer two questions.
//!
//! **Undetermined.** In relative parameters (`J diag(p*)`) the k-th right singular vector is a direction of
//! unit length along which the parameters have the standard deviation `sqrt(v)/s_k`. If the interval along it
//! has a half width above [`UNDETERMINED`], the data do not exclude a joint change of that size: the
//! direction is undetermined. Its parameters are those with at least a fifth of its largest component. If it
//! has one, the data do not determine that parameter; if it has several, the data do not distinguish them.
//!
//! **Collinear.** With columns of length one, `1/s_k` is the collinearity index of Brun, Reichert and Kunsch:
//! an index of 20 means that the other parameters compensate a change of one to within a twentieth of its
//! effect. Above [`COLLINEAR`] this is reported even if the data are precise enough to distinguish the
//! parameters: the distinction then depends on that precision, and on the model being accurate to that
//! precision.
//!
//! # Source
//! Brun, Reichert and Kunsch, Water Resour. Res. 37 (2001), 1015-1030: indices above 10 to 15 are called
//! critical there.

use faer::Mat;

use crate::{
    inference::Inference,
    jacobian::{RANK, ScaledJacobian},
    outcome::LeastSquaresFit,
};

/// Relative half width of an interval along a direction above which the direction is undetermined.
pub const UNDETERMINED: f64 = 0.5;
/// Collinearity index above which parameters are reported as collinear.
pub const COLLINEAR: f64 = 15.0;
/// Components smaller than this, relative to the largest one of a direction, are not reported.
const REPORTED: f64 = 0.2;

/// A direction in the space of parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterDirection {
    /// Component of each parameter; of unit length, the largest one positive.
    pub parts: Vec<f64>,
    /// Its parameters, the largest component first.
    pub parameters: Vec<usize>,
    /// Half width of the interval along it in relative parameters, or the collinearity index; infinite if the
    /// data do not depend on it.
    pub measure: f64,
}

/// What the data do and do not determine.
#[derive(Debug, Clone, PartialEq)]
pub struct Identifiability {
    /// Singular values of the Jacobian in relative parameters, in standard deviations of the data; largest
    /// first.
    pub singular_values: Vec<f64>,
    /// Collinearity index of all parameters together; infinite where they are dependent.
    pub collinearity_index: f64,
    /// Undetermined directions; the measure is the half width of the interval. Empty without a variance.
    pub undetermined: Vec<ParameterDirection>,
    /// Collinear directions that are not undetermined; the measure is the index.
    pub collinear: Vec<ParameterDirection>,
}

impl Identifiability {
    /// From a fit.
    ///
    /// * `typical`: typical magnitude of each parameter, for relative changes; the best value unless it is
    ///   zero.
    #[must_use]
    pub fn of(fit: &LeastSquaresFit, inference: &Inference, typical: &[f64]) -> Self {
        let free: Vec<usize> = (0..fit.parameters.len()).filter(|j| !fit.at_bound[*j]).collect();
        let columns = |scale: &dyn Fn(usize) -> f64| {
            Mat::from_fn(fit.residuals.len(), free.len(), |i, j| fit.jacobian[(i, free[j])] * scale(free[j]))
        };
        let relative = columns(&|j| typical[j].abs());
        let deviation = inference.variance.map_or(f64::NAN, f64::sqrt) * inference.quantile;
        let all = fit.parameters.len();
        let directions = |decomposed: &ScaledJacobian, factor: f64| -> Vec<ParameterDirection> {
            let of = |k: usize| direction(decomposed, k, &free, all, factor);
            (0..free.len()).map(of).collect()
        };
        let (mut singular_values, mut undetermined) = (Vec::new(), Vec::new());
        let ones = vec![1.0; free.len()];
        if let Some(decomposed) = ScaledJacobian::with_scale(&padded(&relative), ones) {
            singular_values.clone_from(&decomposed.singular);
            undetermined = directions(&decomposed, deviation);
            undetermined.retain(|direction| direction.measure > UNDETERMINED);
        }
        let mut collinear = ScaledJacobian::with_unit_columns(&padded(&relative))
            .map_or_else(Vec::new, |decomposed| directions(&decomposed, 1.0));
        let collinearity_index = collinear.iter().map(|direction| direction.measure).fold(0.0, f64::max);
        let same = |direction: &ParameterDirection| {
            let named = |other: &ParameterDirection| {
                direction.parameters.iter().all(|j| other.parameters.contains(j))
            };
            undetermined.iter().any(named)
        };
        collinear.retain(|direction| direction.measure > COLLINEAR && direction.parameters.len() > 1);
        collinear.retain(|direction| !same(direction));
        Self { singular_values, collinearity_index, undetermined, collinear }
    }
}

/// The Jacobian with rows of zeros added, so that it has at least as many singular values as parameters.
fn padded(jacobian: &Mat<f64>) -> Mat<f64> {
    let rows = jacobian.nrows().max(jacobian.ncols());
    Mat::from_fn(rows, jacobian.ncols(), |i, j| if i < jacobian.nrows() { jacobian[(i, j)] } else { 0.0 })
}

/// The direction of a singular value.
fn direction(
    decomposed: &ScaledJacobian,
    k: usize,
    free: &[usize],
    all: usize,
    factor: f64,
) -> ParameterDirection {
    let largest = (0..free.len())
        .map(|j| decomposed.part(j, k))
        .fold(0.0_f64, |a, b| if b.abs() > a.abs() * (1.0 + 1e-9) { b } else { a });
    let sign = if largest < 0.0 { -1.0 } else { 1.0 };
    let mut parts = vec![0.0; all];
    for (j, parameter) in free.iter().enumerate() {
        parts[*parameter] = sign * decomposed.part(j, k);
    }
    let mut parameters: Vec<usize> =
        free.iter().copied().filter(|j| parts[*j].abs() >= REPORTED * largest.abs()).collect();
    parameters.sort_by(|a, b| parts[*b].abs().total_cmp(&parts[*a].abs()));
    let (s, most) = (decomposed.singular[k], decomposed.singular[0]);
    let measure = if s > RANK * most { factor / s } else { f64::INFINITY };
    ParameterDirection { parts, parameters, measure }
}
