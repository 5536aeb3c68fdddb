//! Reduction: fewer coordinates for the motion relative to the support.
//!
//! Every method gives a basis `B` of that motion, zero at the prescribed coordinates; the reduced modes
//! are those of `B^T K B` and `B^T M B`.

mod basis;
mod fixed_interface;
mod free_interface;
mod guyan;
mod interface;

pub(crate) use basis::{Basis, FAR_ABOVE, ResidualInertia};

use crate::{Structure, StructureError, error::positive, modes::Modes, structure::Kind};

/// How a structure is reduced.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reduction {
    /// All modes of the supported structure.
    None,
    /// Free-interface modes up to a cut-off frequency, rigid-body modes included, and residual
    /// flexibility modes for the interface: for the prescribed displacements, which are let go, and for the
    /// named points; then the prescribed displacements are prescribed again.
    ///
    /// Static flexibility at the interface is exact, and elastic modes below the cut-off nearly so.
    FreeInterface {
        /// Highest eigenfrequency kept [Hz].
        cut_off_hz: f64,
    },
    /// The same without the inertia of the residual modes, after MacNeal: they answer statically, which puts
    /// their frequencies far above the cut-off.
    MacNeal {
        /// Highest eigenfrequency kept [Hz].
        cut_off_hz: f64,
    },
    /// A static constraint mode for each interface point and no other, after Guyan.
    Guyan {
        /// Highest eigenfrequency [Hz] that is compared with those of the reduced structure; none is kept.
        cut_off_hz: f64,
    },
    /// Fixed-interface modes up to a cut-off frequency, and a static constraint mode for each interface
    /// point.
    FixedInterface {
        /// Highest eigenfrequency kept [Hz].
        cut_off_hz: f64,
    },
    /// The modes of the supported structure up to a cut-off frequency, without static corrections: a local
    /// force meets too stiff a structure.
    Truncation {
        /// Highest eigenfrequency kept [Hz].
        cut_off_hz: f64,
    },
}

impl Reduction {
    /// Cut-off frequency [Hz], if modes are cut off.
    #[must_use]
    pub fn cut_off_hz(&self) -> Option<f64> {
        match *self {
            Self::None => None,
            Self::FreeInterface { cut_off_hz }
            | Self::MacNeal { cut_off_hz }
            | Self::Guyan { cut_off_hz }
            | Self::FixedInterface { cut_off_hz }
            | Self::Truncation { cut_off_hz } => Some(cut_off_hz),
        }
    }

    /// The basis, or `None` if the structure stays as it is.
    ///
    /// * `full`: modes of the supported structure.
    pub(crate) fn basis(
        &self,
        structure: &Structure,
        full: &Modes,
        interface: &[usize],
    ) -> Result<Option<Basis>, StructureError> {
        let Some(cut_off_hz) = self.cut_off_hz() else { return Ok(None) };
        positive("cut-off frequency", cut_off_hz)?;
        if structure.kind == Kind::Lumped {
            return Err(StructureError::LumpedIsNotReduced);
        }
        let basis = match self {
            Self::Truncation { .. } => full.kept(cut_off_hz).map(|kept| Basis {
                relative: full.shapes.subcols(0, kept).to_owned(),
                kept_hz: full.frequencies_hz()[..kept].to_vec(),
                mass: None,
            }),
            Self::Guyan { .. } => guyan::basis(structure, interface),
            Self::MacNeal { .. } => {
                free_interface::basis(structure, cut_off_hz, interface, ResidualInertia::Neglected)
            }
            Self::FixedInterface { .. } => fixed_interface::basis(structure, cut_off_hz, interface),
            Self::FreeInterface { .. } | Self::None => {
                free_interface::basis(structure, cut_off_hz, interface, ResidualInertia::Kept)
            }
        };
        basis.map(Some)
    }
}
