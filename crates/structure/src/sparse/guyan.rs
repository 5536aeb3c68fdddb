//! Static condensation (Guyan): the constraint modes of the interface, and nothing else.
//!
//! The structure takes the static shape of its interface displacements at every time. `K` is condensed
//! exactly, `M` by these shapes, so frequencies come out too high, and useful where they are far below
//! those of the structure with its interface held.
//!
//! # Source
//! R. Guyan, AIAA J. 3 (1965), 380.

use faer::Mat;

use super::{
    craig_bampton::{FixedInterfaceModes, constraint_modes},
    factor::Pencil,
    statics::Statics,
};
use crate::{StructureError, modes::Modes};

/// The modes of the condensed structure.
///
/// * `loads`: interface points, weights over the free coordinates.
///
/// # Errors
/// No interface, points that depend on one another.
pub(super) fn guyan_modes(
    pencil: &Pencil,
    statics: &Statics<'_>,
    loads: &[Vec<f64>],
) -> Result<FixedInterfaceModes, StructureError> {
    if loads.is_empty() {
        return Err(StructureError::NoInterface);
    }
    let basis = constraint_modes(statics, loads, pencil.size())?.transpose().to_owned();
    let mass = basis.transpose() * pencil.mass.times_columns(basis.as_ref());
    let count = loads.len();
    let mass = Mat::from_fn(count, count, |i, j| 0.5 * (mass[(i, j)] + mass[(j, i)]));
    let modes = Modes::of(Mat::<f64>::identity(count, count).as_ref(), mass.as_ref())?;
    let shapes = basis * modes.shapes;
    Ok(FixedInterfaceModes { frequencies: modes.frequencies, shapes, kept_hz: Vec::new() })
}
