//! Resampling of whole periods by their spectrum.

use realfft::{num_complex::Complex, num_traits::Zero};

use crate::{
    error::{SignalError, ensure, ensure_series},
    fourier::{backward, forward},
};

/// Resamples a periodic series.
///
/// The spectrum is truncated or padded with zeros. The value at half of the lower rate belongs to a positive
/// and a negative frequency: it is halved when these become separate values, and doubled when they merge.
///
/// * `length`: samples of the same duration afterwards.
///
/// # Errors
/// [`SignalError::Input`], [`SignalError::TooShort`], [`SignalError::NotFinite`].
pub fn resample_periodic(series: &[f64], length: usize) -> Result<Vec<f64>, SignalError> {
    ensure_series("resampling", series, 1)?;
    ensure("the number of samples", length as f64, "at least 1", length >= 1)?;
    let before = series.len();
    let mut spectrum = forward(series.to_vec());
    spectrum.resize(length / 2 + 1, Complex::zero());
    let shorter = before.min(length);
    if shorter.is_multiple_of(2) && length != before {
        spectrum[shorter / 2] *= if length < before { 2.0 } else { 0.5 };
    }
    let scale = length as f64 / before as f64;
    Ok(backward(spectrum, length).into_iter().map(|value| value * scale).collect())
}
