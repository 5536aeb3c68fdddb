//! Where a branch comes upon an earlier one that was lost there.
//!
//! A walk that ends early (its corrector fails, its budget is used up) leaves the rest of its curve to be
//! found by a later search. The branch that begins there comes, at the lost end, upon solutions that are
//! stored already. It is cut there, so that no solution is stored twice.
//!
//! A start on an earlier branch makes no branch, so a later branch can come upon an earlier one only over one
//! of its early ends. Each pair of neighbouring rows of the later branch is compared with the last solution
//! of each such end, and with a few before it: the last ones may lie where a curve is so crowded that the
//! step between two rows hides them. The cut follows from the rows alone, so it is the same whether the walk
//! is compared while it is under way or when all of it is there.

use hammerbeam_orbit::Side;
use hammerbeam_results::{
    end::BranchEnd,
    store::{Store, StoreError},
};

use super::{
    Solver,
    agenda::{Agenda, Sketch, Start},
    known::{self, Placed},
};

/// An early end of an earlier branch: its number, the frequency of its last solution [Hz], and the solutions
/// that are compared.
struct LostEnd<'a> {
    branch: u32,
    frequency_hz: f64,
    rows: Vec<Placed<'a>>,
}

/// Cuts the side of a new branch where it comes upon an earlier one, as far as it is walked; the end that
/// this makes.
///
/// * `(job, place, side)`: the job of the start, its place there, and the side of it.
pub(super) fn cut(
    store: &mut Store,
    solver: &dyn Solver,
    agenda: &mut Agenda,
    (job, place, side): (usize, usize, Side),
) -> Result<Option<BranchEnd>, StoreError> {
    let start = &agenda.jobs[job].starts[place];
    if start.walk(side).compared == start.walk(side).rows.len() {
        return Ok(None);
    }
    let found = first_join(store, solver, (start, side), &lost_ends(agenda, start))?;
    let start = &mut agenda.jobs[job].starts[place];
    let key = start.key;
    let walk = start.walk_mut(side);
    walk.compared = walk.rows.len();
    let Some((solutions, end)) = found else { return Ok(None) };
    walk.cancel();
    walk.rows.truncate(solutions);
    walk.compared = solutions;
    walk.end = Some(end.clone());
    store.cut_walk(key, side, solutions as u32, &end)?;
    Ok(Some(end))
}

/// After how many of its solutions the side comes upon an early end, and the end that this makes.
fn first_join(
    store: &Store,
    solver: &dyn Solver,
    (start, side): (&Start, Side),
    ends: &[LostEnd<'_>],
) -> Result<Option<(usize, BranchEnd)>, StoreError> {
    let compared = start.walk(side).compared;
    // The other side has the start itself.
    let ahead = usize::from(side == Side::Down && !start.up.rows.is_empty());
    let shared = known::rows_of_side(start, Side::Up).take(ahead);
    let skipped = (compared + ahead).saturating_sub(1);
    let rows: Vec<Placed<'_>> = shared.chain(known::rows_of_side(start, side)).skip(skipped).collect();
    let mut first: Option<(usize, &LostEnd<'_>)> = None;
    for end in ends {
        for &row in &end.rows {
            let upto = first.map_or(rows.len(), |(index, _)| index + 1);
            if let Some(index) = known::passes(store, solver, &rows[..upto], row)? {
                first = Some((index, end));
            }
        }
    }
    Ok(first.map(|(index, lost)| {
        let end = BranchEnd::Joins { branch: lost.branch, frequency_hz: lost.frequency_hz };
        (skipped + index + 1 - ahead, end)
    }))
}

/// Early ends of the branches before the one of a start, of the same period.
fn lost_ends<'a>(agenda: &'a Agenda, start: &Start) -> Vec<LostEnd<'a>> {
    let is_before =
        |other: &&Start| other.branch < start.branch && other.period_multiple == start.period_multiple;
    let earlier = agenda.accepted().filter(is_before);
    earlier.flat_map(|other| [Side::Up, Side::Down].map(|side| (other, side))).filter_map(lost_end).collect()
}

fn lost_end((start, side): (&Start, Side)) -> Option<LostEnd<'_>> {
    let walk = start.walk(side);
    let branch = start.branch.filter(|_| !walk.end.as_ref().is_none_or(BranchEnd::is_complete))?;
    let rows: Vec<Placed<'_>> = known::rows_of_side(start, side).collect();
    let last: &Sketch = rows.last()?.1;
    let back = [0, 4, 16, 64, 256].into_iter();
    let compared = back.filter_map(|back| rows.len().checked_sub(1 + back).map(|index| rows[index]));
    // At a branch point another branch has the same solution and is another one all the same.
    let compared = compared.filter(|(_, row)| !row.branch_point);
    Some(LostEnd { branch, frequency_hz: last.frequency_hz, rows: compared.collect() })
}
