//! The first point of a branch.

use super::{Follower, direction::StartDirection};
use crate::{
    checkpoint::Checkpoint,
    corrector::{Candidate, Limits},
    error::{PathError, PathStop},
    point::{ContinuationPoint, Counters, PathEvents},
    problem::PathProblem,
    product::{norm, scale, weighed},
    settings::{ParameterRange, Settings},
    state::PathState,
    test_record::TestRecord,
};

impl Follower {
    /// Corrects the start, after which the problem is evaluated at [`current`](Self::current).
    ///
    /// * `start`: `[x; λ]` near the path.
    ///
    /// # Errors
    /// [`PathError`]: the start is outside the range or not near the path, or input has the wrong length.
    pub fn start(
        problem: &mut dyn PathProblem,
        start: &[f64],
        direction: StartDirection<'_>,
        range: ParameterRange,
        settings: Settings,
    ) -> Result<Self, PathError> {
        settings.check()?;
        let length = problem.unknowns() + 1;
        check_length(start.len(), length)?;
        check_length(problem.weights().len(), length)?;
        let weights = problem.weights().to_vec();
        let row = first_border(direction, &weights)?;
        let mut trial = Candidate::new(length);
        trial.point.copy_from_slice(start);
        let parameter = trial.parameter();
        let mut counters = Counters::default();
        trial
            .correct(problem, &weights, &row, start_limits(&settings), &mut counters)
            .map_err(|cause| PathError::Start { parameter, cause })?;
        let mut tests = TestRecord::default();
        problem.tests(&[], &mut tests.values);
        problem.judge().note(&mut tests.noted);
        check_inside(trial.parameter(), range)?;
        scale(&mut trial.node.tangent, direction.sign());
        let current = first_point(&trial, direction.sign(), counters);
        let mut state = PathState::at_start(current, &trial.node, settings.initial_step);
        state.outside = problem.judge().outside(PathEvents::default()).map(|here| (here.least, here.most));
        if state.current.parameter() == range.end_ahead(state.parameter_sign) {
            state.stop = Some(PathStop::RangeEnd);
        }
        let mut follower = Self::resume(problem, Checkpoint { state, tests, counters }, range, settings);
        follower.memory.remember(&follower.state.current, &[1.0]);
        Ok(follower)
    }
}

pub(super) fn check_length(found: usize, expected: usize) -> Result<(), PathError> {
    if found == expected { Ok(()) } else { Err(PathError::WrongLength { found, expected }) }
}

fn check_inside(parameter: f64, range: ParameterRange) -> Result<(), PathError> {
    if range.contains(parameter) {
        return Ok(());
    }
    Err(PathError::StartOutsideRange { parameter, low: range.low(), high: range.high() })
}

pub(super) fn first_border(direction: StartDirection<'_>, weights: &[f64]) -> Result<Vec<f64>, PathError> {
    let length = weights.len();
    let StartDirection::Along(vector) = direction else {
        let mut row = vec![0.0; length];
        row[length - 1] = 1.0;
        return Ok(row);
    };
    check_length(vector.len(), length)?;
    let mut row = weighed(weights, vector);
    scale(&mut row, 1.0 / norm(weights, vector));
    Ok(row)
}

pub(super) fn start_limits(settings: &Settings) -> Limits {
    Limits {
        loose_tolerance: settings.correction_tolerance,
        // Beside a branch point rounding leaves corrections along the other branch; without damping, along
        // what the matrix hardly holds.
        singular_tolerance: settings.correction_tolerance.max(0.01 * settings.initial_step),
        max_iterations: 5 * settings.max_iterations,
        max_displacement: f64::INFINITY,
        max_angle: None,
        ..settings.limits(0.0)
    }
}

/// The orientation equals the sign of the bordered determinant times the sign of the direction.
fn first_point(trial: &Candidate, sign: f64, counters: Counters) -> ContinuationPoint {
    ContinuationPoint {
        point: trial.point.clone(),
        tangent: trial.node.tangent.clone(),
        arc_length: 0.0,
        signature: trial.signature,
        orientation: trial.sign * sign,
        log_determinant: trial.log_determinant,
        correction_norm: trial.correction_norm,
        residual_norm: trial.residual_norm,
        events: PathEvents::default(),
        uncertainty: 0.0,
        evaluations: counters.evaluations,
    }
}
