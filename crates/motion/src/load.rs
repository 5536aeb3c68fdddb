//! The periodic load: prescribed support motion and forces, as sums of harmonics.

/// One harmonic: `amplitude cos(2 pi order cycles + phase)`; order 0 is a constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// Multiple of the excitation frequency; 0 for a constant.
    pub order: u32,
    /// Amplitude, in the unit of what it drives.
    pub amplitude: f64,
    /// Phase [rad].
    pub phase: f64,
}

/// A harmonic force with its distribution over the modes.
#[derive(Debug, Clone, PartialEq)]
pub struct HarmonicForce {
    /// Modal load per unit of the harmonic, length n: `phi_p` for a force in newtons at point p, the model's
    /// `uniform_acceleration` for gravity in m/s^2.
    pub shape: Vec<f64>,
    /// The harmonic.
    pub harmonic: Harmonic,
}

/// All that drives the structure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Load {
    /// Harmonics of the support displacement `u` [m].
    pub support: Vec<Harmonic>,
    /// Harmonic and constant forces.
    pub forces: Vec<HarmonicForce>,
}
