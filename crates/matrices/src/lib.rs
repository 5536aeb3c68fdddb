//! Matrices of finite element programs: read from files, and written as the bundle of Hammerbeam.
//!
//! * Matrix Market: `read/matrix_market.rs`.
//! * CalculiX `.sti`, `.mas`; Abaqus' coordinate and matrix input formats: `read/triplets.rs`.
//! * substructures of Abaqus and CalculiX: `read/user_element.rs`.
//! * Nastran punch files, `DMIG`: `read/punch.rs`, cards in `read/cards.rs`.
//! * Nastran OUTPUT4: `read/output4.rs`, `output4_text.rs`, `output4_binary.rs`; the order of rows
//!   `read/extrn.rs`.
//! * Harwell-Boeing: `read/harwell_boeing.rs`.
//! * MAT files of version 5: `read/mat5.rs`.
//! * labels of rows, nodes, lines: `read/tables.rs`.
//!
//! Readers go through a file once, a line or a record at a time. An entry takes 16 bytes while it is read and
//! 12 afterwards, and nothing is allocated because a header says so. Every fault has its file and its line or
//! byte ([`MatrixError`]).
//!
//! The bundle is a folder: `K.mtx` and `M.mtx`, where there is damping `C.mtx` (Matrix Market, symmetric),
//! `dofs.csv` (`row,node,direction,kind,name`), `nodes.csv` (`node,x,y,z`), `lines.csv` (`node,node`); all in
//! SI units. See `docs/how-to/structures.md`.
//!
//! ```
//! let text = b"%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2.0\n2 1 -1.0\n2 2 2.0\n";
//! let matrices = hammerbeam_matrices::parse_matrices(text, None)?;
//! assert_eq!((matrices[0].rows, matrices[0].entries.len()), (2, 3));
//! # Ok::<(), hammerbeam_matrices::MatrixError>(())
//! ```

mod component;
mod error;
mod format;
mod matrix;
mod read;
mod write;

pub use component::{ComponentFiles, MatrixFile, read_component};
pub use error::{FilePlace, MatrixError, MatrixFault};
pub use format::MatrixFormat;
pub use matrix::{FileMatrix, MOST_ROWS};
pub use read::{Nodes, parse_matrices, read_labels, read_lines, read_matrices, read_nodes};
pub use write::{write_dofs, write_lines, write_matrix_market, write_nodes};
