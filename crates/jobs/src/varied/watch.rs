//! What a piece tells while it is computed, and how it hears that it is to stop.

use std::sync::{
    atomic::{AtomicBool, Ordering},
    mpsc::Sender,
};

use super::pool::News;

/// The ear and the mouth of one piece.
pub(super) struct Watch<'a> {
    /// Number of the piece among those to be computed.
    pub piece: usize,
    pub stop: &'a AtomicBool,
    pub news: &'a Sender<News>,
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

impl Watch<'_> {
    /// Whether to stop.
    pub fn interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// There is a new solution.
    ///
    /// * `fraction`: estimated part of the piece that is done, 0 to 1.
    pub fn row(&self, value: f64, frequency_hz: f64, fraction: f64) {
        // Nobody may listen any more, which is no harm.
        let _ = self.news.send(News::Row { piece: self.piece, value, frequency_hz, fraction });
    }
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
