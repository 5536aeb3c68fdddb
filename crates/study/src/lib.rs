//! Studies: the study file, the model it describes, running it, and the store of its results.
//!
//! | room | what it knows |
//! |---|---|
//! | `document` | TOML tables that are asked for their keys, quantities with their ranges, all faults at once and where they stand |
//! | [`file`] | one file per table of the study file: its keys and their meaning |
//! | `model` | from what the file says to the equations of motion |
//! | `number` | numbers in the text of a study by their key paths, and the text with others |
//! | `identity` | what makes a study the same study, so that a results folder is continued or refused |
//! | [`run`] | the plan of searches, following branches, progress; of the numerics it knows two traits |
//! | `orbit_solver` | these traits, served by the orbit crate |
//! | [`varied`] | branches in other parameters and curves of bifurcations, after the diagram |
//! | [`update`] | parameters of a study fitted to measured eigenfrequencies, damping ratios and responses |
//! | [`store`] | the results folder: one database in transactions, the checkpoint of each walk beside its rows; motions in time, sweeps, exponents and basins by request |
//! | `crossings` | where stored branches cross a frequency, and which of them holds a periodic motion |
//! | [`comparison`] | measured points held against stored branches |
//! | [`rig`] | a measurement made with another model |
//! | [`verify`] | stored solutions, computed again by the independent integrator |
//! | [`export`], [`summary`] | what is read from it: CSV, and branches in few numbers |
//!
//! A run is a loop over searches that the study alone decides. Everything it finishes is in the store before
//! it goes on, and what is in the store is skipped, so a run that was killed does exactly what is left, with
//! the same bits.
//!
//! # Example
//! ```
//! let text = r#"
//!     [structure]
//!     kind = "lumped"
//!     mass = [{ name = "mass", mass_kg = -1.0 }]
//!
//!     [excitation]
//!     kind = "force"
//!     at = "mass"
//!     amplitude_n = 1.0
//!     frequency_hz = [0.1, 1.0]
//! "#;
//! let fault = hammerbeam_study::StudyFile::parse("study.toml", text.to_owned()).expect_err("a negative mass");
//! assert!(fault.to_string().contains("mass_kg"), "{fault}");
//! ```

pub mod comparison;
mod crossings;
mod document;
pub mod export;
pub mod file;
mod identity;
mod model;
mod number;
mod orbit_solver;
mod reason;
pub mod rig;
pub mod run;
pub mod settled;
pub mod store;
pub mod summary;
pub mod update;
pub mod varied;
pub mod verify;
pub mod whole_file;

pub use crossings::{MirrorImage, PlacedRow, StoredBranch, StoredBranches, corrected};
pub use document::{Problem, Report, unit::hertz};
pub use export::{export_csv, export_states};
pub use file::{Study, StudyError, StudyFile};
pub use identity::DATA_VERSION;
pub use model::matrix_study;
pub use model::{
    Drift, Model, PointStart, PointStartError, PointStartKind, StudyParameter, UndampedInContact,
    UndampedMode,
};
pub use orbit_solver::OrbitSolver;
pub use store::{Store, StoreError};
