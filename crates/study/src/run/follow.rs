//! Following one side of a branch into the store.

use std::time::{Duration, Instant};

use hammerbeam_orbit::{BranchRow, Side, StopReason};

use super::{Observer, Plan, Progress, RunError, Solver, Walk, done::Done, runner::Ended};
use crate::store::{Continuation, Memory, Store, StoredReason};

/// Solutions are committed together after this time,
const COMMIT_AFTER: Duration = Duration::from_millis(200);
/// or when there are so many of them.
const COMMIT_AT: usize = 2000;

/// A walk, or why it could not begin.
type Opened<'s> = Result<Box<dyn Walk + 's>, StoredReason>;

/// One side of a branch, from where the store has it.
pub(super) struct Follow<'a> {
    pub store: &'a mut Store,
    pub solver: &'a dyn Solver,
    pub plan: &'a Plan,
    pub branch: u32,
    pub period_multiple: u32,
    pub side: Side,
}

impl Follow<'_> {
    /// Follows the side until it ends or the observer says stop.
    pub(super) fn run(&mut self, done: &mut Done, observer: &mut dyn Observer) -> Result<Ended, RunError> {
        let mut stored = self.store.walk(self.branch, self.side)?.solutions;
        let solver = self.solver;
        let mut walk = match self.open(solver)? {
            Ok(walk) => walk,
            Err(reason) => {
                // Told as the end of this side; the other branches go on.
                self.store.append(self.branch, self.side, &[], Continuation::Ended(&reason))?;
                observer.walk_ended(self.branch, self.side, &reason);
                return Ok(Ended::Finished);
            }
        };
        loop {
            let (rows, reason) = self.stretch(walk.as_mut(), stored, done, observer)?;
            stored += rows.len() as u64;
            self.commit(&rows, walk.as_mut(), reason.as_ref())?;
            if let Some(reason) = reason {
                observer.walk_ended(self.branch, self.side, &reason);
                return Ok(Ended::Finished);
            }
            if observer.interrupted() {
                return Ok(Ended::Interrupted);
            }
        }
    }

    /// The walk where the store has left it.
    fn open<'s>(&self, solver: &'s dyn Solver) -> Result<Opened<'s>, RunError> {
        if let Some(memory) = self.store.checkpoint(self.branch, self.side)? {
            return solver
                .resume(&memory.checkpoint, &memory.journal)
                .map(Ok)
                .map_err(|message| self.failed(message));
        }
        let start = self.store.solution(self.branch, Side::Up, 0)?;
        Ok(solver.begin(&start, self.side).map_err(|message| StoredReason::not_begun(&message)))
    }

    fn failed(&self, message: String) -> RunError {
        RunError::Walk { branch: self.branch, message }
    }

    /// Solutions to be committed together, and why the walk ended with them if it did.
    fn stretch(
        &self,
        walk: &mut dyn Walk,
        stored: u64,
        done: &mut Done,
        observer: &mut dyn Observer,
    ) -> Result<(Vec<BranchRow>, Option<StoredReason>), RunError> {
        let begun = Instant::now();
        let mut rows = Vec::new();
        loop {
            if stored + rows.len() as u64 >= self.plan.budget {
                let reason = StopReason::Budget { solutions: self.plan.budget as usize };
                return Ok((rows, Some(StoredReason::of(&reason))));
            }
            let before = rows.len();
            let reason = walk.step(&mut rows).map_err(|message| self.failed(message))?;
            self.tell(&rows[before..], done, observer);
            if let Some(reason) = reason {
                return Ok((rows, Some(StoredReason::of(&reason))));
            }
            if rows.len() >= COMMIT_AT || begun.elapsed() >= COMMIT_AFTER || observer.interrupted() {
                return Ok((rows, None));
            }
        }
    }

    fn tell(&self, rows: &[BranchRow], done: &mut Done, observer: &mut dyn Observer) {
        let Some(newest) = rows.last() else { return };
        let frequency_hz = newest.solution.frequency_hz;
        done.add(rows.len() as u64, frequency_hz);
        observer.progress(&Progress {
            branch: self.branch,
            period_multiple: self.period_multiple,
            side: self.side,
            frequency_hz,
            new_solutions: done.new_solutions,
            solutions: done.solutions,
            fraction: done.fraction(),
        });
    }

    fn commit(
        &mut self,
        rows: &[BranchRow],
        walk: &mut dyn Walk,
        reason: Option<&StoredReason>,
    ) -> Result<(), RunError> {
        let (checkpoint, journal) = (walk.checkpoint(), walk.take_journal());
        let memory = Memory { checkpoint: &checkpoint, journal: &journal };
        let continuation = match reason {
            None => Continuation::GoesOn(memory),
            Some(reason) if reason.is_budget() => Continuation::Paused(reason, memory),
            Some(reason) => Continuation::Ended(reason),
        };
        Ok(self.store.append(self.branch, self.side, rows, continuation)?)
    }
}
