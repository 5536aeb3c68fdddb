//! Divided differences of the exponential, also where their arguments meet.
//!
//! `e_1(z) = exp[0, z] = (exp(z) - 1)/z` and `e_2(z) = exp[0, 0, z] = (e_1(z) - 1)/z` are entire functions:
//!
//! `e_2(z) = sum_m z^m/(m + 2)!`, `e_1(z) = 1 + z e_2(z)`, `exp(z) = 1 + z e_1(z)`.
//!
//! Up to the magnitude 1 the series serves, whose terms do not cancel; beyond, the quotients lose no digit
//! relative to the larger one of `1/|z|` and the function.

use faer::c64;

/// Terms of the series: the next is below `1/22!`, 9e-22.
const TERMS: u32 = 20;

/// `[e_1(z), e_2(z)]`.
pub(super) fn divided(z: f64) -> [f64; 2] {
    if z.abs() <= 1.0 {
        let second = (0..TERMS).rev().fold(0.0, |sum, m| (1.0 + z * sum) / f64::from(m + 2));
        return [1.0 + z * second, second];
    }
    let first = z.exp_m1() / z;
    [first, (first - 1.0) / z]
}

/// `[e_1(z), e_2(z)]` of a complex number.
pub(super) fn complex_divided(z: c64) -> [c64; 2] {
    let one = c64::new(1.0, 0.0);
    if z.norm() <= 1.0 {
        let zero = c64::new(0.0, 0.0);
        let second = (0..TERMS).rev().fold(zero, |sum, m| (one + z * sum) / f64::from(m + 2));
        return [one + z * second, second];
    }
    let first = (z.exp() - one) / z;
    [first, (first - one) / z]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `e_1(z) = int_0^1 exp(z u) du`, `e_2(z) = int_0^1 (1 - u) exp(z u) du` (Hermite and Genocchi), by
    /// Simpson's rule with 4000 panels, whose error is below `(|z|/2000)^4/180`.
    #[test]
    fn divided_differences_are_the_integrals_of_hermite_and_genocchi() {
        let panels = 4000;
        for radius in [0.0, 1e-9, 1e-3, 0.3, 0.999, 1.001, 2.5, 12.0] {
            for angle in [0.0_f64, 0.7, 1.6, 2.4, std::f64::consts::PI] {
                let z = c64::new(angle.cos(), angle.sin()) * radius;
                let mut sums = [c64::new(0.0, 0.0); 2];
                for k in 0..=panels {
                    let u = f64::from(k) / f64::from(panels);
                    let end = k == 0 || k == panels;
                    let weight = if end { 1.0 } else { 2.0 * f64::from(1 + k % 2) };
                    let value = (z * u).exp() * (weight / (3.0 * f64::from(panels)));
                    sums = [sums[0] + value, sums[1] + value * (1.0 - u)];
                }
                for (found, expected) in complex_divided(z).into_iter().zip(sums) {
                    let error = (found - expected).norm() / (1.0 + expected.norm());
                    assert!(error < 1e-11, "{z}: {found} {expected}");
                }
                if z.im.abs() < 1e-15 {
                    for (found, expected) in divided(z.re).into_iter().zip(complex_divided(z)) {
                        assert!((found - expected.re).abs() < 4e-16 * (1.0 + expected.re), "{z}");
                    }
                }
            }
        }
    }
}
