//! Orbits whose ends have to keep clear of impacts, cut into two segments, four and more, and joined again.
//!
//! A symmetric orbit comes to graze two opposite rigid stops at once. Over one segment the speed `v` of the
//! first touch, which goes like the root of its depth, moves the second one, whose speed then goes like the
//! root of `v`: the corner there is none of those that the path crate turns. Cut in two, each touch lies in a
//! segment of its own, and depends on the state before it alone. The multipliers grow like the product of
//! `1/v` of all touches, so an orbit of several slow impacts is better cut, too, and if two segments are not
//! enough, each of them again.
//!
//! The phases at which a cut orbit starts and is cut must all be clear of impacts. Where an impact comes near
//! one of them all segments start later (`start_phase.rs`). Where that cannot be, or there is no longer more
//! than one impact, each two segments are joined, and a single one may start elsewhere. An orbit with an
//! impact near the ends of its new segments, as behind the corner of two stops, is cut elsewhere
//! (`start_phase.rs`). A branch of doubled period starts with twice the segments of the orbit that it leaves.

use hammerbeam_path::{ContinuationPoint, Node};

use super::{
    orbit_path::{OrbitPath, Origin},
    refine::refine,
};
use crate::cut::{contacts, folded, longest_of_orbit};

/// Cuts each segment in two, where the ends of the new ones are clear of impacts; false if the walk stays as
/// it was.
pub(super) fn cut_in_halves(path: &mut OrbitPath) -> bool {
    let OrbitPath { problem, follower, .. } = path;
    let Ok(current) = refine(problem, follower.current(), 2) else {
        return false;
    };
    let started = Some(&follower.state().start).filter(|_| follower.state().has_start());
    let start = started.and_then(|start| refine(problem, start, 2).ok());
    let segments = 2 * path.problem.segments();
    go_on_with(path, segments, &current, start.as_ref())
}

/// Joins each two segments of an orbit; false if the walk stays as it was.
pub(super) fn join_segments(path: &mut OrbitPath) -> bool {
    let segments = path.problem.segments();
    let size = path.problem.node_size();
    // All are made one where their number is odd.
    let joined = if segments.is_multiple_of(2) { 2 } else { segments };
    let current = every(joined, path.follower.current(), size);
    let state = path.follower.state();
    let start = state.has_start().then(|| every(joined, &state.start, size));
    go_on_with(path, segments / joined, &current, start.as_ref())
}

/// By how much later the present orbit would have to start for the ends of so many segments to be clear of
/// impacts [cycles]; zero if they are. None where it has a single impact, for which more than one segment is
/// of no use, where impacts leave next to no time for the ends of more than two, or where it cannot be
/// followed.
pub(super) fn offset_to_clear_ends(path: &mut OrbitPath, segments: usize) -> Option<f64> {
    let OrbitPath { problem, follower, .. } = path;
    let point = &follower.current().point;
    problem.move_to(point).ok()?;
    let (phase, cycles) = (problem.phase(), f64::from(problem.period_multiple()));
    let (frequency_hz, nodes) = (problem.frequency(point), problem.nodes(point));
    let part = cycles / nodes.len() as f64;
    let mut closed = Vec::new();
    for (number, node) in nodes.iter().enumerate() {
        let later = number as f64 * part;
        let of_part = contacts(problem.integrator(), (phase + later, part), node, frequency_hz).ok()?;
        closed.extend(of_part.into_iter().map(|contact| contact.later(later)));
    }
    match closed.len() {
        0 => return Some(0.0),
        1 => return None,
        _ => {}
    }
    let length = cycles / segments as f64;
    let (gap, nearest) = longest_of_orbit(&folded(&closed, length), length, false)?;
    if segments > 2 && gap.is_short() {
        return None;
    }
    Some(if gap.asks_to_move(nearest) { gap.middle(phase).rem_euclid(length) } else { 0.0 })
}

fn go_on_with(path: &mut OrbitPath, segments: usize, current: &Node, start: Option<&Node>) -> bool {
    let before = path.problem.segments();
    let origin = origin_now(path);
    let OrbitPath { problem, follower, .. } = path;
    problem.set_segments(segments);
    let mut moved = start.is_some() && follower.transfer(problem, current, start).is_ok();
    if !moved {
        // The start is brought back where the path comes near it.
        moved = follower.transfer(problem, current, None).is_ok();
    }
    if moved {
        path.origin = origin;
        path.measures_anew = true;
    } else {
        problem.set_segments(before);
    }
    moved
}

/// The start of the walk as an orbit of one segment.
pub(super) fn origin_now(path: &OrbitPath) -> Option<Origin> {
    let state = path.follower.state();
    let of_start = || {
        let mut point = state.in_first_units(&state.start);
        let node = every(path.problem.segments(), &point, path.problem.node_size());
        (point.point, point.tangent) = (node.point, node.tangent);
        Origin { phase: path.problem.phase(), point }
    };
    path.origin.clone().or_else(|| state.has_start().then(of_start))
}

/// The first of each so many nodes of a point and the last unknown, with the tangent there.
fn every(joined: usize, at: &ContinuationPoint, size: usize) -> Node {
    let of = |values: &[f64]| {
        let nodes = values.chunks_exact(size).step_by(joined).flatten();
        nodes.chain(values.last()).copied().collect()
    };
    Node { point: of(&at.point), tangent: of(&at.tangent) }
}
