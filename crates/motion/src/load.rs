//! The periodic load: prescribed support motions and forces, as sums of harmonics.

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

/// One harmonic of the displacement of a support.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SupportHarmonic {
    /// Number of the support among those of the model that move, from 0.
    pub support: usize,
    /// The harmonic, amplitude in metres.
    pub harmonic: Harmonic,
}

impl From<Harmonic> for SupportHarmonic {
    /// Of the first support, which is the only one where all move alike.
    fn from(harmonic: Harmonic) -> Self {
        Self { support: 0, harmonic }
    }
}

/// All that drives the structure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Load {
    /// Harmonics of the displacements `u_s` of the supports [m].
    pub support: Vec<SupportHarmonic>,
    /// Harmonic and constant forces.
    pub forces: Vec<HarmonicForce>,
}

impl Load {
    /// Every harmonic.
    pub(crate) fn harmonics(&self) -> impl Iterator<Item = &Harmonic> {
        let moved = self.support.iter().map(|motion| &motion.harmonic);
        moved.chain(self.forces.iter().map(|force| &force.harmonic))
    }
}
