//! A loop that comes back to a start which its follower no longer holds, or no longer knows well enough.
//!
//! Where the orbits of a walk come to start at another phase, or are cut elsewhere (`start_phase.rs`), the
//! start of the walk is an orbit of other unknowns. It is brought along if its motion allows that. Where it
//! does not, or where motions part so fast that what was brought along is another orbit, the loop would be
//! walked again and again. So each step over the parameter of the start, in the direction in which the walk
//! began, ends at the orbit there if that is the start: if its motion comes to the state with which the walk
//! began, at that phase or whole excitation periods later.

use hammerbeam_motion::Stretch;
use hammerbeam_path::{ContinuationPoint, PathEvents, PathProblem, distance};

use super::{orbit_path::OrbitPath, reopening::along_tangent};
use crate::{
    OrbitError, OrbitSettings,
    solve::{correct, evaluate},
};

/// Distance of states, relative to the orbit, below which the orbit is the start: the motion has come some
/// part of a period from where it is known.
const SAME: f64 = 1e-6;

/// The start of a walk whose orbits were cut anew, if the last step, from this point to the present one, has
/// passed it unseen.
///
/// # Errors
/// See [`OrbitError`]: the present point cannot be evaluated again.
pub(super) fn passed_lost_start(
    path: &mut OrbitPath,
    from: &ContinuationPoint,
) -> Result<Option<ContinuationPoint>, OrbitError> {
    let Some(origin) = path.origin.as_ref().filter(|_| from.arc_length > 0.0) else { return Ok(None) };
    let start = path.follower.state().in_present_units(&origin.point);
    // Behind a corner the path may go any way.
    let corner = path.follower.passed_corner().and_then(|corner| corner.beside.last().copied());
    let (here, at) = (path.current().point.clone(), start.parameter());
    let way = corner.unwrap_or(path.parameter()) - from.parameter();
    let share = (at - from.parameter()) / way;
    if !(0.0..=1.0).contains(&share) || way * start.tangent_parameter() <= 0.0 {
        return Ok(None);
    }
    let there = orbit_at(path, (from, &here), at).filter(|there| is_start(path, &start.point, there));
    // The motion at the present point is asked for next.
    evaluate(&mut path.problem, &here)?;
    Ok(there)
}

/// The orbit at this parameter, ahead of a point and no farther than another one.
fn orbit_at(
    path: &mut OrbitPath,
    (from, to): (&ContinuationPoint, &[f64]),
    at: f64,
) -> Option<ContinuationPoint> {
    let length = (at - from.parameter()) / from.tangent_parameter();
    if !(0.0..=2.0 * distance(path.problem.weights(), &from.point, to)).contains(&length) {
        return None;
    }
    let mut there = along_tangent(from, length);
    *there.point.last_mut()? = at;
    there.events = PathEvents::default();
    // The problem measures corrections in arc length.
    let tolerance = path.settings.tolerance * path.problem.length_per_norm();
    let settings = OrbitSettings { tolerance, ..path.settings };
    there.correction_norm = correct(&mut path.problem, &mut there.point, &settings).ok()?;
    Some(there)
}

/// Whether the motion from a point comes to the first node of the start.
fn is_start(path: &mut OrbitPath, start: &[f64], there: &ContinuationPoint) -> bool {
    let Some(phase) = path.origin.as_ref().map(|origin| origin.phase) else { return false };
    let problem = &mut path.problem;
    if problem.move_to(&there.point).is_err() {
        return false;
    }
    let (frequency_hz, nodes) = (problem.frequency(&there.point), problem.nodes(&there.point));
    let (cycles, scale) = (f64::from(problem.period_multiple()), problem.scale().clone());
    let part = cycles / nodes.len() as f64;
    let wanted: Vec<f64> = start.iter().zip(scale.values()).map(|(x, s)| x * s).collect();
    (0..problem.period_multiple()).any(|periods| {
        let later = (phase + f64::from(periods) - problem.phase()).rem_euclid(cycles);
        let node = ((later / part) as usize).min(nodes.len() - 1);
        let start = problem.phase() + node as f64 * part;
        let stretch = Stretch { frequency_hz, start, end: problem.phase() + later };
        let state = match stretch.end > stretch.start {
            true => problem.integrator().advance(&stretch, &nodes[node]),
            false => Ok(nodes[node].clone()),
        };
        state.is_ok_and(|state| scale.are_within(&state, &wanted, SAME))
    })
}
