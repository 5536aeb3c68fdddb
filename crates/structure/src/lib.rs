//! Linear structures: beams and lumped masses, assembled, supported and reduced to modes.
//!
//! This crate knows nothing of time, contact or excitation frequency: it ends in a
//! [`ReducedModel`], the modal form that the motion crate takes over.

mod reduced_model;

pub use reduced_model::{PointOutput, ReducedModel, SupportInput};
