//! The flip at which a branch of doubled period ends, from the branch that flips there.
//!
//! Beside the flip an orbit of doubled period is one of half its period and a small part `d` that alternates.
//! Its equations are singular there, and rounding can hold up the steps before the branch point is met. For
//! the orbit of half the period the flip is a place like any other: `A - I` is regular, since the multiplier
//! is -1. So a walk starts on that branch, at the mean of the two halves, which is `O(d^2)` away from it, and
//! goes to both sides until a multiplier passes -1. The orbit there, run through twice, is the last one of
//! the branch of doubled period.
//!
//! That holds if the flip is near: nothing else is taken for it. Where a contact grazes, multipliers may jump
//! over -1: then that grazing is the end.

use hammerbeam_motion::exact::ExactIntegrator;
use hammerbeam_path::{
    ContinuationPoint, Follower, ParameterRange, PathEvents, PathProblem, StartDirection, StepOutcome,
    distance,
};

use super::{
    OrbitPath,
    row::{RowRecord, row_at},
    settings::path_settings,
};
use crate::{
    BranchRow, OrbitError, OrbitSettings, StopReason, located,
    shooting::ShootingProblem,
    solve::{evaluate, nodes_from},
};

/// The flip lies no farther from the mean of the two halves than they from each other, since it goes with
/// the square of that; or within this part of a longest step of the walk, if that is more: of halves that
/// differ by rounding alone the distance says little.
const PART: f64 = 2e-3;
/// Steps to each side, at most.
const STEPS_TO_FLIP: usize = 16;

/// The orbit of half the period at its flip.
struct Flip {
    point: ContinuationPoint,
    nodes: Vec<Vec<f64>>,
    /// Within which the frequency, or what varies, is known.
    uncertainty: f64,
    /// It is where a contact grazes, behind which a multiplier jumps over -1.
    grazes: bool,
}

/// The equations of the orbit of half the period, and a point near its path.
struct Half {
    problem: ShootingProblem,
    mean: Vec<f64>,
    /// Within which the flip is looked for, in arc length.
    reach: f64,
}

/// A walk that ends at the flip of a branch of shorter period, without having located it as a branch point
/// of its own, ends in the row of that flip: the end with its place. Where no flip is found nearby, or its
/// motion cannot be computed, it ends as it did.
pub(super) fn end_in_flip(
    path: &mut OrbitPath,
    record: &mut RowRecord,
    end: StopReason,
    rows: &mut Vec<BranchRow>,
) -> Result<StopReason, OrbitError> {
    let is_flip = matches!(end, StopReason::ShorterPeriod { grazes: false, .. });
    if !is_flip || path.current().events.branch_point {
        return Ok(end);
    }
    let (row, grazes) = match row_of_flip(path, &mut record.evaluations_between) {
        Ok(Some(found)) => found,
        Ok(None) | Err(OrbitError::Motion(_) | OrbitError::Eigenvalues(_)) => return Ok(end),
        Err(error) => return Err(error),
    };
    let place = row.parameter.unwrap_or(row.solution.frequency_hz);
    rows.push(row);
    Ok(StopReason::ShorterPeriod { place, grazes })
}

/// Whether the branch of half the period flips nearby, but farther from the present orbit than this part of
/// its frequency, or of what varies.
pub(super) fn flips_elsewhere(path: &mut OrbitPath, part: f64) -> bool {
    let mut evaluations = 0;
    let flip = nearest_flip(path, &mut evaluations);
    let here = path.follower.current().point.clone();
    let size = path.problem.parameter_size(&here);
    let off = |flip: Flip| (flip.point.parameter() - path.parameter()).abs();
    let is_elsewhere = flip.ok().flatten().map(off).is_some_and(|off| off > part * size);
    // The motion at the present orbit is asked for next.
    evaluate(&mut path.problem, &here).is_ok() && is_elsewhere
}

