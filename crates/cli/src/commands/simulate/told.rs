//! How far a motion has come, in words.

use hammerbeam_attractor::AttractorError;
use hammerbeam_results::store::SimulationLayout;

use super::time::Pieces;
use crate::{
    failure::Failure,
    kept::{Kept, counted},
};

/// What a motion is cut into.
#[derive(Clone, Copy)]
pub struct Told<'a> {
    pub layout: &'a SimulationLayout,
    pub pieces: Pieces,
}

impl Told<'_> {
    /// What becomes of the periods that are done.
    pub fn fate(self, done: u64, kept: &Kept) -> String {
        let (number, part) = self.place(done);
        format!("{}{part} {}", counted(number, self.pieces.word()), kept.fate(number))
    }

    /// A motion that ends early.
    pub fn ended(self, error: &AttractorError, (done, kept): (u64, &Kept)) -> Failure {
        let word = self.pieces.word();
        let (period, part) = self.place(done + 1);
        let (number, of) = self.place(done);
        let finished = counted(number, word);
        Failure::NoResult(format!("{word} {period}{part}: {error}; {finished}{of} {}", kept.place(number)))
    }

    /// The number of a period in its part of the motion, and that part.
    fn place(self, period: u64) -> (u64, &'static str) {
        match self.layout.transient_periods {
            0 => (period, ""),
            transient if period > transient => (period - transient, ""),
            _ => (period, " of the transient"),
        }
    }
}
