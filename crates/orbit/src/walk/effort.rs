//! What a walk may cost, counted as work and not as time, so that no result depends on a machine.
//!
//! With `n` modes a shooting evaluation multiplies and solves matrices of `2n` rows, some `2 (2n)^3`
//! operations, and a row takes some `10 (2n)^3` for its multipliers; the motion counts its own
//! ([`ExactCounts::operations`](hammerbeam_motion::exact::ExactCounts)). An operation is about a nanosecond:
//! the beam of the paper, with six modes, takes some 1e5 to 1e6 for a solution. A side of a branch may take
//! [`MOST`]; and it is left before where [`MOST`]`/`[`PARTS`] of them did not move it by [`PROGRESS`] of the
//! range in arc length: where it chatters, say, and every orbit has ten thousand impacts.

use super::orbit_path::OrbitPath;
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

/// What the counters of a walk say: operations since it was started or taken up. Differences depend on the
/// path only.
///
/// * `evaluations`: of the shooting equations since the start of the walk.
pub(crate) fn counted_operations(path: &OrbitPath, evaluations: u64) -> u64 {
    let cube = (path.problem.node_size() as u64).pow(3);
    let rows = path.follower.counters().accepted;
    path.problem.counts().operations + cube * (2 * evaluations + 10 * rows)
}

impl Effort {
    /// Operations since the start of the walk, by what the counters say now.
    pub fn operations(&self, counted: u64) -> u64 {
        self.spent + (counted - self.counted)
    }

    /// Why the walk ends, if it has taken too much work, or too much for how far it got.
    pub fn end_of(&mut self, path: &OrbitPath, evaluations: u64) -> Option<StopReason> {
        let counted = counted_operations(path, evaluations);
        self.spent = self.operations(counted);
        self.counted = counted;
        let arc_length = path.current().arc_length;
        let (low, high) = path.range_hz;
        if (arc_length - self.mark.1).abs() >= PROGRESS * (high - low) {
            self.mark = (self.spent, arc_length);
        }
        let gets_on = self.spent - self.mark.0 <= MOST / PARTS;
        (!gets_on || self.spent > MOST).then(|| StopReason::TooMuchWork {
            frequency_hz: path.parameter(),
            solutions: path.follower.counters().accepted,
            gets_on,
        })
    }
}
