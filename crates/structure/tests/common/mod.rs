//! Structures that several tests share.

pub use hammerbeam_testkit::structures::{bare, lumped, paper_beam, unit_beam};
