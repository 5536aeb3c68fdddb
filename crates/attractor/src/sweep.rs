//! Stepped-sine sweeps with the state carried over, and diagrams from many initial states.
//!
//! At each frequency the motion is let settle, classified (`classify.rs`) and sampled once in every
//! excitation period. In a sweep it starts where it ended at the frequency before, at phase 0, so that it
//! follows a branch as far as that is stable and hysteresis shows. In a diagram it starts at each of several
//! states, the same ones at every frequency: rest, the motion without contacts, and states about it.

use hammerbeam_motion::{
    Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    in_front_of_contacts, start_reach,
};

use crate::{
    AttractorError, Class, Classified, Effort, SystemMap, classify, error::ensure, random::Random,
    section::state_scales,
};

/// Draws of a state of a diagram until a motion can start at it.
const MOST_DRAWS: usize = 1000;

/// What is read off a motion: `shape . q + support_ratios . u`.
#[derive(Debug, Clone, PartialEq)]
pub struct Observable {
    /// Weights of the modal displacements, length n.
    pub shape: Vec<f64>,
    /// Part of the displacement of each support [-].
    pub support_ratios: Vec<f64>,
}

/// How the motions of a sweep are computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweepSettings {
    /// How much is spent on each motion.
    pub effort: Effort,
    /// Periods that are sampled of a motion that does not repeat.
    pub sampled: usize,
    /// Accuracy of the integrator.
    pub motion: ExactSettings,
}

/// What a motion does at a frequency, once it has settled.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepPoint {
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// What it is.
    pub class: Class,
    /// Largest exponent [1/s], if it was needed.
    pub largest_exponent: Option<crate::Estimate>,
    /// K of the 0-1 test, if it was needed.
    pub zero_one: Option<f64>,
    /// Displacement of the observable at phase 0 of each sampled period [m]: as many as the period of a
    /// periodic motion.
    pub samples: Vec<f64>,
    /// Largest absolute displacement of the observable over the sampled periods [m].
    pub max_abs_displacement: f64,
    /// Contacts closed in the sampled periods, over the number of periods.
    pub contacts_per_period: f64,
    /// State at phase 0 at the end, length 2n.
    pub state: Vec<f64>,
}

/// Computes settled motions of one system at one frequency after the other.
#[derive(Debug)]
pub struct Sweeper {
    map: SystemMap,
    watching: ExactIntegrator,
    observable: Observable,
    settings: SweepSettings,
}

impl Sweeper {
    /// For a system and what is observed of it.
    ///
    /// # Errors
    /// The damping has no block form.
    pub fn new(
        system: &System,
        observable: &Observable,
        settings: SweepSettings,
    ) -> Result<Self, AttractorError> {
        let watched = (observable.shape.as_slice(), observable.support_ratios.as_slice());
        let watching = ExactIntegrator::watching(system.clone(), settings.motion, Some(watched))?;
        let map = SystemMap::new(system.clone(), 1.0, 1, settings.motion)?;
        Ok(Self { map, watching, observable: observable.clone(), settings })
    }

    /// The motion to which a motion from this state at phase 0 settles, once the start is checked.
    ///
    /// # Errors
    /// [`AttractorError::BehindRigidStop`], [`AttractorError::WithinContact`], and the errors of
    /// [`Sweeper::at`].
    pub fn begin_at(&mut self, frequency_hz: f64, state: &[f64]) -> Result<SweepPoint, AttractorError> {
        self.map.set_frequency(frequency_hz);
        self.map.check_in_front_of_stops(state)?;
        self.at(frequency_hz, state)
    }

    /// The motion that one from this state at phase 0 settles to.
    ///
    /// # Errors
    /// The motion cannot be computed.
    pub fn at(&mut self, frequency_hz: f64, state: &[f64]) -> Result<SweepPoint, AttractorError> {
        let positive = frequency_hz.is_finite() && frequency_hz > 0.0;
        ensure("the frequency", frequency_hz, "finite and more than 0 Hz", positive)?;
        self.map.set_frequency(frequency_hz);
        let classified = classify(&mut self.map, 1, state, &self.settings.effort)?;
        self.observe(frequency_hz, classified)
    }

    /// Whether a motion can start at a state at phase 0 that this sweeper has not come to itself: in no
    /// contact of an impact-speed-dependent law.
    #[must_use]
    pub fn can_begin(&mut self, state: &[f64]) -> bool {
        let frequency_hz = self.map.frequency_hz();
        !self.map.integrator().system().is_in_remembered_contact(frequency_hz, 0.0, state)
    }

