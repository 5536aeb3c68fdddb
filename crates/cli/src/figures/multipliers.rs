//! Figures of the Floquet multipliers of the branches.

use hammerbeam_figure::{MultiplierDiagram, Multipliers, Style};
use hammerbeam_orbit::Side;
use hammerbeam_study::{
    Store, StoreError,
    store::{BranchRecord, Row},
};

use super::{Album, Drawn, unless_damaged};
use crate::failure::Failure;

/// Solutions of a branch that are drawn at least, where it has so many, besides all bifurcations.
const DRAWN: usize = 4000;

/// Draws the multipliers of each branch, over the frequency and in the complex plane.
pub fn draw(store: &Store, drawn: &mut Drawn<'_>) -> Result<(), Failure> {
    for branch in store.branches()? {
        if drawn.is_stopped() {
            break;
        }
        let title = format!("{}, branch {}", store.about("title")?, branch.id);
        let name = format!("multipliers-{}", branch.id);
        let found = unless_damaged(solutions(store, &branch), &name, drawn)?;
        let Some(solutions) = found else { continue };
        let diagram = MultiplierDiagram { title, solutions };
        let moduli = diagram.draw_moduli(&Style::double_column());
        drawn.add(&name, moduli);
        let circle = diagram.draw_circle(&Style::single_column());
        drawn.add(&format!("{name}-unit-circle"), circle);
    }
    Ok(())
}

fn solutions(store: &Store, branch: &BranchRecord) -> Result<Vec<Multipliers>, StoreError> {
    let down = store.walked(branch.start, Side::Down)?;
    let up = store.walked(branch.start, Side::Up)?;
    let step = (down.len() + up.len()).div_ceil(DRAWN).max(1);
    let places = (0..down.len()).rev().map(|number| (Side::Down, number, &down[number]));
    let places = places.chain((0..up.len()).map(|number| (Side::Up, number, &up[number])));
    let is_drawn = |place: usize, row: &Row| {
        let events = &row.events;
        place.is_multiple_of(step)
            || events.fold
            || events.flip
            || events.neimark_sacker
            || events.branch_point
    };
    places
        .enumerate()
        .filter(|(place, (_, _, row))| is_drawn(*place, row))
        .map(|(_, (side, number, row))| {
            let solution = store.solution(branch.start, side, number as u32)?;
            let multipliers = solution.floquet_multipliers;
            Ok(Multipliers { frequency_hz: row.frequency_hz, stable: row.stable, multipliers })
        })
        .collect()
}
