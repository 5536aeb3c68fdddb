//! The orbit that is most alike, and those that the record cannot separate from it.
//!
//! The noise is in the record: its waveform is `a = h b + e`, with the orbit `b` as it is delayed, so that an
//! orbit leaves `u = |a - h b|^2/aa`. With the correlation `c` and `x = h sqrt(bb/aa)` that is
//!
//! `u = 1 - 2 x c + x^2`
//!
//! The most alike orbit leaves least. A given factor `g` on the record is `h = 1/|g|`: `u = |g a - b|^2/(g^2
//! aa)`, where `|g a - b|^2/bb` would be small for whatever orbit is large. Without it `h` is whatever leaves
//! least, `x = c` and `u = 1 - c^2`; where `c` is negative, nothing of the orbit leaves less than its mirror
//! image, `x = 0`. (The fitted factor is not `1/h`: it brings `a` closest to `b`, and `g^2` takes a part
//! `c^2` of the orbit for the record. `|g a - b|^2/(g^2 aa) = (1 - c^2)/c^2` would magnify differences by
//! `1/c^4`.)
//!
//! Let the record be of an orbit of a branch. If `e` is small and white, the frequency that leaves least is
//! off by what one degree of freedom of `e`, along the change of `h b` with the frequency, makes of it; there
//! `u` is less than at the true one by the square of this one degree. So the true one is among those whose
//! `u` is above the least by less than 3.84 variances of a degree of freedom (chi-squared, 95 %). Pieces
//! scatter by `s` (root mean square), their mean over `P` pieces by `s/sqrt(P)`, in `2 L` degrees for `L`
//! lines: the variance is `s^2/(2 L P)` over the mean square of `a`. Noise that is not white, as from before
//! a filter, has more in some degrees than in others; then this is an order of magnitude.

use hammerbeam_signal::waveform::{Alignment, Waveform};

use super::{
    candidates::SPACING,
    found::{Alike, Overlay},
};

/// Chi-squared of one freedom that is exceeded with 5 %.
const CHI_SQUARED: f64 = 3.84;
/// Difference of squares that is none: folding a record knows values between its samples to some 1e-5.
const NONE: f64 = 1e-9;

/// The place of the orbit that leaves least of the measured waveform; of equal ones that with the largest
/// correlation, and the first of those, whatever the number of threads.
pub(super) fn most_alike(laid: &[Overlay], given: Option<f64>) -> Option<usize> {
    let order = |one: &Overlay| (left(one.alignment, given), -one.alignment.correlation);
    (0..laid.len()).reduce(|best, one| if order(&laid[one]) < order(&laid[best]) { one } else { best })
}

pub(super) fn alike(
    laid: &[Overlay],
    best: &Overlay,
    measured: &Waveform,
    given: Option<f64>,
) -> Option<Alike> {
    let left = |one: &Overlay| left(one.alignment, given);
    let most = left(best) + separable(measured, best.alignment.sizes.0);
    // Neighbours on a branch are nearly the same orbit.
    let apart = |one: &&Overlay| {
        let distance = (one.frequency_hz / best.frequency_hz - 1.0).abs();
        one.branch != best.branch || distance > 2.0 * SPACING
    };
    let others: Vec<&Overlay> = laid.iter().filter(apart).filter(|one| left(one) <= most).collect();
    let mut branches: Vec<u32> = others.iter().map(|one| one.branch).collect();
    branches.sort_unstable();
    branches.dedup();
    let frequencies = others.iter().map(|one| one.frequency_hz);
    let frequency_hz =
        frequencies.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), f| (low.min(f), high.max(f)));
    (!others.is_empty()).then_some(Alike { count: others.len(), branches, frequency_hz })
}

/// Difference of squares that a record can show, over the mean square of its waveform.
///
/// * `size`: root mean square of the waveform.
pub(super) fn separable(measured: &Waveform, size: f64) -> f64 {
    let freedom = 2.0 * measured.lines as f64 * measured.pieces as f64;
    NONE.max(CHI_SQUARED * (measured.scatter / size).powi(2) / freedom)
}

