//! All tests of this crate that use it from outside, in one binary: linking is most of what a test costs.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod angular;
mod bad_input;
mod borders;
mod both_sides;
mod common;
mod compare;
mod corners;
mod curves;
mod energy_loss;
mod events;
mod every_law;
mod failing_writes;
mod figure;
mod figure_refused;
mod formula;
mod impact_oscillator;
mod interrupts;
mod json;
mod kills;
mod marginal;
mod memory;
mod motions;
mod overlay;
mod page;
mod parameters;
mod resting;
mod rig;
mod run;
mod same_bytes;
mod signal;
mod unbounded;
mod update;
mod varied;
mod verify;
mod wide_range;
