//! The whole run of a study into a results folder: branches over the frequency, then those in other
//! parameters and curves, then what is known of all of them.

use std::path::{Path, PathBuf};

use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_results::{
    Store,
    summary::{summarise, summarise_pieces},
};

use super::{Plan, RunOutcome, RunReport, run};
use crate::{
    JobError, MirrorImage, Observer, OrbitSolver, PreparedStudy, StoredBranches,
    outputs::{OutputPass, compute_outputs},
    run::report::BranchReport,
    settled::settled_states,
    special_point::{NearPoint, near_point},
    varied::{self, VariedOutcome},
};

/// Stored motions at which branches of a run begin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RunOrigin {
    /// A results folder.
    pub folder: PathBuf,
    /// A special point of its branches, by its number; `None` for the motions of its sweeps and basins.
    pub special_point: Option<u32>,
}

impl RunOrigin {
    /// `DIR`, or `DIR:POINT` for a special point; a folder whose name ends so is meant as a whole.
    #[must_use]
    pub fn of(text: &str) -> Self {
        let point = text.rsplit_once(':').and_then(|(folder, number)| Some((folder, number.parse().ok()?)));
        match point.filter(|_| !Path::new(text).is_dir()) {
            Some((folder, number)) => Self { folder: folder.into(), special_point: Some(number) },
            None => Self { folder: text.into(), special_point: None },
        }
    }
}

/// What is asked of a run.
#[derive(Debug, Clone, Copy)]
pub struct RunRequest<'a> {
    /// The results folder, made if it is not there; a run that was stopped goes on from there.
    pub out: &'a Path,
    /// Stored motions at which branches begin as well.
    pub from: &'a [RunOrigin],
    /// Number of threads; the results do not depend on it.
    pub threads: usize,
}

/// A run that has come to its end, whose results folder is still open.
#[derive(Debug)]
pub struct WholeRun {
    /// The results, under the lock of their folder; [`Store::finish`] closes it.
    pub store: Store,
    /// What came of the run.
    pub report: RunReport,
}

/// Runs what is left of a study.
///
/// # Errors
/// [`JobError`]; what was stored before stays. A run that is stopped is no error, see [`RunReport::outcome`].
pub fn run_study(
    study: &PreparedStudy,
    request: RunRequest<'_>,
    observer: &mut dyn Observer,
) -> Result<WholeRun, JobError> {
    let PreparedStudy { file, model } = study;
    file.forced()?;
    study.check_held(observer)?;
    study.warn_of_many_modes(observer);
    study.check_range()?;
    let solver = OrbitSolver::new(model, &file.study);
    let mut met = Vec::new();
    for origin in request.from {
        met.extend(met_at(origin, (&solver, file.study.excitation.range_hz()), observer)?);
    }
    let mut store = Store::open_for_run(request.out, file)?;
    let plan = Plan { met, ..Plan::of(&file.study) };
    let outcome = run(&mut store, &solver, &plan, request.threads, observer);
    let varied = match outcome {
        Ok(RunOutcome::Done) => varied::run(&mut store, model, &file.study, request.threads, observer),
        _ => Ok(VariedOutcome::Done),
    };
    let outcome = match (outcome?, varied?) {
        (_, VariedOutcome::Interrupted) => RunOutcome::Interrupted,
        (outcome, VariedOutcome::Done) => outcome,
    };
    let outputs = match outcome {
        RunOutcome::Interrupted => OutputPass::default(),
        _ => compute_outputs(&mut store, study, request.threads, observer)?,
    };
    observer.finishing();
    let outcome = if outputs.is_interrupted { RunOutcome::Interrupted } else { outcome };
    let report = RunReport { outputs, ..report(study, &store, outcome)? };
    Ok(WholeRun { store, report })
}

/// The periodic solutions of the study at stored motions.
///
/// * `range_hz`: of the study.
fn met_at(
    origin: &RunOrigin,
    (solver, range_hz): (&OrbitSolver<'_>, [f64; 2]),
    observer: &mut dyn Observer,
) -> Result<Vec<PeriodicSolution>, JobError> {
    let store = Store::open(&origin.folder)?;
    let Some(number) = origin.special_point else { return Ok(solver.settled(&settled_states(&store)?)) };
    let system = PreparedStudy::of_store(&store)?.model.system;
    let states = match near_point(&store, &system, number)? {
        NearPoint::States(states) => states,
        NearPoint::Missing { count } => {
            return Err(JobError::NoSpecialPoint { results: origin.folder.clone(), number, count });
        }
    };
    let results = origin.folder.clone();
    let [low, high] = range_hz;
    if let Some(point) = states.first()
        && states.iter().all(|state| !(low..=high).contains(&state.frequency_hz))
    {
        let at_hz = point.frequency_hz;
        return Err(JobError::SpecialPointOutside { results, number, at_hz, range_hz });
    }
    let found = solver.near(&states);
    if found.is_empty() {
        let results = results.display();
        observer.notice(&format_args!(
            "no periodic solution of this study was found near special point {number} of {results}"
        ));
    }
    Ok(found)
}

fn report(study: &PreparedStudy, store: &Store, outcome: RunOutcome) -> Result<RunReport, JobError> {
    let PreparedStudy { file, model } = study;
    let stored = match model.system.is_symmetric() {
        true => Some(StoredBranches::open(store.folder(), file)?),
        false => None,
    };
    let image = |id: u32| -> Result<Option<MirrorImage>, JobError> {
        let Some(stored) = &stored else { return Ok(None) };
        let branch = stored.branches().iter().find(|branch| branch.record.id == id);
        let image = branch.map(|branch| stored.mirror_image_of(model, branch)).transpose()?;
        Ok(image.flatten())
    };
    let branches = summarise(store)?.into_iter().map(|summary| {
        let mirror_image = image(summary.record.id)?;
        Ok(BranchReport { summary, mirror_image })
    });
    Ok(RunReport {
        outcome,
        title: file.study.title.clone(),
        results: store.folder().to_owned(),
        branches: branches.collect::<Result<_, JobError>>()?,
        varied: summarise_pieces(store)?,
        searches: store.jobs()?,
        outputs: OutputPass::default(),
        undamped_modes: model.undamped_modes(),
        undamped_in_contact: model.undamped_in_contact(file.study.excitation.range_hz()[1]),
        figures: Vec::new(),
    })
}
