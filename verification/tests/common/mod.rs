//! Structures and walks shared by the verification tests.

pub mod crossings;
pub mod settled;
pub mod spectrum;

pub use hammerbeam_testkit::{
    ObservedSystem, Walked, extensive, folds,
    laws::hertz,
    paper_rig as paper_beam, paper_rig_with as paper_beam_with,
    structures::{masses, paper_beam_model, single_mass},
    systems::{element_at, force_at, response_of, shaken},
    walk, walk_both,
};
