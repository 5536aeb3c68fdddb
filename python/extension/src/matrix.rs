//! Matrices as files, and what else needs no study.

use std::{
    fs::File,
    io::{BufWriter, Write},
    path::PathBuf,
};

use pyo3::{exceptions::PyOSError, prelude::*, types::PyBytes};

/// Version of the package.
#[pyfunction]
pub fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// Writes a matrix in Matrix Market format, every entry as it is given.
///
/// * `rows`, `columns`: of each entry from 0 on, as 8-byte integers; `values`: as 8-byte floats.
#[pyfunction]
pub fn write_matrix(
    py: Python<'_>,
    path: PathBuf,
    size: (u64, u64),
    rows: &Bound<'_, PyBytes>,
    columns: &Bound<'_, PyBytes>,
    values: &Bound<'_, PyBytes>,
) -> PyResult<()> {
    let (rows, columns, values) = (rows.as_bytes(), columns.as_bytes(), values.as_bytes());
    let written = py.detach(|| -> std::io::Result<()> {
        let mut out = BufWriter::new(File::create(path)?);
        writeln!(out, "%%MatrixMarket matrix coordinate real general")?;
        writeln!(out, "{} {} {}", size.0, size.1, values.len() / 8)?;
        let entries = rows.as_chunks().0.iter().zip(columns.as_chunks().0).zip(values.as_chunks().0);
        for ((row, column), value) in entries {
            let (row, column) = (i64::from_le_bytes(*row) + 1, i64::from_le_bytes(*column) + 1);
            writeln!(out, "{row} {column} {:e}", f64::from_le_bytes(*value))?;
        }
        out.flush()
    });
    written.map_err(|error| PyOSError::new_err(error.to_string()))
}
