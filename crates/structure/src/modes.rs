//! Undamped eigenmodes, accurate from the first to the last.
//!
//! `K phi = w^2 M phi` with `K = G^T G` and `M = L L^T` is the singular value problem
//! `G L^-T = U S V^T`, `w = S`, `Phi = L^-T V`, `G phi_i = w_i u_i`. Its relative error in `w_i` is about
//! `eps w_max / w_i`; that of the eigenvalue problem with an assembled `K` is the square of the spread,
//! `eps (w_max / w_i)^2`, which spoils the low modes of a fine mesh.

use std::f64::consts::TAU;

use faer::{Mat, MatRef, Side};

use crate::{
    StructureError,
    assembly::{Assembly, times},
};

/// Modes whose frequency is below this part of the highest one are rigid-body modes.
///
/// Rounding leaves about `1e-15`; the first elastic mode of 1000 elements stands at `4e-8`.
const RIGID: f64 = 1e-12;

/// Mass-normalised modes: `Phi^T M Phi = 1`, `Phi^T K Phi = diag(w^2)`.
#[derive(Debug, Clone)]
pub(crate) struct Modes {
    /// `w` [rad/s], ascending; rigid-body modes exactly 0.0.
    pub frequencies: Vec<f64>,
    /// `Phi`, one column a mode [kg^-1/2].
    pub shapes: Mat<f64>,
    /// `U`, orthonormal strains of the modes, one column a mode.
    strains: Mat<f64>,
}

impl Modes {
    /// Modes of a structure over some of its coordinates, the others held.
    pub fn over(assembly: &Assembly, coordinates: &[usize]) -> Result<Self, StructureError> {
        let size = coordinates.len();
        let mass = Mat::from_fn(size, size, |i, j| assembly.mass[(coordinates[i], coordinates[j])]);
        Self::of(assembly.stiffness.columns(coordinates).as_ref(), mass.as_ref())
    }

    /// Modes of `K = G^T G` and `M`.
    ///
    /// * `strains`: `G`, any number of rows.
    /// * `mass`: `M`, symmetric positive definite.
    ///
    /// # Errors
    /// `M` is not positive definite, or the iteration fails.
    pub fn of(strains: MatRef<'_, f64>, mass: MatRef<'_, f64>) -> Result<Self, StructureError> {
        let size = mass.nrows();
        let cholesky = mass.llt(Side::Lower).map_err(|_| StructureError::MassNotPositive { size })?;
        let rows = strains.nrows();
        let mut scaled = strains.transpose().to_owned();
        cholesky.L().solve_lower_triangular_in_place(scaled.as_mut());
        let tall = Mat::from_fn(rows.max(size), size, |i, j| if i < rows { scaled[(j, i)] } else { 0.0 });
        let values = tall.thin_svd().map_err(|_| StructureError::ModesNotConverged { size })?;
        let mut shapes = values.V().reverse_cols().to_owned();
        cholesky.L().transpose().solve_upper_triangular_in_place(shapes.as_mut());
        let ascending = values.S().column_vector().iter().rev().copied();
        Ok(Self {
            frequencies: rigid_exactly_zero(ascending.collect()),
            shapes,
            strains: values.U().reverse_cols().subrows(0, rows).to_owned(),
        })
    }

    /// Frequencies [Hz].
    pub fn frequencies_hz(&self) -> Vec<f64> {
        self.frequencies.iter().map(|w| w / TAU).collect()
    }

    /// The same, with what is a rigid-body motion of a larger structure with that highest frequency: a
    /// reduced one may have nothing else to measure rounding by.
    pub fn rigid_beside(mut self, highest: f64) -> Self {
        for w in &mut self.frequencies {
            if *w <= RIGID * highest {
                *w = 0.0;
            }
        }
        self
    }

    /// Number of rigid-body modes; they come first.
    pub fn rigid(&self) -> usize {
        self.frequencies.iter().filter(|w| **w == 0.0).count()
    }

    /// Number of modes up to and including a frequency [Hz].
    pub fn up_to(&self, cut_off_hz: f64) -> usize {
        self.frequencies.iter().filter(|w| **w <= TAU * cut_off_hz).count()
    }

    /// Number of modes to keep under a cut-off frequency [Hz], rigid-body modes included.
    ///
    /// # Errors
    /// There are elastic modes, and all lie above the cut-off.
    pub fn kept(&self, cut_off_hz: f64) -> Result<usize, StructureError> {
        let kept = self.up_to(cut_off_hz);
        match self.frequencies.get(self.rigid()) {
            Some(first) if kept <= self.rigid() => {
                Err(StructureError::CutOffBelowFirstMode { cut_off_hz, first_hz: first / TAU })
            }
            _ => Ok(kept),
        }
    }

