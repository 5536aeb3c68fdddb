//! Where the results of a request are kept: in the results folder of `--out`, or nowhere.

use std::path::{Path, PathBuf};

use hammerbeam_jobs::StoredBranches;
use hammerbeam_results::{
    Store,
    store::{DATABASE, RequestKind, StoreError},
};
use hammerbeam_study::StudyFile;

use crate::failure::Failure;

/// A request, and the store that keeps its results if there is one.
#[derive(Debug)]
pub struct Kept {
    folder: Option<PathBuf>,
    store: Option<Store>,
    request: i64,
    /// Pieces that were done before.
    pub done: u64,
}

impl Kept {
    /// Finds or begins a request in a results folder.
    ///
    /// * `words`: everything that its results depend on besides the study, as lines `key = value`.
    pub fn open(
        out: Option<&Path>,
        file: &StudyFile,
        (kind, words): (RequestKind, &[String]),
        pieces: u64,
    ) -> Result<Self, Failure> {
        let Some(folder) = out else { return Ok(Self { folder: None, store: None, request: 0, done: 0 }) };
        let mut store = Store::open_for_run(folder, file)?;
        let request = store.request(kind, &words.join("\n"), pieces)?;
        Ok(Self {
            folder: Some(folder.to_owned()),
            store: Some(store),
            request: request.id,
            done: request.done,
        })
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
    pub fn finish(&mut self) -> Result<(), StoreError> {
        self.store.take().map_or(Ok(()), Store::finish)
    }

    /// What becomes of so many results of an interrupted command.
    pub fn fate(&self, number: u64) -> String {
        let be = if number == 1 { "is" } else { "are" };
        match &self.folder {
            Some(_) => format!("{}, the same command goes on from there", self.place(number)),
            None => format!("{be} lost without --out"),
        }
    }

    /// Where so many results are, of a command that cannot go on.
    pub fn place(&self, number: u64) -> String {
        let [be, have_been] = if number == 1 { ["is", "was"] } else { ["are", "were"] };
        match &self.folder {
            Some(folder) => format!("{be} kept in {}", folder.display()),
            None => format!("{have_been} computed"),
        }
    }
}

/// A number of things.
pub fn counted(number: u64, thing: &str) -> String {
    format!("{number} {thing}{}", if number == 1 { "" } else { "s" })
}

/// The words of a state.
pub fn state_words(state: &[f64]) -> impl Iterator<Item = String> {
    state.iter().enumerate().map(|(index, entry)| format!("state[{index}] = {entry:e}"))
}

/// Branches of the folder given, else those of the results if there are some.
///
/// They are read before the work, so that a wrong folder is told at once, and again after it, when they are
/// to be let go before the store is closed: nobody may read the results then.
pub fn branches(
    results: Option<&Path>,
    out: Option<&Path>,
    file: &StudyFile,
) -> Result<Option<StoredBranches>, StoreError> {
    if let Some(folder) = results {
        return StoredBranches::open(folder, file).map(Some);
    }
    let own = out.filter(|folder| folder.join(DATABASE).is_file());
    match own.map(|folder| StoredBranches::open(folder, file)).transpose() {
        // Of a command that ended before it had stored anything.
        Err(StoreError::NoResults { .. }) => Ok(None),
        other => other,
    }
}
