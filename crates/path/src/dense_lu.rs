//! LU factorisation of a small dense matrix, with the sign and logarithm of its determinant.

use crate::problem::{Determinant, SingularJacobian};

/// `P A = L U` with partial pivoting, rows stored one after the other.
///
/// Repeated factorisations of matrices of one size allocate nothing.
///
/// # Source
/// Golub and Van Loan, *Matrix Computations*, 4th ed. 2013, algorithm 3.4.1.
#[derive(Debug, Clone, Default)]
pub struct DenseLu {
    size: usize,
    factors: Vec<f64>,
    exchanges: Vec<usize>,
    sign: f64,
    log_magnitude: f64,
}

impl DenseLu {
    /// An empty factorisation; the first [`factorise`](Self::factorise) gives it its size.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Factorises the `n × n` matrix, row by row in `matrix`.
    ///
    /// # Errors
    /// [`SingularJacobian`] when a pivot is zero or not finite; the factorisation is then unusable.
    pub fn factorise(&mut self, n: usize, matrix: &[f64]) -> Result<Determinant, SingularJacobian> {
        assert_eq!(matrix.len(), n * n, "the matrix has n rows of n entries");
        self.factors.clear();
        self.factors.extend_from_slice(matrix);
        self.factorise_kept(n)
    }

    /// Factorises the `n × n` matrix made of the rows in `upper` (`n − 1` of them) and one last row.
    ///
    /// # Errors
    /// As [`factorise`](Self::factorise).
    pub fn factorise_bordered(
        &mut self,
        upper: &[f64],
        row: &[f64],
    ) -> Result<Determinant, SingularJacobian> {
        let n = row.len();
        assert_eq!(upper.len(), n * (n - 1), "the upper rows have the length of the border");
        self.factors.clear();
        self.factors.extend_from_slice(upper);
        self.factors.extend_from_slice(row);
        self.factorise_kept(n)
    }

    /// Solves `A x = b` in place.
    pub fn solve(&self, right_hand_side: &mut [f64]) {
        let n = self.size;
        for (i, &j) in self.exchanges.iter().enumerate() {
            right_hand_side.swap(i, j);
        }
        for i in 1..n {
            let (known, open) = right_hand_side.split_at_mut(i);
            open[0] -= dot(&self.factors[i * n..i * n + i], known);
        }
        for i in (0..n).rev() {
            let (open, known) = right_hand_side.split_at_mut(i + 1);
            let row = &self.factors[i * n..(i + 1) * n];
            open[i] = (open[i] - dot(&row[i + 1..], known)) / row[i];
        }
    }

    /// Solves `A X = B` in place for matrices of so many columns, stored row by row: much quicker than one
    /// column after the other.
    pub fn solve_rows(&self, right_hand_sides: &mut [f64], columns: usize) {
        let n = self.size;
        for (i, &j) in self.exchanges.iter().enumerate().filter(|(i, j)| i != *j) {
            let (above, below) = right_hand_sides.split_at_mut(j * columns);
            above[i * columns..(i + 1) * columns].swap_with_slice(&mut below[..columns]);
        }
        let subtract = |row: &mut [f64], factors: &[f64], known: &[f64]| {
            for (&factor, known) in factors.iter().zip(known.chunks_exact(columns)) {
                row.iter_mut().zip(known).for_each(|(entry, known)| *entry -= factor * known);
            }
        };
        for i in 1..n {
            let (known, open) = right_hand_sides.split_at_mut(i * columns);
            subtract(&mut open[..columns], &self.factors[i * n..i * n + i], known);
        }
        for i in (0..n).rev() {
            let (open, known) = right_hand_sides.split_at_mut((i + 1) * columns);
            let (row, factors) = (&mut open[i * columns..], &self.factors[i * n..(i + 1) * n]);
            subtract(row, &factors[i + 1..], known);
            row.iter_mut().for_each(|entry| *entry /= factors[i]);
        }
    }

    /// Determinant of the last factorised matrix.
    #[must_use]
    pub fn determinant(&self) -> Determinant {
        Determinant { sign: self.sign, log_magnitude: self.log_magnitude }
    }

