//! Figures of the Floquet multipliers of the branches.

use hammerbeam_figure::{MultiplierDiagram, Multipliers};
use hammerbeam_orbit::Stability;
use hammerbeam_results::{Store, StoreError, row::Row, store::BranchRecord};

use crate::{Album, DrawingError, Drawn};

/// Solutions of a branch that are drawn at least, where it has so many, besides all bifurcations.
const DRAWN: usize = 4000;

/// Draws the multipliers of each branch, over the frequency and in the complex plane.
pub fn draw(store: &Store, drawn: &mut Drawn<'_>) -> Result<(), DrawingError> {
    for branch in store.branches()? {
        if drawn.is_stopped() {
            break;
        }
        let title = format!("{}, branch {}", store.about("title")?, branch.id);
        let name = format!("multipliers-{}", branch.id);
        let found = drawn.unless_damaged(solutions(store, &branch), &name)?;
        let Some(solutions) = found else { continue };
        let diagram = MultiplierDiagram { title, solutions };
        let moduli = diagram.draw_moduli(&drawn.wide());
        drawn.add(&name, moduli);
        let circle = diagram.draw_circle(&drawn.narrow());
        drawn.add(&format!("{name}-unit-circle"), circle);
    }
    Ok(())
}

/// Multipliers along a branch, thinned; a damaged solution is reported, drawn or not.
fn solutions(store: &Store, branch: &BranchRecord) -> Result<Vec<Multipliers>, StoreError> {
    let mut rows = Vec::new();
    store.each_row::<StoreError>(branch, |row| {
        rows.push(row);
        Ok(())
    })?;
    let step = rows.len().div_ceil(DRAWN).max(1);
    let is_drawn = |place: usize, row: &Row| place.is_multiple_of(step) || row.events.is_bifurcation();
    let (mut rows, mut drawn) = (rows.iter().enumerate(), Vec::new());
    store.each_multipliers::<StoreError>(branch, |found| {
        let multipliers = found?;
        if let Some((_, row)) = rows.next().filter(|(place, row)| is_drawn(*place, row)) {
            drawn.push(Multipliers {
                frequency_hz: row.frequency_hz,
                stable: row.stability.may_be_stable(),
                marginal: row.stability == Stability::Marginal,
                multipliers,
            });
        }
        Ok(())
    })?;
    Ok(drawn)
}
