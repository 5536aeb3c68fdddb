//! Motions that need not repeat by columns: in time, settled ones, exponents, basins.

use hammerbeam_attractor::{Attractor, Estimate, fractions};

use super::{ArrayTable, ArrayValues, named, or_nan, or_none};
use crate::{
    export::grid,
    store::{
        ExponentRecord, RequestKind, RequestRecord, SettledMotion, SimulatedContact, SimulationLayout, Store,
        StoreError,
    },
};

/// The tables of every request in a store, with its number in their names.
///
/// # Errors
/// [`StoreError`].
pub fn motion_tables(store: &Store) -> Result<Vec<ArrayTable>, StoreError> {
    let mut tables = Vec::new();
    for request in store.requests()? {
        tables.extend(request_tables(store, &request)?.into_iter().map(|mut table| {
            table.name = format!("{}-{}", table.name, request.id);
            table
        }));
    }
    Ok(tables)
}

/// The tables of a request, with the columns of their CSV files: `samples`, `contacts`, `stroboscopic`;
/// `sweep`, `sweep_samples`; `spectra`, `exponents`; or `basins`, `attractors`.
///
/// # Errors
/// [`StoreError`].
pub fn request_tables(store: &Store, request: &RequestRecord) -> Result<Vec<ArrayTable>, StoreError> {
    match request.kind {
        RequestKind::Simulation => simulation(store, request),
        RequestKind::Sweep | RequestKind::Starts => Ok(settled(&store.settled(request.id)?)),
        RequestKind::Exponents => Ok(exponents(&store.exponents(request.id)?)),
        RequestKind::Basins => {
            let (cells, found) = store.basins(request.id)?;
            let grid = grid(request)?;
            let places: Vec<[f64; 2]> = (0..cells.len()).map(|cell| grid.place(cell)).collect();
            let along = |axis: usize| ArrayValues::Numbers(places.iter().map(|place| place[axis]).collect());
            let attractors = ArrayValues::Whole(cells.iter().map(|&cell| cell.into()).collect());
            let columns = named([("x", along(0)), ("y", along(1)), ("attractor", attractors)]);
            Ok(vec![ArrayTable::new("basins", columns), attractor_table(&cells, &found)])
        }
    }
}

/// Attractors of a grid, with the first state of each: `[q; q']` at phase 0. Branches are not known here.
fn attractor_table(cells: &[u32], attractors: &[Attractor]) -> ArrayTable {
    let shares = fractions(cells, attractors.len());
    let share = |of: &dyn Fn(&Estimate) -> f64| ArrayValues::Numbers(shares.iter().skip(1).map(of).collect());
    let number = |of: &dyn Fn(&Attractor) -> Option<f64>| {
        ArrayValues::Numbers(attractors.iter().map(|attractor| or_nan(of(attractor))).collect())
    };
    let class = attractors.iter().map(|attractor| attractor.class.name().into());
    let period = attractors.iter().map(|attractor| or_none(attractor.class.period()));
    let states: Vec<Vec<f64>> = attractors.iter().map(|attractor| attractor.states[0].clone()).collect();
    ArrayTable::new(
        "attractors",
        named([
            ("attractor", ArrayValues::Whole((1..).take(attractors.len()).collect())),
            ("class", ArrayValues::Words(class.collect())),
            ("period", ArrayValues::Whole(period.collect())),
            ("fraction", share(&|share| share.value)),
            ("standard_error", share(&|share| share.half_width)),
            ("largest_exponent_per_s", number(&|attractor| Some(attractor.largest_exponent?.value))),
            ("zero_one_k", number(&|attractor| attractor.zero_one)),
            ("branch", ArrayValues::Whole(vec![-1; attractors.len()])),
            ("state", ArrayValues::vectors(&states)),
        ]),
    )
}

/// Samples, contacts and the stroboscopic section of a motion in time.
fn simulation(store: &Store, request: &RequestRecord) -> Result<Vec<ArrayTable>, StoreError> {
    let layout = SimulationLayout::of(request)?;
    let (mut samples, mut section, mut contacts, mut open) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    store.each_simulated::<StoreError>(request.id, &layout, |chunk| {
        samples.extend(chunk.samples);
        section.extend(chunk.section);
        contacts.extend(chunk.contacts);
        open = chunk.unfinished;
        Ok(())
    })?;
    contacts.extend(open);
    Ok(vec![
        sample_table(&layout, &samples),
        contact_table(&layout, &contacts),
        section_table(&layout, &section),
    ])
}

