//! Moves the phase at which the orbits of a walk start, before a contact of an impact-speed-dependent law
//! comes to lie over it, or an impact on a rigid stop, where the state jumps.
//!
//! Before each step the contacts of the present orbit are looked at (`cut.rs`). If one is near the phase, the
//! orbit is cut anew in the middle of its longest time without contact: the state and its tangent are carried
//! there by the flow, `t' = dZ/dz t + dZ/df t_f`. Where a step fails all the same, as at a contact that
//! appears by grazing just at the phase, the present phase counts as a contact. Where a rigid stop holds the
//! structure but for an instant, the start stays within that contact. Multipliers and the orientation of the
//! path do not depend on the phase: `A' - I = P (A - I) P^-1` with the fundamental matrix `P` in between.
//!
//! The start of the walk is cut at the new phase, too, so that a loop still closes. Where it is in contact
//! there, it is out of reach until the path comes back to its frequency.
//!
//! What is lost: the memory of the path holds first nodes, which at another phase are others. It starts anew,
//! so a stretch that was walked before the phase moved is not recognised if the path should run back into it.
//! All segments of an orbit that is cut (`halves.rs`) start later by the same time, or are joined first;
//! where the study gives the number of segments the phase does not move.

use hammerbeam_motion::Stretch;
use hammerbeam_path::{ContinuationPoint, Node};

use super::{
    halves::{cut_in_halves, join_segments, offset_to_clear_ends, origin_now},
    orbit_path::OrbitPath,
    refine::refine,
};
use crate::{
    OrbitError, Segments,
    cut::{Gap, contacts, longest_of_orbit, must_start_off_contacts},
    shooting::ShootingProblem,
};

/// Most segments of an orbit whose ends keep clear of impacts.
const MOST_CUT: usize = 16;

/// Whether the orbits of a path may have to start at another phase.
pub(super) fn moves_phase(path: &OrbitPath) -> bool {
    must_start_off_contacts(path.problem.system()) && path.problem.segments() == 1
}

/// Keeps the phase away from contacts, and brings back the start where it can be.
pub(super) fn keep_phase_clear(path: &mut OrbitPath) {
    if path.follower.stop_reason().is_some() {
        return;
    }
    while is_cut(path) && !ends_are_clear(path) && join_segments(path) {}
    if !moves_phase(path) {
        return;
    }
    if let Some(offset) = offset(path, false) {
        move_phase(path, offset);
    } else if path.is_near_lost_start() {
        move_phase(path, 0.0);
    }
}

/// Moves the phase although no contact is near it: a step has failed; false if it does not go.
pub(super) fn flee_phase(path: &mut OrbitPath) -> bool {
    moves_phase(path) && offset(path, true).is_some_and(|offset| move_phase(path, offset))
}

/// By how much the phase should move [cycles].
fn offset(path: &mut OrbitPath, flees: bool) -> Option<f64> {
    let OrbitPath { problem, follower, .. } = path;
    let point = &follower.current().point;
    problem.move_to(point).ok()?;
    let (phase, cycles) = (problem.phase(), f64::from(problem.period_multiple()));
    let (frequency_hz, state) = (problem.frequency(point), problem.nodes(point).swap_remove(0));
    let contacts = contacts(problem.integrator(), (phase, cycles), &state, frequency_hz).ok()?;
    let (gap, nearest) = longest_of_orbit(&contacts, cycles, flees)?;
    let keeps_start = !problem.system().remembers_impacts()
        && gap.is_short()
        && lasts_over_start(&contacts, cycles, gap.length());
    let moves = flees || gap.asks_to_move(nearest) && !keeps_start;
    let offset = gap.middle(phase).rem_euclid(cycles);
    (moves && offset > 0.0).then_some(offset)
}

/// Whether a contact lasts so long before the start of an orbit, and behind it: a stop that holds the
/// structure is a better start than a flight of an instant.
fn lasts_over_start(contacts: &[Gap], cycles: f64, long: f64) -> bool {
    let behind = |contact: &Gap| contact.start <= 0.0 && contact.end > long;
    let before = |contact: &Gap| contact.end >= cycles && contact.start < cycles - long;
    contacts.iter().any(behind) && contacts.iter().any(before)
}

/// Whether its orbits were cut (`halves.rs`).
fn is_cut(path: &OrbitPath) -> bool {
    let is_given = matches!(path.settings.segments, Segments::Fixed(_));
    must_start_off_contacts(path.problem.system()) && path.problem.segments() > 1 && !is_given
}

