//! Studies: the study file, the model it describes, running it, and the store of its results.

mod document;
pub mod file;
mod identity;
mod model;

pub use document::{Problem, Report};
pub use file::{Study, StudyError, StudyFile};
pub use identity::DATA_VERSION;
pub use model::{Model, ResponsePoint};
