//! Orbits that start on an impact, started elsewhere.
//!
//! Newton's method may come to an orbit that strikes a rigid stop just where it starts: without losses and
//! under a load in phase many do, since they go backwards in time alike, with an impact at phase 0. Rounding
//! then says on which side of the impact its first state lies. So that state does not identify the orbit, and
//! a walk that starts there has the impact at both of its ends or at neither. Started in the middle of its
//! longest flight, the orbit is like any other.

use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, MotionError},
};

use crate::{
    PeriodicSolution,
    cut::{contacts, longest_of_orbit},
};

/// Impacts so near are on the start [cycles].
const ON: f64 = 1e-7;

/// The orbit with one node in its longest flight; `None` where no impact lies on its start.
///
/// # Errors
/// [`MotionError`] if its motion cannot be computed.
pub(crate) fn started_off_impacts(
    integrator: &mut ExactIntegrator,
    orbit: &PeriodicSolution,
) -> Result<Option<PeriodicSolution>, MotionError> {
    if !integrator.system().has_rigid_stops() {
        return Ok(None);
    }
    let (frequency_hz, phase, cycles) = (orbit.frequency_hz, orbit.phase, f64::from(orbit.period_multiple));
    let contacts = contacts(integrator, (phase, cycles), &orbit.nodes[0], frequency_hz)?;
    let is_impact = |time: f64| contacts.iter().any(|it| it.length() < ON && (it.start - time).abs() < ON);
    let Some((flight, _)) = longest_of_orbit(&contacts, cycles, false) else { return Ok(None) };
    if !is_impact(0.0) && !is_impact(cycles) {
        return Ok(None);
    }
    let offset = flight.middle(phase).rem_euclid(cycles);
    let stretch = Stretch { frequency_hz, start: phase, end: phase + offset };
    let node = integrator.advance(&stretch, &orbit.nodes[0])?;
    Ok(Some(PeriodicSolution { phase: (phase + offset).fract(), nodes: vec![node], ..orbit.clone() }))
}
