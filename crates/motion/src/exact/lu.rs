//! A small dense LU factorisation for the forces of a step.

use super::lanes::{add_to_row, dot, vectorised};

/// `P A = L U` of a small square matrix, row by row.
#[derive(Debug, Clone, Default)]
pub(crate) struct SmallLu {
    size: usize,
    factors: Vec<f64>,
    pivots: Vec<usize>,
}

impl SmallLu {
    /// Factorises the matrix that `fill` writes row by row into a zeroed slice; `None` if it is singular.
    #[must_use]
    pub fn factorise(&mut self, size: usize, fill: impl FnOnce(&mut [f64])) -> Option<()> {
        self.size = size;
        self.factors.clear();
        self.factors.resize(size * size, 0.0);
        self.pivots.clear();
        fill(&mut self.factors);
        vectorised(
            #[inline(always)]
            || self.eliminate(),
        )
    }

    #[inline(always)]
    fn eliminate(&mut self) -> Option<()> {
        let size = self.size;
        for k in 0..size {
            let magnitude = |row: usize| self.factors[row * size + k].abs();
            let pivot =
                (k + 1..size).fold(k, |best, row| if magnitude(row) > magnitude(best) { row } else { best });
            self.pivots.push(pivot);
            if pivot != k {
                let (upper, lower) = self.factors.split_at_mut(pivot * size);
                upper[k * size..(k + 1) * size].swap_with_slice(&mut lower[..size]);
            }
            let (upper, lower) = self.factors.split_at_mut((k + 1) * size);
            let top = &upper[k * size..];
            if top[k] == 0.0 || !top[k].is_finite() {
                return None;
            }
            let inverse = 1.0 / top[k];
            for row in lower.chunks_exact_mut(size) {
                let factor = row[k] * inverse;
                row[k] = factor;
                row[k + 1..].iter_mut().zip(&top[k + 1..]).for_each(|(r, t)| *r -= factor * t);
            }
        }
        Some(())
    }

    /// Solves in place.
    pub fn solve(&self, right: &mut [f64]) {
        self.pivots.iter().enumerate().for_each(|(k, &pivot)| right.swap(k, pivot));
        vectorised(
            #[inline(always)]
            || {
                let rows = self.factors.chunks_exact(self.size.max(1)).enumerate();
                for (k, row) in rows.clone() {
                    right[k] -= dot(&row[..k], right);
                }
                for (k, row) in rows.rev() {
                    right[k] = (right[k] - dot(&row[k + 1..], &right[k + 1..])) / row[k];
                }
            },
        );
    }

    /// Solves in place for `columns` right-hand sides, a multiple of four, stored row by row (`[row *
    /// columns + column]`).
    pub fn solve_rows(&self, right: &mut [f64], columns: usize) {
        exchange_rows(&self.pivots, right, columns);
        let row = |i: usize| &self.factors[i * self.size..(i + 1) * self.size];
        substitute(
            right,
            columns,
            (
                #[inline(always)]
                |i| row(i)[..i].iter().map(|factor| -factor),
                #[inline(always)]
                |i| row(i)[i + 1..].iter().map(|factor| -factor),
                #[inline(always)]
                |i| 1.0 / row(i)[i],
            ),
        );
    }
}

/// `P A = L U` of an N x N matrix, column by column: loops of fixed length, which the compiler turns into
/// vectors.
#[derive(Debug, Clone)]
pub(crate) struct FixedLu<const N: usize> {
    /// Columns of U down to the diagonal; what is below means nothing.
    upper: [[f64; N]; N],
    /// Columns of L, zero from the diagonal up.
    lower: [[f64; N]; N],
    inverse: [f64; N],
    pivots: [usize; N],
}

impl<const N: usize> Default for FixedLu<N> {
    fn default() -> Self {
        let zero = [[0.0; N]; N];
        Self { upper: zero, lower: zero, inverse: [0.0; N], pivots: [0; N] }
    }
}

