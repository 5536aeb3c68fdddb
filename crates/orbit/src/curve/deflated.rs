//! The multipliers beside the critical ones.
//!
//! Householder reflections that turn the critical vectors into the first axes bring the monodromy matrix to
//! `[A_c *; 0 A_r]`; the other multipliers are the eigenvalues of `A_r`. Nothing is divided by what vanishes
//! where one of them comes to the critical ones, as `w^T v` does, and no multiplier is taken for another
//! there. With them, two that meet at +1 would be found as a pair on either side of the unit circle, at the
//! root of rounding.
//!
//! # Source
//! Golub and Van Loan, *Matrix Computations* (2013), sections 5.1 and 7.1.

use crate::{
    by_rows::dot,
    eigenvalues::{NoEigenvalues, eigenvalues},
};

/// Eigenvalues `[re, im]` of a matrix, given by rows, but the ones of an invariant subspace.
///
/// * `invariant`: linearly independent columns that span it.
pub(super) fn other_eigenvalues(
    size: usize,
    matrix: &[f64],
    invariant: &[Vec<f64>],
) -> Result<Vec<[f64; 2]>, NoEigenvalues> {
    let mut matrix = matrix.to_vec();
    let mut columns = invariant.to_vec();
    for j in 0..columns.len() {
        let normal = normal_of_mirror(&columns[j], j);
        columns.iter_mut().for_each(|column| reflect(column, &normal));
        matrix.chunks_exact_mut(size).for_each(|row| reflect(row, &normal));
        for k in 0..size {
            let mut column: Vec<f64> = (0..size).map(|i| matrix[i * size + k]).collect();
            reflect(&mut column, &normal);
            column.iter().enumerate().for_each(|(i, entry)| matrix[i * size + k] = *entry);
        }
    }
    let first = columns.len();
    let rest: Vec<f64> =
        matrix.chunks_exact(size).skip(first).flat_map(|row| row[first..].to_vec()).collect();
    eigenvalues(size - first, &rest)
}

/// Unit normal of the mirror that turns a column into the axis of that number, its entries before that left
/// out.
fn normal_of_mirror(column: &[f64], axis: usize) -> Vec<f64> {
    let mut normal = column.to_vec();
    normal[..axis].fill(0.0);
    normal[axis] += dot(&normal, &normal).sqrt().copysign(normal[axis]);
    let length = dot(&normal, &normal).sqrt();
    normal.into_iter().map(|entry| entry / length).collect()
}

fn reflect(vector: &mut [f64], normal: &[f64]) {
    let twice = 2.0 * dot(vector, normal);
    vector.iter_mut().zip(normal).for_each(|(entry, n)| *entry -= twice * n);
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test ends where its matrix is wrong")]

    use super::*;

    /// `S T S^-1` with `S = I + u e^T`, so that `S^-1 = I - u e^T / (1 + e . u)`, of an upper triangular
    /// matrix in blocks.
    fn mixed(blocks: [[f64; 4]; 4]) -> Vec<f64> {
        let (u, e) = ([0.3, -0.7, 0.2, 0.5], [0.4, 0.1, -0.6, 0.8]);
        let unit = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        let sum = 1.0 + dot(&u, &e);
        let s = |i: usize, j: usize| unit(i, j) + u[i] * e[j];
        let inverse = |i: usize, j: usize| unit(i, j) - u[i] * e[j] / sum;
        let entry = |i: usize, j: usize| -> f64 {
            (0..4).flat_map(|k| (0..4).map(move |l| s(i, k) * blocks[k][l] * inverse(l, j))).sum()
        };
        (0..16).map(|k| entry(k / 4, k % 4)).collect()
    }

    fn columns(count: usize) -> Vec<Vec<f64>> {
        let (u, e) = ([0.3, -0.7, 0.2, 0.5], [0.4, 0.1, -0.6, 0.8]);
        let column = |j: usize| (0..4).map(|i| u[i] * e[j] + if i == j { 1.0 } else { 0.0 }).collect();
        (0..count).map(column).collect()
    }

    /// A multiplier that meets the critical one, in a block that cannot be made diagonal, is found to
    /// rounding; among all four it is off by its root.
    #[test]
    fn a_multiplier_that_meets_the_critical_one_is_found_to_rounding() {
        let matrix =
            mixed([[1.0, 3.0, 0.2, 0.4], [0.0, 1.0, -0.5, 0.1], [0.0, 0.0, 0.6, -0.8], [0.0, 0.0, 0.8, 0.6]]);
        let rest = other_eigenvalues(4, &matrix, &columns(1)).unwrap();
        let off = |expected: [f64; 2]| {
            let each = rest.iter().map(|[re, im]| (re - expected[0]).hypot(im - expected[1]));
            each.fold(f64::INFINITY, f64::min)
        };
        assert!(off([1.0, 0.0]) < 1e-14 && off([0.6, 0.8]) < 1e-14 && rest.len() == 3, "{rest:?}");
    }

    #[test]
    fn a_pair_is_taken_out_with_its_plane() {
        let matrix = mixed([
            [0.6, -0.8, 0.2, 0.4],
            [0.8, 0.6, -0.5, 0.1],
            [0.0, 0.0, -1.0, 0.3],
            [0.0, 0.0, 0.0, 0.25],
        ]);
        let [one, two] = [0, 1].map(|j| columns(2).swap_remove(j));
        let skew: Vec<f64> = one.iter().zip(&two).map(|(a, b)| 0.3 * a - b).collect();
        let rest = other_eigenvalues(4, &matrix, &[one, skew]).unwrap();
        assert!((rest[0][0] + 1.0).abs() < 1e-14 && (rest[1][0] - 0.25).abs() < 1e-14, "{rest:?}");
    }
}
