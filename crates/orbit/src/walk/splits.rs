//! Whether a walk has come to the place where a contact splits, and how far it goes before that.
//!
//! A step that has passed the place tells no more than that the branch ends within its length. The end is
//! found by halving: from the last orbit that is known, half of what is left is gone along its tangent, and
//! the orbit there is the next one if the corrector comes to it, its contacts are those of the branch, and it
//! is told from the other side.

use hammerbeam_path::{ContinuationPoint, solve_between};

use super::{
    orbit_path::OrbitPath,
    row::{RowRecord, row_at},
};
use crate::{
    BranchRow, OrbitError, StopReason,
    solve::evaluate,
    spectrum::largest_modulus,
    splitting::{self, Splitting},
};

/// Halvings of a step that has passed a splitting, to an interval of rounding.
const HALVINGS: u32 = 40;

/// A point of a walk and the phase at which its orbit begins.
pub(super) struct Departed {
    /// Phase of the excitation [cycles].
    phase: f64,
    /// First node of the orbit.
    state: Vec<f64>,
    point: ContinuationPoint,
}

/// Work of a walk; differences of it depend on nothing but the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Work {
    /// Steps of the motion with forces.
    force_steps: u64,
    /// Shooting evaluations.
    evaluations: u64,
}

/// What is known of a walk before a step.
pub(super) struct Departure {
    /// The point that is left; `None` where no contact can split.
    pub place: Option<Departed>,
    pub work: Work,
}

impl Work {
    fn since(self, earlier: Self) -> Self {
        Self {
            force_steps: self.force_steps - earlier.force_steps,
            evaluations: self.evaluations - earlier.evaluations,
        }
    }

    /// Whether an orbit with so many touches took far more steps of the motion than touches take.
    fn takes_too_many_steps(self, touches: u64) -> bool {
        self.force_steps > splitting::MOST_STEPS_AT_TOUCH * touches.max(1) * self.evaluations.max(1)
    }
}

/// If the last steps were short, and a contact of the present orbit splits: the way to the border is no
/// longer resolved.
pub(super) fn tends_to_splitting(path: &mut OrbitPath) -> Option<StopReason> {
    let short = path.follower.counters().short_steps;
    if short == 0 || !short.is_multiple_of(splitting::SHORT_STEPS) {
        return None;
    }
    splits_here(path, path.parameter())
}

/// If the step from `departure` has passed a splitting, or takes too many force steps beside one: the last
/// orbit before that, with why the walk ends.
///
/// * `record`: at the row before.
/// * `from`: the point before the present one, cut in the same way.
pub(super) fn comes_to_splitting(
    path: &mut OrbitPath,
    record: &mut RowRecord,
    departure: &Departure,
    from: &ContinuationPoint,
) -> Result<Option<(ContinuationPoint, StopReason)>, OrbitError> {
    let Some(before) = &departure.place else { return Ok(None) };
    let spent = work(path).since(departure.work);
    if let Some(splitting) = passes_splitting(path, &record.touches, before)? {
        let last = last_before_splitting(path, record, from);
        let reason = splits_at(last.parameter(), splitting);
        return Ok(Some((last, reason)));
    }
    let labours = labours_at_splitting(path, before, spent)?;
    Ok(labours.map(|reason| (from.clone(), reason)))
}

/// The last orbit of a branch that is found behind `from` before the splitting that the step to the present
/// orbit has passed.
fn last_before_splitting(
    path: &mut OrbitPath,
    record: &mut RowRecord,
    from: &ContinuationPoint,
) -> ContinuationPoint {
    let settings = path.settings_between();
    let mut last = from.clone();
    let mut length = path.current().arc_length - from.arc_length;
    for _ in 0..HALVINGS {
        length /= 2.0;
        let ahead = along_tangent(&last, length);
        if let Ok(found) = solve_between(&mut path.problem, [&last, &ahead], 1.0, &settings) {
            record.evaluations_between += found.evaluations;
            if path.problem.touches() == record.touches && is_told(path) {
                last = found;
            }
        }
    }
    last
}

/// Whether the orbit at which the problem was evaluated last is told from those on the other side.
fn is_told(path: &mut OrbitPath) -> bool {
    path.problem.multipliers().is_ok_and(|multipliers| largest_modulus(multipliers) < splitting::UNRESOLVED)
}

/// The point at a length ahead on the tangent of another one.
pub(super) fn along_tangent(from: &ContinuationPoint, length: f64) -> ContinuationPoint {
    let point = from.point.iter().zip(&from.tangent).map(|(x, t)| x + length * t).collect();
    ContinuationPoint { point, arc_length: from.arc_length + length, ..from.clone() }
}

impl RowRecord {
    /// Appends the row of the last orbit before a splitting, and those between `from` and it; none if it is
    /// `from`.
    pub fn append_last(
        &mut self,
        path: &mut OrbitPath,
        [from, last]: [&ContinuationPoint; 2],
        rows: &mut Vec<BranchRow>,
    ) -> Result<(), OrbitError> {
        if last.arc_length <= from.arc_length {
            return Ok(());
        }
        evaluate(&mut path.problem, &last.point)?;
        match row_at(path, last) {
            Ok(row) => self.append_densely(path, [from, last], row, rows),
            // As in `density.rs`: what cannot be computed is no row.
            Err(OrbitError::Motion(_) | OrbitError::Eigenvalues(_)) => Ok(()),
            Err(error) => Err(error),
        }
    }
}

