//! All tests of this crate that use it from outside, in one binary: linking is most of what a test costs.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod beams;
mod closed_form;
mod common;
mod damping;
mod derivatives;
mod invariants;
mod matrices;
mod reductions;
mod refused_input;
mod support_motion;
mod supports_that_differ;
