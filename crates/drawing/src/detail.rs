//! Whether there is anything in the parts of diagrams that are to be drawn again, larger.

use hammerbeam_figure::plain_number;
use hammerbeam_results::{Store, StoreError, store::BranchRecord};

use crate::{DrawingError, FigureDetail, FigureSelection};

/// Refuses a detail that no diagram would show, or that shows no less than all of one.
///
/// Stored solutions that are missing or damaged are none: what needs them is named when it is drawn.
///
/// # Errors
/// [`DrawingError::Detail`], or the results cannot be read.
pub fn ensure_details(store: &Store, selection: &FigureSelection) -> Result<(), DrawingError> {
    for (place, detail) in selection.details.iter().enumerate() {
        let before = &selection.details[..place];
        let reason = if before.iter().any(|other| other.parameter == detail.parameter) {
            Some("the same axis has another detail already".to_owned())
        } else {
            match reason_against(store, selection, detail) {
                Err(error) if error.is_of_solutions() => None,
                found => found?,
            }
        };
        if let Some(reason) = reason {
            return Err(DrawingError::Detail { detail: detail.to_string(), reason });
        }
    }
    Ok(())
}

fn reason_against(
    store: &Store,
    selection: &FigureSelection,
    detail: &FigureDetail,
) -> Result<Option<String>, StoreError> {
    let mut reach = Reach::default();
    let Some(parameter) = &detail.parameter else {
        reach.extend(store, &store.branches()?, detail)?;
        for folder in &selection.with {
            let other = Store::open(folder)?;
            reach.extend(&other, &other.branches()?, detail)?;
        }
        return Ok(reach.reason_against(detail, "the frequency"));
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
    for piece in of {
        reach.extend(store, &piece.branches, detail)?;
    }
    Ok(reach.reason_against(detail, parameter))
}

/// Where the solutions of branches are along a horizontal axis.
struct Reach {
    low: f64,
    high: f64,
    /// Whether one is in the detail.
    is_inside: bool,
}

impl Default for Reach {
    fn default() -> Self {
        Self { low: f64::INFINITY, high: f64::NEG_INFINITY, is_inside: false }
    }
}

impl Reach {
    fn extend(
        &mut self,
        store: &Store,
        branches: &[BranchRecord],
        detail: &FigureDetail,
    ) -> Result<(), StoreError> {
        let (from, to) = detail.range;
        for branch in branches {
            store.each_row::<StoreError>(branch, |row| {
                (self.low, self.high) = (self.low.min(row.parameter), self.high.max(row.parameter));
                self.is_inside |= (from..=to).contains(&row.parameter);
                Ok(())
            })?;
        }
        Ok(())
    }

    fn reason_against(&self, detail: &FigureDetail, axis: &str) -> Option<String> {
        let (from, to) = detail.range;
        if self.low > self.high {
            return Some(format!("there is no solution over {axis}"));
        }
        let [low, high] = [self.low, self.high].map(plain_number);
        if !self.is_inside {
            return Some(format!(
                "no stored solution is inside; over {axis} there are some from {low} to {high}"
            ));
        }
        let is_all = from <= self.low && self.high <= to;
        is_all.then(|| format!("these are all solutions: over {axis} they go from {low} to {high}"))
    }
}
