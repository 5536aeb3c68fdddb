//! `hammerbeam sweep`: settled motions over the frequency.

use hammerbeam_attractor::{
    AttractorError, Class, Observable, SweepPoint, SweepSettings, Sweeper, SystemMap, in_order,
};
use hammerbeam_figure::FrequencyUnit;
use hammerbeam_jobs::StoredBranches;
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_results::{
    Store,
    export::write_sweep,
    store::{RequestKind, SettledMotion},
};
use hammerbeam_study::{Model, StudyFile};
use serde_json::{Value, json};

use super::{run::threads, simulate::folder};
use crate::{
    failure::Failure,
    initial,
    interrupt::Interrupt,
    kept::{Kept, branches, counted, state_words},
    motion_args::SweepOptions,
    output::{Output, tell},
    series::series,
    ticker::Ticker,
};

pub fn run(options: &SweepOptions, output: Output) -> Result<(), Failure> {
    let file = StudyFile::read(&options.study)?;
    let [low, high] = file.forced()?.frequency_hz;
    let model = Model::build(&file)?;
    let upward = series((options.from.unwrap_or(low), options.to.unwrap_or(high)), options.step, "--from")?;
    let (results, out) = (options.results.as_deref(), options.out.as_deref());
    branches(results, out, &file)?;
    let observable = Observable {
        shape: model.response.shape.clone(),
        support_ratios: model.response.support_ratios.clone(),
    };
    let motion = ExactSettings::default();
    let settings =
        SweepSettings { effort: (&options.effort).into(), sampled: options.samples as usize, motion };
    let make = || Sweeper::new(&model.system, &observable, settings);
    let state = match options.starts {
        // A diagram has states of its own.
        Some(_) => Vec::new(),
        None => {
            let mut first = SystemMap::new(model.system.clone(), upward[0], 1, motion)?;
            initial::state(&options.initial, &mut first, (&file, &model), results)?
        }
    };
    let (kind, pieces) = pieces(options, &upward);
    let words = words(options, &upward, &state);
    let kept = Kept::open(out, &file, (kind, &words), pieces.len() as u64)?;
    let found = kept.read(Store::settled)?;
    let interrupt = Interrupt::listen(output)?;
    let mut work = Work { options, interrupt: &interrupt, kept, found };
    match options.starts {
        Some(starts) => work.diagram(&make, &pieces, starts as usize)?,
        None => work.sweep(&mut make()?, &pieces, state)?,
    }
    let Work { found, mut kept, .. } = work;
    interrupt.is_in_order();
    // Under the lock of the folder: two commands do not write the same tables at once.
    let on_branches = numbered_and_written(options, (&file, &model), &found);
    kept.finish()?;
    let number = found.len() as u64;
    let fate = format!("{} {}", counted(number, "motion"), kept.fate(number));
    let on_branches = on_branches.map_err(|failure| failure.and(&fate))?;
    if interrupt.raised() {
        return Err(Failure::Interrupted(format!("interrupted; {fate}")));
    }
    if found.is_empty() {
        return Err(Failure::NoResult("no motion could be computed".to_owned()));
    }
    let result = Outcome { options, found: &found, branches: &on_branches, dof: model.system.dof() };
    output.give(&result.document(), || result.text(output.frequency_unit))?;
    Ok(())
}

/// Writes the tables.
///
/// # Returns
/// The branch that each motion lies on. The branches are closed again here: a store that is read cannot be
/// finished.
fn numbered_and_written(
    options: &SweepOptions,
    (file, model): (&StudyFile, &Model),
    found: &[SettledMotion],
) -> Result<Vec<Option<u32>>, Failure> {
    let numbers = match branches(options.results.as_deref(), options.out.as_deref(), file)? {
        Some(branches) => {
            found.iter().map(|motion| branch(&branches, model, &motion.point)).collect::<Result<_, _>>()?
        }
        None => vec![None; found.len()],
    };
    if let Some(folder) = &options.out {
        write_sweep(folder, "", found, &numbers)?;
    }
    Ok(numbers)
}

