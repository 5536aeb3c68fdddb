//! All tests of this crate that use it from outside, in one binary: linking is most of what a test costs.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod comparison;
mod comparison_minima;
mod orbits;
mod update;
mod update_data;
mod varied;
