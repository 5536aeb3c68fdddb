//! Symmetric sparse matrices: the lower triangle, column by column.

use faer::{Mat, MatRef};

/// An entry of a matrix, rows and columns from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Row.
    pub row: u32,
    /// Column.
    pub column: u32,
    /// Value.
    pub value: f64,
}

/// A symmetric matrix that keeps its lower triangle: 12 bytes an entry.
#[derive(Debug, Clone, PartialEq)]
pub struct SymmetricMatrix {
    /// Where each column begins in `rows` and `values`; one more than there are columns.
    starts: Vec<usize>,
    /// Rows of the entries, ascending within a column, none above the diagonal.
    rows: Vec<u32>,
    values: Vec<f64>,
}

impl SymmetricMatrix {
    /// The matrix of entries of one triangle: those of the other one are mirrored, those of one place are
    /// added up, zeros are left out.
    ///
    /// * `entries`: rows and columns below `size`, in any order; each pair of mirrored entries once.
    ///
    /// # Panics
    /// An entry lies outside.
    #[must_use]
    pub fn from_entries(size: usize, entries: &[Entry]) -> Self {
        let mut starts = vec![0_usize; size + 1];
        let stored = || entries.iter().filter(|entry| entry.value != 0.0);
        for entry in stored() {
            assert!((entry.row.max(entry.column) as usize) < size, "an entry lies outside of the matrix");
            starts[entry.row.min(entry.column) as usize + 1] += 1;
        }
        for column in 0..size {
            starts[column + 1] += starts[column];
        }
        let mut next = starts.clone();
        let (mut rows, mut values) = (vec![0_u32; starts[size]], vec![0.0; starts[size]]);
        for entry in stored() {
            let place = &mut next[entry.row.min(entry.column) as usize];
            (rows[*place], values[*place]) = (entry.row.max(entry.column), entry.value);
            *place += 1;
        }
        drop(next);
        Self { starts, rows, values }.tidied()
    }

    /// The same with rows ascending and each place once.
    fn tidied(mut self) -> Self {
        let (mut kept, mut column_of_entries) = (0, Vec::new());
        for column in 0..self.size() {
            let range = self.starts[column]..self.starts[column + 1];
            self.starts[column] = kept;
            column_of_entries.clear();
            column_of_entries.extend(range.map(|place| (self.rows[place], self.values[place])));
            column_of_entries.sort_by_key(|&(row, _)| row);
            let first = kept;
            for &(row, value) in &column_of_entries {
                if kept > first && self.rows[kept - 1] == row {
                    self.values[kept - 1] += value;
                } else {
                    (self.rows[kept], self.values[kept]) = (row, value);
                    kept += 1;
                }
            }
        }
        let size = self.size();
        self.starts[size] = kept;
        self.rows.truncate(kept);
        self.values.truncate(kept);
        self
    }

    /// Number of rows.
    #[must_use]
    pub fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of stored entries, those of one triangle.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.rows.len()
    }

    /// Memory that it takes [bytes].
    pub(super) fn bytes(&self) -> u64 {
        (size_of::<usize>() * self.starts.len() + 12 * self.values.len()) as u64
    }

    /// The entries of a column on and below the diagonal, as row and value.
    pub fn column(&self, column: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.starts[column]..self.starts[column + 1];
        range.map(|place| (self.rows[place] as usize, self.values[place]))
    }

    /// All stored entries as row, column and value, column by column.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        (0..self.size()).flat_map(|column| self.column(column).map(move |(row, value)| (row, column, value)))
    }

    /// The diagonal.
    #[must_use]
    pub fn diagonal(&self) -> Vec<f64> {
        let entry = |column| self.column(column).next().filter(|(row, _)| *row == column);
        (0..self.size()).map(|column| entry(column).map_or(0.0, |(_, value)| value)).collect()
    }

    /// The matrix times a factor.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.values.iter_mut().for_each(|value| *value *= factor);
        self
    }

    /// The product with a vector.
    #[must_use]
    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.size()];
        for column in 0..self.size() {
            let (factor, mut sum) = (vector[column], 0.0);
            for (row, value) in self.column(column) {
                if row == column {
                    sum += value * factor;
                } else {
                    sum += value * vector[row];
                    product[row] += value * factor;
                }
            }
            product[column] += sum;
        }
        product
    }

    /// The product with each column of a dense matrix.
    #[must_use]
    pub fn times_columns(&self, columns: MatRef<'_, f64>) -> Mat<f64> {
        let mut product = Mat::zeros(self.size(), columns.ncols());
        for column in 0..columns.ncols() {
            let vector: Vec<f64> = columns.col(column).iter().copied().collect();
            let answer = self.times(&vector);
            product.col_mut(column).iter_mut().zip(answer).for_each(|(to, from)| *to = from);
        }
        product
    }

    /// `|x|^T |A| |x|`: what rounding of every entry in one part of it can change in `x^T A x`.
    #[must_use]
    pub fn absolute_form(&self, vector: &[f64]) -> f64 {
        let term = |(row, column, value): (usize, usize, f64)| {
            let twice = if row == column { 1.0 } else { 2.0 };
            twice * (vector[row] * value * vector[column]).abs()
        };
        self.entries().map(term).sum()
    }

    /// The matrix in full.
    #[must_use]
    pub fn dense(&self) -> Mat<f64> {
        let mut dense = Mat::zeros(self.size(), self.size());
        for (row, column, value) in self.entries() {
            (dense[(row, column)], dense[(column, row)]) = (value, value);
        }
        dense
    }

    /// Whether each row has an entry that is not zero.
    #[must_use]
    pub fn occupied(&self) -> Vec<bool> {
        let mut occupied = vec![false; self.size()];
        for (row, column, value) in self.entries() {
            if value != 0.0 {
                (occupied[row], occupied[column]) = (true, true);
            }
        }
        occupied
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(row: u32, column: u32, value: f64) -> Entry {
        Entry { row, column, value }
    }

    #[test]
    fn entries_in_any_order_of_either_triangle_make_the_matrix() {
        let entries =
            [entry(2, 1, 5.0), entry(0, 2, 3.0), entry(1, 1, 2.0), entry(1, 1, 0.5), entry(0, 0, 0.0)];
        let matrix = SymmetricMatrix::from_entries(3, &entries);
        assert_eq!(matrix.entries().collect::<Vec<_>>(), [(2, 0, 3.0), (1, 1, 2.5), (2, 1, 5.0)]);
        assert_eq!(matrix.times(&[1.0, 2.0, 4.0]), [12.0, 25.0, 13.0]);
        assert_eq!(matrix.diagonal(), [0.0, 2.5, 0.0]);
        assert_eq!(matrix.absolute_form(&[1.0, -2.0, 4.0]), 2.0 * 12.0 + 10.0 + 2.0 * 40.0);
        let dense = matrix.dense();
        assert_eq!((dense[(0, 2)], dense[(2, 0)]), (3.0, 3.0));
    }
}
