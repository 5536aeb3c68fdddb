//! One side of a branch or a curve, whatever it runs along: walked in stretches that are committed together,
//! each with all that is needed to go on behind it.

use std::time::{Duration, Instant};

use hammerbeam_orbit::StopReason;
use hammerbeam_results::{
    end::BranchEnd,
    row::SolvedRow,
    store::{Continuation, Memory},
};

/// Solutions are handed over together after this time,
const SEND_AFTER: Duration = Duration::from_millis(200);
/// or when there are so many of them.
const SEND_AT: u64 = 2000;

/// A walk along one side of a branch.
pub trait Walk {
    /// Appends the next solutions in the order of the path; `Some` when the walk has ended.
    ///
    /// # Errors
    /// Why there is neither a solution nor an end, in words.
    fn step(&mut self, rows: &mut Vec<SolvedRow>) -> Result<Option<BranchEnd>, String>;

    /// All that is needed to go on from here, besides the journal; replaces the last one. `None` where the
    /// walk can only be done from its start to its end.
    fn checkpoint(&self) -> Option<Vec<u8>>;

    /// What the walk has to keep of the solutions since the journal was taken last.
    fn take_journal(&mut self) -> Vec<u8>;
}

/// Solutions of a walk, to be committed together.
#[derive(Debug)]
pub(crate) struct Stretch {
    pub rows: Vec<SolvedRow>,
    pub checkpoint: Vec<u8>,
    pub journal: Vec<u8>,
    /// How the walk ended with them, if it did.
    pub end: Option<BranchEnd>,
    /// Whether whoever walks has left the walk.
    pub last: bool,
}

impl Stretch {
    /// A walk that ends where it should have started.
    pub fn not_started(message: String) -> Self {
        let end = Some(BranchEnd::NotStarted { message });
        Self { rows: Vec::new(), checkpoint: Vec::new(), journal: Vec::new(), end, last: true }
    }

    /// How the walk goes on behind it.
    pub fn continuation(&self) -> Continuation<'_> {
        let memory = Memory { checkpoint: &self.checkpoint, journal: &self.journal };
        match &self.end {
            None => Continuation::GoesOn(memory),
            Some(end) if end.is_budget() => Continuation::Paused(end, memory),
            Some(end) => Continuation::Ended(end),
        }
    }
}

/// How far a walk goes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WalkLimits {
    /// Solutions that are stored of it.
    pub stored: u64,
    /// Most solutions of it.
    pub budget: u64,
    /// New solutions after which it is left to others, if it is to be.
    pub share: Option<u64>,
}

/// Walks until the walk ends, its share is walked, it is to be left, or nobody wants more of it.
///
/// * `leave`: whether to leave it, asked at every step.
/// * `send`: takes each stretch; whether more is wanted.
pub(crate) fn walk_on(
    walk: &mut dyn Walk,
    limits: WalkLimits,
    leave: &dyn Fn() -> bool,
    send: &mut dyn FnMut(Stretch) -> bool,
) {
    let mut stored = limits.stored;
    loop {
        let mut rows = Vec::new();
        let left = limits.share.map_or(u64::MAX, |share| share.saturating_sub(stored - limits.stored));
        // What cannot be computed ends its side and nothing else.
        let end = stretch(walk, &mut rows, (stored, limits.budget), left.min(SEND_AT), leave)
            .unwrap_or_else(|message| Some(BranchEnd::Failed { message }));
        stored += rows.len() as u64;
        let last = end.is_some() || leave() || rows.len() as u64 >= left;
        let checkpoint = walk.checkpoint();
        if end.is_none() && checkpoint.is_none() {
            return;
        }
        let (checkpoint, journal) = (checkpoint.unwrap_or_default(), walk.take_journal());
        if !send(Stretch { rows, checkpoint, journal, end, last }) || last {
            return;
        }
    }
}

/// Appends solutions that are handed over together, so many or a few more; how the walk ended with them if it
/// did.
fn stretch(
    walk: &mut dyn Walk,
    rows: &mut Vec<SolvedRow>,
    (stored, budget): (u64, u64),
    most: u64,
    leave: &dyn Fn() -> bool,
) -> Result<Option<BranchEnd>, String> {
    let started = Instant::now();
    let can_pause = walk.checkpoint().is_some();
    loop {
        if stored + rows.len() as u64 >= budget {
            return Ok(Some(StopReason::Budget { solutions: budget as usize }.into()));
        }
        if let Some(end) = walk.step(rows)? {
            return Ok(Some(end));
        }
        let is_enough = rows.len() as u64 >= most || started.elapsed() >= SEND_AFTER;
        if can_pause && is_enough || leave() {
            return Ok(None);
        }
    }
}