/// Every `width`-th number, from `first` on.
fn strided(numbers: &[f64], first: usize, width: usize) -> ArrayValues {
    ArrayValues::Numbers(numbers.iter().skip(first).step_by(width).copied().collect())
}

fn sample_table(layout: &SimulationLayout, samples: &[f64]) -> ArrayTable {
    let width = layout.numbers_of_sample();
    let per_period = layout.samples_per_period as usize;
    let count = samples.len() / width;
    let phase = |sample: usize| layout.phase((sample % per_period) as u32);
    let time = |sample: usize| {
        (sample / per_period) as f64 / layout.frequency_hz + phase(sample) / layout.frequency_hz
    };
    let mut columns = named([
        ("time_s", ArrayValues::Numbers((0..count).map(time).collect())),
        ("phase_cycles", ArrayValues::Numbers((0..count).map(phase).collect())),
        ("displacement_m", strided(samples, 0, width)),
        ("velocity_m_s", strided(samples, 1, width)),
        ("acceleration_m_s2", strided(samples, 2, width)),
    ]);
    for (place, name) in layout.elements.iter().enumerate() {
        let name = crate::export::word(name);
        columns.push((format!("{name}_relative_displacement_m"), strided(samples, 3 + 2 * place, width)));
        columns.push((format!("{name}_force_n"), strided(samples, 4 + 2 * place, width)));
    }
    ArrayTable::new("samples", columns)
}

fn section_table(layout: &SimulationLayout, section: &[f64]) -> ArrayTable {
    let width = layout.numbers_of_section();
    let count = section.len() / width;
    let time =
        |period: usize| period as f64 / layout.frequency_hz + layout.section_phase / layout.frequency_hz;
    let states: Vec<f64> = section.chunks_exact(width).flat_map(|row| &row[2..]).copied().collect();
    ArrayTable::new(
        "stroboscopic",
        named([
            ("time_s", ArrayValues::Numbers((0..count).map(time).collect())),
            ("phase_cycles", ArrayValues::Numbers(vec![layout.section_phase; count])),
            ("displacement_m", strided(section, 0, width)),
            ("velocity_m_s", strided(section, 1, width)),
            ("state", ArrayValues::Vectors { width: width - 2, values: states }),
        ]),
    )
}

fn contact_table(layout: &SimulationLayout, contacts: &[SimulatedContact]) -> ArrayTable {
    let number = |of: &dyn Fn(&SimulatedContact) -> Option<f64>| {
        ArrayValues::Numbers(contacts.iter().map(|contact| or_nan(of(contact))).collect())
    };
    let name =
        |contact: &SimulatedContact| layout.elements.get(contact.element).cloned().unwrap_or_default().into();
    let touch = |contact: &SimulatedContact| contact.touch.clone();
    ArrayTable::new(
        "contacts",
        named([
            ("element", ArrayValues::Words(contacts.iter().map(name).collect())),
            ("begin_s", number(&|contact| Some(touch(contact)?.time_s))),
            ("end_s", number(&|contact| contact.end_s)),
            ("phase_cycles", number(&|contact| Some(touch(contact)?.phase))),
            ("impact_velocity_m_s", number(&|contact| Some(touch(contact)?.speed))),
            ("impulse_n_s", number(&|contact| Some(contact.impulse))),
            ("peak_force_n", number(&|contact| Some(contact.peak_force))),
            ("energy_lost_j", number(&|contact| Some(contact.energy_lost))),
            ("displacement_m", number(&|contact| Some(touch(contact)?.response[0]))),
            ("velocity_m_s", number(&|contact| Some(touch(contact)?.response[1]))),
        ]),
    )
}

