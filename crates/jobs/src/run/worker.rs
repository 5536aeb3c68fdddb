//! What a thread does: evaluates a job, or walks one side of a branch and sends what it finds.

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::SyncSender,
    },
    thread,
};

use hammerbeam_orbit::{Crossing, Side};
use hammerbeam_results::store::StoredMemory;

use super::solver::{BranchOrigin, Solver, Surveyed};
use crate::walk::{Stretch, WalkLimits, walk_on};

/// A piece of work.
#[derive(Debug)]
pub(super) enum Task {
    Evaluate(Evaluation),
    Walk(WalkTask),
}

/// What is to be evaluated.
#[derive(Debug)]
pub(super) struct Evaluation {
    pub job: u32,
    pub what: Question,
}

#[derive(Debug)]
pub(super) enum Question {
    Harmonic(f64),
    Survey { frequency_hz: f64, width_hz: f64, multiples: Vec<u32> },
    Probe { frequency_hz: f64, multiples: Vec<u32> },
    Leave(Crossing),
}

/// A walk, from its origin or from where it was left.
#[derive(Debug)]
pub(super) struct WalkTask {
    pub key: u32,
    pub side: Side,
    pub from: From,
    /// Solutions that the store has of it.
    pub stored: u64,
    pub budget: u64,
    /// Solutions after which the thread leaves it for others, if it is to.
    pub share: Option<u64>,
    /// Asks it to leave.
    pub cancelled: Arc<AtomicBool>,
}

#[derive(Debug)]
pub(super) enum From {
    Origin(BranchOrigin),
    Memory(StoredMemory),
}

/// What a thread has to say.
#[derive(Debug)]
pub(super) enum Report {
    /// What came of a job.
    Evaluated { job: u32, starts: Result<Surveyed, String> },
    /// More of a walk.
    Walked(Walked),
    /// The task was given up as it was cancelled; there is nothing more of it.
    Left,
    /// A stored walk cannot be taken up.
    Failed { key: u32, message: String },
    /// The thread has panicked: its task will never be done.
    Lost,
}

/// Reports a panic, so that nobody waits for the thread.
struct Alarm<'a>(&'a SyncSender<Report>);

impl Drop for Alarm<'_> {
    fn drop(&mut self) {
        if thread::panicking() {
            // If nobody listens, nobody waits.
            let _ = self.0.send(Report::Lost);
        }
    }
}

/// Solutions of a walk, to be committed together.
#[derive(Debug)]
pub(super) struct Walked {
    pub key: u32,
    pub side: Side,
    pub stretch: Stretch,
    pub cancelled: Arc<AtomicBool>,
}

/// Does a task and reports it, unless nobody reads reports any more.
pub(super) fn work(solver: &dyn Solver, task: Task, reports: &SyncSender<Report>, stop: &AtomicBool) {
    let _alarm = Alarm(reports);
    match task {
        Task::Evaluate(evaluation) => {
            let starts = evaluate(solver, &evaluation.what, stop);
            // What was stopped on the way is asked again by the next run.
            let stopped = starts.is_err() && stop.load(Ordering::Relaxed);
            let report =
                if stopped { Report::Left } else { Report::Evaluated { job: evaluation.job, starts } };
            // If nobody reads it, nobody waits.
            let _ = reports.send(report);
        }
        Task::Walk(task) => walk(solver, &task, reports, stop),
    }
}

fn evaluate(solver: &dyn Solver, question: &Question, stop: &AtomicBool) -> Result<Surveyed, String> {
    let complete = |solutions| Surveyed { solutions, incomplete: None };
    match question {
        Question::Harmonic(frequency_hz) => {
            let mut stopped = || stop.load(Ordering::Relaxed);
            Ok(complete(vec![solver.find_harmonic(*frequency_hz, &mut stopped)?]))
        }
        Question::Survey { frequency_hz, width_hz, multiples } => {
            solver.survey(*frequency_hz, *width_hz, multiples, &mut || stop.load(Ordering::Relaxed))
        }
        Question::Probe { frequency_hz, multiples } => {
            solver.probe(*frequency_hz, multiples, &mut || stop.load(Ordering::Relaxed))
        }
        Question::Leave(crossing) => {
            // Only a branch that can be followed is one.
            solver.begin(&BranchOrigin::Crossing(crossing.clone()), Side::Up)?;
            Ok(complete(vec![solver.root(crossing)?]))
        }
    }
}

/// Walks until the walk ends, its share is walked, it is to leave, or nobody reads reports any more.
fn walk(solver: &dyn Solver, task: &WalkTask, reports: &SyncSender<Report>, stop: &AtomicBool) {
    let report = |stretch: Stretch| {
        let cancelled = Arc::clone(&task.cancelled);
        Report::Walked(Walked { key: task.key, side: task.side, stretch, cancelled })
    };
    let opened = match &task.from {
        From::Origin(origin) => solver.begin(origin, task.side),
        From::Memory(memory) => solver.resume(&memory.checkpoint, &memory.journal),
    };
    let mut walk = match opened {
        Ok(walk) => walk,
        // A walk that cannot begin ends its side; one that cannot be taken up is an error.
        Err(message) => {
            let _ = reports.send(match task.from {
                From::Memory(_) => Report::Failed { key: task.key, message },
                From::Origin(_) => report(Stretch::not_started(message)),
            });
            return;
        }
    };
    let is_cancelled = || task.cancelled.load(Ordering::Relaxed);
    let leave = || stop.load(Ordering::Relaxed) || is_cancelled();
    let limits = WalkLimits { stored: task.stored, budget: task.budget, share: task.share };
    walk_on(walk.as_mut(), limits, &leave, &mut |stretch| {
        let is_wanted = !is_cancelled();
        let news = if is_wanted { report(stretch) } else { Report::Left };
        reports.send(news).is_ok() && is_wanted
    });
}
