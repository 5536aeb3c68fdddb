//! Whether a walk has come to the flip of an orbit of shorter period.

use hammerbeam_path::{Judge, Node};

use super::{half_orbit::flips_elsewhere, orbit_path::OrbitPath, row::largest_multiplier};
use crate::StopReason;

/// Distance from an orbit of shorter period, relative to the orbit, below which a branch point is the flip of
/// that orbit: it is located to about the square of this in frequency.
const MERGED: f64 = 1e-3;

/// Distance from an orbit of shorter period, relative to the orbit, below which an orbit is that one.
const SAME: f64 = 1e-7;

/// Distance from an orbit of shorter period, relative to the orbit, within which a branch that goes there in
/// steps far shorter than that has arrived, if its frequency has next to nothing left to change: the flip
/// itself is then found from the other branch (`half_orbit.rs`). What holds the steps up is the error of the
/// motion, which changes with the choice of contact steps: it is more than what the frequency changes in a
/// step.
const NO_PROGRESS_NEAR: f64 = 5e-3;
/// Next to nothing left: this part of the frequency, by the slope there times the distance.
const STILL: f64 = 2e-8;
/// Farther than this part of the frequency from where a branch of half the period flips it has not arrived:
/// beside a fold, where the frequency does not change either.
const FARTHEST: f64 = 10.0 * STILL;
/// The same two where no orbit has half the period: nothing else finds the place then.
const NO_PROGRESS_AT: f64 = 1e-4;
const STILL_AT: f64 = 2e-9;
/// Nearer than this, and ever nearer, a branch has arrived, however long its steps: what is left of its slow
/// impacts at rigid stops is rounding.
const ARRIVED: f64 = 1e-6;
/// A disturbance of an orbit becomes less than so many times as large in a period beside a flip, and more
/// beside a grazing.
const GROWN: f64 = 1e4;
/// Far shorter: this part of the distance.
const LITTLE: f64 = 0.02;

/// Where the walk ends since the present point is one of a branch of shorter period: where that flips, or
/// so near to it that its place is known while steps are held up by rounding; or where the contacts
/// changed and left an orbit of shorter period, as where the impacts of an orbit that touches a rigid
/// stop in every second period vanish.
pub(super) fn meets_shorter_period(path: &mut OrbitPath) -> Option<StopReason> {
    let place = path.parameter();
    let flips = path.follower.current().events.branch_point && is_near_shorter_period(path);
    let tends = !flips && tends_to_shorter_period(path) && !flips_elsewhere(path, FARTHEST);
    let grazes = !flips && (tends && grazes_if_it_tends(path) || grazes_shorter_period(path));
    (flips || tends || grazes).then_some(StopReason::ShorterPeriod { place, grazes })
}

/// Whether the contacts have just changed and left an orbit of shorter period.
pub(super) fn grazes_shorter_period(path: &mut OrbitPath) -> bool {
    path.follower.current().events.signature_change && is_one_of_shorter_period(path)
}

/// Whether a branch that tends to an orbit of shorter period does so since a rigid stop is left: of orbits of
/// half its period it may be a flip, of others it is nothing else.
fn grazes_if_it_tends(path: &mut OrbitPath) -> bool {
    let doubles = path.problem.period_multiple().is_multiple_of(2);
    path.problem.system().has_rigid_stops() && (!doubles || largest_multiplier(path) > GROWN)
}

/// Whether the last steps have led towards an orbit of shorter period, nearer than [`NO_PROGRESS_NEAR`] of
/// the orbit, in a small part of the way that is left each, or have [`ARRIVED`].
fn tends_to_shorter_period(path: &mut OrbitPath) -> bool {
    let doubles = path.problem.period_multiple().is_multiple_of(2);
    let (near, still) = if doubles { (NO_PROGRESS_NEAR, STILL) } else { (NO_PROGRESS_AT, STILL_AT) };
    let near = near * path.length_per_norm();
    let OrbitPath { problem, follower, .. } = path;
    let history = &follower.state().history;
    let nodes = &history.nodes[..history.used];
    if nodes.len() < 2 || problem.distance_to_shorter_period(&nodes[0].point) >= near {
        return false;
    }
    let left: Vec<f64> = nodes.iter().map(|node| problem.distance_to_shorter_period(&node.point)).collect();
    let approaches = left.len() > 2 && left.windows(2).all(|pair| pair[0] < pair[1]);
    if problem.has_root_corners() && approaches && left[0] < ARRIVED * problem.length_per_norm() {
        return true;
    }
    let is_still = |(node, left): (&Node, &f64)| {
        let slope = node.tangent[node.tangent.len() - 1].abs();
        slope * left < still * problem.parameter_size(&node.point)
    };
    nodes.iter().zip(&left).all(is_still)
        && left.windows(2).all(|pair| (0.0..LITTLE * pair[0]).contains(&(pair[1] - pair[0])))
}

/// Whether the present orbit is, within [`MERGED`], one of shorter period.
pub(super) fn is_near_shorter_period(path: &mut OrbitPath) -> bool {
    distance_to_shorter_period(path) < MERGED
}

/// Whether the present orbit is one of shorter period: by its motion, or, beside a grazing impact, behind
/// which motions part so fast that its own does not decide, by its nodes, each of which Newton's method has
/// found.
fn is_one_of_shorter_period(path: &mut OrbitPath) -> bool {
    let by_motion = distance_to_shorter_period(path);
    if !(SAME..MERGED).contains(&by_motion) {
        return by_motion < SAME;
    }
    let OrbitPath { problem, follower, .. } = path;
    problem.distance_to_shorter_period(&follower.current().point) < SAME * problem.length_per_norm()
}

/// Distance of the present orbit from one of shorter period, relative to it; infinite if it has a period
/// of its own or the motion cannot be computed.
fn distance_to_shorter_period(path: &mut OrbitPath) -> f64 {
    if path.problem.period_multiple() == 1 {
        return f64::INFINITY;
    }
    path.of_present(|orbit, integrator, scale| orbit.distance_to_shorter_period(integrator, scale))
        .unwrap_or(f64::INFINITY)
}
