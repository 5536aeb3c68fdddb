//! The flip at which a branch of doubled period ends, from the branch that flips there.
//!
//! Beside the flip an orbit of doubled period is one of half its period and a small part `d` that alternates.
//! Its equations are singular there, and rounding can hold up the steps before the branch point is met. For
//! the orbit of half the period the flip is a place like any other: `A - I` is regular, since the multiplier
//! is -1. So a walk begins on that branch, at the mean of the two halves, which is `O(d^2)` away from it, and
//! goes to both sides until a multiplier passes -1. The orbit there, run through twice, is the last one of
//! the branch of doubled period.

use hammerbeam_motion::exact::ExactIntegrator;
use hammerbeam_path::{
    ContinuationPoint, Follower, Judge, ParameterRange, PathEvents, StartDirection, StepOutcome,
};

use super::{OrbitPath, row::row_at, settings::path_settings};
use crate::{
    BranchRow, OrbitError, OrbitSettings, StopReason, located,
    shooting::ShootingProblem,
    solve::{evaluate, nodes_from},
};

/// Steps on the branch of half the period are at most this many distances of the two halves long, or
const DISTANCES: f64 = 2.0;
/// this part of those of the walk, if that is longer,
const PART: f64 = 1e-3;
/// so many to each side.
const MOST_STEPS: usize = 16;

/// A place on the branch of half the period.
struct Flip {
    point: ContinuationPoint,
    nodes: Vec<Vec<f64>>,
    /// Within which the frequency, or what varies, is known.
    uncertainty: f64,
}

/// Where a walk ends at the flip of a branch of shorter period that is not located yet, it ends in a row there:
/// the end with its place.
pub(super) fn at_flip(path: &mut OrbitPath, end: StopReason, rows: &mut Vec<BranchRow>) -> StopReason {
    let StopReason::ShorterPeriod { grazes: false, .. } = end else { return end };
    if path.current().events.branch_point {
        return end;
    }
    let Ok(Some(row)) = row_of_flip(path) else { return end };
    let frequency_hz = row.parameter.unwrap_or(row.solution.frequency_hz);
    rows.push(row);
    StopReason::ShorterPeriod { frequency_hz, grazes: false }
}

/// The row of the flip beside the present orbit, as the last one of its branch; `None` where the orbit of
/// half the period does not flip nearby.
pub(super) fn row_of_flip(path: &mut OrbitPath) -> Result<Option<BranchRow>, OrbitError> {
    let Some(flip) = nearest_flip(path)? else { return Ok(None) };
    let (present, problem) = (path.follower.current(), &mut path.problem);
    let nodes = if problem.segments().is_multiple_of(2) {
        [flip.nodes.as_slice(), &flip.nodes].concat()
    } else {
        let begin = (problem.phase(), flip.nodes[0].as_slice());
        let (multiple, segments) = (problem.period_multiple(), problem.segments());
        problem.move_to(&flip.point.point)?;
        let frequency_hz = problem.frequency(&flip.point.point);
        nodes_from(problem.integrator(), begin, frequency_hz, multiple, segments)?
    };
    let at_flip = ContinuationPoint {
        point: problem.point(&nodes, flip.point.parameter()),
        events: PathEvents { branch_point: true, ..PathEvents::default() },
        correction_norm: flip.point.correction_norm,
        residual_norm: flip.point.residual_norm,
        ..present.clone()
    };
    evaluate(problem, &at_flip.point)?;
    let place = located::Place {
        point: &at_flip,
        bend: 0.0,
        at_corners: 0.0,
        contacts: Vec::new(),
        computed: Some(flip.uncertainty),
        before: None,
    };
    let located = located::describe(problem, place);
    Ok(Some(BranchRow { located, ..row_at(path, &at_flip)? }))
}

/// The nearest flip of the branch of half the period.
fn nearest_flip(path: &mut OrbitPath) -> Result<Option<Flip>, OrbitError> {
    let present = path.follower.current().point.clone();
    let distance = path.problem.distance_to_simpler(&present);
    let longest = (DISTANCES * distance).max(PART * path.settings.max_step_hz);
    let here = path.parameter();
    let mut nearest: Option<Flip> = None;
    for direction in [StartDirection::Increasing, StartDirection::Decreasing] {
        let Some((mut problem, start)) = half_orbit(path, &present)? else { return Ok(None) };
        let found = flip_ahead(path, &mut problem, &start, (direction, longest));
        let off = |flip: &Flip| (flip.point.parameter() - here).abs();
        if let Some(found) = found
            && nearest.as_ref().is_none_or(|nearest| off(&found) < off(nearest))
        {
            nearest = Some(found);
        }
    }
    Ok(nearest)
}

/// The equations of the orbit of half the period, and the mean of the two halves of the present one, at which
/// the path is; `None` where its periods cannot be halved.
fn half_orbit(
    path: &mut OrbitPath,
    present: &[f64],
) -> Result<Option<(ShootingProblem, Vec<f64>)>, OrbitError> {
    let problem = &mut path.problem;
    let (multiple, segments) = (problem.period_multiple(), problem.segments());
    if !multiple.is_multiple_of(2) {
        return Ok(None);
    }
    problem.move_to(present)?;
    let frequency_hz = problem.frequency(present);
    let mut nodes = problem.nodes(present);
    if !segments.is_multiple_of(2) {
        let begin = (problem.phase(), nodes[0].as_slice());
        nodes = nodes_from(problem.integrator(), begin, frequency_hz, multiple, 2)?;
    }
    let later = nodes.split_off(nodes.len() / 2);
    for (node, later) in nodes.iter_mut().zip(&later) {
        node.iter_mut().zip(later).for_each(|(a, b)| *a = 0.5 * (*a + b));
    }
    let integrator = ExactIntegrator::new(problem.system().clone(), problem.integrator().settings())?;
    let (scale, length) = (problem.scale().clone(), problem.hertz_per_norm());
    let cut = (multiple / 2, nodes.len());
    let mut half = ShootingProblem::new(integrator, cut, scale, length).beginning_at(problem.phase());
    half.watch_stability();
    half.vary(problem.varied())?;
    let start = half.point(&nodes, present[present.len() - 1]);
    Ok(Some((half, start)))
}

/// The first flip on the path from `start`, in steps of at most this length.
fn flip_ahead(
    path: &OrbitPath,
    problem: &mut ShootingProblem,
    start: &[f64],
    (direction, longest): (StartDirection<'_>, f64),
) -> Option<Flip> {
    let settings = OrbitSettings { max_step_hz: longest, ..path.settings };
    let settings = path_settings(&settings, problem.system(), problem.hertz_per_norm());
    let range = ParameterRange::new(path.range_hz.0, path.range_hz.1).ok()?;
    let mut follower = Follower::start(problem, start, direction, range, settings).ok()?;
    for _ in 0..MOST_STEPS {
        let StepOutcome::Accepted = follower.step(problem) else { return None };
        let point = follower.current();
        if point.events.zeros & 1 == 0 {
            continue;
        }
        let place = located::Place {
            point,
            bend: 0.0,
            at_corners: follower.settings().min_step,
            contacts: Vec::new(),
            computed: None,
            before: None,
        };
        let uncertainty = located::describe(problem, place)?.uncertainty;
        return Some(Flip { nodes: problem.nodes(&point.point), point: point.clone(), uncertainty });
    }
    None
}
