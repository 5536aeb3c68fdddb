//! Stored results as CSV for other programs: branches and events here, the rest in files of their own.

mod ends;
mod events;
mod motions;
mod simulation;
mod states;
mod table;
mod varied;

use std::{
    io::{self, Write},
    path::{Path, PathBuf},
};

pub use ends::{END_COLUMNS, PARAMETER_END_COLUMNS};
pub use events::{EVENT_COLUMNS, PARAMETER_EVENT_COLUMNS};
pub use motions::{write_basins, write_exponents, write_sweep};
pub use simulation::SimulationTables;
pub use states::{PARAMETER_STATE_COLUMNS, STATE_COLUMNS};
pub use table::{Table, header, number, word};

pub(crate) use ends::entries;
pub(crate) use events::complex_numbers;
pub(crate) use motions::grid;
pub(crate) use table::quoted;

use ends::write_ends;
use events::write_events;
use motions::export_motions;
use states::write_states;
use varied::{export_varied, export_varied_states};

use crate::{
    store::{BranchRecord, Row, Store, StoreError},
    whole_file::{WholeFile, WriteError},
};

/// Columns of `branches.csv`; the first twelve are fixed, further ones follow after them.
pub const COLUMNS: [&str; 15] = [
    "branch",
    "period_multiple",
    "frequency_hz",
    "max_abs_displacement_m",
    "max_abs_acceleration_m_s2",
    "max_contact_force_n",
    "max_impact_velocity_m_s",
    "contacts",
    "leading_multiplier_re",
    "leading_multiplier_im",
    "stable",
    "event",
    "impulse_n_s",
    "residual",
    "error_estimate",
];

/// Why results could not be exported.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The store refuses.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// What was exported.
#[derive(Debug, Clone, PartialEq)]
pub struct Exported {
    /// The branches.
    pub path: PathBuf,
    /// Number of their rows, without the header.
    pub rows: u64,
    /// The events.
    pub events_path: PathBuf,
    /// How branches ended.
    pub ends_path: PathBuf,
    /// `parameter_branches.csv`, `parameter_events.csv` and `parameter_ends.csv`, `curves.csv` and
    /// `curve_ends.csv`, where the study asks for them.
    pub varied_paths: Vec<PathBuf>,
    /// Tables of motions, sweeps, exponents and basins, with the numbers of their requests.
    pub motion_paths: Vec<PathBuf>,
}

/// Writes `branches.csv`, one row per solution, end to end along each branch, `events.csv`, one row per
/// event, and `ends.csv`, one row per end of a branch, into a folder.
///
/// Numbers are the shortest that read back to the same double. The files appear complete or not at all.
///
/// # Errors
/// [`ExportError`].
pub fn export_csv(store: &Store, folder: &Path) -> Result<Exported, ExportError> {
    let snapshot = store.snapshot()?;
    let path = folder.join("branches.csv");
    let rows = write_whole(&path, |writer| write_csv(store, writer, &path))?;
    let events_path = folder.join("events.csv");
    write_whole(&events_path, |writer| write_events(store, writer, &events_path))?;
    let ends_path = folder.join("ends.csv");
    write_whole(&ends_path, |writer| write_ends(store, writer, &ends_path))?;
    let varied_paths = export_varied(store, folder)?;
    let motion_paths = export_motions(store, folder)?;
    drop(snapshot);
    Ok(Exported { path, rows, events_path, ends_path, varied_paths, motion_paths })
}

/// Writes `states.csv` into a folder, and `parameter_states.csv` and `curve_states.csv` where there are such
/// branches and curves: the state and all multipliers of every solution, which take several times the room of
/// the rest.
///
/// # Returns
/// The files.
/// # Errors
/// [`ExportError`].
pub fn export_states(store: &Store, folder: &Path) -> Result<Vec<PathBuf>, ExportError> {
    let snapshot = store.snapshot()?;
    let path = folder.join("states.csv");
    write_whole(&path, |writer| write_states(store, writer, &path))?;
    let mut paths = vec![path];
    paths.extend(export_varied_states(store, folder)?);
    drop(snapshot);
    Ok(paths)
}

/// Writes a file that appears complete or not at all.
pub(crate) fn write_whole<T>(
    path: &Path,
    write: impl FnOnce(&mut WholeFile) -> Result<T, ExportError>,
) -> Result<T, ExportError> {
    let mut file = WholeFile::begin(path)?;
    let written = write(&mut file)?;
    file.finish()?;
    Ok(written)
}

fn write_csv(store: &Store, writer: &mut impl Write, path: &Path) -> Result<u64, ExportError> {
    let failed = |source| ExportError::from(WriteError { path: path.to_owned(), source });
    writeln!(writer, "{}", COLUMNS.join(",")).map_err(failed)?;
    let mut count = 0;
    for branch in store.branches()? {
        store.each_row::<ExportError>(&branch, |row| {
            count += 1;
            write_row(writer, &branch, &row).map_err(failed)
        })?;
    }
    Ok(count)
}

fn write_row(writer: &mut impl Write, branch: &BranchRecord, row: &Row) -> io::Result<()> {
    let maxima = &row.maxima;
    let [re, im] = row.leading_multiplier;
    writeln!(
        writer,
        "{},{},{:?},{:?},{:?},{:?},{:?},{},{:?},{:?},{},{},{:?},{:?},{:?}",
        branch.id,
        branch.period_multiple,
        row.frequency_hz,
        maxima.displacement,
        maxima.acceleration,
        maxima.contact_force,
        maxima.impact_velocity,
        maxima.contacts,
        re,
        im,
        row.stability.column(),
        row.events.label(),
        maxima.impulse,
        row.residual,
        row.error_estimate,
    )
}
