//! Whether a walk of asymmetric orbits has come to symmetric ones.
//!
//! Where a pair of mirror images leaves the symmetric orbits of a symmetric system, the path of the pair goes
//! through the branch point from one image to the other, and so does a walk. But beside it the equations are
//! singular, and where the two images are hardly apart rounding holds up the steps before the branch point is
//! met. Then the walk has arrived: beyond are the images of what it has come along. Steps that lead on from
//! there lead onto the symmetric orbits.

use super::orbit_path::OrbitPath;
use crate::StopReason;

/// Distance from the symmetric orbits, relative to the orbit, below which a walk that comes ever nearer has
/// arrived.
const ARRIVED: f64 = 1e-6;
/// The point before it was within so many times that: a longer step has come there by chance, and goes on.
const BEFORE: f64 = 10.0;
/// Distance within which a walk that gets no further has arrived.
const MERGED: f64 = 1e-3;

/// Where the walk ends since it has come to symmetric orbits in ever shorter steps.
pub(super) fn tends_to_symmetric(path: &mut OrbitPath) -> Option<StopReason> {
    let arrived = ARRIVED * path.hertz_per_norm();
    if distance(path)? >= arrived {
        return None;
    }
    let OrbitPath { problem, follower, .. } = path;
    let history = &follower.state().history;
    let nodes = &history.nodes[..history.used];
    let left: Vec<f64> = nodes.iter().map(|node| problem.distance_to_symmetric(&node.point)).collect();
    let approaches = left.len() > 2 && left.windows(2).all(|pair| pair[0] < pair[1]);
    (approaches && left[1] < BEFORE * arrived)
        .then(|| StopReason::Symmetric { frequency_hz: path.parameter() })
}

/// Whether the walk, of asymmetric orbits, has come to symmetric ones, if it gets no further.
pub(super) fn is_near_symmetric(path: &mut OrbitPath) -> bool {
    let merged = MERGED * path.hertz_per_norm();
    distance(path).is_some_and(|distance| distance < merged)
}

/// Distance of the present orbit from symmetric ones; `None` where the walk is not one that meets them.
fn distance(path: &mut OrbitPath) -> Option<f64> {
    let OrbitPath { problem, follower, .. } = path;
    problem.meets_symmetric().then(|| problem.distance_to_symmetric(&follower.current().point))
}
