//! Plain loops on wide vectors.
//!
//! Products and sums are never fused or reordered by the compiler, so results do not depend on the machine.

/// Runs loops that are compiled twice, for any machine and for one with vectors of four; the machine at hand
/// decides.
///
/// What is called from `work` has to be inlined to have a part in it.
#[inline(always)]
pub(crate) fn vectorised<R>(work: impl FnOnce() -> R) -> R {
    struct Work<F>(F);
    impl<R, F: FnOnce() -> R> pulp::NullaryFnOnce for Work<F> {
        type Output = R;
        #[inline(always)]
        fn call(self) -> R {
            (self.0)()
        }
    }
    pulp::Arch::new().dispatch(Work(work))
}

/// Scalar product, summed in four lanes.
#[inline(always)]
pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    let (length, mut lanes) = (x.len().min(y.len()), [0.0; 4]);
    let ((x, x_rest), (y, y_rest)) = (x[..length].as_chunks::<4>(), y[..length].as_chunks::<4>());
    for (a, b) in x.iter().zip(y) {
        (0..4).for_each(|lane| lanes[lane] += a[lane] * b[lane]);
    }
    let mut sum = (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
    if !x_rest.is_empty() {
        sum += x_rest.iter().zip(y_rest).map(|(a, b)| a * b).sum::<f64>();
    }
    sum
}

/// The same of a fixed length, a multiple of four: a few instructions instead of a loop.
#[inline(always)]
pub(crate) fn fixed_dot<const N: usize>(x: &[f64; N], y: &[f64; N]) -> f64 {
    const { assert!(N.is_multiple_of(4), "four at a time leave none out") };
    let mut lanes = [0.0; 4];
    for (a, b) in x.as_chunks::<4>().0.iter().zip(y.as_chunks::<4>().0) {
        (0..4).for_each(|lane| lanes[lane] += a[lane] * b[lane]);
    }
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3])
}

/// `T_r += sum_k w_rk S_k` for the rows `T_r` of `target` and the rows `S_k` of `source`, of `columns`
/// entries each, a multiple of four.
///
/// * `weights`: the `w_rk` of a row r; where they end the sum ends.
#[inline(always)]
pub(crate) fn add_products<W: Iterator<Item = f64> + Clone>(
    target: &mut [f64],
    source: &[f64],
    columns: usize,
    weights: impl Fn(usize) -> W,
) {
    pulp::Arch::new().dispatch(Products { target, source, columns, weights });
}

struct Products<'a, F> {
    target: &'a mut [f64],
    source: &'a [f64],
    columns: usize,
    weights: F,
}

impl<W: Iterator<Item = f64> + Clone, F: Fn(usize) -> W> pulp::WithSimd for Products<'_, F> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) {
        for (r, row) in self.target.chunks_exact_mut(self.columns).enumerate() {
            add_to_row(simd, row, self.source, (self.weights)(r));
        }
    }
}

/// One row of [`add_products`], eight vectors at a time, which stay in registers.
#[inline(always)]
pub(crate) fn add_to_row<S: pulp::Simd>(
    simd: S,
    row: &mut [f64],
    source: &[f64],
    weights: impl Iterator<Item = f64> + Clone,
) {
    let (row, source) = (S::as_mut_simd_f64s(row).0, S::as_simd_f64s(source).0);
    let (columns, mut first) = (row.len(), 0);
    while first + 8 <= columns {
        add_to_vectors::<S, 8>(simd, row, source, first, weights.clone());
        first += 8;
    }
    match columns - first {
        1 => add_to_vectors::<S, 1>(simd, row, source, first, weights),
        2 => add_to_vectors::<S, 2>(simd, row, source, first, weights),
        3 => add_to_vectors::<S, 3>(simd, row, source, first, weights),
        4 => add_to_vectors::<S, 4>(simd, row, source, first, weights),
        5 => add_to_vectors::<S, 5>(simd, row, source, first, weights),
        6 => add_to_vectors::<S, 6>(simd, row, source, first, weights),
        7 => add_to_vectors::<S, 7>(simd, row, source, first, weights),
        _ => {}
    }
}

#[inline(always)]
fn add_to_vectors<S: pulp::Simd, const N: usize>(
    simd: S,
    row: &mut [S::f64s],
    source: &[S::f64s],
    first: usize,
    weights: impl Iterator<Item = f64>,
) {
    let columns = row.len();
    let target = &mut row[first..first + N];
    let mut sum: [S::f64s; N] = std::array::from_fn(|i| target[i]);
    for (source, weight) in source.chunks_exact(columns).zip(weights) {
        let (weight, part) = (simd.splat_f64s(weight), &source[first..first + N]);
        for i in 0..N {
            sum[i] = simd.add_f64s(sum[i], simd.mul_f64s(weight, part[i]));
        }
    }
    target.copy_from_slice(&sum);
}

/// Adds a multiple of a row to another.
#[inline(always)]
pub(crate) fn add_multiple(to: &mut [f64], factor: f64, row: &[f64]) {
    to.iter_mut().zip(row).for_each(|(t, r)| *t += factor * r);
}

/// Raises each entry to the largest magnitude in its column of `rows`, which have as many entries, a multiple
/// of four.
pub(crate) fn raise_by_columns(to: &mut [f64], rows: &[f64]) {
    let columns = to.len();
    debug_assert!(columns.is_multiple_of(4) && rows.len().is_multiple_of(columns), "columns are padded");
    vectorised(
        #[inline(always)]
        || {
            for (place, to) in to.as_chunks_mut::<4>().0.iter_mut().enumerate() {
                let mut largest = *to;
                for row in rows.chunks_exact(columns) {
                    let four = row.as_chunks::<4>().0[place].map(f64::abs);
                    largest =
                        std::array::from_fn(|i| if four[i] > largest[i] { four[i] } else { largest[i] });
                }
                *to = largest;
            }
        },
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scalar_products_of_any_length_are_complete() {
        let numbers: Vec<f64> = (1..=11).map(f64::from).collect();
        for length in 0..=11 {
            let expected: f64 = (1..=length).map(|i| f64::from(i) * f64::from(i)).sum();
            assert_eq!(dot(&numbers[..length as usize], &numbers), expected);
            assert_eq!(vectorised(|| dot(&numbers[..length as usize], &numbers)), expected);
        }
        let eight = numbers.first_chunk::<8>().unwrap();
        assert_eq!(fixed_dot(eight, eight), 204.0);
    }

    #[test]
    fn entries_are_raised_to_what_is_larger_in_their_column() {
        let rows =
            [[1.0, -9.0, f64::NAN, 0.0, 2.0, 3.0, -4.0, 5.0], [-7.0, 1.0, 2.0, 0.0, 0.5, -6.0, 1.0, 5.0]];
        let mut largest = [3.0; 8];
        raise_by_columns(&mut largest, rows.as_flattened());
        assert_eq!(largest, [7.0, 9.0, 3.0, 3.0, 3.0, 6.0, 4.0, 5.0]);
    }
}
