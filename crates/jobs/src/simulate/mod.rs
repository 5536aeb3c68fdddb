//! A motion in time, with every contact.
//!
//! With a results folder it goes into the store chunk by chunk, and on from the last one if it is asked
//! again. Tables and report are made of the chunks alone, those of the store first, so that they have the
//! same bytes however often the job was stopped.

mod recorder;
mod report;
mod size;
mod time;

use hammerbeam_attractor::{AttractorError, Simulation, SimulationCheckpoint, SystemMap};
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_results::{
    export::SimulationTables,
    store::{RequestKind, SimulatedChunk, SimulationLayout},
};

pub use report::{ListedContact, SimulationReport};
pub use size::SimulationTooLarge;
pub use time::{DurationTooLong, MotionPieces, SimulationTime};

use crate::{
    CountedProgress, InitialState, JobError, JobFolders, Observer, PreparedStudy,
    request::{KeptRequest, state_words},
};
use recorder::Recorder;
use report::Summary;

/// What is asked of a motion in time.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulationRequest {
    /// How its time is cut.
    pub time: SimulationTime,
    /// Phase of the stroboscopic section [cycles], 0 to 1.
    pub section_phase: f64,
    /// Where the motion begins.
    pub initial: InitialState,
}

/// Computes a motion, or what is left of it, and writes `samples.csv`, `contacts.csv` and `stroboscopic.csv`.
///
/// # Errors
/// [`JobError`]; [`JobError::Interrupted`] and [`JobError::Stopped`] with the number of periods or intervals,
/// those of the transient among them. A motion that ends early is [`JobError::Stopped`] by its reason.
pub fn simulate(
    study: &PreparedStudy,
    request: &SimulationRequest,
    folders: JobFolders<'_>,
    observer: &mut dyn Observer,
) -> Result<SimulationReport, JobError> {
    let layout = request.layout(study);
    let pieces = request.time.pieces;
    size::check(&layout, pieces, folders.out.is_some())?;
    let (system, settings) = (&study.model.system, ExactSettings::default());
    let mut map = SystemMap::new(system.clone(), layout.frequency_hz, 1, settings)?;
    let state = request.initial.at(&mut map, study, folders.results)?;
    let begin = |checkpoint: Option<SimulationCheckpoint>| match checkpoint {
        Some(checkpoint) => Simulation::resume(system.clone(), layout.frequency_hz, checkpoint, settings),
        None => Simulation::new(system.clone(), layout.frequency_hz, &state, settings),
    };
    if folders.out.is_some() {
        // A motion that cannot begin leaves no folder behind.
        begin(None)?.skip_period()?;
    }
    let mut words = layout.words();
    words.extend(state_words(&state));
    let total = layout.transient_periods + layout.periods;
    let identity = (RequestKind::Simulation, words.as_slice());
    let kept = KeptRequest::open(folders.out, &study.file, identity, total)?;
    let tables = folders.out.map(|folder| SimulationTables::new(folder, "", layout.clone()));
    let written = Written { layout: &layout, tables, summary: Summary::default() };
    let mut work = Work { observer: &mut *observer, done: kept.done, kept, written };
    let mut simulation = begin(work.read()?)?;
    let failure = work.simulate(&mut simulation, Recorder::new(&study.model, &layout), pieces)?;
    let Work { observer, kept, done, written } = work;
    observer.finishing();
    // Under the lock of the folder: two jobs do not write the same tables at once.
    let written = written.finish();
    let request = kept.number();
    kept.finish()?;
    let summary = written.map_err(|error| error.stopped_after(done))?;
    match failure {
        Some(error) if done > 0 => Err(JobError::from(error).stopped_after(done)),
        Some(error) => Err(error.into()),
        None if done < total => Err(JobError::Interrupted { done, part_s: None }),
        None => Ok(SimulationReport { request, ..summary.report(&layout, pieces, folders) }),
    }
}

impl SimulationRequest {
    /// What is written down, and how it is stored.
    #[must_use]
    pub fn layout(&self, study: &PreparedStudy) -> SimulationLayout {
        let system = &study.model.system;
        SimulationLayout {
            transient_periods: self.time.transient,
            periods: self.time.count,
            frequency_hz: self.time.per_second,
            samples_per_period: self.time.samples,
            section_phase: self.section_phase,
            dof: system.dof(),
            elements: system.elements().iter().map(|element| element.name.clone()).collect(),
        }
    }
}

struct Work<'a> {
    observer: &'a mut dyn Observer,
    kept: KeptRequest,
    written: Written<'a>,
    /// Periods that are done, with those of the transient.
    done: u64,
}

impl Work<'_> {
    /// Takes over what is stored.
    ///
    /// # Returns
    /// Where the motion is, if it has started.
    fn read(&mut self) -> Result<Option<SimulationCheckpoint>, JobError> {
        let Some((store, request)) = self.kept.stored() else { return Ok(None) };
        let (written, observer, done) = (&mut self.written, &mut *self.observer, self.done);
        let mut last = None;
        store.each_simulated::<JobError>(request, written.layout, |chunk| {
            if observer.interrupted() {
                return Err(JobError::TablesInterrupted);
            }
            written.take(&chunk).map_err(|error| error.stopped_after(done))?;
            last = Some(chunk.checkpoint);
            Ok(())
        })?;
        Ok(last)
    }

    /// Goes on to the end.
    ///
    /// # Returns
    /// Why the motion ends early, if it does.
    fn simulate(
        &mut self,
        simulation: &mut Simulation,
        mut recorder: Recorder<'_>,
        pieces: MotionPieces,
    ) -> Result<Option<AttractorError>, JobError> {
        let transient = self.written.layout.transient_periods;
        let total = transient + self.written.layout.periods;
        let mut failure = None;
        while self.done < total && failure.is_none() && !self.observer.interrupted() {
            let period =
                if self.done < transient { recorder.skip(simulation) } else { recorder.period(simulation) };
            match period {
                Ok(()) => self.done += 1,
                Err(error) => failure = Some(error),
            }
            if recorder.is_due() {
                self.add(recorder.take(simulation))?;
            }
            self.observer.counted(&CountedProgress {
                done: self.done,
                total: Some(total),
                things: pieces.words(),
                place: &"",
            });
        }
        self.add(recorder.take(simulation))?;
        Ok(failure)
    }

    /// Stores the periods that have been done last, and writes them down.
    fn add(&mut self, chunk: Option<SimulatedChunk>) -> Result<(), JobError> {
        let Some(chunk) = chunk else { return Ok(()) };
        let first = self.done - chunk.periods;
        let stored = self.kept.add(|store, request| store.append_simulated(request, first, &chunk));
        stored.map_err(|error| JobError::from(error).stopped_after(first))?;
        self.written.take(&chunk).map_err(|error| error.stopped_after(self.done))
    }
}

/// The tables, and the motion in few numbers.
struct Written<'a> {
    layout: &'a SimulationLayout,
    tables: Option<SimulationTables>,
    summary: Summary,
}

impl Written<'_> {
    fn take(&mut self, chunk: &SimulatedChunk) -> Result<(), JobError> {
        self.summary.take(self.layout, chunk);
        self.tables.as_mut().map_or(Ok(()), |tables| tables.take(chunk))?;
        Ok(())
    }

    fn finish(mut self) -> Result<Summary, JobError> {
        self.tables.map_or_else(|| Ok(Vec::new()), SimulationTables::finish)?;
        self.summary.finish(self.layout);
        Ok(self.summary)
    }
}
