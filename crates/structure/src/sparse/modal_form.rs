//! The modal form of a structure of matrices: what its points, supports and dampers are to its modes.

use faer::Mat;

use super::{
    Matrices, SupportRows, SymmetricMatrix,
    assemble::{Assembled, unit},
    prepared::{Prepared, Weights},
    statics::Statics,
    translation::ensure_translation,
    vectors::{add, dot},
};
use crate::{Damping, PointOutput, ReducedModel, StructureError, SupportInput};

/// `Gamma_s` over the free coordinates, and 1 at its support: a column each.
pub(super) fn support_shapes(
    matrices: &Matrices,
    prepared: &Prepared,
    moving: &[&[&str]],
    statics: &Statics<'_>,
) -> Result<Mat<f64>, StructureError> {
    let (free, all) = (prepared.assembled.free, prepared.assembled.map.columns());
    let mut shapes = Mat::zeros(all, moving.len());
    for (number, names) in moving.iter().enumerate() {
        let supports = || matrices.supports.iter().filter(|support| names.contains(&support.name.as_str()));
        let base = supports().find(|support| support.rows == SupportRows::Base);
        let Some(support) = base.or_else(|| supports().next()) else { continue };
        let along = unit(&support.along, &format!("the direction of support \"{}\"", support.name))?;
        let translation = match (&support.rows, prepared.assembled.joined.translation(along)) {
            (SupportRows::Of(_), Err(_)) => vec![0.0; prepared.assembled.map.rows()],
            (_, translation) => translation?,
        };
        let mut shape = prepared.assembled.of_rows(&translation);
        if support.rows != SupportRows::Base {
            let share = 1.0 / moving.len() as f64;
            shape[..free].iter_mut().for_each(|entry| *entry *= share);
            shape[free..].fill(0.0);
            shape[free + number] = 1.0;
            let forces = prepared.assembled.stiffness.times(&shape);
            let relief = statics.elastic(&forces[..free]);
            add(&mut shape[..free], -1.0, &relief);
        } else {
            ensure_translation(matrices, &prepared.assembled.joined)?;
            shape[free..].fill(0.0);
            shape[free + number] = 1.0;
        }
        shapes.col_mut(number).iter_mut().zip(shape).for_each(|(to, from)| *to = from);
    }
    Ok(shapes)
}

/// The modal form over these modes.
pub(super) fn modal_form(
    matrices: &Matrices,
    prepared: &Prepared,
    frequencies: Vec<f64>,
    shapes: &Mat<f64>,
    support_shapes: &Mat<f64>,
    damping: &Damping,
) -> Result<ReducedModel, StructureError> {
    let Prepared { assembled, points, .. } = prepared;
    let damped = assembled.damping.as_ref().map(|matrix| matrix.times_columns(shapes.as_ref()));
    let product = damped
        .as_ref()
        .map_or_else(|| Mat::zeros(shapes.ncols(), shapes.ncols()), |damped| shapes.transpose() * damped);
    let damping = damping.matrix_with(&frequencies, product.as_ref())?;
    let output = |(name, weights): &(String, Weights)| PointOutput {
        name: name.clone(),
        shape: weighted(weights, shapes),
        support_ratios: weighted(weights, support_shapes),
    };
    let input = |number: usize| {
        let shape = support_shapes.col_as_slice(number);
        let moves_rows = (0..assembled.free).any(|row| assembled.is_coupled(row, assembled.free + number));
        SupportInput {
            inertia: projected(shapes, &assembled.mass.times(shape)),
            // A structure that follows its base as a whole does not move against its dampers.
            damping: match &assembled.damping {
                Some(matrix) if moves_rows => projected(shapes, &matrix.times(shape)),
                _ => vec![0.0; shapes.ncols()],
            },
        }
    };
    let uniform = match matrices.acceleration {
        Some(along) => {
            let along = unit(&along, "the direction of the acceleration")?;
            ensure_translation(matrices, &assembled.joined)?;
            let motion = assembled.of_rows(&assembled.joined.translation(along)?);
            projected(shapes, &assembled.mass.times(&motion))
        }
        None => vec![0.0; shapes.ncols()],
    };
    let model = ReducedModel {
        points: points.iter().map(output).collect(),
        supports: (0..support_shapes.ncols()).map(input).collect(),
        natural_frequencies: frequencies,
        damping,
        uniform_acceleration: uniform,
    };
    crate::reduce::check_finite(&model).map(|()| model)
}

impl Assembled {
    /// The coordinates x of a motion of all rows: what each stands for by itself.
    pub(super) fn of_rows(&self, motion: &[f64]) -> Vec<f64> {
        let mut coordinates = vec![0.0; self.map.columns()];
        for (row, value) in motion.iter().enumerate() {
            let mut terms = self.map.row(row);
            if let (Some((column, weight)), None) = (terms.next(), terms.next())
                && weight == 1.0
            {
                coordinates[column] = *value;
            }
        }
        coordinates
    }

    /// Whether stiffness, mass or damping joins two coordinates.
    pub(super) fn is_coupled(&self, row: usize, column: usize) -> bool {
        let joins = |matrix: &SymmetricMatrix| {
            matrix.column(row.min(column)).any(|(place, _)| place == row.max(column))
        };
        joins(&self.stiffness) || self.damping.as_ref().is_some_and(joins)
    }
}

fn weighted(weights: &Weights, columns: &Mat<f64>) -> Vec<f64> {
    columns.col_iter().map(|column| weights.iter().map(|&(row, weight)| weight * column[row]).sum()).collect()
}

/// `Phi^T v`.
fn projected(shapes: &Mat<f64>, vector: &[f64]) -> Vec<f64> {
    (0..shapes.ncols()).map(|column| dot(shapes.col_as_slice(column), vector)).collect()
}