/// The row of the flip beside the present orbit, as the last one of its branch; `None` where the orbit of
/// half the period does not flip nearby.
fn row_of_flip(path: &mut OrbitPath, evaluations: &mut u64) -> Result<Option<(BranchRow, bool)>, OrbitError> {
    let Some(flip) = nearest_flip(path, evaluations)? else { return Ok(None) };
    let (present, problem) = (path.follower.current(), &mut path.problem);
    let nodes = if problem.segments().is_multiple_of(2) {
        [flip.nodes.as_slice(), &flip.nodes].concat()
    } else {
        let start = (problem.phase(), flip.nodes[0].as_slice());
        let (multiple, segments) = (problem.period_multiple(), problem.segments());
        problem.move_to(&flip.point.point)?;
        let frequency_hz = problem.frequency(&flip.point.point);
        nodes_from(problem.integrator(), start, frequency_hz, multiple, segments)?
    };
    // The branch arrives along the direction that alternates, as the present tangent nearly does.
    let last = ContinuationPoint {
        point: problem.point(&nodes, flip.point.parameter()),
        events: PathEvents {
            branch_point: !flip.grazes,
            signature_change: flip.grazes,
            ..PathEvents::default()
        },
        correction_norm: flip.point.correction_norm,
        residual_norm: flip.point.residual_norm,
        ..present.clone()
    };
    evaluate(problem, &last.point)?;
    *evaluations += 1;
    let located = located::describe(problem, located::EventLocation::alone(&last, Some(flip.uncertainty)));
    Ok(Some((BranchRow { located, ..row_at(path, &last)? }, flip.grazes)))
}

/// The nearest flip of the branch of half the period.
fn nearest_flip(path: &mut OrbitPath, evaluations: &mut u64) -> Result<Option<Flip>, OrbitError> {
    let here = path.parameter();
    let off = |flip: &Flip| (flip.point.parameter() - here).abs();
    let Some(mut half) = half_orbit(path)? else { return Ok(None) };
    let mut nearest: Option<Flip> = None;
    for direction in [StartDirection::Increasing, StartDirection::Decreasing] {
        let found = flip_ahead(path, &mut half, direction, evaluations);
        if let Some(found) = found
            && nearest.as_ref().is_none_or(|nearest| off(&found) < off(nearest))
        {
            nearest = Some(found);
        }
    }
    Ok(nearest)
}

/// The orbit of half the period beside the present one; `None` where its periods cannot be halved.
fn half_orbit(path: &mut OrbitPath) -> Result<Option<Half>, OrbitError> {
    let least = PART * path.settings.max_step;
    let (present, problem) = (&path.follower.current().point, &mut path.problem);
    let (multiple, segments) = (problem.period_multiple(), problem.segments());
    if !multiple.is_multiple_of(2) {
        return Ok(None);
    }
    problem.move_to(present)?;
    let frequency_hz = problem.frequency(present);
    let mut nodes = problem.nodes(present);
    if !segments.is_multiple_of(2) {
        let start = (problem.phase(), nodes[0].as_slice());
        nodes = nodes_from(problem.integrator(), start, frequency_hz, multiple, 2)?;
    }
    let later = nodes.split_off(nodes.len() / 2);
    let (scale, length) = (problem.scale().clone(), problem.length_per_norm());
    let squares: f64 = nodes.iter().zip(&later).map(|(a, b)| scale.distance(a, b).powi(2)).sum();
    let apart = length * (squares / nodes.len() as f64).sqrt();
    for (node, later) in nodes.iter_mut().zip(&later) {
        node.iter_mut().zip(later).for_each(|(a, b)| *a = 0.5 * (*a + b));
    }
    let integrator = ExactIntegrator::new(problem.system().clone(), problem.integrator().settings())?;
    let cut = (multiple / 2, nodes.len());
    let mut half = ShootingProblem::new(integrator, cut, scale, length).starting_at(problem.phase());
    half.watch_stability();
    half.vary(problem.varied())?;
    let mean = half.point(&nodes, present[present.len() - 1]);
    let reach = apart.max(least);
    Ok(reach.is_finite().then_some(Half { problem: half, mean, reach }))
}

