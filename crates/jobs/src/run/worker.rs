//! What a thread does: evaluates a job, or walks one side of a branch and sends what it finds.

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::SyncSender,
    },
    thread,
    time::{Duration, Instant},
};

use hammerbeam_orbit::{BranchRow, Crossing, Side, StopReason};
use hammerbeam_results::store::{StoredMemory, StoredReason};

use super::{Origin, Solver, Surveyed, Walk};

/// Solutions are sent together after this time,
const SEND_AFTER: Duration = Duration::from_millis(200);
/// or when there are so many of them.
const SEND_AT: u64 = 2000;

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
    /// Tells it to leave.
    pub cancelled: Arc<AtomicBool>,
}

#[derive(Debug)]
pub(super) enum From {
    Origin(Origin),
    Memory(StoredMemory),
}

/// What a thread has to say.
#[derive(Debug)]
pub(super) enum Report {
    /// What came of a job.
    Evaluated { job: u32, starts: Result<Surveyed, String> },
    /// More of a walk.
    Walked(Stretch),
    /// The task was given up as it was told; there is nothing more of it.
    Left,
    /// A stored walk cannot be taken up.
    Failed { key: u32, message: String },
    /// The thread has panicked: its task will never be done.
    Lost,
}

/// Tells of a panic, so that nobody waits for the thread.
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
pub(super) struct Stretch {
    pub key: u32,
    pub side: Side,
    pub rows: Vec<BranchRow>,
    pub checkpoint: Vec<u8>,
    pub journal: Vec<u8>,
    /// Why the walk ended with them, if it did.
    pub reason: Option<StoredReason>,
    /// Whether the thread has left the walk.
    pub last: bool,
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
            // Only a branch that can be begun is one.
            solver.begin(&Origin::Crossing(crossing.clone()), Side::Up)?;
            Ok(complete(vec![solver.root(crossing)?]))
        }
    }
}

/// Walks until the walk ends, its share is walked, it is to leave, or nobody reads reports any more.
fn walk(solver: &dyn Solver, task: &WalkTask, reports: &SyncSender<Report>, stop: &AtomicBool) {
    let opened = match &task.from {
        From::Origin(origin) => solver.begin(origin, task.side),
        From::Memory(memory) => solver.resume(&memory.checkpoint, &memory.journal),
    };
    let mut walk = match opened {
        Ok(walk) => walk,
        Err(message) => {
            let _ = reports.send(not_opened(task, message));
            return;
        }
    };
    let leave = || stop.load(Ordering::Relaxed) || task.cancelled.load(Ordering::Relaxed);
    let mut stored = task.stored;
    loop {
        let mut rows = Vec::new();
        let left = task.share.map_or(u64::MAX, |share| share.saturating_sub(stored - task.stored));
        // What cannot be computed ends its side and nothing else.
        let reason = stretch(walk.as_mut(), &mut rows, (stored, task.budget), left.min(SEND_AT), &leave)
            .unwrap_or_else(|message| Some(StoredReason::failed(&message)));
        if task.cancelled.load(Ordering::Relaxed) {
            let _ = reports.send(Report::Left);
            return;
        }
        stored += rows.len() as u64;
        let last = reason.is_some() || leave() || rows.len() as u64 >= left;
        let stretch = Stretch {
            key: task.key,
            side: task.side,
            rows,
            checkpoint: walk.checkpoint(),
            journal: walk.take_journal(),
            reason,
            last,
            cancelled: Arc::clone(&task.cancelled),
        };
        if reports.send(Report::Walked(stretch)).is_err() || last {
            return;
        }
    }
}

/// A walk that cannot begin is told as the end of its side; one that cannot be taken up is an error.
fn not_opened(task: &WalkTask, message: String) -> Report {
    match task.from {
        From::Memory(_) => Report::Failed { key: task.key, message },
        From::Origin(_) => Report::Walked(Stretch {
            key: task.key,
            side: task.side,
            rows: Vec::new(),
            checkpoint: Vec::new(),
            journal: Vec::new(),
            reason: Some(StoredReason::not_begun(&message)),
            last: true,
            cancelled: Arc::clone(&task.cancelled),
        }),
    }
}

/// Appends solutions that are sent together, so many or a few more; why the walk ended with them if it did.
fn stretch(
    walk: &mut dyn Walk,
    rows: &mut Vec<BranchRow>,
    (stored, budget): (u64, u64),
    most: u64,
    leave: &dyn Fn() -> bool,
) -> Result<Option<StoredReason>, String> {
    let begun = Instant::now();
    loop {
        if stored + rows.len() as u64 >= budget {
            let reason = StopReason::Budget { solutions: budget as usize };
            return Ok(Some(StoredReason::of(&reason)));
        }
        if let Some(reason) = walk.step(rows)? {
            return Ok(Some(StoredReason::of(&reason)));
        }
        if rows.len() as u64 >= most || begun.elapsed() >= SEND_AFTER || leave() {
            return Ok(None);
        }
    }
}
