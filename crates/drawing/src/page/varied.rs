//! Branches over another parameter than the frequency, behind those over the frequency.

use hammerbeam_figure::{Page, PageBranch, PageParameter};
use hammerbeam_results::{
    Store, StoreError,
    store::{BranchRecord, PieceRecord},
};

use super::solution::solution;
use crate::parameter::parameter_axis;

/// Adds the branches of every `[[vary]]` of the study, with their leading multipliers.
///
/// Their numbers go on from those of the branches over the frequency.
pub fn add(store: &Store, page: &mut Page) -> Result<(), StoreError> {
    let mut id = page.branches.iter().map(|branch| branch.id).max().unwrap_or(0);
    for piece in store.pieces()?.into_iter().filter(|piece| !piece.kind.is_curve()) {
        let over = page.parameters.len() as u32 + 1;
        let mut branches = branches(store, &piece)?;
        branches.retain(|branch| !branch.solutions.is_empty());
        let Some(first) = branches.first().and_then(|branch| branch.solutions.first()) else { continue };
        let axis = parameter_axis(&piece.parameter);
        page.parameters.push(PageParameter { axis, frequency_hz: first.frequency_hz });
        for branch in branches {
            id += 1;
            for solution in &branch.solutions {
                let [re, im] = solution.leading_multiplier;
                let pair = [[re, im], [re, -im]];
                page.multipliers.push(if im == 0.0 { &pair[..1] } else { &pair });
            }
            page.branches.push(PageBranch { id, over, ..branch });
        }
    }
    Ok(())
}

fn branches(store: &Store, piece: &PieceRecord) -> Result<Vec<PageBranch>, StoreError> {
    let branch = |record: &BranchRecord| {
        let mut solutions = Vec::new();
        store.each_row::<StoreError>(record, |row| {
            solutions.push(solution(&row));
            Ok(())
        })?;
        Ok(PageBranch { period_multiple: record.period_multiple, solutions, ..PageBranch::default() })
    };
    piece.branches.iter().map(branch).collect()
}