impl<const N: usize> FixedLu<N> {
    /// Factorises the matrix that `fill` writes column by column; `None` if it is singular.
    #[must_use]
    #[inline(always)]
    pub fn factorise(&mut self, fill: impl FnOnce(&mut [[f64; N]; N])) -> Option<()> {
        vectorised(
            #[inline(always)]
            || {
                fill(&mut self.upper);
                self.eliminate()
            },
        )
    }

    #[inline(always)]
    fn eliminate(&mut self) -> Option<()> {
        for k in 0..N {
            let pivot = largest_from(&self.upper[k], k);
            self.pivots[k] = pivot;
            if pivot != k {
                self.upper.iter_mut().chain(&mut self.lower[..k]).for_each(|column| column.swap(k, pivot));
            }
            let column = self.upper[k];
            let top = column[k];
            if top == 0.0 || !top.is_finite() {
                return None;
            }
            let inverse = 1.0 / top;
            self.inverse[k] = inverse;
            // Zeros are cheaper than exact lengths.
            let lower = std::array::from_fn(|i| if i > k { column[i] * inverse } else { 0.0 });
            self.lower[k] = lower;
            self.upper[k + 1..].iter_mut().for_each(|column| subtract(column, &lower, column[k]));
        }
        Some(())
    }

    /// Solves in place.
    pub fn solve(&self, right: &mut [f64; N]) {
        self.pivots.iter().enumerate().for_each(|(k, &pivot)| right.swap(k, pivot));
        vectorised(
            #[inline(always)]
            || {
                // Whole columns: of what is open only entries that are not yet known are read.
                let mut open = *right;
                for k in 0..N {
                    let known = open[k];
                    subtract(&mut open, &self.lower[k], known);
                }
                for k in (0..N).rev() {
                    right[k] = open[k] * self.inverse[k];
                    subtract(&mut open, &self.upper[k], right[k]);
                }
            },
        );
    }

    /// Solves in place for `columns` right-hand sides, a multiple of four, stored row by row (`[row *
    /// columns + column]`).
    pub fn solve_rows(&self, right: &mut [f64], columns: usize) {
        exchange_rows(&self.pivots, right, columns);
        substitute(
            right,
            columns,
            (
                #[inline(always)]
                |i| self.lower[..i].iter().map(move |column| -column[i]),
                #[inline(always)]
                |i| self.upper[i + 1..].iter().map(move |column| -column[i]),
                #[inline(always)]
                |i| self.inverse[i],
            ),
        );
    }
}

/// Takes a multiple of another column off a column.
#[inline(always)]
fn subtract<const N: usize>(column: &mut [f64; N], other: &[f64; N], factor: f64) {
    column.iter_mut().zip(other).for_each(|(entry, other)| *entry -= other * factor);
}

/// Where the entry of largest magnitude is, the first of those from k on.
#[inline(always)]
fn largest_from<const N: usize>(column: &[f64; N], k: usize) -> usize {
    let magnitudes: [f64; N] = std::array::from_fn(|i| if i < k { 0.0 } else { column[i].abs() });
    // Mostly there is none above.
    if magnitudes.iter().filter(|m| **m > magnitudes[k]).count() == 0 {
        return k;
    }
    (k + 1..N).fold(k, |best, row| if magnitudes[row] > magnitudes[best] { row } else { best })
}

/// All exchanges, before anything else: later ones have moved the factors of earlier columns too.
fn exchange_rows(pivots: &[usize], right: &mut [f64], columns: usize) {
    for (k, &pivot) in pivots.iter().enumerate() {
        if pivot != k {
            let (upper, lower) = right.split_at_mut(pivot * columns);
            upper[k * columns..(k + 1) * columns].swap_with_slice(&mut lower[..columns]);
        }
    }
}

