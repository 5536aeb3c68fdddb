//! What this room needs of a motion: the state, and the fundamental matrix, over one section.
//! Equation (E1) of the book, `docs/theory`.
//!
//! A section is a stretch of the motion that always has the same duration: a part of the excitation period of
//! a [`System`], of the period or of the time of a vector field, or one step of a map. Sections are counted,
//! so that a motion that depends on time knows its phase. A fundamental matrix may be asked for over a part
//! of a section ([`Part`]): over all of it one direction may grow so much more than another that this one is
//! lost in rounding.

use faer::Mat;
use hammerbeam_motion::{
    Stretch, System,
    exact::{ContactMemory, ExactIntegrator, ExactSettings},
    general::{GeneralSettings, VectorField, integrate},
    law::RigidStop,
};

use crate::{AttractorError, Part};

/// How far behind a rigid stop a state counts as on it, relative to the displacement there.
const ON_THE_STOP: f64 = 1e-9;

/// Periods over which a motion that does not repeat is looked at for a contact that stays closed.
pub const WATCHED_PERIODS: usize = 64;

/// Sections of motions in time can be halved so often.
const MOST_HALVINGS: u32 = 12;

/// A motion that is advanced section by section.
pub trait SectionMap {
    /// Length of a state.
    fn dimension(&self) -> usize;

    /// Duration of a section, in the unit of time in which exponents are wanted.
    fn duration(&self) -> f64;

    /// Sizes of the entries of a state against one another: distances and tangent vectors are measured in
    /// them, length as the state.
    fn scales(&self) -> Vec<f64> {
        vec![1.0; self.dimension()]
    }

    /// State after the section of that number.
    ///
    /// # Errors
    /// The motion cannot be computed.
    fn advance(&mut self, section: u64, state: &[f64]) -> Result<Vec<f64>, AttractorError>;

    /// State after a part of a section, and its derivative by the state before it.
    ///
    /// # Errors
    /// The motion cannot be computed.
    fn flow(&mut self, part: Part, state: &[f64]) -> Result<(Vec<f64>, Mat<f64>), AttractorError>;

    /// How often a section can be halved.
    fn most_halvings(&self) -> u32 {
        0
    }

    /// Takes the last [`SectionMap::flow`] back, where the map holds more than the state says.
    fn take_back(&mut self) {}

    /// Refuses a settled motion in which a contact of an impact-speed-dependent law stays closed.
    ///
    /// * `state`: that to which the motion has come last, at phase 0; `periods`: excitation periods that are
    ///   looked at.
    ///
    /// # Errors
    /// [`AttractorError::NeverOpens`], or the motion cannot be computed.
    fn check_opens(&mut self, _state: &[f64], _periods: usize) -> Result<(), AttractorError> {
        Ok(())
    }

    /// How many directions the last [`SectionMap::flow`] has lost for good.
    fn directions_lost(&self) -> usize {
        0
    }

    /// What `ln |det P|` of the last [`SectionMap::flow`] has to be, where that is known otherwise; minus
    /// infinity where the motion lost directions for good.
    fn growth_of_volume(&self) -> Option<f64> {
        None
    }
}

/// A system at one excitation frequency, by the exact integrator; a section is a whole part of the excitation
/// period.
#[derive(Debug)]
pub struct SystemMap {
    integrator: ExactIntegrator,
    frequency_hz: f64,
    parts: u64,
    /// What the integrator kept of its contacts before the last flow.
    memory_before: Option<ContactMemory>,
    /// Of the last flow.
    growth_of_volume: Option<f64>,
}

impl SystemMap {
    /// For a system at a frequency, with so many sections in an excitation period.
    ///
    /// # Errors
    /// [`AttractorError::Input`], or the damping has no block form.
    pub fn new(
        system: System,
        frequency_hz: f64,
        parts: u64,
        settings: ExactSettings,
    ) -> Result<Self, AttractorError> {
        let positive = frequency_hz.is_finite() && frequency_hz > 0.0;
        crate::error::ensure("the frequency", frequency_hz, "finite and more than 0 Hz", positive)?;
        crate::error::ensure(
            "the number of sections",
            parts as f64,
            "1 to 1024",
            (1..=1024).contains(&parts),
        )?;
        let integrator = ExactIntegrator::new(system, settings)?;
        Ok(Self { integrator, frequency_hz, parts, memory_before: None, growth_of_volume: None })
    }

    /// The integrator, for what is not advanced in sections.
    pub fn integrator(&mut self) -> &mut ExactIntegrator {
        &mut self.integrator
    }

    /// Excitation frequency [Hz].
    #[must_use]
    pub fn frequency_hz(&self) -> f64 {
        self.frequency_hz
    }

