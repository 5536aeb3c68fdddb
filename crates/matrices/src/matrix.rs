//! A matrix as a file gives it, and its symmetric form.

use hammerbeam_structure::{Entry, RowLabel, SymmetricMatrix};

use crate::error::{FilePlace, MatrixFault, PlacedFault};

/// Most rows of a matrix.
pub const MOST_ROWS: u64 = 20_000_000;
/// Mirrored entries may differ by this part of `sqrt(a_ii a_jj)` and of themselves.
const SYMMETRIC: f64 = 1e-6;

/// A matrix of a file, real, in entries.
#[derive(Debug, Clone, PartialEq)]
pub struct FileMatrix {
    /// Name in the file; empty where the format has none.
    pub name: String,
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// Entries in the order of the file.
    pub entries: Vec<Entry>,
    /// Whether the file says that it gives one triangle of a symmetric matrix.
    pub one_triangle: bool,
    /// Whether the file says how many rows there are, as opposed to the last entry.
    pub is_sized: bool,
    /// Relative error to which entries are written: half a unit in their last digit.
    pub precision: f64,
    /// What the rows are, where the file says so; else empty.
    pub labels: Vec<RowLabel>,
    /// Where the matrix begins in the file.
    pub place: FilePlace,
}

impl FileMatrix {
    /// The symmetric matrix: of a file with both triangles their mean.
    ///
    /// # Errors
    /// It is not square, or mirrored entries differ.
    pub(crate) fn symmetric(&self) -> Result<SymmetricMatrix, PlacedFault> {
        if self.rows != self.columns {
            let (rows, columns) = (self.rows as u64, self.columns as u64);
            return Err(MatrixFault::NotSquare { name: self.name.clone(), rows, columns }.at(self.place));
        }
        let above = self.entries.iter().any(|entry| entry.row < entry.column);
        let below = self.entries.iter().any(|entry| entry.row > entry.column);
        if self.one_triangle || !(above && below) {
            return Ok(SymmetricMatrix::from_entries(self.rows, &self.entries));
        }
        let of = |keep: fn(&Entry) -> bool| {
            let kept: Vec<Entry> = self.entries.iter().filter(|entry| keep(entry)).copied().collect();
            SymmetricMatrix::from_entries(self.rows, &kept)
        };
        let lower = of(|entry| entry.row >= entry.column);
        let upper = of(|entry| entry.row <= entry.column);
        // Entries of either triangle, each pair once, are a matrix, too.
        let mirrored = self.common_places(&lower, &upper);
        if mirrored == 0 {
            return Ok(SymmetricMatrix::from_entries(self.rows, &self.entries));
        }
        self.mean(&lower, &upper)
    }

    /// Number of places beside the diagonal that both have.
    fn common_places(&self, lower: &SymmetricMatrix, upper: &SymmetricMatrix) -> usize {
        let in_column = |column: usize| {
            let mut other = upper.column(column).peekable();
            lower.column(column).filter(move |&(row, _)| {
                if row == column {
                    return false;
                }
                while other.peek().is_some_and(|(place, _)| *place < row) {
                    other.next();
                }
                other.peek().is_some_and(|(place, _)| *place == row)
            })
        };
        (0..self.rows).map(|column| in_column(column).count()).sum()
    }

    fn mean(&self, lower: &SymmetricMatrix, upper: &SymmetricMatrix) -> Result<SymmetricMatrix, PlacedFault> {
        let diagonal: Vec<f64> = lower.diagonal().iter().map(|entry| entry.abs().sqrt()).collect();
        let differ = |row: usize, column: usize, below: f64, above: f64| {
            let allowed = SYMMETRIC * (diagonal[row] * diagonal[column]).max(below.abs()).max(above.abs());
            (below - above).abs() > allowed
        };
        let mut entries = Vec::with_capacity(lower.stored());
        for column in 0..self.rows {
            let (mut below, mut above) = (lower.column(column).peekable(), upper.column(column).peekable());
            while let Some(row) = below.peek().into_iter().chain(above.peek()).map(|(row, _)| *row).min() {
                let value = below.next_if(|(place, _)| *place == row).map_or(0.0, |(_, value)| value);
                let mirrored = above.next_if(|(place, _)| *place == row).map_or(0.0, |(_, value)| value);
                if differ(row, column, value, mirrored) {
                    let name =
                        if self.name.is_empty() { "of the file".to_owned() } else { self.name.clone() };
                    let (row, column) = (row as u64 + 1, column as u64 + 1);
                    let fault = MatrixFault::NotSymmetric { name, row, column, value, mirrored };
                    return Err(fault.at(self.place));
                }
                let value = 0.5 * (value + mirrored);
                entries.push(Entry { row: row as u32, column: column as u32, value });
            }
        }
        Ok(SymmetricMatrix::from_entries(self.rows, &entries))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(entries: &[(u32, u32, f64)]) -> FileMatrix {
        let entry = |&(row, column, value): &(u32, u32, f64)| Entry { row, column, value };
        FileMatrix {
            name: "K".into(),
            rows: 3,
            columns: 3,
            entries: entries.iter().map(entry).collect(),
            one_triangle: false,
            is_sized: true,
            precision: 1e-16,
            labels: Vec::new(),
            place: FilePlace::Whole,
        }
    }

    #[test]
    fn one_triangle_either_one_both_and_each_pair_once_are_the_same() {
        let diagonal = [(0, 0, 4.0), (1, 1, 5.0), (2, 2, 6.0)];
        let of = |more: &[(u32, u32, f64)]| matrix(&[&diagonal[..], more].concat()).symmetric().unwrap();
        let lower = of(&[(1, 0, 2.0), (2, 1, 3.0)]);
        assert_eq!(of(&[(0, 1, 2.0), (1, 2, 3.0)]), lower);
        assert_eq!(of(&[(0, 1, 2.0), (1, 0, 2.0), (1, 2, 3.0), (2, 1, 3.0)]), lower);
        assert_eq!(of(&[(0, 1, 2.0), (2, 1, 3.0)]), lower);
    }

    #[test]
    fn mirrored_entries_that_differ_are_named() {
        let entries = [(0, 0, 4.0), (1, 1, 5.0), (0, 1, 2.0), (1, 0, 2.1), (2, 1, 3.0), (1, 2, 3.0)];
        let fault = matrix(&entries).symmetric().unwrap_err().fault.to_string();
        assert!(fault.contains("row 2, column 1 is 2.1e0, and mirrored 2e0"), "{fault}");
    }
}
