//! The whole run of a study into a results folder: branches over the frequency, then those in other
//! parameters and curves, then what is known of all of them.

use std::path::{Path, PathBuf};

use hammerbeam_results::{
    Store,
    summary::{summarise, summarise_pieces},
};

use super::{Plan, RunOutcome, RunReport, run};
use crate::{
    JobError, MirrorImage, Observer, OrbitSolver, PreparedStudy, StoredBranches,
    run::report::BranchReport,
    settled::settled_states,
    varied::{self, VariedOutcome},
};

/// What is asked of a run.
#[derive(Debug, Clone, Copy)]
pub struct RunRequest<'a> {
    /// The results folder, made if it is not there; a run that was stopped goes on from there.
    pub out: &'a Path,
    /// Results folders with motions of sweeps and basins, at which branches begin as well.
    pub from: &'a [PathBuf],
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
    study.check_range()?;
    let mut settled = Vec::new();
    for folder in request.from {
        settled.extend(settled_states(&Store::open(folder)?)?);
    }
    let mut store = Store::open_for_run(request.out, file)?;
    let solver = OrbitSolver::new(model, &file.study);
    let plan = Plan { met: solver.settled(&settled), ..Plan::of(&file.study) };
    let outcome = run(&mut store, &solver, &plan, request.threads, observer);
    let varied = match outcome {
        Ok(RunOutcome::Done) => varied::run(&mut store, model, &file.study, request.threads, observer),
        _ => Ok(VariedOutcome::Done),
    };
    observer.finishing();
    let outcome = match (outcome?, varied?) {
        (_, VariedOutcome::Interrupted) => RunOutcome::Interrupted,
        (outcome, VariedOutcome::Done) => outcome,
    };
    let report = report(study, &store, outcome)?;
    Ok(WholeRun { store, report })
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
        undamped_modes: model.undamped_modes(),
        undamped_in_contact: model.undamped_in_contact(),
        figures: Vec::new(),
    })
}
