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
    let (size, old) = (problem.node_size(), problem.segments());
    let (frequency_hz, last_tangent) = (problem.frequency(point), tangent[old * size]);
    problem.move_to(point)?;
    let scales = problem.scale().values().to_vec();
    let unscaled = |values: &[f64]| values.iter().zip(&scales).map(|(x, s)| x * s).collect::<Vec<f64>>();
    let (mut points, mut tangents) = (Vec::new(), Vec::new());
    for segment in 0..old {
        let stretch = problem.stretch(segment, frequency_hz);
        let place = segment * size..(segment + 1) * size;
        let (mut state, mut slope) = (unscaled(&point[place.clone()]), unscaled(&tangent[place]));
        for part in 0..factor {
            points.extend(state.iter().zip(&scales).map(|(z, s)| z / s));
            tangents.extend(slope.iter().zip(&scales).map(|(z, s)| z / s));
            let phase = |k: usize| stretch.start + (stretch.end - stretch.start) * k as f64 / factor as f64;
            let piece = Stretch { frequency_hz, start: phase(part), end: phase(part + 1) };
            let flow = problem.integrator().flow(&piece, &state)?;
            let carried = |i: usize| (0..size).map(|j| flow.by_state[(i, j)] * slope[j]).sum::<f64>();
            let by_last = problem.by_last(&flow);
            slope = (0..size).map(|i| carried(i) + by_last[i] * last_tangent).collect();
            state = flow.state;
        }
    }
    points.push(point[old * size]);
    tangents.push(last_tangent);
    Ok(Node { point: points, tangent: tangents })
}
