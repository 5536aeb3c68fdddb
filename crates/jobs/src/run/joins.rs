//! Where a branch comes upon an earlier one: where that was lost, or where both graze the same contacts.
//!
//! A walk that ends early (its corrector fails, its budget is used up) leaves the rest of its curve to be
//! found by a later search. The branch that begins there comes, at the lost end, upon solutions that are
//! stored already. It is cut there, so that no solution is stored twice.
//!
//! Where several contacts are grazed at once, as by a symmetric orbit between two stops, more than two pieces
//! of curve meet: that with none of the contacts, that with all, and those with some. A branch that comes
//! there goes on along one of them, and another one along the same. The later one is cut at the grazing.
//!
//! Of a closed curve both sides may go round most of it, if each is lost at a place that the other passes.
//! That is looked at when both have ended.
//!
//! A start on an earlier branch makes no branch, so a later branch can come upon an earlier one only at such
//! places. Each pair of neighbouring rows of the later branch is compared with the last solution of each
//! early end, and with a few before it: the last ones may lie where a curve is so crowded that the step
//! between two rows hides them. So are a few solutions on either side of each grazing. The cut follows from
//! the rows alone, so it is the same whether the walk is compared while it is under way or when all of it is
//! there.

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

/// How many solutions off such a place those are that are compared.
const APART: [usize; 5] = [0, 4, 16, 64, 256];

/// A place at which a later branch may come upon an earlier one.
struct Junction<'a> {
    /// The earlier branch.
    start: &'a Start,
    /// Frequency of its last solution there, or of its grazing [Hz].
    frequency_hz: f64,
    /// Whether it is a grazing, from which the branch goes on.
    grazes: bool,
    /// The solutions that are compared.
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
    let found = first_join(store, solver, (start, side), &junctions(agenda, start))?;
    let start = &mut agenda.jobs[job].starts[place];
    start.walk_mut(side).compared = start.walk(side).rows.len();
    found.map_or(Ok(None), |found| cut_at(store, start, side, found).map(Some))
}

/// Cuts the lower side of a branch that is walked to both its ends where it comes upon the lost end of the
/// upper one: both have gone round most of a closed curve.
///
/// It goes on from there along the upper side, so it meets the lost end, or a solution close to it, and then
/// more of those that are compared, one after the other.
pub(super) fn cut_at_upper_side(
    store: &mut Store,
    solver: &dyn Solver,
    start: &mut Start,
) -> Result<Option<BranchEnd>, StoreError> {
    // With a larger budget a side goes on.
    let goes_on = start.up.end.as_ref().is_none_or(BranchEnd::is_budget);
    if std::mem::replace(&mut start.sides_compared, true) || goes_on {
        return Ok(None);
    }
    let Some(lost) = lost_end(start, Side::Up) else { return Ok(None) };
    let rows: Vec<Placed<'_>> = known::rows_of_side(start, Side::Down).collect();
    let mut met = Vec::new();
    for (place, &row) in lost.rows.iter().enumerate() {
        let index = known::passes(store, solver, &rows, (row, Some(row.1.contacts)))?;
        met.extend(index.map(|index| (place, index)));
    }
    let in_order = met.windows(2).all(|pair| pair[0].1 < pair[1].1);
    let Some(&(0 | 1, index)) = met.first().filter(|_| met.len() > 1 && in_order) else { return Ok(None) };
    let end = BranchEnd::Joins { branch: None, frequency_hz: lost.frequency_hz };
    cut_at(store, start, Side::Down, (index + 1, end)).map(Some)
}

/// Cuts a side after so many solutions, with this end.
pub(super) fn cut_at(
    store: &mut Store,
    start: &mut Start,
    side: Side,
    (solutions, end): (usize, BranchEnd),
) -> Result<BranchEnd, StoreError> {
    let key = start.key;
    let walk = start.walk_mut(side);
    walk.cancel();
    walk.rows.truncate(solutions);
    walk.compared = solutions;
    walk.end = Some(end.clone());
    store.cut_walk(key, side, solutions as u32, &end)?;
    Ok(end)
}

