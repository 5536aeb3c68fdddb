//! What the caller chooses: range, step lengths, tolerances.

use crate::{corrector::Limits, error::PathError};

/// The interval of the parameter; a path is cut exactly at its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterRange {
    low: f64,
    high: f64,
}

impl ParameterRange {
    /// The interval `[low, high]`.
    ///
    /// # Errors
    /// [`PathError::EmptyRange`] unless `low < high`, both finite.
    pub fn new(low: f64, high: f64) -> Result<Self, PathError> {
        if low < high && low.is_finite() && high.is_finite() {
            Ok(Self { low, high })
        } else {
            Err(PathError::EmptyRange { low, high })
        }
    }

    /// Lower end.
    #[must_use]
    pub fn low(&self) -> f64 {
        self.low
    }

    /// Upper end.
    #[must_use]
    pub fn high(&self) -> f64 {
        self.high
    }

    /// Whether the parameter lies in the closed interval.
    #[must_use]
    pub fn contains(&self, parameter: f64) -> bool {
        (self.low..=self.high).contains(&parameter)
    }

    /// The end that lies ahead when the parameter moves with this sign.
    pub(crate) fn end_ahead(&self, sign: f64) -> f64 {
        if sign >= 0.0 { self.high } else { self.low }
    }
}

/// Step lengths and tolerances of a [`Follower`](crate::Follower).
///
/// Lengths are measured in the problem's weighted norm `‖a‖² = Σ w_i a_i²`; `h` is the step length, `t` the
/// unit tangent, `d` a Newton correction, `z₀ → z₁` a step, `θ` the angle between its tangents.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// First step length `h`.
    pub initial_step: f64,
    /// Bound of `|Δλ|` over one step, by the tangent: `h |t_λ| ≤ max_parameter_step`.
    pub max_parameter_step: f64,
    /// Bound of `h`.
    pub max_step_length: f64,
    /// Shortest step, some hundred times the `correction_floor`; a turn that is still unresolved at it is
    /// taken as a corner, and if that fails too, the branch stops.
    pub min_step: f64,
    /// Steps that are no longer on the average do not get anywhere: after
    /// [`MOST_SHORT_STEPS`](crate::MOST_SHORT_STEPS) of them the branch stops.
    pub short_step: f64,
    /// Bound of `θ`, in radians.
    pub max_angle: f64,
    /// A point is accepted when the correction that is still due has `‖d‖ ≤ correction_tolerance`
    /// (and `≤ h / 100` at very short steps, as far as `correction_floor` allows).
    pub correction_tolerance: f64,
    /// What rounding leaves of `‖d‖` at a converged point; no tighter tolerance is asked for.
    pub correction_floor: f64,
    /// Bound of the residual `max |R_i|` of an accepted point.
    pub residual_tolerance: f64,
    /// Residual above which a point is corrected further as long as corrections shrink, though the one that
    /// is still due is small: where the matrix is large, that is what takes the residual away.
    pub residual_wanted: f64,
    /// The same where the correction that is still due changes the parameter by more than this part of it, if
    /// the residual is above this, too: lengths are measured by a range, which may be wide.
    pub parameter_tolerance: f64,
    /// What rounding leaves of the residual. Where it is reached and corrections do not shrink any more
    /// (beside a branch point), `‖d‖ ≤ 0.03 h` is enough.
    pub residual_floor: f64,
    /// Most evaluations of one correction.
    pub max_iterations: u32,
    /// Sheets at least this far apart are distinguished: the corrector may move a prediction by
    /// `min(sheet_distance, h / 10)` (but ten times the `correction_floor`), and `‖z₁ − z₀ − h (t₀ + t₁)/2‖ ≤
    /// sheet_distance + h θ / 10`.
    pub sheet_distance: f64,
    /// Longest step over a change of signature. On both sides of the change steps grow at most like the
    /// distance from it, so that pairs of folds beside it are seen whatever the longest step.
    pub signature_step: f64,
    /// A fold is located to `|t_λ| ≤ fold_tolerance`, or as closely as rounding allows.
    pub fold_tolerance: f64,
    /// Most accepted points, the start not counted.
    pub max_points: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            initial_step: 1e-3,
            max_parameter_step: f64::INFINITY,
            max_step_length: 0.1,
            min_step: 1e-10,
            short_step: 1e-6,
            max_angle: 0.3,
            correction_tolerance: 1e-9,
            correction_floor: 1e-12,
            residual_tolerance: 1e-6,
            residual_wanted: 1e-6,
            parameter_tolerance: f64::INFINITY,
            residual_floor: 1e-13,
            max_iterations: 6,
            sheet_distance: 1e-5,
            signature_step: 1e-6,
            fold_tolerance: 1e-7,
            max_points: 100_000,
        }
    }
}

