//! Whether a motion has come to a stable orbit that is known: then it need not be followed any further.

use hammerbeam_motion::exact::{ExactIntegrator, MotionError};

use crate::{
    PeriodicSolution,
    matching::{distance_in_phase, states_at_phase},
    size::orbit_scale,
    state_scale::StateScale,
};

/// Distance from an orbit, relative to it, at which a motion has come to it.
const ARRIVED: f64 = 1e-5;

/// The stable orbits known at one frequency, by their states at phase 0.
#[derive(Debug, Default)]
pub(crate) struct StableOrbits(Vec<(StateScale, Vec<Vec<f64>>)>);

impl StableOrbits {
    /// Adds an orbit if it is stable.
    ///
    /// # Errors
    /// [`MotionError`] if its motion cannot be computed.
    pub fn add(
        &mut self,
        integrator: &mut ExactIntegrator,
        orbit: &PeriodicSolution,
    ) -> Result<(), MotionError> {
        if orbit.stable() {
            let scale = orbit_scale(integrator, orbit)?;
            self.0.push((scale, states_at_phase(integrator, orbit, 0.0)?));
        }
        Ok(())
    }

    /// Whether a motion with that state at phase 0 has come to one of them.
    pub fn are_reached(&self, state: &[f64]) -> bool {
        self.0.iter().any(|(scale, phases)| distance_in_phase(scale, phases, state) < ARRIVED)
    }
}
