//! Flips and Neimark-Sacker points that only the numbers of multipliers outside the unit circle show.
//!
//! The path counts them from point to point, but not over its shortest steps; and a pair that leaves the
//! circle and comes back within one step leaves no trace in them, where a row between the points
//! (`density.rs`) may lie where it is outside. Of neighbours among points and rows whose numbers differ,
//! although nothing happens at either that accounts for it, the place between is found by halving. Where the
//! contacts change, multipliers may jump, and nothing is asked.

use hammerbeam_path::{ContinuationPoint, PathEvents, TestValue, solve_between};

use super::{
    orbit_path::OrbitPath,
    row::{RowRecord, row_at},
};
use crate::{
    BranchRow, OrbitError, PeriodicSolution, located,
    solve::evaluate,
    spectrum::Spectrum,
    stability::{self, flip_without, neimark_sacker_without},
};

/// Halvings to an interval of rounding.
const HALVINGS: u32 = 50;
/// A multiplier that is farther from its place where the numbers change jumps there: that is no event.
const JUMPS: f64 = 1e-4;

/// A row between two points of the path.
pub(super) struct Between {
    pub point: ContinuationPoint,
    pub row: BranchRow,
}

/// Puts the rows of hidden events among those between `from` and `to`, the row of which is `last`.
pub(super) fn show_hidden_events(
    record: &mut RowRecord,
    path: &mut OrbitPath,
    from: &ContinuationPoint,
    (to, last): (&ContinuationPoint, &BranchRow),
    rows: Vec<Between>,
) -> Result<Vec<Between>, OrbitError> {
    let behind = outside(&spectrum_of(&last.solution), to.events);
    let first = match record.outside.replace(behind) {
        Some(outside) => outside,
        None => match spectrum_at(path, from) {
            Ok(spectrum) => outside(&spectrum, from.events),
            Err(OrbitError::Motion(_) | OrbitError::Eigenvalues(_)) => return Ok(rows),
            Err(error) => return Err(error),
        },
    };
    let of_rows =
        rows.iter().map(|between| outside(&spectrum_of(&between.row.solution), PathEvents::default()));
    let numbers: Vec<(u32, u32)> = std::iter::once(first).chain(of_rows).chain([behind]).collect();
    let corner = from.events.corner || to.events.corner;
    let changes = corner || rows.iter().any(|between| between.point.signature != from.signature);
    if changes || to.signature != from.signature || may_be_equal(&numbers) {
        return Ok(rows);
    }
    let mut shown: Vec<Between> = Vec::with_capacity(rows.len() + 2);
    let mut before = from.clone();
    let ends = rows.into_iter().map(Some).chain([None]);
    for (pair, between) in numbers.windows(2).zip(ends) {
        let behind = between.as_ref().map_or(to, |between| &between.point).clone();
        if !may_be_equal(pair) {
            match hidden_event(record, path, [&before, &behind]) {
                Ok(event) => shown.extend(event),
                // As in `density.rs`: what cannot be computed is no row, and the walk goes on.
                Err(OrbitError::Motion(_) | OrbitError::Eigenvalues(_)) => {}
                Err(error) => return Err(error),
            }
        }
        before = behind;
        shown.extend(between);
    }
    Ok(shown)
}