/// Directions and frequencies, one after the other.
fn pieces(options: &SweepOptions, upward: &[f64]) -> (RequestKind, Vec<(&'static str, f64)>) {
    let mut pieces: Vec<_> = upward.iter().map(|frequency_hz| ("up", *frequency_hz)).collect();
    if options.down {
        pieces.extend(upward.iter().rev().map(|frequency_hz| ("down", *frequency_hz)));
    }
    (if options.starts.is_some() { RequestKind::Starts } else { RequestKind::Sweep }, pieces)
}

/// What is asked of the study.
fn words(options: &SweepOptions, upward: &[f64], state: &[f64]) -> Vec<String> {
    let mut words: Vec<String> = upward
        .first()
        .zip(upward.last())
        .map(|(from, to)| vec![format!("from_hz = {from:e}"), format!("to_hz = {to:e}")])
        .unwrap_or_default();
    words.push(format!("frequencies = {}", upward.len()));
    words.push(format!("samples = {}", options.samples));
    words.extend(options.effort.words());
    match options.starts {
        Some(starts) => words.push(format!("starts = {starts}")),
        None => {
            words.push(format!("down = {}", options.down));
            words.extend(state_words(state));
        }
    }
    words
}

struct Work<'a> {
    options: &'a SweepOptions,
    interrupt: &'a Interrupt,
    kept: Kept,
    found: Vec<SettledMotion>,
}

