//! Motions that need not repeat as CSV: sweeps, exponents, basins; motions in time see `simulation.rs`.
//!
//! The commands write the tables of what they were asked; an export writes those of every request in the
//! store, with its number in their names.

use std::path::{Path, PathBuf};

use hammerbeam_attractor::{Attractor, Axis, Grid, fractions};

use super::{
    ExportError,
    simulation::export_simulation,
    table::{Table, header, number, optional},
};
use crate::store::{ExponentRecord, RequestKind, RequestRecord, SettledMotion, Store, StoreError};

/// Writes `sweep.csv`, one row per motion, and `sweep_samples.csv`, one per sample.
///
/// * `suffix`: follows the names of the files.
/// * `branches`: the branch each motion lies on, of the same length, or empty where that is not known.
///
/// # Errors
/// [`ExportError::Write`].
pub fn write_sweep(
    folder: &Path,
    suffix: &str,
    motions: &[SettledMotion],
    branches: &[Option<u32>],
) -> Result<Vec<PathBuf>, ExportError> {
    let columns = [
        "from",
        "frequency_hz",
        "class",
        "period",
        "max_abs_displacement_m",
        "contacts_per_period",
        "largest_exponent_per_s",
        "half_width_per_s",
        "zero_one_k",
        "branch",
    ];
    let mut table = Table::begin(folder, &format!("sweep{suffix}.csv"), &header(&columns))?;
    let columns = ["from", "frequency_hz", "class", "displacement_m"];
    let mut samples = Table::begin(folder, &format!("sweep_samples{suffix}.csv"), &header(&columns))?;
    for (index, SettledMotion { origin, point }) in motions.iter().enumerate() {
        let class = point.class.name().to_owned();
        table.row(&[
            origin.to_string(),
            number(point.frequency_hz),
            class.clone(),
            optional(point.class.period()),
            number(point.max_abs_displacement),
            number(point.contacts_per_period),
            number(point.largest_exponent.map(|exponent| exponent.value)),
            number(point.largest_exponent.map(|exponent| exponent.half_width)),
            number(point.zero_one),
            optional(branches.get(index).copied().flatten()),
        ])?;
        for sample in &point.samples {
            samples.row(&[origin.to_string(), number(point.frequency_hz), class.clone(), number(*sample)])?;
        }
    }
    Ok(vec![table.finish()?, samples.finish()?])
}

/// Writes `spectra.csv`, one row per frequency, `exponents.csv`, one per exponent, `convergence.csv`, one per
/// place of the convergence curves, and `section.csv`, one per point of the stroboscopic sections.
///
/// * `suffix`: follows the names of the files.
///
/// # Errors
/// [`ExportError::Write`].
pub fn write_exponents(
    folder: &Path,
    suffix: &str,
    records: &[ExponentRecord],
) -> Result<Vec<PathBuf>, ExportError> {
    let begin =
        |name: &str, columns: &[&str]| Table::begin(folder, &format!("{name}{suffix}.csv"), &header(columns));
    let mut spectra = begin("spectra", &SPECTRUM_COLUMNS)?;
    let mut exponents =
        begin("exponents", &["frequency_hz", "number", "exponent_per_s", "half_width_per_s"])?;
    let mut section = begin("section", &["frequency_hz", "displacement_m", "velocity_m_s"])?;
    let count = records.first().map_or(0, |record| record.spectrum.exponents.len());
    let mut columns = header(&["frequency_hz", "time_s"]);
    columns.extend((1..=count).map(|i| format!("exponent_{i}_per_s")));
    let mut convergence = Table::begin(folder, &format!("convergence{suffix}.csv"), &columns)?;
    for record in records {
        spectra.row(&spectrum_row(record))?;
        for (index, exponent) in record.spectrum.exponents.iter().enumerate() {
            exponents.row(&[
                number(record.frequency_hz),
                (index + 1).to_string(),
                number(exponent.value),
                number(exponent.half_width),
            ])?;
        }
        for place in &record.spectrum.convergence {
            let entries =
                [record.frequency_hz, place.time].into_iter().chain(place.exponents.iter().copied());
            convergence.row(&entries.map(number).collect::<Vec<_>>())?;
        }
        for [displacement, velocity] in &record.section {
            section.row(&[number(record.frequency_hz), number(*displacement), number(*velocity)])?;
        }
    }
    Ok(vec![spectra.finish()?, exponents.finish()?, convergence.finish()?, section.finish()?])
}

const SPECTRUM_COLUMNS: [&str; 11] = [
    "frequency_hz",
    "largest_exponent_per_s",
    "half_width_per_s",
    "sum_per_s",
    "divergence_per_s",
    "expected_sum_per_s",
    "kaplan_yorke_dimension",
    "block_correlation",
    "zero_one_k",
    "time_s",
    "sections_per_period",
];