/// If the multipliers of the present orbit are too large to tell on which side of a splitting it is, and
/// one of its contacts begins with next to no speed.
pub(super) fn is_lost_at_splitting(
    path: &mut OrbitPath,
    departure: &Departure,
    largest_multiplier: f64,
) -> Result<Option<StopReason>, OrbitError> {
    match &departure.place {
        Some(before) if largest_multiplier >= splitting::UNRESOLVED => has_just_split(path, before),
        _ => Ok(None),
    }
}

/// If the motion of the last step, which led away from `before`, took far more work than its contacts
/// need, that of the orbit reached does, and one of its contacts begins with next to no speed.
fn labours_at_splitting(
    path: &mut OrbitPath,
    before: &Departed,
    spent: Work,
) -> Result<Option<StopReason>, OrbitError> {
    let touches = path.problem.touches().iter().map(|&touches| u64::from(touches)).sum();
    if !spent.takes_too_many_steps(touches) {
        return Ok(None);
    }
    let present = place(path);
    // A correction on a wrong way may have been what cost so much.
    let earlier = work(path);
    evaluate(&mut path.problem, &present.point.point)?;
    let alone = Work { evaluations: 1, ..work(path).since(earlier) };
    if !alone.takes_too_many_steps(touches) {
        return Ok(None);
    }
    has_just_split(path, before)
}

/// If one of the contacts of the present orbit, at which the problem is evaluated again, begins with next
/// to no speed.
fn has_just_split(path: &mut OrbitPath, before: &Departed) -> Result<Option<StopReason>, OrbitError> {
    let present = place(path);
    let span = move_to_orbit(path, &present);
    let begin = (present.phase, present.state);
    let found =
        span.and_then(|span| splitting::find_slow_begin(path.problem.integrator(), begin, span).ok()?);
    evaluate(&mut path.problem, &present.point.point)?;
    Ok(found.map(|splitting| splits_at(before.point.parameter(), splitting)))
}

/// If a step has passed a splitting: the number of contacts of an element has changed since the last row,
/// and a contact of it splits in the orbit `before` the step or in the present one, at which the problem
/// was evaluated last.
///
/// Beside a splitting two sheets of orbits lie close to one another, and a corrector may fall from one
/// onto the other, in a step or where the orbit is cut anew. That is no way on.
fn passes_splitting(
    path: &mut OrbitPath,
    touches: &[u32],
    before: &Departed,
) -> Result<Option<Splitting>, OrbitError> {
    let (system, now) = (path.problem.system(), path.problem.touches());
    let changed = splitting::elements_with_other_touches(system, touches, now);
    if changed.is_empty() {
        return Ok(None);
    }
    let current = place(path);
    let among = |found: Splitting| Some(found).filter(|found| changed.contains(&found.element));
    let splits = splitting_of(path, before).and_then(among);
    let splits = splits.or_else(|| splitting_of(path, &current).and_then(among));
    evaluate(&mut path.problem, &current.point.point)?;
    Ok(splits)
}

/// If a contact of the present orbit is about to open and to be pressed on again at once, or has just
/// begun to.
pub(super) fn splits_here(path: &mut OrbitPath, place: f64) -> Option<StopReason> {
    let present = may_split(path)?;
    splitting_of(path, &present).map(|splitting| splits_at(place, splitting))
}

/// Where the present orbit begins, if a contact of it may split.
pub(super) fn may_split(path: &OrbitPath) -> Option<Departed> {
    path.problem.system().remembers_impacts().then(|| place(path))
}

/// Work done so far.
pub(super) fn work(path: &mut OrbitPath) -> Work {
    let force_steps = path.problem.integrator().counts().steps;
    Work { force_steps, evaluations: path.follower.counters().evaluations }
}

fn place(path: &OrbitPath) -> Departed {
    let point = path.follower.current().clone();
    Departed { phase: path.problem.phase(), state: path.problem.nodes(&point.point).swap_remove(0), point }
}

/// Where a contact of an orbit splits.
fn splitting_of(path: &mut OrbitPath, orbit: &Departed) -> Option<Splitting> {
    let span = move_to_orbit(path, orbit)?;
    let begin = (orbit.phase, orbit.state.clone());
    splitting::find(path.problem.integrator(), begin, span).ok()?
}

/// Sets the parameter of an orbit; its frequency [Hz] and its excitation periods.
fn move_to_orbit(path: &mut OrbitPath, orbit: &Departed) -> Option<(f64, f64)> {
    let point = &orbit.point.point;
    path.problem.move_to(point).ok()?;
    Some((path.problem.frequency(point), f64::from(path.problem.period_multiple())))
}

/// Why a walk ends whose last orbit has this frequency.
fn splits_at(place: f64, Splitting { element, phase }: Splitting) -> StopReason {
    StopReason::ContactReopens { place, element, phase }
}
