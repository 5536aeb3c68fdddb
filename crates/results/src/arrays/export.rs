//! Everything that a results folder holds, as files of a format.

use std::path::{Path, PathBuf};

use super::{ArrayTable, branch_array, motion_tables, piece_arrays, write_json, write_npz, write_table};
use crate::{
    export::{ExportError, TableLines, export_csv, export_states},
    store::{Store, StoreError, StoredOutputs},
    whole_file::ensure_written,
};

/// Format of exported tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableFormat {
    /// Comma-separated values, a file for each table.
    Csv,
    /// One JSON document, by columns.
    Json,
    /// One NPZ file of record arrays.
    Npz,
}

impl TableFormat {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Csv, Self::Json, Self::Npz];

    /// Its name, which is the last part of the names of its files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Json => "json",
            Self::Npz => "npz",
        }
    }
}

/// All tables of a results folder.
///
/// * `with_states`: also the state and all multipliers of every solution.
///
/// # Errors
/// [`StoreError`].
pub fn all_tables(store: &Store, with_states: bool) -> Result<Vec<ArrayTable>, StoreError> {
    let snapshot = store.snapshot()?;
    let mut lines = vec![TableLines::Rows, TableLines::Events, TableLines::Ends];
    lines.extend(with_states.then_some(TableLines::States));
    lines.extend((!StoredOutputs::of(store)?.outputs().is_empty()).then_some(TableLines::Outputs));
    let mut tables = Vec::new();
    for lines in &lines {
        tables.extend(branch_array(store, *lines, &[])?);
    }
    tables.extend(piece_arrays(store, &lines)?);
    tables.extend(motion_tables(store)?);
    drop(snapshot);
    Ok(tables)
}

/// Writes everything that a results folder holds.
///
/// # Returns
/// The files.
/// # Errors
/// [`ExportError`]; [`ExportError::Write`] also if a file was removed while later ones were written.
pub fn export_all(
    store: &Store,
    folder: &Path,
    format: TableFormat,
    with_states: bool,
) -> Result<Vec<PathBuf>, ExportError> {
    if format != TableFormat::Csv {
        return write_tables(&all_tables(store, with_states)?, folder, ("results", format));
    }
    let exported = export_csv(store, folder)?;
    let mut files = vec![exported.path, exported.events_path, exported.ends_path];
    files.extend(exported.varied_paths.into_iter().chain(exported.output_paths));
    files.extend(exported.motion_paths);
    if with_states {
        files.extend(export_states(store, folder)?);
    }
    ensure_written(Path::new(""), &files)?;
    Ok(files)
}

/// Writes tables.
///
/// * `name`: of the one file, in formats that have one.
///
/// # Returns
/// The files.
/// # Errors
/// [`ExportError::Write`], also if a file was removed while later ones were written.
pub fn write_tables(
    tables: &[ArrayTable],
    folder: &Path,
    (name, format): (&str, TableFormat),
) -> Result<Vec<PathBuf>, ExportError> {
    let path = folder.join(format!("{name}.{}", format.name()));
    let mut files = vec![path.clone()];
    match format {
        TableFormat::Csv => {
            files = tables.iter().map(|table| write_table(table, folder)).collect::<Result<_, _>>()?;
        }
        TableFormat::Json => write_json(tables, &path)?,
        TableFormat::Npz => write_npz(tables, &path)?,
    }
    ensure_written(Path::new(""), &files)?;
    Ok(files)
}
