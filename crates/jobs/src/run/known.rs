//! Whether a solution lies on a branch that is already there.
//!
//! Maxima over a whole orbit do not depend on its phase; neighbouring rows between whose maxima those of the
//! solution lie, within a margin, are candidates. Then the states decide: the state between the rows,
//! interpolated to the frequency of the solution, is compared with the states of the solution at the
//! starts of all its excitation periods, and the orbit that Newton's method finds from there must be the
//! solution itself, or it lies straight between the rows, has their contacts and is as stable.
//!
//! Where the amplitude may be any a branch ends, but orbits of larger amplitude go on from there, at next to
//! the same frequency: a solution among them lies on that branch, too.
//!
//! A branch that leaves a flip or branch point is known if another one ends, begins or has a branch point
//! there: the same frequency and the same state. Either point, if it was bracketed and not located, is taken
//! to lie within [`DOUBTS`] times its uncertainty.

use hammerbeam_orbit::{PeriodicSolution, Side};
use hammerbeam_results::{
    end::BranchEnd,
    store::{Store, StoreError, solution_key},
};

use super::{
    OrbitMatcher, Solver,
    agenda::{Sketch, Start},
};

/// Relative margin of the maxima of candidates.
const MARGIN: f64 = 0.02;
/// Relative difference of frequencies up to which two branch points can be the same, besides what their place
/// is uncertain by.
pub(super) const SAME_FREQUENCY: f64 = 1e-7;
/// Uncertainties within which a bracketed point lies: they are what the last steps of its search moved it by,
/// and have been seen to be a third of its error.
const DOUBTS: f64 = 10.0;
/// Distance of states, relative to the orbit, up to which two branch points of the same frequency are the
/// same.
const SAME_STATE: f64 = 5e-3;
/// Distance of a solution from the line between its neighbours, as a part of their distances from it.
const STRAIGHT: f64 = 0.03;
/// Part by which its largest multiplier may be smaller or larger than those of its neighbours.
const ALIKE: f64 = 0.01;
/// So much further than the interval between two rows reaches a solution may lie, in parts of the interval.
const OVERHANG: f64 = 1e-3;

/// What is left of a branch whose amplitude may be any, in parts of the way over which that doubled last:
/// with `a = c/|f* - f|^p` it is `1/(2^(1/p) - 1)`, and p at most two, as far as was seen.
const LEFT: f64 = 3.0;

/// A row of a branch: where it is stored, and its sketch.
pub(super) type Placed<'a> = (i64, &'a Sketch);

/// Whether the solution lies on the branch of a start, as far as that has been walked.
pub(super) fn lies_on(
    store: &Store,
    solver: &dyn Solver,
    start: &Start,
    solution: &PeriodicSolution,
) -> Result<bool, StoreError> {
    if start.period_multiple != solution.period_multiple {
        return Ok(false);
    }
    let rows: Vec<Placed<'_>> = rows_of(start).collect();
    let at = (solution.frequency_hz, [solution.maxima.displacement, solution.maxima.acceleration]);
    Ok(first_before(store, solver, (&rows, None), (at, || Ok(solution.clone())))?.is_some())
}

/// Whether the branch of a start goes on to the solution beyond an end at which its amplitude may be any.
pub(super) fn goes_on_to(start: &Start, solution: &PeriodicSolution) -> bool {
    let at = (solution.frequency_hz, solution.maxima.displacement);
    start.period_multiple == solution.period_multiple && goes_on_at(start, at)
}

fn goes_on_at(start: &Start, (frequency_hz, displacement): (f64, f64)) -> bool {
    let goes_on = |side: Side| {
        let walk = start.walk(side);
        let end = walk.end.as_ref().filter(|end| end.has_any_amplitude());
        let Some((end, last)) = end.zip(walk.rows.last()) else { return false };
        let way = frequency_hz - last.frequency_hz;
        let same = SAME_FREQUENCY * last.frequency_hz;
        // Towards infinity the frequency goes on as it went; free vibrations all have the same one.
        let is_half = |row: &&Sketch| end.is_unbounded() && row.displacement <= 0.5 * last.displacement;
        let half = walk.rows.iter().rev().chain(start.up.rows.first()).find(is_half);
        let left = half.map_or(0.0, |half| LEFT * (last.frequency_hz - half.frequency_hz));
        let is_ahead = way.abs() <= same || way * left > 0.0 && way.abs() <= left.abs();
        displacement >= last.displacement && is_ahead
    };
    [Side::Up, Side::Down].into_iter().any(goes_on)
}

