//! Waveforms over the periods of an excitation, and one laid over another.
//!
//! **Folding.** A record is read at phases of its excitation and averaged over all its pieces of `n` periods. The pieces scatter about their mean; that is what the measurement itself leaves open.
//!
//! **Laying over.** Two waveforms `a`, `b` of one length, about their means: with the coefficients `A_k`, `B_k` of their Fourier series
//!
//! `r(s) = sum a(t) b(t - s) = (2/N) Re sum_{k = 1}^{k < N/2} A_k conj(B_k) exp(2 pi i k s/N)`
//!
//! is the product of `a` with `b` delayed by `s` samples. The shift is where `r` is largest: on the grid of samples, then between them by Newton's method on
//! `r'`, which is exact for series that their samples determine. With `aa`, `bb` the squares of both, the correlation is `r/sqrt(aa bb)`, the factor that brings `a` closest to `b`
//! is `r/aa`, and a factor `g` leaves the residual `sqrt((g^2 aa - 2 g r + bb)/bb)` of the root mean square of `b`.

use std::f64::consts::TAU;

use realfft::num_complex::Complex;

use crate::{
    error::{SignalError, ensure, ensure_series},
    fourier::{backward, forward},
    resample::{Interpolation, REACH},
};

/// A record, averaged over its pieces of some excitation periods.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    /// Means at equal steps of the phase, from a multiple of the period on the record's own clock: sample `k` is at the time `k/(per_period f)`, modulo the period.
    pub samples: Vec<f64>,
    /// Samples in an excitation period.
    pub per_period: usize,
    /// Pieces that were averaged.
    pub pieces: usize,
    /// Root mean square of what the pieces differ from their mean by.
    pub scatter: f64,
}

/// Fewest pieces of a mean.
const PIECES: usize = 2;

/// Folds a record.
///
/// * `sampling_rate_hz`, `start_s`: of the record.
/// * `frequency_hz`: of the excitation.
/// * `periods`, `per_period`: excitation periods of a piece, and samples in each of them.
///
/// # Errors
/// [`SignalError::TooShort`] if fewer than two pieces are in it, [`SignalError::NotFinite`], [`SignalError::Input`].
pub fn folded(
    samples: &[f64],
    (sampling_rate_hz, start_s): (f64, f64),
    frequency_hz: f64,
    (periods, per_period): (usize, usize),
) -> Result<Waveform, SignalError> {
    ensure("the excitation frequency", frequency_hz, "more than 0", frequency_hz > 0.0)?;
    ensure("the number of periods", periods as f64, "at least 1", periods > 0)?;
    let samples_of_piece = periods as f64 * sampling_rate_hz / frequency_hz;
    let needed = (PIECES as f64 * samples_of_piece).ceil() as usize + 1;
    ensure_series("averaging over periods", samples, needed)?;
    let begin = start_s * frequency_hz / periods as f64;
    let end = begin + (samples.len() - 1) as f64 / samples_of_piece;
    // Beside the ends interpolation has too few samples: such pieces are taken only where there are too few others.
    let margin = REACH as f64 / samples_of_piece;
    let inner = ((begin + margin).ceil() as i64, (end - margin).floor() as i64);
    let enough = inner.1 - inner.0 >= PIECES as i64;
    let (first, last) = if enough { inner } else { (begin.ceil() as i64, end.floor() as i64) };
    let pieces = (last - first).max(0) as usize;
    if pieces < PIECES {
        // Pieces begin where the clock has a whole number of them.
        let needed = ((PIECES + 1) as f64 * samples_of_piece).ceil() as usize + 1;
        return Err(SignalError::TooShort { what: "averaging over periods", found: samples.len(), needed });
    }
    let interpolation = Interpolation::new();
    let length = periods * per_period;
    let (mut sums, mut squares) = (vec![0.0; length], vec![0.0; length]);
    let level = samples.iter().sum::<f64>() / samples.len() as f64;
    for piece in first..last {
        for k in 0..length {
            let place = (piece as f64 + k as f64 / length as f64 - begin) * samples_of_piece;
            let value = interpolation.at(samples, place) - level;
            sums[k] += value;
            squares[k] += value * value;
        }
    }
    let count = pieces as f64;
    let spread: f64 = sums.iter().zip(&squares).map(|(s, q)| (q - s * s / count).max(0.0)).sum();
    let scatter = (spread / (length as f64 * (count - 1.0))).sqrt();
    let samples = sums.iter().map(|sum| level + sum / count).collect();
    Ok(Waveform { samples, per_period, pieces, scatter })
}

/// Which shifts are allowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shifts {
    /// All.
    Any,
    /// Whole multiples of a period, and so much beside them.
    NearWhole {
        /// Samples of a period.
        period: usize,
        /// Largest distance from a multiple [samples].
        most: f64,
    },
}

