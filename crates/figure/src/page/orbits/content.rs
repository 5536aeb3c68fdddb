//! Data of an orbit on the page.

/// An orbit over its period, from phase 0 of the excitation on, the end of the period left out.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageOrbit {
    /// Its period (s).
    pub duration_s: f64,
    /// Displacement of the response point at equal steps (m).
    pub displacement_m: Vec<f64>,
    /// Its velocity at the same instants (m/s).
    pub velocity_m_s: Vec<f64>,
    /// Additional samples within contacts, which may be shorter than the sampling step: number of the
    /// preceding sample, displacement (m) and velocity (m/s).
    pub in_contacts: Vec<(usize, f64, f64)>,
    /// Impacts on rigid stops, in their order in time.
    pub impulses: Vec<PageImpulse>,
    /// Least and largest acceleration from each sample to the next, in their order in time (m/s²).
    pub acceleration_m_s2: Vec<[f64; 2]>,
    /// The same of the force of each local element (N).
    pub forces_n: Vec<Vec<[f64; 2]>>,
    /// Displacements of the moving supports (m) in sequence, each at equal steps over one excitation period.
    pub support_m: Vec<f64>,
    /// Coordinates (kg^1/2 m) of the modes that are drawn, at equal steps of their own over the period of the
    /// orbit.
    pub modes: Vec<Vec<f64>>,
    /// Amplitudes of the harmonics 1, 2, ... of the orbit frequency in the acceleration (m/s²).
    pub spectrum_m_s2: Vec<f64>,
}

/// An impact on a rigid stop.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PageImpulse {
    /// Number of the local element.
    pub element: usize,
    /// Its time, in excitation periods from phase 0.
    pub cycles: f64,
    /// Impulse along the relative displacement of the element (N s).
    pub impulse_n_s: f64,
    /// Displacement of the response point (m).
    pub displacement_m: f64,
    /// Its velocity before and after (m/s).
    pub velocity_m_s: [f64; 2],
}
