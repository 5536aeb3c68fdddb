//! What a run needs of the numerics; the rest of this module knows no more of them than this.

use hammerbeam_orbit::{BranchRow, Interruption, PeriodicSolution, Side, StopReason};

/// Finds periodic solutions and follows their branches.
pub trait Solver {
    /// A periodic solution of minimal period `period_multiple` near which a branch can begin.
    ///
    /// * `interrupted`: asked now and then; the search ends with an error when it says true.
    ///
    /// # Errors
    /// Why there is none, in words.
    fn find_start(
        &self,
        frequency_hz: f64,
        period_multiple: u32,
        interrupted: Interruption<'_>,
    ) -> Result<PeriodicSolution, String>;

    /// A walk along the branch from its start.
    ///
    /// # Errors
    /// Why it cannot begin, in words.
    fn begin<'a>(&'a self, start: &PeriodicSolution, side: Side) -> Result<Box<dyn Walk + 'a>, String>;

    /// The walk that a checkpoint was taken of; it goes on as if it had never been left.
    ///
    /// * `journal`: everything [`Walk::take_journal`] gave, end to end.
    ///
    /// # Errors
    /// Why it cannot go on, in words.
    fn resume<'a>(&'a self, checkpoint: &[u8], journal: &[u8]) -> Result<Box<dyn Walk + 'a>, String>;
}

/// A walk along one side of a branch.
pub trait Walk {
    /// Appends the next solutions in the order of the path; `Some` when the walk has ended.
    ///
    /// # Errors
    /// Why there is neither a solution nor an end, in words.
    fn step(&mut self, rows: &mut Vec<BranchRow>) -> Result<Option<StopReason>, String>;

    /// All that is needed to go on from here, besides the journal; replaces the last one.
    fn checkpoint(&self) -> Vec<u8>;

    /// What the walk has to remember of the solutions since the journal was taken last.
    fn take_journal(&mut self) -> Vec<u8>;
}