/// Square of what an orbit leaves of the measured waveform, over the square of that; `given` is the factor on
/// the measured one, if it is.
fn left(alignment: Alignment, given: Option<f64>) -> f64 {
    let ((measured, computed), correlation) = (alignment.sizes, alignment.correlation);
    let explained = given.map_or(correlation.max(0.0), |factor| computed / (factor.abs() * measured));
    1.0 - 2.0 * explained * correlation + explained * explained
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use hammerbeam_signal::{
        random::RandomSource,
        waveform::{Shifts, align, band_limited},
    };

    use super::*;

    const LENGTH: usize = 256;
    const LINES: usize = 120;
    const PIECES: usize = 20;

    /// An orbit of a branch along which the second harmonic makes room for the third; its frequency is `1 +
    /// p`.
    fn orbit(p: f64) -> Vec<f64> {
        let at =
            |t: f64| (TAU * t).cos() + p * (2.0 * TAU * t).sin() + (1.0 - p) * (3.0 * TAU * t + 1.0).cos();
        (0..LENGTH).map(|k| at(k as f64 / LENGTH as f64)).collect()
    }

    /// An orbit laid under a record.
    fn laid(p: f64, record: &[f64]) -> Overlay {
        let alignment = align(record, &orbit(p), Shifts::Any).unwrap();
        aligned(1.0 + p, alignment)
    }

    fn aligned(frequency_hz: f64, alignment: Alignment) -> Overlay {
        Overlay {
            frequency_hz,
            branch: 1,
            row: None,
            alignment,
            turned_correlation: 0.0,
            factor: alignment.factor,
            residual_before: alignment.residual(1.0),
            residual_after: alignment.residual(alignment.factor),
            filtered: Vec::new(),
            unfiltered: Vec::new(),
            displacement: Vec::new(),
            supports: Vec::new(),
            largest: (0.0, 0.0),
            alike: None,
            tried: 0,
            skipped: 0,
        }
    }

    /// The mean of pieces of the orbit in the middle, delayed by a tenth and half as large, with white noise
    /// of so many times its size.
    fn record(noise: f64, random: &mut RandomSource) -> Waveform {
        let orbit = orbit(0.5);
        let size = (orbit.iter().map(|b| b * b).sum::<f64>() / LENGTH as f64).sqrt();
        let white: Vec<f64> = (0..LENGTH).map(|_| random.normal()).collect();
        // Of white noise the lines keep their part of the degrees of freedom.
        let kept = band_limited(&white, LENGTH, LINES).unwrap();
        let part = (2.0 * LINES as f64 / LENGTH as f64).sqrt();
        let sample =
            |k: usize| 0.5 * (orbit[(k + LENGTH - LENGTH / 10) % LENGTH] + noise * size * kept[k] / part);
        let scatter = 0.5 * noise * size * (PIECES as f64).sqrt();
        let samples = (0..LENGTH).map(sample).collect();
        Waveform { samples, per_period: LENGTH, lines: LINES, pieces: PIECES, scatter }
    }

    /// Of 400 records 380 ± 4.4 should have the orbit that they are of among those that are counted: within
    /// three of these standard deviations.
    fn assert_covered(noise: f64, given: Option<f64>, correlations: std::ops::Range<f64>) {
        let mut random = RandomSource::new(11);
        let (mut covered, mut correlation) = (0, 0.0);
        for _ in 0..400 {
            let measured = record(noise, &mut random);
            let tried: Vec<Overlay> =
                (0..=100).map(|k| laid(f64::from(k) / 100.0, &measured.samples)).collect();
            let best = &tried[most_alike(&tried, given).unwrap()];
            let alike = alike(&tried, best, &measured, given);
            let (low, high) = alike.map_or((f64::INFINITY, f64::NEG_INFINITY), |alike| alike.frequency_hz);
            covered += i32::from(best.frequency_hz == 1.5 || (low..=high).contains(&1.5));
            correlation += best.alignment.correlation / 400.0;
        }
        assert!(correlations.contains(&correlation), "{correlation}");
        assert!((covered - 380).abs() <= 14, "{covered} of 400 at noise {noise}, {given:?}");
    }

    #[test]
    fn true_orbit_is_among_those_that_are_told_in_95_of_100_cases() {
        for (noise, correlations) in [(0.2, 0.97..0.99), (0.9, 0.72..0.78), (1.2, 0.6..0.68)] {
            assert_covered(noise, None, correlations.clone());
            assert_covered(noise, Some(2.0), correlations);
        }
    }

    /// Cosines of one form, 0.2 to 4.2 times as large as the one of the record. With noise of its own size
    /// the residual over the orbit is least at the size 2, since `|a - s b|^2 = 2 bb - 2 s bb + s^2 bb`.
    #[test]
    fn given_factor_finds_the_size_of_the_orbit_through_noise() {
        let cosine: Vec<f64> = (0..LENGTH).map(|k| (TAU * k as f64 / LENGTH as f64).cos()).collect();
        // Noise in other lines, as large as the cosine.
        let noisy = |k: usize| cosine[k] + (5.0 * TAU * k as f64 / LENGTH as f64).sin();
        for factor in [1.0, 0.5] {
            let record: Vec<f64> = (0..LENGTH).map(|k| noisy(k) / factor).collect();
            let sized = |size: f64| {
                let orbit: Vec<f64> = cosine.iter().map(|value| size * value).collect();
                let alignment = align(&record, &orbit, Shifts::Any).unwrap();
                Overlay { residual_after: alignment.residual(factor), ..aligned(size, alignment) }
            };
            let tried: Vec<Overlay> = (0..=400).map(|k| sized(0.2 + 0.01 * f64::from(k))).collect();
            let best = &tried[most_alike(&tried, Some(factor)).unwrap()];
            assert!((best.frequency_hz - 1.0).abs() < 1e-9, "{}", best.frequency_hz);
            assert!((best.alignment.correlation - 0.5_f64.sqrt()).abs() < 1e-6);
            // Not the least of the residuals that are counted.
            assert!(tried.iter().any(|one| one.residual_after < 0.8 * best.residual_after));
        }
        assert_eq!(most_alike(&[], None), None);
    }

    /// An orbit whose mirror image is alike is not.
    #[test]
    fn mirror_image_explains_nothing() {
        let still = Shifts::NearWhole { period: LENGTH, most: 0.0 };
        let turned: Vec<f64> = orbit(0.5).iter().map(|value| -value).collect();
        let alignment = align(&turned, &orbit(0.5), still).unwrap();
        assert!(alignment.correlation < -0.999);
        assert_eq!(left(alignment, None), 1.0);
    }
}
