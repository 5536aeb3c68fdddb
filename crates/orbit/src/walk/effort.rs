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
        let (low, high) = path.range;
        if (arc_length - self.mark.1).abs() >= PROGRESS * (high - low) {
            self.mark = (self.spent, arc_length);
        }
        let gets_on = self.spent - self.mark.0 <= MOST / PARTS;
        (!gets_on || self.spent > MOST).then(|| StopReason::TooMuchWork {
            place: path.parameter(),
            solutions: path.follower.counters().accepted,
            gets_on,
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

    use hammerbeam_motion::{Law, law::LinearStop};

    use super::{MOST, PARTS};
    use crate::{BranchWalk, OrbitSettings, Side, StopReason, find_start, test_oscillator::oscillator};

    const RANGE: (f64, f64) = (0.12, 0.5);

    /// A walk of a bilinear oscillator after some steps.
    fn walk(settings: &OrbitSettings) -> BranchWalk {
        let (system, response) = oscillator(0.1, 1.0, Law::Linear(LinearStop::with_gap(19.0, 0.0).unwrap()));
        let start = find_start(&system, &response, 0.3, 1, settings).unwrap();
        let mut walk = BranchWalk::new(&system, &response, &start, Side::Up, RANGE, settings).unwrap();
        for _ in 0..5 {
            assert_eq!(walk.step(&mut Vec::new()).unwrap(), None);
        }
        walk
    }

    #[test]
    fn work_is_counted_from_the_start_and_grows_with_every_step() {
        let settings = OrbitSettings { max_step: 0.001, ..OrbitSettings::default() };
        let mut walk = walk(&settings);
        let before = walk.operations();
        assert_eq!(walk.step(&mut Vec::new()).unwrap(), None);
        let step = walk.operations() - before;
        // Five steps before it, and the start.
        assert!(step > 0 && before > 3 * step && before < 30 * step, "{before} operations, then {step}");
    }

    #[test]
    fn a_side_ends_when_its_work_is_used_up() {
        let settings = OrbitSettings { max_step: 0.001, ..OrbitSettings::default() };
        let mut walk = walk(&settings);
        walk.effort.spent = MOST;
        walk.effort.mark.0 = MOST;
        let end = walk.step(&mut Vec::new()).unwrap();
        let at = walk.path.parameter();
        let wanted = StopReason::TooMuchWork { place: at, solutions: 5, gets_on: true };
        assert_eq!(end, Some(wanted));
    }

    /// Steps of a millionth of the range make no progress; steps of a thousandth do.
    #[test]
    fn a_side_ends_where_a_part_of_its_work_does_not_move_it() {
        for (step, ends) in [(1e-6, true), (1e-3, false)] {
            let settings = OrbitSettings { max_step: step * (RANGE.1 - RANGE.0), ..OrbitSettings::default() };
            let mut walk = walk(&settings);
            let before = walk.operations();
            assert_eq!(walk.step(&mut Vec::new()).unwrap(), None);
            let of_step = walk.operations() - before;
            // Half a step's work is left of the part that began here.
            let not_counted_yet = walk.operations() - walk.effort.spent;
            walk.effort.mark = (0, walk.path.current().arc_length);
            walk.effort.spent = MOST / PARTS - of_step / 2 - not_counted_yet;
            let end = (0..3).find_map(|_| walk.step(&mut Vec::new()).unwrap());
            let is_end = matches!(end, Some(StopReason::TooMuchWork { gets_on: false, .. }));
            assert_eq!((is_end, end.is_some()), (ends, ends), "{end:?}");
        }
    }
}
