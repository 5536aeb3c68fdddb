//! The page of a results folder: reads everything that is stored and hands it over as plain rows.

mod choice;
mod gallery;
mod irregular;
mod measured;
mod orbits;
mod outputs;
mod shape;
mod solution;
mod varied;

use hammerbeam_figure::{MultiplierRecords, Page, PageBranch};
use hammerbeam_results::{
    Store, StoreError,
    store::{BranchRecord, PlacedRow, RequestKind, WalkRecord},
};
use hammerbeam_study::{Model, StudyFile};
use solution::solution;

use super::{Album, Drawn, motions};
use crate::DrawingError;

/// Name of the file.
pub const NAME: &str = "page.html";

/// Draws the page, unless nothing of what it shows is stored or the user asks to stop.
pub fn draw(
    store: &Store,
    file: &StudyFile,
    model: &Model,
    drawn: &mut Drawn<'_>,
) -> Result<(), DrawingError> {
    let records = store.branches()?;
    if records.is_empty() && !has_more(store)? {
        return Ok(());
    }
    let stored: Vec<Vec<PlacedRow>> =
        records.iter().map(|record| store.placed_rows(record)).collect::<Result<_, _>>()?;
    let [low, high] = file.study.excitation.range_hz();
    let mut page = Page {
        title: store.about("title")?,
        point: file.study.response.point.clone(),
        frequency_range_hz: (low, high),
        notice: notice(store, &records)?,
        folder_name: store.folder().file_name().unwrap_or_default().to_string_lossy().into_owned(),
        branches: records.iter().zip(&stored).map(|(record, places)| branch(record, places)).collect(),
        multipliers: multipliers(store, &records, drawn)?,
        structure: Some(shape::structure(file, model)),
        motions: irregular::of_sweeps(store)?,
        chaotic_ranges_hz: motions::chaotic_ranges(store)?,
        sections: irregular::sections(store)?,
        measured: measured::series(store.folder(), drawn),
        figures: gallery::figures(store, (file, model), drawn)?,
        ..Page::default()
    };
    energies(store, &records, &model.system.model().natural_frequencies, &mut page.branches)?;
    varied::add(store, &mut page)?;
    page.outputs = outputs::of_branches(store, file, &page.branches)?;
    let page = page.pack();
    let orbits = orbits::carried(store, model, (&records, &stored), (page.room_for_orbits(), drawn))?;
    if !drawn.is_stopped() {
        drawn.write(NAME, move || page.html(&orbits));
    }
    Ok(())
}

/// Whether there is more than branches: motions, or solutions over other parameters.
fn has_more(store: &Store) -> Result<bool, StoreError> {
    for request in store.requests()? {
        let is_empty = match request.kind {
            // Nothing is drawn of a motion in time.
            RequestKind::Simulation => true,
            RequestKind::Sweep | RequestKind::Starts => store.settled(request.id)?.is_empty(),
            RequestKind::Exponents => store.exponents(request.id)?.is_empty(),
            RequestKind::Basins => store.basins(request.id)?.0.is_empty(),
        };
        if !is_empty {
            return Ok(true);
        }
    }
    Ok(store.pieces()?.iter().any(|piece| !piece.branches.is_empty()))
}

/// Multipliers of all solutions; those of a damaged one are named and left out.
fn multipliers(
    store: &Store,
    records: &[BranchRecord],
    drawn: &mut Drawn<'_>,
) -> Result<MultiplierRecords, StoreError> {
    let mut multipliers = MultiplierRecords::default();
    for record in records {
        store.each_multipliers::<StoreError>(record, |found| {
            multipliers.push(&found.unwrap_or_else(|error| {
                drawn.refuse("multipliers on the page", error.to_string());
                Vec::new()
            }));
            Ok(())
        })?;
    }
    Ok(multipliers)
}

/// Energies of all solutions whose orbits start at phase 0; those of damaged ones stay unknown.
///
/// `½ Σ (q'_k² + ω_k² q_k²)` over the modes `k`, which have a mass of one: kinetic energy and that of the
/// structure's springs, without the stops [J].
fn energies(
    store: &Store,
    records: &[BranchRecord],
    rates: &[f64],
    branches: &mut [PageBranch],
) -> Result<(), StoreError> {
    for (record, branch) in records.iter().zip(branches) {
        let mut solutions = branch.solutions.iter_mut();
        store.each_beginning::<StoreError>(record, |found| {
            let Some(solution) = solutions.next() else { return Ok(()) };
            if let Ok((0.0, state)) = found {
                solution.energy_j = energy(&state, rates);
            }
            Ok(())
        })?;
    }
    Ok(())
}

fn energy(state: &[f64], rates: &[f64]) -> f64 {
    let (displacements, velocities) = state.split_at(state.len() / 2);
    let modes = displacements.iter().zip(velocities).zip(rates);
    0.5 * modes.map(|((q, v), rate)| v * v + (rate * q).powi(2)).sum::<f64>()
}

fn branch(record: &BranchRecord, places: &[PlacedRow]) -> PageBranch {
    let end =
        |walk: &WalkRecord| walk.end.as_ref().map_or_else(|| "not finished".to_owned(), ToString::to_string);
    PageBranch {
        id: record.id,
        period_multiple: record.period_multiple,
        over: 0,
        ends: [end(&record.down), end(&record.up)],
        solutions: places.iter().map(|placed| solution(&placed.row)).collect(),
    }
}

/// What is not finished, in words; empty if everything is.
fn notice(store: &Store, records: &[BranchRecord]) -> Result<String, StoreError> {
    let walks = records.iter().flat_map(|record| [&record.up, &record.down]);
    let open = walks.filter(|walk| walk.end.is_none()).count();
    let left = store.jobs()?.iter().filter(|job| job.outcome.is_none()).count();
    if open == 0 && left == 0 {
        return Ok(String::new());
    }
    let (walks, jobs) = ("sides of branches under way", "searches, flips and branch points left");
    Ok(format!("The run was not finished when this page was drawn; {walks}: {open}; {jobs}: {left}."))
}