impl Shifts {
    /// Signed distance from the nearest multiple, within the length of a period.
    fn beside(period: usize, shift: f64) -> f64 {
        let period = period as f64;
        shift - (shift / period).round() * period
    }

    fn allows(self, shift: f64) -> bool {
        match self {
            Self::Any => true,
            Self::NearWhole { period, most } => Self::beside(period, shift).abs() <= most + 1e-9,
        }
    }
}

/// How one waveform lies over another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Alignment {
    /// Samples by which the second one is to be delayed, 0 to less than its length.
    pub shift: f64,
    /// Correlation of both about their means, then.
    pub correlation: f64,
    /// Factor on the first one that brings it closest to the second; negative where it is the mirror image.
    pub factor: f64,
    /// Root mean squares of both about their means.
    pub sizes: (f64, f64),
}

impl Alignment {
    /// Root mean square of the difference, with a factor on the first one, over that of the second.
    #[must_use]
    pub fn residual(&self, factor: f64) -> f64 {
        let (a, b) = self.sizes;
        let ratio = factor * a / b;
        (ratio * ratio - 2.0 * ratio * self.correlation + 1.0).max(0.0).sqrt()
    }
}

/// Lays the second waveform over the first.
///
/// # Errors
/// [`SignalError::Input`] if the lengths differ, [`SignalError::TooShort`], [`SignalError::NotFinite`], [`SignalError::Constant`] if one of them does not move.
pub fn align(first: &[f64], second: &[f64], shifts: Shifts) -> Result<Alignment, SignalError> {
    for series in [first, second] {
        ensure_series("laying one waveform over another", series, 4)?;
    }
    let length = first.len();
    let allowed = format!("the {length} of the other one");
    ensure("the number of samples of a waveform", second.len() as f64, allowed, second.len() == length)?;
    let (a, b) = (forward(first.to_vec()), forward(second.to_vec()));
    let lines = || 1..length.div_ceil(2);
    let square = |of: &[Complex<f64>]| lines().map(|k| 2.0 * of[k].norm_sqr()).sum::<f64>() / length as f64;
    let (aa, bb) = (square(&a), square(&b));
    // What rounding leaves of a constant is no motion.
    let moves = |square: f64, of: &[Complex<f64>]| square > 1e-28 * of[0].norm_sqr() / length as f64;
    if aa <= 0.0 || bb <= 0.0 || !moves(aa, &a) || !moves(bb, &b) {
        return Err(SignalError::Constant);
    }
    let mut cross = vec![Complex::new(0.0, 0.0); a.len()];
    lines().for_each(|k| cross[k] = a[k] * b[k].conj());
    let products = backward(cross.clone(), length);
    let allowed = (0..length).filter(|shift| shifts.allows(*shift as f64));
    let best = allowed.max_by(|&i, &j| products[i].total_cmp(&products[j])).unwrap_or(0);
    let (shift, product) = refined(&cross, length, best as f64, shifts);
    Ok(Alignment {
        shift: shift.rem_euclid(length as f64),
        correlation: product / (aa * bb).sqrt(),
        factor: product / aa,
        sizes: ((aa / length as f64).sqrt(), (bb / length as f64).sqrt()),
    })
}

/// A waveform delayed by so many samples, which need not be whole.
///
/// # Errors
/// [`SignalError::TooShort`], [`SignalError::NotFinite`].
pub fn delayed(series: &[f64], shift: f64) -> Result<Vec<f64>, SignalError> {
    ensure_series("delaying a waveform", series, 2)?;
    let length = series.len();
    let mut spectrum = forward(series.to_vec());
    for (k, value) in spectrum.iter_mut().enumerate() {
        *value *= Complex::from_polar(1.0, -TAU * k as f64 * shift / length as f64);
    }
    Ok(backward(spectrum, length))
}

