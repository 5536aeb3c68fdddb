//! The 0-1 test for chaos: a second opinion beside the exponents, from one observable alone.
//! Equations (E7) and (E8) of the book, `docs/theory`.
//!
//! A series `x_1 .. x_N` drives a point in the plane, `p(n) = sum_(j<=n) x_j cos(j c)`, `q(n) = sum_(j<=n)
//! x_j sin(j c)`. Regular motion leaves the point bounded for almost every `c`, chaotic motion lets it
//! diffuse. With the mean square displacement
//!
//! `M(n) = 1/(N - n_cut) sum_j (p(j + n) - p(j))^2 + (q(j + n) - q(j))^2`, `n = 1 .. n_cut = N/10`,
//!
//! `K_c` is the correlation of `M(n)` with `n`. The median K over [`ANGLES`] values of `c` is near 0 for
//! regular and near 1 for chaotic motion. The series has to be sampled about as often as the motion changes:
//! once in an excitation period.
//!
//! **Bands.** The source subtracts from `M` the oscillation that the mean of the series causes. Chaos of a
//! structure with stops often jumps between two or more bands in a fixed order; the order is a strong
//! periodic part, whose oscillation hides the diffusion in the same way. So the mean of every [`CLASSES`]-th
//! value is subtracted from the series itself, for each remainder: what has the period 1, 2, 3, 4, 6, 8, 12
//! or 24 is gone, and with it the oscillation. Regular motion stays regular.
//!
//! # Source
//! Gottwald and Melbourne, Proc. R. Soc. A 460 (2004), 603-611; SIAM J. Appl. Dyn. Syst. 8 (2009), 129-145,
//! which is what is done here, apart from the bands.

use std::f64::consts::PI;

/// Number of values of `c`.
const ANGLES: usize = 100;
/// Period whose divisors are taken out of the series.
const CLASSES: usize = 24;
/// What is left of a series without its bands, relative to its spread, that is rounding and not motion.
const NOTHING_LEFT: f64 = 1e-8;
/// Least length of a series, ten values for each remainder; a thousand is usual.
pub const SHORTEST: usize = 10 * CLASSES;

/// K of a series: near 0 for regular motion, near 1 for chaotic motion.
///
/// # Returns
/// `None` for fewer than 240 values; 0 for a constant series and for one of a period that divides 24.
#[must_use]
pub fn zero_one(series: &[f64]) -> Option<f64> {
    if series.len() < SHORTEST {
        return None;
    }
    let mean = series.iter().sum::<f64>() / series.len() as f64;
    let spread = series.iter().map(|x| (x - mean).abs()).fold(0.0, f64::max);
    if spread <= 1e-12 * mean.abs() {
        return Some(0.0);
    }
    let centred = without_bands(series, spread);
    if centred.iter().all(|x| x.abs() <= NOTHING_LEFT) {
        return Some(0.0);
    }
    let mut correlations: Vec<f64> = (0..ANGLES).map(|k| correlation(&centred, angle(k))).collect();
    correlations.sort_by(f64::total_cmp);
    Some(0.5 * (correlations[ANGLES / 2 - 1] + correlations[ANGLES / 2]))
}

/// The series less the mean of every 24th value, over its spread.
fn without_bands(series: &[f64], spread: f64) -> Vec<f64> {
    let mut sums = [(0.0, 0.0); CLASSES];
    for (k, x) in series.iter().enumerate() {
        let (sum, count) = &mut sums[k % CLASSES];
        *sum += x;
        *count += 1.0;
    }
    series.iter().enumerate().map(|(k, x)| (x - sums[k % CLASSES].0 / sums[k % CLASSES].1) / spread).collect()
}

/// Angles spread over the middle of (0, pi) by the golden section, away from the resonances at its ends.
fn angle(k: usize) -> f64 {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    PI * (0.2 + 0.6 * (golden * (k as f64 + 0.5)).fract())
}

fn correlation(series: &[f64], c: f64) -> f64 {
    let (mut p, mut q) = (0.0, 0.0);
    let mut walk = Vec::with_capacity(series.len());
    for (j, x) in series.iter().enumerate() {
        let (sin, cos) = (c * (j + 1) as f64).sin_cos();
        p += x * cos;
        q += x * sin;
        walk.push((p, q));
    }
    let cut = series.len() / 10;
    let counted = series.len() - cut;
    let displacement = |n: usize| {
        let pairs = walk[..counted].iter().zip(&walk[n..]);
        let sum: f64 = pairs.map(|(a, b)| (b.0 - a.0).powi(2) + (b.1 - a.1).powi(2)).sum();
        sum / counted as f64
    };
    let displacements: Vec<f64> = (1..=cut).map(displacement).collect();
    let count = cut as f64;
    let (middle, average) = (0.5 * (count + 1.0), displacements.iter().sum::<f64>() / count);
    let (mut covariance, mut of_n, mut of_m) = (0.0, 0.0, 0.0);
    for (k, m) in displacements.iter().enumerate() {
        let (a, b) = ((k + 1) as f64 - middle, m - average);
        covariance += a * b;
        of_n += a * a;
        of_m += b * b;
    }
    if of_m > f64::MIN_POSITIVE { covariance / (of_n * of_m).sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn logistic(parameter: f64) -> Vec<f64> {
        let mut x = 0.3;
        let mut step = || {
            x = parameter * x * (1.0 - x);
            x
        };
        (0..1000).for_each(|_| _ = step());
        (0..2000).map(|_| step()).collect()
    }

    /// The logistic map in its chaotic range and with its period of eight, as Gottwald and Melbourne (2009)
    /// show them.
    #[test]
    fn logistic_map_is_chaotic_at_3_97_and_regular_at_3_55() {
        let chaotic = zero_one(&logistic(3.97)).unwrap();
        assert!(chaotic > 0.98, "{chaotic}");
        let regular = zero_one(&logistic(3.55)).unwrap();
        assert!(regular.abs() < 0.05, "{regular}");
    }

    #[test]
    fn two_incommensurate_frequencies_are_regular() {
        let series: Vec<f64> =
            (0..2000).map(|k| f64::from(k).sin() + 0.4 * (2f64.sqrt() * f64::from(k)).cos()).collect();
        let k = zero_one(&series).unwrap();
        assert!(k.abs() < 0.1, "{k}");
    }

    /// Chaos of a hundredth of the jump between two bands, which alone would hide it.
    #[test]
    fn chaos_in_two_narrow_bands_is_chaotic() {
        let series: Vec<f64> =
            logistic(3.97).iter().enumerate().map(|(k, x)| 0.01 * x + (k % 2) as f64).collect();
        let k = zero_one(&series).unwrap();
        assert!(k > 0.98, "{k}");
    }

    /// Rounding, which is as irregular as can be, on top of a period of two.
    #[test]
    fn rounding_of_a_periodic_motion_is_not_chaos() {
        let series: Vec<f64> =
            logistic(3.97).iter().enumerate().map(|(k, x)| 1e-12 * x + (k % 2) as f64).collect();
        assert_eq!(zero_one(&series), Some(0.0));
    }

    #[test]
    fn short_series_have_no_answer_and_constant_ones_are_regular() {
        assert_eq!(zero_one(&[1.0; 239]), None);
        assert_eq!(zero_one(&[1.0; 240]), Some(0.0));
    }
}
