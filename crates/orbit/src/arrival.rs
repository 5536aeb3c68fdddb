//! Whether a motion has come to a stable orbit that is known: then it need not be followed any further.
//!
//! Near a stable orbit the distance falls like `r^n` over n periods, where r is the largest modulus of its
//! multipliers. Where it has fallen to a tenth since the motion came near, the motion is in that regime, and
//! where it leads is seen. To wait until nothing of the distance is left would take several times as long
//! where damping is low.

use hammerbeam_motion::exact::{ExactIntegrator, MotionError};

use crate::{
    PeriodicSolution,
    matching::{distance_in_phase, states_at_phase},
    size::orbit_scale,
    state_scale::StateScale,
};

/// Distance from an orbit, relative to it, at which a motion has come to it in any case.
const ARRIVED: f64 = 1e-5;
/// Distance at which it is near.
const NEAR: f64 = 1e-2;
/// Part of the distance at which it came near, below which it is on its way to the orbit.
const FALLEN: f64 = 0.1;

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

    /// A motion that is about to be followed.
    pub fn approached(&self) -> Approach {
        Approach { entered: vec![None; self.0.len()] }
    }
}

/// How a motion approaches the orbits that were known when it began.
#[derive(Debug)]
pub(crate) struct Approach {
    /// For each orbit the distance at which the motion came near it, if it is there.
    entered: Vec<Option<f64>>,
}

impl Approach {
    /// Whether the motion, with that state at the next instant of phase 0, has come to one of them.
    pub fn has_arrived(&mut self, orbits: &StableOrbits, state: &[f64]) -> bool {
        let mut arrived = false;
        for (entered, (scale, phases)) in self.entered.iter_mut().zip(&orbits.0) {
            let distance = distance_in_phase(scale, phases, state);
            *entered = (distance < NEAR).then(|| entered.unwrap_or(distance));
            let has_fallen = entered.is_some_and(|entered| distance < FALLEN * entered);
            arrived |= has_fallen || distance < ARRIVED;
        }
        arrived
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distances of a motion from an orbit at rest at 0, and after how many of them it has arrived.
    fn arrives_after(distances: &[f64]) -> Option<usize> {
        let scale = StateScale::from_values(vec![1.0, 1.0]);
        let orbits = StableOrbits(vec![(scale, vec![vec![0.0, 0.0]])]);
        let mut approach = orbits.approached();
        let mut states = distances.iter().map(|distance| [*distance, 0.0]);
        states.position(|state| approach.has_arrived(&orbits, &state))
    }

    #[test]
    fn a_motion_that_contracts_has_arrived_and_one_that_passes_by_has_not() {
        assert_eq!(arrives_after(&[0.5, 0.009, 0.004, 0.002, 0.0008]), Some(4));
        // It leaves again: what it has fallen to counts from where it comes near anew.
        assert_eq!(arrives_after(&[0.009, 0.002, 0.02, 0.002, 0.0008, 0.02]), None);
        assert_eq!(arrives_after(&[0.5, 0.9e-5]), Some(1));
    }
}
