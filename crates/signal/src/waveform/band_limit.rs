//! Periodic series with a limited number of harmonics.

use realfft::num_complex::Complex;

use crate::{
    error::{SignalError, ensure, ensure_series},
    fourier::{backward, forward},
};

/// A periodic series at another number of samples, with the lowest lines of its spectrum only.
///
/// * `length`: samples of the same duration afterwards.
/// * `lines`: the highest line that is kept, in cycles over the duration.
///
/// # Errors
/// [`SignalError::TooShort`], [`SignalError::NotFinite`]; [`SignalError::Input`] if half of the samples,
/// before or afterwards, cannot represent so many lines.
pub fn band_limited(series: &[f64], length: usize, lines: usize) -> Result<Vec<f64>, SignalError> {
    ensure_series("cutting a waveform to lines", series, 1)?;
    let most = (series.len().min(length).max(1) - 1) / 2;
    ensure("the number of lines", lines as f64, format!("at most {most}"), lines <= most)?;
    let mut spectrum = forward(series.to_vec());
    spectrum.truncate(lines + 1);
    spectrum.resize(length / 2 + 1, Complex::new(0.0, 0.0));
    let scale = length as f64 / series.len() as f64;
    Ok(backward(spectrum, length).into_iter().map(|value| value * scale).collect())
}