/// After how many of its solutions the side comes upon an earlier branch, and the end that this makes.
fn first_join(
    store: &Store,
    solver: &dyn Solver,
    (start, side): (&Start, Side),
    junctions: &[Junction<'_>],
) -> Result<Option<(usize, BranchEnd)>, StoreError> {
    let compared = start.walk(side).compared;
    // The other side has the start itself.
    let ahead = usize::from(side == Side::Down && !start.up.rows.is_empty());
    let shared = known::rows_of_side(start, Side::Up).take(ahead);
    let skipped = (compared + ahead).saturating_sub(1);
    let rows: Vec<Placed<'_>> = shared.chain(known::rows_of_side(start, side)).skip(skipped).collect();
    let mut first: Option<(usize, &Junction<'_>)> = None;
    for junction in junctions {
        for &row in &junction.rows {
            let upto = first.map_or(rows.len(), |(index, _)| index + 1);
            // Beside a grazing lie orbits with more contacts and with fewer, and Newton's method goes over.
            let contacts = junction.grazes.then_some(row.1.contacts);
            let Some(index) = known::passes(store, solver, &rows[..upto], (row, contacts))? else { continue };
            let upto = skipped + index + 1 - ahead;
            if !junction.grazes || goes_along(store, solver, (start, side, upto), junction.start)? {
                first = Some((index, junction));
            }
        }
    }
    Ok(first.map(|(index, junction)| {
        let walk = &start.walk(side).rows;
        let mut solutions = skipped + index + 1 - ahead;
        if let Some(grazing) = grazing_before(walk, solutions).filter(|_| junction.grazes) {
            solutions = grazing + 1;
        }
        let last = solutions.checked_sub(1).and_then(|last| walk.get(last));
        let frequency_hz = last.map_or(junction.frequency_hz, |row| row.frequency_hz);
        (solutions, BranchEnd::Joins { branch: junction.start.branch, frequency_hz })
    }))
}

/// Whether a side goes along another branch from its last grazing on up to so many of its solutions, by one
/// halfway.
///
/// Where contacts are ever slower, orbits of many branches come together, nearer than they are known, and
/// part again: that they meet says nothing there.
fn goes_along(
    store: &Store,
    solver: &dyn Solver,
    (start, side, solutions): (&Start, Side, usize),
    other: &Start,
) -> Result<bool, StoreError> {
    let rows = &start.walk(side).rows;
    let from = last_change(rows, solutions).map_or(0, |index| index + 1);
    let halfway = from + (solutions - from) / 2;
    let Some((key, _)) = known::row_of_side(start, side, halfway.min(rows.len().saturating_sub(1))) else {
        return Ok(true);
    };
    known::lies_on(store, solver, other, &store.solution_of_key(key)?)
}

/// The grazing from which on a side has the contacts that it has after so many solutions.
fn grazing_before(rows: &[Sketch], solutions: usize) -> Option<usize> {
    last_change(rows, solutions).filter(|&index| rows[index].grazes)
}

/// The last of so many solutions before those that have the contacts of the last one.
fn last_change(rows: &[Sketch], solutions: usize) -> Option<usize> {
    let contacts = rows[..solutions].last()?.contacts;
    rows[..solutions].iter().rposition(|row| row.grazes || row.contacts != contacts)
}

/// Early ends and grazings of the branches before the one of a start, of the same period.
fn junctions<'a>(agenda: &'a Agenda, start: &Start) -> Vec<Junction<'a>> {
    let is_before =
        |other: &&Start| other.branch < start.branch && other.period_multiple == start.period_multiple;
    let sides = agenda.accepted().filter(is_before).flat_map(|other| SIDES.map(|side| (other, side)));
    sides.flat_map(|(other, side)| grazings(other, side).into_iter().chain(lost_end(other, side))).collect()
}

const SIDES: [Side; 2] = [Side::Up, Side::Down];

fn lost_end(start: &Start, side: Side) -> Option<Junction<'_>> {
    let walk = start.walk(side);
    start.branch.filter(|_| !walk.end.as_ref().is_none_or(BranchEnd::is_complete))?;
    let last = walk.rows.last()?;
    let before = |back: usize| known::row_of_side(start, side, walk.rows.len().checked_sub(1 + back)?);
    // At a branch point another branch has the same solution and is another one all the same.
    let compared = |back: usize| before(back).filter(|(_, row)| !row.branch_point);
    Some(Junction {
        start,
        frequency_hz: last.frequency_hz,
        grazes: false,
        rows: APART.into_iter().filter_map(compared).collect(),
    })
}

/// The grazings of a side, with solutions on either side of each: at the grazing itself another branch has
/// the same one.
fn grazings(start: &Start, side: Side) -> Vec<Junction<'_>> {
    if start.branch.is_none() {
        return Vec::new();
    }
    let is_plain = |(_, row): &Placed<'_>| !row.branch_point && !row.grazes;
    let around = |index: usize| {
        let apart = APART.into_iter().skip(1);
        let beside = apart.flat_map(move |apart| [index.checked_sub(apart), index.checked_add(apart)]);
        let at = |index| known::row_of_side(start, side, index);
        beside.flatten().filter_map(at).filter(is_plain).collect()
    };
    let grazes = start.walk(side).rows.iter().enumerate().filter(|(_, row)| row.grazes);
    grazes
        .map(|(index, row)| Junction {
            start,
            frequency_hz: row.frequency_hz,
            grazes: true,
            rows: around(index),
        })
        .collect()
}
