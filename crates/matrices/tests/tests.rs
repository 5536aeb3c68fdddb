//! Tests of the readers, and of modes from files that finite element programs have written.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod calculix;
mod incompatible_modes;
mod mat;
mod output4;
mod shared_files;
mod texts;
