//! Null vectors and invariant planes by inverse iteration.

use hammerbeam_path::DenseLu;

use crate::by_rows::dot;

/// Orthonormal columns near the null space of a nearly singular matrix, given by rows.
pub(super) fn null_space(size: usize, matrix: &[f64], count: usize) -> Vec<Vec<f64>> {
    let mut matrix = matrix.to_vec();
    let largest = matrix.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let mut lu = DenseLu::new();
    while lu.factorise(size, &matrix).is_err() {
        // Singular to the last bit: an inverse needs it a little off.
        (0..size).for_each(|i| matrix[i * size + i] += 1e-14 * largest.max(f64::MIN_POSITIVE));
    }
    let mut columns: Vec<Vec<f64>> = (0..count)
        .map(|c| (0..size).map(|i| ((i + 1) as f64 * (1.3 + c as f64)).sin() + 0.1).collect())
        .collect();
    for _ in 0..4 {
        columns.iter_mut().for_each(|column| lu.solve(column));
        orthonormalise(&mut columns);
    }
    columns
}

pub(super) fn orthonormalise(columns: &mut [Vec<f64>]) {
    for c in 0..columns.len() {
        let (before, column) = columns.split_at_mut(c);
        for other in before {
            let part = dot(other, &column[0]);
            column[0].iter_mut().zip(other.iter()).for_each(|(x, o)| *x -= part * o);
        }
        let length = dot(&column[0], &column[0]).sqrt();
        column[0].iter_mut().for_each(|x| *x /= length);
    }
}