    /// Goes to another frequency; states stay what they are.
    pub fn set_frequency(&mut self, frequency_hz: f64) {
        self.frequency_hz = frequency_hz;
    }

    /// Sections in an excitation period.
    #[must_use]
    pub fn parts(&self) -> u64 {
        self.parts
    }

    /// Cuts the period into another number of sections.
    pub fn set_parts(&mut self, parts: u64) {
        self.parts = parts.clamp(1, 1024);
    }

    /// `-tr(M^-1 C)` [1/s]: the sum of all exponents, while no contact loses energy.
    #[must_use]
    pub fn divergence(&self) -> f64 {
        let damping = &self.integrator.system().model().damping;
        -(0..damping.nrows()).map(|i| damping[(i, i)]).sum::<f64>()
    }

    /// Refuses a state at phase 0 that lies behind a rigid stop, where no motion comes, or in a contact of
    /// an impact-speed-dependent law.
    ///
    /// # Errors
    /// [`AttractorError::BehindRigidStop`], [`AttractorError::WithinContact`], of the first such stop.
    pub fn check_in_front_of_stops(&self, state: &[f64]) -> Result<(), AttractorError> {
        let system = self.integrator.system();
        for (number, element) in system.elements().iter().enumerate() {
            let Some(depth) = system.depth_in_contact(number, self.frequency_hz, 0.0, state) else {
                continue;
            };
            let stop = || element.name.clone();
            if element.law.remembers_impact() && depth > 0.0 {
                return Err(AttractorError::WithinContact { stop: stop(), depth });
            }
            let Some(level) = element.law.rigid().map(RigidStop::level) else { continue };
            // A state on the stop may have come from a motion, with its rounding.
            if depth > ON_THE_STOP * (depth + level).abs().max(level.abs()) {
                return Err(AttractorError::BehindRigidStop { stop: stop(), depth });
            }
        }
        Ok(())
    }

    /// The first element whose law depends on the impact speed and whose contact stays closed over these
    /// periods: the state lies within it after each of them, and nothing has touched it.
    fn stays_closed(&mut self, state: &[f64], periods: usize) -> Result<Option<usize>, AttractorError> {
        let period = Stretch { frequency_hz: self.frequency_hz, start: 0.0, end: 1.0 };
        let mut closed = self.remembered_contacts(state);
        let mut state = state.to_vec();
        for _ in 0..periods {
            if closed.is_empty() {
                return Ok(None);
            }
            state = self.integrator.advance(&period, &state)?;
            let inside = self.remembered_contacts(&state);
            let touches = self.integrator.touches();
            closed.retain(|(element, contact)| {
                inside.contains(&(*element, *contact)) && touches[*contact] == 0
            });
        }
        Ok(closed.first().map(|(element, _)| *element))
    }

    /// Elements within a contact of an impact-speed-dependent law, and the numbers of these contacts among
    /// the contacts of all elements.
    fn remembered_contacts(&self, state: &[f64]) -> Vec<(usize, usize)> {
        let (system, mut first) = (self.integrator.system(), 0);
        let mut within = Vec::new();
        for (number, element) in system.elements().iter().enumerate() {
            let depth = || system.depth_in_contact(number, self.frequency_hz, 0.0, state);
            if element.law.remembers_impact() && depth().is_some_and(|depth| depth > 0.0) {
                within.push((number, first));
            }
            first += element.law.contacts().len();
        }
        within
    }

    fn stretch(&self, part: Part) -> Stretch {
        let ((start, end), parts) = (part.ends(self.parts), self.parts as f64);
        Stretch { frequency_hz: self.frequency_hz, start: start / parts, end: end / parts }
    }
}

/// Sizes of modal states: velocities 1, displacements one over the eigenfrequency or, for slower modes, over
/// the excitation.
#[must_use]
pub fn state_scales(system: &System, frequency_hz: f64) -> Vec<f64> {
    let reference = std::f64::consts::TAU * frequency_hz;
    let rates = system.model().natural_frequencies.iter().map(|w| w.max(reference));
    rates.map(f64::recip).chain(vec![1.0; system.dof()]).collect()
}

impl SectionMap for SystemMap {
    fn dimension(&self) -> usize {
        2 * self.integrator.system().dof()
    }

    fn duration(&self) -> f64 {
        1.0 / (self.frequency_hz * self.parts as f64)
    }

    fn scales(&self) -> Vec<f64> {
        state_scales(self.integrator.system(), self.frequency_hz)
    }

