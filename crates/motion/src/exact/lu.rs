//! A small dense LU factorisation for the forces of a step.

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
        for k in 0..size {
            let magnitude = |row: usize| self.factors[row * size + k].abs();
            let pivot = (k + 1..size).fold(k, |best, row| if magnitude(row) > magnitude(best) { row } else { best });
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

    /// Solves in place for `columns` right-hand sides stored row by row (`[row * columns + column]`).
    pub fn solve(&self, right: &mut [f64], columns: usize) {
        let size = self.size;
        // All exchanges first: later ones have moved the factors of earlier columns too.
        for (k, &pivot) in self.pivots.iter().enumerate() {
            if pivot != k {
                let (upper, lower) = right.split_at_mut(pivot * columns);
                upper[k * columns..(k + 1) * columns].swap_with_slice(&mut lower[..columns]);
            }
        }
        for k in 0..size {
            let (upper, lower) = right.split_at_mut((k + 1) * columns);
            let top = &upper[k * columns..];
            for (row, target) in lower.chunks_exact_mut(columns).enumerate() {
                let factor = self.factors[(k + 1 + row) * size + k];
                target.iter_mut().zip(top).for_each(|(r, t)| *r -= factor * t);
            }
        }
        for k in (0..size).rev() {
            let (upper, lower) = right.split_at_mut((k + 1) * columns);
            let target = &mut upper[k * columns..];
            for (row, source) in lower[..(size - k - 1) * columns].chunks_exact(columns).enumerate() {
                let factor = self.factors[k * size + k + 1 + row];
                target.iter_mut().zip(source).for_each(|(r, t)| *r -= factor * t);
            }
            let inverse = 1.0 / self.factors[k * size + k];
            target.iter_mut().for_each(|r| *r *= inverse);
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
        let mut x = [1.0, 4.0, 2.0, 5.0, 3.0, 6.0];
        lu.solve(&mut x, 2);
        for (row, expected) in [[1.0, 4.0], [2.0, 5.0], [3.0, 6.0]].iter().enumerate() {
            for column in 0..2 {
                let sum: f64 = (0..3).map(|k| matrix[row * 3 + k] * x[k * 2 + column]).sum();
                assert!((sum - expected[column]).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn singular_matrix_is_refused() {
        assert!(SmallLu::default().factorise(2, |m| m.copy_from_slice(&[1.0, 2.0, 2.0, 4.0])).is_none());
    }
}
