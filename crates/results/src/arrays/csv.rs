//! A table as CSV: vectors as numbers with blanks between them, as in `ends.csv`.

use std::path::{Path, PathBuf};

use super::{ArrayTable, ArrayValues};
use crate::export::{ExportError, Table, complex_numbers, entries, quoted};

/// Writes a table into a folder, under its name.
///
/// # Errors
/// [`ExportError::Write`].
pub fn write_table(table: &ArrayTable, folder: &Path) -> Result<PathBuf, ExportError> {
    let header: Vec<String> = table.columns.iter().map(|column| quoted(&column.name)).collect();
    let mut file = Table::begin(folder, &format!("{}.csv", table.name), &header)?;
    for row in 0..table.rows() {
        let cells: Vec<String> = table.columns.iter().map(|column| cell(&column.values, row)).collect();
        file.row(&cells)?;
    }
    file.finish()
}

fn cell(values: &ArrayValues, row: usize) -> String {
    match values {
        ArrayValues::Numbers(values) if values[row].is_nan() => String::new(),
        ArrayValues::Numbers(values) => format!("{:?}", values[row]),
        ArrayValues::Whole(values) if values[row] < 0 => String::new(),
        ArrayValues::Whole(values) => values[row].to_string(),
        ArrayValues::Flags(values) => values[row].to_string(),
        ArrayValues::Words(words) => quoted(&words[row]),
        ArrayValues::Vectors { width, values } => entries(&values[row * width..(row + 1) * width]),
        ArrayValues::Complex { width, values } => complex_numbers(&values[row * width..(row + 1) * width]),
    }
}