    fn advance(&mut self, section: u64, state: &[f64]) -> Result<Vec<f64>, AttractorError> {
        Ok(self.integrator.advance(&self.stretch(Part::whole(section)), state)?)
    }

    fn flow(&mut self, part: Part, state: &[f64]) -> Result<(Vec<f64>, Mat<f64>), AttractorError> {
        self.memory_before = self.integrator.memory();
        let flow = self.integrator.flow_onwards(&self.stretch(part), state)?;
        let of_damping = self.divergence() * self.duration() * part.share();
        self.growth_of_volume =
            Some(of_damping + self.integrator.contraction()).filter(|growth| !growth.is_nan());
        Ok((flow.state, flow.by_state))
    }

    fn most_halvings(&self) -> u32 {
        MOST_HALVINGS
    }

    fn take_back(&mut self) {
        self.integrator.set_memory(self.memory_before.clone());
    }

    fn check_opens(&mut self, state: &[f64], periods: usize) -> Result<(), AttractorError> {
        if !self.integrator.system().remembers_impacts() {
            return Ok(());
        }
        let memory = self.integrator.memory();
        let stays = self.stays_closed(state, periods);
        self.integrator.set_memory(memory);
        stays?.map_or(Ok(()), |element| {
            let element = self.integrator.system().elements()[element].name.clone();
            Err(AttractorError::NeverOpens { element })
        })
    }

    fn directions_lost(&self) -> usize {
        self.integrator.directions_lost()
    }

    /// `-tr(M^-1 C)` times the duration, and what contacts contribute; not known where an
    /// impact-speed-dependent law takes nearly all speed out of an impact.
    fn growth_of_volume(&self) -> Option<f64> {
        self.growth_of_volume
    }
}

/// Any vector field, by the general integrator.
#[derive(Debug)]
pub struct FieldMap<F> {
    field: F,
    duration: f64,
    parts: u64,
    settings: GeneralSettings,
}

impl<F: VectorField> FieldMap<F> {
    /// * `duration`: of a section, in the unit of the field's time.
    /// * `parts`: sections after which the time of the field starts anew: the sections of a period; 1 where
    ///   the field does not depend on time.
    ///
    /// # Errors
    /// [`AttractorError::Input`].
    pub fn new(
        field: F,
        duration: f64,
        parts: u64,
        settings: GeneralSettings,
    ) -> Result<Self, AttractorError> {
        let positive = duration.is_finite() && duration > 0.0;
        crate::error::ensure("the duration of a section", duration, "finite and more than 0", positive)?;
        Ok(Self { field, duration, parts: parts.max(1), settings })
    }

    fn run(
        &mut self,
        part: Part,
        state: &[f64],
        sensitivities: bool,
    ) -> Result<(Vec<f64>, Mat<f64>), AttractorError> {
        let (start, end) = part.ends(self.parts);
        let settings = GeneralSettings { sensitivities, ..self.settings };
        let flow = integrate(&mut self.field, start * self.duration, end * self.duration, state, &settings)?;
        Ok((flow.state, flow.by_state))
    }
}

impl<F: VectorField> SectionMap for FieldMap<F> {
    fn dimension(&self) -> usize {
        self.field.dimension()
    }

    fn duration(&self) -> f64 {
        self.duration
    }

    fn advance(&mut self, section: u64, state: &[f64]) -> Result<Vec<f64>, AttractorError> {
        Ok(self.run(Part::whole(section), state, false)?.0)
    }

    fn flow(&mut self, part: Part, state: &[f64]) -> Result<(Vec<f64>, Mat<f64>), AttractorError> {
        self.run(part, state, true)
    }

    fn most_halvings(&self) -> u32 {
        MOST_HALVINGS
    }
}

/// A map with its derivative; a section is one step, of duration 1.
#[derive(Debug)]
pub struct StepMap<M> {
    map: M,
    dimension: usize,
}

impl<M: FnMut(&[f64]) -> (Vec<f64>, Mat<f64>)> StepMap<M> {
    /// * `map`: gives the next state and its derivative by this one, `dimension` x `dimension`.
    pub fn new(dimension: usize, map: M) -> Self {
        Self { map, dimension }
    }
}

impl<M: FnMut(&[f64]) -> (Vec<f64>, Mat<f64>)> SectionMap for StepMap<M> {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn duration(&self) -> f64 {
        1.0
    }

    fn advance(&mut self, _: u64, state: &[f64]) -> Result<Vec<f64>, AttractorError> {
        Ok((self.map)(state).0)
    }

    fn flow(&mut self, _: Part, state: &[f64]) -> Result<(Vec<f64>, Mat<f64>), AttractorError> {
        Ok((self.map)(state))
    }
}
