//! What the data leave open: directions in the space of parameters.
//!
//! Two scalings of the Jacobian at the best parameters `p*`, two questions.
//!
//! **Left open.** In relative parameters (`J diag(p*)`) the k-th right singular vector is a direction of unit
//! length along which the parameters have the standard deviation `sqrt(v)/s_k`. If the interval along it has
//! a half width of more than [`OPEN`], the data do not exclude that the parameters change by so much
//! together: they leave the direction open. The parameters with at least a fifth of the direction's largest
//! part are its parameters. If it is one, the data do not determine it; if there are more, the data do not
//! tell them apart.
//!
//! **Collinear.** With columns of length one, `1/s_k` is the collinearity index of Brun, Reichert and Kunsch:
//! an index of 20 means that a change of one parameter is made up for by the others to within a twentieth of
//! its effect. Beyond [`COLLINEAR`] this is told even if the data are precise enough to tell the parameters
//! apart; it then hangs on that precision, and on the model being right to that precision.
//!
//! # Source
//! Brun, Reichert and Kunsch, Water Resour. Res. 37 (2001), 1015-1030: indices above 10 to 15 are called
//! critical there.

use faer::Mat;

use crate::{
    Fit, Inference,
    jacobian::{Decomposed, RANK},
};

/// Relative half width of an interval along a direction beyond which it counts as left open.
pub const OPEN: f64 = 0.5;
/// Collinearity index beyond which parameters are told to make up for each other.
pub const COLLINEAR: f64 = 15.0;
/// Parts smaller than this, relative to the largest part of a direction, are not named.
const NAMED: f64 = 0.2;

/// A direction in the space of parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// Part of each parameter; of unit length, the largest part positive.
    pub parts: Vec<f64>,
    /// Parameters that it is about, the largest part first.
    pub parameters: Vec<usize>,
    /// Half width of the interval along it in relative parameters, or the collinearity index; infinite where
    /// the data see nothing at all.
    pub measure: f64,
}

/// What the data leave open.
#[derive(Debug, Clone, PartialEq)]
pub struct Identifiability {
    /// Singular values of the Jacobian in relative parameters, in standard deviations of the data; largest
    /// first.
    pub singular_values: Vec<f64>,
    /// Collinearity index of all parameters together; infinite where they are dependent.
    pub collinearity_index: f64,
    /// Directions left open; the measure is the half width of the interval. Empty without a variance.
    pub open: Vec<Direction>,
    /// Collinear directions that are not left open; the measure is the index.
    pub collinear: Vec<Direction>,
}

impl Identifiability {
    /// From a fit.
    ///
    /// * `typical`: a size of each parameter, for relative changes; that of the best value, where it is not
    ///   zero.
    #[must_use]
    pub fn of(fit: &Fit, inference: &Inference, typical: &[f64]) -> Self {
        let free: Vec<usize> = (0..fit.parameters.len()).filter(|j| !fit.at_bound[*j]).collect();
        let columns = |scale: &dyn Fn(usize) -> f64| {
            Mat::from_fn(fit.residuals.len(), free.len(), |i, j| fit.jacobian[(i, free[j])] * scale(free[j]))
        };
        let relative = columns(&|j| typical[j].abs());
        let deviation = inference.variance.map_or(f64::NAN, f64::sqrt) * inference.quantile;
        let all = fit.parameters.len();
        let directions = |decomposed: &Decomposed, factor: f64| -> Vec<Direction> {
            let of = |k: usize| direction(decomposed, k, &free, all, factor);
            (0..free.len()).map(of).collect()
        };
        let (mut singular_values, mut open) = (Vec::new(), Vec::new());
        let ones = vec![1.0; free.len()];
        if let Some(decomposed) = Decomposed::with_scale(&square(&relative), ones) {
            singular_values.clone_from(&decomposed.singular);
            open = directions(&decomposed, deviation);
            open.retain(|direction| direction.measure > OPEN);
        }
        let mut collinear = Decomposed::with_unit_columns(&square(&relative))
            .map_or_else(Vec::new, |decomposed| directions(&decomposed, 1.0));
        let collinearity_index = collinear.iter().map(|direction| direction.measure).fold(0.0, f64::max);
        let same = |direction: &Direction| {
            let named = |other: &Direction| direction.parameters.iter().all(|j| other.parameters.contains(j));
            open.iter().any(named)
        };
        collinear.retain(|direction| direction.measure > COLLINEAR && direction.parameters.len() > 1);
        collinear.retain(|direction| !same(direction));
        Self { singular_values, collinearity_index, open, collinear }
    }
}

/// With rows of zeros, so that there are at least as many singular values as parameters.
fn square(jacobian: &Mat<f64>) -> Mat<f64> {
    let rows = jacobian.nrows().max(jacobian.ncols());
    Mat::from_fn(rows, jacobian.ncols(), |i, j| if i < jacobian.nrows() { jacobian[(i, j)] } else { 0.0 })
}

fn direction(decomposed: &Decomposed, k: usize, free: &[usize], all: usize, factor: f64) -> Direction {
    let largest = (0..free.len())
        .map(|j| decomposed.part(j, k))
        .fold(0.0_f64, |a, b| if b.abs() > a.abs() * (1.0 + 1e-9) { b } else { a });
    let sign = if largest < 0.0 { -1.0 } else { 1.0 };
    let mut parts = vec![0.0; all];
    for (j, parameter) in free.iter().enumerate() {
        parts[*parameter] = sign * decomposed.part(j, k);
    }
    let mut parameters: Vec<usize> =
        free.iter().copied().filter(|j| parts[*j].abs() >= NAMED * largest.abs()).collect();
    parameters.sort_by(|a, b| parts[*b].abs().total_cmp(&parts[*a].abs()));
    let (s, most) = (decomposed.singular[k], decomposed.singular[0]);
    let measure = if s > RANK * most { factor / s } else { f64::INFINITY };
    Direction { parts, parameters, measure }
}