/// Behind which of these neighbouring rows a stored solution lies first, if it lies between any of them; of
/// rows with so many contacts, if that is given, and at none where branches cross.
pub(super) fn passes(
    store: &Store,
    solver: &dyn Solver,
    rows: &[Placed<'_>],
    ((key, sketch), contacts): (Placed<'_>, Option<u32>),
) -> Result<Option<usize>, StoreError> {
    let at = (sketch.frequency_hz, [sketch.displacement, sketch.acceleration]);
    first_before(store, solver, (rows, contacts), (at, || store.solution_of_key(key)))
}

/// The same for a solution of which frequency and maxima are known, and which is fetched where they allow
/// that it lies there.
fn first_before(
    store: &Store,
    solver: &dyn Solver,
    (rows, contacts): (&[Placed<'_>], Option<u32>),
    (at, solution): ((f64, [f64; 2]), impl FnOnce() -> Result<PeriodicSolution, StoreError>),
) -> Result<Option<usize>, StoreError> {
    let counts =
        |(_, row): &Placed<'_>| contacts.is_none_or(|contacts| row.contacts == contacts && !row.branch_point);
    let pairs = rows.windows(2).enumerate().filter(|(_, pair)| pair.iter().all(counts));
    let mut near =
        pairs.filter_map(|(index, pair)| Some((index, share(pair[0].1, pair[1].1, at)?))).peekable();
    if near.peek().is_none() {
        return Ok(None);
    }
    let solution = solution()?;
    // A solution that cannot be compared is taken for a new one, and its walk will say why.
    let Ok(matcher) = solver.matcher(&solution) else { return Ok(None) };
    for (index, share) in near {
        if is_between(store, (matcher.as_ref(), &solution), (rows[index].0, rows[index + 1].0), share)? {
            return Ok(Some(index));
        }
    }
    Ok(None)
}

/// Whether the branch of a start begins, ends or is crossed at this branch point, by another row than the
/// one from which the new branch leaves: that one is the branch point itself, and says nothing of what
/// crosses it.
pub(super) fn has_branch_point(
    store: &Store,
    solver: &dyn Solver,
    start: &Start,
    (root, left_from): (&PeriodicSolution, Option<i64>),
) -> Result<bool, StoreError> {
    if start.period_multiple != root.period_multiple {
        return Ok(false);
    }
    let places = rows_of(start).filter(|(_, row)| row.branch_point).chain(ends_at_simpler(start));
    let places = places.filter(|(key, _)| Some(*key) != left_from);
    let doubt_hz = |key: i64| -> Result<f64, StoreError> {
        Ok(store.event(key)?.map_or(0.0, |event| DOUBTS * event.uncertainty))
    };
    let of_root = left_from.map_or(Ok(0.0), doubt_hz)?;
    let mut near = Vec::new();
    for (key, row) in places {
        let allowed_hz = SAME_FREQUENCY * root.frequency_hz + of_root + doubt_hz(key)?;
        if (row.frequency_hz - root.frequency_hz).abs() <= allowed_hz {
            near.push(key);
        }
    }
    if near.is_empty() {
        return Ok(false);
    }
    let Ok(matcher) = solver.matcher(root) else { return Ok(false) };
    for key in near {
        let stored = store.solution_of_key(key)?;
        if matcher.distance((stored.phase, &stored.nodes[0])) < SAME_STATE {
            return Ok(true);
        }
    }
    Ok(false)
}

/// The last rows of the sides that end at motions of shorter period or symmetric ones, whether the place
/// could be located or not.
fn ends_at_simpler(start: &Start) -> impl Iterator<Item = Placed<'_>> {
    let of_side = |side| {
        let walk = start.walk(side);
        let ends = walk.end.as_ref().is_some_and(BranchEnd::meets_simpler);
        row_of_side(start, side, walk.rows.len().checked_sub(1)?).filter(|_| ends)
    };
    [Side::Up, Side::Down].into_iter().filter_map(of_side)
}

/// Rows end to end along the branch.
fn rows_of(start: &Start) -> impl Iterator<Item = Placed<'_>> {
    let down: Vec<Placed<'_>> = rows_of_side(start, Side::Down).collect();
    down.into_iter().rev().chain(rows_of_side(start, Side::Up))
}

/// Rows of a side, from the start on.
pub(super) fn rows_of_side(start: &Start, side: Side) -> impl Iterator<Item = Placed<'_>> {
    (0..start.walk(side).rows.len()).filter_map(move |number| row_of_side(start, side, number))
}

/// The row of that number on a side.
pub(super) fn row_of_side(start: &Start, side: Side, number: usize) -> Option<Placed<'_>> {
    let row = start.walk(side).rows.get(number)?;
    Some((solution_key(start.key, side, number as u32), row))
}

