//! What an idle thread does next: what the next decision waits for, then later jobs, then walks from starts
//! that are likely to be new.
//!
//! Walking ahead of a decision may be wasted. It is done only where the start lies on nothing that was
//! walked so far. Of walks from searches those come first whose period multiple nobody is walking, then those
//! far from the starts of the walks under way: the other end of a branch is often near. A branch that leaves
//! another one mostly comes back to it at the next flip or branch point along it. So the first of them in
//! order is walked, since it is the one that will be kept, and meanwhile the one behind it is not begun as
//! long as there is another walk. The second side of a branch waits for the first one, which may close the
//! branch, as long as there is anything else to do.
//!
//! How long a walk is shows only at its end, and a long one that begins last keeps one thread busy alone. So
//! walks of branches that leave another one, awaited or not, go on in turns: always the one that has the
//! fewest turns behind it. Walks from searches take no turns: many searches find the same branch, and the
//! first walk of it, once at its end, spares the others.

use std::sync::{Arc, atomic::AtomicBool};

use hammerbeam_orbit::{Crossing, Side};
use hammerbeam_results::store::{JobKind, JobRecord, Store, StoreError, start_of_key};

use super::{
    BranchOrigin, Plan, Solver,
    agenda::{Agenda, Job, Start},
    known,
    worker::{Evaluation, From, Question, Task, WalkTask},
};

/// The next task, if there is one; it is noted as running.
pub(super) fn next_task(
    agenda: &mut Agenda,
    store: &Store,
    solver: &dyn Solver,
    plan: &Plan,
) -> Result<Option<Task>, StoreError> {
    let Some(first) = agenda.jobs.iter().position(is_open) else { return Ok(None) };
    if let Some(walk) = awaited_walk(&agenda.jobs[first], plan) {
        return Ok(Some(begin_walk(agenda, store, plan, walk, None)?));
    }
    if let Some(job) = job_to_evaluate(agenda, first) {
        return Ok(Some(begin_evaluation(agenda, store, plan, job)?));
    }
    for kind in [Ahead::NewMultiple, Ahead::Leaving, Ahead::Search, Ahead::Behind] {
        if let Some(walk) = walk_ahead(agenda, store, solver, plan, kind)? {
            let share = kind.takes_turns().then_some(plan.turn);
            return Ok(Some(begin_walk(agenda, store, plan, walk, share)?));
        }
    }
    let Some((walk, share)) = second_side(agenda, plan) else { return Ok(None) };
    begin_walk(agenda, store, plan, walk, share).map(Some)
}

fn is_open(job: &Job) -> bool {
    job.record.outcome.is_none()
}

/// A walk of a new branch for which the next decision waits, and which takes no turns.
fn awaited_walk(job: &Job, plan: &Plan) -> Option<(u32, Side)> {
    if takes_turns(job) {
        return None;
    }
    job.starts.iter().filter(|start| start.branch.is_some()).find_map(|start| open_side(start, plan))
}

/// Whether a job's branch leaves another one.
fn takes_turns(job: &Job) -> bool {
    job.record.kind.leaves_source()
}

/// A side of a start that nobody walks and that need not wait for the other one.
fn open_side(start: &Start, plan: &Plan) -> Option<(u32, Side)> {
    let open = |side: Side| {
        let walk = start.walk(side);
        !walk.is_finished(plan) && walk.running.is_none()
    };
    if open(Side::Up) {
        return Some((start.key, Side::Up));
    }
    let up_is_done = start.up.running.is_none() && !start.up.is_closed();
    (up_is_done && open(Side::Down)).then_some((start.key, Side::Down))
}

/// The second side of a start whose first one is under way, and its share if it takes turns.
fn second_side(agenda: &Agenda, plan: &Plan) -> Option<((u32, Side), Option<u64>)> {
    let waits = |start: &&Start| {
        start.up.running.is_some() && start.down.running.is_none() && !start.down.is_finished(plan)
    };
    agenda.jobs.iter().filter(|job| is_open(job)).find_map(|job| {
        let start = job.starts.iter().filter(|start| !start.doubtful).find(waits)?;
        Some(((start.key, Side::Down), takes_turns(job).then_some(plan.turn)))
    })
}

/// The first open job that is not evaluated. Whether a harmonic start is needed at all is known only when its
/// turn comes.
fn job_to_evaluate(agenda: &Agenda, first: usize) -> Option<usize> {
    (first..agenda.jobs.len()).find(|&index| {
        let job = &agenda.jobs[index];
        let ready = is_open(job) && !job.record.evaluated && !job.running;
        ready && (index == first || !Plan::only_if_not_covered(&job.record))
    })
}

/// What is walked before it is known to be wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ahead {
    /// From a search, where nobody walks a branch of that period multiple.
    NewMultiple,
    /// A branch that leaves another one, in turns; the one that the next decision waits for, too.
    Leaving,
    /// From a search.
    Search,
    /// A branch that leaves another one, in turns, to be begun just behind one that is under way.
    Behind,
}

