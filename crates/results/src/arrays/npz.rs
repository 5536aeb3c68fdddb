//! Tables as one NPZ file: a ZIP archive, not compressed, of one record array for each table.

use std::{
    io::{Cursor, Write},
    path::Path,
};

use zip::{CompressionMethod, ZipWriter, write::SimpleFileOptions};

use super::{ArrayTable, pack};
use crate::whole_file::{WriteError, replace};

/// Writes tables as records, each under its name; `numpy.load` gives them back without `allow_pickle`.
///
/// # Errors
/// [`WriteError`]: the file cannot be written.
pub fn write_npz(tables: &[ArrayTable], path: &Path) -> Result<(), WriteError> {
    let failed = |source| WriteError { path: path.to_owned(), source };
    // In memory: the directory of an archive follows its files, and a whole file cannot be gone back in.
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .large_file(true)
        .last_modified_time(zip::DateTime::default());
    for table in tables {
        let records = pack(table);
        archive.start_file(format!("{}.npy", table.name), options).map_err(|error| failed(error.into()))?;
        archive
            .write_all(&records.npy_header())
            .and_then(|()| archive.write_all(&records.bytes))
            .map_err(failed)?;
    }
    let archive = archive.finish().map_err(|error| failed(error.into()))?;
    replace(path, archive.get_ref())
}
