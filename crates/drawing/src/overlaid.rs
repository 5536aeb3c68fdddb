//! Response diagrams of further results folders behind those of the first.

use std::{collections::BTreeMap, path::Path};

use hammerbeam_figure::OverlaidBranches;
use hammerbeam_jobs::JobError;
use hammerbeam_results::Store;
use hammerbeam_study::{Study, StudyFile, file::Excitation};

use crate::{
    DrawingError, FigureSelection,
    branches::curves,
    outputs::{ShownOutput, shown_outputs},
};

/// A further results folder.
pub struct Overlaid {
    store: Store,
    /// Its outputs that are shown.
    shown: Vec<ShownOutput>,
    /// Its branches, and ends of their frequency range [Hz].
    pub branches: OverlaidBranches,
    pub range_hz: [f64; 2],
}

impl Overlaid {
    /// Opens a folder whose branches are laid over those of a study.
    ///
    /// # Errors
    /// [`DrawingError::NotAlike`], and what is wrong with the folder.
    pub fn open(folder: &Path, name: &str, study: &Study) -> Result<Self, DrawingError> {
        let (store, file) = opened(folder, study)?;
        let branches = OverlaidBranches { name: name.to_owned(), curves: curves(&store)? };
        let shown = shown_outputs(&store, &file)?;
        Ok(Self { range_hz: file.study.excitation.range_hz(), store, shown, branches })
    }

    /// Its branches with the values of an output of the first results, where it has the same.
    pub fn with_output(&self, output: &ShownOutput) -> Result<Option<OverlaidBranches>, DrawingError> {
        let Some(own) = self.shown.iter().find(|own| own.shows_as(output)) else { return Ok(None) };
        let mut branches = self.branches.clone();
        own.fill(&self.store, &self.store.branches()?, &mut branches.curves)?;
        Ok(Some(branches))
    }
}

/// Refuses further folders whose branches cannot be laid over those of a study.
///
/// # Errors
/// [`DrawingError::NotAlike`], [`DrawingError::Store`], [`DrawingError::Job`].
pub fn ensure_alike(selection: &FigureSelection, file: &StudyFile) -> Result<(), DrawingError> {
    selection.with.iter().try_for_each(|folder| opened(folder, &file.study).map(|_| ()))
}

/// A further folder with its study.
fn opened(folder: &Path, study: &Study) -> Result<(Store, StudyFile), DrawingError> {
    let store = Store::open(folder)?;
    let file = StudyFile::parse("study.toml", store.about("study")?).map_err(JobError::from)?;
    match difference(study, &file.study) {
        None => Ok((store, file)),
        Some(difference) => Err(DrawingError::NotAlike { folder: folder.display().to_string(), difference }),
    }
}

/// What results folders are called: by their last part, or in full where two have the same.
pub fn names(folders: &[&Path]) -> Vec<String> {
    let last = |folder: &Path| {
        let whole = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        whole.file_name().map_or_else(|| folder.display().to_string(), |name| name.to_string_lossy().into())
    };
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for folder in folders {
        *counts.entry(last(folder)).or_default() += 1;
    }
    let name = |folder: &&Path| match counts.get(&last(folder)) {
        Some(1) => last(folder),
        _ => folder.display().to_string(),
    };
    folders.iter().map(name).collect()
}

/// In what two studies differ so that their diagrams show different things.
fn difference(first: &Study, other: &Study) -> Option<String> {
    let (point, of_other) = (&first.response.point, &other.response.point);
    if point != of_other {
        return Some(format!("its response point is {of_other} instead of {point}"));
    }
    let [own, others] = [&first.excitation, &other.excitation].map(excited_by);
    (own != others).then(|| format!("it is excited by {others} instead of {own}"))
}

fn excited_by(excitation: &Excitation) -> &'static str {
    match (excitation.harmonic().is_some(), excitation.supports().is_empty()) {
        (false, _) => "nothing",
        (true, true) => "forces",
        (true, false) => "moving supports",
    }
}