impl Ahead {
    fn takes_turns(self) -> bool {
        matches!(self, Self::Leaving | Self::Behind)
    }
}

/// A walk from a start that lies on nothing that was walked so far.
fn walk_ahead(
    agenda: &mut Agenda,
    store: &Store,
    solver: &dyn Solver,
    plan: &Plan,
    kind: Ahead,
) -> Result<Option<(u32, Side)>, StoreError> {
    while let Some((start, walk)) = candidate(agenda, plan, kind) {
        if start.branch.is_some() || !seems_known(agenda, store, solver, start)? {
            return Ok(Some(walk));
        }
        let key = walk.0;
        if let Some(start) = agenda.start_mut(key) {
            start.doubtful = true;
        }
    }
    Ok(None)
}

/// The start to go on from next, and on which side.
fn candidate<'a>(agenda: &'a Agenda, plan: &Plan, kind: Ahead) -> Option<(&'a Start, (u32, Side))> {
    let walked: Vec<(u32, f64)> = agenda
        .starts()
        .filter(|start| is_walked(start))
        .map(|start| (start.period_multiple, begins_at(start)))
        .collect();
    let in_turns = kind.takes_turns();
    let jobs = agenda.jobs.iter().filter(|job| is_open(job) && takes_turns(job) == in_turns);
    let mut open = jobs
        .filter(|job| !in_turns || is_behind_a_walk(agenda, plan, job) == (kind == Ahead::Behind))
        .flat_map(|job| &job.starts)
        .filter(|start| if start.branch.is_some() { in_turns } else { !start.doubtful })
        .filter_map(|start| Some((start, open_side(start, plan)?)));
    let apart = |start: &Start| {
        walked.iter().map(|(_, at)| (at - begins_at(start)).abs()).fold(f64::INFINITY, f64::min)
    };
    let turns = |start: &Start| (start.up.rows.len() + start.down.rows.len()) as u64 / plan.turn.max(1);
    match kind {
        Ahead::NewMultiple => {
            let is_new = |start: &Start| walked.iter().all(|(n, _)| *n != start.period_multiple);
            open.find(|(start, _)| is_new(start))
        }
        Ahead::Leaving | Ahead::Behind => open.min_by_key(|(start, _)| turns(start)),
        Ahead::Search => open.max_by(|(a, _), (b, _)| apart(a).total_cmp(&apart(b))),
    }
}

/// Whether nothing of a job's branches is walked yet while the branch that leaves the same one just before it
/// is under way: jobs of one branch are in order along it.
fn is_behind_a_walk(agenda: &Agenda, plan: &Plan, job: &Job) -> bool {
    let leaves = |job: &Job| (job.record.kind, job.record.source.map(start_of_key));
    let earlier = &agenda.jobs[..job.record.id as usize];
    let before = earlier.iter().rev().find(|before| leaves(before) == leaves(job));
    !job.starts.iter().any(is_begun)
        && before.is_some_and(|before| before.starts.iter().any(|start| is_under_way(start, plan)))
}

/// Whether more of a branch than its start is known, or a thread is at it.
fn is_begun(start: &Start) -> bool {
    is_walked(start) || [&start.up, &start.down].iter().any(|walk| walk.rows.len() > 1)
}

/// Whether a thread is at a branch, or rests between two turns.
fn is_under_way(start: &Start, plan: &Plan) -> bool {
    let goes_on = || (start.branch.is_some() || !start.doubtful) && open_side(start, plan).is_some();
    is_walked(start) || is_begun(start) && goes_on()
}

/// Whether a thread is at a branch.
fn is_walked(start: &Start) -> bool {
    start.up.running.is_some() || start.down.running.is_some()
}

/// Frequency of a start [Hz].
fn begins_at(start: &Start) -> f64 {
    start.up.rows.first().map_or(0.0, |row| row.frequency_hz)
}

/// Whether a start lies on anything that was walked so far.
fn seems_known(
    agenda: &Agenda,
    store: &Store,
    solver: &dyn Solver,
    start: &Start,
) -> Result<bool, StoreError> {
    let solution = store.solution(start.key, Side::Up, 0)?;
    let root = start.up.rows.first().is_some_and(|row| row.branch_point);
    let left_from = agenda.left_from(start.key);
    for other in agenda.starts().filter(|other| other.key != start.key) {
        let known = if root {
            known::has_branch_point(store, solver, other, (&solution, left_from))?
        } else {
            known::lies_on(store, solver, other, &solution)?
        };
        if known {
            return Ok(true);
        }
    }
    Ok(false)
}

