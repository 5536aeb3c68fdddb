//! Studies: the study file, the document that it is, the model it describes.
//!
//! * [`document`]: TOML tables that are asked for their keys, quantities with their ranges, all faults at
//!   once and where they stand.
//! * [`file`]: one file per table of the study file: its keys and their meaning.
//! * `model`: from what the file says to the equations of motion.
//! * [`number`]: numbers in the text of a study by their key paths, and the text with others.
//! * `setting`: keys with other values, written into the text of a study.
//! * [`identity`]: what makes a study the same study, so that a results folder is continued or refused.
//!
//! Nothing is solved or stored here: `hammerbeam-results` keeps what `hammerbeam-jobs` computes.
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
//! let read = hammerbeam_study::StudyFile::parse("study.toml", text.to_owned());
//! let fault = read.expect_err("a negative mass");
//! assert!(fault.to_string().contains("mass_kg"), "{fault}");
//! ```

pub mod changed;
pub mod document;
pub mod file;
pub mod identity;
mod model;
pub mod number;
mod setting;

pub use document::{
    FaultReport, Problem,
    unit::{hertz, readable, readable_to},
};
pub use file::{Study, StudyError, StudyFile};
pub use identity::DATA_VERSION;
pub use model::matrix_study;
pub use model::{
    Drift, Model, PointStart, PointStartError, PointStartKind, StudyParameter, UndampedInContact,
    UndampedMode, output_signals, with_structure_fault,
};
pub use setting::{Setting, SettingError};
