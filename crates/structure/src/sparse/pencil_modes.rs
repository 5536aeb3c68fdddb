//! All modes up to a cut-off frequency, with the proof that none is missed.
//!
//! The pivots of `K - sigma M` count the eigenvalues below a shift (see [`super::factor`]). At a shift below
//! zero there must be none, else `K` is not positive semi-definite; at the cut-off the count says how many
//! modes have to be found. Small structures are solved whole and dense: `K - sigma M = L L^T`, and the
//! eigenvalues `theta` of `L^-1 M L^-T`; those that are zero belong to what has no mass.
//!
//! Two ways lead to an eigenvalue: `1 / theta + sigma`, and `phi^T K phi`. The one is off by the rounding of
//! the largest `theta`, `eps theta_1 / theta^2`, the other by that of `K`, `eps |phi|^T |K| |phi|`; the
//! better one is taken.
//!
//! A mode is a rigid-body one if its eigenvalue is nothing but rounding: entries with a relative error `e`
//! change `phi^T K phi` by `e |phi|^T |K| |phi|` at most.

use std::f64::consts::TAU;

use faer::{Mat, Side};

use super::{
    factor::{Factors, Pencil},
    lanczos::{LowestModes, lowest_modes},
    vectors::dot,
};
use crate::StructureError;

/// Coordinates up to which a structure is solved whole and dense.
pub(crate) const DENSE: usize = 700;
/// Most modes below a cut-off.
const MOST_MODES: usize = 1500;
/// The shift for the modes relative to the square of the cut-off frequency.
const SHIFTS: [f64; 3] = [-0.01, -0.1, -1.0];
/// How many times the rounding of the entries a rigid-body mode may have.
const ROUNDING: f64 = 20.0;
/// `theta` below this part of the largest belongs to what has no mass.
const MASSLESS: f64 = 1e-13;

/// Modes up to a cut-off.
#[derive(Debug, Clone)]
pub(crate) struct PencilModes {
    /// `w` [rad/s], ascending; rigid-body modes exactly 0.0.
    pub frequencies: Vec<f64>,
    /// `Phi`, one column a mode [kg^-1/2].
    pub shapes: Mat<f64>,
    /// The shift below all eigenvalues with which static answers are found [1/s^2].
    pub shift: f64,
}

impl PencilModes {
    /// Number of rigid-body modes; they come first.
    pub fn rigid(&self) -> usize {
        self.frequencies.iter().filter(|w| **w == 0.0).count()
    }
}

impl Pencil {
    /// The modes up to a cut-off frequency, rigid-body modes included.
    ///
    /// * `cut_off_hz`: infinite for all of them, which takes a small structure.
    /// * `precision`: relative error of the entries of `K`, see [`super::MatrixStructure`].
    ///
    /// # Errors
    /// `K` is indefinite, something without mass is not held, or there are too many modes or coordinates.
    pub fn modes(&self, cut_off_hz: f64, precision: f64) -> Result<PencilModes, StructureError> {
        self.modes_and_factors(cut_off_hz, precision).map(|(modes, _)| modes)
    }

    /// The same with the factors at the shift below all eigenvalues.
    pub fn modes_and_factors(
        &self,
        cut_off_hz: f64,
        precision: f64,
    ) -> Result<(PencilModes, Factors<'_>), StructureError> {
        let whole = self.size() <= DENSE;
        if !whole && !cut_off_hz.is_finite() {
            return Err(StructureError::TooManyCoordinates { found: self.size(), allowed: DENSE });
        }
        let square = if cut_off_hz.is_finite() { (TAU * cut_off_hz).powi(2) } else { self.typical_square() };
        // Counted first, so that its factors are gone when those of the search come.
        let count = if whole { Ok(0) } else { self.count_below(square) };
        let (shift, factors) = self.below_all(square)?;
        let found = if whole {
            self.all_modes(shift)?
        } else {
            self.modes_by_lanczos(&factors, shift, (count?, square))?
        };
        let upto = found.values.iter().filter(|value| **value <= (TAU * cut_off_hz).powi(2)).count();
        let shapes = found.shapes.subcols(0, upto).to_owned();
        let largest_theta =
            found.values.iter().fold(0.0_f64, |largest, value| largest.max(1.0 / (value - shift)));
        let frequencies = found.values.iter().enumerate().take(upto).map(|(mode, &value)| {
            let shape = shapes.col_as_slice(mode);
            let of_entries = self.stiffness.absolute_form(shape);
            // Rounding of `theta` spoils what is far above the shift, that of `K` what is far below its norm.
            let of_theta = largest_theta * (value - shift).powi(2);
            let value = if of_entries < of_theta { dot(shape, &self.stiffness.times(shape)) } else { value };
            if value.abs() <= ROUNDING * precision * of_entries { 0.0 } else { value.max(0.0).sqrt() }
        });
        Ok((PencilModes { frequencies: frequencies.collect(), shapes, shift }, factors))
    }

