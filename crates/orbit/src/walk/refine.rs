//! A point of the path with every segment cut into smaller ones.

use hammerbeam_motion::Stretch;
use hammerbeam_path::{ContinuationPoint, Node};

use crate::{OrbitError, shooting::ShootingProblem};

/// Point and tangent with every segment cut into `factor`.
pub(super) fn refine(
    problem: &mut ShootingProblem,
    at: &ContinuationPoint,
    factor: usize,
) -> Result<Node, OrbitError> {
    let (point, tangent) = (&at.point, &at.tangent);
    let (old, last) = (problem.segments(), problem.segments() * problem.node_size());
    let frequency_hz = problem.frequency(point);
    problem.move_to(point)?;
    let (mut points, mut tangents) = (Vec::new(), Vec::new());
    for segment in 0..old {
        let stretch = problem.stretch(segment, frequency_hz);
        let phase = |k: usize| stretch.start + (stretch.end - stretch.start) * k as f64 / factor as f64;
        let mut node = problem.node_slope(point, tangent, segment);
        for part in 0..factor {
            points.extend_from_slice(&node.node);
            tangents.extend_from_slice(&node.slope);
            if part + 1 < factor {
                let piece = Stretch { frequency_hz, start: phase(part), end: phase(part + 1) };
                node = problem.carried(&node, &piece, tangent[last])?;
            }
        }
    }
    points.push(point[last]);
    tangents.push(tangent[last]);
    Ok(Node { point: points, tangent: tangents })
}
