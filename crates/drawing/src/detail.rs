//! Whether there is anything in the parts of diagrams that are to be drawn again, larger.

use hammerbeam_figure::plain_number;
use hammerbeam_results::{Store, StoreError, store::BranchRecord};

use crate::{DrawingError, FigureDetail, FigureSelection};

/// Refuses a detail that no diagram would show.
///
/// # Errors
/// [`DrawingError::Detail`], or the results cannot be read.
pub fn ensure_details(store: &Store, selection: &FigureSelection) -> Result<(), DrawingError> {
    for (place, detail) in selection.details.iter().enumerate() {
        let before = &selection.details[..place];
        let reason = if before.iter().any(|other| other.parameter == detail.parameter) {
            Some("the same axis has another detail already".to_owned())
        } else if !selection.kinds.contains(&detail.kind()) {
            Some("--kind leaves its diagrams out".to_owned())
        } else {
            emptiness(store, detail)?
        };
        if let Some(reason) = reason {
            return Err(DrawingError::Detail { detail: detail.to_string(), reason });
        }
    }
    Ok(())
}

/// Why nothing stored would be in a detail.
fn emptiness(store: &Store, detail: &FigureDetail) -> Result<Option<String>, StoreError> {
    let Some(parameter) = &detail.parameter else {
        let reason = emptiness_among(store, &store.branches()?, detail)?;
        return Ok(reason.map(|reason| format!("{reason} over the frequency")));
    };
    let varied = store.pieces()?.into_iter().filter(|piece| !piece.kind.is_curve());
    let (of, others): (Vec<_>, Vec<_>) = varied.partition(|piece| piece.parameter == *parameter);
    if of.is_empty() {
        let others: Vec<String> = others.into_iter().map(|piece| piece.parameter).collect();
        let there = match others.as_slice() {
            [] => "there is no [[vary]]".to_owned(),
            others => format!("there are branches over {}", others.join(", ")),
        };
        return Ok(Some(format!("there is no branch over {parameter}; {there}")));
    }
    let branches: Vec<BranchRecord> = of.into_iter().flat_map(|piece| piece.branches).collect();
    let reason = emptiness_among(store, &branches, detail)?;
    Ok(reason.map(|reason| format!("{reason} over {parameter}")))
}

fn emptiness_among(
    store: &Store,
    branches: &[BranchRecord],
    detail: &FigureDetail,
) -> Result<Option<String>, StoreError> {
    let (from, to) = detail.range;
    let (mut low, mut high, mut is_inside) = (f64::INFINITY, f64::NEG_INFINITY, false);
    for branch in branches {
        store.each_row::<StoreError>(branch, |row| {
            (low, high) = (low.min(row.parameter), high.max(row.parameter));
            is_inside |= (from..=to).contains(&row.parameter);
            Ok(())
        })?;
    }
    Ok(match (is_inside, low <= high) {
        (true, _) => None,
        (false, true) => Some(format!(
            "no solution is inside; there are some from {} to {}",
            plain_number(low),
            plain_number(high)
        )),
        (false, false) => Some("there is no solution".to_owned()),
    })
}
