//! Amplitude spectrum of a whole record, and the lines in it.
//!
//! A line between two bins is located by the parabola through the logarithms of the three values about a maximum: at `delta` bins from it,
//! `delta = (a - c) / (2 (a - 2b + c))` with `a, b, c` these logarithms, and the line's amplitude is `exp(b - (a - c) delta / 4)`. For a Hann window that is
//! within 0.016 bins and 4 % (the rectangular window knows no such rule: its values are those of the bin).

use super::Window;
use crate::{
    error::{SignalError, ensure_series},
    fourier,
};

/// Values over frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// Distance of the values [Hz]; the first is at zero.
    pub step_hz: f64,
    /// The values, up to half the sampling rate.
    pub values: Vec<f64>,
}

/// A maximum of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Where [Hz].
    pub frequency_hz: f64,
    /// How high.
    pub value: f64,
}

/// Amplitudes of a series.
///
/// The mean is taken off before the window is put on, so that it does not leak into low frequencies; it stands at zero.
///
/// # Errors
/// [`SignalError::TooShort`], [`SignalError::NotFinite`].
pub fn amplitude_spectrum(
    series: &[f64],
    sampling_rate_hz: f64,
    window: Window,
) -> Result<Spectrum, SignalError> {
    ensure_series("a spectrum", series, 2)?;
    let length = series.len();
    let mean = series.iter().sum::<f64>() / length as f64;
    let weights = window.values(length);
    let sum: f64 = weights.iter().sum();
    let windowed = series.iter().zip(&weights).map(|(value, weight)| (value - mean) * weight).collect();
    let spectrum = fourier::forward(windowed);
    let value = |(k, x): (usize, &realfft::num_complex::Complex<f64>)| {
        let single = k == 0 || 2 * k == length;
        x.norm() * if single { 1.0 } else { 2.0 } / sum
    };
    let mut values: Vec<f64> = spectrum.iter().enumerate().map(value).collect();
    values[0] = mean.abs();
    Ok(Spectrum { step_hz: sampling_rate_hz / length as f64, values })
}

impl Spectrum {
    /// Frequency of a value [Hz].
    #[must_use]
    pub fn frequency_hz(&self, index: usize) -> f64 {
        index as f64 * self.step_hz
    }

    /// The highest lines, highest first.
    ///
    /// * `count`: how many at most.
    /// * `apart`: bins within which only the highest counts.
    #[must_use]
    pub fn lines(&self, count: usize, apart: usize) -> Vec<Line> {
        let values = &self.values;
        let mut maxima: Vec<usize> = (1..values.len().saturating_sub(1))
            .filter(|&k| values[k] > values[k - 1] && values[k] >= values[k + 1])
            .collect();
        maxima.sort_by(|&one, &other| values[other].total_cmp(&values[one]).then(one.cmp(&other)));
        let mut chosen: Vec<usize> = Vec::new();
        for index in maxima {
            if chosen.len() == count {
                break;
            }
            if chosen.iter().all(|other| other.abs_diff(index) > apart) {
                chosen.push(index);
            }
        }
        chosen.into_iter().map(|index| self.line(index)).collect()
    }

    fn line(&self, index: usize) -> Line {
        let [a, b, c] = [-1, 0, 1]
            .map(|shift: isize| self.values[index.saturating_add_signed(shift)].max(f64::MIN_POSITIVE).ln());
        let curvature = a - 2.0 * b + c;
        let shift = if curvature < 0.0 { ((a - c) / (2.0 * curvature)).clamp(-0.5, 0.5) } else { 0.0 };
        Line { frequency_hz: (index as f64 + shift) * self.step_hz, value: (b - (a - c) * shift / 4.0).exp() }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn harmonic(frequency: f64, amplitude: f64) -> Vec<f64> {
        (0..2000)
            .map(|k| 0.25 + amplitude * (2.0 * PI * frequency * f64::from(k) / 1000.0 + 0.3).sin())
            .collect()
    }

    #[test]
    fn line_on_a_bin_has_its_amplitude_with_every_window() {
        for window in [Window::Rectangular, Window::Hann, Window::Hamming, Window::Blackman, Window::FlatTop]
        {
            let spectrum = amplitude_spectrum(&harmonic(50.0, 1.7), 1000.0, window).unwrap();
            assert!((spectrum.values[100] - 1.7).abs() < 1e-12, "{window:?}");
            assert!((spectrum.values[0] - 0.25).abs() < 1e-12);
        }
    }

    #[test]
    fn line_between_bins_is_located() {
        for frequency in [50.1, 50.25, 50.4] {
            let spectrum = amplitude_spectrum(&harmonic(frequency, 1.7), 1000.0, Window::Hann).unwrap();
            let line = spectrum.lines(1, 3)[0];
            assert!((line.frequency_hz - frequency).abs() < 0.017 * 0.5, "{line:?}");
            assert!((line.value / 1.7 - 1.0).abs() < 0.04, "{line:?}");
        }
    }

    #[test]
    fn flat_top_keeps_the_amplitude_between_bins() {
        let spectrum = amplitude_spectrum(&harmonic(50.25, 1.7), 1000.0, Window::FlatTop).unwrap();
        // 0.01 dB is 0.12 %.
        assert!((spectrum.values[100].max(spectrum.values[101]) / 1.7 - 1.0).abs() < 1.2e-3);
    }
}
