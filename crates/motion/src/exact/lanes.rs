//! Plain loops on wide vectors.
//!
//! Products and sums are never fused or reordered by the compiler, so results do not depend on the machine.

/// Runs loops that are compiled twice, for any machine and for one with vectors of four; the machine at hand decides.
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
    let mut lanes = [0.0; 4];
    let (x, y) = (&x[..x.len().min(y.len())], &y[..x.len().min(y.len())]);
    let (quads, rest) = (x.chunks_exact(4).zip(y.chunks_exact(4)), x.len() / 4 * 4);
    for (a, b) in quads {
        (0..4).for_each(|lane| lanes[lane] += a[lane] * b[lane]);
    }
    let tail: f64 = x[rest..].iter().zip(&y[rest..]).map(|(a, b)| a * b).sum();
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]) + tail
}

/// Adds a multiple of a row to another.
#[inline(always)]
pub(crate) fn add_multiple(to: &mut [f64], factor: f64, row: &[f64]) {
    to.iter_mut().zip(row).for_each(|(t, r)| *t += factor * r);
}

/// Raises each entry to the magnitude of that of a row.
#[inline(always)]
pub(crate) fn raise(to: &mut [f64], row: &[f64]) {
    to.iter_mut().zip(row).for_each(|(t, r)| *t = if r.abs() > *t { r.abs() } else { *t });
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
    }
}
