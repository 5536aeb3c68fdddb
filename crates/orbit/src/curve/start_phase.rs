//! Moving the phase at which the orbits of a curve are cut into segments, before a contact comes to lie over
//! an end of one at which fundamental matrices jump.
//!
//! The gradient of a condition is made of differences of fundamental matrices. Where a stop with a damper
//! closes, its force jumps, and with it the rate of the motion: the matrix of a segment jumps where that
//! instant passes over the segment's end, and a difference over it is meaningless. So before each step the
//! contacts of the present orbit are looked at (`cut.rs`), and where one is near an end, all nodes are
//! carried by the flow to the middle of the longest time that is clear of them in every segment: `t_k' = G_k
//! t_k + dZ_k/df t_f + dZ_k/dp t_p`.
//!
//! Multipliers do not depend on the phase: with the fundamental matrix `P` from the first node to where it is
//! carried, `A' = P A P^-1`, so that the right null vector becomes `P v` and the left one `P^-T w`. The
//! borders are taken at the new phase with the signs that this gives, so that the curve keeps its
//! orientation.
//!
//! The start of the curve is carried along, so that a closed curve is seen to close; where it cannot be
//! followed there, it is out of reach. Grazing curves are cut where the contact is touched, wherever that is.

use hammerbeam_motion::{Stretch, exact::MotionError};
use hammerbeam_path::{ContinuationPoint, Node};

use super::{problem::CurveProblem, walk::CurveWalk};
use crate::{OrbitError, cut::offset_to_clear};

impl CurveWalk {
    /// Keeps the ends of segments away from contacts; where that does not go, the curve stays as it was.
    pub(super) fn keep_phase_clear(&mut self) {
        if self.problem.condition.has_phase() || self.follower.stop_reason().is_some() {
            return;
        }
        if let Ok(Some(offset)) = self.offset() {
            let before = (self.problem.cut_phase, self.problem.condition.clone());
            if self.move_phase(offset).is_err() {
                (self.problem.cut_phase, self.problem.condition) = before;
            }
        }
    }

    fn offset(&mut self) -> Result<Option<f64>, MotionError> {
        let place = self.problem.place(&self.follower.current().point);
        let shooting = &mut self.problem.shooting;
        shooting.set_parameter(place.value)?;
        let (scales, cycles) = (shooting.scale.values(), shooting.cycles());
        let state: Vec<f64> = place.nodes.iter().zip(scales).map(|(x, s)| x * s).collect();
        let phases = (place.phase, cycles, cycles / shooting.count as f64);
        offset_to_clear(&mut shooting.integrator, phases, &state, place.frequency_hz)
    }

    fn move_phase(&mut self, offset: f64) -> Result<(), OrbitError> {
        let current = self.follower.current().clone();
        let first = self.follower.state().has_start().then(|| self.follower.state().start.clone());
        let start = first.and_then(|first| Some((carried(&mut self.problem, &first, offset).ok()?.0, first)));
        let (node, matrix) = carried(&mut self.problem, &current, offset)?;
        let cycles = f64::from(self.problem.shooting.period_multiple);
        self.problem.cut_phase = (self.problem.cut_phase + offset).rem_euclid(cycles);
        let place = self.problem.place(&node.point);
        self.problem.shooting.evaluate(&place)?;
        self.problem.condition.carry(&self.problem.shooting, &matrix);
        let with_start = start.as_ref().map(|(start, first)| (start, first));
        let moved = self.follower.transfer_afresh(&mut self.problem, &node, with_start);
        if moved.is_err() && with_start.is_some() {
            self.follower.transfer_afresh(&mut self.problem, &node, None)?;
        } else {
            moved?;
        }
        Ok(())
    }
}

/// Point and tangent of an orbit whose segments start this much later, and the fundamental matrix from its
/// first node to the new one, by rows.
fn carried(
    problem: &mut CurveProblem,
    at: &ContinuationPoint,
    offset: f64,
) -> Result<(Node, Vec<f64>), MotionError> {
    let place = problem.place(&at.point);
    let (mut point, mut tangent) = (at.point.clone(), at.tangent.clone());
    let shooting = &mut problem.shooting;
    shooting.set_parameter(place.value)?;
    let (size, count) = (shooting.size(), shooting.count);
    let (by_hertz, by_value) = (tangent[size * count], tangent[size * count + 1]);
    let mut first = Vec::new();
    for k in 0..count {
        let start = shooting.stretch(k, place.frequency_hz, place.phase).start;
        let stretch = Stretch { frequency_hz: place.frequency_hz, start, end: start + offset };
        let node = k * size..(k + 1) * size;
        let flow = shooting.flow_over((stretch, false), &point[node.clone()])?;
        let slope = crate::by_rows::times(&flow.matrix, &tangent[node.clone()]);
        for i in 0..size {
            point[k * size + i] = flow.end[i];
            tangent[k * size + i] =
                slope[i] + flow.by_frequency[i] * by_hertz + flow.by_parameter[i] * by_value;
        }
        if k == 0 {
            first = flow.matrix;
        }
    }
    Ok((Node { point, tangent }, first))
}
