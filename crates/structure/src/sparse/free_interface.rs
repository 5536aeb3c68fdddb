//! Free-interface modes with residual flexibility, after Rubin; without the inertia of the residual modes,
//! after MacNeal.
//!
//! The basis `T = [Phi_k Psi]` has the kept modes and, for each interface load, what the deleted modes answer
//! to it, made orthonormal in `K`. In it `K` is `diag(w_k^2, 1)` and `M` is `diag(1, H)`, `H = Psi^T M Psi`.
//! Free supports are prescribed again by `c p = u`, as for beams. A support of which the matrices hold
//! nothing cannot be let go: the basis then is that of the structure on it. An interface row without mass
//! may leave a `Psi` without inertia: its eigenvalue of `H` is then raised, which puts a mode far above the
//! cut-off and keeps the static flexibility as it is. MacNeal neglects all of `H`: then all of it is what
//! is raised.
//!
//! # Source
//! S. Rubin, AIAA J. 13 (1975), 995-1006; R. MacNeal, Computers and Structures 1 (1971), 581-601.

use std::f64::consts::TAU;

use faer::{Mat, MatRef, Side};

use super::{
    SymmetricMatrix,
    factor::Pencil,
    map::CoordinateMap,
    pencil_modes::PencilModes,
    prepared::{Prepared, ReducedModes, Weights, dense, ensure_elastic, over_all},
    statics::Statics,
    vectors::{add, dot},
};
use crate::{
    StructureError,
    modes::Modes,
    reduction::{FAR_ABOVE, ResidualInertia},
};

/// A residual mode is dropped if this part of it or less is not spanned by those already taken.
const DEPENDENT: f64 = 1e-8;
/// A residual mode whose flexibility is this part or less of what the load meets in all is nothing.
const NOTHING: f64 = 1e-10;

/// What is reduced.
pub(super) struct FreeInterfaceReduction<'a> {
    pub prepared: &'a Prepared,
    /// Modes of the supported structure up to the cut-off, and its static answers.
    pub full: &'a PencilModes,
    pub statics: &'a Statics<'a>,
    /// Highest frequency kept [Hz].
    pub cut_off_hz: f64,
    pub inertia: ResidualInertia,
}

impl FreeInterfaceReduction<'_> {
    /// The modes of the reduced structure.
    ///
    /// * `loads`: names and weights of the interface points.
    pub fn modes(&self, loads: &[(String, Weights)]) -> Result<ReducedModes, StructureError> {
        let Self { prepared, full, statics, cut_off_hz, inertia } = *self;
        let (free, all) = (prepared.assembled.free, prepared.assembled.map.columns());
        let chosen = self.free_and_released();
        if free == chosen.len() || !cut_off_hz.is_finite() {
            ensure_elastic(&prepared.supported, full, cut_off_hz)?;
            let basis = Basis::new(&prepared.supported, full, statics, &loads_over(loads, free), inertia);
            let (frequencies, shapes) = basis.modes(&[])?;
            let kept_hz = full.frequencies.iter().map(|w| w / TAU).collect();
            return Ok(ReducedModes { frequencies, shapes: over_all(&shapes, all), kept_hz });
        }
        let selected = CoordinateMap::selecting(all, &chosen);
        let of_chosen = |matrix: &SymmetricMatrix| selected.congruence(matrix);
        let (stiffness, mass) = (&prepared.assembled.stiffness, &prepared.assembled.mass);
        let released = Pencil::new(of_chosen(stiffness), of_chosen(mass), prepared.supported.beside())?;
        let (modes, factors) = prepared.modes(&released, cut_off_hz, prepared.assembled.joined.precision)?;
        ensure_elastic(&released, &modes, cut_off_hz)?;
        let statics = Statics::new(&released, &modes, factors);
        let prescribed: Vec<usize> = (free..chosen.len()).collect();
        let mut loads = loads_over(loads, all);
        for load in &mut loads {
            *load = chosen.iter().map(|&column| load[column]).collect();
        }
        let unit =
            |column: usize| (0..chosen.len()).map(|row| if row == column { 1.0 } else { 0.0 }).collect();
        let loads: Vec<Vec<f64>> = prescribed.iter().map(|&column| unit(column)).chain(loads).collect();
        let basis = Basis::new(&released, &modes, &statics, &loads, inertia);
        let (frequencies, shapes) = basis.modes(&prescribed)?;
        let kept_hz = modes.frequencies.iter().map(|w| w / TAU).collect();
        // Prescribed rows are zero, and so are those of supports that could not be let go.
        let shapes = over_all(&shapes.subrows(0, free).to_owned(), all);
        Ok(ReducedModes { frequencies, shapes, kept_hz })
    }

    /// The free coordinates, then those of supports that the matrices know: a column of zeros is no support
    /// that can be let go.
    fn free_and_released(&self) -> Vec<usize> {
        let assembled = &self.prepared.assembled;
        let (stiff, heavy) = (assembled.stiffness.occupied(), assembled.mass.occupied());
        let all = assembled.map.columns();
        (0..all).filter(|&column| column < assembled.free || stiff[column] || heavy[column]).collect()
    }
}

