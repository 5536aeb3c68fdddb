//! Static condensation: constraint modes of the interface points, and nothing else.
//!
//! A unit displacement of one interface point, the others held, bends the rest into `psi = -K_ii^-1 K_ib`.
//! These shapes hold the stiffness at the interface exactly, and the mass as far as the rest follows
//! statically.
//!
//! # Source
//! Guyan, AIAA J. 3 (1965), 380.

use faer::Mat;

use super::{basis::Basis, interface::places};
use crate::{Structure, StructureError, modes::Modes};

/// Basis of the relative motion of a structure.
///
/// * `interface`: coordinates with local forces; those that are held or prescribed are passed over.
///
/// # Errors
/// No interface point that is free, or one that leaves rigid-body modes.
pub(super) fn basis(structure: &Structure, interface: &[usize]) -> Result<Basis, StructureError> {
    let free = structure.free_coordinates();
    let boundary: Vec<usize> = interface.iter().copied().filter(|index| free.contains(index)).collect();
    if boundary.is_empty() {
        return Err(StructureError::NoInterface);
    }
    let interior: Vec<usize> = free.iter().copied().filter(|index| !boundary.contains(index)).collect();
    let mut relative = Mat::zeros(free.len(), boundary.len());
    if !interior.is_empty() {
        let modes = Modes::over(&structure.assembly, &interior)?;
        if modes.rigid() > 0 {
            return Err(StructureError::NotHeld { rigid_modes: modes.rigid() });
        }
        let bent = modes.relief_of_strains(structure.assembly.stiffness.columns(&boundary).as_ref());
        for (row, place) in places(&free, &interior).into_iter().enumerate() {
            relative.row_mut(place).copy_from(bent.row(row));
        }
    }
    for (column, place) in places(&free, &boundary).into_iter().enumerate() {
        relative[(place, column)] = 1.0;
    }
    Ok(Basis { relative, kept_hz: Vec::new(), mass: None })
}
