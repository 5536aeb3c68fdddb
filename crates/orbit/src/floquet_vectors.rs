//! Vectors of a Floquet multiplier, and how far errors of the motion move it.
//! Equation (P10) of the book, `docs/theory`.
//!
//! The monodromy matrix `A = G_{m-1} ... G_0` is the product of the matrices of the segments of an orbit. A
//! multiplier `mu` has a right vector, `A v_0 = mu v_0`, which the motion carries on, `v_{k+1} = G_k v_k`,
//! and a left one, `w_m^H A = mu w_m^H`, which it carries back, `w_k^H = w_{k+1}^H G_k`. Errors `E_k` of the
//! matrices of the segments and one of the product, E, move it by
//!
//! `(sum_k w_{k+1}^H E_k v_k + w_m^H E v_0) / (w_m^H v_0)`
//!
//! to first order. So a multiplier is known to `c_s e_s + c e`, where the errors are `|E_k| <= e_s |G_k|` and
//! `|E| <= e`, with its conditions
//!
//! `c_s = sum_k |w_{k+1}| |G_k| |v_k| / |w_m^H v_0|`, `c = |w_m| |v_0| / |w_m^H v_0|`.
//!
//! Between its nodes an orbit may be stretched far more than over its period, and in directions that have
//! nothing to do with this multiplier: the norms of the products say far less than `c_s`. Since `w_{k+1}^H
//! v_{k+1}` is the same number everywhere, `c_s >= m` for a multiplier on the unit circle.
//!
//! # Source
//! Golub and Van Loan, *Matrix Computations* (2013), section 7.2, for one matrix.

use hammerbeam_path::DenseLu;

use crate::by_rows::{dot, left_times, norm, shifted, times, transposed};

/// So often a matrix that cannot be inverted is shifted; what still cannot be is not finite.
const MOST_SHIFTS: u32 = 8;

/// By how much errors of size one move a multiplier, to first order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Condition {
    /// Relative errors of the matrix of each segment.
    pub of_segments: f64,
    /// An error of their product.
    pub of_product: f64,
}

impl Condition {
    /// Of a multiplier of the product of these matrices by rows, which is given, too; `None` if they are not
    /// finite.
    pub fn of(size: usize, segments: &[&[f64]], product: &[f64], multiplier: [f64; 2]) -> Option<Self> {
        let matrix = shifted(size, product, multiplier);
        let width = matrix.len().isqrt();
        let left = null_vector(width, transposed(width, &matrix))?;
        let right = null_vector(width, matrix)?;
        // Of a real multiplier they have no imaginary part.
        let parts = |vector: Vec<f64>| vector.chunks_exact(size).map(<[f64]>::to_vec).collect::<Vec<_>>();
        let (left, right) = (parts(left), parts(right));
        let together = inner(&left, &right);
        let of_product = length(&left) * length(&right) / together;
        let mut behind = vec![length(&left)];
        let mut vector = left;
        for matrix in segments.iter().skip(1).rev() {
            vector.iter_mut().for_each(|part| *part = left_times(matrix, part));
            behind.push(length(&vector));
        }
        let (mut of_segments, mut vector) = (0.0, right);
        for (matrix, behind) in segments.iter().zip(behind.iter().rev()) {
            of_segments += behind * norm(matrix) * length(&vector) / together;
            vector.iter_mut().for_each(|part| *part = times(matrix, part));
        }
        Some(Self { of_segments, of_product })
    }
}

/// Absolute value of `w^H v`, of vectors by real and imaginary part.
fn inner(w: &[Vec<f64>], v: &[Vec<f64>]) -> f64 {
    match (w, v) {
        ([w], [v]) => dot(w, v).abs(),
        ([w_re, w_im], [v_re, v_im]) => {
            (dot(w_re, v_re) + dot(w_im, v_im)).hypot(dot(w_re, v_im) - dot(w_im, v_re))
        }
        _ => 0.0,
    }
}

fn length(vector: &[Vec<f64>]) -> f64 {
    vector.iter().map(|part| norm(part)).fold(0.0, f64::hypot)
}

