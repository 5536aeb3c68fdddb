//! Motion in time: states at a sampling rate, and every contact from touch to release.
//!
//! The exact integrator computes the motion, one excitation period at a time: closed form in flight, contacts
//! certified, so no contact of the motion is missed between samples, whatever the sampling rate. Parts of a
//! contact that lie in neighbouring periods are joined.

use hammerbeam_motion::{
    Stretch, System,
    exact::{ContactPiece, ExactIntegrator, ExactSettings, Jump, Touchdown},
};

use crate::{AttractorError, error::ensure};

/// Largest number of samples in a period.
const MOST_SAMPLES: usize = 1_000_000;
/// Part of a period within which a contact that ends with a period and one that starts with the next are one.
const SAME_INSTANT: f64 = 1e-12;

/// A state at a time.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Time since observation of the motion started [s].
    pub time: f64,
    /// Phase of the excitation, 0 to 1 [cycles].
    pub phase: f64,
    /// `[q; q']`, length 2n.
    pub state: Vec<f64>,
    /// Forces of the local elements along their relative displacements [N].
    pub forces: Vec<f64>,
}

/// A contact.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactRecord {
    /// Number of the local element.
    pub element: usize,
    /// Number of the contact of its law.
    pub contact: usize,
    /// The touch, with its time since observation started; `None` if the contact was closed then.
    pub begin: Option<Touchdown>,
    /// Of an impact on a rigid stop what it did at the touch; `None` where a force acts over a time.
    pub jump: Option<Jump>,
    /// When it opened [s]; `None` if it was still closed at the end.
    pub end: Option<f64>,
    /// Integral of the magnitude of the force [N s].
    pub impulse: f64,
    /// Largest magnitude of the force [N].
    pub peak_force: f64,
    /// Energy that the structure did not get back [J].
    pub energy_lost: f64,
}

/// Where a motion is at the end of a period: what it needs to go on with the same bits.
///
/// The state and the contacts are not all of it: an impact-speed-dependent law needs the speed at which its
/// contact closed. What sticks to a rigid stop follows from the state.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SimulationCheckpoint {
    /// `[q; q']` at phase 0, length 2n.
    pub state: Vec<f64>,
    /// Periods observed so far.
    pub periods: u64,
    /// Contacts that are closed, as far as they were seen.
    pub open: Vec<ContactRecord>,
    /// The impact speed on which the law of each element depends [m/s], infinite where there is none; empty
    /// if no law of the system depends on one.
    pub impact_speeds: Vec<f64>,
}

/// A motion under way.
#[derive(Debug)]
pub struct Simulation {
    integrator: ExactIntegrator,
    frequency_hz: f64,
    state: Vec<f64>,
    periods: u64,
    /// Contacts that were closed at the end of the last period, by element.
    open: Vec<Option<ContactRecord>>,
}

impl Simulation {
    /// Begins at a state at phase 0.
    ///
    /// # Errors
    /// [`AttractorError::Input`], [`AttractorError::StateLength`], or the damping has no block form.
    pub fn new(
        system: System,
        frequency_hz: f64,
        state: &[f64],
        settings: ExactSettings,
    ) -> Result<Self, AttractorError> {
        let positive = frequency_hz.is_finite() && frequency_hz > 0.0;
        ensure("the frequency", frequency_hz, "finite and more than 0 Hz", positive)?;
        let (found, expected, elements) = (state.len(), 2 * system.dof(), system.elements().len());
        if found != expected {
            return Err(AttractorError::StateLength { found, expected });
        }
        for &entry in state {
            ensure("an entry of the state", entry, "finite", entry.is_finite())?;
        }
        let integrator = ExactIntegrator::new(system, settings)?;
        Ok(Self { integrator, frequency_hz, state: state.to_vec(), periods: 0, open: vec![None; elements] })
    }

    /// Goes on where a motion of the same system, frequency and settings was.
    ///
    /// # Errors
    /// As [`Simulation::new`], or the checkpoint is from a system with other elements.
    pub fn resume(
        system: System,
        frequency_hz: f64,
        checkpoint: SimulationCheckpoint,
        settings: ExactSettings,
    ) -> Result<Self, AttractorError> {
        let SimulationCheckpoint { state, periods, open, impact_speeds } = checkpoint;
        let mut simulation = Self::new(system, frequency_hz, &state, settings)?;
        let elements = simulation.open.len();
        let speeds = impact_speeds.len();
        ensure(
            "remembered impacts",
            speeds as f64,
            "none, or one of each element",
            [0, elements].contains(&speeds),
        )?;
        for record in open {
            let element = record.element;
            ensure("the element of a contact", element as f64, "one of the system", element < elements)?;
            simulation.open[element] = Some(record);
        }
        if !impact_speeds.is_empty() {
            simulation.integrator.set_impact_speeds(0.0, &state, &impact_speeds);
        }
        Ok(Self { periods, ..simulation })
    }

