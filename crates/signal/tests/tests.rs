//! All tests of this crate that use it from outside, in one binary: linking is most of what a test costs.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod classify;
mod decay;
mod exact_filters;
mod exponent;
mod formats;
mod refused_files;
mod rosenstein_1993;
mod scipy;
mod systems;
