//! Whether a walk has come to the place where a contact reopens, and how far it goes before that.
//!
//! A step that has passed the place says no more than that the branch ends within its length. The end is
//! found by halving: from the last orbit that is known, half of what is left is gone along its tangent. The
//! orbit there is the next one if the corrector comes to it, it has the contacts of the branch, and it is
//! distinguished from the other side.

use hammerbeam_path::{ContinuationPoint, solve_between};

use super::{
    orbit_path::OrbitPath,
    row::{RowRecord, row_at},
};
use crate::{
    BranchRow, OrbitError, StopReason,
    reopening::{self, Reopening},
    solve::evaluate,
    spectrum::largest_modulus,
};

/// Halvings of a step that has passed a reopening, to an interval of rounding.
const HALVINGS: u32 = 40;

/// A point of a walk and the phase at which its orbit starts.
pub(super) struct Departed {
    /// Phase of the excitation [cycles].
    phase: f64,
    /// First node of the orbit.
    state: Vec<f64>,
    point: ContinuationPoint,
}

/// Work of a walk; differences of it depend on nothing but the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepWork {
    /// Steps of the motion with forces.
    force_steps: u64,
    /// Shooting evaluations.
    evaluations: u64,
}

/// What is known of a walk before a step.
pub(super) struct Departure {
    /// The point that is left; `None` where no contact can reopen.
    pub place: Option<Departed>,
    pub work: StepWork,
}

impl StepWork {
    fn since(self, earlier: Self) -> Self {
        Self {
            force_steps: self.force_steps - earlier.force_steps,
            evaluations: self.evaluations - earlier.evaluations,
        }
    }

    /// Whether an orbit with so many touches took far more steps of the motion than touches take.
    fn takes_too_many_steps(self, touches: u64) -> bool {
        self.force_steps > reopening::MOST_STEPS_AT_TOUCH * touches.max(1) * self.evaluations.max(1)
    }
}

/// If the last steps were short, and a contact of the present orbit reopens: the way to the border is no
/// longer resolved.
pub(super) fn tends_to_reopening(path: &mut OrbitPath) -> Option<StopReason> {
    let short = path.follower.counters().short_steps;
    if short == 0 || !short.is_multiple_of(reopening::SHORT_STEPS) {
        return None;
    }
    reopens_here(path, path.parameter())
}

/// If the step from `departure` has passed a reopening, or takes too many force steps beside one: the last
/// orbit before that, with why the walk ends.
///
/// * `record`: at the row before.
/// * `from`: the point before the present one, cut in the same way.
pub(super) fn comes_to_reopening(
    path: &mut OrbitPath,
    record: &mut RowRecord,
    departure: &Departure,
    from: &ContinuationPoint,
) -> Result<Option<(ContinuationPoint, StopReason)>, OrbitError> {
    let Some(before) = &departure.place else { return Ok(None) };
    let spent = work(path).since(departure.work);
    if let Some(found) = passes_reopening(path, &record.touches, before)? {
        let last = last_before_reopening(path, record, from);
        let reason = reopens_at(last.parameter(), found);
        return Ok(Some((last, reason)));
    }
    let labours = labours_at_reopening(path, before, spent)?;
    Ok(labours.map(|reason| (from.clone(), reason)))
}

/// The last orbit of a branch that is found behind `from` before the reopening that the step to the present
/// orbit has passed.
fn last_before_reopening(
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
            if path.problem.touches() == record.touches && is_resolved(path) {
                last = found;
            }
        }
    }
    last
}

/// Whether the orbit at which the problem was evaluated last is distinguished from those on the other side.
fn is_resolved(path: &mut OrbitPath) -> bool {
    path.problem.multipliers().is_ok_and(|multipliers| largest_modulus(multipliers) < reopening::UNRESOLVED)
}

/// The point at a length ahead on the tangent of another one.
pub(super) fn along_tangent(from: &ContinuationPoint, length: f64) -> ContinuationPoint {
    let point = from.point.iter().zip(&from.tangent).map(|(x, t)| x + length * t).collect();
    ContinuationPoint { point, arc_length: from.arc_length + length, ..from.clone() }
}

