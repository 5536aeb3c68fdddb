//! The jobs that the events of a branch give: where a flip or a branch point lets another branch leave.

use hammerbeam_orbit::Side;

use super::{Plan, agenda::Start};
use crate::store::{JobKind, solution_key};

/// Jobs at the flips and branch points of a branch, end to end along it.
pub(super) fn of_branch(start: &Start, depth: u32, plan: &Plan) -> Vec<(JobKind, f64, Option<i64>, u32)> {
    let down = (0..start.down.rows.len()).rev().map(|number| (Side::Down, number));
    let up = (0..start.up.rows.len()).map(|number| (Side::Up, number));
    down.chain(up).filter_map(|(side, number)| at_row(start, (side, number), depth, plan)).collect()
}

fn at_row(
    start: &Start,
    (side, number): (Side, usize),
    depth: u32,
    plan: &Plan,
) -> Option<(JobKind, f64, Option<i64>, u32)> {
    let walk = start.walk(side);
    let row = walk.rows.get(number)?;
    let key = solution_key(start.key, side, number as u32);
    if row.flip && plan.wants_doubling(start.period_multiple, depth) {
        return Some((JobKind::Doubling, row.frequency_hz, Some(key), depth + 1));
    }
    // The first row of a branch that leaves another one is where it does so; the last one where it comes to one of shorter period is there, too.
    let is_root = side == Side::Up && number == 0;
    let meets_shorter = number + 1 == walk.rows.len()
        && walk.reason.as_ref().is_some_and(|reason| reason.kind == "shorter-period");
    let crosses = row.branch_point && !is_root && !meets_shorter;
    crosses.then_some((JobKind::Crossing, row.frequency_hz, Some(key), depth))
}
