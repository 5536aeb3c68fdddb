//! The spectrum of the acceleration of an orbit.

use std::f64::consts::TAU;

use hammerbeam_signal::spectrum::{Window, amplitude_spectrum};

/// Harmonics that are carried at most.
const MOST_HARMONICS: usize = 600;

/// Amplitudes of the harmonics of the acceleration up to a frequency, from samples of the displacement `y` at
/// equal steps: `(2 pi k f)^2 |y_k|`.
///
/// The displacement is smoother than the acceleration by two orders, so that what aliasing adds is smaller by
/// as much; the harmonics of a Hertz contact fall like `k^-3.5`. There are none of a displacement that is not
/// finite.
pub fn spectrum(samples: &[f64], base_hz: f64, highest_hz: f64) -> Vec<f64> {
    let count = samples.len();
    let harmonics =
        ((highest_hz / base_hz) as usize).clamp(20, MOST_HARMONICS).min(count.saturating_sub(1) / 2);
    let rate_hz = base_hz * count as f64;
    let Ok(lines) = amplitude_spectrum(samples, rate_hz, Window::Rectangular) else { return Vec::new() };
    let acceleration = |(k, value): (usize, f64)| value * (TAU * k as f64 * base_hz).powi(2);
    lines.values.into_iter().enumerate().skip(1).take(harmonics).map(acceleration).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `y = cos(2 pi f t) + 1e-3 cos(2 pi 5 f t + 1)`: harmonics 1 and 5 of the acceleration, and no other.
    #[test]
    fn amplitudes_are_those_of_the_acceleration() {
        let at = |k: usize| TAU * k as f64 / 128.0;
        let samples: Vec<f64> = (0..128).map(|k| at(k).cos() + 1e-3 * (5.0 * at(k) + 1.0).cos()).collect();
        let found = spectrum(&samples, 2.0, 60.0);
        assert_eq!(found.len(), 30);
        for (harmonic, amplitude) in (1..).zip(found) {
            let rate = TAU * 2.0 * f64::from(harmonic);
            let meant = match harmonic {
                1 => rate * rate,
                5 => 1e-3 * rate * rate,
                _ => 0.0,
            };
            // Rounding of 128 terms, relative to the larger amplitude of the displacement.
            assert!((amplitude - meant).abs() < 1e-13 * rate * rate, "{harmonic}: {amplitude}");
        }
    }

    #[test]
    fn what_is_not_finite_has_no_spectrum() {
        assert!(spectrum(&[0.0, f64::NAN, 1.0, 2.0], 1.0, 20.0).is_empty());
        assert!(spectrum(&[], 1.0, 20.0).is_empty());
    }
}
