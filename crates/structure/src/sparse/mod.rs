//! Structures given as sparse matrices, from finite element programs.
//!
//! The equations are those of the crate's documentation, with matrices that a file gives instead of a beam's.
//! Four things differ:
//!
//! * **`M` is singular as a rule** (rotations, constrained rows, boundaries without mass), and `K` is where
//!   nothing holds the structure. Neither is factored by itself: `K - sigma M` is, with `sigma` below all
//!   eigenvalues, and modes come from Lanczos on its inverse in the inner product of `M` ([`lanczos`]).
//! * **No mode is missed.** The signs of the pivots of `K - sigma M` at the cut-off count the modes below it
//!   ([`factor`]); the search ends when it has all of them, doubled ones included ([`pencil_modes`]).
//! * **Rows are not always a node and a direction.** Rows of multipliers are conditions, and are eliminated;
//!   rows without entries are left out; components share the rows of common nodes ([`assemble`]). All of it
//!   is one map `y = T x`, and the matrices of what is left are `T^T K T`, `T^T M T`, `T^T C T` ([`map`]).
//! * **`K` is assembled and rounded**, so low modes carry the rounding of large entries: an entry that is off
//!   by a part `e` moves `w^2` by up to `e |phi|^T |K| |phi|`. What is smaller than that is a rigid-body
//!   mode.
//!
//! Static answers beside the kept modes, which free interfaces need, are in [`statics`], the reductions in
//! [`reduce`] and a file each: [`free_interface`], [`craig_bampton`], [`guyan`].

mod assemble;
mod constraints;
mod craig_bampton;
mod factor;
mod free_interface;
mod guyan;
mod joined;
mod krylov_size;
mod label;
mod lanczos;
mod map;
mod matrix;
mod memory;
mod mesh;
mod modal_form;
mod model;
mod part;
mod passive;
mod pencil_modes;
mod points;
mod prepared;
mod random;
mod reduce;
mod report;
mod statics;
mod survey;
mod translation;
mod vectors;

pub use label::{Direction, RowKind, RowLabel};
pub use matrix::{Entry, SymmetricMatrix};
pub use memory::MemoryNeed;
pub(crate) use memory::in_gigabytes;
pub use mesh::{MeshNode, MeshShape};
pub use model::{
    Along, Matrices, MatrixComponent, MatrixPoint, MatrixReport, MatrixSupport, PointPlace, RowSet,
    SupportRows,
};
pub use part::MatrixPart;
pub use survey::MatrixSurvey;
