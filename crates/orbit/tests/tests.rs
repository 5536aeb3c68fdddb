//! All tests of this crate that use it from outside, in one binary: linking is most of what a test costs.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod begin_phase;
mod books;
mod cascade;
mod codimension_two;
mod codimension_two_pairs;
mod common;
mod criticality;
mod curves;
mod density;
mod find;
mod flips_beam;
mod flips_bilinear;
mod flips_duffing;
mod formulas;
mod grazing_located;
mod grazing_pair;
mod grazing_rows;
mod impact_at_phase_0;
mod multipliers;
mod neimark_sacker;
mod outputs;
mod own_images;
mod pressed_start;
mod probe;
mod sag;
mod second_grazing;
mod slow_contact;
mod splitting_curve;
mod splitting_end;
mod symmetry_breaking;
mod touch_over_the_begin;
mod unbounded;
mod vary;
mod walk_resume;
mod work;