/// Newton's method from the best sample, within one sample of it.
fn refined(cross: &[Complex<f64>], length: usize, best: f64, shifts: Shifts) -> (f64, f64) {
    let at = |shift: f64| {
        let (mut value, mut slope, mut bend) = (0.0, 0.0, 0.0);
        for (k, line) in cross.iter().enumerate() {
            let w = TAU * k as f64 / length as f64;
            let turned = line * Complex::from_polar(2.0 / length as f64, w * shift);
            value += turned.re;
            slope -= w * turned.im;
            bend -= w * w * turned.re;
        }
        (value, slope, bend)
    };
    let mut found = (best, at(best).0);
    let mut shift = best;
    for _ in 0..20 {
        let (_, slope, bend) = at(shift);
        if bend >= 0.0 {
            break;
        }
        let step = -slope / bend;
        let next = (shift + step).clamp(best - 1.0, best + 1.0);
        let value = at(next).0;
        if !shifts.allows(next) || value < found.1 {
            break;
        }
        found = (next, value);
        if (next - shift).abs() <= 1e-12 * length as f64 {
            break;
        }
        shift = next;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Harmonics up to the sixth, at a phase in cycles.
    fn wave(phase: f64) -> f64 {
        (1..=6).map(|k| (TAU * f64::from(k) * phase + f64::from(k * k)).cos() / f64::from(k)).sum::<f64>()
            + 0.7
    }

    fn sampled(count: usize, from: f64) -> Vec<f64> {
        (0..count).map(|k| wave(k as f64 / count as f64 + from)).collect()
    }

    #[test]
    fn shift_factor_and_residual_are_those_that_were_put_in() {
        let b = sampled(64, 0.0);
        // Delayed by 13.37 samples, half as large, on another level.
        let a: Vec<f64> = sampled(64, -13.37 / 64.0).iter().map(|value| 0.5 * value + 3.0).collect();
        let found = align(&a, &b, Shifts::Any).unwrap();
        assert!((found.shift - 13.37).abs() < 1e-9, "{found:?}");
        assert!((found.correlation - 1.0).abs() < 1e-12 && (found.factor - 2.0).abs() < 1e-12, "{found:?}");
        // (1 - 1/2) of the size is left without the factor.
        assert!((found.residual(1.0) - 0.5).abs() < 1e-12 && found.residual(2.0) < 1e-6, "{found:?}");
        let moved = delayed(&b, found.shift).unwrap();
        assert!(moved.iter().zip(&a).all(|(b, a)| (0.5 * b + 3.0 - a).abs() < 1e-3), "{moved:?}");
        let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
        let level = mean(&a) - 0.5 * mean(&moved);
        assert!(moved.iter().zip(&a).all(|(b, a)| (0.5 * b + level - a).abs() < 1e-9));
    }

    #[test]
    fn mirror_image_has_a_negative_factor_only_where_no_shift_is_better() {
        let b: Vec<f64> = (0..32).map(|k| if k == 5 { 1.0 } else { 0.0 }).collect();
        let a: Vec<f64> = b.iter().map(|value| -value).collect();
        let still = Shifts::NearWhole { period: 32, most: 0.0 };
        let found = align(&a, &b, still).unwrap();
        assert!((found.factor + 1.0).abs() < 1e-12 && found.shift == 0.0, "{found:?}");
    }

    #[test]
    fn shifts_are_kept_near_whole_periods() {
        let b = sampled(64, 0.0);
        let a = sampled(64, -20.0 / 64.0);
        let near = Shifts::NearWhole { period: 32, most: 3.0 };
        let found = align(&a, &b, near).unwrap();
        assert!(
            (29.0..=35.0).contains(&found.shift) || found.shift <= 3.0 || found.shift >= 61.0,
            "{found:?}"
        );
        let wide = Shifts::NearWhole { period: 32, most: 12.5 };
        assert!((align(&a, &b, wide).unwrap().shift - 20.0).abs() < 1e-9);
    }

    #[test]
    fn record_is_folded_onto_its_own_clock() {
        // 2 Hz, whose waveform repeats after two periods, from 1.3 s on at 1 kHz.
        let value = |t: f64| (TAU * 2.0 * t).cos() + 0.5 * (TAU * t + 0.3).sin();
        let samples: Vec<f64> = (0..9_000).map(|k| value(1.3 + f64::from(k) * 1e-3)).collect();
        let found = folded(&samples, (1000.0, 1.3), 2.0, (2, 512)).unwrap();
        // From 2 to 10 s.
        assert_eq!((found.pieces, found.samples.len()), (8, 1024));
        for (k, sample) in found.samples.iter().enumerate() {
            // The interpolation's own error is 2e-5.
            assert!((sample - value(k as f64 / 1024.0)).abs() < 1e-4, "{k}: {sample}");
        }
        assert!(found.scatter < 1e-4);
    }

    #[test]
    fn scatter_is_the_noise() {
        let mut random = crate::random::Random::new(5);
        let samples: Vec<f64> =
            (0..40_000).map(|k| wave(f64::from(k) / 100.0) + 0.2 * random.normal()).collect();
        let found = folded(&samples, (100.0, 0.0), 1.0, (1, 100)).unwrap();
        // 400 pieces of 100 samples: 0.4 % standard error.
        assert!((found.scatter / 0.2 - 1.0).abs() < 0.02, "{}", found.scatter);
    }

    #[test]
    fn what_cannot_be_laid_over_is_refused() {
        let refused = |first: &[f64], second: &[f64]| align(first, second, Shifts::Any).unwrap_err();
        assert!(matches!(refused(&[1.0; 8], &sampled(8, 0.0)), SignalError::Constant));
        assert!(matches!(refused(&sampled(8, 0.0), &sampled(9, 0.0)), SignalError::Input { .. }));
        let short = folded(&sampled(64, 0.0), (64.0, 0.0), 1.0, (1, 8)).unwrap_err();
        assert!(matches!(short, SignalError::TooShort { .. }), "{short}");
    }
}