    fn factorise_kept(&mut self, n: usize) -> Result<Determinant, SingularJacobian> {
        self.size = n;
        self.sign = 1.0;
        self.log_magnitude = 0.0;
        self.exchanges.clear();
        for k in 0..n {
            let pivot = self.bring_up_pivot(k)?;
            self.sign *= pivot.signum();
            self.log_magnitude += pivot.abs().ln();
            self.eliminate_below(k, pivot);
        }
        Ok(self.determinant())
    }

    /// Exchanges row `k` with the one that has the largest entry in column `k`, and returns that entry.
    fn bring_up_pivot(&mut self, k: usize) -> Result<f64, SingularJacobian> {
        let n = self.size;
        let mut best = k;
        for i in k + 1..n {
            if self.factors[i * n + k].abs() > self.factors[best * n + k].abs() {
                best = i;
            }
        }
        self.exchanges.push(best);
        if best != k {
            let (above, below) = self.factors.split_at_mut(best * n);
            above[k * n..(k + 1) * n].swap_with_slice(&mut below[..n]);
            self.sign = -self.sign;
        }
        let pivot = self.factors[k * n + k];
        if pivot == 0.0 || !pivot.is_finite() { Err(SingularJacobian) } else { Ok(pivot) }
    }

    fn eliminate_below(&mut self, k: usize, pivot: f64) {
        let n = self.size;
        let (above, below) = self.factors.split_at_mut((k + 1) * n);
        let pivot_row = &above[k * n + k + 1..(k + 1) * n];
        for row in below.chunks_exact_mut(n) {
            let factor = row[k] / pivot;
            row[k] = factor;
            if factor != 0.0 {
                for (entry, &p) in row[k + 1..].iter_mut().zip(pivot_row) {
                    *entry -= factor * p;
                }
            }
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn columns_at_once_are_those_one_after_the_other() {
        let matrix: Vec<f64> = (0..25)
            .map(|k| f64::from((k * 7 + k * k * 3) % 11) - if k % 6 == 0 { 9.0 } else { 4.0 })
            .collect();
        let mut lu = DenseLu::new();
        lu.factorise(5, &matrix).unwrap();
        assert!(lu.exchanges.iter().enumerate().any(|(i, &j)| i != j));
        let mut rows: Vec<f64> = (0..15).map(|k| f64::from(k * k % 13)).collect();
        let columns = [0, 1, 2].map(|c| {
            let mut column: Vec<f64> = (0..5).map(|i| rows[3 * i + c]).collect();
            lu.solve(&mut column);
            column
        });
        lu.solve_rows(&mut rows, 3);
        for (k, found) in rows.iter().enumerate() {
            assert_relative_eq!(*found, columns[k % 3][k / 3], max_relative = 1e-12);
        }
    }

    #[test]
    fn determinant_of_a_permuted_triangle_has_the_sign_of_the_permutation() {
        let mut lu = DenseLu::new();
        let d = lu.factorise(3, &[0.0, 2.0, 1.0, 3.0, 1.0, 5.0, 0.0, 0.0, 4.0]).unwrap();
        assert_eq!(d.sign, -1.0);
        assert_relative_eq!(d.log_magnitude, 24.0_f64.ln(), max_relative = 1e-14);
    }

    #[test]
    fn solution_reproduces_the_right_hand_side() {
        let n = 17;
        let matrix: Vec<f64> = (0..n * n).map(|k| ((k * k + 3 * k) as f64 * 0.7).sin()).collect();
        let expected: Vec<f64> = (0..n).map(|k| (k as f64).cos()).collect();
        let mut b: Vec<f64> = matrix.chunks(n).map(|row| dot(row, &expected)).collect();
        let mut lu = DenseLu::new();
        lu.factorise(n, &matrix).unwrap();
        lu.solve(&mut b);
        for (found, wanted) in b.iter().zip(&expected) {
            assert_relative_eq!(found, wanted, epsilon = 1e-11);
        }
    }

    #[test]
    fn a_zero_column_is_singular() {
        let mut lu = DenseLu::new();
        assert_eq!(lu.factorise(2, &[0.0, 1.0, 0.0, 2.0]), Err(SingularJacobian));
        assert_eq!(lu.factorise(2, &[f64::NAN, 1.0, 0.0, 2.0]), Err(SingularJacobian));
    }
}
