//! Settled motions over the frequency: sweeps with the state carried over, and diagrams from many states.

use std::path::PathBuf;

use crate::{
    CountedProgress, FrequencySeries, InitialState, JobError, JobFolders, Observer, PooledOrder,
    PreparedStudy, StoredBranches,
    part::{JobPart, JobPartReport},
    request::{KeptRequest, effort_words, state_words},
    sweep_parts::{SweepPieces, read_sweep_parts},
};
use hammerbeam_attractor::{
    AttractorError, Class, Effort, InOrder, Observable, SectionMap, SweepPoint, SweepSettings, Sweeper,
    SystemMap,
};
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_results::{
    Store,
    export::write_sweep,
    store::{RequestKind, SettledMotion, SettledOrigin},
};

pub use crate::sweep_report::{SweepReport, SweptMotion};

/// What is asked of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepRequest {
    /// The frequencies, from the lowest to the highest.
    pub frequencies: FrequencySeries,
    /// Where the motions begin.
    pub starts: SweepStarts,
    /// Samples of a motion that does not repeat.
    pub samples: usize,
    /// What is spent on the kind of a motion.
    pub effort: Effort,
}

/// Where the motions of a sweep begin.
#[derive(Debug, Clone, PartialEq)]
pub enum SweepStarts {
    /// Where the one at the frequency before has ended; the first one at a state.
    CarriedOver {
        /// The first state.
        initial: InitialState,
        /// Down again as well, from where the sweep up has ended.
        down: bool,
    },
    /// At so many states at every frequency, the same ones each time.
    Many(usize),
}

/// Computes the motions of a sweep, or what is left of them, and writes `sweep.csv` and `sweep_samples.csv`.
///
/// * `threads`: with many states at every frequency; results do not depend on it.
///
/// # Returns
/// The motions: not all of them if the sweep cannot go on, which is reported as a notice.
///
/// # Errors
/// [`JobError`]; [`JobError::Interrupted`] and [`JobError::Stopped`] with the number of motions.
pub fn sweep(
    study: &PreparedStudy,
    request: &SweepRequest,
    folders: JobFolders<'_>,
    threads: usize,
    observer: &mut dyn Observer,
) -> Result<SweepReport, JobError> {
    sweep_with_parts(study, (request, &[]), folders, threads, observer)
}

/// The same, with what parts of it have computed taken from their folders.
///
/// * `parts`: results folders; what they do not have is computed here.
///
/// # Errors
/// [`JobError`]; [`JobError::Store`] of a folder that has no part of it, [`JobError::SweepWithoutParts`].
pub fn sweep_with_parts(
    study: &PreparedStudy,
    (request, parts): (&SweepRequest, &[PathBuf]),
    folders: JobFolders<'_>,
    threads: usize,
    observer: &mut dyn Observer,
) -> Result<SweepReport, JobError> {
    study.file.forced()?;
    let upward = request.frequencies.frequencies()?;
    folders.branches(&study.file)?;
    let state = match &request.starts {
        // A diagram has states of its own.
        SweepStarts::Many(_) => Vec::new(),
        SweepStarts::CarriedOver { initial, .. } => {
            let mut first =
                SystemMap::new(study.model.system.clone(), upward[0], 1, ExactSettings::default())?;
            initial.at(&mut first, study, folders.results)?
        }
    };
    let (kind, pieces) = pieces(request, &upward);
    let words = words(request, &upward, &state);
    if !parts.is_empty() && kind != RequestKind::Starts {
        return Err(JobError::SweepWithoutParts);
    }
    let computed = read_sweep_parts(parts, &study.file, (&words, &upward))?;
    let kept = KeptRequest::open(folders.out, &study.file, (kind, &words), pieces.len() as u64)?;
    let found = kept.read(Store::settled)?;
    let make = || sweeper(study, request);
    let mut work = Work { pieces: &pieces, observer, kept, found };
    match request.starts {
        SweepStarts::Many(starts) => work.diagram(&make, (starts, computed), threads)?,
        SweepStarts::CarriedOver { .. } => work.carried_over(&mut make()?, state)?,
    }
    let Work { found, kept, observer, .. } = work;
    observer.finishing();
    // Under the lock of the folder: two jobs do not write the same tables at once.
    let branches = numbered_and_written(study, folders, &found);
    kept.finish()?;
    let done = found.len() as u64;
    let branches = branches.map_err(|error| error.stopped_after(done))?;
    if observer.interrupted() {
        return Err(JobError::Interrupted { done, part_s: None });
    }
    let motions = found.into_iter().zip(branches).map(|(motion, branch)| SweptMotion { motion, branch });
    let kind = if matches!(request.starts, SweepStarts::Many(_)) { "starts" } else { "sweep" };
    Ok(SweepReport { kind, motions: motions.collect(), results: folders.shown() })
}