    /// The motion without rigid-body part that best undoes given strains: `x = -sum_i phi_i (u_i . s) / w_i`.
    ///
    /// `min |G x + s|`, that is `x = -K^+ G^T s`; one column of the answer for each of `strains`.
    pub fn relief_of_strains(&self, strains: MatRef<'_, f64>) -> Mat<f64> {
        let mut weights = self.strains.transpose() * strains;
        for mode in 0..weights.nrows() {
            let w = self.frequencies[mode];
            let factor = if w > 0.0 { -1.0 / w } else { 0.0 };
            weights.row_mut(mode).iter_mut().for_each(|weight| *weight *= factor);
        }
        &self.shapes * weights
    }

    /// Displacements under constant forces: `y = sum_i phi_i (phi_i . f) / w_i^2`.
    ///
    /// # Errors
    /// The forces drive a rigid-body mode.
    pub fn static_answer(&self, load: &[f64]) -> Result<Vec<f64>, StructureError> {
        let modal: Vec<f64> = (0..self.frequencies.len())
            .map(|mode| self.shapes.col(mode).iter().zip(load).map(|(shape, force)| shape * force).sum())
            .collect();
        let amplitudes = static_amplitudes(&self.frequencies, &modal)?;
        Ok(times(&self.shapes, &amplitudes))
    }
}

/// Modal amplitudes `m_i / w_i^2` under constant modal loads `m`.
///
/// # Errors
/// A rigid-body mode is driven, by more than rounding (`1e-9` of the largest load).
pub(crate) fn static_amplitudes(frequencies: &[f64], loads: &[f64]) -> Result<Vec<f64>, StructureError> {
    let largest = loads.iter().fold(0.0_f64, |largest, load| largest.max(load.abs()));
    let amplitude = |mode: usize, w: f64, load: f64| match w {
        w if w > 0.0 => Ok(load / (w * w)),
        _ if load.abs() <= 1e-9 * largest => Ok(0.0),
        _ => Err(StructureError::RigidBodyModeNotRestrained { mode: mode + 1 }),
    };
    frequencies.iter().zip(loads).enumerate().map(|(mode, (&w, &load))| amplitude(mode, w, load)).collect()
}

fn rigid_exactly_zero(mut frequencies: Vec<f64>) -> Vec<f64> {
    let highest = frequencies.last().copied().unwrap_or(0.0);
    for w in &mut frequencies {
        if *w <= RIGID * highest {
            *w = 0.0;
        }
    }
    frequencies
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::strain::Strains;

    /// Three masses in a chain with two springs, floating.
    fn chain() -> (Mat<f64>, Mat<f64>) {
        let mut strains = Strains::default();
        strains.connect(2.0, 0, Some(1));
        strains.connect(3.0, 1, Some(2));
        let mass = Mat::from_fn(3, 3, |i, j| if i == j { 1.0 + i as f64 } else { 0.0 });
        (strains.columns(&[0, 1, 2]), mass)
    }

    #[test]
    fn modes_diagonalise_mass_and_stiffness() {
        let (strains, mass) = chain();
        let modes = Modes::of(strains.as_ref(), mass.as_ref()).unwrap();
        let unit = modes.shapes.transpose() * &mass * &modes.shapes;
        let bent = &strains * &modes.shapes;
        let squares = bent.transpose() * &bent;
        for i in 0..3 {
            for j in 0..3 {
                let same = if i == j { 1.0 } else { 0.0 };
                assert!((unit[(i, j)] - same).abs() < 1e-14);
                assert!((squares[(i, j)] - same * modes.frequencies[i].powi(2)).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn floating_chain_has_one_rigid_body_mode_at_exactly_zero() {
        let (strains, mass) = chain();
        let modes = Modes::of(strains.as_ref(), mass.as_ref()).unwrap();
        assert_eq!((modes.rigid(), modes.frequencies[0]), (1, 0.0));
        assert_relative_eq!(modes.shapes[(0, 0)].abs(), 1.0 / 6.0_f64.sqrt(), max_relative = 1e-14);
    }

    #[test]
    fn balanced_forces_have_a_static_answer_and_others_drive_the_rigid_body() {
        let (strains, mass) = chain();
        let modes = Modes::of(strains.as_ref(), mass.as_ref()).unwrap();
        let answer = modes.static_answer(&[-1.0, 0.0, 1.0]).unwrap();
        assert_relative_eq!(answer[1] - answer[0], 1.0 / 2.0, max_relative = 1e-13);
        assert_relative_eq!(answer[2] - answer[1], 1.0 / 3.0, max_relative = 1e-13);
        assert_eq!(
            modes.static_answer(&[1.0, 0.0, 0.0]),
            Err(StructureError::RigidBodyModeNotRestrained { mode: 1 })
        );
    }

    #[test]
    fn negative_mass_is_refused() {
        let mass = Mat::from_fn(1, 1, |_, _| -1.0);
        let error = Modes::of(Mat::zeros(1, 1).as_ref(), mass.as_ref()).unwrap_err();
        assert_eq!(error, StructureError::MassNotPositive { size: 1 });
    }
}
