//! Whether mass and damping are such as a structure has: no motion has negative kinetic energy, and no damper
//! drives it.
//!
//! A negative entry on a diagonal shows that at once, and in which row; of the damping no more is asked. What
//! it does not show of the mass, the signs of the pivots of `M + e D` do, with the diagonal `D` of M and a
//! small `e`: there are as many negative ones as eigenvalues of `D^-1 M` below `-e` (Sylvester's law of
//! inertia).

use super::{SymmetricMatrix, assemble::Assembled, factor::Pencil, matrix::Entry, memory::MemoryBudget};
use crate::StructureError;

/// Eigenvalues of the mass below this part of its diagonal are zero.
const RANK: f64 = 1e-9;
/// Eigenvalues of the mass below this part of its diagonal are negative by more than a file with six digits
/// makes them: rounding does not leave a singular matrix singular.
const NEGATIVE: f64 = 1e-5;
/// Entries of a diagonal below this part of its largest are zero.
const ROUNDING: f64 = 1e-12;

/// Refuses mass and damping that would make energy. The factors of the mass take less memory than those of
/// the pencil, which has been found to fit.
///
/// # Errors
/// [`StructureError::NegativeDiagonal`] with the row, [`StructureError::MassNegative`],
/// [`StructureError::NoMass`].
pub(super) fn ensure_passive(assembled: &Assembled) -> Result<(), StructureError> {
    ensure_diagonals(assembled)?;
    ensure_not_negative(&scaled_mass(&assembled.mass)?)
}

/// The same, with the rank of the mass; `None` if it could not be found.
///
/// A mass of full rank takes one factorisation: with no eigenvalue below a small positive shift there is none
/// below zero.
///
/// # Errors
/// As [`ensure_passive`].
pub(super) fn passive_mass_rank(assembled: &Assembled) -> Result<Option<usize>, StructureError> {
    ensure_diagonals(assembled)?;
    let mass = scaled_mass(&assembled.mass)?;
    let small = counted_below(&mass, RANK);
    if small != Some(0) {
        ensure_not_negative(&mass)?;
    }
    Ok(small.map(|small| mass.size() - small))
}

fn ensure_diagonals(assembled: &Assembled) -> Result<(), StructureError> {
    let matrices = [("mass", Some(&assembled.mass)), ("damping", assembled.damping.as_ref())];
    for (matrix, entries) in matrices {
        let diagonal = entries.map_or_else(Vec::new, SymmetricMatrix::diagonal);
        let least = -ROUNDING * largest(&diagonal);
        if let Some(column) = diagonal.iter().position(|entry| *entry < least) {
            let row = assembled.row_of(column).map_or_else(String::new, |row| assembled.joined.label(row));
            return Err(StructureError::NegativeDiagonal { matrix, row, found: diagonal[column] });
        }
    }
    Ok(())
}

fn ensure_not_negative(mass: &Pencil) -> Result<(), StructureError> {
    match counted_below(mass, -NEGATIVE) {
        Some(negative) if negative > 0 => Err(StructureError::MassNegative { negative }),
        _ => Ok(()),
    }
}

/// The pencil of `M` and `D`, with the order of elimination for all shifts.
fn scaled_mass(mass: &SymmetricMatrix) -> Result<Pencil, StructureError> {
    let diagonal = mass.diagonal();
    let largest = largest(&diagonal);
    if largest == 0.0 {
        return Err(StructureError::NoMass);
    }
    let scale = diagonal.iter().enumerate().map(|(row, entry)| Entry {
        row: row as u32,
        column: row as u32,
        value: if *entry == 0.0 { largest } else { entry.abs() },
    });
    let scale = SymmetricMatrix::from_entries(mass.size(), &scale.collect::<Vec<_>>());
    Pencil::new(mass.clone(), scale, MemoryBudget::of(u64::MAX))
}

/// Number of eigenvalues of `D^-1 M` below a shift; `None` if there is no factor there.
fn counted_below(mass: &Pencil, shift: f64) -> Option<usize> {
    mass.factors(shift).ok().map(|factors| factors.negative())
}

fn largest(diagonal: &[f64]) -> f64 {
    diagonal.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()))
}
