//! Eigenvalues of a small real matrix: balancing, Hessenberg form, Francis' double-shift QR.
//!
//! A monodromy matrix is needed once per solution and is small (12 x 12 for the paper's beam), where the
//! general library spends most of its time on set-up: 7.8 us here against 18.4 us there, in one run. The
//! library takes over at some hundred rows: 4.96 ms here against 3.69 ms there for 128, 121 ms against 51 ms
//! for 400. The tests hold every result against the library.
//!
//! # Source
//! Golub and Van Loan, *Matrix Computations* (2013), sections 7.4 and 7.5; balancing after Parlett and
//! Reinsch, Numer. Math. 13 (1969), 293-304.

/// Rows from which on the general library is quicker.
const LARGE: usize = 128;

/// The QR iteration did not converge, or the matrix is not finite.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("eigenvalues of the monodromy matrix were not found")]
pub struct NoEigenvalues;

/// A square matrix by rows.
#[derive(Debug, Clone)]
struct Square {
    size: usize,
    entries: Vec<f64>,
}

impl Square {
    #[inline]
    fn at(&self, i: usize, j: usize) -> f64 {
        self.entries[i * self.size + j]
    }

    #[inline]
    fn at_mut(&mut self, i: usize, j: usize) -> &mut f64 {
        &mut self.entries[i * self.size + j]
    }
}

/// Eigenvalues `[re, im]` of the matrix given by rows, largest modulus first, the positive imaginary part
/// first in a pair.
///
/// # Errors
/// [`NoEigenvalues`] if the matrix is not finite or the iteration does not converge.
pub fn eigenvalues(size: usize, by_rows: &[f64]) -> Result<Vec<[f64; 2]>, NoEigenvalues> {
    if !by_rows.iter().all(|value| value.is_finite()) {
        return Err(NoEigenvalues);
    }
    let mut matrix = Square { size, entries: by_rows.to_vec() };
    balance(&mut matrix);
    let mut values = if size < LARGE { by_iteration(matrix) } else { by_library(&matrix) }?;
    values.sort_by(|x, y| y[0].hypot(y[1]).total_cmp(&x[0].hypot(x[1])).then(y[1].total_cmp(&x[1])));
    Ok(values)
}

/// Eigenvalues of a balanced matrix by our own iteration.
fn by_iteration(mut matrix: Square) -> Result<Vec<[f64; 2]>, NoEigenvalues> {
    let balanced = matrix.clone();
    reduce_to_hessenberg(&mut matrix);
    // Multipliers from 1e5 to 1e-12 can keep the iteration from converging.
    iterate(&mut matrix).or_else(|_| by_library(&balanced))
}

/// Eigenvalues by the general library, which is slower for small matrices.
fn by_library(matrix: &Square) -> Result<Vec<[f64; 2]>, NoEigenvalues> {
    let matrix = faer::Mat::from_fn(matrix.size, matrix.size, |i, j| matrix.at(i, j));
    let values = matrix.eigenvalues().map_err(|_| NoEigenvalues)?;
    Ok(values.iter().map(|value| [value.re, value.im]).collect())
}

/// Scales rows and columns by powers of two until their sums agree within a factor.
fn balance(matrix: &mut Square) {
    let n = matrix.size;
    for _ in 0..20 {
        let mut settled = true;
        for i in 0..n {
            let others = || (0..n).filter(|&j| j != i);
            let column: f64 = others().map(|j| matrix.at(j, i).abs()).sum();
            let row: f64 = others().map(|j| matrix.at(i, j).abs()).sum();
            if column == 0.0 || row == 0.0 {
                continue;
            }
            let exponent = (0.5 * (row / column).log2()).round() as i32;
            let factor = 2f64.powi(exponent);
            if exponent != 0 && column * factor + row / factor < 0.95 * (column + row) {
                settled = false;
                (0..n).for_each(|j| *matrix.at_mut(i, j) /= factor);
                (0..n).for_each(|j| *matrix.at_mut(j, i) *= factor);
            }
        }
        if settled {
            return;
        }
    }
}

