//! In which units states are measured: displacements and velocities differ by orders of magnitude.

/// Scales of a state: displacements `V/w_i`, velocities `V`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StateScale {
    scales: Vec<f64>,
}

impl StateScale {
    /// * `natural_frequencies`: `w_i` [rad/s]; rigid modes take `reference` [rad/s] instead.
    /// * `velocity`: `V` [kg^1/2 m/s].
    pub fn new(natural_frequencies: &[f64], reference: f64, velocity: f64) -> Self {
        let displacement = natural_frequencies.iter().map(|w| velocity / w.max(reference));
        let velocities = natural_frequencies.iter().map(|_| velocity);
        Self { scales: displacement.chain(velocities).collect() }
    }

    /// The scale with these [`StateScale::values`].
    pub fn from_values(scales: Vec<f64>) -> Self {
        Self { scales }
    }

    /// Multiplies the scales.
    pub fn multiply(&mut self, factor: f64) {
        self.scales.iter_mut().for_each(|scale| *scale *= factor);
    }

    /// Scales, one per entry of a state.
    pub fn values(&self) -> &[f64] {
        &self.scales
    }

    /// Norm of the difference of two states relative to the scale.
    pub fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.scales).map(|((a, b), s)| ((a - b) / s).powi(2)).sum::<f64>().sqrt()
    }

    /// Norm of a state relative to the scale.
    pub fn norm(&self, state: &[f64]) -> f64 {
        state.iter().zip(&self.scales).map(|(z, s)| (z / s).powi(2)).sum::<f64>().sqrt()
    }
}