/// The event between two neighbours; `None` if there is none, or the orbits there are not found.
fn hidden_event(
    record: &mut RowRecord,
    path: &mut OrbitPath,
    ends: [&ContinuationPoint; 2],
) -> Result<Option<Between>, OrbitError> {
    let [mut near, mut far] = ends.map(ContinuationPoint::clone);
    let settings = path.settings_between();
    // At an event rounding decides for which side the number holds.
    let is_far_known = !far.events.any();
    let known = if is_far_known { &far } else { &near };
    if known.events.any() {
        return Ok(None);
    }
    let staying = pairs_that_stay(path, ends)?;
    let (known, chord) = (spectrum_at(path, known)?, far.arc_length - near.arc_length);
    let number = beyond(&known, staying);
    let (mut other_number, mut known_moved) = (None, false);
    for _ in 0..HALVINGS {
        let Ok(middle) = solve_between(&mut path.problem, [&near, &far], 0.5, &settings) else { break };
        record.evaluations_between += middle.evaluations;
        let here = beyond(path.problem.spectrum()?, staying);
        let is_known = here == number;
        if is_known {
            known_moved = true;
        } else {
            other_number = Some(here);
        }
        if is_known == is_far_known { far = middle } else { near = middle }
    }
    let uncertainty = far.arc_length - near.arc_length;
    let place = if is_far_known { far } else { near };
    match other_number {
        Some(other) if known_moved => {
            let way = Way { known, chord, staying, change: number.abs_diff(other) };
            event_row(path, ContinuationPoint { uncertainty, ..place }, &way)
        }
        // It lies at one of the ends, as well as that is known.
        _ => Ok(None),
    }
}

fn spectrum_at(path: &mut OrbitPath, point: &ContinuationPoint) -> Result<Spectrum, OrbitError> {
    evaluate(&mut path.problem, &point.point)?;
    Ok(path.problem.spectrum()?.clone())
}

/// How many multipliers are on the circle, as well as they are known, at both points.
fn pairs_that_stay(path: &mut OrbitPath, ends: [&ContinuationPoint; 2]) -> Result<usize, OrbitError> {
    let [one, other] = [spectrum_at(path, ends[0])?, spectrum_at(path, ends[1])?].map(|at| on_circle(&at));
    Ok(one.min(other))
}

/// The way over which the number of multipliers outside changes.
struct Way {
    /// At the end that no event leaves in doubt.
    known: Spectrum,
    chord: f64,
    /// How many multipliers are on the circle all along.
    staying: usize,
    /// How many more or fewer are outside.
    change: usize,
}

/// The row of an orbit with a multiplier at -1 or a pair on the unit circle; `None` if that does not follow
/// from so many more or fewer outside.
fn event_row(
    path: &mut OrbitPath,
    mut point: ContinuationPoint,
    &Way { ref known, chord, staying, change }: &Way,
) -> Result<Option<Between>, OrbitError> {
    let spectrum = spectrum_at(path, &point)?;
    let off = |[re, im]: &[f64; 2]| if *im == 0.0 { (1.0 + re).abs() } else { (re.hypot(*im) - 1.0).abs() };
    let Some(critical) = moving(&spectrum, staying).min_by(|a, b| off(a).total_cmp(&off(b))) else {
        return Ok(None);
    };
    let is_pair = critical[1] != 0.0;
    if off(critical) > JUMPS || change != 1 + usize::from(is_pair) {
        return Ok(None);
    }
    point.events = PathEvents { zeros: if is_pair { 2 } else { 1 }, ..PathEvents::default() };
    let at_corners = path.follower.settings().min_step;
    let approach = located::Approach::over(
        chord,
        test_before(known, staying, is_pair),
        (&path.problem, point.correction_norm),
    );
    let place = located::EventLocation { at_corners, ..located::EventLocation::reached(&point, approach) };
    let located = located::describe(&mut path.problem, place);
    let row = BranchRow { located, ..row_at(path, &point)? };
    Ok(Some(Between { point, row }))
}

/// Least and most number of multipliers outside the circle.
pub(super) fn outside(spectrum: &Spectrum, events: PathEvents) -> (u32, u32) {
    let outside = stability::outside(spectrum, events);
    (outside.least, outside.most)
}

/// How many are outside, those on the circle by their last digit, but for so many that stay on it.
fn beyond(spectrum: &Spectrum, staying: usize) -> usize {
    moving(spectrum, staying).filter(|[re, im]| re.hypot(*im) > 1.0).count()
}

