//! Numbers of outputs over the branches of the page.

use hammerbeam_figure::{PageBranch, PageOutput};
use hammerbeam_results::{Store, StoreError, store::BranchRecord};
use hammerbeam_study::StudyFile;

use crate::outputs::{ShownOutput, shown_outputs};

/// What the study shows of its outputs, over the branches of the page.
pub fn of_branches(
    store: &Store,
    file: &StudyFile,
    branches: &[PageBranch],
) -> Result<Vec<PageOutput>, StoreError> {
    let mut records = store.branches()?;
    for piece in store.pieces()?.into_iter().filter(|piece| !piece.kind.is_curve()) {
        // As on the page, where branches without solutions are left out.
        records.extend(piece.branches.into_iter().filter(|branch| branch.solutions() > 0));
    }
    let expected: usize = branches.iter().map(|branch| branch.solutions.len()).sum();
    let mut outputs = Vec::new();
    for shown in shown_outputs(store, file)? {
        let mut values = values(store, &shown, &records)?;
        // A run that writes meanwhile has added some.
        values.resize(expected, f64::NAN);
        outputs.push(PageOutput { title: shown.title(), unit: shown.unit().to_owned(), values });
    }
    Ok(outputs)
}

fn values(store: &Store, shown: &ShownOutput, records: &[BranchRecord]) -> Result<Vec<f64>, StoreError> {
    let mut values = Vec::new();
    for record in records {
        values.extend(shown.along(store, record)?);
    }
    Ok(values)
}
