//! Moving the phase at which the orbits of a walk begin, before a contact comes to lie over it whose law
//! remembers how it began, or an impact on a rigid stop, where the state jumps.
//!
//! Before each step the contacts of the present orbit are looked at (`cut.rs`). If one is near the phase, the
//! orbit is cut anew in the middle of its longest time without contact: the state and its tangent are carried
//! there by the flow, `t' = dZ/dz t + dZ/df t_f`. Where a step fails all the same, as at a contact that
//! appears by grazing just at the phase, the present phase counts as a contact. Multipliers and the
//! orientation of the path do not depend on the phase: `A' - I = P (A - I) P^-1` with the fundamental matrix
//! `P` in between.
//!
//! The start of the walk is cut at the new phase, too, so that a loop still closes. Where it is in contact
//! there, it is out of reach until the path comes back to its frequency.
//!
//! What is lost: the memory of the path holds first nodes, which at another phase are others. It begins anew,
//! so a stretch that was walked before the phase moved is not recognised if the path should run back into it.
//! Orbits that are cut in two (`halves.rs`) are made one segment again first; where the study gives the
//! number of segments the phase does not move.

use hammerbeam_motion::Stretch;
use hammerbeam_path::{ContinuationPoint, Node};

use crate::{
    BranchWalk, OrbitError, Segments,
    cut::{begins_with_care, contacts, longest_of_orbit},
    shooting::ShootingProblem,
};

/// The start is brought back within so many longest steps of its frequency.
const STEPS_TO_START: f64 = 2.0;

/// The start of a walk as it was begun.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Origin {
    /// Phase of its first node [cycles].
    pub phase: f64,
    /// In the first units.
    pub point: ContinuationPoint,
}

impl BranchWalk {
    /// Whether its orbits may have to begin at another phase.
    pub(crate) fn moves_phase(&self) -> bool {
        begins_with_care(self.problem.system()) && self.problem.segments() == 1
    }

    /// Keeps the phase away from contacts, and brings back the start where it can be.
    pub(crate) fn keep_phase_clear(&mut self) {
        if self.follower.stop_reason().is_some() {
            return;
        }
        if self.is_cut_in_halves() {
            self.join_halves_at_contacts();
        }
        if !self.moves_phase() {
            return;
        }
        if let Some(offset) = self.offset(false) {
            self.move_phase(offset);
        } else if self.is_near_lost_start() {
            self.move_phase(0.0);
        }
    }

    /// Moves the phase although no contact is near it: a step has failed; false if it does not go.
    pub(crate) fn flee_phase(&mut self) -> bool {
        self.moves_phase() && self.offset(true).is_some_and(|offset| self.move_phase(offset))
    }

    /// By how much the phase should move [cycles].
    fn offset(&mut self, flees: bool) -> Option<f64> {
        let point = self.follower.current().point.clone();
        self.problem.move_to(&point).ok()?;
        let (phase, cycles) = (self.problem.phase(), f64::from(self.problem.period_multiple()));
        let (frequency_hz, state) =
            (self.problem.frequency(&point), self.problem.nodes(&point).swap_remove(0));
        let contacts = contacts(self.problem.integrator(), (phase, cycles), &state, frequency_hz).ok()?;
        let (gap, nearest) = longest_of_orbit(&contacts, cycles, flees)?;
        let moves = flees || gap.asks_to_move(nearest);
        let offset = gap.middle(phase).rem_euclid(cycles);
        (moves && offset > 0.0).then_some(offset)
    }

    /// Whether its orbits were cut in two (`halves.rs`).
    fn is_cut_in_halves(&self) -> bool {
        let is_given = matches!(self.settings.segments, Segments::Fixed(_));
        begins_with_care(self.problem.system()) && self.problem.segments() == 2 && !is_given
    }

    pub(crate) fn is_near_lost_start(&self) -> bool {
        let near = STEPS_TO_START * self.settings.max_step_hz;
        let parameter = self.follower.current().parameter();
        let lost = self.origin.as_ref().filter(|_| !self.follower.has_start());
        lost.is_some_and(|origin| (origin.point.parameter() - parameter).abs() < near)
    }

    /// Cuts the present orbit and the start of the walk this much later; false if the walk stays as it was.
    fn move_phase(&mut self, offset: f64) -> bool {
        let (before, cycles) = (self.problem.phase(), f64::from(self.problem.period_multiple()));
        let phase = (before + offset).rem_euclid(cycles);
        let current = self.follower.current().clone();
        let Ok(current) = carried(&mut self.problem, &current, (before, offset)) else { return false };
        let begun = || Origin {
            phase: before,
            point: self.follower.in_first_units(&self.follower.checkpoint().start),
        };
        let origin = self.origin.clone().unwrap_or_else(begun);
        let in_units = in_units(&origin.point, self.follower.checkpoint().unit);
        let from_origin = (phase - origin.phase).rem_euclid(cycles);
        let start = carried(&mut self.problem, &in_units, (origin.phase, from_origin)).ok();
        self.problem.set_phase(phase);
        let with_start = start.as_ref().map(|start| (start, &in_units));
        let mut moved = with_start.is_some()
            && self.follower.transfer_afresh(&mut self.problem, &current, with_start).is_ok();
        if !moved && offset > 0.0 {
            moved = self.follower.transfer_afresh(&mut self.problem, &current, None).is_ok();
        }
        if !moved {
            self.problem.set_phase(before);
            return false;
        }
        self.origin = Some(origin);
        // Before the phases of the new one the journal has a point without unknowns.
        self.journal.push(ContinuationPoint::empty(0));
        self.journal.push(self.follower.in_first_units(self.follower.current()));
        self.last_rows.keep_newest();
        true
    }
}

/// A point of an orbit of one segment in units that are `unit` times the first ones.
fn in_units(point: &ContinuationPoint, unit: f64) -> ContinuationPoint {
    let mut point = point.clone();
    for values in [&mut point.point, &mut point.tangent] {
        let last = values.len() - 1;
        values[..last].iter_mut().for_each(|value| *value /= unit);
    }
    point
}

/// Point and tangent of an orbit whose first node lies this much later than at the phase `from`.
fn carried(
    problem: &mut ShootingProblem,
    at: &ContinuationPoint,
    (from, offset): (f64, f64),
) -> Result<Node, OrbitError> {
    let (mut point, mut tangent) = (at.point.clone(), at.tangent.clone());
    if offset == 0.0 {
        return Ok(Node { point, tangent });
    }
    let (size, frequency_hz) = (problem.node_size(), problem.frequency(&point));
    problem.move_to(&point)?;
    let scales = problem.scale().values().to_vec();
    let state: Vec<f64> = point.iter().zip(&scales).map(|(x, s)| x * s).collect();
    let slope: Vec<f64> = tangent.iter().zip(&scales).map(|(t, s)| t * s).collect();
    let stretch = Stretch { frequency_hz, start: from, end: from + offset };
    let flow = problem.integrator().flow(&stretch, &state)?;
    let by_last = problem.by_last(&flow);
    for i in 0..size {
        let carried: f64 = (0..size).map(|j| flow.by_state[(i, j)] * slope[j]).sum();
        point[i] = flow.state[i] / scales[i];
        tangent[i] = (carried + by_last[i] * tangent[size]) / scales[i];
    }
    Ok(Node { point, tangent })
}
