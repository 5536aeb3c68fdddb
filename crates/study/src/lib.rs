//! Studies: the study file, the model it describes, running it, and the store of its results.

mod document;
pub mod export;
pub mod file;
mod identity;
mod model;
mod orbit_solver;
pub mod run;
pub mod store;
pub mod summary;

pub use document::{Problem, Report};
pub use export::export_csv;
pub use file::{Study, StudyError, StudyFile};
pub use identity::DATA_VERSION;
pub use model::Model;
pub use orbit_solver::OrbitSolver;
pub use store::{Store, StoreError};
