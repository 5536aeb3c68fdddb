//! A low-pass filter on a periodic motion: the settled response of an instrument.
//!
//! A periodic signal `x = sum_k c_k exp(2 pi i k f t)` leaves a linear filter as `sum_k H(2 pi i k f) c_k
//! exp(2 pi i k f t)`: no transient, no time step. `H` is the response of the analogue Butterworth filter,
//!
//! `H(s) = prod_k -p_k/(s/w_c - p_k)`, `p_k = exp(i pi (2k + n + 1)/(2n))`, `|H(i w)|^2 = 1/(1 +
//! (w/w_c)^(2n))`.
//!
//! The coefficients are computed from the samples; lines above half the sampling rate are aliased before.

use std::f64::consts::PI;

use realfft::num_complex::Complex;

use crate::{
    error::{SignalError, ensure, ensure_series},
    fourier::{backward, forward},
};

/// Response of the analogue Butterworth low-pass filter at a frequency.
#[must_use]
pub fn low_pass_response(order: usize, cut_off_hz: f64, frequency_hz: f64) -> Complex<f64> {
    let s = Complex::new(0.0, frequency_hz / cut_off_hz);
    let pole = |k: usize| Complex::from_polar(1.0, PI * (2 * k + order + 1) as f64 / (2 * order) as f64);
    (0..order).map(pole).map(|p| -p / (s - p)).product()
}

/// The settled response of a low-pass filter to a periodic signal.
///
/// * `samples`: one period (or several), at equal steps.
/// * `duration_s`: duration of the samples [s].
/// * `filter`: order and cut-off frequency [Hz].
///
/// # Errors
/// [`SignalError::Input`], [`SignalError::TooShort`], [`SignalError::NotFinite`].
pub fn periodic_low_pass(
    samples: &[f64],
    duration_s: f64,
    filter: (usize, f64),
) -> Result<Vec<f64>, SignalError> {
    filtered(samples, duration_s, filter, |response| response)
}

/// The response of a filter that acts forwards and backwards: `|H|^2`, zero phase.
///
/// # Errors
/// As [`periodic_low_pass`].
pub fn periodic_zero_phase(
    samples: &[f64],
    duration_s: f64,
    filter: (usize, f64),
) -> Result<Vec<f64>, SignalError> {
    filtered(samples, duration_s, filter, |response| Complex::new(response.norm_sqr(), 0.0))
}

