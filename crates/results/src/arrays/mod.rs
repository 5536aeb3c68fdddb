//! Tables by columns, for programs that take arrays: NumPy, MATLAB, data frames.
//!
//! A [`ArrayTable`] holds what a table of the export holds, with numbers as numbers. From it follow records
//! in NumPy's layout, which Python takes as they are, and the files of `export` in NPZ and JSON.
//!
//! | file | what it does |
//! |---|---|
//! | `records.rs` | columns packed as records, and their NumPy file |
//! | `row_records.rs` | the rows of all branches as records, without columns in between |
//! | `npz.rs`, `json.rs`, `csv.rs` | tables as files |
//! | `branches.rs` | branches and curves, their events and ends, states and multipliers |
//! | `export.rs` | all tables of a folder, as files of a format |
//! | `motions.rs` | motions in time, settled motions, exponents, basins |

mod branches;
mod csv;
mod export;
mod json;
mod motions;
mod npz;
mod records;
mod row_records;

use std::borrow::Cow;

pub use branches::{branch_array, piece_arrays};
pub use csv::write_table;
pub use export::{TableFormat, all_tables, export_all, write_tables};
pub use json::write_json;
pub use motions::{motion_tables, request_tables};
pub use npz::write_npz;
pub use records::{Field, Layout, Records, pack};
pub use row_records::RowRecords;

/// The entries of a column, one for each row.
#[derive(Debug, Clone, PartialEq)]
pub enum ArrayValues {
    /// Numbers; NaN where there is none.
    Numbers(Vec<f64>),
    /// Whole numbers; -1 where there is none.
    Whole(Vec<i64>),
    /// Yes or no.
    Flags(Vec<bool>),
    /// Words.
    Words(Vec<Cow<'static, str>>),
    /// So many numbers in each row.
    Vectors {
        /// How many.
        width: usize,
        /// Row by row, NaN where there is none.
        values: Vec<f64>,
    },
    /// So many complex numbers in each row.
    Complex {
        /// How many.
        width: usize,
        /// `[re, im]`, row by row, NaN where there is none.
        values: Vec<[f64; 2]>,
    },
}

impl ArrayValues {
    /// Vectors of equal or different lengths, the shorter ones filled up with NaN.
    #[must_use]
    pub fn vectors(rows: &[Vec<f64>]) -> Self {
        let width = rows.iter().map(Vec::len).max().unwrap_or(0);
        Self::Vectors { width, values: filled(rows, width, f64::NAN) }
    }

    /// Complex vectors, filled up with NaN.
    #[must_use]
    pub fn complex(rows: &[Vec<[f64; 2]>]) -> Self {
        let width = rows.iter().map(Vec::len).max().unwrap_or(0);
        Self::Complex { width, values: filled(rows, width, [f64::NAN; 2]) }
    }

    /// Number of rows; of columns without width as many as the others have.
    fn rows(&self) -> Option<usize> {
        match self {
            Self::Numbers(values) => Some(values.len()),
            Self::Whole(values) => Some(values.len()),
            Self::Flags(values) => Some(values.len()),
            Self::Words(values) => Some(values.len()),
            Self::Vectors { width, values } => values.len().checked_div(*width),
            Self::Complex { width, values } => values.len().checked_div(*width),
        }
    }
}

fn filled<T: Copy>(rows: &[Vec<T>], width: usize, none: T) -> Vec<T> {
    let mut values = Vec::with_capacity(rows.len() * width);
    for row in rows {
        values.extend_from_slice(row);
        values.extend(std::iter::repeat_n(none, width - row.len()));
    }
    values
}

/// A column with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct ArrayColumn {
    /// Name, with the unit at its end.
    pub name: String,
    /// One entry for each row.
    pub values: ArrayValues,
}

/// A table by columns of one length.
#[derive(Debug, Clone, PartialEq)]
pub struct ArrayTable {
    /// Name of the table, that of its CSV file without `.csv`.
    pub name: String,
    /// The columns.
    pub columns: Vec<ArrayColumn>,
}

impl ArrayTable {
    /// A table of columns of one length.
    ///
    /// # Panics
    /// The lengths differ.
    #[must_use]
    pub fn new(name: impl Into<String>, columns: Vec<(String, ArrayValues)>) -> Self {
        let columns: Vec<ArrayColumn> =
            columns.into_iter().map(|(name, values)| ArrayColumn { name, values }).collect();
        let mut lengths = columns.iter().filter_map(|column| column.values.rows());
        let first = lengths.next().unwrap_or(0);
        assert!(lengths.all(|length| length == first), "columns of a table have one length");
        Self { name: name.into(), columns }
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.iter().find_map(|column| column.values.rows()).unwrap_or(0)
    }
}

/// Columns from names that are known.
pub(crate) fn named<const N: usize>(columns: [(&str, ArrayValues); N]) -> Vec<(String, ArrayValues)> {
    columns.into_iter().map(|(name, values)| (name.to_owned(), values)).collect()
}

/// A number that may not be there.
pub(crate) fn or_nan(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}

/// A whole number that may not be there.
pub(crate) fn or_none(value: Option<impl TryInto<i64>>) -> i64 {
    value.and_then(|value| value.try_into().ok()).unwrap_or(-1)
}
