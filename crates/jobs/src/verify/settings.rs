//! What to verify, and how closely.

/// What to verify, and how closely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VerifySettings {
    /// Number of solutions; `None` for all.
    pub sample: Option<u64>,
    /// Which sample.
    pub seed: u64,
    /// The tolerance `tau` of all comparisons; see the module.
    pub tolerance: f64,
    /// Number of threads, at least 1; the result does not depend on it.
    pub jobs: usize,
}

impl Default for VerifySettings {
    /// A thousand solutions on one thread.
    fn default() -> Self {
        Self { sample: Some(1000), seed: 0, tolerance: TOLERANCE, jobs: 1 }
    }
}

/// Default of [`VerifySettings::tolerance`].
pub const TOLERANCE: f64 = 1e-9;
