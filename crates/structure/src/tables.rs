//! What `modes` prints: three tables of eigenfrequencies, and the error of the reduction.

use std::f64::consts::TAU;

use crate::{Reduction, modes::Modes};

/// Eigenfrequencies before and after the reduction, and its error.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ModeTables {
    /// Every eigenfrequency [Hz] of the supported structure, unreduced.
    pub clamped_hz: Vec<f64>,
    /// Free-interface eigenfrequencies [Hz] up to the cut-off, rigid-body modes exactly 0.0; else empty.
    pub free_interface_hz: Vec<f64>,
    /// Fixed-interface eigenfrequencies [Hz] up to the cut-off; empty for other methods.
    pub fixed_interface_hz: Vec<f64>,
    /// Eigenfrequencies [Hz] of the reduced supported structure; those of `clamped_hz` for an unreduced beam,
    /// empty for a lumped structure.
    pub reduced_hz: Vec<f64>,
    /// Mode by mode: reduced against unreduced.
    pub frequency_errors: Vec<FrequencyError>,
    /// Interface point by interface point: reduced against unreduced.
    pub flexibility_errors: Vec<FlexibilityError>,
}

/// Error of a reduced eigenfrequency.
#[derive(Debug, Clone, PartialEq)]
pub struct FrequencyError {
    /// Unreduced eigenfrequency [Hz] of the same number.
    pub full_hz: f64,
    /// Reduced eigenfrequency [Hz], never below the unreduced one but by rounding.
    pub reduced_hz: f64,
    /// `reduced / full - 1` [-]; 0 for rigid-body modes.
    pub relative: f64,
    /// The unreduced eigenfrequency does not exceed the cut-off.
    pub below_cut_off: bool,
}

/// Error of the static flexibility at an interface point: displacement per unit force there.
#[derive(Debug, Clone, PartialEq)]
pub struct FlexibilityError {
    /// Name of the point.
    pub point: String,
    /// Unreduced flexibility [m/N] of the elastic modes, `sum_i phi_i^2 / w_i^2`.
    pub full: f64,
    /// The same of the reduced structure [m/N].
    pub reduced: f64,
    /// `reduced / full - 1` [-]; 0 if both vanish.
    pub relative: f64,
}

/// `sum_i phi_i^2 / w_i^2` over the elastic modes.
pub(crate) fn flexibility<'a>(frequencies: &[f64], shape: impl Iterator<Item = &'a f64>) -> f64 {
    frequencies.iter().zip(shape).filter(|(w, _)| **w > 0.0).map(|(w, phi)| (phi / w).powi(2)).sum()
}

/// Compares eigenfrequencies [rad/s] number by number.
pub(crate) fn frequency_errors(full: &Modes, reduced: &[f64], reduction: &Reduction) -> Vec<FrequencyError> {
    let cut_off_hz = reduction.cut_off_hz().unwrap_or(f64::INFINITY);
    let compare = |(&full, &reduced): (&f64, &f64)| FrequencyError {
        full_hz: full / TAU,
        reduced_hz: reduced / TAU,
        relative: relative_error(full, reduced),
        below_cut_off: full / TAU <= cut_off_hz,
    };
    full.frequencies.iter().zip(reduced).map(compare).collect()
}

/// `found / exact - 1`, and 0 if both vanish.
pub(crate) fn relative_error(exact: f64, found: f64) -> f64 {
    if exact == found { 0.0 } else { found / exact - 1.0 }
}