fn spectrum_row(record: &ExponentRecord) -> [String; 11] {
    let spectrum = &record.spectrum;
    let largest = spectrum.exponents.first();
    [
        number(record.frequency_hz),
        number(largest.map(|exponent| exponent.value)),
        number(largest.map(|exponent| exponent.half_width)),
        number(spectrum.sum),
        number(record.divergence),
        number(spectrum.expected_sum),
        number(spectrum.kaplan_yorke_dimension),
        number(spectrum.block_correlation),
        number(record.zero_one),
        number(spectrum.time),
        record.sections_per_period.to_string(),
    ]
}

/// Writes `basins.csv`, one row per cell, and `attractors.csv`, one per attractor, with its first state
/// (modal displacements and velocities at phase 0).
///
/// * `suffix`: follows the names of the files.
/// * `cells`: number of the attractor of each cell of the grid, counted from 1; 0 where the motion cannot be
///   computed.
/// * `branches`: the branch each attractor lies on, of the same length, or empty where that is not known.
///
/// # Errors
/// [`ExportError::Write`].
pub fn write_basins(
    folder: &Path,
    suffix: &str,
    (grid, cells): (&Grid, &[u32]),
    attractors: &[Attractor],
    branches: &[Option<u32>],
) -> Result<Vec<PathBuf>, ExportError> {
    let mut table = Table::begin(folder, &format!("basins{suffix}.csv"), &header(&["x", "y", "attractor"]))?;
    for (cell, attractor) in cells.iter().enumerate() {
        let [x, y] = grid.place(cell);
        table.row(&[number(x), number(y), attractor.to_string()])?;
    }
    let mut columns = header(&[
        "attractor",
        "class",
        "period",
        "fraction",
        "standard_error",
        "largest_exponent_per_s",
        "zero_one_k",
        "branch",
    ]);
    let dof = attractors.first().map_or(0, |attractor| attractor.states[0].len() / 2);
    columns
        .extend(["q", "v"].into_iter().flat_map(|name| (1..=dof).map(move |mode| format!("{name}{mode}"))));
    let mut list = Table::begin(folder, &format!("attractors{suffix}.csv"), &columns)?;
    let shares = fractions(cells, attractors.len());
    for (index, (attractor, fraction)) in attractors.iter().zip(shares.into_iter().skip(1)).enumerate() {
        let mut row = vec![
            (index + 1).to_string(),
            attractor.class.name().to_owned(),
            optional(attractor.class.period()),
            number(fraction.value),
            number(fraction.half_width),
            number(attractor.largest_exponent.map(|exponent| exponent.value)),
            number(attractor.zero_one),
            optional(branches.get(index).copied().flatten()),
        ];
        row.extend(attractor.states[0].iter().map(|value| number(*value)));
        list.row(&row)?;
    }
    Ok(vec![table.finish()?, list.finish()?])
}

/// Writes the tables of every request in a store; branches are not named in them.
pub(super) fn export_motions(store: &Store, folder: &Path) -> Result<Vec<PathBuf>, ExportError> {
    let mut files = Vec::new();
    for request in store.requests()? {
        let suffix = format!("-{}", request.id);
        files.extend(match request.kind {
            RequestKind::Simulation => export_simulation(store, folder, (&request, &suffix))?,
            RequestKind::Sweep | RequestKind::Starts => {
                write_sweep(folder, &suffix, &store.settled(request.id)?, &[])?
            }
            RequestKind::Exponents => write_exponents(folder, &suffix, &store.exponents(request.id)?)?,
            RequestKind::Basins => {
                let (cells, attractors) = store.basins(request.id)?;
                write_basins(folder, &suffix, (&grid(&request)?, &cells), &attractors, &[])?
            }
        });
    }
    Ok(files)
}

/// The grid of a request, as far as its words say: where the cells lie, not what the coordinates are.
pub(crate) fn grid(request: &RequestRecord) -> Result<Grid, StoreError> {
    let value = |key: &str| {
        let found = request.word(key).unwrap_or_default();
        found
            .parse::<f64>()
            .map_err(|_| StoreError::Unknown { what: "grid of basins", found: found.to_owned() })
    };
    let axis = |name: &str| {
        let (low, high) = (value(&format!("{name}.low"))?, value(&format!("{name}.high"))?);
        Ok::<_, StoreError>(Axis { direction: Vec::new(), low, high, count: value("grid")? as usize })
    };
    Ok(Grid { base: Vec::new(), x: axis("x")?, y: axis("y")? })
}
