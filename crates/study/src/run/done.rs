//! Counts of a run, and an estimate of how far it is.

use super::Plan;
use crate::store::{Store, StoreError};

/// Counts of a run, and an estimate of how far it is.
#[derive(Debug)]
pub(super) struct Done {
    /// Solutions computed by this run.
    pub new_solutions: u64,
    /// Solutions of all runs.
    pub solutions: u64,
    range_hz: [f64; 2],
    /// Part of the work before and within the current period multiple.
    before: f64,
    share: f64,
    reached_hz: Option<[f64; 2]>,
    fraction: f64,
}

impl Done {
    pub(super) fn new(store: &Store, plan: &Plan) -> Result<Self, StoreError> {
        let branches = store.branches()?;
        Ok(Self {
            new_solutions: 0,
            solutions: branches.iter().map(|branch| branch.up.solutions + branch.down.solutions).sum(),
            range_hz: plan.range_hz,
            before: 0.0,
            share: 1.0,
            reached_hz: None,
            fraction: 0.0,
        })
    }

    /// The search with that index in the plan begins.
    ///
    /// Every period multiple counts the same. A harmonic branch is expected to take all of its share, a
    /// subharmonic one as much as the searches that are left for it.
    pub(super) fn begin_target(&mut self, plan: &Plan, index: usize) {
        let mut multiples: Vec<u32> = plan.targets.iter().map(|target| target.period_multiple).collect();
        let current = multiples[index];
        let (within, first) = (
            multiples.iter().filter(|multiple| **multiple == current).count(),
            multiples.iter().position(|multiple| *multiple == current).unwrap_or(index),
        );
        multiples.dedup();
        let place = multiples.iter().position(|multiple| *multiple == current).unwrap_or(0);
        let unit = 1.0 / multiples.len() as f64;
        let gone = (index - first) as f64 / within as f64;
        self.before = unit * (place as f64 + gone);
        self.share = unit * (1.0 - gone);
        self.reached_hz = None;
    }

    /// New solutions, the newest at that frequency.
    pub(super) fn add(&mut self, solutions: u64, frequency_hz: f64) {
        self.new_solutions += solutions;
        self.solutions += solutions;
        let [low, high] = self.reached_hz.unwrap_or([frequency_hz; 2]);
        self.reached_hz = Some([low.min(frequency_hz), high.max(frequency_hz)]);
        let covered = (high - low) / (self.range_hz[1] - self.range_hz[0]);
        self.fraction = self.fraction.max(self.before + self.share * covered.clamp(0.0, 1.0));
    }

    /// Estimated part of the work that is done, 0 to 1; it never decreases.
    pub(super) fn fraction(&self) -> f64 {
        self.fraction.clamp(0.0, 1.0)
    }
}
