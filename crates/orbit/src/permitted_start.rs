//! States at which a motion can start, near those at which none can. A state within a contact does not hold
//! the speed of its impact, which a law may need; and there is no such speed where the structure is pressed
//! against the stop on which it rests.

use hammerbeam_motion::{
    Stretch, System,
    exact::{ExactIntegrator, MotionError},
    in_front_of_contacts,
};

use crate::state_scale::state_of_rest;

/// Cycles within which a motion that cannot start has failed.
const INSTANT: f64 = 1.0 / 1024.0;

/// Whether a motion can start at a state at phase 0.
fn can_start(integrator: &mut ExactIntegrator, frequency_hz: f64, state: &[f64]) -> bool {
    let instant = Stretch { frequency_hz, start: 0.0, end: INSTANT };
    let started = integrator.advance(&instant, state);
    !matches!(started, Err(MotionError::StartsInContact { .. } | MotionError::PressedWithoutImpact { .. }))
}

/// A state at phase 0 at which a motion can start: the given one, or one in front of the contacts, or the one
/// half-way to `other`. The given one, too, if there is no motion from any.
pub(crate) fn permitted_start_near(
    integrator: &mut ExactIntegrator,
    frequency_hz: f64,
    state: Vec<f64>,
    other: &[f64],
) -> Vec<f64> {
    if !integrator.system().remembers_impacts() || can_start(integrator, frequency_hz, &state) {
        return state;
    }
    let half_way = state.iter().zip(other).map(|(a, b)| 0.5 * (a + b)).collect();
    let candidates = [in_front(integrator.system(), frequency_hz, &state), half_way];
    candidates.into_iter().find(|candidate| can_start(integrator, frequency_hz, candidate)).unwrap_or(state)
}

/// Moves a state at phase 0 out of the contact of an impact-speed-dependent law: to its mirror image about
/// the place of rest. That may lie in such a contact too, as where a constant load presses the structure
/// against its stop; then to its reflection at the stop. The state itself if it is in none, or if none is
/// found outside.
pub(crate) fn in_front(system: &System, frequency_hz: f64, state: &[f64]) -> Vec<f64> {
    let within = |state: &[f64]| system.is_in_remembered_contact(frequency_hz, 0.0, state);
    if !within(state) {
        return state.to_vec();
    }
    let mirrored: Vec<f64> =
        state.iter().zip(state_of_rest(system)).map(|(z, rest)| 2.0 * rest - z).collect();
    if !within(&mirrored) {
        return mirrored;
    }
    in_front_of_contacts(system, frequency_hz, 0.0, state).unwrap_or_else(|| state.to_vec())
}