/// Where between two rows a solution lies by its frequency, if its maxima of displacement and acceleration
/// allow that.
fn share(first: &Sketch, second: &Sketch, (frequency_hz, maxima): (f64, [f64; 2])) -> Option<f64> {
    let width = second.frequency_hz - first.frequency_hz;
    let share = if width == 0.0 { 0.5 } else { (frequency_hz - first.frequency_hz) / width };
    let reached = width != 0.0 || frequency_hz == first.frequency_hz;
    if !reached || !(-OVERHANG..=1.0 + OVERHANG).contains(&share) {
        return None;
    }
    let within = |a: f64, b: f64, value: f64| {
        let margin = MARGIN * a.abs().max(b.abs()) + (a - b).abs();
        (a.min(b) - margin..=a.max(b) + margin).contains(&value)
    };
    let agrees = within(first.displacement, second.displacement, maxima[0])
        && within(first.acceleration, second.acceleration, maxima[1]);
    agrees.then_some(share)
}

/// Whether the solution is the one between two stored ones.
fn is_between(
    store: &Store,
    (matcher, solution): (&dyn OrbitMatcher, &PeriodicSolution),
    (first, second): (i64, i64),
    share: f64,
) -> Result<bool, StoreError> {
    let (first, second) = (store.solution_of_key(first)?, store.solution_of_key(second)?);
    if first.phase != second.phase {
        // The orbits were cut anew between them: their nodes are no neighbours, but each is near the
        // solution.
        let near = |stored: PeriodicSolution| matcher.is_near((stored.phase, &stored.nodes[0]));
        return Ok(near(first) || near(second));
    }
    let pairs = first.nodes[0].iter().zip(&second.nodes[0]);
    let guess: Vec<f64> = pairs.map(|(a, b)| a + share * (b - a)).collect();
    let guess = (first.phase, guess.as_slice());
    Ok(matcher.is_near(guess) || lies_straight(matcher, guess, (&first, solution, &second)))
}

/// Whether the solution lies straight between two neighbours, has their contacts and is as stable. Beside a
/// slow impact Newton's method may go from the best guess to another orbit.
fn lies_straight(
    matcher: &dyn OrbitMatcher,
    guess: (f64, &[f64]),
    (first, solution, second): (&PeriodicSolution, &PeriodicSolution, &PeriodicSolution),
) -> bool {
    let multipliers = [first, second].map(PeriodicSolution::largest_multiplier);
    let (low, high) = (multipliers[0].min(multipliers[1]), multipliers[0].max(multipliers[1]));
    let is_as_stable = (low * (1.0 - ALIKE)..=high * (1.0 + ALIKE)).contains(&solution.largest_multiplier());
    let has_contacts = |stored: &PeriodicSolution| stored.maxima.contacts == solution.maxima.contacts;
    if !is_as_stable || !has_contacts(first) || !has_contacts(second) {
        return false;
    }
    // Without a motion all distances are infinite.
    let distance = |stored: &PeriodicSolution| matcher.distance((stored.phase, &stored.nodes[0]));
    matcher.distance(guess) < STRAIGHT * (distance(first) + distance(second))
}

#[cfg(test)]
mod tests {
    use hammerbeam_orbit::StopReason;

    use super::*;
    use crate::run::agenda::examples;

    /// `a = 1/(3 - f)` up to 2.99 Hz.
    #[test]
    fn a_branch_goes_on_to_larger_amplitudes_ahead_of_its_end_at_infinity_and_to_no_others() {
        let row = |frequency_hz: f64| Sketch {
            displacement: 1.0 / (3.0 - frequency_hz),
            ..examples::row(frequency_hz)
        };
        let mut start = examples::start(0, Some(1), [2.0, 2.9, 2.95, 2.98, 2.99].map(row).to_vec());
        let goes_on = |start: &Start| {
            [(2.995, 200.0), (2.995, 50.0), (2.98, 200.0), (3.1, 200.0)].map(|at| goes_on_at(start, at))
        };
        assert_eq!(goes_on(&start), [false; 4], "it has not ended");
        start.up.end = Some(StopReason::Unbounded { place: 2.99, mode: None }.into());
        assert_eq!(goes_on(&start), [true, false, false, false]);
        start.up.end = Some(StopReason::RangeEnd { place: 2.99 }.into());
        assert_eq!(goes_on(&start), [false; 4]);
    }
}
