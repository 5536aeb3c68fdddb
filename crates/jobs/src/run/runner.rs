//! The whole run: threads that compute, and the loop that decides, writes and hands out work.

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::{self, Receiver, RecvTimeoutError, SyncSender},
    },
    time::{Duration, Instant},
};

use hammerbeam_results::store::{MOST_STARTS, Store, StoreError};

use super::{
    Plan, Solver, Surveyed,
    agenda::Agenda,
    decide::Decisions,
    estimate::{self, Effort},
    follow_ups,
    schedule::next_task,
    worker::{self, Report, Task, Walked},
};
use crate::{
    DoneShare, Observer, Progress,
    pool::{PATIENCE, Pool, with_pool},
};

/// Time between two estimates of how much is done.
const ESTIMATED: Duration = Duration::from_millis(50);

/// How a run came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RunOutcome {
    /// Everything the study asks for was looked for; what stopped early has its end.
    Done,
    /// The time budget is used up; the same run goes on when it is started again.
    OutOfTime {
        /// Jobs that are not finished.
        jobs_left: usize,
    },
    /// The observer said stop; the same run goes on when it is started again.
    Interrupted,
}

/// Why a run cannot go on.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum RunError {
    /// The store refuses.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A stored start or checkpoint is of no use.
    #[error("the walk from start {start} cannot be followed: {message}")]
    Walk { start: u32, message: String },
    /// A thread ended that should not have.
    #[error("a thread of the run ended unexpectedly")]
    Thread,
}

/// Runs what is left of a plan on so many threads.
///
/// # Errors
/// [`RunError`]; what was stored before stays.
pub fn run(
    store: &mut Store,
    solver: &dyn Solver,
    plan: &Plan,
    threads: usize,
    observer: &mut dyn Observer,
) -> Result<RunOutcome, RunError> {
    let mut agenda = Agenda::load(store, solver, plan)?;
    follow_ups::add_wanted(&mut agenda, store, plan)?;
    let threads = threads.max(1);
    let stop = AtomicBool::new(false);
    let stop = &stop;
    with_pool(threads, |pool| {
        let (sender, reports) = mpsc::sync_channel(4 * threads);
        let started = Instant::now();
        let mut run = Run {
            effort: Effort::new(&agenda),
            done: DoneShare { fraction: store.part_done()?, of_this_run: 0.0 },
            store,
            solver,
            plan,
            agenda,
            observer,
            threads,
            busy: 0,
            new_solutions: 0,
            started,
            estimated: started,
        };
        let outcome = run.work(&Desk { pool, sender, stop }, &reports);
        // Threads that still walk, for nothing any more, see that nobody reads their reports.
        stop.store(true, Ordering::Relaxed);
        drop(reports);
        if let Ok(outcome) = &outcome {
            run.store.note_part_done((*outcome != RunOutcome::Done).then_some(run.done.fraction))?;
        }
        // A panic has been reported on standard error; here it is one error among others.
        if pool.has_panicked() { Err(RunError::Thread) } else { outcome }
    })
}

/// Where tasks are handed over.
struct Desk<'a, 'work> {
    pool: &'a Pool<'work>,
    sender: SyncSender<Report>,
    stop: &'work AtomicBool,
}

struct Run<'a> {
    store: &'a mut Store,
    solver: &'a dyn Solver,
    plan: &'a Plan,
    agenda: Agenda,
    observer: &'a mut dyn Observer,
    threads: usize,
    /// Threads that have a task.
    busy: usize,
    new_solutions: u64,
    effort: Effort,
    done: DoneShare,
    started: Instant,
    /// When it was estimated last how much is done.
    estimated: Instant,
}

impl<'work> Run<'work> {
    fn work(&mut self, desk: &Desk<'_, 'work>, reports: &Receiver<Report>) -> Result<RunOutcome, RunError> {
        let mut interrupted = false;
        loop {
            self.decide()?;
            let left = self.agenda.jobs.iter().filter(|job| job.record.outcome.is_none()).count();
            if left == 0 {
                return Ok(RunOutcome::Done);
            }
            if !interrupted && self.observer.interrupted() {
                interrupted = true;
                desk.stop.store(true, Ordering::Relaxed);
            }
            let out_of_time = self.plan.time.is_some_and(|time| self.started.elapsed() >= time);
            if !interrupted && !out_of_time {
                self.hand_out(desk)?;
            }
            if self.busy == 0 {
                return match (interrupted, out_of_time) {
                    (true, _) => Ok(RunOutcome::Interrupted),
                    (false, true) => Ok(RunOutcome::OutOfTime { jobs_left: left }),
                    (false, false) => Err(RunError::Thread),
                };
            }
            match reports.recv_timeout(PATIENCE) {
                Ok(report) => self.take(report)?,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Err(RunError::Thread),
            }
            if self.estimated.elapsed() >= ESTIMATED {
                self.estimate();
            }
        }
    }

