//! Requests: where the results of a motion, a sweep, exponents or basins are kept, and what identifies them.

use std::path::Path;

use hammerbeam_attractor::{Effort, frequencies};
use hammerbeam_results::{
    Store,
    store::{DATABASE, RequestKind, StoreError},
};
use hammerbeam_study::StudyFile;

use crate::{JobError, StoredBranches};

/// The results folders of a job.
#[derive(Debug, Clone, Copy, Default)]
pub struct JobFolders<'a> {
    /// With branches: to begin at, or to compare with.
    pub results: Option<&'a Path>,
    /// For what is computed, made if it is not there; a job that was stopped goes on from there.
    pub out: Option<&'a Path>,
}

impl JobFolders<'_> {
    /// Branches of the results, else those of the folder for what is computed if it has some.
    ///
    /// They are opened before the work, so that a wrong folder is reported at once, and again after it, when
    /// they are closed before the store is finished: nobody may read the results then.
    pub(crate) fn branches(&self, file: &StudyFile) -> Result<Option<StoredBranches>, StoreError> {
        if let Some(folder) = self.results {
            return StoredBranches::open(folder, file).map(Some);
        }
        let own = self.out.filter(|folder| folder.join(DATABASE).is_file());
        match own.map(|folder| StoredBranches::open(folder, file)).transpose() {
            // Of a job that ended before it had stored anything.
            Err(StoreError::NoResults { .. }) => Ok(None),
            other => other,
        }
    }

    /// The folder for what is computed, as reports name it.
    pub(crate) fn shown(&self) -> Option<String> {
        self.out.map(|folder| folder.display().to_string())
    }
}

/// A series of rising frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrequencySeries {
    /// The first one [Hz].
    pub from_hz: f64,
    /// The last one [Hz].
    pub to_hz: f64,
    /// The step [Hz]; a hundredth of the way if there is none.
    pub step_hz: Option<f64>,
}

impl FrequencySeries {
    /// All of them; both ends belong to them.
    ///
    /// # Errors
    /// [`JobError::FallingFrequencies`], or a number that makes no sense.
    pub fn frequencies(&self) -> Result<Vec<f64>, JobError> {
        let Self { from_hz, to_hz, step_hz } = *self;
        if to_hz < from_hz {
            return Err(JobError::FallingFrequencies { from_hz, to_hz });
        }
        let step = step_hz.unwrap_or(((to_hz - from_hz) / 100.0).max(f64::MIN_POSITIVE));
        Ok(frequencies(from_hz, to_hz, step)?)
    }
}

/// A request, and the store that keeps its results if there is one.
#[derive(Debug)]
pub(crate) struct KeptRequest {
    store: Option<Store>,
    request: i64,
    /// Pieces that were done before.
    pub done: u64,
}

impl KeptRequest {
    /// Finds a request in a results folder, or adds it.
    ///
    /// * `words`: everything that its results depend on besides the study, as lines `key = value`.
    pub fn open(
        out: Option<&Path>,
        file: &StudyFile,
        (kind, words): (RequestKind, &[String]),
        pieces: u64,
    ) -> Result<Self, StoreError> {
        let Some(folder) = out else { return Ok(Self { store: None, request: 0, done: 0 }) };
        let mut store = Store::open_for_run(folder, file)?;
        let request = store.request(kind, &words.join("\n"), pieces)?;
        Ok(Self { store: Some(store), request: request.id, done: request.done })
    }

    /// Its number in the folder, if it is kept.
    pub fn number(&self) -> Option<i64> {
        self.store.as_ref().map(|_| self.request)
    }

    /// What is stored of the request.
    pub fn read<T: Default>(
        &self,
        read: impl FnOnce(&Store, i64) -> Result<T, StoreError>,
    ) -> Result<T, StoreError> {
        self.store.as_ref().map_or_else(|| Ok(T::default()), |store| read(store, self.request))
    }

    /// The store and the number of the request, to read it piece by piece.
    pub fn stored(&self) -> Option<(&Store, i64)> {
        self.store.as_ref().map(|store| (store, self.request))
    }

    /// Stores more of it.
    pub fn add(
        &mut self,
        add: impl FnOnce(&mut Store, i64) -> Result<(), StoreError>,
    ) -> Result<(), StoreError> {
        self.store.as_mut().map_or(Ok(()), |store| add(store, self.request))
    }

    /// Closes the store.
    pub fn finish(self) -> Result<(), StoreError> {
        self.store.map_or(Ok(()), Store::finish)
    }
}

/// The words of a state.
pub(crate) fn state_words(state: &[f64]) -> impl Iterator<Item = String> {
    state.iter().enumerate().map(|(index, entry)| format!("state[{index}] = {entry:e}"))
}

/// The words of what is spent on the kind of a motion.
pub(crate) fn effort_words(effort: &Effort) -> [String; 4] {
    [
        format!("transient_periods = {}", effort.patience.skipped),
        format!("patience_periods = {}", effort.patience.periods),
        format!("longest_period = {}", effort.patience.longest),
        format!("averaged_periods = {}", effort.averaged),
    ]
}