/// Null vector of a matrix that is singular to rounding, by inverse iteration, of length one; `None` if the
/// matrix is not finite.
pub(crate) fn null_vector(width: usize, mut matrix: Vec<f64>) -> Option<Vec<f64>> {
    let largest = matrix.iter().fold(1.0_f64, |largest, entry| largest.max(entry.abs()));
    let mut lu = DenseLu::new();
    let mut shifts = 0;
    while lu.factorise(width, &matrix).is_err() {
        if shifts == MOST_SHIFTS {
            return None;
        }
        // Singular to the last bit: an inverse needs it a little off, by what the largest entries do not
        // round away.
        (0..width).for_each(|i| matrix[i * width + i] += 1e-14 * largest);
        shifts += 1;
    }
    let mut vector = vec![1.0; width];
    for _ in 0..3 {
        lu.solve(&mut vector);
        let length = vector.iter().map(|v| v * v).sum::<f64>().sqrt();
        vector.iter_mut().for_each(|v| *v /= length);
    }
    Some(vector)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eigenvalues::eigenvalues;

    /// `[3 s, s; 6 s, 2 s]` has the null vector `(1, -3)`; for a large s a shift by 1e-14 would be rounded
    /// away.
    #[test]
    fn null_vector_of_an_exactly_singular_matrix_of_large_entries_is_found() {
        for size in [1e-3, 1.0, 4096.0, 1e9] {
            let vector =
                null_vector(2, vec![3.0 * size, size, 6.0 * size, 2.0 * size]).expect("it is finite");
            assert!((vector[1] / vector[0] + 3.0).abs() < 1e-9, "{vector:?} at {size}");
        }
    }

    fn product_of(a: &[f64], b: &[f64]) -> Vec<f64> {
        (0..9).map(|k| (0..3).map(|j| a[k / 3 * 3 + j] * b[3 * j + k % 3]).sum()).collect()
    }

    /// Root of the sum of the squared derivatives of the eigenvalue of that number by the entries of a
    /// matrix, by differences: the worst error of the norm e moves it by e times as much.
    fn most_moved(k: usize, product: impl Fn(&[f64]) -> Vec<f64>, matrix: &[f64]) -> f64 {
        let squares = (0..9).map(|entry| {
            let [up, down] = [1e-6, -1e-6].map(|h| {
                let mut moved = matrix.to_vec();
                moved[entry] += h;
                eigenvalues(3, &product(&moved)).expect("it converges")[k]
            });
            ((up[0] - down[0]).hypot(up[1] - down[1]) / 2e-6).powi(2)
        });
        squares.sum::<f64>().sqrt()
    }

    #[test]
    fn a_multiplier_moves_as_far_as_its_condition_says() {
        let first = [30.0, 2.0, -1.0, 0.3, 0.9, 0.5, 0.1, -0.7, 0.8];
        let second = [0.4, -0.2, 0.1, -5.0, 0.7, -9.0, 2.0, 6.0, 0.4];
        let third = [1.1, 0.3, -0.4, 0.2, 0.05, 0.6, -0.8, 0.9, 0.2];
        let product = product_of(&third, &product_of(&second, &first));
        let multipliers = eigenvalues(3, &product).expect("it converges");
        assert_eq!(multipliers.iter().filter(|[_, im]| *im != 0.0).count(), 2, "a pair and a real one");
        for (k, multiplier) in multipliers.into_iter().enumerate() {
            let condition = Condition::of(3, &[&first, &second, &third], &product, multiplier);
            let Condition { of_segments, of_product } = condition.expect("it is finite");
            let expected = norm(&first)
                * most_moved(k, |m| product_of(&third, &product_of(&second, m)), &first)
                + norm(&second) * most_moved(k, |m| product_of(&third, &product_of(m, &first)), &second)
                + norm(&third) * most_moved(k, |m| product_of(m, &product_of(&second, &first)), &third);
            assert!((of_segments / expected - 1.0).abs() < 1e-5, "{multiplier:?}: {of_segments}, {expected}");
            let expected = most_moved(k, <[f64]>::to_vec, &product);
            assert!((of_product / expected - 1.0).abs() < 1e-5, "{multiplier:?}: {of_product}, {expected}");
        }
    }

    #[test]
    fn a_matrix_that_is_not_finite_has_no_null_vector() {
        assert_eq!(null_vector(2, vec![f64::NAN, 1.0, 1.0, 1.0]), None);
    }
}
