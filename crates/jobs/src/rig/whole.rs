//! A whole rig: the branches of a study, the measurement with the changed model, and the comparison of both.

use std::path::Path;

use hammerbeam_results::{Store, summary::summarise};
use hammerbeam_signal::{MeasuredQuantity, points::MeasuredPoint};
use hammerbeam_study::{Model, StudyFile, file::Rig};

use super::{
    Filtered, RigError, RigMode, RigPoint, SignalPair, acceleration_curves, changed_study, compare_signal,
    filtered_branches, rig_modes, sweep,
};
use crate::{
    JobError, Observer, OrbitSolver, PreparedStudy, StoredBranches,
    comparison::{ComparedQuantity, Comparison, Curves, Filter, FitSettings, Observation, compare, curves},
    run::{Plan, RunOutcome, run},
};

/// Distance of orbits that are put behind filters as a part of the middle of the frequency range, and their
/// samples in an excitation period.
const SPACING: f64 = 1e-3;
const SAMPLES: usize = 4096;

/// Everything that came of a rig.
#[derive(Debug)]
pub struct RigReport {
    /// The study, with its rig.
    pub file: StudyFile,
    /// The rig.
    pub rig: Rig,
    /// Modes of the rig, measured and computed.
    pub modes: Vec<RigMode>,
    /// What was measured.
    pub points: Vec<RigPoint>,
    /// The filters that branches are put behind, that of the measurement first.
    pub filters: Vec<Filter>,
    /// Branches behind them.
    pub filtered: Filtered,
    /// Name, what it compares, and what came of it.
    pub comparisons: Vec<(&'static str, Curves, Comparison)>,
    /// Measured signals over orbits.
    pub signals: Vec<SignalPair>,
    /// Number of solutions on the branches of the study.
    pub solutions: u64,
}

impl RigReport {
    /// Cut-off of the filter that the branches of a comparison are behind [Hz].
    pub(super) fn low_pass_hz(&self, name: &str) -> Option<f64> {
        self.filters.first().filter(|_| name == "filtered_acceleration").map(|filter| filter.cut_off_hz)
    }

    /// The comparisons with their names, as they are drawn.
    pub fn compared(&self) -> impl Iterator<Item = (&'static str, ComparedQuantity)> {
        let range_hz = self.file.study.excitation.range_hz();
        self.comparisons.iter().map(move |(name, curves, comparison)| {
            let compared = ComparedQuantity {
                curves: curves.clone(),
                comparison: comparison.clone(),
                low_pass_hz: self.low_pass_hz(name),
                point: None,
                range_hz,
            };
            (*name, compared)
        })
    }
}

/// Which stage of a rig begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RigStage {
    Sweep,
    Filters,
    Signals,
}

impl std::fmt::Display for RigStage {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Sweep => "sweeping the rig",
            Self::Filters => "putting the branches behind filters",
            Self::Signals => "comparing signals",
        })
    }
}

/// Measures the rig of a study and compares it with the branches of that study, which are computed into the
/// folder, or what is left of them.
///
/// * `watch_run`: is the observer of the branches; `observer` that of all that comes after them.
///
/// # Errors
/// [`JobError`]; branches that were computed are kept.
pub fn measure_rig(
    study: &PreparedStudy,
    out: &Path,
    threads: usize,
    (watch_run, observer): (&mut dyn Observer, &mut dyn Observer),
) -> Result<RigReport, JobError> {
    let PreparedStudy { file, model } = study;
    let [low, high] = file.forced()?.frequency_hz;
    let Some(rig) = file.study.rig.clone() else {
        return Err(RigError::NoRig { name: file.name.clone() }.into());
    };
    let rig_model = Model::build(&changed_study(file)?)?;
    study.check_held(observer)?;
    let solutions = branches(study, out, threads, watch_run)?;
    let stored = StoredBranches::open(out, file)?;
    observer.notice(&RigStage::Sweep);
    let points = sweep(&rig, &rig_model, threads, observer)?;
    let modes = rig_modes(&rig, &rig_model, model)?;
    let spacing_hz = SPACING * 0.5 * (low + high);
    let cut_offs = std::iter::once(rig.low_pass_hz).chain(rig.other_low_pass_hz.iter().copied());
    let order = rig.low_pass_order as usize;
    let filters: Vec<Filter> = cut_offs.map(|cut_off_hz| Filter { order, cut_off_hz }).collect();
    observer.notice(&RigStage::Filters);
    let filtered = filtered_branches(&stored, model, &filters, (spacing_hz, SAMPLES), threads, observer)?;
    let comparisons = comparisons(&stored, model, &points, &filtered)?;
    let factor = comparisons[0].2.fit.frequency.value;
    observer.notice(&RigStage::Signals);
    let mut signals = Vec::new();
    for &wanted in &rig.signals {
        let (rig_side, model_side) = ((&rig_model, points.as_slice()), (model, &stored));
        signals.push(compare_signal(&rig, rig_side, model_side, wanted, factor, (threads, &mut *observer))?);
    }
    let file = file.clone();
    Ok(RigReport { file, rig, modes, points, filters, filtered, comparisons, signals, solutions })
}

/// Computes the branches of the study into the folder, or what is left of them.
fn branches(
    study: &PreparedStudy,
    out: &Path,
    threads: usize,
    observer: &mut dyn Observer,
) -> Result<u64, JobError> {
    let mut store = Store::open_for_run(out, &study.file)?;
    let solver = OrbitSolver::new(&study.model, &study.file.study);
    let plan = Plan::of(&study.file.study);
    let outcome = run(&mut store, &solver, &plan, threads, observer)?;
    let solutions = summarise(&store)?.iter().map(|branch| branch.solutions).sum();
    store.finish()?;
    match outcome {
        RunOutcome::Interrupted => Err(RigError::BranchesInterrupted.into()),
        _ if solutions == 0 => Err(RigError::NothingToCompare.into()),
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
) -> Result<Vec<(&'static str, Curves, Comparison)>, JobError> {
    let measured: Vec<MeasuredPoint> = points.iter().map(|point| point.point.clone()).collect();
    let stored_curves = |quantity: MeasuredQuantity| {
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
        ("acceleration", MeasuredQuantity::Acceleration, stored_curves(MeasuredQuantity::Acceleration)?),
        ("filtered_acceleration", MeasuredQuantity::Acceleration, acceleration_curves(&filtered.branches, 0)),
        ("displacement", MeasuredQuantity::Displacement, stored_curves(MeasuredQuantity::Displacement)?),
    ];
    let settings = FitSettings::default();
    let one = |(name, quantity, curves): (&'static str, MeasuredQuantity, Curves)| {
        let comparison = compare(&measured, &curves, quantity, &settings)?;
        Ok((name, curves, comparison))
    };
    all.into_iter().map(one).collect()
}
