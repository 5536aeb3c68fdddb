//! Stored branches as CSV for other programs.

use std::{
    fs::{self, File},
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
};

use crate::store::{BranchRecord, Row, Store, StoreError};

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
    #[error("cannot write {}: {source}", path.display())]
    #[expect(missing_docs, reason = "the message names its fields")]
    Write { path: PathBuf, source: io::Error },
}

/// What was exported.
#[derive(Debug, Clone, PartialEq)]
pub struct Exported {
    /// The file.
    pub path: PathBuf,
    /// Number of rows, without the header.
    pub rows: u64,
}

/// Writes `branches.csv` into a folder: one row per solution, end to end along each branch.
///
/// Numbers are the shortest that read back to the same double. The file appears complete or not at all.
///
/// # Errors
/// [`ExportError`].
pub fn export_csv(store: &Store, folder: &Path) -> Result<Exported, ExportError> {
    let path = folder.join("branches.csv");
    let unfinished = folder.join(".branches.csv.part");
    let failed = |source| ExportError::Write { path: path.clone(), source };
    fs::create_dir_all(folder).map_err(failed)?;
    let mut writer = BufWriter::new(File::create(&unfinished).map_err(failed)?);
    let rows = write_csv(store, &mut writer, &path)?;
    writer.flush().map_err(failed)?;
    fs::rename(&unfinished, &path).map_err(failed)?;
    Ok(Exported { path, rows })
}

fn write_csv(store: &Store, writer: &mut impl Write, path: &Path) -> Result<u64, ExportError> {
    let failed = |source| ExportError::Write { path: path.to_owned(), source };
    let snapshot = store.snapshot()?;
    writeln!(writer, "{}", COLUMNS.join(",")).map_err(failed)?;
    let mut count = 0;
    for branch in store.branches()? {
        store.each_row::<ExportError>(&branch, |row| {
            count += 1;
            write_row(writer, &branch, &row).map_err(failed)
        })?;
    }
    drop(snapshot);
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
        row.stable,
        row.events.label(),
        maxima.impulse,
        row.residual,
        row.error_estimate,
    )
}
