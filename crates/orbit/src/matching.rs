//! Whether two orbits are the same, perhaps started at different excitation periods.
//!
//! An orbit of N excitation periods has N states at any phase, such as 0, any of which may have been stored.
//! Two orbits are the same if a state of one is any of the states of the other; distances are in the energy
//! norm relative to the orbit.

use hammerbeam_motion::{
    Stretch, System,
    exact::{ExactIntegrator, MotionError},
};

use crate::{
    OrbitError, OrbitSettings, PeriodicSolution, Response,
    size::orbit_scale,
    solve::{integrator, nodes_from, orbit_near},
    state_scale::StateScale,
};

/// States of an orbit at a phase (from 0 to 1) of each of its excitation periods, wherever the orbit begins:
/// within contacts, too.
///
/// * `integrator`: of its system.
///
/// # Errors
/// [`MotionError`] if its motion cannot be computed.
pub fn states_at_phase(
    integrator: &mut ExactIntegrator,
    orbit: &PeriodicSolution,
    phase: f64,
) -> Result<Vec<Vec<f64>>, MotionError> {
    let (frequency_hz, start) = (orbit.frequency_hz, orbit.phase);
    if start != phase {
        let (periods, first) = (f64::from(orbit.period_multiple), if phase < start { 1.0 } else { 0.0 });
        let phases: Vec<f64> = (0..orbit.period_multiple).map(|k| phase + first + f64::from(k)).collect();
        let stretch = Stretch { frequency_hz, start, end: start + periods };
        return Ok(integrator.trace(&stretch, &orbit.nodes[0], &phases)?.samples);
    }
    let stretch = Stretch { frequency_hz, start, end: start + 1.0 };
    let mut states = vec![orbit.nodes[0].clone()];
    for k in 1..orbit.period_multiple as usize {
        states.push(integrator.advance(&stretch, &states[k - 1])?);
    }
    Ok(states)
}

/// The mirror image `-z(t + T/2)` of an orbit, T being the excitation period: an orbit of a
/// [symmetric](System::is_symmetric) system, perhaps the same one.
#[must_use]
pub fn mirror_image(orbit: &PeriodicSolution) -> PeriodicSolution {
    let mirrored = |node: &Vec<f64>| node.iter().map(|value| -value).collect();
    let nodes = orbit.nodes.iter().map(mirrored).collect();
    PeriodicSolution { phase: (orbit.phase + 0.5) % 1.0, nodes, ..orbit.clone() }
}

/// Smallest distance of a state from the states of an orbit.
pub(crate) fn distance_in_phase(scale: &StateScale, phases: &[Vec<f64>], state: &[f64]) -> f64 {
    phases.iter().map(|phase| scale.distance(phase, state)).fold(f64::INFINITY, f64::min)
}

/// An orbit that others are compared with.
#[derive(Debug)]
pub struct Matcher<'a> {
    system: &'a System,
    response: &'a Response,
    settings: &'a OrbitSettings,
    orbit: &'a PeriodicSolution,
    scale: StateScale,
    phases: Vec<Vec<f64>>,
}

/// Distance, relative to the orbit, below which two orbits are the same.
const SAME: f64 = 1e-6;
/// Distance of a guess for the orbit at which Newton's method is not even tried,
const FAR: f64 = 0.05;
/// and within which the guess counts if Newton's method fails, as it may beside a fold.
const NEAR: f64 = 1e-4;

impl<'a> Matcher<'a> {
    /// For this orbit.
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if its motion cannot be computed.
    pub fn new(
        system: &'a System,
        response: &'a Response,
        orbit: &'a PeriodicSolution,
        settings: &'a OrbitSettings,
    ) -> Result<Self, OrbitError> {
        let mut integrator = integrator(system, response, settings)?;
        let scale = orbit_scale(&mut integrator, orbit)?;
        let phases = states_at_phase(&mut integrator, orbit, orbit.phase)?;
        Ok(Self { system, response, settings, orbit, scale, phases })
    }

    /// Distance of a state at a phase from the orbit, relative to it; infinite where the motion of the orbit
    /// cannot be computed.
    #[must_use]
    pub fn distance(&self, (phase, state): (f64, &[f64])) -> f64 {
        if phase == self.orbit.phase {
            return distance_in_phase(&self.scale, &self.phases, state);
        }
        let states = integrator(self.system, self.response, self.settings)
            .and_then(|mut integrator| Ok(states_at_phase(&mut integrator, self.orbit, phase)?));
        states.map_or(f64::INFINITY, |states| distance_in_phase(&self.scale, &states, state))
    }

    /// Whether the periodic orbit near a guess, a state at a phase, at the same frequency and with the same
    /// number of periods, is this one.
    #[must_use]
    pub fn is_near(&self, guess: (f64, &[f64])) -> bool {
        let distance = self.distance(guess);
        if distance > FAR {
            return false;
        }
        match self.correct(guess) {
            Ok(found) => self.distance((found.phase, &found.nodes[0])) < SAME.max(1e-3 * distance.min(NEAR)),
            Err(_) => distance < NEAR,
        }
    }

    fn correct(&self, guess: (f64, &[f64])) -> Result<PeriodicSolution, OrbitError> {
        let mut integrator = integrator(self.system, self.response, self.settings)?;
        let orbit = (self.orbit.frequency_hz, self.orbit.period_multiple);
        let nodes = nodes_from(&mut integrator, guess, orbit.0, orbit.1, self.orbit.nodes.len())?;
        Ok(orbit_near(integrator, (guess.0, &nodes), orbit, self.settings)?.0)
    }
}

/// Stretches of `lag` periods, one state for each, that end closest to where they start, the closest first.
pub(crate) fn nearest_returns<'s>(
    states: &'s [Vec<f64>],
    scale: &StateScale,
    lag: usize,
    most: usize,
) -> Vec<&'s [Vec<f64>]> {
    let distance = |k: usize| scale.distance(&states[k + lag], &states[k]);
    let mut returns: Vec<(f64, usize)> =
        (0..states.len().saturating_sub(lag)).map(|k| (distance(k), k)).collect();
    returns.sort_by(|x, y| x.0.total_cmp(&y.0));
    returns.iter().take(most).map(|&(_, k)| &states[k..k + lag]).collect()
}
