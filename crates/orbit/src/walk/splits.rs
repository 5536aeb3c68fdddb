//! Whether a walk has come to the place where a contact splits.

use hammerbeam_path::ContinuationPoint;

use super::orbit_path::OrbitPath;
use crate::{
    OrbitError, StopReason,
    solve::evaluate,
    splitting::{self, Splitting},
};

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
    let short = path.follower.counters().short_in_a_row;
    if short == 0 || !short.is_multiple_of(splitting::SHORT_STEPS) {
        return None;
    }
    splits_here(path, path.parameter())
}

/// If the step from `departure` has passed a splitting, or takes too many force steps beside one.
///
/// * `touches`: of each contact at the row before.
pub(super) fn comes_to_splitting(
    path: &mut OrbitPath,
    touches: &[u32],
    departure: &Departure,
) -> Result<Option<StopReason>, OrbitError> {
    let Some(before) = &departure.place else { return Ok(None) };
    let spent = work(path).since(departure.work);
    if let Some(splits) = passes_splitting(path, touches, before)? {
        return Ok(Some(splits));
    }
    labours_at_splitting(path, before, spent)
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
) -> Result<Option<StopReason>, OrbitError> {
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
    Ok(splits.map(|splitting| splits_at(before.point.parameter(), splitting)))
}

/// If a contact of the present orbit is about to open and to be pressed on again at once, or has just
/// begun to.
pub(super) fn splits_here(path: &mut OrbitPath, frequency_hz: f64) -> Option<StopReason> {
    let present = may_split(path)?;
    splitting_of(path, &present).map(|splitting| splits_at(frequency_hz, splitting))
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
fn splits_at(frequency_hz: f64, Splitting { element, phase }: Splitting) -> StopReason {
    StopReason::ContactReopens { frequency_hz, element, phase }
}
