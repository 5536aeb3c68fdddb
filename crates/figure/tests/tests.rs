//! All tests of this crate that use it from outside, in one binary: linking is most of what a test costs.

mod charts;
mod curve_diagram;
mod page;
mod response_diagram;
mod structures;
