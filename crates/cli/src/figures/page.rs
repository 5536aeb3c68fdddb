//! The page of a results folder: reads everything that is stored and hands it over as plain rows.

mod choice;
mod orbits;
mod shape;

use hammerbeam_attractor::Class;
use hammerbeam_figure::{
    MultiplierRecords, Page, PageBranch, PageMotion, PageSection, PageSolution, room_for_orbits,
};
use hammerbeam_orbit::Side;
use hammerbeam_study::{
    Model, Store, StoreError, StudyFile,
    store::{BranchRecord, RequestKind, Row, WalkRecord},
};

use super::{Drawn, motions};

/// Name of the file.
pub const NAME: &str = "page.html";

/// Draws the page, unless nothing of what it shows is stored or the user asks to stop.
pub fn draw(store: &Store, file: &StudyFile, model: &Model, drawn: &mut Drawn<'_>) -> anyhow::Result<()> {
    let records = store.branches()?;
    let (motions, sections) = (swept(store)?, sections(store)?);
    if records.is_empty() && motions.is_empty() && sections.is_empty() {
        return Ok(());
    }
    let mut stored = Vec::new();
    let mut branches = Vec::new();
    let mut multipliers = MultiplierRecords::default();
    for record in &records {
        let places = places(store, record)?;
        store.each_multipliers::<StoreError>(record, |found| {
            multipliers.push(&found.unwrap_or_else(|error| {
                drawn.refuse("multipliers on the page", error.to_string());
                Vec::new()
            }));
            Ok(())
        })?;
        branches.push(branch(record, &places));
        stored.push(places);
    }
    let solutions: usize = stored.iter().map(Vec::len).sum();
    let most = room_for_orbits(solutions, &multipliers);
    let [low, high] = file.study.excitation.frequency_hz;
    let orbits = orbits::carried(store, model, (&records, &stored), (most, drawn))?;
    if drawn.is_stopped() {
        return Ok(());
    }
    let page = Page {
        title: store.about("title")?,
        point: file.study.response.point.clone(),
        frequency_range_hz: (low, high),
        notice: notice(store, &records)?,
        branches,
        orbits,
        multipliers,
        structure: Some(shape::structure(file, model)),
        motions,
        chaotic_ranges_hz: motions::chaotic_ranges(store)?,
        sections,
        measured: Vec::new(),
    };
    drawn.write(NAME, move || page.html());
    Ok(())
}

/// A row with the place of its solution in the store.
pub(super) struct Placed {
    side: Side,
    number: u32,
    row: Row,
}

/// Rows of a branch, end to end.
fn places(store: &Store, record: &BranchRecord) -> Result<Vec<Placed>, StoreError> {
    let of = |side: Side| -> Result<Vec<Placed>, StoreError> {
        let rows = store.walked(record.start, side)?.into_iter().enumerate();
        Ok(rows.map(|(number, row)| Placed { side, number: number as u32, row }).collect())
    };
    let mut places = of(Side::Down)?;
    places.reverse();
    places.extend(of(Side::Up)?);
    Ok(places)
}

fn branch(record: &BranchRecord, places: &[Placed]) -> PageBranch {
    let end = |walk: &WalkRecord| {
        walk.reason.as_ref().map_or_else(|| "not finished".to_owned(), |reason| reason.message.clone())
    };
    PageBranch {
        id: record.id,
        period_multiple: record.period_multiple,
        ends: [end(&record.down), end(&record.up)],
        solutions: places.iter().map(|placed| solution(&placed.row)).collect(),
    }
}

fn solution(row: &Row) -> PageSolution {
    PageSolution {
        frequency_hz: row.frequency_hz,
        displacement_m: row.maxima.displacement,
        acceleration_m_s2: row.maxima.acceleration,
        force_n: row.maxima.contact_force,
        impact_velocity_m_s: row.maxima.impact_velocity,
        contacts: row.maxima.contacts,
        leading_multiplier: row.leading_multiplier,
        stable: row.stable,
        fold: row.events.fold,
        flip: row.events.flip,
        neimark_sacker: row.events.neimark_sacker,
        branch_point: row.events.branch_point,
        grazing: row.events.grazing,
    }
}

/// What is not finished, in words; empty if everything is.
fn notice(store: &Store, records: &[BranchRecord]) -> Result<String, StoreError> {
    let walks = records.iter().flat_map(|record| [&record.up, &record.down]);
    let open = walks.filter(|walk| walk.reason.is_none()).count();
    let left = store.jobs()?.iter().filter(|job| job.outcome.is_none()).count();
    if open == 0 && left == 0 {
        return Ok(String::new());
    }
    let (walks, jobs) = ("sides of branches under way", "searches, flips and branch points left");
    Ok(format!("The run was not finished when this page was drawn; {walks}: {open}; {jobs}: {left}."))
}

/// Motions of sweeps that do not repeat.
fn swept(store: &Store) -> Result<Vec<PageMotion>, StoreError> {
    let mut motions = Vec::new();
    for request in store.requests()? {
        if matches!(request.kind, RequestKind::Sweep | RequestKind::Starts) {
            let settled = store.settled(request.id)?.into_iter();
            let irregular = settled.filter(|motion| !matches!(motion.point.class, Class::Periodic { .. }));
            motions.extend(irregular.map(|motion| PageMotion {
                frequency_hz: motion.point.frequency_hz,
                kind: motions::kind(motion.point.class),
                displacement_m: motion.point.max_abs_displacement,
            }));
        }
    }
    Ok(motions)
}

/// Stroboscopic points of every motion whose exponents are stored.
fn sections(store: &Store) -> Result<Vec<PageSection>, StoreError> {
    let mut sections = Vec::new();
    for request in store.requests()? {
        if request.kind == RequestKind::Exponents {
            sections.extend(store.exponents(request.id)?.into_iter().map(|record| PageSection {
                frequency_hz: record.frequency_hz,
                exponent_per_s:
                    record.spectrum.exponents.first().map(|exponent| (exponent.value, exponent.half_width)),
                dimension: Some(record.spectrum.kaplan_yorke_dimension),
                points: record.section.iter().map(|point| (point[0], point[1])).collect(),
            }));
        }
    }
    Ok(sections)
}