/// Computes a part of a sweep from many states, or what is left of it, into a results folder.
///
/// * `threads`: results do not depend on it.
///
/// # Errors
/// [`JobError`]; [`JobError::SweepWithoutParts`] with the state carried over, [`JobError::Interrupted`] with
/// the number of frequencies.
pub fn sweep_part(
    study: &PreparedStudy,
    (request, part): (&SweepRequest, JobPart),
    folders: JobFolders<'_>,
    threads: usize,
    observer: &mut dyn Observer,
) -> Result<JobPartReport, JobError> {
    study.file.forced()?;
    let SweepStarts::Many(starts) = request.starts else { return Err(JobError::SweepWithoutParts) };
    let upward = request.frequencies.frequencies()?;
    let (kind, pieces) = pieces(request, &upward);
    let pieces = &pieces[part.range(upward.len())];
    let words = part.words(&words(request, &upward, &[]));
    let kept = KeptRequest::open(folders.out, &study.file, (kind, &words), pieces.len() as u64)?;
    let mut work = Work { pieces, observer, kept, found: Vec::new() };
    work.diagram(&|| sweeper(study, request), (starts, SweepPieces::new()), threads)?;
    let Work { kept, observer, .. } = work;
    observer.finishing();
    let done = kept.done;
    kept.finish()?;
    match done {
        done if done < pieces.len() as u64 => Err(JobError::Interrupted { done, part_s: None }),
        done => Ok(JobPartReport { part: part.to_string(), pieces: done, results: folders.shown() }),
    }
}

fn sweeper(study: &PreparedStudy, request: &SweepRequest) -> Result<Sweeper, AttractorError> {
    let response = &study.model.response;
    let observable =
        Observable { shape: response.shape.clone(), support_ratios: response.support_ratios.clone() };
    let motion = ExactSettings::default();
    let settings = SweepSettings { effort: request.effort, sampled: request.samples, motion };
    Sweeper::new(&study.model.system, &observable, settings)
}

/// Writes the tables.
///
/// # Returns
/// The branch that each motion lies on. The branches are closed again here: a store that is read cannot be
/// finished.
fn numbered_and_written(
    study: &PreparedStudy,
    folders: JobFolders<'_>,
    found: &[SettledMotion],
) -> Result<Vec<Option<u32>>, JobError> {
    let numbers = match folders.branches(&study.file)? {
        Some(branches) => {
            found.iter().map(|motion| branch(&branches, study, &motion.point)).collect::<Result<_, _>>()?
        }
        None => vec![None; found.len()],
    };
    if let Some(folder) = folders.out {
        write_sweep(folder, "", found, &numbers)?;
    }
    Ok(numbers)
}

/// Directions and frequencies, one after the other.
fn pieces(request: &SweepRequest, upward: &[f64]) -> (RequestKind, Vec<(SettledOrigin, f64)>) {
    let mut pieces: Vec<_> = upward.iter().map(|frequency_hz| (SettledOrigin::Up, *frequency_hz)).collect();
    match request.starts {
        SweepStarts::Many(_) => (RequestKind::Starts, pieces),
        SweepStarts::CarriedOver { down, .. } => {
            if down {
                pieces.extend(upward.iter().rev().map(|frequency_hz| (SettledOrigin::Down, *frequency_hz)));
            }
            (RequestKind::Sweep, pieces)
        }
    }
}

/// What identifies the request in the store.
fn words(request: &SweepRequest, upward: &[f64], state: &[f64]) -> Vec<String> {
    let mut words: Vec<String> = upward
        .first()
        .zip(upward.last())
        .map(|(from, to)| vec![format!("from_hz = {from:e}"), format!("to_hz = {to:e}")])
        .unwrap_or_default();
    words.push(format!("frequencies = {}", upward.len()));
    words.push(format!("samples = {}", request.samples));
    words.extend(effort_words(&request.effort));
    match request.starts {
        SweepStarts::Many(starts) => words.push(format!("starts = {starts}")),
        SweepStarts::CarriedOver { down, .. } => {
            words.push(format!("down = {down}"));
            words.extend(state_words(state));
        }
    }
    words
}

struct Work<'a> {
    pieces: &'a [(SettledOrigin, f64)],
    observer: &'a mut dyn Observer,
    kept: KeptRequest,
    found: Vec<SettledMotion>,
}

