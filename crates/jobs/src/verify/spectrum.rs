//! Multipliers of a monodromy matrix, and how well they are determined.

use faer::{Mat, c64, linalg::solvers::DenseSolveCore};

/// An eigenvalue and its condition number `k = |x| |y| / |y^H x|`, with its right and left vectors: a change
/// of the matrix by `d` in norm changes it by `k d` at most, to first order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Multiplier {
    pub(super) value: c64,
    pub(super) condition: f64,
}

/// Eigenvalues of a matrix; `None` if they are not found.
pub(super) fn spectrum(matrix: &Mat<f64>) -> Option<Vec<Multiplier>> {
    let eigen = matrix.eigen().ok()?;
    let (vectors, values) = (eigen.U(), eigen.S());
    let inverse = vectors.partial_piv_lu().inverse();
    let of = |i: usize| {
        let condition = vectors.col(i).norm_l2() * inverse.row(i).norm_l2();
        // Where vectors merge, nothing is known to first order.
        let condition = if condition.is_finite() { condition.max(1.0) } else { f64::INFINITY };
        Multiplier { value: values[i], condition }
    };
    Some((0..matrix.nrows()).map(of).collect())
}

/// Frobenius' norm.
pub(super) fn norm(matrix: &Mat<f64>) -> f64 {
    matrix.norm_l2()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `[[a, b], [0, d]]`: eigenvalues a and d, `k = sqrt(1 + (b / (a - d))^2)` for both.
    #[test]
    fn conditions_are_those_of_a_triangle() {
        let matrix = Mat::from_fn(2, 2, |i, j| [[3.0, 8.0], [0.0, 1.0]][i][j]);
        for multiplier in spectrum(&matrix).unwrap() {
            assert!((multiplier.condition - 17_f64.sqrt()).abs() < 1e-12, "{multiplier:?}");
        }
    }
}
