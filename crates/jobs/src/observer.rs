//! What a job reports while it works, and how it is stopped: one observer for every job.

use std::fmt::Display;

use hammerbeam_orbit::Side;
use hammerbeam_results::{
    end::BranchEnd,
    store::{JobOutcome, JobRecord},
};

/// How much of a run is done, as far as that is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoneShare {
    /// Estimated part of the whole work that is done, by earlier runs of the same results too, 0 to 1; it
    /// never decreases.
    pub fraction: f64,
    /// Estimated part of the work of this run alone that is done, 0 to 1; it falls where more work turns up.
    pub of_this_run: f64,
}

/// Where a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Frequency of the newest solution [Hz].
    pub frequency_hz: f64,
    /// Orbit period over excitation period of the newest solution.
    pub period_multiple: u32,
    /// Branches that are finished.
    pub branches_done: usize,
    /// Walks that are being followed now.
    pub walks_open: usize,
    /// Solutions computed by this run; what was stored before does not count.
    pub new_solutions: u64,
    /// Solutions stored or about to be, of all runs.
    pub solutions: u64,
    /// How much is done.
    pub done: DoneShare,
}

/// Where the computing of varied branches and curves is, which comes after the diagram.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VariedProgress<'a> {
    /// Name of the parameter of the newest solution.
    pub parameter: &'a str,
    /// Its value, in the unit of its name.
    pub value: f64,
    /// Frequency of the newest solution [Hz].
    pub frequency_hz: f64,
    /// Pieces (`[[vary]]`, `[[curve]]`) that are computed.
    pub pieces_done: usize,
    /// Pieces that this run has to compute.
    pub pieces: usize,
    /// Solutions of them computed by this run.
    pub new_solutions: u64,
    /// Estimated part of all pieces of the study that is done, by earlier runs too, 0 to 1; it never
    /// decreases.
    pub fraction: f64,
}

/// Where a job is whose work is counted.
#[derive(Clone, Copy)]
pub struct CountedProgress<'a> {
    /// How many are done, of this job and of those that it goes on from.
    pub done: u64,
    /// How many there are, if that is known.
    pub total: Option<u64>,
    /// What is counted: `frequencies`, `cells`.
    pub things: &'a str,
    /// Where the work is; it may be empty.
    pub place: &'a dyn Display,
}

/// Watches a job, from the thread that called it.
pub trait Observer {
    /// A search of a run is being worked at, when so much of the run is done.
    fn working(&mut self, _job: &JobRecord, _done: DoneShare) {}
    /// A search of a run ended; its outcome, in words.
    fn job_ended(&mut self, _job: &JobRecord, _outcome: JobOutcome) {}
    /// A start of a run is that of a new branch.
    fn branch_begun(&mut self, _branch: u32, _period_multiple: u32) {}
    /// There are new solutions of a run.
    fn progress(&mut self, _progress: &Progress) {}
    /// There is a new solution of a varied branch or a curve.
    fn varied(&mut self, _progress: &VariedProgress<'_>) {}
    /// One side of a branch of a run ended.
    fn walk_ended(&mut self, _branch: u32, _side: Side, _end: &BranchEnd) {}
    /// More of what is counted is done.
    fn counted(&mut self, _progress: &CountedProgress<'_>) {}
    /// Something that a user should know although the job goes on: a warning, or the stage that starts now.
    fn notice(&mut self, _notice: &dyn Display) {}
    /// Only short pieces of work are left, which end in order: tables, say.
    fn finishing(&mut self) {}
    /// Whether to stop; asked several times a second.
    fn interrupted(&mut self) -> bool {
        false
    }
}

/// An observer that says nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Quiet;

impl Observer for Quiet {}