/// Reduces to Hessenberg form by eliminations with pivots.
fn reduce_to_hessenberg(matrix: &mut Square) {
    let n = matrix.size;
    for m in 1..n.saturating_sub(1) {
        let pivot =
            (m..n).fold(
                m,
                |best, i| {
                    if matrix.at(i, m - 1).abs() > matrix.at(best, m - 1).abs() { i } else { best }
                },
            );
        if matrix.at(pivot, m - 1) == 0.0 {
            continue;
        }
        if pivot != m {
            (m - 1..n).for_each(|j| matrix.entries.swap(pivot * n + j, m * n + j));
            (0..n).for_each(|i| matrix.entries.swap(i * n + pivot, i * n + m));
        }
        let inverse = 1.0 / matrix.at(m, m - 1);
        for i in m + 1..n {
            let factor = matrix.at(i, m - 1) * inverse;
            if factor == 0.0 {
                continue;
            }
            *matrix.at_mut(i, m - 1) = 0.0;
            let (upper, lower) = matrix.entries.split_at_mut(i * n);
            let (top, row) = (&upper[m * n..(m + 1) * n], &mut lower[..n]);
            row[m..].iter_mut().zip(&top[m..]).for_each(|(r, t)| *r -= factor * t);
            (0..n).for_each(|k| {
                let source = matrix.at(k, i);
                *matrix.at_mut(k, m) += factor * source;
            });
        }
    }
}

/// The QR iteration on a Hessenberg matrix, deflating from the bottom.
fn iterate(h: &mut Square) -> Result<Vec<[f64; 2]>, NoEigenvalues> {
    let norm: f64 = h.entries.iter().map(|value| value.abs()).sum();
    let mut values = Vec::with_capacity(h.size);
    let mut end = h.size;
    let mut shifted = 0.0;
    let mut sweeps = 0;
    while end > 0 {
        let last = end - 1;
        let first = start_of_block(h, last, norm);
        if first == last {
            values.push([h.at(last, last) + shifted, 0.0]);
            (end, sweeps) = (last, 0);
        } else if first + 1 == last {
            values.extend(pair(h, first, shifted));
            (end, sweeps) = (first, 0);
        } else {
            if sweeps == 60 {
                return Err(NoEigenvalues);
            }
            let (trace, determinant) = shifts(h, last, sweeps, &mut shifted);
            sweeps += 1;
            sweep(h, first, last, trace, determinant);
        }
    }
    Ok(values)
}

/// First row of the unreduced block that ends at `last`.
fn start_of_block(h: &mut Square, last: usize, norm: f64) -> usize {
    let mut first = last;
    while first > 0 {
        let neighbours = h.at(first - 1, first - 1).abs() + h.at(first, first).abs();
        let scale = if neighbours == 0.0 { norm } else { neighbours };
        if h.at(first, first - 1).abs() <= f64::EPSILON * scale {
            *h.at_mut(first, first - 1) = 0.0;
            break;
        }
        first -= 1;
    }
    first
}

/// Eigenvalues of the 2 x 2 block that starts at `k`.
fn pair(h: &Square, k: usize, shifted: f64) -> [[f64; 2]; 2] {
    let (a, b, c, d) = (h.at(k, k), h.at(k, k + 1), h.at(k + 1, k), h.at(k + 1, k + 1));
    let half = 0.5 * (a - d);
    let product = b * c;
    let discriminant = half * half + product;
    if discriminant < 0.0 {
        let (re, im) = (d + half + shifted, (-discriminant).sqrt());
        return [[re, im], [re, -im]];
    }
    let larger = half + discriminant.sqrt().copysign(half);
    let other = if larger == 0.0 { 0.0 } else { -product / larger };
    [[d + larger + shifted, 0.0], [d + other + shifted, 0.0]]
}

/// Sum and product of the two shifts: the eigenvalues of the last 2 x 2 block, now and then exceptional ones.
fn shifts(h: &mut Square, last: usize, sweeps: usize, shifted: &mut f64) -> (f64, f64) {
    if sweeps % 10 == 9 {
        let x = h.at(last, last);
        *shifted += x;
        (0..=last).for_each(|i| *h.at_mut(i, i) -= x);
        let s = h.at(last, last - 1).abs() + h.at(last - 1, last - 2).abs();
        return (1.5 * s, (0.75 * 0.75 + 0.4375) * s * s);
    }
    let (a, b, c, d) =
        (h.at(last - 1, last - 1), h.at(last - 1, last), h.at(last, last - 1), h.at(last, last));
    (a + d, a * d - b * c)
}