fn filtered(
    samples: &[f64],
    duration_s: f64,
    (order, cut_off_hz): (usize, f64),
    factor: impl Fn(Complex<f64>) -> Complex<f64>,
) -> Result<Vec<f64>, SignalError> {
    ensure_series("a filter", samples, 2)?;
    ensure("the duration", duration_s, "more than 0", duration_s > 0.0 && duration_s.is_finite())?;
    ensure(
        "the order of the filter",
        order as f64,
        "a whole number from 1 to 32",
        (1..=32).contains(&order),
    )?;
    let positive = cut_off_hz > 0.0 && cut_off_hz.is_finite();
    ensure("the cut-off of the low-pass filter", cut_off_hz, "more than 0", positive)?;
    let mut spectrum = forward(samples.to_vec());
    for (k, value) in spectrum.iter_mut().enumerate() {
        *value *= factor(low_pass_response(order, cut_off_hz, k as f64 / duration_s));
    }
    Ok(backward(spectrum, samples.len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::filter::{Band, butterworth};

    #[test]
    fn modulus_of_the_response_matches_the_formula() {
        for order in [1, 2, 3, 4, 7] {
            for frequency in [0.0, 300.0, 850.0, 3000.0] {
                let expected = (1.0 + (frequency / 850.0_f64).powi(2 * order as i32)).sqrt().recip();
                let found = low_pass_response(order, 850.0, frequency).norm();
                assert!((found / expected - 1.0).abs() < 1e-13, "order {order}, {frequency} Hz");
            }
        }
        // First order by hand: 1/(1 + i w/w_c).
        let first = low_pass_response(1, 100.0, 100.0);
        assert!((first - Complex::new(0.5, -0.5)).norm() < 1e-15);
    }

    /// A square wave through `1/(1 + T s)` is, in closed form, `1 - 2 exp(-t/T)/(1 + exp(-P/2T))` over its
    /// positive half; here the harmonics of a ramped wave, whose coefficients fall like `1/k^2`, so that
    /// folding is small: a triangle of slope `4/P` leaves as `y' = (x - y)/T`.
    #[test]
    fn triangle_through_a_filter_of_first_order_is_the_closed_form() {
        let (period, count) = (0.02, 1 << 14);
        let time_constant = 1.0 / (2.0 * PI * 60.0);
        let triangle =
            |t: f64| if t < 0.5 * period { 4.0 * t / period - 1.0 } else { 3.0 - 4.0 * t / period };
        let samples: Vec<f64> = (0..count).map(|k| triangle(period * k as f64 / count as f64)).collect();
        let found = periodic_low_pass(&samples, period, (1, 60.0)).unwrap();
        // Rising half: y = s (t - T) - 1 + a exp(-t/T), s = 4/P; falling half the negative: y(P/2) = -y(0).
        let slope = 4.0 / period;
        let a = 2.0 * slope * time_constant / (1.0 + (-0.5 * period / time_constant).exp());
        for k in 0..count / 2 {
            let t = period * k as f64 / count as f64;
            let expected = slope * (t - time_constant) - 1.0 + a * (-t / time_constant).exp();
            // Aliases of a triangle are of the order (1/samples)^2 of it.
            assert!((found[k] - expected).abs() < 1e-7, "sample {k}: {} {expected}", found[k]);
        }
    }

    #[test]
    fn it_is_the_settled_state_of_the_digital_filter_at_a_high_rate() {
        let (period, count) = (0.025, 4000);
        let signal = |k: usize| {
            let x = 2.0 * PI * k as f64 / count as f64;
            x.cos() + 0.4 * (7.0 * x + 1.0).sin() + 0.2 * (40.0 * x).cos()
        };
        let samples: Vec<f64> = (0..count).map(signal).collect();
        let found = periodic_low_pass(&samples, period, (4, 850.0)).unwrap();
        let rate = count as f64 / period;
        let digital = butterworth(4, Band::LowPass { cut_off_hz: 850.0 }, rate).unwrap();
        let run = digital.causal(&samples.repeat(6));
        for (a, b) in found.iter().zip(&run[5 * count..]) {
            // The bilinear transformation bends 1600 Hz at 160 kHz by 3e-4.
            assert!((a - b).abs() < 1e-3, "{a} {b}");
        }
    }

    #[test]
    fn forwards_and_backwards_a_line_keeps_its_phase_and_loses_the_square_of_the_gain() {
        let line = |k: u32| (2.0 * PI * f64::from(k) / 64.0 + 0.4).cos();
        let samples: Vec<f64> = (0..64).map(line).collect();
        // At the cut-off: half of the amplitude.
        let found = periodic_zero_phase(&samples, 0.02, (4, 50.0)).unwrap();
        assert!(found.iter().zip(&samples).all(|(found, sample)| (found - 0.5 * sample).abs() < 1e-14));
    }

    #[test]
    fn input_out_of_range_is_refused() {
        assert!(periodic_low_pass(&[1.0], 1.0, (4, 850.0)).is_err());
        assert!(periodic_low_pass(&[1.0, 2.0], 0.0, (4, 850.0)).is_err());
        assert!(periodic_low_pass(&[1.0, 2.0], 1.0, (0, 850.0)).is_err());
        assert!(periodic_low_pass(&[1.0, 2.0], 1.0, (4, -1.0)).is_err());
        assert!(periodic_low_pass(&[1.0, f64::NAN], 1.0, (4, 1.0)).is_err());
    }
}