/// Interface loads over so many coordinates.
fn loads_over(loads: &[(String, Weights)], size: usize) -> Vec<Vec<f64>> {
    loads.iter().map(|(_, weights)| dense(weights, size)).collect()
}

/// Kept modes and residual modes, orthonormal in `K`.
struct Basis<'a> {
    frequencies: &'a [f64],
    shapes: &'a Mat<f64>,
    residual: Vec<Vec<f64>>,
    /// `H`.
    inertia: Mat<f64>,
}

impl<'a> Basis<'a> {
    fn new(
        pencil: &'a Pencil,
        modes: &'a PencilModes,
        statics: &Statics<'_>,
        loads: &[Vec<f64>],
        inertia: ResidualInertia,
    ) -> Self {
        let mut residual: Vec<Vec<f64>> = Vec::new();
        let mut bent: Vec<Vec<f64>> = Vec::new();
        // Where all modes are kept and all coordinates have mass, nothing is left to answer.
        let is_whole = modes.frequencies.len() == pencil.size();
        for load in loads.iter().filter(|_| !is_whole) {
            let mut answer = statics.deleted(load);
            let own = dot(load, &answer);
            if own <= NOTHING * dot(load, &statics.elastic(load)).abs() {
                continue;
            }
            for _ in 0..2 {
                for (other, bent) in residual.iter().zip(&bent) {
                    let along = dot(bent, &answer);
                    add(&mut answer, -along, other);
                }
            }
            let forces = pencil.stiffness.times(&answer);
            let left = dot(&answer, &forces);
            if left > DEPENDENT * DEPENDENT * own {
                let length = left.sqrt();
                residual.push(answer.iter().map(|entry| entry / length).collect());
                bent.push(forces.iter().map(|entry| entry / length).collect());
            }
        }
        let heavy: Vec<Vec<f64>> = match inertia {
            ResidualInertia::Kept => residual.iter().map(|shape| pencil.mass.times(shape)).collect(),
            ResidualInertia::Neglected => vec![vec![0.0; pencil.size()]; residual.len()],
        };
        let inertia = Mat::from_fn(residual.len(), residual.len(), |i, j| {
            0.5 * (dot(&residual[i], &heavy[j]) + dot(&residual[j], &heavy[i]))
        });
        let highest = modes.frequencies.last().copied().unwrap_or(0.0);
        let inertia = raised(inertia, (FAR_ABOVE * highest).powi(-2));
        Self { frequencies: &modes.frequencies, shapes: &modes.shapes, residual, inertia }
    }

    /// Frequencies and shapes of the reduced structure, some rows prescribed to be zero.
    fn modes(&self, prescribed: &[usize]) -> Result<(Vec<f64>, Mat<f64>), StructureError> {
        let (kept, rows) = (self.frequencies.len(), self.shapes.nrows());
        let size = kept + self.residual.len();
        let basis = Mat::from_fn(rows, size, |row, column| match column.checked_sub(kept) {
            None => self.shapes[(row, column)],
            Some(which) => self.residual[which][row],
        });
        if prescribed.is_empty() && self.residual.is_empty() {
            return Ok((self.frequencies.to_vec(), basis));
        }
        let allowed = null_space(basis.as_ref(), prescribed);
        let strains = Mat::from_fn(size, allowed.ncols(), |row, column| {
            allowed[(row, column)] * self.frequencies.get(row).copied().unwrap_or(1.0)
        });
        let mut mass = Mat::<f64>::identity(size, size);
        mass.as_mut().submatrix_mut(kept, kept, size - kept, size - kept).copy_from(&self.inertia);
        let mass = allowed.transpose() * mass * &allowed;
        let modes = Modes::of(strains.as_ref(), mass.as_ref())?;
        Ok((modes.frequencies, basis * (allowed * modes.shapes)))
    }
}

/// Eigenvalues below `least` raised to it.
fn raised(matrix: Mat<f64>, least: f64) -> Mat<f64> {
    if matrix.nrows() == 0 || !least.is_finite() {
        return matrix;
    }
    let Ok(eigen) = matrix.self_adjoint_eigen(Side::Lower) else { return matrix };
    let values = eigen.S().column_vector();
    if values.iter().all(|value| *value >= least) {
        return matrix;
    }
    let scaled =
        Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| eigen.U()[(i, j)] * values[j].max(least));
    scaled * eigen.U().transpose()
}

/// Orthonormal columns `N` with `c N = 0`, `c` the prescribed rows of a basis.
fn null_space(basis: MatRef<'_, f64>, prescribed: &[usize]) -> Mat<f64> {
    let size = basis.ncols();
    let held = prescribed.len().min(size);
    if held == 0 {
        return Mat::identity(size, size);
    }
    let length = |row: usize| basis.row(row).norm_l2().max(f64::MIN_POSITIVE);
    let rows = Mat::from_fn(size, held, |i, j| basis[(prescribed[j], i)] / length(prescribed[j]));
    rows.qr().compute_Q().subcols(held, size - held).to_owned()
}
