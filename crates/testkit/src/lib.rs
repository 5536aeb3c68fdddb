//! What the tests of several crates share: structures, laws, systems, walks, files of OUTPUT4, and the switch
//! for whole sets.
//!
//! The beam of the paper is written here once. Only tests depend on this crate.
#![allow(clippy::unwrap_used, reason = "a test ends where its model is wrong")]

pub mod laws;
mod observed_system;
pub mod output4;
mod random;
pub mod structures;
pub mod systems;

pub use observed_system::{ObservedSystem, Walked, folds, paper_rig, paper_rig_with, walk, walk_both};
pub use random::SeededNumbers;

/// Whether whole sets are asked for instead of samples: `HAMMERBEAM_EXTENSIVE=1`.
pub fn extensive() -> bool {
    std::env::var_os("HAMMERBEAM_EXTENSIVE").is_some_and(|value| value == "1")
}

/// The step through a set of which every n-th member is a sample: 1 where whole sets are asked for.
pub fn stride(every: usize) -> usize {
    if extensive() { 1 } else { every }
}