    /// How much is done, and it is noted how long threads have been at what.
    fn estimate(&mut self) {
        self.estimated = Instant::now();
        self.effort.count(&self.agenda);
        let DoneShare { fraction, of_this_run } = self.effort.done(&self.agenda, self.plan);
        self.done = DoneShare { fraction: self.done.fraction.max(fraction), of_this_run };
    }

    fn decide(&mut self) -> Result<(), RunError> {
        let mut decisions =
            Decisions { store: self.store, solver: self.solver, plan: self.plan, observer: self.observer };
        Ok(decisions.take(&mut self.agenda)?)
    }

    fn hand_out(&mut self, desk: &Desk<'_, 'work>) -> Result<(), RunError> {
        while self.busy < self.threads {
            let Some(task) = next_task(&mut self.agenda, self.store, self.solver, self.plan)? else { break };
            if let Task::Evaluate(evaluation) = &task {
                let job = evaluation.job as usize;
                self.estimate();
                self.observer.working(&self.agenda.jobs[job].record, self.done);
            }
            let (solver, sender, stop) = (self.solver, desk.sender.clone(), desk.stop);
            desk.pool.hand(move || worker::work(solver, task, &sender, stop));
            self.busy += 1;
        }
        Ok(())
    }

    fn take(&mut self, report: Report) -> Result<(), RunError> {
        match report {
            Report::Evaluated { job, starts } => {
                self.busy -= 1;
                let record = self.agenda.jobs[job as usize].record.clone();
                let (starts, message) = match starts {
                    Ok(Surveyed { solutions, incomplete }) => {
                        let message = too_many(solutions.len()).or(incomplete);
                        (solutions, message)
                    }
                    Err(message) => (Vec::new(), Some(message)),
                };
                self.store.note_starts(&record, &starts, message.as_deref())?;
                self.agenda.jobs[job as usize].record.message = message;
                self.agenda.add_starts(job, self.store)?;
            }
            Report::Walked(walked) => self.keep(&walked)?,
            Report::Left => self.busy -= 1,
            Report::Lost => return Err(RunError::Thread),
            Report::Failed { key, message } => return Err(RunError::Walk { start: key, message }),
        }
        Ok(())
    }

    /// Commits a stretch of a walk, unless the walk is not wanted any more.
    fn keep(&mut self, walked: &Walked) -> Result<(), RunError> {
        let Walked { key, side, stretch, cancelled } = walked;
        self.busy -= usize::from(stretch.last);
        let Some(start) = self.agenda.start_mut(*key) else { return Ok(()) };
        let running = &start.walk(*side).running;
        if !running.as_ref().is_some_and(|flag| Arc::ptr_eq(flag, cancelled)) {
            return Ok(());
        }
        let (branch, period_multiple) = (start.branch, start.period_multiple);
        self.store.append(*key, *side, &stretch.rows, stretch.continuation())?;
        self.agenda.add_rows(*key, *side, &stretch.rows, stretch.end.as_ref());
        if stretch.last {
            self.agenda.rest(*key, *side);
        }
        self.new_solutions += stretch.rows.len() as u64;
        if let (Some(branch), Some(end)) = (branch, &stretch.end) {
            self.observer.walk_ended(branch, *side, end);
        }
        if let Some(newest) = stretch.rows.last() {
            self.report_progress(newest.solution.frequency_hz, period_multiple);
        }
        Ok(())
    }

    fn report_progress(&mut self, frequency_hz: f64, period_multiple: u32) {
        self.observer.progress(&Progress {
            frequency_hz,
            period_multiple,
            branches_done: self.agenda.accepted().filter(|start| start.is_finished(self.plan)).count(),
            walks_open: self.agenda.starts().map(estimate::walking).sum(),
            new_solutions: self.new_solutions,
            solutions: self.agenda.solutions(),
            done: self.done,
        });
    }
}

/// What is to be said when a job has more starts than can be taken.
pub(super) fn too_many(starts: usize) -> Option<String> {
    (starts > MOST_STARTS as usize).then(|| format!("{starts} starts, of which {MOST_STARTS} are followed"))
}