/// Cuts the present orbit and the start of the walk this much later; false if the walk stays as it was.
fn move_phase(path: &mut OrbitPath, offset: f64) -> bool {
    let start_of_walk = origin_now(path);
    let OrbitPath { problem, follower, origin, .. } = path;
    let (before, cycles) = (problem.phase(), f64::from(problem.period_multiple()));
    let phase = (before + offset).rem_euclid(cycles);
    let Ok(current) = carried(problem, follower.current(), (before, offset)) else { return false };
    let start = start_of_walk.as_ref().and_then(|origin| {
        let old = follower.state().in_present_units(&origin.point);
        let later = (phase - origin.phase).rem_euclid(cycles);
        Some((carried(problem, &old, (origin.phase, later)).ok()?, old))
    });
    problem.set_phase(phase);
    let with_start = start.as_ref().map(|(start, old)| (start, old));
    let mut moved = with_start.is_some() && follower.transfer_afresh(problem, &current, with_start).is_ok();
    if !moved && offset > 0.0 {
        moved = follower.transfer_afresh(problem, &current, None).is_ok();
    }
    if !moved {
        problem.set_phase(before);
        return false;
    }
    *origin = start_of_walk;
    restart_journal(path);
    true
}

/// Before the phases of the new one the journal has a point without unknowns.
fn restart_journal(path: &mut OrbitPath) {
    path.journal.push(ContinuationPoint::empty(0));
    path.note_in_journal();
    path.measures_anew = true;
}

/// Goes on with orbits of twice the segments, which start elsewhere where an impact is near an end of one.
/// False if the walk stays as it was.
pub(super) fn halve(path: &mut OrbitPath) -> bool {
    let segments = 2 * path.problem.segments();
    if segments > MOST_CUT || !path.problem.system().has_rigid_stops() {
        return false;
    }
    match offset_to_clear_ends(path, segments) {
        Some(offset) if offset > 0.0 => cut_elsewhere(path, offset, 2),
        Some(_) => cut_in_halves(path),
        None => false,
    }
}

/// Whether the ends of all segments of an orbit that is cut are clear of impacts, now that they start later
/// if need be: over one segment a disturbance may grow so fast that the orbit is lost. Not if the start of
/// the walk is to be found again, for which they are joined.
fn ends_are_clear(path: &mut OrbitPath) -> bool {
    let segments = path.problem.segments();
    if path.is_near_lost_start() {
        return false;
    }
    let offset = offset_to_clear_ends(path, segments);
    offset.is_some_and(|offset| offset == 0.0 || cut_elsewhere(path, offset, 1))
}

/// Lets the present orbit start this much later, and cuts each of its segments into `factor`: behind a corner
/// in which several stops were grazed a disturbance grows so fast over one segment that its phase cannot be
/// moved any more. The start of the walk is out of reach from then on. False if the walk stays as it was.
fn cut_elsewhere(path: &mut OrbitPath, offset: f64, factor: usize) -> bool {
    let start_of_walk = origin_now(path);
    let OrbitPath { problem, follower, origin, .. } = path;
    let (before, segments) = (problem.phase(), problem.segments());
    let Ok(later) = carried(problem, follower.current(), (before, offset)) else { return false };
    let later =
        ContinuationPoint { point: later.point, tangent: later.tangent, ..follower.current().clone() };
    problem.set_phase((before + offset).rem_euclid(f64::from(problem.period_multiple())));
    let cut = refine(problem, &later, factor);
    problem.set_segments(segments * factor);
    if !cut.is_ok_and(|cut| follower.transfer_afresh(problem, &cut, None).is_ok()) {
        problem.set_segments(segments);
        problem.set_phase(before);
        return false;
    }
    *origin = start_of_walk;
    restart_journal(path);
    true
}

/// Point and tangent of an orbit whose nodes lie this much later than the nodes of a point that starts at the
/// phase `from`.
fn carried(
    problem: &mut ShootingProblem,
    at: &ContinuationPoint,
    (from, offset): (f64, f64),
) -> Result<Node, OrbitError> {
    let (mut point, mut tangent) = (at.point.clone(), at.tangent.clone());
    if offset == 0.0 {
        return Ok(Node { point, tangent });
    }
    let (size, frequency_hz, last) = (problem.node_size(), problem.frequency(&point), point.len() - 1);
    problem.move_to(&point)?;
    let nodes = last / size;
    for node in 0..nodes {
        let start = from + node as f64 * f64::from(problem.period_multiple()) / nodes as f64;
        let stretch = Stretch { frequency_hz, start, end: start + offset };
        let slope = problem.node_slope(&at.point, &at.tangent, node);
        let carried = problem.carried(&slope, &stretch, at.tangent[last])?;
        let place = node * size..(node + 1) * size;
        point[place.clone()].copy_from_slice(&carried.node);
        tangent[place].copy_from_slice(&carried.slope);
    }
    Ok(Node { point, tangent })
}
