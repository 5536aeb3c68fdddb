//! Whether two rigid stops are struck at one instant where a walk gets no further.
//!
//! With modes of unit mass, and the shape `φ` of the relative displacement `r = φ · q + ...` of a stop, an
//! impact adds `−(1 + e) r' φ/(φ · φ)` to the modal velocities. Of two impacts at one instant the second
//! begins with `r'` as the first has left it: the sum depends on which comes first, by a multiple of `φ₁ ·
//! φ₂`. Where `φ₁ · φ₂ ≠ 0` the motion jumps from one side of such an orbit to the other, and a branch that
//! comes to it ends: where both stops act on one body, or on a structure of so few modes that each shakes
//! the place of the other. Else the order does not matter, and the branch goes on.
//!
//! The second impact need not happen: the first one may turn it away. So it is asked, at each impact, whether
//! another stop is reached at that instant.

use hammerbeam_motion::System;

use super::last_motion::{Impact, LastMotion};
use crate::by_rows::dot;

/// Longest time between the two [cycles]: the shortest steps of a walk come nearer.
const AT_ONE_INSTANT: f64 = 1e-7;
/// Least speed at either stop, relative to the other: one that is held, or grazed, is not struck.
const SLOWER: f64 = 1e-3;
/// Cosine between shapes, and what it is off one, that is rounding.
const ROUNDED: f64 = 1e-9;

/// Names of the two stops, and the phase of the excitation [cycles].
pub(super) fn struck_together(system: &System, motion: &LastMotion) -> Option<(String, f64)> {
    motion.impacts().find_map(|impact| {
        let other = (0..system.elements().len()).find(|&other| is_struck_with(system, &impact, other))?;
        let name = |element: usize| system.elements()[element].name.as_str();
        let (first, second) = (impact.element.min(other), impact.element.max(other));
        Some((format!("{} and {}", name(first), name(second)), impact.phase.rem_euclid(1.0)))
    })
}

fn is_struck_with(system: &System, impact: &Impact<'_>, other: usize) -> bool {
    let (own, shape) = (&system.elements()[impact.element].shape, &system.elements()[other].shape);
    let Some(stop) = system.elements()[other].law.rigid().filter(|_| other != impact.element) else {
        return false;
    };
    let cosine = dot(own, shape) / (dot(own, own) * dot(shape, shape)).sqrt();
    // Stops of one shape and level are struck together at every impact.
    if !(ROUNDED..1.0 - ROUNDED).contains(&cosine.abs()) {
        return false;
    }
    let [r, velocity, _] =
        system.relative_motion(other, impact.frequency_hz, impact.phase, &impact.touch.state);
    // One that was struck just before leaves.
    let (one, two) = (impact.touch.velocity.abs(), velocity.abs());
    let cycles = (stop.level() - r) / velocity * impact.frequency_hz;
    one.min(two) > SLOWER * one.max(two) && cycles.abs() < AT_ONE_INSTANT
}
