//! Maps between sets of coordinates, `y = T x`: selecting, joining and eliminating coordinates.

use super::{Entry, SymmetricMatrix};

/// A sparse matrix `T` row by row: each coordinate y as a weighted sum of the coordinates x.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CoordinateMap {
    starts: Vec<usize>,
    terms: Vec<(u32, f64)>,
    columns: usize,
}

impl CoordinateMap {
    /// A map of `columns` coordinates x; rows follow by [`CoordinateMap::push`].
    pub fn new(columns: usize) -> Self {
        Self { starts: vec![0], terms: Vec::new(), columns }
    }

    /// The map that selects some of `size` coordinates: all others are zero.
    pub fn selecting(size: usize, selected: &[usize]) -> Self {
        let mut place = vec![None; size];
        selected.iter().enumerate().for_each(|(column, &row)| place[row] = Some(column));
        let mut map = Self::new(selected.len());
        for column in place {
            map.push(column.map(|column| (column, 1.0)));
        }
        map
    }

    /// Adds a row.
    pub fn push(&mut self, terms: impl IntoIterator<Item = (usize, f64)>) {
        self.terms.extend(terms.into_iter().map(|(column, weight)| (column as u32, weight)));
        self.starts.push(self.terms.len());
    }

    /// Number of coordinates y.
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of coordinates x.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The terms of a row.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + Clone {
        self.terms[self.starts[row]..self.starts[row + 1]]
            .iter()
            .map(|&(column, weight)| (column as usize, weight))
    }

    /// `T^T A T`.
    pub fn congruence(&self, matrix: &SymmetricMatrix) -> SymmetricMatrix {
        let mut entries: Vec<Entry> = Vec::with_capacity(matrix.stored());
        for (row, column, value) in matrix.entries() {
            for (a, weight_a) in self.row(row) {
                for (b, weight_b) in self.row(column) {
                    let product = value * weight_a * weight_b;
                    // Of the pairs of a diagonal entry both orders come, of the others one.
                    let twice = if row != column && a == b { 2.0 } else { 1.0 };
                    if row != column || a >= b {
                        entries.push(Entry { row: a as u32, column: b as u32, value: twice * product });
                    }
                }
            }
        }
        SymmetricMatrix::from_entries(self.columns, &entries)
    }

    /// `T^T w` of a weighted sum of coordinates y, terms with the same coordinate x added up.
    pub fn pulled_back(&self, weights: &[(usize, f64)]) -> Vec<(usize, f64)> {
        let mut sums: std::collections::BTreeMap<usize, f64> = std::collections::BTreeMap::new();
        for &(row, weight) in weights {
            for (column, factor) in self.row(row) {
                *sums.entry(column).or_default() += weight * factor;
            }
        }
        sums.into_iter().filter(|(_, weight)| *weight != 0.0).collect()
    }
}

#[cfg(test)]
mod tests {
    use faer::Mat;

    use super::*;

    #[test]
    fn congruence_is_the_triple_product() {
        let entry = |row, column, value| Entry { row, column, value };
        let matrix = SymmetricMatrix::from_entries(
            3,
            &[entry(0, 0, 2.0), entry(1, 0, -1.0), entry(1, 1, 3.0), entry(2, 1, 4.0), entry(2, 2, 5.0)],
        );
        let mut map = CoordinateMap::new(2);
        map.push([(0, 1.0), (1, 2.0)]);
        map.push([(1, -1.0)]);
        map.push([(0, 0.5), (1, 3.0)]);
        let dense = Mat::from_fn(3, 2, |i, j| [[1.0, 2.0], [0.0, -1.0], [0.5, 3.0]][i][j]);
        let expected = dense.transpose() * matrix.dense() * &dense;
        let found = map.congruence(&matrix).dense();
        assert!((found - expected).norm_max() < 1e-14);
        assert_eq!(map.pulled_back(&[(0, 1.0), (2, -2.0)]), [(1, -4.0)]);
    }
}
