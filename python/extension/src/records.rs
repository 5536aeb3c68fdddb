//! Tables as bytes that NumPy takes as they are.

use hammerbeam::results::arrays::{ArrayTable, pack};
use pyo3::{prelude::*, types::PyByteArray};

/// Name, fields (name, type, length of a vector), number of rows, and the packed rows.
pub type PackedTable<'py> = (String, Vec<(String, String, Option<usize>)>, usize, Bound<'py, PyByteArray>);

/// A table for Python.
pub fn packed<'py>(py: Python<'py>, table: &ArrayTable) -> PackedTable<'py> {
    let records = py.detach(|| pack(table));
    (table.name.clone(), records.fields, records.rows, PyByteArray::new(py, &records.bytes))
}

/// Several tables for Python.
pub fn all_packed<'py>(py: Python<'py>, tables: &[ArrayTable]) -> Vec<PackedTable<'py>> {
    tables.iter().map(|table| packed(py, table)).collect()
}