    fn observe(&mut self, frequency_hz: f64, classified: Classified) -> Result<SweepPoint, AttractorError> {
        let periods = match classified.class {
            Class::Periodic { period } => period,
            _ => self.settings.sampled,
        };
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        let mut state = classified.states.last().cloned().unwrap_or_default();
        let system = self.map.integrator().system();
        let carried = system.carried(&self.observable.support_ratios, frequency_hz, 0.0)[0];
        let (mut samples, mut largest, mut touches) = (Vec::with_capacity(periods), 0.0_f64, 0);
        // Of a state within a contact the map knows how that began.
        self.watching.set_memory(self.map.integrator().memory());
        for _ in 0..periods {
            let elastic: f64 = self.observable.shape.iter().zip(&state).map(|(a, b)| a * b).sum();
            samples.push(elastic + carried);
            self.watching.begin_course();
            let next = self.watching.advance(&stretch, &state);
            self.watching.end_course();
            let maxima = self.watching.observe(&[(stretch, &state)])?;
            largest = largest.max(maxima.displacement);
            touches += maxima.contacts();
            state = next?;
        }
        self.map.integrator().set_memory(self.watching.memory());
        Ok(SweepPoint {
            frequency_hz,
            class: classified.class,
            largest_exponent: classified.largest_exponent,
            zero_one: classified.zero_one,
            samples,
            max_abs_displacement: largest,
            contacts_per_period: f64::from(touches) / periods as f64,
            state,
        })
    }

    /// States from which a diagram starts: rest, the motion without contacts, and states about it, always
    /// the same ones; of those about it, none behind a rigid stop or within a contact of an
    /// impact-speed-dependent law: where no draw is in front of all of them, the last one is reflected at
    /// them.
    ///
    /// # Errors
    /// [`AttractorError::Input`]: the frequency makes no sense.
    pub fn starts(&mut self, frequency_hz: f64, count: usize) -> Result<Vec<Vec<f64>>, AttractorError> {
        let positive = frequency_hz.is_finite() && frequency_hz > 0.0;
        ensure("the frequency", frequency_hz, "finite and more than 0 Hz", positive)?;
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        self.map.set_frequency(frequency_hz);
        let steady = self.map.integrator().steady_state(&stretch);
        let scales = state_scales(self.map.integrator().system(), frequency_hz);
        let size = |state: &[f64]| {
            state.iter().zip(&scales).map(|(z, scale)| (z / scale).powi(2)).sum::<f64>().sqrt()
        };
        let size = size(&steady).max(f64::MIN_POSITIVE);
        let mut random = Random::new(1);
        let n = steady.len() / 2;
        let mut states = vec![vec![0.0; 2 * n], steady.clone()];
        while states.len() < count {
            let start = states.len() - 2;
            let reach = start_reach(self.map.integrator().system(), frequency_hz, size, start);
            let about = |i: usize, random: &mut Random| {
                steady[i] + reach * scales[i] * random.signed() / (1 + i % n) as f64
            };
            let mut drawn = || (0..2 * n).map(|i| about(i, &mut random)).collect::<Vec<f64>>();
            let mut state = drawn();
            for _ in 1..MOST_DRAWS {
                if self.map.check_in_front_of_stops(&state).is_ok() {
                    break;
                }
                state = drawn();
            }
            let system = self.map.integrator().system();
            states.push(in_front_of_contacts(system, frequency_hz, 0.0, &state).unwrap_or(state));
        }
        states.truncate(count);
        Ok(states)
    }
}

/// Frequencies from one to another in steps, both ends included; downwards if the first is the higher one.
///
/// # Errors
/// [`AttractorError::Input`]: a number makes no sense, or there are more than a million steps.
pub fn frequencies(from_hz: f64, to_hz: f64, step_hz: f64) -> Result<Vec<f64>, AttractorError> {
    for (what, found) in
        [("the first frequency", from_hz), ("the last frequency", to_hz), ("the step", step_hz)]
    {
        ensure(what, found, "finite and more than 0 Hz", found.is_finite() && found > 0.0)?;
    }
    let span = to_hz - from_hz;
    let steps = (span.abs() / step_hz - 1e-9).ceil().max(0.0);
    ensure("the number of steps", steps, "at most a million", steps <= 1e6)?;
    let at = |k: usize| from_hz + span.signum() * step_hz * k as f64;
    let mut all: Vec<f64> = (0..steps as usize).map(at).collect();
    all.push(to_hz);
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequencies_hold_both_ends_in_both_directions() {
        assert_eq!(frequencies(1.0, 2.0, 0.5).unwrap(), [1.0, 1.5, 2.0]);
        assert_eq!(frequencies(2.0, 1.0, 0.4).unwrap(), [2.0, 1.6, 1.2, 1.0]);
        assert_eq!(frequencies(3.0, 3.0, 0.4).unwrap(), [3.0]);
        assert!(matches!(frequencies(1.0, 2.0, 0.0), Err(AttractorError::Input { what: "the step", .. })));
        assert!(frequencies(1.0, 2e9, 1e-3).is_err());
    }
}
