//! One piece: what is left to do of it follows from what is stored.
//!
//! First its starts are searched. Then one start after the other is looked at: one that lies on a branch that
//! was followed before is dropped, any other one is followed to the down side, then to the up side.
//!
//! The walk to the up side puts the start as it has it in the place of the one that was found. Only then the
//! branch has a number: rows of numbered branches never change.

use hammerbeam_orbit::{PeriodicSolution, Side};
use hammerbeam_results::store::{
    BranchRecord, PieceRecord, StartRecord, Store, StoreError, StoredMemory, solution_key,
};

use super::{
    solver::{Failed, PieceSolver},
    watch::{PieceNews, Watch, WatchedWalk, Way},
};
use crate::walk::{WalkLimits, walk_on};

/// A piece that is being computed.
pub(super) struct PieceWork<'a> {
    pub record: PieceRecord,
    /// How it is computed, or why it cannot be.
    pub solver: Result<&'a dyn PieceSolver, String>,
    /// A thread is at it.
    pub is_running: bool,
}

/// What a thread does of a piece.
#[derive(Debug)]
pub(super) enum PieceTask {
    Search,
    Walk(Box<PieceWalk>),
}

/// A side that is walked, from its start or from where it was left.
#[derive(Debug)]
pub(super) struct PieceWalk {
    pub start: u32,
    pub side: Side,
    pub orbit: PeriodicSolution,
    pub memory: Option<StoredMemory>,
    /// Solutions that are stored of it.
    pub stored: u64,
    /// Part of the piece that is done before this start, and part of it that a start is.
    pub share: [f64; 2],
}

impl PieceWork<'_> {
    /// What is to be done next; `None` if the piece is finished, which is then noted.
    pub fn next_task(&mut self, store: &mut Store) -> Result<Option<PieceTask>, StoreError> {
        if self.record.finished {
            return Ok(None);
        }
        if let Err(message) = &self.solver {
            let message = message.clone();
            return self.finish(store, Some(&message));
        }
        if !self.record.searched {
            return Ok(Some(PieceTask::Search));
        }
        let starts = store.starts_of_piece(self.record.key)?;
        for (index, start) in starts.iter().enumerate() {
            if start.branch.is_none() {
                match self.is_known(store, start, &starts[..index])? {
                    Ok(true) => {
                        store.drop_start(start.key)?;
                        return self.next_task(store);
                    }
                    Ok(false) => {}
                    Err(message) => return self.finish(store, Some(&message)),
                }
            }
            let share = [index as f64, 1.0].map(|part| part / starts.len() as f64);
            if let Some(walk) = open_side(store, start.key, share)? {
                return Ok(Some(PieceTask::Walk(Box::new(walk))));
            }
            number_branch(store, start)?;
        }
        self.finish(store, None)
    }

    /// Notes that the piece is finished.
    pub fn finish(
        &mut self,
        store: &mut Store,
        message: Option<&str>,
    ) -> Result<Option<PieceTask>, StoreError> {
        self.record.finished = true;
        store.finish_piece(self.record.key, message)?;
        Ok(None)
    }

    /// Takes what a thread reports; errors of the numerics end the piece.
    pub fn take(&mut self, store: &mut Store, news: PieceNews) -> Result<(), StoreError> {
        let failed = match news {
            PieceNews::Row { .. } => return Ok(()),
            PieceNews::Left => None,
            PieceNews::Searched(Ok(found)) => {
                let message = found.message.as_deref();
                store.note_piece_starts(self.record.key, found.parameter, &found.starts, message)?;
                self.record.searched = true;
                None
            }
            PieceNews::Searched(Err(failed)) => Some(failed),
            PieceNews::Walked { start, side, stretch, from_start } => {
                let (rows, continuation) = (&stretch.rows, stretch.continuation());
                if from_start {
                    store.begin_walk(start, side, rows, continuation)?;
                    if side == Side::Up {
                        self.number(store, start)?;
                    }
                } else {
                    store.append(start, side, rows, continuation)?;
                }
                if !stretch.last {
                    return Ok(());
                }
                None
            }
            PieceNews::NotOpened { start, failed } => {
                if !matches!(failed, Failed::Interrupted) {
                    store.drop_start(start)?;
                }
                Some(failed)
            }
        };
        self.is_running = false;
        match failed {
            Some(Failed::Message(message)) => self.finish(store, Some(&message)).map(|_| ()),
            Some(Failed::Interrupted) | None => Ok(()),
        }
    }

    /// Numbers the branch of a start, by its key.
    fn number(&self, store: &mut Store, key: u32) -> Result<(), StoreError> {
        let starts = store.starts_of_piece(self.record.key)?;
        starts.iter().filter(|start| start.key == key).try_for_each(|start| number_branch(store, start))
    }

    /// Whether a start lies on a branch that was followed from an earlier one, or why that is not known.
    fn is_known(
        &self,
        store: &Store,
        start: &StartRecord,
        earlier: &[StartRecord],
    ) -> Result<Result<bool, String>, StoreError> {
        let Ok(solver) = &self.solver else { return Ok(Ok(false)) };
        let mut states = Vec::new();
        for other in earlier {
            let (up, down) = (store.walk(other.key, Side::Up)?, store.walk(other.key, Side::Down)?);
            let (id, period_multiple) = (other.branch.unwrap_or_default(), other.period_multiple);
            let branch = BranchRecord { id, start: other.key, period_multiple, up, down };
            states.extend(crossings(store, &branch, solver.way().1)?);
        }
        if states.is_empty() {
            return Ok(Ok(false));
        }
        let orbit = store.solution(start.key, Side::Up, 0)?;
        Ok(match solver.is_near(&orbit, &states) {
            Ok(is_near) => Ok(is_near),
            Err(Failed::Message(message)) => Err(message),
            Err(Failed::Interrupted) => Ok(false),
        })
    }

    /// Does a task and reports what came of it.
    pub fn work(solver: &dyn PieceSolver, task: &PieceTask, watch: &Watch<'_>) {
        match task {
            PieceTask::Search => {
                let found = solver.search(&|| watch.interrupted());
                watch.report(PieceNews::Searched(found));
            }
            PieceTask::Walk(walk) => follow(solver, walk, watch),
        }
    }
}

