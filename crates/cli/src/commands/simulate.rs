//! `hammerbeam simulate`: a motion in time, with every contact.
//!
//! With `--out` it goes into the store chunk by chunk, and on from the last one if it is asked again. Tables
//! and summary are made of the chunks alone, those of the store first, so that they have the same bytes
//! however often the command was interrupted.

mod observer;
mod size;
mod summary;
mod time;
mod told;

use std::path::Path;

use hammerbeam_attractor::{AttractorError, Simulation, SimulationCheckpoint, SystemMap};
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_results::{
    export::SimulationTables,
    store::{RequestKind, SimulatedChunk},
};
use hammerbeam_study::{Model, StudyFile};

use crate::{
    failure::Failure,
    initial,
    interrupt::Interrupt,
    kept::{Kept, state_words},
    motion_args::SimulateOptions,
    output::Output,
    ticker::Ticker,
};
use observer::Observer;
use summary::Summary;
use told::Told;

pub fn run(options: &SimulateOptions, output: Output) -> Result<(), Failure> {
    let file = StudyFile::read(&options.study)?;
    let model = Model::build(&file)?;
    let (layout, pieces) = time::layout(options, (&file, &model))?;
    let told = Told { layout: &layout, pieces };
    size::check(&told, options.out.is_some())?;
    let motion = ExactSettings::default();
    let mut map = SystemMap::new(model.system.clone(), layout.frequency_hz, 1, motion)?;
    let state = initial::state(&options.initial, &mut map, (&file, &model), options.results.as_deref())?;
    let begin = |checkpoint: Option<SimulationCheckpoint>| match checkpoint {
        Some(checkpoint) => Simulation::resume(model.system.clone(), layout.frequency_hz, checkpoint, motion),
        None => Simulation::new(model.system.clone(), layout.frequency_hz, &state, motion),
    };
    if options.out.is_some() {
        // A motion that cannot begin leaves no folder behind.
        begin(None)?.skip_period()?;
    }
    let interrupt = Interrupt::listen(output)?;
    // What is asked of the study.
    let mut words = layout.words();
    words.extend(state_words(&state));
    let total = layout.transient_periods + layout.periods;
    let kept = Kept::open(options.out.as_deref(), &file, (RequestKind::Simulation, &words), total)?;
    let tables = options.out.as_deref().map(|folder| SimulationTables::new(folder, "", layout.clone()));
    let written = Written { told, tables, summary: Summary::default() };
    let mut work = Work { interrupt: &interrupt, done: kept.done, kept, written };
    let mut simulation = begin(work.read()?)?;
    let failure = work.simulate(&mut simulation, Observer::new(&model, &layout))?;
    let Work { mut kept, done, written, .. } = work;
    interrupt.is_in_order();
    // Under the lock of the folder: two commands do not write the same tables at once.
    let written = written.finish();
    kept.finish()?;
    let summary = written.map_err(|failure| failure.and(&told.fate(done, &kept)))?;
    if let Some(error) = failure {
        return Err(if done > 0 { told.ended(&error, (done, &kept)) } else { error.into() });
    }
    if done < total {
        return Err(Failure::Interrupted(format!("interrupted; {}", told.fate(done, &kept))));
    }
    let out = options.out.as_deref();
    output.give(&summary.document(&told, out), || summary.text(&told, (out, output.frequency_unit)))?;
    Ok(())
}

struct Work<'a> {
    interrupt: &'a Interrupt,
    kept: Kept,
    written: Written<'a>,
    /// Periods that are done, with those of the transient.
    done: u64,
}

impl Work<'_> {
    /// Takes over what is stored.
    ///
    /// # Returns
    /// Where the motion is, if it has begun.
    fn read(&mut self) -> Result<Option<SimulationCheckpoint>, Failure> {
        let Some((store, request)) = self.kept.stored() else { return Ok(None) };
        let (written, mut last) = (&mut self.written, None);
        let fate = written.told.fate(self.done, &self.kept);
        store.each_simulated::<Failure>(request, written.told.layout, |chunk| {
            if self.interrupt.raised() {
                let message = "interrupted before the tables were written; everything is kept";
                return Err(Failure::Interrupted(message.to_owned()));
            }
            written.take(&chunk).map_err(|failure| failure.and(&fate))?;
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
        mut observer: Observer<'_>,
    ) -> Result<Option<AttractorError>, Failure> {
        let Told { layout, pieces } = self.written.told;
        let transient = layout.transient_periods;
        let total = transient + layout.periods;
        let mut ticker = Ticker::new(total, pieces.words());
        let mut failure = None;
        while self.done < total && failure.is_none() && !self.interrupt.raised() {
            let period =
                if self.done < transient { observer.skip(simulation) } else { observer.period(simulation) };
            match period {
                Ok(()) => self.done += 1,
                Err(error) => failure = Some(error),
            }
            if observer.is_due() {
                self.add(observer.take(simulation))?;
            }
            ticker.at(self.done, String::new);
        }
        ticker.clear();
        self.add(observer.take(simulation))?;
        Ok(failure)
    }

    /// Stores the periods that have been done last, and writes them down.
    fn add(&mut self, chunk: Option<SimulatedChunk>) -> Result<(), Failure> {
        let Some(chunk) = chunk else { return Ok(()) };
        let first = self.done - chunk.periods;
        let stored = self.kept.add(|store, request| store.append_simulated(request, first, &chunk));
        stored.map_err(|error| Failure::from(error).and(&self.written.told.fate(first, &self.kept)))?;
        let kept = self.written.told.fate(self.done, &self.kept);
        self.written.take(&chunk).map_err(|failure| failure.and(&kept))
    }
}

/// The tables, and the motion in few numbers.
struct Written<'a> {
    told: Told<'a>,
    tables: Option<SimulationTables>,
    summary: Summary,
}

impl Written<'_> {
    fn take(&mut self, chunk: &SimulatedChunk) -> Result<(), Failure> {
        self.summary.take(self.told.layout, chunk);
        self.tables.as_mut().map_or(Ok(()), |tables| tables.take(chunk))?;
        Ok(())
    }

    fn finish(mut self) -> Result<Summary, Failure> {
        self.tables.map_or_else(|| Ok(Vec::new()), SimulationTables::finish)?;
        self.summary.finish(self.told.layout);
        Ok(self.summary)
    }
}

pub fn folder(path: Option<&Path>) -> Option<String> {
    path.map(|path| path.display().to_string())
}
