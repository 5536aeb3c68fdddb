//! A damped oscillation, sample by sample.
//!
//! With `z = exp((-s + i w) h)` for a step `h`, an oscillation is `Re((a - i b) z^k)` at sample `k`. Powers
//! are continued by multiplication and recomputed every 256 samples, so that rounding does not grow.

use realfft::num_complex::Complex;

/// A damped oscillation `exp(-s t) (a cos w t + b sin w t)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Oscillation {
    /// Decay rate [1/s].
    pub rate: f64,
    /// Damped angular frequency [rad/s].
    pub frequency: f64,
    /// Amplitude of the cosine.
    pub cosine: f64,
    /// Amplitude of the sine.
    pub sine: f64,
}

/// Samples after which powers are recomputed.
const RECOMPUTED_EVERY: usize = 256;

impl Oscillation {
    /// Amplitude at time zero.
    pub(crate) fn amplitude(&self) -> f64 {
        self.cosine.hypot(self.sine)
    }

    /// `exp(-s t) exp(i w t)` for each sample.
    pub(super) fn powers(&self, length: usize, step: f64) -> impl Iterator<Item = Complex<f64>> + use<> {
        let exponent = Complex::new(-self.rate, self.frequency) * step;
        let factor = exponent.exp();
        let mut power = Complex::new(1.0, 0.0);
        (0..length).map(move |k| {
            if k.is_multiple_of(RECOMPUTED_EVERY) {
                power = (exponent * k as f64).exp();
            }
            let current = power;
            power *= factor;
            current
        })
    }

    /// Subtracts the oscillation from a series.
    pub(super) fn subtract(&self, series: &mut [f64], step: f64) {
        let amplitude = Complex::new(self.cosine, -self.sine);
        let powers = self.powers(series.len(), step);
        series.iter_mut().zip(powers).for_each(|(value, power)| *value -= (amplitude * power).re);
    }
}