impl Work<'_> {
    /// Up, and down again if that is wanted, with the state carried over.
    fn carried_over(&mut self, sweeper: &mut Sweeper, initial: Vec<f64>) -> Result<(), JobError> {
        let mut state = self.last_state(sweeper, initial)?;
        for (piece, (direction, frequency_hz)) in (0..).zip(self.pieces).skip(self.kept.done as usize) {
            if self.observer.interrupted() {
                return Ok(());
            }
            // Where a sweep cannot go on, what it has found is kept.
            let point = match sweeper.at(*frequency_hz, &state) {
                Ok(point) => point,
                Err(error @ AttractorError::Input { .. }) => return Err(error.into()),
                Err(error) => {
                    let ends = format_args!("the sweep {direction} ends at {frequency_hz} Hz: {error}");
                    self.observer.notice(&ends);
                    return Ok(());
                }
            };
            state.clone_from(&point.state);
            let motion = SettledMotion { origin: *direction, point };
            self.kept
                .add(|store, request| store.append_settled(request, piece, std::slice::from_ref(&motion)))?;
            self.found.push(motion);
            self.count(piece + 1, &format_args!("{direction} {frequency_hz:.4} Hz"));
        }
        Ok(())
    }

    fn count(&mut self, done: u64, place: &dyn std::fmt::Display) {
        let total = Some(self.pieces.len() as u64);
        self.observer.counted(&CountedProgress { done, total, things: "frequencies", place });
    }

    /// The state that the motions found so far have come to. Within a contact whose law depends on the speed
    /// of its impact it does not say how that began: then the sweep is gone over once more from the last
    /// state that does.
    fn last_state(&self, sweeper: &mut Sweeper, initial: Vec<f64>) -> Result<Vec<f64>, JobError> {
        let mut states = self.found.iter().map(|motion| &motion.point.state).enumerate().rev();
        let last = states.find(|(_, state)| sweeper.can_begin(state));
        let (known, mut state) = last.map_or((0, initial), |(k, state)| (k + 1, state.clone()));
        for (_, frequency_hz) in self.pieces.iter().take(self.found.len()).skip(known) {
            state = sweeper.at(*frequency_hz, &state)?.state;
        }
        Ok(state)
    }

    /// From the same states at every frequency; motions that cannot be computed are left out and reported.
    fn diagram(
        &mut self,
        make: &(impl Fn() -> Result<Sweeper, AttractorError> + Sync),
        (starts, mut computed): (usize, SweepPieces),
        threads: usize,
    ) -> Result<(), JobError> {
        for (piece, &(_, frequency_hz)) in (0..).zip(self.pieces).skip(self.kept.done as usize) {
            if let Some(motions) = computed.remove(&piece) {
                self.add(piece, motions)?;
                continue;
            }
            let states = make()?.starts(frequency_hz, starts)?;
            let at = |sweeper: &mut Result<Sweeper, AttractorError>, state: &Vec<f64>| match sweeper {
                Ok(sweeper) => sweeper.begin_at(frequency_hz, state),
                Err(error) => Err(error.clone()),
            };
            let points = PooledOrder::new(threads, self.observer).in_order(&states, make, &at);
            let Some(points) = points else { return Ok(()) };
            let mut motions = Vec::new();
            for (start, point) in (1..).zip(points) {
                match point {
                    Ok(point) => motions.push(SettledMotion { origin: SettledOrigin::Start(start), point }),
                    Err(error) => {
                        self.observer.notice(&format_args!("{frequency_hz} Hz, start {start}: {error}"));
                    }
                }
            }
            self.add(piece, motions)?;
            self.count(piece + 1, &format_args!("{frequency_hz:.4} Hz"));
        }
        Ok(())
    }

    fn add(&mut self, piece: u64, motions: Vec<SettledMotion>) -> Result<(), JobError> {
        self.kept.add(|store, request| store.append_settled(request, piece, &motions))?;
        self.kept.done = piece + 1;
        self.found.extend(motions);
        Ok(())
    }
}

/// The branch that a periodic motion lies on.
fn branch(
    branches: &StoredBranches,
    study: &PreparedStudy,
    point: &SweepPoint,
) -> Result<Option<u32>, JobError> {
    let Class::Periodic { period } = point.class else { return Ok(None) };
    let system = study.model.system.clone();
    let mut map = SystemMap::new(system, point.frequency_hz, 1, ExactSettings::default())?;
    let mut states = vec![point.state.clone()];
    while states.len() < period {
        // A motion cannot go on from a state within a contact whose law depends on the speed of its impact;
        // one of its states is enough.
        match map.advance(0, &states[states.len() - 1]) {
            Ok(next) => states.push(next),
            Err(_) => states.resize(period, point.state.clone()),
        }
    }
    Ok(branches.branch_of(&study.model, point.frequency_hz, &states)?)
}
