//! A whole branch at once, for small problems and tests.

use super::{Follower, StepOutcome, direction::StartDirection};
use crate::{
    error::{PathError, PathStop},
    point::{ContinuationPoint, Counters},
    problem::PathProblem,
    product::scale,
    settings::{ParameterRange, Settings},
};

/// A path from its start to its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// All points in the order of travel, the start first.
    pub points: Vec<ContinuationPoint>,
    /// Why it ended.
    pub stop: PathStop,
    /// Work done.
    pub counters: Counters,
}

impl Branch {
    /// Points that are folds.
    pub fn folds(&self) -> impl Iterator<Item = &ContinuationPoint> {
        self.points.iter().filter(|point| point.events.fold)
    }

    /// Points that are branch points.
    pub fn branch_points(&self) -> impl Iterator<Item = &ContinuationPoint> {
        self.points.iter().filter(|point| point.events.branch_point)
    }
}

/// A path through its start, from one end to the other.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoSidedBranch {
    /// All points from the end of the backward direction to the end of the forward direction; tangents point
    /// forward, the arc length is negative behind the start.
    pub points: Vec<ContinuationPoint>,
    /// Index of the start.
    pub start: usize,
    /// Why the backward direction ended; `Closed` without points of its own if the forward direction closed.
    pub backward: PathStop,
    /// Why the forward direction ended.
    pub forward: PathStop,
}

/// Follows a path from its start to its end.
///
/// # Errors
/// As [`Follower::start`].
pub fn follow(
    problem: &mut dyn PathProblem,
    start: &[f64],
    direction: StartDirection<'_>,
    range: ParameterRange,
    settings: Settings,
) -> Result<Branch, PathError> {
    let mut follower = Follower::start(problem, start, direction, range, settings)?;
    let mut points = vec![follower.current().clone()];
    loop {
        match follower.step(problem) {
            StepOutcome::Accepted => points.push(follower.current().clone()),
            StepOutcome::Stopped(stop) => return Ok(Branch { points, stop, counters: follower.counters() }),
        }
    }
}

/// Follows a path in both directions from a start that is corrected at fixed parameter.
///
/// # Errors
/// As [`Follower::start`].
pub fn follow_both(
    problem: &mut dyn PathProblem,
    start: &[f64],
    range: ParameterRange,
    settings: Settings,
) -> Result<TwoSidedBranch, PathError> {
    let forward = follow(problem, start, StartDirection::Increasing, range, settings.clone())?;
    if forward.stop == PathStop::Closed {
        let stop = PathStop::Closed;
        return Ok(TwoSidedBranch { points: forward.points, start: 0, backward: stop, forward: stop });
    }
    let backward = follow(problem, start, StartDirection::Decreasing, range, settings)?;
    let mut points: Vec<_> = backward.points.into_iter().skip(1).rev().map(reversed).collect();
    let start = points.len();
    points.extend(forward.points);
    Ok(TwoSidedBranch { points, start, backward: backward.stop, forward: forward.stop })
}

fn reversed(mut point: ContinuationPoint) -> ContinuationPoint {
    scale(&mut point.tangent, -1.0);
    point.arc_length = -point.arc_length;
    point.orientation = -point.orientation;
    point
}