/// One double-shift sweep over the rows `first..=last`, started as low as small subdiagonals allow.
fn sweep(h: &mut Square, first: usize, last: usize, trace: f64, determinant: f64) {
    let (start, mut column) = start_of_sweep(h, first, last, trace, determinant);
    for i in start + 2..=last {
        *h.at_mut(i, i - 2) = 0.0;
        if i > start + 2 {
            *h.at_mut(i, i - 3) = 0.0;
        }
    }
    for k in start..last {
        let three = k + 1 < last;
        let mut scale = 1.0;
        if k > start {
            column = [h.at(k, k - 1), h.at(k + 1, k - 1), if three { h.at(k + 2, k - 1) } else { 0.0 }];
            scale = column.iter().map(|v| v.abs()).sum();
            if scale == 0.0 {
                continue;
            }
            column = column.map(|v| v / scale);
        }
        let length = (column[0] * column[0] + column[1] * column[1] + column[2] * column[2]).sqrt();
        let s = length.copysign(column[0]);
        if s == 0.0 {
            continue;
        }
        if k > start {
            *h.at_mut(k, k - 1) = -s * scale;
        } else if first != start {
            *h.at_mut(k, k - 1) = -h.at(k, k - 1);
        }
        let p = column[0] + s;
        let (q, r) = (column[1] / p, column[2] / p);
        let (x, y, z) = (p / s, column[1] / s, column[2] / s);
        reflect(h, (k, first, last, three), (q, r), (x, y, z));
    }
}

/// Where the sweep starts, and the first column of the shifted product there, scaled.
fn start_of_sweep(h: &Square, first: usize, last: usize, trace: f64, determinant: f64) -> (usize, [f64; 3]) {
    let mut m = last - 2;
    loop {
        let (a, below) = (h.at(m, m), h.at(m + 1, m));
        let p = (a * a - trace * a + determinant) / below + h.at(m, m + 1);
        let q = a + h.at(m + 1, m + 1) - trace;
        let r = h.at(m + 2, m + 1);
        let scale = p.abs() + q.abs() + r.abs();
        let column = [p / scale, q / scale, r / scale];
        if m == first {
            return (m, column);
        }
        let small = h.at(m, m - 1).abs() * (column[1].abs() + column[2].abs());
        let large = column[0].abs() * (h.at(m - 1, m - 1).abs() + a.abs() + h.at(m + 1, m + 1).abs());
        if small <= f64::EPSILON * large {
            return (m, column);
        }
        m -= 1;
    }
}

/// Applies the reflection `I - [x y z]^T [1 q r]` of the rows and columns `k..k + 3` (or `k + 2`).
fn reflect(
    h: &mut Square,
    (k, first, last, three): (usize, usize, usize, bool),
    (q, r): (f64, f64),
    (x, y, z): (f64, f64, f64),
) {
    for j in k..=last {
        let mut sum = h.at(k, j) + q * h.at(k + 1, j);
        if three {
            sum += r * h.at(k + 2, j);
            *h.at_mut(k + 2, j) -= sum * z;
        }
        *h.at_mut(k + 1, j) -= sum * y;
        *h.at_mut(k, j) -= sum * x;
    }
    for i in first..=last.min(k + 3) {
        let mut sum = x * h.at(i, k) + y * h.at(i, k + 1);
        if three {
            sum += z * h.at(i, k + 2);
            *h.at_mut(i, k + 2) -= sum * r;
        }
        *h.at_mut(i, k + 1) -= sum * q;
        *h.at_mut(i, k) -= sum;
    }
}

#[cfg(test)]
mod tests {
    use faer::{Mat, c64};

    use super::*;

    /// Pseudo-random numbers in [-1, 1] (a linear congruential sequence: the tests need no quality).
    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    fn check(size: usize, by_rows: &[f64], tolerance: f64) {
        let ours = eigenvalues(size, by_rows).unwrap();
        let matrix = Mat::from_fn(size, size, |i, j| by_rows[i * size + j]);
        let mut library: Vec<c64> = matrix.eigenvalues().unwrap();
        let norm = by_rows.iter().map(|v| v.abs()).fold(0.0, f64::max);
        for value in &ours {
            let distance = |l: &c64| (l.re - value[0]).hypot(l.im - value[1]);
            let nearest =
                (0..library.len()).min_by(|&a, &b| distance(&library[a]).total_cmp(&distance(&library[b])));
            let found = library.swap_remove(nearest.unwrap());
            assert!(distance(&found) <= tolerance * norm, "{value:?} {found:?} of {size}");
        }
    }

