//! `hammerbeam rig`: a measurement made with another model, and the whole comparison of it with the branches
//! of a study.

mod document;
mod report;
mod signals;
mod tables;

use hammerbeam_drawing::{DrawSettings, draw_into};
use hammerbeam_jobs::{
    OrbitSolver, PreparedStudy, StoredBranches,
    comparison::{Comparison, Curves, Filter, FitSettings, Observation, compare, curves},
    pool::threads,
    rig::{
        Filtered, RigError, RigMode, RigPoint, SignalPair, acceleration_curves, changed_study,
        compare_signal, filtered_branches, rig_modes, sweep,
    },
    run::{Plan, RunOutcome},
};
use hammerbeam_results::Store;
use hammerbeam_signal::{Quantity, points::MeasuredPoint};
use hammerbeam_study::{Model, StudyFile, file::Rig};

use super::compare::{Compared, draw};
use crate::{
    compare_args::RigOptions,
    failure::Failure,
    interrupt::Interrupt,
    output::{Output, tell},
    progress::Terminal,
    watch::{Notices, Watch},
};

/// Distance of orbits that are put behind filters as a part of the middle of the frequency range, and their
/// samples in an excitation period.
const SPACING: f64 = 1e-3;
const SAMPLES: usize = 4096;

/// Everything that came of a rig.
struct Found {
    file: StudyFile,
    rig: Rig,
    modes: Vec<RigMode>,
    points: Vec<RigPoint>,
    filters: Vec<Filter>,
    filtered: Filtered,
    /// Name, what it compares, and what came of it.
    comparisons: Vec<(&'static str, Curves, Comparison)>,
    signals: Vec<SignalPair>,
    solutions: u64,
}

impl Found {
    /// Cut-off of the filter that the branches of a comparison are behind (Hz).
    fn low_pass_hz(&self, name: &str) -> Option<f64> {
        self.filters.first().filter(|_| name == "filtered_acceleration").map(|filter| filter.cut_off_hz)
    }
}

pub fn run(options: &RigOptions, output: Output) -> Result<(), Failure> {
    let file = StudyFile::read(&options.study)?;
    let [low, high] = file.forced()?.frequency_hz;
    let Some(rig) = file.study.rig.clone() else {
        return Err(RigError::NoRig { name: file.name }.into());
    };
    let rig_file = changed_study(&file)?;
    let (model, rig_model) = (Model::build(&file)?, Model::build(&rig_file)?);
    let study = PreparedStudy { file, model };
    study.check_held(&mut Notices)?;
    let PreparedStudy { file, model } = study;
    let interrupt = Interrupt::listen(output)?;
    let threads = threads(options.jobs);
    let solutions = branches(options, &file, &model, threads, &interrupt)?;
    let stored = StoredBranches::open(&options.out, &file)?;
    let mut watch = Watch::new(interrupt.clone());
    tell("sweeping the rig");
    let points = sweep(&rig, &rig_model, threads, &mut watch)?;
    let modes = rig_modes(&rig, &rig_model, &model)?;
    let spacing_hz = SPACING * 0.5 * (low + high);
    let cut_offs = std::iter::once(rig.low_pass_hz).chain(rig.other_low_pass_hz.iter().copied());
    let order = rig.low_pass_order as usize;
    let filters: Vec<Filter> = cut_offs.map(|cut_off_hz| Filter { order, cut_off_hz }).collect();
    tell("putting the branches behind filters");
    let filtered = filtered_branches(&stored, &model, &filters, (spacing_hz, SAMPLES), threads, &mut watch)?;
    let comparisons = comparisons(&stored, &model, &points, &filtered)?;
    let factor = comparisons[0].2.fit.frequency.value;
    let mut signal = |&wanted: &(f64, u32)| {
        let (rig_side, model_side) = ((&rig_model, points.as_slice()), (&model, &stored));
        compare_signal(&rig, rig_side, model_side, wanted, factor, (threads, &mut watch))
    };
    tell("comparing signals");
    let signals = rig.signals.iter().map(&mut signal).collect::<Result<Vec<_>, _>>()?;
    let found = Found { file, rig, modes, points, filters, filtered, comparisons, signals, solutions };
    let settings = DrawSettings { threads, frequency_unit: output.frequency_unit, ..DrawSettings::default() };
    let mut document = document::document(&found);
    let drawn = draw_into::<Failure>(&options.out, settings, &mut watch, |drawn| {
        tables::write(&options.out, &found, &mut drawn.files)?;
        for (name, curves, comparison) in &found.comparisons {
            let compared = Compared {
                curves: curves.clone(),
                comparison: comparison.clone(),
                low_pass_hz: found.low_pass_hz(name),
                point: None,
                range_hz: [low, high],
            };
            draw(&found.file, &compared, name, drawn);
        }
        report::write(&options.out, &found, &document, &mut drawn.files)
    });
    let files = drawn?.names;
    document["folder"] = serde_json::json!(options.out);
    document["files"] = serde_json::json!(files);
    output.give(&document, || report::text(&found, &options.out, &files))?;
    Ok(())
}

/// Computes the branches of the study into the folder, or what is left of them.
fn branches(
    options: &RigOptions,
    file: &StudyFile,
    model: &Model,
    threads: usize,
    interrupt: &Interrupt,
) -> Result<u64, Failure> {
    let mut store = Store::open_for_run(&options.out, file)?;
    let solver = OrbitSolver::new(model, &file.study);
    let mut terminal = Terminal::new(interrupt.clone(), 0);
    let plan = Plan::of(&file.study);
    let outcome = hammerbeam_jobs::run::run(&mut store, &solver, &plan, threads, &mut terminal);
    terminal.clear();
    let outcome = outcome?;
    let solutions =
        hammerbeam_results::summary::summarise(&store)?.iter().map(|branch| branch.solutions).sum();
    store.finish()?;
    match outcome {
        RunOutcome::Interrupted => {
            let message = "interrupted; the branches computed so far are kept, the same command goes on";
            Err(Failure::Interrupted(message.to_owned()))
        }
        _ if solutions == 0 => Err(Failure::NoResult("no branch was found to compare with".to_owned())),
        _ => Ok(solutions),
    }
}

/// The paper's comparison (filtered accelerations over computed ones), the same over branches behind the
/// filter, and displacements.
fn comparisons(
    stored: &StoredBranches,
    model: &Model,
    points: &[RigPoint],
    filtered: &Filtered,
) -> Result<Vec<(&'static str, Curves, Comparison)>, Failure> {
    let measured: Vec<MeasuredPoint> = points.iter().map(|point| point.point.clone()).collect();
    let stored_curves = |quantity: Quantity| {
        // Stored maxima need no orbit, and so no spacing.
        let observation = Observation {
            quantity,
            at_response_point: true,
            filter: None,
            spacing_hz: 0.0,
            samples: SAMPLES,
        };
        curves(stored, model, &observation)
    };
    let all = [
        ("acceleration", Quantity::Acceleration, stored_curves(Quantity::Acceleration)?),
        ("filtered_acceleration", Quantity::Acceleration, acceleration_curves(&filtered.branches, 0)),
        ("displacement", Quantity::Displacement, stored_curves(Quantity::Displacement)?),
    ];
    let settings = FitSettings::default();
    let one = |(name, quantity, curves): (&'static str, Quantity, Curves)| {
        let comparison = compare(&measured, &curves, quantity, &settings)?;
        Ok((name, curves, comparison))
    };
    all.into_iter().map(one).collect()
}
