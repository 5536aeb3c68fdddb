//! All tests of this crate that use it from outside, in one binary: linking is most of what a test costs.

mod linear;
mod nonlinear;