/// The first flip on the path of half the period in this direction, if it is within reach.
fn flip_ahead(
    path: &OrbitPath,
    Half { problem, mean, reach }: &mut Half,
    direction: StartDirection<'_>,
    evaluations: &mut u64,
) -> Option<Flip> {
    let settings = OrbitSettings { max_step: 0.25 * *reach, ..path.settings };
    let settings = path_settings(&settings, problem.system(), problem.length_per_norm());
    let range = ParameterRange::new(path.range.0, path.range.1).ok()?;
    let mut follower = Follower::start(problem, mean, direction, range, settings).ok()?;
    for _ in 0..STEPS_TO_FLIP {
        if distance(problem.weights(), &follower.current().point, mean) > *reach {
            break;
        }
        let before = follower.counters().evaluations;
        let outcome = follower.step(problem);
        *evaluations += follower.counters().evaluations - before;
        let StepOutcome::Accepted = outcome else { break };
        let point = follower.current();
        if point.events.zeros & 1 == 0 {
            continue;
        }
        let is_near = distance(problem.weights(), &point.point, mean) <= *reach;
        if point.events.signature_change {
            let corner = follower.passed_corner();
            let (place, uncertainty) = corner
                .map_or((&point.point, point.uncertainty), |corner| (&corner.beside, corner.uncertainty));
            return is_near.then(|| Flip {
                nodes: problem.nodes(place),
                point: ContinuationPoint { point: place.clone(), ..point.clone() },
                uncertainty,
                grazes: true,
            });
        }
        let is_smooth = !point.events.corner && follower.passed_corner().is_none();
        let approach = located::Approach::of(&follower, problem, point);
        let located = located::describe(problem, located::EventLocation::reached(point, approach))?;
        let off = located.multiplier.map_or(f64::INFINITY, |[re, im]| (1.0 + re).hypot(im));
        let is_flip = is_near && is_smooth && off <= located::SHARP_MULTIPLIER;
        return is_flip.then(|| Flip {
            nodes: problem.nodes(&point.point),
            point: point.clone(),
            uncertainty: located.uncertainty,
            grazes: false,
        });
    }
    None
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

    use hammerbeam_motion::{Law, System, law::LinearStop};

    use super::row_of_flip;
    use crate::{
        BranchWalk, Crossing, OrbitSettings, Response, Segments, Side, find_start,
        test_oscillator::oscillator,
    };

    const RANGE: (f64, f64) = (0.12, 0.5);

    /// `x'' + 0.1 x' + x = cos(2 pi f t)`, with 19 N/m more beyond `x = 0`.
    fn bilinear() -> (System, Response) {
        oscillator(0.1, 1.0, Law::Linear(LinearStop::with_gap(19.0, 0.0).unwrap()))
    }

    /// The first flip above 0.3 Hz.
    fn flip((system, response): &(System, Response), settings: &OrbitSettings) -> Crossing {
        let start = find_start(system, response, 0.3, 1, settings).unwrap();
        let mut walk = BranchWalk::new(system, response, &start, Side::Up, RANGE, settings).unwrap();
        loop {
            assert_eq!(walk.step(&mut Vec::new()).unwrap(), None);
            if let Some(flip) = walk.flip_here().unwrap() {
                return flip;
            }
        }
    }

    /// From its first solutions, which alternate by a thousandth to a tenth, in any number of segments.
    #[test]
    fn the_flip_is_found_from_the_branch_that_leaves_there() {
        for segments in [Segments::Automatic, Segments::Fixed(3)] {
            let settings = OrbitSettings { max_step: 0.001, segments, ..OrbitSettings::default() };
            let subject = bilinear();
            let flip = flip(&subject, &settings);
            let (system, response) = &subject;
            let mut walk =
                BranchWalk::from_crossing(system, response, &flip, Side::Up, RANGE, &settings).unwrap();
            for _ in 0..14 {
                assert_eq!(walk.step(&mut Vec::new()).unwrap(), None);
                let (mut evaluations, at) = (0, flip.orbit.frequency_hz);
                let (row, _) = row_of_flip(&mut walk.path, &mut evaluations).unwrap().unwrap();
                assert!(evaluations > 2 && row.events.branch_point);
                assert!((row.solution.frequency_hz - at).abs() < 1e-12, "{}", row.solution.frequency_hz);
                assert_eq!(row.solution.period_multiple, 2);
            }
        }
    }

    /// An orbit run through twice does not alternate; where it flips far away there is no end.
    #[test]
    fn a_flip_far_away_is_none() {
        let settings = OrbitSettings { max_step: 0.001, ..OrbitSettings::default() };
        let (system, response) = bilinear();
        let orbit = find_start(&system, &response, 0.3, 1, &settings).unwrap();
        let twice = Crossing { orbit, direction: Vec::new(), factor: 2 };
        let twice = twice.root(&system, &response, &settings).unwrap();
        let mut walk = BranchWalk::new(&system, &response, &twice, Side::Up, RANGE, &settings).unwrap();
        assert_eq!(row_of_flip(&mut walk.path, &mut 0).unwrap(), None);
    }
}
