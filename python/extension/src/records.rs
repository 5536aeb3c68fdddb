//! Tables as records of NumPy.

use hammerbeam::results::arrays::{ArrayTable, Layout};
use pyo3::{buffer::PyBuffer, prelude::*, types::PySlice};

/// Name, fields (name, type, length of a vector), number of rows, and the packed rows: an array of bytes.
pub type PackedTable<'py> = (String, Vec<(String, String, Option<usize>)>, usize, Bound<'py, PyAny>);

/// Records that are packed at a time, so that they stay in the cache until they are copied.
const BLOCK: usize = 4096;

/// A table for Python, in memory of NumPy, which asks the system for large pages: with small ones the system
/// would take longer to hand out the memory than it takes to fill it.
pub fn packed<'py>(py: Python<'py>, table: &ArrayTable) -> PyResult<PackedTable<'py>> {
    let layout = py.detach(|| Layout::of(table));
    let (record, rows) = (layout.record(), layout.rows());
    let array = py.import("numpy")?.call_method1("empty", (record * rows, "u1"))?;
    let mut block = vec![0; record * BLOCK.min(rows)];
    for first in (0..rows).step_by(BLOCK) {
        let end = rows.min(first + BLOCK);
        let bytes = &mut block[..(end - first) * record];
        py.detach(|| layout.fill(first, bytes));
        let place = PySlice::new(py, (first * record) as isize, (end * record) as isize, 1);
        PyBuffer::<u8>::get(&array.get_item(place)?)?.copy_from_slice(py, bytes)?;
    }
    Ok((table.name.clone(), layout.fields(), rows, array))
}

/// Several tables for Python.
pub fn all_packed<'py>(py: Python<'py>, tables: &[ArrayTable]) -> PyResult<Vec<PackedTable<'py>>> {
    tables.iter().map(|table| packed(py, table)).collect()
}
