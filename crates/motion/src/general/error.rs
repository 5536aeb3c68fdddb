//! Why the general integrator has nothing to give.

/// Why a motion was not integrated to its end.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum GeneralError {
    /// Tolerances lie where rounding errors do not govern and the method is still of high order.
    #[error("tolerance is {found:e}, must lie between 1e-14 and 1e-2")]
    Tolerance { found: f64 },
    /// The state does not belong to the field.
    #[error("the state has {found} entries, the field has {expected}")]
    StateLength { found: usize, expected: usize },
    /// A state, a frequency or an end of the stretch is infinite, not a number, or out of order.
    #[error("{what} is {found}, must be {allowed}")]
    Input { what: &'static str, found: f64, allowed: &'static str },
    /// A law needs the speed with which a contact began, and the stretch begins within it.
    #[error("{element} is closed at the start of the stretch, and its law needs to know how fast it closed")]
    StartsInContact { element: String },
    /// The motion runs away, or the field is not defined here.
    #[error("the motion is not finite beyond {time}")]
    NotFinite { time: f64 },
    /// The error cannot be brought below the tolerance: the field jumps, or the tolerance is too small.
    #[error("the step at {time} shrank to {step:e}")]
    StepTooSmall { time: f64, step: f64 },
    /// More steps than [`super::GeneralSettings::max_steps`].
    #[error("{steps} steps led only to {time}")]
    TooManySteps { steps: usize, time: f64 },
}
