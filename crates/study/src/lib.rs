//! Studies: the study file, the model it describes, running it, and the store of its results.

mod document;
mod file;

pub use document::{Problem, Report};
pub use file::*;