    /// Where the motion is at the end of the last period.
    #[must_use]
    pub fn checkpoint(&self) -> SimulationCheckpoint {
        SimulationCheckpoint {
            state: self.state.clone(),
            periods: self.periods,
            open: self.unfinished(),
            impact_speeds: self.integrator.memory().map_or_else(Vec::new, |memory| memory.impact_speeds()),
        }
    }

    /// The state at the end of the last period.
    #[must_use]
    pub fn state(&self) -> &[f64] {
        &self.state
    }

    /// The system.
    #[must_use]
    pub fn system(&self) -> &System {
        self.integrator.system()
    }

    /// Time observed so far [s].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.periods as f64 / self.frequency_hz
    }

    /// Goes over one period without observing it; time and contacts start anew.
    ///
    /// # Errors
    /// The motion cannot be computed.
    pub fn skip_period(&mut self) -> Result<(), AttractorError> {
        let stretch = self.stretch();
        self.state = self.integrator.advance(&stretch, &self.state)?;
        self.periods = 0;
        self.open.fill(None);
        Ok(())
    }

    /// Goes over one period.
    ///
    /// * `samples`: their number, at equal steps, the first at the start of the period.
    ///
    /// # Returns
    /// The samples, and the contacts that ended in the period, in the order in which they ended.
    /// # Errors
    /// The motion cannot be computed, or more samples are asked for than a million.
    pub fn period(&mut self, samples: usize) -> Result<(Vec<Sample>, Vec<ContactRecord>), AttractorError> {
        ensure("samples per period", samples as f64, "at most a million", samples <= MOST_SAMPLES)?;
        let phases: Vec<f64> = (0..samples).map(|k| k as f64 / samples as f64).collect();
        self.period_at(&phases)
    }

    /// Goes over one period, with the states at these phases [cycles, ascending, from 0 to 1].
    ///
    /// # Errors
    /// The motion cannot be computed.
    pub fn period_at(&mut self, phases: &[f64]) -> Result<(Vec<Sample>, Vec<ContactRecord>), AttractorError> {
        let trace = self.integrator.trace(&self.stretch(), &self.state, phases)?;
        let start = self.time();
        let sample = |((&phase, state), forces)| Sample {
            time: start + phase / self.frequency_hz,
            phase,
            state,
            forces,
        };
        let samples = phases.iter().zip(trace.samples).zip(trace.forces).map(sample).collect();
        let contacts = self.join(trace.contacts, start);
        self.state = trace.state;
        self.periods += 1;
        Ok((samples, contacts))
    }

    /// The contacts that are closed now, as far as they were seen.
    #[must_use]
    pub fn unfinished(&self) -> Vec<ContactRecord> {
        self.open.iter().flatten().cloned().collect()
    }

    fn stretch(&self) -> Stretch {
        Stretch { frequency_hz: self.frequency_hz, start: 0.0, end: 1.0 }
    }

    /// Contacts that ended, from the pieces of a period that began at a time.
    fn join(&mut self, pieces: Vec<ContactPiece>, start: f64) -> Vec<ContactRecord> {
        let mut ended = Vec::new();
        let goes_on = |piece: &ContactPiece| {
            piece.begin.as_ref().is_none_or(|touch| touch.time * self.frequency_hz <= SAME_INSTANT)
        };
        for (element, open) in self.open.iter_mut().enumerate() {
            let first = pieces.iter().find(|piece| piece.element == element);
            if !first.is_some_and(&goes_on)
                && let Some(record) = open.take()
            {
                ended.push(ContactRecord { end: Some(start), ..record });
            }
        }
        for piece in pieces {
            let element = piece.element;
            let begin = piece.begin.map(|touch| Touchdown { time: start + touch.time, ..touch });
            let earlier = self.open[element].take();
            let record = ContactRecord {
                element,
                contact: piece.contact,
                begin: earlier.as_ref().map_or(begin, |record| record.begin.clone()),
                jump: earlier.as_ref().map_or(piece.jump, |record| record.jump.clone()),
                end: piece.end.map(|end| start + end),
                impulse: piece.impulse + earlier.as_ref().map_or(0.0, |record| record.impulse),
                peak_force: piece.peak_force.max(earlier.as_ref().map_or(0.0, |record| record.peak_force)),
                energy_lost: piece.energy_lost + earlier.map_or(0.0, |record| record.energy_lost),
            };
            if record.end.is_some() {
                ended.push(record);
            } else {
                self.open[element] = Some(record);
            }
        }
        ended
    }
}
