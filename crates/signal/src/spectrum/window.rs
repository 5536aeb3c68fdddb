//! Windows: sums of cosines, `w_n = sum_j (-1)^j a_j cos(2 pi j n / N)`, `n = 0 .. N-1` (periodic form).
//!
//! | window | for | lines are as wide as | sidelobes below |
//! |---|---|---|---|
//! | rectangular | whole periods, transients | 1 bin | 13 dB |
//! | Hann | in general | 1.5 bins | 31 dB |
//! | Hamming | low first sidelobes | 1.36 bins | 43 dB |
//! | Blackman | weak lines next to strong ones | 1.73 bins | 58 dB |
//! | flat-top | amplitudes of lines between bins, to 0.01 dB | 3.77 bins | 93 dB |
//!
//! Widths are equivalent noise bandwidths.
//!
//! # Source
//! Harris, Proc. IEEE 66 (1978), 51-83; flat-top: D'Antona and Ferrero, *Digital Signal Processing for
//! Measurement Systems*, 2006, p. 70.

use std::f64::consts::PI;

/// A window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Window {
    /// No window.
    Rectangular,
    /// Hann.
    Hann,
    /// Hamming.
    Hamming,
    /// Blackman.
    Blackman,
    /// Flat-top with five terms.
    FlatTop,
}

impl Window {
    /// Coefficients `a_j`.
    #[must_use]
    pub const fn coefficients(self) -> &'static [f64] {
        match self {
            Self::Rectangular => &[1.0],
            Self::Hann => &[0.5, 0.5],
            Self::Hamming => &[0.54, 0.46],
            Self::Blackman => &[0.42, 0.5, 0.08],
            Self::FlatTop => &[0.215_578_95, 0.416_631_58, 0.277_263_158, 0.083_578_947, 0.006_947_368],
        }
    }

    /// Values of a window of a length.
    #[must_use]
    pub fn values(self, length: usize) -> Vec<f64> {
        let coefficients = self.coefficients();
        let value = |n: usize| {
            let angle = 2.0 * PI * n as f64 / length as f64;
            let term = |(j, a): (usize, &f64)| {
                let sign = if j.is_multiple_of(2) { 1.0 } else { -1.0 };
                sign * a * (j as f64 * angle).cos()
            };
            coefficients.iter().enumerate().map(term).sum()
        };
        (0..length).map(value).collect()
    }
}
