//! Tables as records of NumPy.

use hammerbeam::{
    Store,
    results::{
        StoreError,
        arrays::{ArrayTable, Field, Layout, RowRecords},
    },
};
use pyo3::{buffer::PyBuffer, prelude::*, types::PySlice};

/// Name, fields, number of rows, and the packed rows: an array of bytes.
pub type PackedTable = (String, Vec<Field>, usize, Py<PyAny>);

/// Records that are packed at a time, so that they stay in the cache until they are copied.
const BLOCK: usize = 4096;

/// A table for Python, in memory of NumPy, which asks the system for large pages: with small ones the system
/// would take longer to hand out the memory than it takes to fill it.
pub fn packed(py: Python<'_>, table: &ArrayTable) -> PyResult<PackedTable> {
    let layout = py.detach(|| Layout::of(table));
    let (record, rows) = (layout.record(), layout.rows());
    let array = room(py, record * rows)?;
    let mut block = vec![0; record * BLOCK.min(rows)];
    for first in (0..rows).step_by(BLOCK) {
        let end = rows.min(first + BLOCK);
        let bytes = &mut block[..(end - first) * record];
        py.detach(|| layout.fill(first, bytes));
        put(py, &array, first * record, bytes)?;
    }
    Ok((table.name.clone(), layout.fields(), rows, array.unbind()))
}

/// The rows of branches over the frequency, packed as they are read. Called without the interpreter's lock,
/// which it takes for no longer than some thousand of them are copied.
pub fn packed_rows(store: &Store, branches: &[u32]) -> Result<PackedTable, NotPacked> {
    let records = RowRecords::of(store, branches)?;
    let (record, rows) = (records.record(), records.rows());
    let array = Python::attach(|py| room(py, record * rows).map(Bound::unbind))?;
    let mut first = 0;
    records.each_bytes::<NotPacked>(|bytes| {
        Python::attach(|py| put(py, array.bind(py), first, bytes))?;
        first += bytes.len();
        Ok(())
    })?;
    Ok((records.name().to_owned(), records.fields(), rows, array))
}

/// Why rows are not packed.
pub enum NotPacked {
    /// They cannot be read.
    Store(StoreError),
    /// Python has no room for them.
    Python(PyErr),
}

impl From<StoreError> for NotPacked {
    fn from(error: StoreError) -> Self {
        Self::Store(error)
    }
}

impl From<PyErr> for NotPacked {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

fn room(py: Python<'_>, bytes: usize) -> PyResult<Bound<'_, PyAny>> {
    py.import("numpy")?.call_method1("empty", (bytes, "u1"))
}

fn put(py: Python<'_>, array: &Bound<'_, PyAny>, first: usize, bytes: &[u8]) -> PyResult<()> {
    let place = PySlice::new(py, first as isize, (first + bytes.len()) as isize, 1);
    PyBuffer::<u8>::get(&array.get_item(place)?)?.copy_from_slice(py, bytes)
}

/// Several tables for Python.
pub fn all_packed(py: Python<'_>, tables: &[ArrayTable]) -> PyResult<Vec<PackedTable>> {
    tables.iter().map(|table| packed(py, table)).collect()
}