/// Share of the step that a correction may be which does not shrink any more beside a branch point: a
/// third of what a correction may move a prediction. Where the path turns sharply there, as at a pitchfork
/// over a narrow range, no shorter step is known better; with more, walks come over to the other path.
const SINGULAR: f64 = 0.03;

impl Settings {
    /// How far the corrector may move a prediction of a step of length `h`.
    pub(crate) fn allowed_displacement(&self, step: f64) -> f64 {
        self.sheet_distance.min((0.1 * step).max(10.0 * self.correction_floor))
    }

    /// Correction that may stay unapplied after a step of length `h`.
    pub(crate) fn tolerance_at(&self, step: f64) -> f64 {
        self.correction_tolerance.min(0.01 * step).max(self.correction_floor)
    }

    /// Correction that may stay unapplied where corrections stop shrinking.
    pub(crate) fn loose_tolerance_at(&self, step: f64) -> f64 {
        self.correction_tolerance.min((0.1 * step).max(10.0 * self.correction_floor))
    }

    /// What the correction of a step of length `h` must keep to.
    pub(crate) fn limits(&self, step: f64) -> Limits {
        Limits {
            tolerance: self.tolerance_at(step),
            loose_tolerance: self.loose_tolerance_at(step),
            singular_tolerance: self.loose_tolerance_at(step).max(SINGULAR * step),
            residual_floor: self.residual_floor,
            residual_tolerance: self.residual_tolerance,
            residual_wanted: self.residual_wanted,
            parameter_tolerance: self.parameter_tolerance,
            max_iterations: self.max_iterations,
            max_displacement: self.allowed_displacement(step),
            max_angle: Some(self.max_angle),
        }
    }

    /// Longest step with this parameter component of the tangent.
    pub(crate) fn longest_step(&self, tangent_parameter: f64) -> f64 {
        self.max_step_length.min(self.max_parameter_step / tangent_parameter.abs().max(f64::MIN_POSITIVE))
    }

    /// # Errors
    /// [`PathError::UnusableSetting`] naming the first setting that is not positive (`max_angle`: also not
    /// above 1).
    pub(crate) fn check(&self) -> Result<(), PathError> {
        let positive = [
            ("initial_step", self.initial_step),
            ("max_parameter_step", self.max_parameter_step),
            ("max_step_length", self.max_step_length),
            ("min_step", self.min_step),
            ("short_step", self.short_step),
            ("max_angle", self.max_angle),
            ("correction_tolerance", self.correction_tolerance),
            ("correction_floor", self.correction_floor),
            ("residual_tolerance", self.residual_tolerance),
            ("residual_wanted", self.residual_wanted),
            ("parameter_tolerance", self.parameter_tolerance),
            ("residual_floor", self.residual_floor),
            ("sheet_distance", self.sheet_distance),
            ("signature_step", self.signature_step),
            ("fold_tolerance", self.fold_tolerance),
            ("max_iterations", f64::from(self.max_iterations)),
        ];
        for (name, value) in positive {
            if value.is_nan() || value <= 0.0 || (name == "max_angle" && value > 1.0) {
                return Err(PathError::UnusableSetting { name, value });
            }
        }
        Ok(())
    }
}
