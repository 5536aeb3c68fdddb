//! Fixed-interface modes with constraint modes (Craig and Bampton).
//!
//! The interface points `p = W^T x` are held for the modes `Phi_k`: of each condition `w . x = 0` one
//! coordinate is expressed by the others. The constraint modes follow from the static answers `X = K^-1
//! W` to unit forces: `Psi = X (W^T X)^-1` moves one point by one and no other. In the basis `[Phi_k
//! Psi]` the stiffness is `diag(w_k^2)` and `(W^T X)^-1`, without coupling.
//!
//! # Source
//! R. Craig, M. Bampton, AIAA J. 6 (1968), 1313-1319.

use std::{collections::BTreeMap, f64::consts::TAU};

use faer::{Mat, Side};

use super::{constraints::Dependent, factor::Pencil, map::CoordinateMap, statics::Statics, vectors::dot};
use crate::{StructureError, modes::Modes};

/// Modes of a reduced structure.
pub(super) struct FixedInterfaceModes {
    /// `w` [rad/s].
    pub frequencies: Vec<f64>,
    /// Shapes over the free coordinates.
    pub shapes: Mat<f64>,
    /// Frequencies [Hz] of the fixed-interface modes that were kept.
    pub kept_hz: Vec<f64>,
}

/// What is reduced.
pub(super) struct FixedInterface<'a> {
    /// The supported structure.
    pub pencil: &'a Pencil,
    /// Its static answers, no rigid-body mode among them.
    pub statics: &'a Statics<'a>,
    /// Interface points, weights over the free coordinates.
    pub loads: Vec<Vec<f64>>,
    /// Highest frequency kept [Hz].
    pub cut_off_hz: f64,
    /// Relative error of the entries of the stiffness.
    pub precision: f64,
}

/// Constraint modes, a row each, made orthonormal in `K`: `Psi L = X L^-T` with the flexibility `F = W^T X
/// = L L^T` of the interface, since `Psi^T K Psi = F^-1`.
///
/// # Errors
/// Points that depend on one another.
pub(super) fn constraint_modes(
    statics: &Statics<'_>,
    loads: &[Vec<f64>],
    size: usize,
) -> Result<Mat<f64>, StructureError> {
    let answers: Vec<Vec<f64>> = loads.iter().map(|load| statics.elastic(load)).collect();
    let count = loads.len();
    let flexibility = Mat::from_fn(count, count, |i, j| dot(&loads[i], &answers[j]));
    let dependent = |_| StructureError::DependentInterface;
    let factored = flexibility.llt(Side::Lower).map_err(dependent)?;
    let mut constraint = Mat::from_fn(count, size, |i, row| answers[i][row]);
    factored.L().solve_lower_triangular_in_place(constraint.as_mut());
    Ok(constraint)
}

impl FixedInterface<'_> {
    /// The modes of the reduced structure.
    ///
    /// # Errors
    /// The pencil of the held structure has no factors, points depend on one another, nothing is below the
    /// cut-off.
    pub fn modes(&self) -> Result<FixedInterfaceModes, StructureError> {
        let size = self.pencil.size();
        let (held, map) = self.held_modes()?;
        let count = self.loads.len();
        let constraint = constraint_modes(self.statics, &self.loads, size)?;
        let kept = held.frequencies.len();
        let mapped = Mat::from_fn(size, kept, |row, mode| {
            map.row(row).map(|(column, weight)| weight * held.shapes[(column, mode)]).sum::<f64>()
        });
        let basis = Mat::from_fn(size, kept + count, |row, column| match column.checked_sub(kept) {
            None => mapped[(row, column)],
            Some(which) => constraint[(which, row)],
        });
        let strains = Mat::from_fn(kept + count, kept + count, |row, column| match row == column {
            true => held.frequencies.get(row).copied().unwrap_or(1.0),
            false => 0.0,
        });
        let mass = basis.transpose() * self.pencil.mass.times_columns(basis.as_ref());
        let mass = Mat::from_fn(kept + count, kept + count, |i, j| 0.5 * (mass[(i, j)] + mass[(j, i)]));
        let modes = Modes::of(strains.as_ref(), mass.as_ref())?;
        Ok(FixedInterfaceModes {
            frequencies: modes.frequencies,
            shapes: basis * modes.shapes,
            kept_hz: held.frequencies.iter().map(|w| w / TAU).collect(),
        })
    }

    /// Modes with the interface held, and the map from their coordinates.
    fn held_modes(&self) -> Result<(super::pencil_modes::PencilModes, CoordinateMap), StructureError> {
        let size = self.pencil.size();
        let condition = |load: &Vec<f64>| -> BTreeMap<usize, f64> {
            load.iter().copied().enumerate().filter(|(_, weight)| *weight != 0.0).collect()
        };
        let dependent = Dependent::of(self.loads.iter().map(condition).collect(), |_| true);
        let free: Vec<usize> = (0..size).filter(|row| !dependent.expressions.contains_key(row)).collect();
        let mut place = vec![0; size];
        free.iter().enumerate().for_each(|(column, &row)| place[row] = column);
        let mut map = CoordinateMap::new(free.len());
        for row in 0..size {
            match dependent.expressions.get(&row) {
                None => map.push([(place[row], 1.0)]),
                Some(expression) => {
                    map.push(expression.iter().map(|(&other, &factor)| (place[other], factor)));
                }
            }
        }
        let held = Pencil::new(
            map.congruence(&self.pencil.stiffness),
            map.congruence(&self.pencil.mass),
            self.pencil.beside(),
        )?;
        let modes = held.modes(self.cut_off_hz, self.precision)?;
        Ok((modes, map))
    }
}
