//! Free-interface modes with residual flexibility (inertia relief).
//!
//! The component has its interface free: prescribed displacements are let go. With its modes
//! `Phi = [Phi_k Phi_d]`, kept and deleted, the residual flexibility mode of a unit load `e_i` at an
//! interface coordinate is what the deleted modes answer to it statically,
//! `psi_i = Phi_d diag(w_d^-2) Phi_d^T e_i`. Rigid-body modes are always kept, so this is the answer to
//! the load with their inertia relieved. The basis `T = [Phi_k Psi]` holds the exact static answers to
//! all interface loads; prescribing `c p = u` with `c` the rows of `T` at the prescribed coordinates
//! leaves the relative motion `p = N z`, `c N = 0`. MacNeal's form neglects the inertia of `Psi`.
//!
//! # Source
//! Craig, "A review of time-domain and frequency-domain component mode synthesis methods", 1985; Rubin,
//! AIAA J. 13 (1975), 995-1006, whose residual modes these are, first order; MacNeal, Computers and
//! Structures 1 (1971), 581-601.

use faer::{Mat, MatRef};

use super::{
    basis::{Basis, FAR_ABOVE, ResidualInertia},
    interface::{joined, places},
};
use crate::{Structure, StructureError, modes::Modes};

/// A residual mode is dropped if this part of it or less is not spanned by the others already taken.
const DEPENDENT: f64 = 1e-8;
/// A residual mode smaller than this part of the largest the deleted modes could give is nothing.
const NOTHING: f64 = 1e-12;

/// Basis of the relative motion of a structure.
///
/// * `interface`: coordinates with local forces; those that are held are passed over.
///
/// # Errors
/// No elastic mode up to the cut-off.
pub(super) fn basis(
    structure: &Structure,
    cut_off_hz: f64,
    interface: &[usize],
    inertia: ResidualInertia,
) -> Result<Basis, StructureError> {
    let component = structure.released_coordinates();
    let modes = Modes::over(&structure.assembly, &component)?;
    let kept = modes.kept(cut_off_hz)?;
    let loaded = places(&component, &joined(&structure.prescribed(), interface));
    let coefficients = coefficients(&modes, kept, &loaded);
    let reduced = &modes.shapes * &coefficients;
    let allowed = allowed(reduced.as_ref(), &places(&component, &structure.prescribed()));
    let mass = match inertia {
        ResidualInertia::Kept => None,
        ResidualInertia::Neglected => {
            let mass = without_residual_inertia(&modes, kept, &coefficients);
            Some(
                allowed
                    .as_ref()
                    .map_or_else(|| mass.clone(), |allowed| allowed.transpose() * &mass * allowed),
            )
        }
    };
    let relative = allowed.map_or_else(|| reduced.clone(), |allowed| &reduced * allowed);
    let free = places(&component, &structure.free_coordinates());
    Ok(Basis {
        relative: Mat::from_fn(free.len(), relative.ncols(), |i, j| relative[(free[i], j)]),
        kept_hz: modes.frequencies_hz()[..kept].to_vec(),
        mass,
    })
}

/// Columns of `T` in the coordinates of all modes: the kept modes, then orthonormal residual modes.
fn coefficients(modes: &Modes, kept: usize, loaded: &[usize]) -> Mat<f64> {
    let size = modes.frequencies.len();
    let residual = |row: usize| -> Vec<f64> {
        (kept..size).map(|mode| modes.shapes[(row, mode)] / modes.frequencies[mode].powi(2)).collect()
    };
    let scale = |row: usize| {
        let shape = modes.shapes.row(row).iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
        modes.frequencies.get(kept).map_or(0.0, |w| shape / (w * w))
    };
    let present = loaded.iter().map(|&row| (residual(row), scale(row)));
    let residuals =
        orthonormal(present.filter(|(mode, scale)| norm(mode) > NOTHING * scale).map(|pair| pair.0));
    Mat::from_fn(size, kept + residuals.len(), |row, column| match column.checked_sub(kept) {
        None => f64::from(u8::from(row == column)),
        Some(_) if row < kept => 0.0,
        Some(which) => residuals[which][row - kept],
    })
}

/// Orthonormal vectors with the span of those given, without dependent ones.
fn orthonormal(vectors: impl Iterator<Item = Vec<f64>>) -> Vec<Vec<f64>> {
    let mut taken: Vec<Vec<f64>> = Vec::new();
    for vector in vectors {
        let length = norm(&vector);
        let mut rest: Vec<f64> = vector.iter().map(|entry| entry / length).collect();
        for _ in 0..2 {
            for other in &taken {
                let part: f64 = rest.iter().zip(other).map(|(a, b)| a * b).sum();
                rest.iter_mut().zip(other).for_each(|(entry, along)| *entry -= part * along);
            }
        }
        let left = norm(&rest);
        if left > DEPENDENT {
            taken.push(rest.iter().map(|entry| entry / left).collect());
        }
    }
    taken
}

/// The mass in the basis `T`, 1 of the kept modes and next to nothing of the residual ones: as much as puts
/// them far above, in proportion to their stiffness `T^T diag(w^2) T`.
fn without_residual_inertia(modes: &Modes, kept: usize, coefficients: &Mat<f64>) -> Mat<f64> {
    let highest = FAR_ABOVE * modes.frequencies[kept - 1];
    let stiffness = |i: usize, j: usize| -> f64 {
        let rows = kept..coefficients.nrows();
        rows.map(|row| coefficients[(row, i)] * modes.frequencies[row].powi(2) * coefficients[(row, j)]).sum()
    };
    Mat::from_fn(coefficients.ncols(), coefficients.ncols(), |i, j| match (i < kept, j < kept) {
        (true, true) => f64::from(u8::from(i == j)),
        (false, false) => stiffness(i, j) / (highest * highest),
        _ => 0.0,
    })
}

/// `N`, the orthonormal null space of the rows of `T` at the prescribed coordinates; `None` where it is all.
fn allowed(reduced: MatRef<'_, f64>, prescribed: &[usize]) -> Option<Mat<f64>> {
    let size = reduced.ncols();
    let held = prescribed.len().min(size);
    if held == 0 {
        return None;
    }
    let length = |row: usize| reduced.row(row).norm_l2().max(f64::MIN_POSITIVE);
    let rows = Mat::from_fn(size, held, |i, j| reduced[(prescribed[j], i)] / length(prescribed[j]));
    Some(rows.qr().compute_Q().subcols(held, size - held).to_owned())
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}
