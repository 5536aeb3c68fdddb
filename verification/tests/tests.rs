//! All tests of this crate that use it from outside, in one binary: linking is most of what a test costs.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod architecture;
mod beam_between_stops;
mod beam_chaos;
mod bilinear_oscillator;
mod bracket;
mod common;
mod completeness;
mod components;
mod contact_damping;
mod contacts;
mod discontinuous_supports;
mod duffing;
mod formulas;
mod licences;
mod linear;
mod loads;
mod many_attractors;
mod marginal;
mod measuring_filter;
mod moving_supports;
mod mutations;
mod plain_motion;
mod reductions;
mod relations;
mod round_holes;
mod shaw_holmes_1983;
mod surveys;
mod two_masses;
mod two_planes;
mod two_slopes;
mod two_wells;
mod van_de_vorst_conclusions;
mod van_de_vorst_eigenfrequencies;
mod van_de_vorst_harmonic_branch;
mod van_de_vorst_harmonic_walk;
mod van_de_vorst_measured_modes;

mod whole_runs;
