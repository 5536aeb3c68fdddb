//! Jobs, starts and walks, as they are in the store, with what is needed of their rows to decide on others.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use hammerbeam_orbit::{BranchEventKind, Side};
use hammerbeam_results::{
    end::BranchEnd,
    row::{Row, SolvedRow},
    store::{JobRecord, StartRecord, Store, StoreError},
};

use super::{plan::Plan, solver::Solver};

/// Distance from the unit circle up to which a multiplier is on it, at a located event.
const ON_CIRCLE: f64 = 1e-3;

/// What is kept of a row in memory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sketch {
    pub frequency_hz: f64,
    pub displacement: f64,
    pub acceleration: f64,
    pub flip: bool,
    /// No other multiplier lies outside the unit circle.
    pub else_stable: bool,
    pub branch_point: bool,
    /// A contact is grazed.
    pub grazes: bool,
    /// Contacts in a period.
    pub contacts: u32,
}

impl Sketch {
    fn of_row(row: &Row) -> Self {
        Self {
            frequency_hz: row.frequency_hz,
            displacement: row.maxima.displacement,
            acceleration: row.maxima.acceleration,
            flip: row.events.has(BranchEventKind::Flip),
            else_stable: is_on_circle(row.leading_multiplier),
            branch_point: row.events.has(BranchEventKind::BranchPoint),
            grazes: row.events.has(BranchEventKind::Grazing),
            contacts: row.maxima.contacts,
        }
    }
}

/// Whether a solution at a bifurcation is as stable as that allows: its leading multiplier is the one on the
/// unit circle.
fn is_on_circle([re, im]: [f64; 2]) -> bool {
    re.hypot(im) < 1.0 + ON_CIRCLE
}

/// One side of a branch.
#[derive(Debug, Default)]
pub(super) struct WalkState {
    pub rows: Vec<Sketch>,
    pub end: Option<BranchEnd>,
    /// A thread is at it; setting the flag asks it to leave.
    pub running: Option<Arc<AtomicBool>>,
    /// Of so many rows it is known whether they lie on a branch that was lost there.
    pub compared: usize,
}

impl WalkState {
    /// Whether nothing is left to walk with this budget.
    pub fn is_finished(&self, plan: &Plan) -> bool {
        let enough = |end: &BranchEnd| !end.is_budget() || self.rows.len() as u64 >= plan.budget;
        self.end.as_ref().is_some_and(enough)
    }

    pub fn is_closed(&self) -> bool {
        self.end.as_ref().is_some_and(BranchEnd::is_closed)
    }

    /// Asks the thread that is at it to leave.
    pub fn cancel(&mut self) {
        if let Some(flag) = self.running.take() {
            flag.store(true, Ordering::Relaxed);
        }
    }
}

/// A start and its two walks.
#[derive(Debug)]
pub(super) struct Start {
    pub key: u32,
    pub period_multiple: u32,
    /// Its number, once it is known to be a new branch.
    pub branch: Option<u32>,
    /// It seems to lie on another start's branch: nothing is walked before that is decided.
    pub doubtful: bool,
    /// Both sides have ended, and were compared with one another.
    pub sides_compared: bool,
    pub up: WalkState,
    pub down: WalkState,
}

impl Start {
    pub fn walk(&self, side: Side) -> &WalkState {
        match side {
            Side::Up => &self.up,
            Side::Down => &self.down,
        }
    }

    pub fn walk_mut(&mut self, side: Side) -> &mut WalkState {
        match side {
            Side::Up => &mut self.up,
            Side::Down => &mut self.down,
        }
    }

    /// Whether a side that was left at its budget has more of it now.
    pub fn goes_on(&self, plan: &Plan) -> bool {
        [&self.up, &self.down].iter().any(|walk| walk.end.is_some() && !walk.is_finished(plan))
    }

    /// Whether both sides are followed as far as they are to be.
    pub fn is_finished(&self, plan: &Plan) -> bool {
        self.up.is_finished(plan) && self.down.is_finished(plan)
    }
}

/// A job with its starts.
#[derive(Debug)]
pub(super) struct Job {
    pub record: JobRecord,
    pub starts: Vec<Start>,
    /// The branch that the last start was on that is gone since it is on one.
    pub on_branch: Option<u32>,
    /// A thread is evaluating it.
    pub running: bool,
}

/// All jobs in their order.
#[derive(Debug)]
pub(super) struct Agenda {
    pub jobs: Vec<Job>,
}

impl Agenda {
    /// What the store holds; the plan's first jobs are added to a store that has none.
    ///
    /// A branch that has more budget now goes on, and what was decided after it is decided again with all of
    /// it.
    pub fn load(store: &mut Store, solver: &dyn Solver, plan: &Plan) -> Result<Self, StoreError> {
        if store.jobs()?.is_empty() {
            store.add_jobs(&plan.first_jobs(&solver.resonances_hz()))?;
        }
        let goes_on = Self::read(store)?.accepted().find(|start| start.goes_on(plan)).map(|start| start.key);
        if let Some(key) = goes_on {
            store.note_part_done(None)?;
            store.take_back_to(key)?;
        }
        store.add_met(&plan.met)?;
        Self::read(store)
    }

