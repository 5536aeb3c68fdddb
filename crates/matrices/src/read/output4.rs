//! Nastran OUTPUT4: what text and binary files have in common.
//!
//! A file is a sequence of matrices; each is a header, its columns, and a column beyond the last one. A
//! column is dense (a first row and the values from there), or strings of values with their own first rows:
//! with one word `65536 (length + 1) + row` before each string, or, if the number of rows is written as a
//! negative one (BIGMAT), with two words, `length + 1` and row. Lengths count words of 4 bytes: a double
//! value has two of them (in files of 8 byte words one).
//!
//! Form 6 is symmetric, with both triangles; 1 is square; others are rectangular. Types 1 and 2 are real
//! numbers of 4 and 8 bytes, 3 and 4 complex ones, which are passed over.
//!
//! # Source
//! MSC Nastran DMAP Programmer's Guide, "OUTPUT4"; what its editions leave open is as in files of MSC and NX
//! Nastran.

use hammerbeam_structure::Entry;

use crate::{
    error::{FilePlace, MatrixFault},
    matrix::{FileMatrix, MOST_ROWS},
};

/// A matrix that is being read.
pub(crate) struct Output4Matrix {
    name: String,
    rows: usize,
    columns: usize,
    kind: i64,
    /// Strings have two words before them.
    pub big: bool,
    entries: Vec<Entry>,
    place: FilePlace,
}

impl Output4Matrix {
    /// A matrix by the numbers of its header.
    pub fn new(
        name: &str,
        [columns, rows, _, kind]: [i64; 4],
        place: FilePlace,
    ) -> Result<Self, MatrixFault> {
        let most = MOST_ROWS as i64;
        let checked = |what, found: i64| match found.checked_abs() {
            Some(size) if size <= most => Ok(size as usize),
            _ => Err(MatrixFault::OutOfRange { what, found, allowed: format!("0 to {most}") }),
        };
        if columns < 0 {
            let allowed = format!("0 to {most}");
            return Err(MatrixFault::OutOfRange { what: "the number of columns", found: columns, allowed });
        }
        if !(1..=4).contains(&kind) {
            let allowed = "1 to 4".to_owned();
            return Err(MatrixFault::OutOfRange { what: "the type of a matrix", found: kind, allowed });
        }
        Ok(Self {
            name: name.trim().to_owned(),
            rows: checked("the number of rows", rows)?,
            columns: checked("the number of columns", columns)?,
            kind,
            big: rows < 0,
            entries: Vec::new(),
            place,
        })
    }

    /// Whether a value is two numbers.
    pub fn is_complex(&self) -> bool {
        self.kind > 2
    }

    /// Whether a number is one of 8 bytes.
    pub fn is_double(&self) -> bool {
        self.kind % 2 == 0
    }

    /// Numbers of a value: 1, or 2 of a complex one.
    pub fn parts(&self) -> usize {
        1 + usize::from(self.is_complex())
    }

    /// A column from 0; `None` for the one that ends the matrix.
    pub fn column(&self, number: i64) -> Result<Option<u32>, MatrixFault> {
        let last = self.columns as i64 + 1;
        match number {
            _ if number == last => Ok(None),
            _ if number >= 1 && number < last => Ok(Some((number - 1) as u32)),
            found => {
                Err(MatrixFault::OutOfRange { what: "a column", found, allowed: format!("1 to {last}") })
            }
        }
    }

    /// Checks the first row of a string of values.
    ///
    /// # Returns
    /// The row from 0.
    pub fn string(&self, row: i64, values: i64) -> Result<u32, MatrixFault> {
        let room = self.rows as i64;
        if !(1..=room).contains(&row) {
            return Err(MatrixFault::OutOfRange {
                what: "a row",
                found: row,
                allowed: format!("1 to {room}"),
            });
        }
        if values < 0 || values > room - row + 1 {
            let allowed = format!("0 to {}", room - row + 1);
            return Err(MatrixFault::OutOfRange { what: "the length of a string", found: values, allowed });
        }
        Ok((row - 1) as u32)
    }

    /// Takes a value; of a complex matrix nothing is kept.
    pub fn push(&mut self, row: u32, column: u32, value: f64) -> Result<(), MatrixFault> {
        if !value.is_finite() {
            return Err(MatrixFault::NotFinite { what: "an entry", found: value });
        }
        if value != 0.0 && !self.is_complex() {
            self.entries.push(Entry { row, column, value });
        }
        Ok(())
    }

    /// The matrix, if it is real.
    pub fn finished(self, precision: f64) -> Option<FileMatrix> {
        let precision =
            if self.is_double() { precision } else { precision.max(0.5 * f64::from(f32::EPSILON)) };
        (!self.is_complex()).then_some(FileMatrix {
            name: self.name,
            rows: self.rows,
            columns: self.columns,
            entries: self.entries,
            one_triangle: false,
            is_sized: true,
            precision,
            labels: Vec::new(),
            place: self.place,
        })
    }
}