impl RowRecord {
    /// Appends the row of the last orbit before a reopening, and the rows between `from` and it; none if it
    /// is `from`.
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

/// If the multipliers of the present orbit are too large to decide on which side of a reopening it is, and
/// one of its contacts starts with next to no speed.
pub(super) fn is_lost_at_reopening(
    path: &mut OrbitPath,
    departure: &Departure,
    largest_multiplier: f64,
) -> Result<Option<StopReason>, OrbitError> {
    match &departure.place {
        Some(before) if largest_multiplier >= reopening::UNRESOLVED => has_just_reopened(path, before),
        _ => Ok(None),
    }
}

/// If the motion of the last step, which led away from `before`, took far more work than its contacts need,
/// the evaluation of the orbit reached does, and one of its contacts starts with next to no speed.
fn labours_at_reopening(
    path: &mut OrbitPath,
    before: &Departed,
    spent: StepWork,
) -> Result<Option<StopReason>, OrbitError> {
    let touches = path.problem.touches().iter().map(|&touches| u64::from(touches)).sum();
    if !spent.takes_too_many_steps(touches) {
        return Ok(None);
    }
    let present = place(path);
    // A correction on a wrong way may have been what cost so much.
    let earlier = work(path);
    evaluate(&mut path.problem, &present.point.point)?;
    let alone = StepWork { evaluations: 1, ..work(path).since(earlier) };
    if !alone.takes_too_many_steps(touches) {
        return Ok(None);
    }
    has_just_reopened(path, before)
}

/// If one of the contacts of the present orbit, at which the problem is evaluated again, starts with next to
/// no speed.
fn has_just_reopened(path: &mut OrbitPath, before: &Departed) -> Result<Option<StopReason>, OrbitError> {
    let present = place(path);
    let span = move_to_orbit(path, &present);
    let start = (present.phase, present.state);
    let found =
        span.and_then(|span| reopening::find_slow_start(path.problem.integrator(), start, span).ok()?);
    evaluate(&mut path.problem, &present.point.point)?;
    Ok(found.map(|found| reopens_at(before.point.parameter(), found)))
}

/// If a step has passed a reopening: the number of contacts of an element has changed since the last row, and
/// a contact of it reopens in the orbit `before` the step or in the present one, at which the problem was
/// evaluated last.
///
/// Beside a reopening two sheets of orbits lie close to one another, and a corrector may fall from one onto
/// the other, in a step or where the orbit is cut anew. That is no way on.
fn passes_reopening(
    path: &mut OrbitPath,
    touches: &[u32],
    before: &Departed,
) -> Result<Option<Reopening>, OrbitError> {
    let (system, now) = (path.problem.system(), path.problem.touches());
    let changed = reopening::elements_with_other_touches(system, touches, now);
    if changed.is_empty() {
        return Ok(None);
    }
    let current = place(path);
    let among = |found: Reopening| Some(found).filter(|found| changed.contains(&found.element));
    let found = reopening_of(path, before).and_then(among);
    let found = found.or_else(|| reopening_of(path, &current).and_then(among));
    evaluate(&mut path.problem, &current.point.point)?;
    Ok(found)
}

/// If a contact of the present orbit is about to reopen or has just done so.
pub(super) fn reopens_here(path: &mut OrbitPath, place: f64) -> Option<StopReason> {
    let present = may_reopen(path)?;
    reopening_of(path, &present).map(|found| reopens_at(place, found))
}

/// Where the present orbit starts, if a contact of it may reopen.
pub(super) fn may_reopen(path: &OrbitPath) -> Option<Departed> {
    path.problem.system().remembers_impacts().then(|| place(path))
}

/// Work done so far.
pub(super) fn work(path: &mut OrbitPath) -> StepWork {
    let force_steps = path.problem.integrator().counts().steps;
    StepWork { force_steps, evaluations: path.follower.counters().evaluations }
}

fn place(path: &OrbitPath) -> Departed {
    let point = path.follower.current().clone();
    Departed { phase: path.problem.phase(), state: path.problem.nodes(&point.point).swap_remove(0), point }
}

/// Where a contact of an orbit reopens.
fn reopening_of(path: &mut OrbitPath, orbit: &Departed) -> Option<Reopening> {
    let span = move_to_orbit(path, orbit)?;
    let start = (orbit.phase, orbit.state.clone());
    reopening::find(path.problem.integrator(), start, span).ok()?
}

/// Sets the parameter of an orbit; its frequency [Hz] and its excitation periods.
fn move_to_orbit(path: &mut OrbitPath, orbit: &Departed) -> Option<(f64, f64)> {
    let point = &orbit.point.point;
    path.problem.move_to(point).ok()?;
    Some((path.problem.frequency(point), f64::from(path.problem.period_multiple())))
}

/// Why a walk ends whose last orbit has this frequency.
fn reopens_at(place: f64, Reopening { element, phase }: Reopening) -> StopReason {
    StopReason::ContactReopens { place, element, phase }
}