/// Numbers a branch that has no number yet.
fn number_branch(store: &mut Store, start: &StartRecord) -> Result<(), StoreError> {
    match start.branch {
        Some(_) => Ok(()),
        None => store.accept_start(start.key).map(|_| ()),
    }
}

/// The side of a start that is to be walked next, if one is; the up side of a closed branch is not.
fn open_side(store: &mut Store, start: u32, share: [f64; 2]) -> Result<Option<PieceWalk>, StoreError> {
    for side in [Side::Down, Side::Up] {
        let walk = store.walk(start, side)?;
        let Some(end) = walk.end else {
            let orbit = store.solution(start, Side::Up, 0)?;
            let memory = store.checkpoint(start, side)?;
            let stored = if memory.is_some() { walk.solutions } else { 0 };
            return Ok(Some(PieceWalk { start, side, orbit, memory, stored, share }));
        };
        if side == Side::Down && end.is_closed() {
            // One walk is all of it.
            store.cut_walk(start, Side::Up, 0, &end)?;
        }
    }
    Ok(None)
}

fn follow(solver: &dyn PieceSolver, walk: &PieceWalk, watch: &Watch<'_>) {
    let (start, side) = (walk.start, walk.side);
    let opened = match &walk.memory {
        None => solver.begin(&walk.orbit, side),
        Some(memory) => solver.resume(memory),
    };
    let opened = match opened {
        Ok(opened) => opened,
        Err(failed) => {
            watch.report(PieceNews::NotOpened { start, failed });
            return;
        }
    };
    let (range, value) = solver.way();
    let way = Way::new(range, value);
    let mut watched =
        WatchedWalk { walk: opened, watch, way, second_side: side == Side::Up, share: walk.share };
    let limits = WalkLimits { stored: walk.stored, budget: u64::MAX, share: None };
    let (mut from_start, mut is_reported) = (walk.memory.is_none(), false);
    walk_on(&mut watched, limits, &|| watch.interrupted(), &mut |stretch| {
        is_reported = stretch.last;
        let from_start = std::mem::take(&mut from_start);
        watch.report(PieceNews::Walked { start, side, stretch, from_start })
    });
    if !is_reported {
        watch.report(PieceNews::Left);
    }
}

/// Phases and states near the orbits in which a branch passes a value of its parameter.
fn crossings(store: &Store, branch: &BranchRecord, value: f64) -> Result<Vec<(f64, Vec<f64>)>, StoreError> {
    let rows = store.placed_rows(branch)?;
    let mut found = Vec::new();
    for pair in rows.windows(2) {
        let (a, b) = (pair[0].row.parameter - value, pair[1].row.parameter - value);
        if a * b > 0.0 {
            continue;
        }
        let share = if a == b { 0.0 } else { a / (a - b) };
        let key = |index: usize| solution_key(branch.start, pair[index].side, pair[index].number);
        let [from, to] = [store.solution_of_key(key(0))?, store.solution_of_key(key(1))?];
        if from.phase == to.phase {
            let states = from.nodes[0].iter().zip(&to.nodes[0]);
            found.push((from.phase, states.map(|(x, y)| x + share * (y - x)).collect()));
        } else {
            // The orbits were cut anew between the rows: their nodes are no neighbours.
            found.extend([from, to].map(|orbit| (orbit.phase, orbit.nodes[0].clone())));
        }
    }
    Ok(found)
}
