//! All tests of this crate that use it from outside, in one binary: linking is most of what a test costs.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

#[macro_use]
mod support;

mod beside_simpler;
mod branch_points;
mod hidden_zeros;
mod images;
mod known_paths;
mod large_residual;
mod noise;
mod outside;
mod random_paths;
mod rescale;
mod root_corners;
mod running;
mod sharp_turns;
mod sheets;
mod test_functions;
mod transfer;
mod undecided;
