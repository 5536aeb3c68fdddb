//! Averages of spectra over overlapping segments.

use realfft::RealFftPlanner;

use super::{
    amplitude::{FrequencySpectrum, ROUNDING},
    window::Window,
};
use crate::error::{SignalError, ensure, ensure_series};

/// Meaning of the values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scaling {
    /// Spectral density [unit²/Hz].
    Density,
    /// Power [unit²].
    Power,
}

/// What is subtracted from each segment before its transform.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detrend {
    /// Nothing.
    None,
    /// Its mean.
    Constant,
    /// Its regression line.
    Linear,
}

/// How a series is divided into segments and evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WelchSettings {
    /// Samples of a segment.
    pub segment: usize,
    /// Samples that neighbouring segments share.
    pub overlap: usize,
    /// The window.
    pub window: Window,
    /// Meaning of the values.
    pub scaling: Scaling,
    /// What is subtracted.
    pub detrend: Detrend,
}

impl WelchSettings {
    /// Segments of a length that overlap by half, with a Hann window, densities, mean removed.
    #[must_use]
    pub const fn with_segment(segment: usize) -> Self {
        Self {
            segment,
            overlap: segment / 2,
            window: Window::Hann,
            scaling: Scaling::Density,
            detrend: Detrend::Constant,
        }
    }
}

/// Spectral density or power, averaged over segments.
///
/// # Errors
/// [`SignalError::TooShort`] if there is no whole segment, [`SignalError::Input`] for an invalid segment or
/// overlap.
pub fn welch(
    series: &[f64],
    sampling_rate_hz: f64,
    settings: &WelchSettings,
) -> Result<FrequencySpectrum, SignalError> {
    let WelchSettings { segment: length, overlap, window, scaling, detrend } = *settings;
    ensure("the length of a segment", length as f64, "at least 2 samples", length >= 2)?;
    ensure(
        "the overlap",
        overlap as f64,
        format!("less than the segment, {length} samples"),
        overlap < length,
    )?;
    ensure_series("a spectrum by segments", series, length)?;
    let weights = window.values(length);
    let scale = match scaling {
        Scaling::Density => 1.0 / (sampling_rate_hz * weights.iter().map(|w| w * w).sum::<f64>()),
        Scaling::Power => weights.iter().sum::<f64>().powi(-2),
    };
    let transform = RealFftPlanner::new().plan_fft_forward(length);
    let mut scratch = transform.make_scratch_vec();
    let mut spectrum = transform.make_output_vec();
    let mut values = vec![0.0; spectrum.len()];
    let mut count = 0;
    let mut segment = vec![0.0; length];
    for start in (0..=series.len() - length).step_by(length - overlap) {
        segment.copy_from_slice(&series[start..start + length]);
        remove_trend(&mut segment, detrend);
        segment.iter_mut().zip(&weights).for_each(|(value, weight)| *value *= weight);
        transform
            .process_with_scratch(&mut segment, &mut spectrum, &mut scratch)
            .expect("the lengths match the plan");
        values.iter_mut().zip(&spectrum).for_each(|(value, x)| *value += x.norm_sqr());
        count += 1;
    }
    for (k, value) in values.iter_mut().enumerate() {
        let single = k == 0 || 2 * k == length;
        *value *= scale * if single { 1.0 } else { 2.0 } / f64::from(count);
    }
    let largest = series.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let rounding = scale * (ROUNDING * largest * weights.iter().sum::<f64>()).powi(2);
    Ok(FrequencySpectrum { step_hz: sampling_rate_hz / length as f64, values, rounding, window })
}

/// Subtracts the mean or the regression line.
fn remove_trend(series: &mut [f64], detrend: Detrend) {
    if detrend == Detrend::None {
        return;
    }
    let n = series.len() as f64;
    let mean = series.iter().sum::<f64>() / n;
    let middle = (n - 1.0) / 2.0;
    let slope = if detrend == Detrend::Linear && series.len() > 1 {
        let moment: f64 = series.iter().enumerate().map(|(k, value)| (k as f64 - middle) * value).sum();
        moment * 12.0 / (n * (n * n - 1.0))
    } else {
        0.0
    };
    for (k, value) in series.iter_mut().enumerate() {
        *value -= mean + slope * (k as f64 - middle);
    }
}
