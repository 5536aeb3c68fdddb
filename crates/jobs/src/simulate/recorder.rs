//! What is written down of a motion, period by period, in chunks that the store takes.

use std::time::{Duration, Instant};

use hammerbeam_attractor::{AttractorError, ContactRecord, Sample, Simulation};
use hammerbeam_motion::PointMotion;
use hammerbeam_results::store::{SimulatedChunk, SimulatedContact, SimulatedTouch, SimulationLayout};
use hammerbeam_study::Model;

/// A chunk goes into the store after this time, which is what a kill loses at most, besides the period under
/// way,
const LONGEST: Duration = Duration::from_millis(500);
/// or when it holds so many numbers, 2 MB; what it holds together with others does not depend on either.
const MOST_NUMBERS: usize = 1 << 18;

/// Writes a motion down.
pub struct Recorder<'a> {
    model: &'a Model,
    layout: &'a SimulationLayout,
    response: PointMotion,
    /// Phases of a period at which the state is wanted: equal steps, and that of the section.
    phases: Vec<f64>,
    /// Index of that of the section,
    section: usize,
    /// and whether it is one of the equal steps.
    shared: bool,
    chunk: SimulatedChunk,
    started: Instant,
}

impl<'a> Recorder<'a> {
    pub fn new(model: &'a Model, layout: &'a SimulationLayout) -> Self {
        let mut phases: Vec<f64> = (0..layout.samples_per_period).map(|k| layout.phase(k)).collect();
        let section = phases.partition_point(|phase| *phase < layout.section_phase);
        let shared = phases.get(section) == Some(&layout.section_phase);
        if !shared {
            phases.insert(section, layout.section_phase);
        }
        let response = model.response_motion(layout.frequency_hz);
        let (chunk, started) = (SimulatedChunk::default(), Instant::now());
        Self { model, layout, response, phases, section, shared, chunk, started }
    }

    /// Goes over a period of the transient, of which nothing is written down.
    pub fn skip(&mut self, simulation: &mut Simulation) -> Result<(), AttractorError> {
        simulation.skip_period()?;
        self.chunk.periods += 1;
        Ok(())
    }

    /// Goes over a period and writes it down.
    pub fn period(&mut self, simulation: &mut Simulation) -> Result<(), AttractorError> {
        let (samples, contacts) = simulation.period_at(&self.phases)?;
        for (index, sample) in samples.iter().enumerate() {
            if index != self.section || self.shared {
                self.sample(sample);
            }
            if index == self.section {
                let [displacement, velocity, _] =
                    self.response.at(sample.phase, &sample.state, &sample.forces);
                self.chunk.section.extend([displacement, velocity]);
                self.chunk.section.extend(&sample.state);
            }
        }
        let contacts = contacts.iter().map(|contact| self.contact(contact));
        self.chunk.contacts.extend(contacts.collect::<Vec<_>>());
        self.chunk.periods += 1;
        Ok(())
    }

    /// Whether the chunk is to go into the store now.
    pub fn is_due(&self) -> bool {
        let SimulatedChunk { samples, section, contacts, .. } = &self.chunk;
        let numbers = samples.len() + section.len() + SimulatedContact::NUMBERS * contacts.len();
        numbers >= MOST_NUMBERS || self.started.elapsed() >= LONGEST
    }

    /// The chunk, if there are periods in it; another one is started.
    pub fn take(&mut self, simulation: &Simulation) -> Option<SimulatedChunk> {
        self.started = Instant::now();
        let chunk = std::mem::take(&mut self.chunk);
        let unfinished = || simulation.unfinished().iter().map(|contact| self.contact(contact)).collect();
        (chunk.periods > 0).then(|| SimulatedChunk {
            unfinished: unfinished(),
            checkpoint: simulation.checkpoint(),
            ..chunk
        })
    }

    fn sample(&mut self, sample: &Sample) {
        let Sample { phase, state, forces, .. } = sample;
        self.chunk.samples.extend(self.response.at(*phase, state, forces));
        for (e, force) in forces.iter().enumerate() {
            let [r, ..] = self.model.system.relative_motion(e, self.layout.frequency_hz, *phase, state);
            self.chunk.samples.extend([r, *force]);
        }
    }

    fn contact(&self, contact: &ContactRecord) -> SimulatedContact {
        let touch = contact.begin.as_ref().map(|touch| {
            let phase = (touch.time * self.layout.frequency_hz).fract();
            let [displacement, velocity, _] = self.response.at(phase, &touch.state, &[]);
            let response = [displacement, velocity];
            SimulatedTouch { time_s: touch.time, phase, speed: touch.velocity.abs(), response }
        });
        SimulatedContact {
            element: contact.element,
            touch,
            end_s: contact.end,
            impulse: contact.impulse,
            peak_force: contact.peak_force,
            energy_lost: contact.energy_lost,
        }
    }
}
