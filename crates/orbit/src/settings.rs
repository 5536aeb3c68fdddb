//! What the user chooses for orbits and branches.

/// How many shooting segments an orbit period is cut into.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Segments {
    /// As many as multipliers and contacts ask for.
    #[default]
    Automatic,
    /// That many, at least one.
    Fixed(usize),
}

/// Settings of orbits and branches.
///
/// Lengths of a path are measured in `ds^2 = df^2 + (F |dz|)^2`, f what varies, mostly the frequency, `|dz|`
/// the change of the orbit's state in the norm `sqrt(sum r_i^2 q_i^2 + q_i'^2)`, `r_i = max(w_i, 2 pi f)`,
/// relative to the norm of the orbit, and F a hundredth of the range of f: a change as large as the motion
/// counts like a hundredth of the range. Relative means in units that fit the start. Where the orbit or its
/// frequency outgrows the unit of one displacement or of the velocities by a factor of four either way, all
/// get the power of two that fits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrbitSettings {
    /// Largest change of what varies from one solution to the next, in its unit; of the frequency in hertz.
    pub max_step: f64,
    /// An orbit is accepted when Newton's correction that is still due is at most this, in the relative
    /// energy norm.
    pub tolerance: f64,
    /// Tolerance of the contact steps, see [`hammerbeam_motion::exact::ExactSettings`].
    pub motion_tolerance: f64,
    /// Shooting segments.
    pub segments: Segments,
    /// Most solutions on one side of a branch.
    pub max_solutions: usize,
    /// Whether a walk locates flips and Neimark-Sacker points.
    pub locates_stability_changes: bool,
}

impl OrbitSettings {
    /// The defaults with the longest step that suits a frequency range: a five-thousandth of it.
    #[must_use]
    pub fn for_range((low, high): (f64, f64)) -> Self {
        Self { max_step: (high - low) / 5000.0, ..Self::default() }
    }
}

impl Default for OrbitSettings {
    fn default() -> Self {
        Self {
            max_step: 0.02,
            tolerance: 1e-10,
            motion_tolerance: 5e-12,
            segments: Segments::Automatic,
            max_solutions: 1_000_000,
            locates_stability_changes: true,
        }
    }
}

/// What is observed: the displacement `shape . q + support_ratios . u`.
#[derive(Debug, Clone, PartialEq)]
pub struct Response {
    /// Displacement of the response point in each mode [kg^-1/2], length n.
    pub shape: Vec<f64>,
    /// Its part of the displacement of each support [-].
    pub support_ratios: Vec<f64>,
}