    /// What the store holds.
    fn read(store: &Store) -> Result<Self, StoreError> {
        let mut agenda = Self { jobs: Vec::new() };
        agenda.add_new_jobs(store)?;
        for record in store.starts()? {
            let walk = |side| -> Result<WalkState, StoreError> {
                let end = store.walk(record.key, side)?.end;
                let rows = store.walked(record.key, side)?.iter().map(Sketch::of_row).collect();
                Ok(WalkState { rows, end, ..WalkState::default() })
            };
            let start = Start {
                key: record.key,
                period_multiple: record.period_multiple,
                branch: record.branch,
                doubtful: false,
                sides_compared: false,
                up: walk(Side::Up)?,
                down: walk(Side::Down)?,
            };
            agenda.jobs[record.job() as usize].starts.push(start);
        }
        Ok(agenda)
    }

    /// Adds what the store has more of.
    pub fn add_new_jobs(&mut self, store: &Store) -> Result<(), StoreError> {
        let known = self.jobs.len();
        let new = store.jobs()?.into_iter().skip(known);
        self.jobs.extend(new.map(|record| Job {
            record,
            starts: Vec::new(),
            on_branch: None,
            running: false,
        }));
        Ok(())
    }

    /// The solutions at which walks begin, as a thread has found and the store has noted them.
    pub fn add_starts(&mut self, job: u32, store: &Store) -> Result<(), StoreError> {
        let job = &mut self.jobs[job as usize];
        job.record.evaluated = true;
        job.running = false;
        let known: Vec<u32> = job.starts.iter().map(|start| start.key).collect();
        let is_new = |record: &&StartRecord| record.job() == job.record.id && !known.contains(&record.key);
        for record in store.starts()?.iter().filter(is_new) {
            let rows = store.walked(record.key, Side::Up)?.iter().map(Sketch::of_row).collect();
            let down = store.walk(record.key, Side::Down)?.end;
            job.starts.push(Start {
                key: record.key,
                period_multiple: record.period_multiple,
                branch: None,
                doubtful: false,
                sides_compared: false,
                up: WalkState { rows, ..WalkState::default() },
                down: WalkState { end: down, ..WalkState::default() },
            });
        }
        Ok(())
    }

    pub fn starts(&self) -> impl Iterator<Item = &Start> {
        self.jobs.iter().flat_map(|job| &job.starts)
    }

    pub fn accepted(&self) -> impl Iterator<Item = &Start> {
        self.starts().filter(|start| start.branch.is_some())
    }

    /// The row from which the branch of a start leaves another one, if it does.
    pub fn left_from(&self, key: u32) -> Option<i64> {
        let job = self.jobs.iter().find(|job| job.starts.iter().any(|start| start.key == key))?;
        job.record.source.filter(|_| job.record.kind.leaves_source())
    }

    pub fn start_mut(&mut self, key: u32) -> Option<&mut Start> {
        self.jobs.iter_mut().flat_map(|job| &mut job.starts).find(|start| start.key == key)
    }

    /// Notes new rows of a walk.
    pub fn add_rows(&mut self, key: u32, side: Side, rows: &[SolvedRow], end: Option<&BranchEnd>) {
        if let Some(start) = self.start_mut(key) {
            let walk = start.walk_mut(side);
            walk.rows.extend(rows.iter().map(|row| Sketch::of_row(&row.into())));
            walk.end = end.cloned();
        }
    }

    /// Notes that no thread is at a walk any more.
    pub fn rest(&mut self, key: u32, side: Side) {
        if let Some(start) = self.start_mut(key) {
            start.walk_mut(side).running = None;
        }
    }

    /// Whether a harmonic branch passes a frequency.
    pub fn is_covered(&self, frequency_hz: f64) -> bool {
        self.accepted().filter(|start| start.period_multiple == 1).any(|start| {
            let rows = || start.up.rows.iter().chain(&start.down.rows).map(|row| row.frequency_hz);
            let low = rows().fold(f64::INFINITY, f64::min);
            let high = rows().fold(f64::NEG_INFINITY, f64::max);
            (low..=high).contains(&frequency_hz)
        })
    }

    /// Solutions of all branches.
    pub fn solutions(&self) -> u64 {
        self.starts().map(|start| (start.up.rows.len() + start.down.rows.len()) as u64).sum()
    }
}

/// Jobs and starts for tests.
#[cfg(test)]
pub(super) mod examples {
    use hammerbeam_results::store::JobKind;
    use hammerbeam_study::StudyFile;

    use super::{Job, JobRecord, Plan, Sketch, Start, WalkState};

    pub fn plan() -> Plan {
        let text = include_str!("../../../../studies/duffing.toml").to_owned();
        Plan::of(&StudyFile::parse("study.toml", text).expect("a study").study)
    }

    /// A job that is not finished.
    pub fn job(id: u32, kind: JobKind, evaluated: bool) -> Job {
        let record = JobRecord {
            id,
            kind,
            frequency_hz: 50.0,
            source: None,
            depth: 0,
            evaluated,
            message: None,
            outcome: None,
        };
        Job { record, starts: Vec::new(), on_branch: None, running: false }
    }

    /// A start with rows of its upper side.
    pub fn start(key: u32, branch: Option<u32>, rows: Vec<Sketch>) -> Start {
        let up = WalkState { rows, ..WalkState::default() };
        Start {
            key,
            period_multiple: 1,
            branch,
            doubtful: false,
            sides_compared: false,
            up,
            down: WalkState::default(),
        }
    }

    /// A stable row without an event.
    pub fn row(frequency_hz: f64) -> Sketch {
        let (displacement, acceleration) = (1.0, 1.0);
        Sketch {
            frequency_hz,
            displacement,
            acceleration,
            flip: false,
            else_stable: true,
            branch_point: false,
            grazes: false,
            contacts: 0,
        }
    }
}
