//! How a motion is integrated, what it gives, and which inputs are refused.

use faer::Mat;

use super::{GeneralError, VectorField};
use crate::Stretch;

/// How to integrate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GeneralSettings {
    /// Bound of the error of a step, relative to the largest entries; see the module. From 1e-14 to 1e-2, but
    /// below 3e-13 rounding decides where crossings lie: one motion with a chatter of two stops was off by
    /// half its size at 1e-13, without an error.
    pub tolerance: f64,
    /// Whether the sensitivities are wanted; without them their matrix and vector are empty.
    pub sensitivities: bool,
    /// Bound of the number of steps, rejected ones included.
    pub max_steps: usize,
    /// Length of the first step, in the unit of the independent variable (cycles for a system); estimated if
    /// `None`.
    pub first_step: Option<f64>,
}

impl GeneralSettings {
    /// Settings of that tolerance, with sensitivities.
    #[must_use]
    pub fn with_tolerance(tolerance: f64) -> Self {
        Self { tolerance, sensitivities: true, max_steps: 1_000_000, first_step: None }
    }

    /// The same without sensitivities.
    #[must_use]
    pub fn state_only(self) -> Self {
        Self { sensitivities: false, ..self }
    }
}

impl Default for GeneralSettings {
    /// Tolerance 1e-10.
    fn default() -> Self {
        Self::with_tolerance(1e-10)
    }
}

/// The work of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Steps accepted.
    pub steps: usize,
    /// Steps tried and given up.
    pub rejected: usize,
    /// Evaluations of the field, with or without sensitivities.
    pub evaluations: usize,
    /// Boundaries between smooth regions crossed.
    pub crossings: usize,
}

/// Flow of a vector field, and what it cost.
#[derive(Debug, Clone)]
pub struct FieldFlow {
    /// State at the end.
    pub state: Vec<f64>,
    /// Derivative of the final state by the initial one, `dimension` x `dimension`.
    pub by_state: Mat<f64>,
    /// Derivative of the final state by the parameter, at fixed ends.
    pub by_parameter: Vec<f64>,
    /// Work done.
    pub counts: Counts,
    /// Length of the step that would have come next, as [`GeneralSettings::first_step`] of what follows.
    pub next_step: f64,
}

pub(super) fn check_frequency(stretch: &Stretch) -> Result<(), GeneralError> {
    let found = stretch.frequency_hz;
    ensure("the frequency", found, "finite and positive", found.is_finite() && found > 0.0)
}

pub(super) fn check(
    field: &impl VectorField,
    (start, end): (f64, f64),
    state: &[f64],
    settings: &GeneralSettings,
) -> Result<(), GeneralError> {
    let (found, expected) = (state.len(), field.dimension());
    if found != expected {
        return Err(GeneralError::StateLength { found, expected });
    }
    if !(1e-14..=1e-2).contains(&settings.tolerance) {
        return Err(GeneralError::Tolerance { found: settings.tolerance });
    }
    for &value in state {
        ensure("the state", value, "finite", value.is_finite())?;
    }
    ensure("the start", start, "finite", start.is_finite())?;
    ensure("the end", end, "finite and not before the start", end.is_finite() && end >= start)?;
    let step = settings.first_step.unwrap_or(1.0);
    ensure("the first step", step, "finite and positive", step.is_finite() && step > 0.0)
}

pub(super) fn ensure(
    what: &'static str,
    found: f64,
    allowed: &'static str,
    holds: bool,
) -> Result<(), GeneralError> {
    if holds { Ok(()) } else { Err(GeneralError::Input { what, found, allowed }) }
}
