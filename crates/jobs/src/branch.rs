//! One side of a branch, row by row: an iterator over its solutions.

use std::collections::VecDeque;

use hammerbeam_orbit::{BranchRow, BranchWalk, OrbitError, PeriodicSolution, Side, StopReason};
use hammerbeam_results::end::BranchEnd;

use crate::{PreparedStudy, orbit_solver::settings};

/// The rows of one side of a branch, in the order of the path: its start first, folds, flips and other events
/// as rows of their own.
///
/// Whoever takes the rows decides how many: nothing is computed ahead.
#[derive(Debug)]
pub struct BranchRows {
    walk: BranchWalk,
    /// Rows that are computed and not yet taken.
    ready: VecDeque<BranchRow>,
    end: Option<StopReason>,
    has_started: bool,
    has_failed: bool,
}

impl PreparedStudy {
    /// Follows a branch over the frequency from a periodic solution, to one side, within the range of the
    /// study.
    ///
    /// # Errors
    /// [`OrbitError`]: the start is outside the range, or does not converge.
    pub fn follow(&self, start: &PeriodicSolution, side: Side) -> Result<BranchRows, OrbitError> {
        let (study, model) = (&self.file.study, &self.model);
        let [low, high] = study.excitation.range_hz();
        let settings = settings(&study.continuation);
        let walk = BranchWalk::new(&model.system, &model.response, start, side, (low, high), &settings)?;
        Ok(BranchRows { walk, ready: VecDeque::new(), end: None, has_started: false, has_failed: false })
    }
}

impl BranchRows {
    /// How the branch ended, once all rows are taken: [`BranchEnd`] displays it in a sentence, and shows
    /// whether it ended where it should.
    #[must_use]
    pub fn end(&self) -> Option<BranchEnd> {
        self.end.clone().map(BranchEnd::from)
    }

    /// More rows, or the end.
    fn more(&mut self) -> Result<(), OrbitError> {
        if !self.has_started {
            self.has_started = true;
            self.ready.push_back(self.walk.start_row()?);
            return Ok(());
        }
        let mut rows = Vec::new();
        self.end = self.walk.step(&mut rows)?;
        self.ready.extend(rows);
        Ok(())
    }
}

impl Iterator for BranchRows {
    type Item = Result<BranchRow, OrbitError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(row) = self.ready.pop_front() {
                return Some(Ok(row));
            }
            if self.end.is_some() || self.has_failed {
                return None;
            }
            if let Err(error) = self.more() {
                self.has_failed = true;
                return Some(Err(error));
            }
        }
    }
}
