//! Everything a follower knows between two points, as plain data.

use crate::{
    error::StopReason,
    point::{ContinuationPoint, Counters},
    predictor::History,
    problem::TestValue,
};

/// State of a [`Follower`](crate::Follower) after an accepted point.
///
/// [`Follower::resume`](crate::Follower::resume) continues from it bit by bit like the run it was taken from,
/// once all accepted points, the start first, were handed to
/// [`Follower::remember`](crate::Follower::remember).
#[derive(Debug, Clone, PartialEq)]
pub struct Checkpoint {
    /// The point accepted last.
    pub current: ContinuationPoint,
    /// The start, against which a closed path is recognised.
    pub start: ContinuationPoint,
    /// The last points of the present smooth arc, for the predictor; the first is the base of the next step.
    pub history: History,
    /// Most earlier points for the predictor of the next step: as many as would have served the last one
    /// best.
    pub most_earlier: usize,
    /// Length of the next step.
    pub step_length: f64,
    /// Sign of `det [R_x R_λ; (W t)ᵀ]` with the tangent in the direction of travel.
    pub orientation: f64,
    /// Sign that `t_λ` has after `current`; it settles the doubt at a fold, where `t_λ` is rounding.
    pub parameter_sign: f64,
    /// The test functions as they are after `current`; it settles the doubt at a zero, where the sign is
    /// rounding.
    pub tests: Vec<TestValue>,
    /// The test functions at the point before `current`, where the history has it.
    pub tests_before: Vec<TestValue>,
    /// What the problem noted at `current`, see [`PathProblem::note`](crate::PathProblem::note).
    pub noted: Vec<f64>,
    /// Bit `k` is set while test function `k` has not left the zero behind which the path goes on.
    pub zeros_near: u32,
    /// Least and most number of multipliers outside the unit circle behind `current`; `None` if nothing is
    /// known of them.
    pub outside: Option<(u32, u32)>,
    /// Units of the unknowns now, in those of the start.
    pub unit: f64,
    /// A change of signature is known to lie within this distance ahead; zero if none is known.
    pub change_ahead: f64,
    /// Work done so far.
    pub counters: Counters,
    /// Why the branch ended, if it did.
    pub stop: Option<StopReason>,
}
