//! Whether a walk of asymmetric orbits that gets no further has come to symmetric ones.
//!
//! Where a pair of mirror images leaves the symmetric orbits of a symmetric system, the path of the pair goes
//! through the branch point from one image to the other, and so does a walk. But beside it the equations are
//! singular, and where the two images are hardly apart rounding holds up the steps before the branch point is
//! met. Then the walk has arrived: beyond are the images of what it has come along. Steps that lead on from
//! there lead onto the symmetric orbits.

use super::orbit_path::OrbitPath;

/// Distance from the symmetric orbits, relative to the orbit, within which a walk that came ever nearer has
/// arrived when its steps fail.
const ARRIVED: f64 = 1e-6;

/// Whether the last orbits of a walk came ever nearer to symmetric ones, up to [`ARRIVED`].
pub(super) fn has_come_to_symmetric(path: &mut OrbitPath) -> bool {
    let arrived = ARRIVED * path.length_per_norm();
    let OrbitPath { problem, follower, .. } = path;
    if !problem.is_asymmetric() || problem.move_to(&follower.current().point).is_err() {
        return false;
    }
    let history = &follower.state().history;
    let nodes = &history.nodes[..history.used];
    let left: Vec<f64> = nodes.iter().map(|node| problem.distance_to_symmetric(&node.point)).collect();
    problem.has_symmetric_orbits()
        && left.len() > 1
        && left[0] < arrived
        && left.windows(2).all(|pair| pair[0] < pair[1])
}
