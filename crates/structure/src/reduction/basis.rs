//! The basis that a method of reduction hands over.

use faer::Mat;

/// What a method hands over.
pub(crate) struct Basis {
    /// `B`, rows over the free coordinates of the structure.
    pub relative: Mat<f64>,
    /// Frequencies [Hz] of the component's modes that are kept.
    pub kept_hz: Vec<f64>,
    /// `B^T M B`, where it is not that of the structure.
    pub mass: Option<Mat<f64>>,
}

/// What of the residual modes' inertia counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ResidualInertia {
    /// All of it (Rubin).
    Kept,
    /// None (MacNeal).
    Neglected,
}

/// Frequency of a residual mode without inertia, over the highest frequency that is kept.
pub(crate) const FAR_ABOVE: f64 = 100.0;
