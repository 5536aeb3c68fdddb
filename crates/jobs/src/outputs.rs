//! The pass over stored orbits that reads off the outputs of a study (`[[output]]`).
//!
//! What is read off depends on the stored orbit and the study alone. So outputs may come with the run or be
//! added to a finished folder: the same numbers are stored. A pass that was stopped goes on where it was.

use std::collections::VecDeque;

use hammerbeam_motion::{
    System,
    exact::{ExactIntegrator, ExactSettings, MotionError},
};
use hammerbeam_orbit::{OrbitSignal, SignalStatistics, read_orbit};
use hammerbeam_results::{
    Store, StoreError,
    row::SolvedRow,
    store::{BranchRecord, StoredOutputs, keep_outputs, put_outputs, solution_key},
};
use hammerbeam_study::{Model, StudyParameter, file::OutputEntry, output_signals};

use crate::{
    CountedProgress, JobError, Observer, PreparedStudy,
    piece_parameter::piece_parameter,
    pool::{PATIENCE, Pending, with_pool},
};

/// Solutions that a thread takes at once.
const TOGETHER: usize = 64;

/// What came of a pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct OutputPass {
    /// Solutions whose numbers this pass has stored.
    pub solutions: u64,
    /// Those of them whose motion could not be gone over again, which have none.
    pub failed: u64,
    /// Whether the observer has said stop before all were done.
    pub is_interrupted: bool,
}

/// A solution by its key, with the parameter that has another value in its system, if one has.
type Left = (i64, Option<StudyParameter>);
/// What was read off some solutions.
type Found = Vec<(i64, Option<Vec<SignalStatistics>>)>;

/// Reads off what is not stored yet of the outputs of a study, on so many threads.
///
/// # Errors
/// [`JobError::Store`].
pub fn compute_outputs(
    store: &mut Store,
    study: &PreparedStudy,
    threads: usize,
    observer: &mut dyn Observer,
) -> Result<OutputPass, JobError> {
    let outputs = study.file.study.outputs.as_slice();
    keep_outputs(store, outputs)?;
    let mut pass = OutputPass::default();
    if outputs.is_empty() {
        return Ok(pass);
    }
    let left = solutions_left(store, study)?;
    let total = left.len() as u64;
    with_pool(threads, |pool| {
        let mut pending: VecDeque<Pending<Found>> = VecDeque::new();
        let mut parts = left.chunks(TOGETHER);
        loop {
            pass.is_interrupted |= observer.interrupted();
            let next = if pass.is_interrupted { None } else { parts.next() };
            if let Some(part) = next {
                let rows = solved(store, part)?;
                pending.push_back(pool.hand(move || read_all(&study.model, outputs, &rows)));
                if pending.len() <= 2 * pool.threads() {
                    continue;
                }
            }
            let Some(first) = pending.front() else { return Ok(pass) };
            let Some(found) = first.wait(PATIENCE) else { continue };
            pending.pop_front();
            put_outputs(store, &found)?;
            pass.solutions += found.len() as u64;
            pass.failed += found.iter().filter(|(_, numbers)| numbers.is_none()).count() as u64;
            let things = "solutions with their outputs";
            let progress = CountedProgress { done: pass.solutions, total: Some(total), things, place: &"" };
            observer.counted(&progress);
        }
    })
}

/// Solutions of branches that have no numbers yet, in their order.
fn solutions_left(store: &Store, study: &PreparedStudy) -> Result<Vec<Left>, StoreError> {
    let done = StoredOutputs::of(store)?.keys()?;
    let keys = |branch: &BranchRecord| {
        let start = branch.start;
        let keys = branch.places().map(move |(side, number)| solution_key(start, side, number));
        keys.filter(|key| !done.contains(key)).collect::<Vec<i64>>()
    };
    let mut left = Vec::new();
    for branch in store.branches()? {
        left.extend(keys(&branch).into_iter().map(|key| (key, None)));
    }
    for piece in store.pieces()? {
        // Of a parameter that is gone the piece is, too, with the next run.
        let Ok(parameter) = piece_parameter(&piece, study) else { continue };
        for branch in &piece.branches {
            left.extend(keys(branch).into_iter().map(|key| (key, Some(parameter))));
        }
    }
    Ok(left)
}

fn solved(store: &Store, part: &[Left]) -> Result<Vec<(Left, SolvedRow)>, StoreError> {
    part.iter().map(|left| Ok((*left, store.solved_row(left.0)?))).collect()
}

fn read_all(model: &Model, outputs: &[OutputEntry], rows: &[(Left, SolvedRow)]) -> Found {
    let mut usual: Option<Reader> = None;
    let mut read = |(left, row): &(Left, SolvedRow)| -> Option<Vec<SignalStatistics>> {
        match left.1 {
            None => {
                if usual.is_none() {
                    usual = Reader::of(model, outputs, model.system.clone());
                }
                usual.as_mut()?.read(outputs, row)
            }
            Some(parameter) => {
                let (system, _) = model.with_parameter(&parameter, row.parameter).ok()?;
                Reader::of(model, outputs, system)?.read(outputs, row)
            }
        }
    };
    rows.iter().map(|row| (row.0.0, read(row))).collect()
}

/// Reads outputs off orbits of one system.
struct Reader {
    integrator: ExactIntegrator,
    signals: Vec<OrbitSignal>,
}

impl Reader {
    fn of(model: &Model, outputs: &[OutputEntry], system: System) -> Option<Self> {
        let signals = output_signals(model, outputs, &system)?;
        let integrator: Result<ExactIntegrator, MotionError> =
            ExactIntegrator::new(system, ExactSettings::default());
        Some(Self { integrator: integrator.ok()?, signals })
    }

    fn read(&mut self, outputs: &[OutputEntry], row: &SolvedRow) -> Option<Vec<SignalStatistics>> {
        let orders = outputs.iter().map(|output| output.harmonics).max().unwrap_or(0);
        let mut found = read_orbit(&mut self.integrator, &row.solution, &self.signals, orders).ok()?;
        for (statistics, output) in found.iter_mut().zip(outputs) {
            statistics.harmonics.truncate((output.harmonics * row.solution.period_multiple) as usize);
        }
        Some(found)
    }
}
