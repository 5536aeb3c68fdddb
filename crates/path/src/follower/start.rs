//! The first point of a branch.

use super::Follower;
use crate::{
    checkpoint::Checkpoint,
    corrector::{Candidate, Limits},
    error::{PathError, StopReason},
    point::{ContinuationPoint, Counters, Events},
    predictor::{History, MOST_EARLIER_NODES},
    problem::PathProblem,
    product::{norm, scale, weigh},
    settings::{ParameterRange, Settings},
};

/// Where a branch sets out from its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Direction<'a> {
    /// The parameter increases at first. The start is corrected at fixed parameter.
    Increasing,
    /// The parameter decreases at first. The start is corrected at fixed parameter.
    Decreasing,
    /// Along this vector `v`, length `n + 1`: the start is corrected in the plane `⟨v, z − z_start⟩ = 0`, and
    /// the tangent has `⟨v, t⟩ > 0`. For starts at folds and beside branch points.
    Along(&'a [f64]),
}

impl Direction<'_> {
    fn sign(self) -> f64 {
        if self == Direction::Decreasing { -1.0 } else { 1.0 }
    }
}

impl Follower {
    /// Corrects the start, after which the problem is evaluated at [`current`](Self::current).
    ///
    /// * `start`: `[x; λ]` near the path.
    ///
    /// # Errors
    /// [`PathError`]: the start is outside the range or not near the path, or input has the wrong length.
    pub fn start(
        problem: &mut (impl PathProblem + ?Sized),
        start: &[f64],
        direction: Direction<'_>,
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
        let limits = start_limits(&settings);
        trial
            .correct(problem, &weights, &row, limits, &mut counters)
            .map_err(|cause| PathError::Start { parameter, cause })?;
        problem.tests(&mut trial.tests);
        problem.note(&mut trial.noted);
        check_inside(trial.parameter(), range)?;
        scale(&mut trial.node.tangent, direction.sign());
        let mut state = first_state(&trial, direction.sign(), &settings, counters);
        state.outside = problem.outside(Events::default()).map(|here| (here.least, here.most));
        let mut follower = Self::resume(problem, state, range, settings);
        follower.stop_if_leaving();
        follower.memory.remember(&follower.state.current, 1.0);
        Ok(follower)
    }

    fn stop_if_leaving(&mut self) {
        let end = self.range.end_ahead(self.state.parameter_sign);
        if self.state.current.parameter() == end {
            self.state.stop = Some(StopReason::RangeEnd);
        }
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

pub(super) fn first_border(direction: Direction<'_>, weights: &[f64]) -> Result<Vec<f64>, PathError> {
    let length = weights.len();
    let mut row = vec![0.0; length];
    if let Direction::Along(vector) = direction {
        check_length(vector.len(), length)?;
        weigh(weights, vector, &mut row);
        scale(&mut row, 1.0 / norm(weights, vector));
    } else {
        row[length - 1] = 1.0;
    }
    Ok(row)
}

pub(super) fn start_limits(settings: &Settings) -> Limits {
    Limits {
        tolerance: settings.tolerance_at(0.0),
        loose_tolerance: settings.correction_tolerance,
        // Beside a branch point rounding leaves corrections along the other branch; without damping, along what
        // the matrix hardly holds.
        singular_tolerance: settings.correction_tolerance.max(0.01 * settings.initial_step),
        residual_floor: settings.residual_floor,
        residual_tolerance: settings.residual_tolerance,
        residual_wanted: settings.residual_wanted,
        max_iterations: 5 * settings.max_iterations,
        max_displacement: f64::INFINITY,
        max_angle: None,
    }
}

/// The orientation is that of the border times the sign of the direction.
fn first_state(trial: &Candidate, sign: f64, settings: &Settings, counters: Counters) -> Checkpoint {
    let length = trial.point.len();
    let mut current = ContinuationPoint::empty(length);
    current.point.copy_from_slice(&trial.point);
    current.tangent.copy_from_slice(&trial.node.tangent);
    current.signature = trial.signature;
    current.orientation = trial.sign * sign;
    current.log_determinant = trial.log_determinant;
    current.correction_norm = trial.correction_norm;
    current.residual_norm = trial.residual_norm;
    current.events = Events::default();
    current.evaluations = counters.evaluations;
    let mut history = History::new(length);
    history.push(&trial.node);
    Checkpoint {
        start: current.clone(),
        history,
        most_earlier: MOST_EARLIER_NODES,
        step_length: settings.initial_step,
        orientation: current.orientation,
        parameter_sign: if current.tangent_parameter() < 0.0 { -1.0 } else { 1.0 },
        tests: trial.tests.clone(),
        tests_before: Vec::new(),
        noted: trial.noted.clone(),
        zeros_near: 0,
        outside: None,
        unit: 1.0,
        change_ahead: 0.0,
        counters,
        stop: None,
        current,
    }
}
