//! The orbit of a system from the orbit of a slightly different one.

use hammerbeam_motion::System;

use crate::{OrbitError, OrbitSettings, PeriodicSolution, Response, start::attempt_nodes};

/// The orbit of `system` by Newton's method from an orbit of another system, at its frequency and with its
/// segments.
///
/// `None` if the method fails, ends at an orbit of shorter period, or if the systems have different numbers
/// of modes.
///
/// # Errors
/// [`OrbitError::Motion`] if the motion of the system cannot be computed at all.
pub fn neighbouring_orbit(
    system: &System,
    response: &Response,
    near: &PeriodicSolution,
    settings: &OrbitSettings,
) -> Result<Option<PeriodicSolution>, OrbitError> {
    if near.nodes.iter().any(|node| node.len() != 2 * system.dof()) {
        return Ok(None);
    }
    let orbit = (near.frequency_hz, near.period_multiple);
    attempt_nodes(system, response, (near.phase, &near.nodes), orbit, settings)
}
