//! What is known of a signal over an orbit.

/// A signal over an orbit in a few numbers, in its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct SignalStatistics {
    /// Largest value.
    pub maximum: f64,
    /// Smallest value.
    pub minimum: f64,
    /// Mean over the orbit.
    pub mean: f64,
    /// Root of the mean square.
    pub root_mean_square: f64,
    /// Complex amplitudes `[re, im]` of the orders `j/n` of the excitation frequency, j from 1, of an orbit
    /// of n excitation periods.
    pub harmonics: Vec<[f64; 2]>,
}

impl SignalStatistics {
    /// Largest absolute value.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.maximum.max(-self.minimum)
    }

    /// Largest value less smallest value.
    #[must_use]
    pub fn peak_to_peak(&self) -> f64 {
        self.maximum - self.minimum
    }
}