    /// A square of a frequency that the structure may have: a small part of the largest ratio of diagonals.
    pub(super) fn typical_square(&self) -> f64 {
        let ratios = self.stiffness.diagonal().into_iter().zip(self.mass.diagonal());
        let largest = ratios.filter(|(_, m)| *m > 0.0).map(|(k, m)| k / m).fold(0.0, f64::max);
        if largest > 0.0 { 1e-5 * largest } else { 1.0 }
    }

    /// Factors at a shift below all eigenvalues.
    fn below_all(&self, square: f64) -> Result<(f64, Factors<'_>), StructureError> {
        let mut refused = StructureError::StiffnessNotPositive { negative: 0, below_hz: 0.0 };
        for shift in SHIFTS.map(|part| part * square) {
            match self.factors(shift) {
                Err(coordinate) => refused = StructureError::Mechanism { coordinate },
                Ok(factors) => match factors.negative() {
                    0 => return Ok((shift, factors)),
                    negative => {
                        let below_hz = (-shift).sqrt() / TAU;
                        refused = StructureError::StiffnessNotPositive { negative, below_hz };
                    }
                },
            }
        }
        Err(refused)
    }

    /// All modes with mass.
    fn all_modes(&self, shift: f64) -> Result<LowestModes, StructureError> {
        let size = self.size();
        let failed = || StructureError::ModesNotConverged { size };
        let shifted = self.stiffness.dense() - self.mass.dense() * faer::Scale(shift);
        let cholesky = shifted.llt(Side::Lower).map_err(|_| failed())?;
        let mut inner = self.mass.dense();
        cholesky.L().solve_lower_triangular_in_place(inner.as_mut());
        let mut inner = inner.transpose().to_owned();
        cholesky.L().solve_lower_triangular_in_place(inner.as_mut());
        let inner = Mat::from_fn(size, size, |i, j| 0.5 * (inner[(i, j)] + inner[(j, i)]));
        let eigen = inner.self_adjoint_eigen(Side::Lower).map_err(|_| failed())?;
        let theta: Vec<f64> = eigen.S().column_vector().iter().rev().copied().collect();
        let massive = theta.iter().take_while(|&&value| value > MASSLESS * theta[0]).count();
        let mut shapes = eigen.U().reverse_cols().subcols(0, massive).to_owned();
        cholesky.L().transpose().solve_upper_triangular_in_place(shapes.as_mut());
        for column in 0..massive {
            let shape = shapes.col_as_slice_mut(column);
            let size = dot(shape, &self.mass.times(shape)).max(0.0).sqrt();
            shape.iter_mut().for_each(|entry| *entry /= size);
        }
        Ok(LowestModes { values: theta[..massive].iter().map(|value| 1.0 / value + shift).collect(), shapes })
    }

    /// The modes below the square of a cut-off, as many as the pivots there say.
    fn modes_by_lanczos(
        &self,
        factors: &Factors<'_>,
        shift: f64,
        (count, square): (usize, f64),
    ) -> Result<LowestModes, StructureError> {
        let size = self.size();
        if count > MOST_MODES {
            return Err(StructureError::TooManyModes { found: count, allowed: MOST_MODES });
        }
        self.ensure_memory(count)?;
        lowest_modes(factors, &self.mass, shift, (count, square))
            .ok_or(StructureError::ModesNotConverged { size })
    }

    /// Frequency [Hz] of the first mode above those of rigid bodies, if there is one.
    ///
    /// # Errors
    /// The factors or the search fail.
    pub fn first_beyond(&self, rigid: &PencilModes) -> Result<Option<f64>, StructureError> {
        let size = self.size();
        let failed = || StructureError::ModesNotConverged { size };
        let found = if size <= DENSE {
            self.all_modes(rigid.shift)?
        } else {
            let factors = self.factors(rigid.shift).map_err(|_| failed())?;
            lowest_modes(&factors, &self.mass, rigid.shift, (rigid.rigid() + 1, f64::INFINITY))
                .ok_or_else(failed)?
        };
        Ok(found.values.get(rigid.rigid()).map(|value| value.max(0.0).sqrt() / TAU))
    }

    /// Number of eigenvalues below a square of a frequency.
    ///
    /// # Errors
    /// The factors are not reliable there nor a little above.
    pub fn count_below(&self, square: f64) -> Result<usize, StructureError> {
        let beside = [1e-9, 1e-7, 1e-5].into_iter();
        let counted = beside.filter_map(|above| self.factors(square * (1.0 + above)).ok()).next();
        let size = self.size();
        counted.map(|factors| factors.negative()).ok_or(StructureError::ModesNotConverged { size })
    }
}
