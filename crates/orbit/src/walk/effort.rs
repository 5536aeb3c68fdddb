//! What a walk may cost, counted as work and not as time, so that no result depends on a machine.
//!
//! With `n` modes a shooting evaluation multiplies and solves matrices of `2n` rows, some `2 (2n)^3`
//! operations, and a row takes some `10 (2n)^3` for its multipliers; the motion counts its own
//! ([`ExactCounts::operations`](hammerbeam_motion::exact::ExactCounts)). An operation is about a nanosecond:
//! the beam of the paper, with six modes, takes some 1e5 to 1e6 for a solution. A side of a branch may take
//! [`MOST`]; and it is left before where [`MOST`]`/`[`PARTS`] of them did not move it by [`PROGRESS`] of the
//! range in arc length: where it chatters, say, and every orbit has ten thousand impacts.

use super::BranchWalk;
use crate::StopReason;

/// Operations of one side of a branch.
const MOST: u64 = 1_000_000_000_000;
/// Parts of them at the end of each of which a walk must have got on.
const PARTS: u64 = 40;
/// Arc length that is getting on, relative to the range. In arc length a change of the orbit by its own size
/// counts like a hundredth of the range.
const PROGRESS: f64 = 1e-4;

/// The work of a walk.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Effort {
    /// Operations up to the last departure.
    pub spent: u64,
    /// Those, and the arc length, when the walk last had got on.
    pub mark: (u64, f64),
    /// What the counters said at the last departure.
    pub counted: u64,
}

impl BranchWalk {
    /// What the counters of the walk say now: operations since it was begun or taken up. Differences depend
    /// on the path only.
    pub(crate) fn counted_operations(&self) -> u64 {
        let cube = (self.problem.node_size() as u64).pow(3);
        let rows = self.follower.counters().accepted;
        self.problem.counts().operations + cube * (2 * self.evaluations() + 10 * rows)
    }

    /// Operations since the start of the walk.
    pub(crate) fn operations(&self) -> u64 {
        self.effort.spent + (self.counted_operations() - self.effort.counted)
    }

    /// Why the walk ends, if it has taken too much work, or too much for how far it got.
    pub(super) fn is_too_laborious(&mut self) -> Option<StopReason> {
        self.effort.spent = self.operations();
        self.effort.counted = self.counted_operations();
        let arc_length = self.follower.current().arc_length;
        let (low, high) = self.range_hz;
        if (arc_length - self.effort.mark.1).abs() >= PROGRESS * (high - low) {
            self.effort.mark = (self.effort.spent, arc_length);
        }
        let gets_on = self.effort.spent - self.effort.mark.0 <= MOST / PARTS;
        (!gets_on || self.effort.spent > MOST).then(|| StopReason::TooLaborious {
            frequency_hz: self.follower.current().parameter(),
            solutions: self.follower.counters().accepted,
            gets_on,
        })
    }
}
