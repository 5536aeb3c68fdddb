//! How far a motion has come, in words.

use hammerbeam_attractor::AttractorError;
use hammerbeam_study::store::SimulationLayout;

use crate::{
    failure::Failure,
    kept::{Kept, counted},
};

/// What becomes of the periods that are done.
pub fn fate(layout: &SimulationLayout, done: u64, kept: &Kept) -> String {
    let (number, part) = place(layout, done);
    format!("{}{part} {}", counted(number, "period"), kept.fate(number))
}

/// A motion that ends early.
pub fn ended(error: &AttractorError, layout: &SimulationLayout, (done, kept): (u64, &Kept)) -> Failure {
    let (period, part) = place(layout, done + 1);
    let (number, of) = place(layout, done);
    let finished = counted(number, "period");
    Failure::NoResult(format!("period {period}{part}: {error}; {finished}{of} {}", kept.place(number)))
}

/// The number of a period in its part of the motion, and that part.
fn place(layout: &SimulationLayout, period: u64) -> (u64, &'static str) {
    match layout.transient_periods {
        0 => (period, ""),
        transient if period > transient => (period - transient, ""),
        _ => (period, " of the transient"),
    }
}
