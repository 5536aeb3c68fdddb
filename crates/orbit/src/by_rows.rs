//! Square matrices by rows.

use faer::{Accum, MatMut, MatRef, Par, linalg::matmul::matmul};

/// Rows from which on the general library multiplies matrices: it takes 1.3 us for 32, a loop 23 us; for
/// fewer the sums keep their order.
const LARGE: usize = 32;

/// Root of the sum of the squared entries.
pub(crate) fn norm(matrix: &[f64]) -> f64 {
    matrix.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// `M v`.
pub(crate) fn times(matrix: &[f64], vector: &[f64]) -> Vec<f64> {
    matrix.chunks_exact(vector.len()).map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum()).collect()
}

/// `w^T M`.
pub(crate) fn left_times(matrix: &[f64], vector: &[f64]) -> Vec<f64> {
    let size = matrix.len() / vector.len();
    let mut sum = vec![0.0; size];
    for (row, w) in matrix.chunks_exact(size).zip(vector) {
        sum.iter_mut().zip(row).for_each(|(s, entry)| *s += w * entry);
    }
    sum
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `target = factor source`.
pub(crate) fn multiply(size: usize, factor: &[f64], source: &[f64], target: &mut [f64]) {
    if size >= LARGE {
        let [factor, source] = [factor, source].map(|rows| MatRef::from_row_major_slice(rows, size, size));
        let target = MatMut::from_row_major_slice_mut(target, size, size);
        return matmul(target, Accum::Replace, factor, source, 1.0, Par::Seq);
    }
    target.fill(0.0);
    for (row, out) in factor.chunks_exact(size).zip(target.chunks_exact_mut(size)) {
        for (value, from) in row.iter().zip(source.chunks_exact(size)) {
            out.iter_mut().zip(from).for_each(|(o, s)| *o += value * s);
        }
    }
}

pub(crate) fn transposed(size: usize, matrix: &[f64]) -> Vec<f64> {
    (0..size * size).map(|k| matrix[k % size * size + k / size]).collect()
}

/// `A - z I` of a matrix by rows; for a complex number `[A - a I, b I; -b I, A - a I]`, which acts on real
/// and imaginary parts.
pub(crate) fn shifted(size: usize, by_rows: &[f64], [re, im]: [f64; 2]) -> Vec<f64> {
    let blocks = if im == 0.0 { 1 } else { 2 };
    let width = blocks * size;
    let mut matrix = vec![0.0; width * width];
    for (i, row) in matrix.chunks_exact_mut(width).enumerate() {
        let (block, of_block) = (i / size, i % size);
        row[block * size..(block + 1) * size]
            .copy_from_slice(&by_rows[of_block * size..(of_block + 1) * size]);
        row[i] -= re;
        if blocks == 2 {
            row[(1 - block) * size + of_block] = if block == 0 { im } else { -im };
        }
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The library multiplies large matrices as the loops do small ones.
    #[test]
    fn products_of_large_and_small_matrices_are_alike() {
        for size in [1, LARGE - 1, LARGE, LARGE + 5] {
            let entry = |k: usize, seed: f64| (seed * (k + 1) as f64).sin();
            let factor: Vec<f64> = (0..size * size).map(|k| entry(k, 1.3)).collect();
            let source: Vec<f64> = (0..size * size).map(|k| entry(k, 2.9)).collect();
            let mut product = vec![f64::NAN; size * size];
            multiply(size, &factor, &source, &mut product);
            for (i, j) in [(0, 0), (size / 2, size - 1), (size - 1, size / 3), (size - 1, size - 1)] {
                let expected: f64 = (0..size).map(|k| factor[i * size + k] * source[k * size + j]).sum();
                assert!((product[i * size + j] - expected).abs() < 1e-12, "{i}, {j} of {size}");
            }
        }
    }
}