fn on_circle(spectrum: &Spectrum) -> usize {
    spectrum.on_circle.iter().filter(|on| **on).count()
}

/// The multipliers without the first so many of those on the circle.
fn moving(spectrum: &Spectrum, staying: usize) -> impl Iterator<Item = &[f64; 2]> {
    let mut on = 0;
    let marked = spectrum.multipliers.iter().zip(&spectrum.on_circle);
    let moves = marked.filter(move |(_, is_on)| {
        on += usize::from(**is_on);
        !**is_on || on > staying
    });
    moves.map(|(multiplier, _)| multiplier)
}

/// The test function of a pair, or of a flip, at the end that is known; `None` where the pair is real there.
fn test_before(known: &Spectrum, staying: usize, is_pair: bool) -> Option<TestValue> {
    if !is_pair {
        return Some(flip_without(known, 0));
    }
    let pairs = || known.multipliers.iter().zip(&known.on_circle).filter(|([_, im], _)| *im > 0.0);
    let stay = pairs().filter(|(_, on)| **on).count().min(staying / 2);
    (pairs().count() > stay).then(|| neimark_sacker_without(known, stay as u32))
}

pub(super) fn spectrum_of(solution: &PeriodicSolution) -> Spectrum {
    let multipliers = solution.floquet_multipliers.clone();
    let at_minus_one = vec![false; multipliers.len()];
    Spectrum { multipliers, on_circle: solution.on_circle.clone(), at_minus_one }
}

/// Whether as many multipliers may be outside at all of these places.
fn may_be_equal(numbers: &[(u32, u32)]) -> bool {
    let least = numbers.iter().map(|number| number.0).max();
    let most = numbers.iter().map(|number| number.1).min();
    least <= most
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

    use hammerbeam_motion::{Law, System, law::LinearStop};

    use super::show_hidden_events;
    use crate::{BranchWalk, OrbitSettings, Response, Side, find_start, test_oscillator::oscillator};

    /// `x'' + 0.1 x' + k x = cos(2 pi f t)` with `k = 1` for `x < 0` and 20 for `x > 0`: harmonic orbits flip
    /// between 0.2 and 0.6 Hz.
    fn bilinear() -> (System, Response) {
        oscillator(0.1, 1.0, Law::Linear(LinearStop::with_gap(19.0, 0.0).unwrap()))
    }

    /// Between the points before and behind a flip that the path has found, it is found again from the
    /// numbers alone.
    #[test]
    fn an_event_of_which_only_the_numbers_tell_is_found() {
        let (system, response) = bilinear();
        let settings = OrbitSettings { max_step: 1e-3, ..OrbitSettings::default() };
        let start = find_start(&system, &response, 0.6, 1, &settings).unwrap();
        let mut walk =
            BranchWalk::new(&system, &response, &start, Side::Down, (0.2, 0.6), &settings).unwrap();
        let (mut rows, mut points, mut found) = (vec![walk.start_row().unwrap()], Vec::new(), 0);
        points.push(walk.path.current().clone());
        while walk.step(&mut rows).unwrap().is_none() {
            points.push(walk.path.current().clone());
            let [.., before, flip, _] = points.as_slice() else { continue };
            if flip.events.zeros != 1 {
                continue;
            }
            let (expected, behind) = (flip.parameter(), points[points.len() - 1].clone());
            walk.record.outside = None;
            let last = rows[rows.len() - 1].clone();
            let before = before.clone();
            let shown =
                show_hidden_events(&mut walk.record, &mut walk.path, &before, (&behind, &last), Vec::new())
                    .unwrap();
            assert_eq!(shown.len(), 1, "at {expected} Hz");
            let event = &shown[0].row;
            assert!(event.events.flip && event.located.is_some());
            let off = (event.solution.frequency_hz - expected).abs();
            assert!(off < 1e-9 * expected, "{off:.1e} Hz off {expected} Hz");
            found += 1;
        }
        assert!(found > 0, "no flip");
    }
}
