//! The whole run.

use hammerbeam_orbit::Side;

use super::{Observer, Plan, Solver, Target, done::Done, follow::Follow, known};
use crate::store::{Store, StoreError, StoredReason, WalkRecord};

/// How a run came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RunOutcome {
    /// Everything the study asks for was looked for; what stopped early is told by its reason.
    Done,
    /// The observer said stop; the same run goes on when it is started again.
    Interrupted,
}

/// Why a run cannot go on.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum RunError {
    /// The store refuses.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A stored start or checkpoint is of no use.
    #[error("branch {branch} cannot be followed: {message}")]
    Walk { branch: u32, message: String },
}

/// Whether a walk came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ended {
    Finished,
    Interrupted,
}

/// Runs what is left of a plan.
///
/// # Errors
/// [`RunError`]; what was stored before stays.
pub fn run(
    store: &mut Store,
    solver: &dyn Solver,
    plan: &Plan,
    observer: &mut dyn Observer,
) -> Result<RunOutcome, RunError> {
    let mut done = Done::new(store, plan)?;
    for (index, target) in plan.targets.iter().enumerate() {
        done.begin_target(plan, index);
        let branch = match searched(store, target)? {
            Some(branch) => branch,
            None if observer.interrupted() => return Ok(RunOutcome::Interrupted),
            None => search(store, solver, target, observer)?,
        };
        let Some(branch) = branch else {
            if observer.interrupted() {
                return Ok(RunOutcome::Interrupted);
            }
            continue;
        };
        if follow_branch(store, solver, plan, branch, &mut done, observer)? == Ended::Interrupted {
            return Ok(RunOutcome::Interrupted);
        }
    }
    Ok(RunOutcome::Done)
}

/// What came of a target before: the branch that began there, if one did; `None` if the search is still to be made.
fn searched(store: &Store, target: &Target) -> Result<Option<Option<u32>>, RunError> {
    if let Some((branch, _)) = store.search_outcome(target.period_multiple, target.frequency_hz)? {
        return Ok(Some(branch));
    }
    // While a walk of this multiple waits for more budget, a new start might lie on what it has still to walk.
    let waits = is_paused(store, target.period_multiple)?;
    let superfluous = waits || (target.only_if_not_covered && is_covered(store, target)?);
    Ok(superfluous.then_some(None))
}

/// Whether a walk of that multiple has used up its budget.
fn is_paused(store: &Store, period_multiple: u32) -> Result<bool, RunError> {
    let paused = |walk: &WalkRecord| walk.reason.as_ref().is_some_and(StoredReason::is_budget);
    let branches = store.branches()?;
    Ok(branches.iter().any(|b| b.period_multiple == period_multiple && (paused(&b.up) || paused(&b.down))))
}

/// Whether a branch of the target's multiple passes its frequency.
fn is_covered(store: &Store, target: &Target) -> Result<bool, RunError> {
    for branch in store.branches()?.iter().filter(|branch| branch.period_multiple == target.period_multiple) {
        let [low, high] = store.frequency_span(branch)?;
        if (low..=high).contains(&target.frequency_hz) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Looks for a start; the new branch, if there is one. A search that is interrupted is not noted, so that it is made again.
fn search(
    store: &mut Store,
    solver: &dyn Solver,
    target: &Target,
    observer: &mut dyn Observer,
) -> Result<Option<u32>, RunError> {
    observer.searching(target);
    let interrupted = &mut || observer.interrupted();
    let outcome = match solver.find_start(target.frequency_hz, target.period_multiple, interrupted) {
        Err(_) if observer.interrupted() => return Ok(None),
        Err(message) => message,
        Ok(start) => match known::branch_of(store, &start)? {
            Some(branch) => format!("on branch {branch}"),
            None => {
                let branch = store.begin_branch(target.frequency_hz, &start)?;
                observer.branch_begun(branch, &start);
                return Ok(Some(branch));
            }
        },
    };
    store.note_search(target.period_multiple, target.frequency_hz, &outcome)?;
    observer.nothing_found(target, &outcome);
    Ok(None)
}

/// Follows both sides of a branch as far as they are not finished.
fn follow_branch(
    store: &mut Store,
    solver: &dyn Solver,
    plan: &Plan,
    branch: u32,
    done: &mut Done,
    observer: &mut dyn Observer,
) -> Result<Ended, RunError> {
    let records = store.branches()?;
    let record = records.iter().find(|record| record.id == branch).expect("the branch was just stored");
    let period_multiple = record.period_multiple;
    for side in [Side::Up, Side::Down] {
        if is_finished(&store.walk(branch, side)?, plan) {
            continue;
        }
        let up = store.walk(branch, Side::Up)?;
        if side == Side::Down
            && let Some(reason) = up.reason.filter(StoredReason::is_closed)
        {
            store.append(branch, side, &[], crate::store::Continuation::Ended(&reason))?;
            continue;
        }
        let mut follow = Follow { store, solver, plan, branch, period_multiple, side };
        if follow.run(done, observer)? == Ended::Interrupted {
            return Ok(Ended::Interrupted);
        }
    }
    Ok(Ended::Finished)
}

/// A walk that has used up its budget goes on if the budget has grown.
fn is_finished(walk: &WalkRecord, plan: &Plan) -> bool {
    match &walk.reason {
        None => false,
        Some(reason) => !reason.is_budget() || walk.solutions >= plan.budget,
    }
}
