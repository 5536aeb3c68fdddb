//! Why nothing can be followed at all, and why a branch ended.

use crate::{corrector::CorrectorError, problem::EvaluationError};

/// There is nothing to give: no branch was started.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum PathError {
    /// The start is not near the path, or lies at a fold.
    #[error("the start at parameter {parameter} was not corrected: {cause}")]
    Start { parameter: f64, cause: CorrectorError },
    /// The start lies outside the range of the parameter.
    #[error("the start at parameter {parameter} lies outside the range {low} to {high}")]
    StartOutsideRange { parameter: f64, low: f64, high: f64 },
    /// The ends of the range are not in order.
    #[error("the range {low} to {high} is empty, its ends must be finite and in order")]
    EmptyRange { low: f64, high: f64 },
    /// A setting is zero, negative or not a number.
    #[error("setting {name} is {value}, it must be positive (max_angle at most 1)")]
    UnusableSetting { name: &'static str, value: f64 },
    /// The determinant of the present point has another sign in the new unknowns.
    #[error("the orientation of the path at parameter {parameter} is another one in the new unknowns")]
    OtherOrientation { parameter: f64 },
    /// A point, a direction or the weights have another length than `n + 1`.
    #[error("length {found} where {expected} is needed: unknowns and one parameter")]
    WrongLength { found: usize, expected: usize },
}

/// Why a branch ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PathStop {
    /// The last point lies exactly at an end of the range.
    RangeEnd,
    /// The path came back to its start with the same tangent; the last point is the start again.
    Closed,
    /// `Settings::max_points` points were accepted.
    Budget,
    /// No acceptable point was found with the shortest step.
    StepTooShort {
        /// Parameter of the last accepted point.
        parameter: f64,
        /// Step length that was tried last.
        step: f64,
        /// Largest residual `max |R_i|` of the last evaluation.
        residual: f64,
        /// What was wrong with it.
        doubt: StepDoubt,
    },
    /// The path was followed, but in steps so short that it does not get anywhere.
    NoProgress {
        /// Parameter of the last accepted point.
        parameter: f64,
        /// So many steps came no farther than `Settings::short_step` each, on the average.
        steps: u64,
    },
    /// The problem could not be evaluated beyond the last accepted point.
    EvaluationFailed {
        /// Parameter of the last accepted point.
        parameter: f64,
        /// Step length that was tried last.
        step: f64,
        /// What the problem answered.
        error: EvaluationError,
    },
    /// However short the step, the path continued on a stretch that was already walked.
    RunsBack {
        /// Parameter of the last accepted point.
        parameter: f64,
        /// Arc length of the stored stretch that was met.
        met_arc_length: f64,
    },
}

/// In words, without the place, which has a unit that its reader knows.
impl std::fmt::Display for PathStop {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::RangeEnd => write!(f, "end of the range"),
            Self::Closed => write!(f, "closed path"),
            Self::Budget => write!(f, "largest number of points reached"),
            Self::StepTooShort { step, residual, doubt, .. } => {
                write!(f, "at step {step:.1e}, residual {residual:.1e}: {doubt}")
            }
            Self::NoProgress { steps, .. } => write!(f, "the last {steps} steps made no progress"),
            Self::EvaluationFailed { step, error, .. } => write!(f, "at step {step:.1e}: {error}"),
            Self::RunsBack { .. } => write!(f, "the path continues on a stretch walked before"),
        }
    }
}

/// What was wrong with a candidate for the next point; the step is then shortened.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepDoubt {
    /// The corrector failed.
    #[error(transparent)]
    Corrector(CorrectorError),
    /// The tangent turned by more than `max_angle`.
    #[error("the tangent turns by {angle:.2} rad")]
    Angle {
        /// Angle between the tangents, in radians.
        angle: f64,
    },
    /// The determinant says that the path runs backwards here, and there is no branch point between.
    #[error("the path runs backwards and there is no branch point between")]
    Reversed,
    /// Chord and tangents do not belong to one smooth arc.
    #[error("chord and tangents do not belong to one arc, they differ by {defect:.1e}")]
    Defect {
        /// `‖z₁ − z₀ − h (t₀ + t₁)/2‖`.
        defect: f64,
    },
    /// The signature changed within a step longer than `signature_step`.
    #[error("the signature changes within the step")]
    Signature,
    /// The parameter seems to turn twice between the points.
    #[error("the parameter turns twice within the step")]
    HiddenFolds,
    /// A test function seems to be zero twice between the points.
    #[error("a test function is zero twice within the step")]
    HiddenZeros,
    /// The number of multipliers outside the unit circle changes by another number than the events of the
    /// step account for.
    #[error(
        "{before} multipliers lie outside the unit circle before the step, {behind} behind it, \
        and no event between accounts for it"
    )]
    Unaccounted {
        /// Before the step.
        before: u32,
        /// The nearest number that there may be behind it.
        behind: u32,
    },
    /// The candidate lies on a path that this one meets at branch points only.
    #[error("the point lies on a simpler path, {distance:.1e} from it")]
    Simpler {
        /// [`Judge::distance_to_simpler`](crate::Judge::distance_to_simpler).
        distance: f64,
    },
    /// The candidate lies on a stretch that was already walked.
    #[error("the stretch at arc length {arc_length} was walked before")]
    Retraced {
        /// Arc length of that stretch.
        arc_length: f64,
    },
    /// A fold or branch point between the points could not be located.
    #[error("an event within the step was not located")]
    NotLocated,
}
