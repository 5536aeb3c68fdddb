//! The exponential of a small matrix by scaling and squaring.

/// A square matrix, row by row.
pub(super) type Square<const N: usize> = [[f64; N]; N];

/// Norm up to which Taylor's series serves: what it leaves out is below `0.5^19/19!`, 2e-23.
const SERVED: f64 = 0.5;
/// Terms of the series behind the first.
const TERMS: i32 = 18;

/// `exp(A t)` by Taylor's series of `A t/2^j` and j squarings.
pub(super) fn exponential<const N: usize>(system: &Square<N>, time: f64) -> Square<N> {
    let norm =
        system.iter().map(|row| row.iter().map(|v| v.abs()).sum::<f64>()).fold(0.0, f64::max) * time.abs();
    let squarings = if norm > SERVED { (norm / SERVED).log2().ceil() as i32 } else { 0 };
    let scaled = system.map(|row| row.map(|value| value * time / 2f64.powi(squarings)));
    let mut sum = [[0.0; N]; N];
    (0..N).for_each(|i| sum[i][i] = 1.0);
    let mut term = sum;
    for m in 1..=TERMS {
        term = multiply(&term, &scaled).map(|row| row.map(|value| value / f64::from(m)));
        (0..N).for_each(|i| (0..N).for_each(|j| sum[i][j] += term[i][j]));
    }
    for _ in 0..squarings {
        sum = multiply(&sum, &sum);
    }
    sum
}

fn multiply<const N: usize>(x: &Square<N>, y: &Square<N>) -> Square<N> {
    let mut product = [[0.0; N]; N];
    for i in 0..N {
        for k in 0..N {
            for j in 0..N {
                product[i][j] += x[i][k] * y[k][j];
            }
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `exp([a b; 0 a]) = exp(a) [1 b; 0 1]`, and a rotation, over short and long times.
    #[test]
    fn exponentials_of_a_jordan_block_and_of_a_rotation_are_the_closed_forms() {
        for time in [0.0, 1e-3, 0.4, 7.0, 60.0] {
            let jordan = exponential(&[[-0.3, 2.0], [0.0, -0.3]], time);
            let decay = (-0.3 * time).exp();
            let rotation = exponential(&[[0.0, -1.0], [1.0, 0.0]], time);
            let (sin, cos) = time.sin_cos();
            for (found, expected) in
                [(jordan, [[decay, 2.0 * time * decay], [0.0, decay]]), (rotation, [[cos, -sin], [sin, cos]])]
            {
                for (x, y) in found.as_flattened().iter().zip(expected.as_flattened()) {
                    assert!((x - y).abs() < 2e-14 * (1.0 + time), "{time}: {x} {y}");
                }
            }
        }
    }
}
