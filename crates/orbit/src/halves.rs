//! Orbits whose ends have to keep clear of impacts, cut into two segments and made one again.
//!
//! A symmetric orbit comes to graze two opposite rigid stops at once. Over one segment the speed `v` of the
//! first touch, which goes like the root of its depth, moves the second one, whose speed then goes like the
//! root of `v`: the corner there is none of those that the path crate turns. Cut in two, each touch lies in a
//! segment of its own, and depends on the state before it alone. The multipliers grow like the product of
//! `1/v` of all touches, so an orbit of several slow impacts is better cut, too.
//!
//! The phases at which a cut orbit begins and is cut must both be clear of impacts. Where an impact comes
//! near one of them the orbit is made one segment again, whose begin may move.

use hammerbeam_path::{ContinuationPoint, Node};

use crate::{
    BranchWalk,
    cut::{contacts, folded, longest_of_orbit},
    recut::Origin,
    resegment::refine,
};

impl BranchWalk {
    /// Goes on with orbits of two segments; false if the walk stays as it was: an orbit of one impact needs
    /// no second segment, and there may be no room for it.
    pub(crate) fn cut_in_halves(&mut self) -> bool {
        let of_rigid_stops = self.problem.system().has_rigid_stops();
        if self.problem.segments() != 1 || !of_rigid_stops || self.halves_are_clear() != Some(true) {
            return false;
        }
        let Ok(current) = refine(&mut self.problem, &self.follower.current().clone(), 2) else {
            return false;
        };
        let begun = self.follower.has_start().then(|| self.follower.checkpoint().start.clone());
        let start = begun.and_then(|start| refine(&mut self.problem, &start, 2).ok());
        self.go_on_with(2, &current, start.as_ref())
    }

    /// Makes orbits of two segments one again where an impact comes near their ends, or the start of the walk
    /// is to be found again.
    pub(crate) fn join_halves_at_contacts(&mut self) {
        if self.halves_are_clear() == Some(true) && !self.is_near_lost_start() {
            return;
        }
        let size = self.problem.node_size();
        let current = first_node(self.follower.current(), size);
        let start = self.follower.has_start().then(|| first_node(&self.follower.checkpoint().start, size));
        self.go_on_with(1, &current, start.as_ref());
    }

    /// Whether the begin and the middle of the present orbit are clear of impacts; none where it has a single
    /// one, for which halves are of no use, or cannot be followed.
    fn halves_are_clear(&mut self) -> Option<bool> {
        let point = self.follower.current().point.clone();
        self.problem.move_to(&point).ok()?;
        let (phase, cycles) = (self.problem.phase(), f64::from(self.problem.period_multiple()));
        let (frequency_hz, state) =
            (self.problem.frequency(&point), self.problem.nodes(&point).swap_remove(0));
        let contacts = contacts(self.problem.integrator(), (phase, cycles), &state, frequency_hz).ok()?;
        match contacts.len() {
            0 => return Some(true),
            1 => return None,
            _ => {}
        }
        let (gap, nearest) = longest_of_orbit(&folded(&contacts, 0.5 * cycles), 0.5 * cycles, false)?;
        Some(!gap.asks_to_move(nearest))
    }

    fn go_on_with(&mut self, segments: usize, current: &Node, start: Option<&Node>) -> bool {
        let before = self.problem.segments();
        let origin = self.origin_now();
        self.problem.set_segments(segments);
        let mut moved = start.is_some() && self.follower.transfer(&mut self.problem, current, start).is_ok();
        if !moved {
            // The start is brought back where the path comes near it.
            moved = self.follower.transfer(&mut self.problem, current, None).is_ok();
        }
        if moved {
            self.origin = origin;
            self.last_rows.keep_newest();
        } else {
            self.problem.set_segments(before);
        }
        moved
    }

    /// The start of the walk as an orbit of one segment.
    fn origin_now(&self) -> Option<Origin> {
        let of_start = || {
            let mut point = self.follower.in_first_units(&self.follower.checkpoint().start);
            let node = first_node(&point, self.problem.node_size());
            (point.point, point.tangent) = (node.point, node.tangent);
            Origin { phase: self.problem.phase(), point }
        };
        self.origin.clone().or_else(|| self.follower.has_start().then(of_start))
    }
}

/// The first node of a point and the last unknown, with the tangent there.
fn first_node(at: &ContinuationPoint, size: usize) -> Node {
    let of = |values: &[f64]| values[..size].iter().chain(values.last()).copied().collect();
    Node { point: of(&at.point), tangent: of(&at.tangent) }
}
