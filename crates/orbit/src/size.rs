//! The size of an orbit: by its motion, not by the state with which it happens to start.
//!
//! With `s_j` the states at equally spaced phases of the whole orbit, [`PER_PERIOD`] of them or a few more in
//! each excitation period, nodes included, the size is the root of the mean of `|s_j|^2` in the energy norm
//! (`state_scale.rs`). A structure that rests on its stop at phase 0 has a state there that is thousands of
//! times smaller than its orbit; in units of that state every tolerance would be thousands of times too
//! strict. For a motion of harmonics up to the third the mean equals the mean over the whole motion, so that
//! the size does not depend on the phase at which the orbit starts; else it does by as much as the higher
//! harmonics hold.
//!
//! The motion is gone through once, without sensitivities, from each node to the next.

use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, MotionError},
};

use crate::{
    PeriodicSolution,
    state_scale::{StateScale, state_scale, unit_scale},
};

/// States in each excitation period.
const PER_PERIOD: usize = 8;

/// Least deviation from its mean that an orbit is measured by, relative to its size: tolerances of a motion
/// are relative to that.
const LEAST_DEVIATION: f64 = 1e-2;

/// A motion cut at equal phases: an orbit or a guess of one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cut<'a> {
    /// Phase of the first node [cycles].
    pub phase: f64,
    pub nodes: &'a [Vec<f64>],
    pub frequency_hz: f64,
    pub period_multiple: u32,
}

impl<'a> Cut<'a> {
    /// That of an orbit.
    pub fn of(orbit: &'a PeriodicSolution) -> Self {
        Self {
            phase: orbit.phase,
            nodes: &orbit.nodes,
            frequency_hz: orbit.frequency_hz,
            period_multiple: orbit.period_multiple,
        }
    }

    /// States at equally spaced phases, every node among them.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    fn states(&self, integrator: &mut ExactIntegrator) -> Result<Vec<Vec<f64>>, MotionError> {
        let (periods, segments) = (self.period_multiple as usize, self.nodes.len());
        let parts = (PER_PERIOD * periods).div_ceil(segments);
        let phase = |k: usize| self.phase + (periods * k) as f64 / (segments * parts) as f64;
        let mut states = Vec::with_capacity(segments * parts);
        for (k, node) in self.nodes.iter().enumerate() {
            states.push(node.clone());
            if parts > 1 {
                let inner: Vec<f64> = (1..parts).map(|part| phase(k * parts + part)).collect();
                let (start, end) = (phase(k * parts), inner[parts - 2]);
                let stretch = Stretch { frequency_hz: self.frequency_hz, start, end };
                states.extend(integrator.trace(&stretch, node, &inner)?.samples);
            }
        }
        Ok(states)
    }

    /// Size of the motion in these units.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn size(&self, integrator: &mut ExactIntegrator, scale: &StateScale) -> Result<f64, MotionError> {
        Ok(scale.size_of_motion(&self.states(integrator)?))
    }

    /// Largest magnitude of `shape . q` over the states that the size is made of.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn largest_along(&self, integrator: &mut ExactIntegrator, shape: &[f64]) -> Result<f64, MotionError> {
        let along = |state: &Vec<f64>| shape.iter().zip(state).map(|(s, q)| s * q).sum::<f64>().abs();
        Ok(self.states(integrator)?.iter().map(along).fold(0.0, f64::max))
    }

    /// The units in which the motion has the size one.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn scale(&self, integrator: &mut ExactIntegrator) -> Result<StateScale, MotionError> {
        Ok(self.fitting_scale(integrator)?.0)
    }

    /// [`Cut::scale`], and the size of the motion [kg^1/2 m/s]; without one the scale belongs to one kg^1/2
    /// m/s.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn fitting_scale(&self, integrator: &mut ExactIntegrator) -> Result<(StateScale, f64), MotionError> {
        let mut scale = unit_scale(integrator.system(), self.frequency_hz);
        let size = scale.fit_to(&self.states(integrator)?);
        Ok((scale, size))
    }

    /// Smallest distance of an orbit from itself a part of its periods later that divides them, relative to
    /// its motion about its mean, as the root of the mean of squares over the states of its first excitation
    /// period; infinite for an orbit of one excitation period.
    ///
    /// A sag that a stop carries is part of the size of an orbit, but not of this.
    ///
    /// At a single phase the orbits of a structure that rests there on its stop are all alike.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn distance_to_shorter_period(
        &self,
        integrator: &mut ExactIntegrator,
        scale: &StateScale,
    ) -> Result<f64, MotionError> {
        let multiple = self.period_multiple as usize;
        let divisors: Vec<usize> = (1..multiple).filter(|part| multiple.is_multiple_of(*part)).collect();
        let Some(&largest) = divisors.last() else { return Ok(f64::INFINITY) };
        let (start, count) = (self.phase, PER_PERIOD * (largest + 1));
        let phases: Vec<f64> = (0..count).map(|k| start + k as f64 / PER_PERIOD as f64).collect();
        let stretch = Stretch { frequency_hz: self.frequency_hz, start, end: phases[count - 1] };
        let states = integrator.trace(&stretch, &self.nodes[0], &phases)?.samples;
        let first = &states[..PER_PERIOD];
        let whole = scale.size_of_motion(first).max(1e-3);
        let size = scale.deviation(first).max(LEAST_DEVIATION * whole);
        let distance = |periods: usize| {
            let later = &states[periods * PER_PERIOD..];
            let squares = first.iter().zip(later).map(|(a, b)| scale.distance(a, b).powi(2));
            (squares.sum::<f64>() / PER_PERIOD as f64).sqrt() / size
        };
        Ok(divisors.into_iter().map(distance).fold(f64::INFINITY, f64::min))
    }
}

/// The units in which the motion over the excitation period from a state at phase 0 has the size one. With it
/// the state at the end of that period, unless the motion fails behind the last of the states that give the
/// size. With impact-speed-dependent laws the units follow from the state alone: the integrator keeps impact
/// speeds for one motion only, which has yet to go on.
///
/// # Errors
/// [`MotionError`] if the motion cannot be computed.
pub(crate) fn scale_from(
    integrator: &mut ExactIntegrator,
    state: &[f64],
    frequency_hz: f64,
) -> Result<(StateScale, Option<Vec<f64>>), MotionError> {
    if integrator.system().remembers_impacts() {
        return Ok((state_scale(integrator.system(), state, frequency_hz), None));
    }
    let phases: Vec<f64> = (1..PER_PERIOD).map(|k| k as f64 / PER_PERIOD as f64).collect();
    let Ok(trace) = integrator.trace(&Stretch { frequency_hz, start: 0.0, end: 1.0 }, state, &phases) else {
        let nodes = [state.to_vec()];
        let cut = Cut { phase: 0.0, nodes: &nodes, frequency_hz, period_multiple: 1 };
        return Ok((cut.scale(integrator)?, None));
    };
    let states: Vec<&[f64]> = std::iter::once(state).chain(trace.samples.iter().map(Vec::as_slice)).collect();
    let mut scale = unit_scale(integrator.system(), frequency_hz);
    scale.fit_to(&states);
    Ok((scale, Some(trace.state)))
}

/// The units in which an orbit has the size one.
///
/// # Errors
/// [`MotionError`] if the motion cannot be computed.
pub(crate) fn orbit_scale(
    integrator: &mut ExactIntegrator,
    orbit: &PeriodicSolution,
) -> Result<StateScale, MotionError> {
    Cut::of(orbit).scale(integrator)
}

#[cfg(test)]
mod tests;
