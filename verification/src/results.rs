//! Whole runs of a study, and where their branches cross a frequency.

use std::path::Path;

use hammerbeam_jobs::{
    Observer, OrbitSolver, Quiet, StoredBranch, StoredBranches,
    run::{Plan, run},
};
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_results::{Store, store::BranchRecord};
use hammerbeam_study::{Model, StudyFile};

/// What ends a check before it has a result.
pub type BoxedError = Box<dyn std::error::Error + Send + Sync>;

/// Stored branches of a study, with its model.
#[derive(Debug)]
pub struct Results {
    /// The equations of motion.
    pub model: Model,
    /// Range of the excitation frequency [Hz].
    pub range_hz: [f64; 2],
    stored: StoredBranches,
}

impl Results {
    /// Runs a study into a folder on so many threads, and reads what came of it.
    ///
    /// # Errors
    /// The study is wrong, or the store refuses.
    pub fn of_run(text: &str, folder: &Path, threads: usize) -> Result<Self, BoxedError> {
        Self::of_watched_run(text, folder, threads, &mut Quiet)
    }

    /// The same, watched by an observer, which may end it early.
    ///
    /// # Errors
    /// The study is wrong, or the store refuses.
    pub fn of_watched_run(
        text: &str,
        folder: &Path,
        threads: usize,
        observer: &mut dyn Observer,
    ) -> Result<Self, BoxedError> {
        let file = StudyFile::parse("study.toml", text.to_owned())?;
        let model = Model::build(&file)?;
        let mut store = Store::open_for_run(folder, &file)?;
        let solver = OrbitSolver::new(&model, &file.study);
        run(&mut store, &solver, &Plan::of(&file.study), threads, observer)?;
        store.finish()?;
        Self::read(text, folder)
    }

    /// Reads the results of a study.
    ///
    /// # Errors
    /// The study is wrong, or the store refuses.
    pub fn read(text: &str, folder: &Path) -> Result<Self, BoxedError> {
        let file = StudyFile::parse("study.toml", text.to_owned())?;
        let model = Model::build(&file)?;
        let stored = StoredBranches::open(folder, &file)?;
        Ok(Self { model, range_hz: file.study.excitation.range_hz(), stored })
    }

    /// The branches, in their order.
    #[must_use]
    pub fn branches(&self) -> &[StoredBranch] {
        self.stored.branches()
    }

    /// Orbits in which the branches of a period multiple cross a frequency, each with the number of its
    /// branch.
    ///
    /// # Errors
    /// The store refuses.
    pub fn crossings(
        &self,
        frequency_hz: f64,
        period_multiple: u32,
    ) -> Result<Vec<(u32, PeriodicSolution)>, BoxedError> {
        let wanted = |record: &BranchRecord| record.period_multiple == period_multiple;
        Ok(self.stored.crossings(&self.model, frequency_hz, wanted)?)
    }
}
