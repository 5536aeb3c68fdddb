//! What the computing of a piece reports, and how far it is.

use std::sync::{
    atomic::{AtomicBool, Ordering},
    mpsc::Sender,
};

use hammerbeam_orbit::Side;
use hammerbeam_results::{end::BranchEnd, row::SolvedRow};

use super::solver::{Failed, FoundStarts};
use crate::walk::{Stretch, Walk};

/// What threads report of a piece, by its number among those to be computed.
#[derive(Debug)]
pub(super) struct News {
    pub piece: usize,
    pub what: PieceNews,
}

#[derive(Debug)]
pub(super) enum PieceNews {
    /// A new solution.
    Row { value: f64, frequency_hz: f64, fraction: f64 },
    /// What came of the search.
    Searched(Result<FoundStarts, Failed>),
    /// More of a walk, from its start on or behind what is stored.
    Walked { start: u32, side: Side, stretch: Stretch, from_start: bool },
    /// A walk could not start, or go on.
    NotOpened { start: u32, failed: Failed },
    /// The task was given up when it was to stop.
    Left,
}

/// Where a thread reports to, and whether it is to stop.
pub(super) struct Watch<'a> {
    /// Number of the piece among those to be computed.
    pub piece: usize,
    pub stop: &'a AtomicBool,
    pub news: &'a Sender<News>,
}

impl Watch<'_> {
    /// Whether to stop.
    pub fn interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Reports; whether anybody reads it.
    pub fn report(&self, what: PieceNews) -> bool {
        self.news.send(News { piece: self.piece, what }).is_ok()
    }
}

/// A walk that reports each of its rows.
pub(super) struct WatchedWalk<'a> {
    pub walk: Box<dyn Walk + 'a>,
    pub watch: &'a Watch<'a>,
    pub way: Way,
    pub second_side: bool,
    /// Part of the piece that is done before this start, and part of it that a start is.
    pub share: [f64; 2],
}

impl Walk for WatchedWalk<'_> {
    fn step(&mut self, rows: &mut Vec<SolvedRow>) -> Result<Option<BranchEnd>, String> {
        let before = rows.len();
        let end = self.walk.step(rows);
        for row in &rows[before..] {
            let [done, part] = self.share;
            let fraction = done + part * self.way.at(row.parameter, self.second_side);
            let frequency_hz = row.solution.frequency_hz;
            self.watch.report(PieceNews::Row { value: row.parameter, frequency_hz, fraction });
        }
        end
    }

    fn checkpoint(&self) -> Option<Vec<u8>> {
        self.walk.checkpoint()
    }

    fn take_journal(&mut self) -> Vec<u8> {
        self.walk.take_journal()
    }
}

/// How far a walk to both sides is: the part of the way from the start to the ends of the range.
#[derive(Debug, Clone, Copy)]
pub(super) struct Way {
    /// Range of the parameter, in the unit of the study.
    pub range: [f64; 2],
    /// Where the walks begin.
    pub start: f64,
    /// Largest part reached yet.
    pub reached: f64,
}

impl Way {
    pub fn new(range: [f64; 2], start: f64) -> Self {
        Self { range, start, reached: 0.0 }
    }

    /// Goes to a value on the first or second side; the part of both sides that is done, which never
    /// decreases.
    pub fn at(&mut self, value: f64, second_side: bool) -> f64 {
        let [low, high] = self.range;
        let [down, up] =
            [(self.start - value) / (self.start - low), (value - self.start) / (high - self.start)];
        // A curve may turn and go to the other end.
        let part = down.max(up);
        let part = if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) };
        let both = if second_side { 0.5 + 0.5 * part } else { 0.5 * part };
        self.reached = self.reached.max(both);
        self.reached
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_grows_from_nothing_to_all_and_never_shrinks() {
        let mut way = Way::new([1.0, 4.0], 2.0);
        assert_eq!(way.at(2.0, false), 0.0);
        assert_eq!(way.at(1.5, false), 0.25);
        assert_eq!(way.at(1.8, false), 0.25);
        assert_eq!(way.at(1.0, false), 0.5);
        assert_eq!(way.at(2.0, true), 0.5);
        assert_eq!(way.at(4.0, true), 1.0);
        // A start at the end of the range.
        let mut way = Way::new([1.0, 4.0], 1.0);
        assert_eq!(way.at(1.0, false), 0.0);
        assert_eq!(way.at(2.5, true), 0.75);
    }
}
