//! The jobs that a branch gives: where a flip or a branch point lets another branch leave, and beyond a
//! frequency at which it goes to infinity.

use hammerbeam_orbit::Side;
use hammerbeam_results::{
    end::BranchEnd,
    store::{JobKind, Store, StoreError, solution_key},
};

use super::{
    agenda::{Agenda, Start},
    plan::Plan,
};

/// Adds the jobs of finished branches that a greater depth asks for; those that are there already are left
/// out.
pub(super) fn add_wanted(agenda: &mut Agenda, store: &mut Store, plan: &Plan) -> Result<(), StoreError> {
    let finished = agenda.jobs.iter().filter(|job| job.record.outcome.is_some());
    let jobs: Vec<_> = finished
        .flat_map(|job| job.starts.iter().map(|start| (start, job.record.depth)))
        .flat_map(|(start, depth)| of_branch(start, depth, plan))
        .collect();
    store.add_jobs(&jobs)?;
    agenda.add_new_jobs(store)
}

/// Jobs at the flips and branch points of a branch, end to end along it.
pub(super) fn of_branch(start: &Start, depth: u32, plan: &Plan) -> Vec<(JobKind, f64, Option<i64>, u32)> {
    let down = (0..start.down.rows.len()).rev().map(|number| (Side::Down, number));
    let up = (0..start.up.rows.len()).map(|number| (Side::Up, number));
    let events = down.chain(up).filter_map(|(side, number)| at_row(start, (side, number), depth, plan));
    let beyond =
        [Side::Down, Side::Up].into_iter().filter_map(|side| beyond_any_amplitude(start, side, plan));
    events.chain(beyond.filter(|_| start.period_multiple == 1)).collect()
}

/// Distance from a frequency at which the amplitude may be any to where the next harmonic one is looked for,
/// in parts of the range.
const BEYOND: f64 = 1e-3;

/// A search for the harmonic branch on the other side of a frequency at which the amplitude may be any.
fn beyond_any_amplitude(start: &Start, side: Side, plan: &Plan) -> Option<(JobKind, f64, Option<i64>, u32)> {
    let walk = start.walk(side);
    let ends = walk.end.as_ref().is_some_and(BranchEnd::has_any_amplitude);
    let last = walk.rows.last().filter(|_| ends && plan.multiples.contains(&1))?.frequency_hz;
    let [low, high] = plan.range_hz;
    let step = BEYOND * (high - low);
    let before = walk.rows.iter().rev().find(|row| (row.frequency_hz - last).abs() > step)?.frequency_hz;
    let at_hz = last + step.copysign(last - before);
    let key = solution_key(start.key, side, walk.rows.len() as u32 - 1);
    (low..=high).contains(&at_hz).then_some((JobKind::Harmonic, at_hz, Some(key), 0))
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
    let at_flip = row.flip && (plan.unstable || row.else_stable);
    if at_flip && plan.wants_doubling(start.period_multiple, depth) {
        return Some((JobKind::Doubling, row.frequency_hz, Some(key), depth + 1));
    }
    // The first row of a branch that leaves another one is where it does so; the last one where it comes to
    // one of shorter period is there, too.
    let is_root = side == Side::Up && number == 0;
    let meets_shorter =
        number + 1 == walk.rows.len() && walk.end.as_ref().is_some_and(BranchEnd::is_shorter_period);
    let crosses = row.branch_point && !is_root && !meets_shorter;
    crosses.then_some((JobKind::Crossing, row.frequency_hz, Some(key), depth))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::agenda::{
        Sketch,
        examples::{self, row},
    };

    fn jobs(unstable: bool) -> Vec<(JobKind, f64, Option<i64>, u32)> {
        let plan = Plan { unstable, multiples: vec![1, 2], ..examples::plan() };
        let flip = |frequency_hz, else_stable| Sketch { flip: true, else_stable, ..row(frequency_hz) };
        let start = examples::start(0, Some(1), vec![row(1.0), flip(2.0, true), flip(3.0, false)]);
        of_branch(&start, 0, &plan)
    }

    #[test]
    fn without_unstable_starts_only_flips_of_stable_solutions_are_left() {
        let places = |unstable| jobs(unstable).iter().map(|job| job.1).collect::<Vec<_>>();
        assert_eq!(places(true), [2.0, 3.0]);
        assert_eq!(places(false), [2.0]);
    }
}
