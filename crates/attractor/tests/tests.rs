//! All tests of this crate that use it from outside, in one binary: linking is most of what a test costs.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod basins;
mod checkpoint;
mod classes;
mod common;
mod exponents_of_systems;
mod impact_speed_exponents;
mod impact_speed_laws;
mod published_exponents;
mod rigid;
mod simulate;
mod sweep;
mod work;
