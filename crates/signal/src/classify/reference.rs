//! The excitation frequency from a reference channel: an accelerometer on the shaker table, or the signal of
//! the generator.

use std::f64::consts::PI;

use crate::{
    decay::{Oscillation, fit},
    error::{SignalError, ensure_series},
    fourier,
    spectrum::Window,
};

/// Least fraction of the power in the line.
const MIN_POWER: f64 = 0.5;

/// Frequency of the strongest line of a series, by a fit of a harmonic signal to all samples [Hz].
///
/// # Errors
/// [`SignalError::NoReferenceLine`] if the line has less than half of the power; [`SignalError::TooShort`],
/// [`SignalError::NotFinite`], [`SignalError::Constant`], [`SignalError::FitNotConverged`].
pub fn excitation_frequency(series: &[f64], sampling_rate_hz: f64) -> Result<f64, SignalError> {
    ensure_series("a reference", series, 32)?;
    let length = series.len();
    let mean = series.iter().sum::<f64>() / length as f64;
    let variance = series.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / length as f64;
    if variance <= 0.0 {
        return Err(SignalError::Constant);
    }
    let weights = Window::Hann.values(length);
    let windowed = series.iter().zip(&weights).map(|(value, weight)| (value - mean) * weight).collect();
    let spectrum = fourier::forward(windowed);
    let size = |k: usize| spectrum.get(k).map_or(0.0, |value| value.norm());
    let line = (1..spectrum.len()).max_by(|&a, &b| size(a).total_cmp(&size(b))).unwrap_or(1);
    // For a Hann window the two largest values of a line have the ratio (1 + d)/(2 - d), d bins from the
    // larger one.
    let (neighbour, sign) =
        if size(line + 1) > size(line - 1) { (size(line + 1), 1.0) } else { (size(line - 1), -1.0) };
    let ratio = neighbour / size(line);
    let position = line as f64 + sign * (2.0 * ratio - 1.0) / (1.0 + ratio);
    let step = 1.0 / sampling_rate_hz;
    let frequency = 2.0 * PI * position * sampling_rate_hz / length as f64;
    let start = Oscillation { rate: 0.0, frequency, cosine: 0.0, sine: 0.0 };
    let amplitude = projection(series, mean, frequency * step);
    let found = fit(series, step, &[Oscillation { cosine: amplitude.0, sine: amplitude.1, ..start }])?;
    let remaining = found.residual.iter().map(|value| value * value).sum::<f64>() / length as f64;
    if remaining > (1.0 - MIN_POWER) * variance {
        return Err(SignalError::NoReferenceLine { percent: 100.0 * (1.0 - remaining / variance) });
    }
    Ok(found.oscillations[0].frequency / (2.0 * PI))
}

/// Amplitudes of cosine and sine at an angular frequency [rad per sample].
fn projection(series: &[f64], mean: f64, frequency: f64) -> (f64, f64) {
    let scale = 2.0 / series.len() as f64;
    series.iter().enumerate().fold((0.0, 0.0), |(cosine, sine), (k, value)| {
        let (s, c) = (frequency * k as f64).sin_cos();
        (cosine + scale * (value - mean) * c, sine + scale * (value - mean) * s)
    })
}