/// Both substitutions for several right-hand sides at once.
///
/// * `factors`: of row i the negative entries of L before its diagonal, those of U behind it, and the inverse
///   of the diagonal entry of U.
#[inline(always)]
fn substitute<L, U>(
    right: &mut [f64],
    columns: usize,
    factors: (impl Fn(usize) -> L, impl Fn(usize) -> U, impl Fn(usize) -> f64),
) where
    L: Iterator<Item = f64> + Clone,
    U: Iterator<Item = f64> + Clone,
{
    pulp::Arch::new().dispatch(Substitution { right, columns, factors });
}

struct Substitution<'a, F> {
    right: &'a mut [f64],
    columns: usize,
    factors: F,
}

impl<L, U, Lower, Upper, Inverse> pulp::WithSimd for Substitution<'_, (Lower, Upper, Inverse)>
where
    L: Iterator<Item = f64> + Clone,
    U: Iterator<Item = f64> + Clone,
    Lower: Fn(usize) -> L,
    Upper: Fn(usize) -> U,
    Inverse: Fn(usize) -> f64,
{
    type Output = ();
    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) {
        let Self { right, columns, factors: (lower, upper, inverse) } = self;
        let size = right.len() / columns;
        for i in 1..size {
            let (known, open) = right.split_at_mut(i * columns);
            add_to_row(simd, &mut open[..columns], known, lower(i));
        }
        for i in (0..size).rev() {
            let (open, known) = right.split_at_mut((i + 1) * columns);
            let (target, factor) = (&mut open[i * columns..], inverse(i));
            add_to_row(simd, target, known, upper(i));
            target.iter_mut().for_each(|t| *t *= factor);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solution_satisfies_the_equations_with_pivoting() {
        let matrix = [0.0, 2.0, 1.0, 1.0, 1e-3, 3.0, 4.0, 1.0, 0.5];
        let mut lu = SmallLu::default();
        lu.factorise(3, |m| m.copy_from_slice(&matrix)).unwrap();
        let rights = [[1.0, 4.0, -1.0, 0.0], [2.0, 5.0, 3.0, 1.0], [3.0, 6.0, 7.0, -2.0]];
        let mut x = rights.as_flattened().to_vec();
        lu.solve_rows(&mut x, 4);
        for column in 0..4 {
            let mut single = rights.map(|row| row[column]);
            lu.solve(&mut single);
            for (row, right) in rights.iter().enumerate() {
                let sum: f64 = (0..3).map(|k| matrix[row * 3 + k] * x[k * 4 + column]).sum();
                assert!((sum - right[column]).abs() < 1e-14);
                assert!((single[row] - x[row * 4 + column]).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn fixed_and_variable_sizes_agree() {
        let matrix: [[f64; 6]; 6] = std::array::from_fn(|i| {
            std::array::from_fn(|j| ((i * 7 + j * j * 3 + i * i * j + 5) % 11) as f64 - 4.0)
        });
        let (mut fixed, mut variable) = (FixedLu::default(), SmallLu::default());
        fixed.factorise(|m| *m = std::array::from_fn(|j| matrix.map(|row| row[j]))).unwrap();
        variable.factorise(6, |m| m.copy_from_slice(matrix.as_flattened())).unwrap();
        let mut single = [1.0, -2.0, 3.0, 0.5, 0.0, 7.0];
        let mut expected = single.to_vec();
        variable.solve(&mut expected);
        for columns in [4, 12, 16] {
            let mut rows: Vec<f64> =
                (0..6 * columns).map(|i| single[i / columns] * (1 + i % columns) as f64).collect();
            fixed.solve_rows(&mut rows, columns);
            for (i, found) in rows.iter().enumerate() {
                let factor = (1 + i % columns) as f64;
                assert!((found - factor * expected[i / columns]).abs() < 1e-12 * factor);
            }
        }
        fixed.solve(&mut single);
        (0..6).for_each(|i| assert!((single[i] - expected[i]).abs() < 1e-12));
    }

    #[test]
    fn singular_matrix_is_refused() {
        assert!(SmallLu::default().factorise(2, |m| m.copy_from_slice(&[1.0, 2.0, 2.0, 4.0])).is_none());
    }
}