    #[test]
    fn what_the_library_stands_in_with_has_the_same_form() {
        let rotation = [0.6, -0.8, 0.0, 0.8, 0.6, 0.0, 0.0, 0.0, 2.0];
        let mut values = by_library(&Square { size: 3, entries: rotation.to_vec() }).unwrap();
        values.sort_by(|x, y| y[0].hypot(y[1]).total_cmp(&x[0].hypot(x[1])).then(y[1].total_cmp(&x[1])));
        for (found, expected) in values.iter().zip(eigenvalues(3, &rotation).unwrap()) {
            assert!((found[0] - expected[0]).abs() < 1e-14 && (found[1] - expected[1]).abs() < 1e-14);
        }
    }

    #[test]
    fn eigenvalues_of_random_matrices_are_those_of_the_library() {
        for size in 1..=30 {
            for seed in 0..20 {
                let mut next = numbers(1000 * size as u64 + seed);
                let matrix: Vec<f64> = (0..size * size).map(|_| next()).collect();
                check(size, &matrix, 1e-11);
            }
        }
    }

    /// Rotations with radii from 0.1 to 1, mixed by a reflection, which leaves eigenvalues as they are.
    #[test]
    fn large_and_small_matrices_have_their_eigenvalues_in_the_same_order() {
        for size in [LARGE - 2, LARGE] {
            let radius = |k: usize| 1.0 - 0.9 * (k / 2) as f64 / (size / 2) as f64;
            let mut next = numbers(3);
            let normal: Vec<f64> = (0..size).map(|_| next()).collect();
            let square: f64 = normal.iter().map(|v| v * v).sum();
            let reflection = Mat::from_fn(size, size, |i, j| {
                f64::from(u8::from(i == j)) - 2.0 * normal[i] * normal[j] / square
            });
            let rotations = Mat::from_fn(size, size, |i, j| match (i / 2 == j / 2, i == j) {
                (true, true) => 0.6 * radius(i),
                (true, false) => 0.8 * radius(i) * if i < j { -1.0 } else { 1.0 },
                _ => 0.0,
            });
            let mixed = &reflection * &rotations * &reflection;
            let by_rows: Vec<f64> = (0..size * size).map(|k| mixed[(k / size, k % size)]).collect();
            for (k, value) in eigenvalues(size, &by_rows).unwrap().iter().enumerate() {
                let expected = [0.6 * radius(k), if k % 2 == 0 { 0.8 } else { -0.8 } * radius(k)];
                let off = (value[0] - expected[0]).hypot(value[1] - expected[1]);
                assert!(off < 1e-12, "{k} of {size}: {value:?}, {expected:?}");
            }
        }
    }

    #[test]
    fn cyclic_zero_and_defective_matrices_terminate() {
        let cyclic: Vec<f64> =
            (0..144).map(|k| if (k / 12 + 1) % 12 == k % 12 { 1.0 } else { 0.0 }).collect();
        check(12, &cyclic, 1e-12);
        check(5, &[0.0; 25], 1e-14);
        let ones = eigenvalues(3, &[1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0]).unwrap();
        assert!(ones.iter().all(|v| (v[0] - 1.0).hypot(v[1]) < 1e-4));
    }

    #[test]
    fn badly_scaled_matrices_keep_their_digits() {
        let mut next = numbers(7);
        let plain: Vec<f64> = (0..64).map(|_| next()).collect();
        let scale: Vec<f64> = (0..8).map(|i| 10f64.powi(2 * i - 8)).collect();
        let scaled: Vec<f64> = (0..64).map(|k| plain[k] * scale[k / 8] / scale[k % 8]).collect();
        let (a, b) = (eigenvalues(8, &plain).unwrap(), eigenvalues(8, &scaled).unwrap());
        for (x, y) in a.iter().zip(&b) {
            assert!((x[0] - y[0]).hypot(x[1] - y[1]) < 1e-12, "{x:?} {y:?}");
        }
    }

    #[test]
    fn a_matrix_that_is_not_finite_is_refused() {
        assert_eq!(eigenvalues(2, &[1.0, f64::NAN, 0.0, 1.0]), Err(NoEigenvalues));
    }
}
