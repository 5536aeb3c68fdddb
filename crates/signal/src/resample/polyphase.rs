//! Resampling by a rational factor.
//!
//! Conceptually, `up - 1` zeros are inserted between samples, the result is filtered, and every `down`-th
//! value is kept: with the centred filter `h`, `y_m = sum_k h(m down - k up) x_k`. The filter is a sinc with
//! a cut-off of `1 / max(up, down)` of half the fine rate, over 10 zeros on each side. It is multiplied by a
//! Kaiser window with `beta = 5` (ripple and stop band about 0.3 % and 53 dB) and scaled to gain one. The
//! series is zero outside its samples.
//!
//! # Source
//! Kaiser and Schafer, IEEE Trans. Acoust. Speech Signal Process. 28 (1980), 105-107; the parameters are
//! those of SciPy's `resample_poly`.

use std::f64::consts::PI;

use super::bessel::bessel_i0;
use crate::error::{SignalError, ensure, ensure_sample_count, ensure_series};

const BETA: f64 = 5.0;
/// Zeros of the sinc on each side.
const ZEROS: usize = 10;
/// Largest numerator and denominator of a ratio.
const LARGEST: usize = 10_000;

/// New sampling rate over old, in lowest terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ratio {
    up: usize,
    down: usize,
}

impl Ratio {
    /// `up / down`, reduced to lowest terms.
    ///
    /// # Errors
    /// [`SignalError::Input`] if one of them is zero or, reduced, more than 10 000.
    pub fn new(up: usize, down: usize) -> Result<Self, SignalError> {
        let divisor = greatest_common_divisor(up, down).max(1);
        let (up, down) = (up / divisor, down / divisor);
        for (what, number) in [("the factor up", up), ("the factor down", down)] {
            let holds = (1..=LARGEST).contains(&number);
            ensure(what, number as f64, format!("from 1 to {LARGEST}"), holds)?;
        }
        Ok(Self { up, down })
    }

    /// The ratio of two rates [Hz]: the first convergent of its continued fraction with an error below 1e-9.
    ///
    /// # Errors
    /// [`SignalError::Input`] if there is none with numbers up to 10 000.
    pub fn of_rates(new_hz: f64, old_hz: f64) -> Result<Self, SignalError> {
        let wanted = new_hz / old_hz;
        ensure("the new sampling rate", new_hz, "more than 0", new_hz > 0.0 && wanted.is_finite())?;
        let (mut before, mut last) = ((0.0, 1.0), (1.0, 0.0));
        let mut remainder = wanted;
        for _ in 0..40 {
            let whole = remainder.floor();
            let next = (whole * last.0 + before.0, whole * last.1 + before.1);
            (before, last) = (last, next);
            if next.0 > LARGEST as f64 || next.1 > LARGEST as f64 {
                break;
            }
            if next.0 > 0.0 && (next.0 / next.1 / wanted - 1.0).abs() < 1e-9 {
                return Self::new(next.0 as usize, next.1 as usize);
            }
            remainder = 1.0 / (remainder - whole);
        }
        let allowed = format!("in a ratio of whole numbers up to {LARGEST} to {old_hz} Hz");
        Err(SignalError::Input { what: "the new sampling rate", found: new_hz, allowed })
    }

    /// Its value.
    #[must_use]
    pub fn value(self) -> f64 {
        self.up as f64 / self.down as f64
    }
}

const fn greatest_common_divisor(mut a: usize, mut b: usize) -> usize {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// Resamples a series; the first sample keeps its time.
///
/// # Returns
/// `ceil(N up / down)` samples.
/// # Errors
/// [`SignalError::TooShort`], [`SignalError::NotFinite`].
pub fn resample(series: &[f64], ratio: Ratio) -> Result<Vec<f64>, SignalError> {
    ensure_series("resampling", series, 1)?;
    let Ratio { up, down } = ratio;
    if up == down {
        return Ok(series.to_vec());
    }
    let half = ZEROS * up.max(down);
    ensure_sample_count(series.len() as f64 * ratio.value())?;
    let filter = filter(half, up.max(down), up as f64);
    let length = (series.len() * up).div_ceil(down);
    let value = |m: usize| {
        // The filter's index is m down + half - k up, from 0 to 2 half.
        let position = m * down + half;
        let last = (position / up).min(series.len() - 1);
        let first = position.saturating_sub(2 * half).div_ceil(up);
        (first..=last).map(|k| filter[position - k * up] * series[k]).sum()
    };
    Ok((0..length).map(value).collect())
}

fn filter(half: usize, rate: usize, gain: f64) -> Vec<f64> {
    let cut_off = 1.0 / rate as f64;
    let taps: Vec<f64> = (0..=2 * half)
        .map(|n| {
            let x = n as f64 - half as f64;
            let part = x / half as f64;
            let sinc = if x == 0.0 { 1.0 } else { (PI * cut_off * x).sin() / (PI * cut_off * x) };
            sinc * bessel_i0(BETA * (1.0 - part * part).max(0.0).sqrt()) / bessel_i0(BETA)
        })
        .collect();
    let sum: f64 = taps.iter().sum();
    taps.into_iter().map(|tap| tap * gain / sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratio_of_rates_is_found() {
        assert_eq!(Ratio::of_rates(10_000.0, 12_800.0).unwrap(), Ratio { up: 25, down: 32 });
        assert_eq!(Ratio::of_rates(48_000.0, 44_100.0).unwrap(), Ratio { up: 160, down: 147 });
        assert_eq!(Ratio::of_rates(100.0, 1000.0).unwrap(), Ratio { up: 1, down: 10 });
        assert!(Ratio::of_rates(PI * 1000.0, 1000.0).is_err());
        assert!(Ratio::of_rates(-1.0, 1000.0).is_err());
    }
}
