//! What a run tells while it works, and how it is stopped.

use hammerbeam_orbit::{PeriodicSolution, Side};

use super::Target;
use crate::store::StoredReason;

/// Where a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Branch that is being followed.
    pub branch: u32,
    /// Its orbit period over excitation period.
    pub period_multiple: u32,
    /// Side of its start.
    pub side: Side,
    /// Frequency of the newest solution [Hz].
    pub frequency_hz: f64,
    /// Solutions computed by this run; what was stored before does not count.
    pub new_solutions: u64,
    /// Solutions stored or about to be, of all runs.
    pub solutions: u64,
    /// Estimated part of the work that is done, 0 to 1; it never decreases.
    pub fraction: f64,
}

/// Watches a run.
pub trait Observer {
    /// A search for a start begins.
    fn searching(&mut self, _target: &Target) {}
    /// A search ended without a new branch.
    fn nothing_found(&mut self, _target: &Target, _why: &str) {}
    /// A branch begins.
    fn branch_begun(&mut self, _branch: u32, _start: &PeriodicSolution) {}
    /// There are new solutions.
    fn progress(&mut self, _progress: &Progress) {}
    /// A walk ended.
    fn walk_ended(&mut self, _branch: u32, _side: Side, _reason: &StoredReason) {}
    /// Whether to stop; asked between solutions.
    fn interrupted(&mut self) -> bool {
        false
    }
}

/// An observer that says nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Quiet;

impl Observer for Quiet {}
