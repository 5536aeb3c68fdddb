//! Linear structures: beams and lumped masses, assembled, supported and reduced to modes.
//!
//! Coordinates of a structure are held (zero), prescribed or free. Prescribed ones follow one of several
//! supports, `y_p = u_s(t)`, each of which has a motion of its own:
//!
//! `M_ff y'' + C_ff y' + K_ff y + sum_s (M_fs u_s'' + C_fs u_s' + K_fs u_s) = f + a (M 1)_f`.
//!
//! The absolute motion is the static answer to the supports plus a relative motion in `n` modes,
//!
//! `y = sum_s Gamma_s u_s + Phi q`, `Gamma_s = -K_ff^-1 K_fs`, `Phi^T M Phi = 1`, `Phi^T K Phi = diag(w^2)`,
//!
//! so that the stiffness of the supports drops out and, with the modal damping matrix
//! `C = Phi^T C_d Phi + diag(2 z w) + alpha 1 + beta diag(w^2)`,
//!
//! `q'' + C q' + diag(w^2) q = -sum_s (g_s u_s'' + d_s u_s') + Phi^T f + a Phi^T M 1`,
//! `g_s = Phi^T (M_ff Gamma_s + M_fs)`, `d_s = Phi^T (C_ff Gamma_s + C_fs)`.
//!
//! `Gamma_s` is the shape that the structure takes when support s alone is moved by one and the others stand
//! still: a cantilever follows rigidly, `Gamma = 1`; between two pinned ends the shapes are `1 - x/l` and
//! `x/l`, between two clamped ones cubics. Where all supports move alike, `u_s = u`, only the sum of the
//! shapes counts, and it is 1 where nothing else holds the structure. Supports that move apart strain the
//! structure, which no rigid translation does.
//!
//! Each `u_s` is a sum of harmonics with amplitudes and phases of their own, `Re U_sm exp(i m W t)`; the
//! equations are linear in them, so harmonic m of the right side is `sum_s ((m W)^2 g_s - i m W d_s) U_sm`,
//! and the sum of the motions that each support alone causes is the motion that all of them cause.
//!
//! Only the discrete dampers `C_d` act on the absolute motion; modal and Rayleigh damping act on the
//! motion relative to the static answer. `Phi` are all modes of the supported structure, or those of a
//! [`Reduction`].
//!
//! Stiffness is kept as `K = G^T G` and modes come from singular values, because an assembled `K` loses
//! the low modes of a fine mesh: the eigenvalues of a cantilever of 200 elements spread over twelve
//! decades. These matrices are dense. [`Matrices`] of finite element programs are sparse, and have no
//! `G`: see there, and `sparse/mod.rs` for the mathematics.
//!
//! This crate knows nothing of time, contact or excitation frequency: it ends in a
//! [`ReducedModel`], the modal form that the motion crate takes over.
//!
//! ```
//! use hammerbeam_structure::{Beam, BeamPoint, Damping, End, Reduction, Section};
//!
//! let beam = Beam {
//!     length: 0.26,
//!     elements: 40,
//!     section: Section::rectangle(0.03, 0.002)?,
//!     youngs_modulus: 2.1e11,
//!     density: 7800.0,
//!     left: End::Clamped,
//!     right: End::Free,
//!     points: vec![BeamPoint { name: "tip".into(), at: 0.24, mass: 0.04, ..BeamPoint::default() }],
//! };
//! let shaken = beam.structure()?.with_support_motion(&["left"])?;
//! let reduction = Reduction::FreeInterface { cut_off_hz: 1000.0 };
//! let reduced = shaken.reduce(&reduction, &Damping::modal(0.015), &["tip"])?;
//! assert_eq!(reduced.tables.free_interface_hz[0], 0.0);
//! assert!(reduced.model.point("tip").is_some_and(|tip| tip.shape[0] > 0.0));
//! # Ok::<(), hammerbeam_structure::StructureError>(())
//! ```

mod assembly;
mod beam;
mod damping;
mod error;
mod export;
mod lumped;
mod modes;
mod names;
mod orient;
mod plane;
mod plausible;
mod reduce;
mod reduced_model;
mod reduction;
mod section;
mod sparse;
mod strain;
mod structure;
mod tables;
mod two_planes;

pub use beam::{Beam, BeamChange, BeamPoint, BeamSpan, Boundary, End, PointChange, Shear, SteppedBeam};
pub use damping::{Damping, ModalRatios};
pub use error::StructureError;
pub use export::ExportedMatrices;
pub use lumped::{Connection, GROUND, Lumped, LumpedMass};
pub use plane::Plane;
pub use plausible::{PLAUSIBLE_DENSITY, PLAUSIBLE_YOUNGS_MODULUS};
pub use reduce::{OutlinePoint, Reduced};
pub use reduced_model::{PointOutput, ReducedModel, SupportInput};
pub use reduction::Reduction;
pub use section::Section;
pub use sparse::{
    Along, Direction, Entry, Matrices, MatrixComponent, MatrixPart, MatrixPoint, MatrixReport, MatrixSupport,
    MatrixSurvey, MemoryNeed, MeshNode, MeshShape, PointPlace, RowKind, RowLabel, RowSet, SupportRows,
    SymmetricMatrix,
};
pub use structure::Structure;
pub use tables::{FlexibilityError, FrequencyError, ModeTables};
pub use two_planes::TwoPlanes;
