//! Fixed-interface modes with static constraint modes.
//!
//! With the interface points `b` held besides the support, the interior `i` has modes `Phi_k`; a unit
//! displacement of one interface point, the others held, bends it into the constraint mode
//! `psi = -K_ii^-1 K_ib` (pseudo-inverse if the interior can still move rigidly, which its rigid-body
//! modes then do). The basis is `B = [Phi_k Psi]`; static answers to interface loads are exact.
//!
//! # Source
//! Craig and Bampton, AIAA J. 6 (1968), 1313-1319; the constraint modes are theirs, the support is held.

use faer::Mat;

use super::{basis::Basis, interface::places};
use crate::{Structure, StructureError, modes::Modes};

/// Basis of the relative motion of a structure.
///
/// * `interface`: coordinates with local forces; those that are held or prescribed are passed over.
///
/// # Errors
/// No elastic mode up to the cut-off, or nothing free.
pub(super) fn basis(
    structure: &Structure,
    cut_off_hz: f64,
    interface: &[usize],
) -> Result<Basis, StructureError> {
    let free = structure.free_coordinates();
    let boundary: Vec<usize> = interface.iter().copied().filter(|index| free.contains(index)).collect();
    let interior: Vec<usize> = free.iter().copied().filter(|index| !boundary.contains(index)).collect();
    if interior.is_empty() {
        return Ok(Basis {
            relative: Mat::identity(free.len(), free.len()),
            kept_hz: Vec::new(),
            mass: None,
        });
    }
    let modes = Modes::over(&structure.assembly, &interior)?;
    let kept = modes.kept(cut_off_hz)?;
    let strains = structure.assembly.stiffness.columns(&boundary);
    let bent = modes.relief_of_strains(strains.as_ref());
    let mut relative = Mat::zeros(free.len(), kept + boundary.len());
    for (row, place) in places(&free, &interior).into_iter().enumerate() {
        relative.row_mut(place).subcols_mut(0, kept).copy_from(modes.shapes.row(row).subcols(0, kept));
        relative.row_mut(place).subcols_mut(kept, boundary.len()).copy_from(bent.row(row));
    }
    for (column, place) in places(&free, &boundary).into_iter().enumerate() {
        relative[(place, kept + column)] = 1.0;
    }
    Ok(Basis { relative, kept_hz: modes.frequencies_hz()[..kept].to_vec(), mass: None })
}
