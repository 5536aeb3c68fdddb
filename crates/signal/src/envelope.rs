//! The analytic signal: envelope and instantaneous phase.
//!
//! `z = x + i H(x)` with the Hilbert transform `H` has the spectrum of `x` at positive frequencies, doubled,
//! and none at negative ones. Its modulus is the envelope: for a decaying harmonic `A exp(-d t) cos(w t + p)`
//! it is `A exp(-d t)` for `d` much smaller than `w`. It is inaccurate near both ends of a record, since the
//! transform treats the record as periodic.
//!
//! # Source
//! Feldman, *Hilbert Transform Applications in Mechanical Vibration*, 2011, chapter 2.

use realfft::{num_complex::Complex, num_traits::Zero};
use rustfft::FftPlanner;

use crate::error::{SignalError, ensure_series};

/// The analytic signal of a series.
///
/// # Errors
/// [`SignalError::TooShort`], [`SignalError::NotFinite`].
pub fn analytic_signal(series: &[f64]) -> Result<Vec<Complex<f64>>, SignalError> {
    ensure_series("an envelope", series, 2)?;
    let length = series.len();
    let mut signal: Vec<Complex<f64>> = series.iter().map(|&value| Complex::new(value, 0.0)).collect();
    let mut planner = FftPlanner::new();
    planner.plan_fft_forward(length).process(&mut signal);
    for (k, value) in signal.iter_mut().enumerate() {
        if 2 * k > length {
            *value = Complex::zero();
        } else if k > 0 && 2 * k < length {
            *value *= 2.0;
        }
    }
    planner.plan_fft_inverse(length).process(&mut signal);
    signal.iter_mut().for_each(|value| *value /= length as f64);
    Ok(signal)
}

/// The envelope of a series about its mean.
///
/// # Errors
/// [`SignalError::TooShort`], [`SignalError::NotFinite`].
pub fn envelope(series: &[f64]) -> Result<Vec<f64>, SignalError> {
    let mean = series.iter().sum::<f64>() / series.len().max(1) as f64;
    let centred: Vec<f64> = series.iter().map(|value| value - mean).collect();
    Ok(analytic_signal(&centred)?.iter().map(|value| value.norm()).collect())
}
