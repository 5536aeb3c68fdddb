//! Cutting the orbit of a walk into more segments, where its multipliers have outgrown the present ones.
//!
//! The new follower keeps neither the memory nor the start of the old one: a loop that is walked past a re-cut is recognised as closed
//! when it comes back to the place of the re-cut, and its first part may be walked twice.
//!
//! New nodes lie on the motion from the old ones; their tangents follow from the flow, `t_j = dZ/dz t_k + dZ/df t_f`. The walk goes on
//! along the tangent, so its direction is kept; the orientation of the path does not depend on the number of segments.

use hammerbeam_motion::Stretch;
use hammerbeam_path::{Direction, Follower, ParameterRange};

use crate::{BranchWalk, OrbitError, shooting::ShootingProblem, walk::path_settings};

/// Segments become this many times as many,
const FACTOR: usize = 4;
/// up to this number.
const MOST: usize = 64;

impl BranchWalk {
    /// Goes on from the present point with more segments; false if there are enough already.
    pub(crate) fn resegment(&mut self) -> Result<bool, OrbitError> {
        let segments = self.problem.segments() * FACTOR;
        if segments > MOST {
            return Ok(false);
        }
        let current = self.follower.current().clone();
        let (point, tangent) = refine(&mut self.problem, &current.point, &current.tangent)?;
        self.problem.set_segments(segments);
        let range = ParameterRange::new(self.range_hz.0, self.range_hz.1)?;
        let settings = path_settings(&self.settings, crate::walk::hertz_per_norm(self.range_hz));
        let direction = Direction::Along(&tangent);
        match Follower::start(&mut self.problem, &point, direction, range, settings) {
            Ok(follower) => self.follower = follower,
            // The walk stays where it was; its own reason to stop is told.
            Err(_) => {
                self.problem.set_segments(segments / FACTOR);
                return Ok(false);
            }
        }
        self.journal.push(self.follower.current().clone());
        Ok(true)
    }
}

/// Point and tangent with every segment cut into [`FACTOR`].
fn refine(
    problem: &mut ShootingProblem,
    point: &[f64],
    tangent: &[f64],
) -> Result<(Vec<f64>, Vec<f64>), OrbitError> {
    let (size, old) = (problem.node_size(), problem.segments());
    let (frequency_hz, frequency_tangent) = (point[old * size], tangent[old * size]);
    let scales = problem.scale().values().to_vec();
    let unscaled = |values: &[f64]| values.iter().zip(&scales).map(|(x, s)| x * s).collect::<Vec<f64>>();
    let (mut points, mut tangents) = (Vec::new(), Vec::new());
    for segment in 0..old {
        let stretch = problem.stretch(segment, frequency_hz);
        let place = segment * size..(segment + 1) * size;
        let (mut state, mut slope) = (unscaled(&point[place.clone()]), unscaled(&tangent[place]));
        for part in 0..FACTOR {
            points.extend(state.iter().zip(&scales).map(|(z, s)| z / s));
            tangents.extend(slope.iter().zip(&scales).map(|(z, s)| z / s));
            let phase = |k: usize| stretch.start + (stretch.end - stretch.start) * k as f64 / FACTOR as f64;
            let piece = Stretch { frequency_hz, start: phase(part), end: phase(part + 1) };
            let flow = problem.integrator().flow(&piece, &state)?;
            let carried = |i: usize| (0..size).map(|j| flow.by_state[(i, j)] * slope[j]).sum::<f64>();
            slope = (0..size).map(|i| carried(i) + flow.by_frequency[i] * frequency_tangent).collect();
            state = flow.state;
        }
    }
    points.push(frequency_hz);
    tangents.push(frequency_tangent);
    Ok((points, tangents))
}