impl Work<'_> {
    /// Up, and down again if that is wanted, with the state carried over.
    fn sweep(
        &mut self,
        sweeper: &mut Sweeper,
        pieces: &[(&'static str, f64)],
        initial: Vec<f64>,
    ) -> Result<(), Failure> {
        let mut state = self.last_state(sweeper, pieces, initial)?;
        let mut ticker = Ticker::new(pieces.len() as u64, "frequencies");
        for (piece, (direction, frequency_hz)) in (0..).zip(pieces).skip(self.kept.done as usize) {
            if self.interrupt.raised() {
                return Ok(());
            }
            // A sweep that cannot go on is told, and what it has found is kept.
            let point = match sweeper.at(*frequency_hz, &state) {
                Ok(point) => point,
                Err(error @ AttractorError::Input { .. }) => return Err(error.into()),
                Err(error) => {
                    tell(&format!("the sweep {direction} ends at {frequency_hz} Hz: {error}"));
                    return Ok(());
                }
            };
            state.clone_from(&point.state);
            let motion = SettledMotion { origin: (*direction).to_owned(), point };
            self.kept
                .add(|store, request| store.append_settled(request, piece, std::slice::from_ref(&motion)))?;
            self.found.push(motion);
            ticker.at(piece + 1, || format!("{direction} {frequency_hz:.4} Hz"));
        }
        ticker.clear();
        Ok(())
    }

    /// The state that the motions found so far have come to. Within a contact whose law remembers its impact
    /// it does not tell how that began: then the sweep is gone over once more from the last state that does.
    fn last_state(
        &self,
        sweeper: &mut Sweeper,
        pieces: &[(&'static str, f64)],
        initial: Vec<f64>,
    ) -> Result<Vec<f64>, Failure> {
        let mut states = self.found.iter().map(|motion| &motion.point.state).enumerate().rev();
        let last = states.find(|(_, state)| sweeper.can_begin(state));
        let (known, mut state) = last.map_or((0, initial), |(k, state)| (k + 1, state.clone()));
        for (_, frequency_hz) in pieces.iter().take(self.found.len()).skip(known) {
            state = sweeper.at(*frequency_hz, &state)?.state;
        }
        Ok(state)
    }

    /// From the same states at every frequency; motions that cannot be computed are left out and told.
    fn diagram(
        &mut self,
        make: &(impl Fn() -> Result<Sweeper, AttractorError> + Sync),
        pieces: &[(&'static str, f64)],
        starts: usize,
    ) -> Result<(), Failure> {
        let threads = threads(self.options.jobs);
        let mut ticker = Ticker::new(pieces.len() as u64, "frequencies");
        for (piece, &(_, frequency_hz)) in (0..).zip(pieces).skip(self.kept.done as usize) {
            let states = make()?.starts(frequency_hz, starts)?;
            let at = |sweeper: &mut Result<Sweeper, AttractorError>, state: &Vec<f64>| match sweeper {
                Ok(sweeper) => sweeper.begin_at(frequency_hz, state),
                Err(error) => Err(error.clone()),
            };
            let Some(points) = in_order(&states, threads, self.interrupt.flag(), make, at) else {
                return Ok(());
            };
            let mut motions = Vec::new();
            for (start, point) in points.into_iter().enumerate() {
                match point {
                    Ok(point) => motions.push(SettledMotion { origin: (start + 1).to_string(), point }),
                    Err(error) => tell(&format!("{frequency_hz} Hz, start {}: {error}", start + 1)),
                }
            }
            self.kept.add(|store, request| store.append_settled(request, piece, &motions))?;
            self.found.extend(motions);
            ticker.at(piece + 1, || format!("{frequency_hz:.4} Hz"));
        }
        ticker.clear();
        Ok(())
    }
}

/// The branch that a periodic motion lies on.
fn branch(branches: &StoredBranches, model: &Model, point: &SweepPoint) -> Result<Option<u32>, Failure> {
    let Class::Periodic { period } = point.class else { return Ok(None) };
    let mut map = SystemMap::new(model.system.clone(), point.frequency_hz, 1, ExactSettings::default())?;
    let mut states = vec![point.state.clone()];
    while states.len() < period {
        // A state within a contact that remembers its impact cannot be gone on from; one of its states is
        // enough.
        match hammerbeam_attractor::SectionMap::advance(&mut map, 0, &states[states.len() - 1]) {
            Ok(next) => states.push(next),
            Err(_) => states.resize(period, point.state.clone()),
        }
    }
    Ok(branches.branch_of(model, point.frequency_hz, &states)?)
}

struct Outcome<'a> {
    options: &'a SweepOptions,
    found: &'a [SettledMotion],
    /// The branch each of them lies on.
    branches: &'a [Option<u32>],
    /// Number of modes.
    dof: usize,
}

impl Outcome<'_> {
    fn document(&self) -> Value {
        let motion = |(motion, branch): (&SettledMotion, &Option<u32>)| {
            let point = &motion.point;
            json!({
                "from": motion.origin,
                "frequency_hz": point.frequency_hz,
                "class": point.class.name(),
                "period": point.class.period(),
                "doubt": point.class.doubt(),
                "max_abs_displacement_m": point.max_abs_displacement,
                "contacts_per_period": point.contacts_per_period,
                "largest_exponent_per_s": point.largest_exponent.map(|exponent| exponent.value),
                "half_width_per_s": point.largest_exponent.map(|exponent| exponent.half_width),
                "zero_one_k": point.zero_one,
                "branch": branch,
                "sampled_displacements_m": point.samples,
            })
        };
        json!({
            "kind": if self.options.starts.is_some() { "starts" } else { "sweep" },
            "motions": self.found.iter().zip(self.branches).map(motion).collect::<Vec<_>>(),
            "results": folder(self.options.out.as_deref()),
        })
    }

    fn text(&self, unit: FrequencyUnit) -> String {
        let mut lines = vec![format!(
            "{:>6} {:>12}  {:<16} {:>14} {:>9}  {:<24} {:>6}  branch",
            "from",
            unit.symbol(),
            "class",
            "max. displ. m",
            "contacts",
            "largest exponent 1/s",
            "K"
        )];
        for (SettledMotion { origin, point }, branch) in self.found.iter().zip(self.branches) {
            let class = point.class;
            let exponent = point.largest_exponent.map_or_else(String::new, |exponent| {
                format!("{:.3} +- {:.3}", exponent.value, exponent.half_width)
            });
            let k = point.zero_one.map_or_else(String::new, |k| format!("{k:.2}"));
            let branch = branch.map_or_else(String::new, |branch| branch.to_string());
            lines.push(format!(
                "{origin:>6} {:>12.6}  {class:<16} {:>14.6e} {:>9.2}  {exponent:<24} {k:>6}  {branch}",
                unit.factor() * point.frequency_hz,
                point.max_abs_displacement,
                point.contacts_per_period
            ));
        }
        let doubtful = self.found.iter().filter(|motion| motion.point.class.doubt().is_some()).count();
        if doubtful > 0 {
            lines.push(format!(
                "{doubtful} motion(s) of {} modes are doubtful; --json has the reasons",
                self.dof
            ));
        }
        if let Some(folder) = &self.options.out {
            lines.push(format!("sweep.csv and sweep_samples.csv are in {}", folder.display()));
        }
        lines.join("\n")
    }
}