/// Settled motions and their samples.
fn settled(motions: &[SettledMotion]) -> Vec<ArrayTable> {
    let number = |of: &dyn Fn(&SettledMotion) -> Option<f64>| {
        ArrayValues::Numbers(motions.iter().map(|motion| or_nan(of(motion))).collect())
    };
    let origin = motions.iter().map(|motion| motion.origin.to_string().into());
    let class = motions.iter().map(|motion| motion.point.class.name().into());
    let period = motions.iter().map(|motion| or_none(motion.point.class.period()));
    let sweep = ArrayTable::new(
        "sweep",
        named([
            ("from", ArrayValues::Words(origin.collect())),
            ("frequency_hz", number(&|motion| Some(motion.point.frequency_hz))),
            ("class", ArrayValues::Words(class.collect())),
            ("period", ArrayValues::Whole(period.collect())),
            ("max_abs_displacement_m", number(&|motion| Some(motion.point.max_abs_displacement))),
            ("contacts_per_period", number(&|motion| Some(motion.point.contacts_per_period))),
            ("largest_exponent_per_s", number(&|motion| Some(motion.point.largest_exponent?.value))),
            ("half_width_per_s", number(&|motion| Some(motion.point.largest_exponent?.half_width))),
            ("zero_one_k", number(&|motion| motion.point.zero_one)),
            ("branch", ArrayValues::Whole(vec![-1; motions.len()])),
        ]),
    );
    let each =
        || motions.iter().flat_map(|motion| motion.point.samples.iter().map(move |sample| (motion, *sample)));
    let samples = ArrayTable::new(
        "sweep_samples",
        named([
            (
                "from",
                ArrayValues::Words(each().map(|(motion, _)| motion.origin.to_string().into()).collect()),
            ),
            (
                "frequency_hz",
                ArrayValues::Numbers(each().map(|(motion, _)| motion.point.frequency_hz).collect()),
            ),
            (
                "class",
                ArrayValues::Words(each().map(|(motion, _)| motion.point.class.name().into()).collect()),
            ),
            ("displacement_m", ArrayValues::Numbers(each().map(|(_, sample)| sample).collect())),
        ]),
    );
    vec![sweep, samples]
}

/// Spectra of exponents, and their convergence.
fn exponents(records: &[ExponentRecord]) -> Vec<ArrayTable> {
    let number = |of: &dyn Fn(&ExponentRecord) -> Option<f64>| {
        ArrayValues::Numbers(records.iter().map(|record| or_nan(of(record))).collect())
    };
    let exponents: Vec<Vec<f64>> = records
        .iter()
        .map(|record| record.spectrum.exponents.iter().map(|one| one.value).collect())
        .collect();
    let widths: Vec<Vec<f64>> = records
        .iter()
        .map(|record| record.spectrum.exponents.iter().map(|one| one.half_width).collect())
        .collect();
    let spectra = ArrayTable::new(
        "spectra",
        named([
            ("frequency_hz", number(&|record| Some(record.frequency_hz))),
            ("exponents_per_s", ArrayValues::vectors(&exponents)),
            ("half_widths_per_s", ArrayValues::vectors(&widths)),
            ("sum_per_s", number(&|record| Some(record.spectrum.sum))),
            ("divergence_per_s", number(&|record| Some(record.divergence))),
            ("expected_sum_per_s", number(&|record| record.spectrum.expected_sum)),
            ("kaplan_yorke_dimension", number(&|record| Some(record.spectrum.kaplan_yorke_dimension))),
            ("block_correlation", number(&|record| Some(record.spectrum.block_correlation))),
            ("zero_one_k", number(&|record| record.zero_one)),
            ("time_s", number(&|record| Some(record.spectrum.time))),
        ]),
    );
    let places =
        || records.iter().flat_map(|record| record.spectrum.convergence.iter().map(move |at| (record, at)));
    let along: Vec<Vec<f64>> = places().map(|(_, at)| at.exponents.clone()).collect();
    let convergence = ArrayTable::new(
        "convergence",
        named([
            ("frequency_hz", ArrayValues::Numbers(places().map(|(record, _)| record.frequency_hz).collect())),
            ("time_s", ArrayValues::Numbers(places().map(|(_, at)| at.time).collect())),
            ("exponents_per_s", ArrayValues::vectors(&along)),
        ]),
    );
    let points =
        || records.iter().flat_map(|record| record.section.iter().map(move |point| (record, *point)));
    let section = ArrayTable::new(
        "section",
        named([
            ("frequency_hz", ArrayValues::Numbers(points().map(|(record, _)| record.frequency_hz).collect())),
            (
                "displacement_m",
                ArrayValues::Numbers(points().map(|(_, [displacement, _])| displacement).collect()),
            ),
            ("velocity_m_s", ArrayValues::Numbers(points().map(|(_, [_, velocity])| velocity).collect())),
        ]),
    );
    vec![spectra, convergence, section]
}
