//! Square matrices by rows.

/// Root of the sum of the squared entries.
pub(crate) fn norm(matrix: &[f64]) -> f64 {
    matrix.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// `M v`.
pub(crate) fn times(matrix: &[f64], vector: &[f64]) -> Vec<f64> {
    matrix.chunks_exact(vector.len()).map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum()).collect()
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