fn begin_evaluation(
    agenda: &mut Agenda,
    store: &Store,
    plan: &Plan,
    index: usize,
) -> Result<Task, StoreError> {
    let job = &mut agenda.jobs[index];
    job.running = true;
    let record = &job.record;
    let what = match record.kind {
        JobKind::Harmonic => Question::Harmonic(record.frequency_hz),
        JobKind::Survey => Question::Survey {
            frequency_hz: record.frequency_hz,
            width_hz: plan.survey_width_hz(),
            multiples: plan.multiples.clone(),
        },
        // What was met is known; a run that ended before it was noted looks there.
        JobKind::Resonance | JobKind::NoneStable | JobKind::ContactChange | JobKind::Met => {
            Question::Probe { frequency_hz: record.frequency_hz, multiples: plan.multiples.clone() }
        }
        JobKind::Doubling | JobKind::Crossing => Question::Leave(crossing(store, record)?),
    };
    Ok(Task::Evaluate(Evaluation { job: record.id, what }))
}

/// The crossing at which a job's branch leaves another one.
fn crossing(store: &Store, job: &JobRecord) -> Result<Crossing, StoreError> {
    let source = job.source.unwrap_or_default();
    let direction = store.event(source)?.map(|event| event.direction).unwrap_or_default();
    let factor = if job.kind == JobKind::Doubling { 2 } else { 1 };
    Ok(Crossing { orbit: store.solution_of_key(source)?, direction, factor })
}

fn begin_walk(
    agenda: &mut Agenda,
    store: &Store,
    plan: &Plan,
    (key, side): (u32, Side),
    share: Option<u64>,
) -> Result<Task, StoreError> {
    let from = match store.checkpoint(key, side)? {
        Some(memory) => From::Memory(memory),
        None => From::Origin(origin(agenda, store, key)?),
    };
    let cancelled = Arc::new(AtomicBool::new(false));
    let mut stored = 0;
    if let Some(start) = agenda.start_mut(key) {
        let walk = start.walk_mut(side);
        walk.running = Some(Arc::clone(&cancelled));
        stored = walk.rows.len() as u64;
    }
    Ok(Task::Walk(WalkTask { key, side, from, stored, budget: plan.budget, share, cancelled }))
}

fn origin(agenda: &Agenda, store: &Store, key: u32) -> Result<BranchOrigin, StoreError> {
    let job = agenda.jobs.iter().find(|job| job.starts.iter().any(|start| start.key == key));
    match job {
        Some(job) if job.record.kind.leaves_source() => {
            Ok(BranchOrigin::Crossing(crossing(store, &job.record)?))
        }
        _ => Ok(BranchOrigin::Found(store.solution(key, Side::Up, 0)?)),
    }
}

#[cfg(test)]
mod tests {
    use hammerbeam_orbit::StopReason;
    use hammerbeam_results::store::solution_key;

    use super::*;
    use crate::run::agenda::examples::{job, plan, row, start};

    /// A flip at the row of this number of a branch, with a start of the doubled branch.
    fn doubling(id: u32, source: i64) -> Job {
        let mut doubled = start(id, None, vec![row(f64::from(id))]);
        doubled.down.end = Some(StopReason::Closed.into());
        let mut job = job(id, JobKind::Doubling, true);
        job.record.source = Some(source);
        job.starts.push(doubled);
        job
    }

    fn begin(agenda: &mut Agenda, key: u32) {
        agenda.start_mut(key).expect("a start").up.running = Some(Arc::default());
    }

    /// A thread leaves the walk after a turn.
    fn rest(agenda: &mut Agenda, key: u32) {
        agenda.start_mut(key).expect("a start").up.rows.push(row(0.5));
        agenda.rest(key, Side::Up);
    }

    /// Branches to go on with next, not behind one under way and behind one.
    fn next(agenda: &Agenda) -> [Option<u32>; 2] {
        let plan = plan();
        [Ahead::Leaving, Ahead::Behind].map(|kind| candidate(agenda, &plan, kind).map(|(start, _)| start.key))
    }

    #[test]
    fn branches_that_leave_another_one_are_begun_in_order_but_for_the_one_behind() {
        let mut agenda = Agenda { jobs: (0..4).map(|id| doubling(id, i64::from(id))).collect() };
        assert_eq!(next(&agenda), [Some(0), None]);
        begin(&mut agenda, 0);
        assert_eq!(next(&agenda), [Some(2), Some(1)]);
        begin(&mut agenda, 2);
        assert_eq!(next(&agenda), [None, Some(1)]);
        rest(&mut agenda, 0);
        assert_eq!(next(&agenda), [Some(0), Some(1)], "a walk that takes turns goes on");
        begin(&mut agenda, 1);
        rest(&mut agenda, 2);
        assert_eq!(next(&agenda), [Some(0), Some(3)], "also behind one that was begun later");
    }

    #[test]
    fn a_branch_waits_for_none_that_leaves_elsewhere_or_will_not_go_on() {
        let elsewhere = solution_key(7, Side::Up, 0);
        let mut agenda = Agenda { jobs: vec![doubling(0, 0), doubling(1, elsewhere), doubling(2, 1)] };
        begin(&mut agenda, 0);
        assert_eq!(next(&agenda), [Some(1), Some(2)], "0 and 2 leave one branch, 1 another");
        rest(&mut agenda, 0);
        agenda.start_mut(0).expect("a start").doubtful = true;
        assert_eq!(next(&agenda), [Some(1), None]);
    }
}
