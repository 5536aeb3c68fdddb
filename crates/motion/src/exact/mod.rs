//! The exact integrator: closed-form flight, certified contacts, collocated contact forces, exact
//! sensitivities.
//!
//! The mathematics stands in the crate docs; here is who does what:
//!
//! * `flow.rs`, `run.rs`, `standstill.rs`, `error.rs`: a run over a stretch; whether it gets on; why it does
//!   not.
//! * `block.rs`, `propagator.rs`, `decouple.rs`, `plane.rs`: the structure as independent second-order
//!   blocks.
//! * `drive.rs`, `drive_values.rs`, `drive_bounds.rs`: the particular solution of the load.
//! * `secular.rs`, `matrix_exponential.rs`: loads without a steady response.
//! * `majorant.rs`: what bounds all derivatives of the part of a load.
//! * `output.rs`: rows that read displacements, and bounds on them.
//! * `clearance.rs`, `flight.rs`: certified search for the next contact.
//! * `collocation.rs`, `recurrence.rs`: the nodes of a step and its constants.
//! * `weights.rs`, `series.rs`, `moments.rs`, `quadrature.rs`: the matrices of a step.
//! * `force_step.rs`, `newton.rs`, `attempt.rs`, `step_error.rs`: one step with forces, and its error.
//! * `coinciding.rs`: elements that read one displacement, an unknown for all of them.
//! * `damped_step.rs`, `onset.rs`: forces that depend on the velocity; sensitivities where they set in with a
//!   jump.
//! * `rounding.rs`: what rounding leaves unknown of the sensitivities behind hard contacts.
//! * `memory.rs`, `volume.rs`: laws that remember the speed of an impact; what contacts do to volumes of
//!   states.
//! * `impact.rs`, `velocity_jump.rs`, `stick.rs`: impacts on rigid stops, the forces that jump with them;
//!   chatter, stops that stick and lift.
//! * `held.rs`, `hold.rs`, `structure.rs`: the structure that is left while rigid stops are held; going over
//!   to it and back.
//! * `hole.rs`: round holes, whose force turns with the displacement.
//! * `pressing.rs`: what held stops press with, also while forces act, and where that ends.
//! * `lu.rs`, `lanes.rs`, `elementary.rs`: small dense equations, loops on vectors, sines and exponentials on
//!   them.
//! * `contact_phase.rs`, `aim.rs`, `event.rs`, `hidden_turn.rs`: steps from touch to release, with error
//!   control; two events at once; turns in front of the first node or behind the last, and corners beyond the
//!   ends.
//! * `brief_opening.rs`: contacts that open for an instant between two presses.
//! * `touches.rs`: what of the touches of a stretch counts in an orbit.
//! * `kink.rs`: kinks of the force of a closed contact.
//! * `touching.rs`, `force_bound.rs`: certified search for further contacts while forces act.
//! * `enclosure.rs`: proof that closed contacts stay closed all through a step.
//! * `forecast.rs`, `polynomial.rs`: how long a contact will last; where a polynomial falls below zero.
//! * `sensitivity.rs`: the fundamental matrix and the frequency column.
//! * `by_parameter.rs`; `by_damping.rs`, `change.rs`; `by_family.rs`: the column of a parameter; of the
//!   damping, which is in every matrix; of a number that the modes depend on.
//! * `course.rs`: what a motion went through.
//! * `given_up.rs`: why no force step was good enough.
//! * `near_miss.rs`: least clearance of flights, least speed of touches, least penetration between two
//!   presses: what vanishes at grazing.
//! * `maxima.rs`, `flight_maximum.rs`, `step_maximum.rs`, `step_waves.rs`, `extremum.rs`, `parabola.rs`,
//!   `sampling.rs`, `defect.rs`: maxima on the continuous motion, reading inside a step, and what its
//!   polynomials leave of a force there.
//! * `trace.rs`: states at given phases, and every contact with its impulse and the energy it took.
//! * `tracing.rs`: what each piece of motion adds to that.
//! * `panels.rs`: a motion in smooth panels, for integrals over it and its extrema.

mod aim;
mod attempt;
mod block;
mod brief_opening;
mod by_damping;
mod by_family;
mod by_parameter;
mod change;
mod clearance;
mod coinciding;
mod collocation;
mod contact_phase;
mod course;
mod damped_step;
mod decouple;
mod defect;
mod drive;
mod drive_bounds;
mod drive_values;
mod elementary;
mod enclosure;
mod error;
mod event;
mod extremum;
mod flight;
mod flight_maximum;
mod flow;
mod force_bound;
mod force_step;
mod forecast;
mod given_up;
mod held;
mod hidden_turn;
mod hold;
mod hole;
mod impact;
mod kink;
mod lanes;
mod lu;
mod majorant;
mod matrix_exponential;
mod maxima;
mod memory;
mod moments;
mod near_miss;
mod newton;
mod onset;
mod output;
mod panels;
mod parabola;
mod plane;
mod polynomial;
mod pressing;
mod propagator;
mod quadrature;
mod recurrence;
mod rounding;
mod run;
mod sampling;
mod secular;
mod sensitivity;
mod series;
mod standstill;
mod step_error;
mod step_length;
mod step_maximum;
mod step_waves;
mod stick;
mod structure;
mod touches;
mod touching;
mod trace;
mod tracing;
mod valley;
mod velocity_jump;
mod volume;
mod weights;

#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use decouple::MergedModes;
pub use error::MotionError;
pub use maxima::Maxima;
pub use memory::ContactMemory;
pub use near_miss::NearMisses;
pub use panels::{MotionPanel, PANEL_NODES, panel_rule};
pub use touches::{AtEnd, complete_touches, touches_lacking};
pub use trace::{ContactPiece, Inside, Jump, PanelledMotion, Touchdown, Trace};

use block::Blocks;
use course::Course;
use drive::Drive;
use force_step::ForceStep;
use output::Output;
use propagator::Propagator;
use run::Run;
use series::Series;
use structure::{KeptWeights, Structure};
use weights::StepWeights;

use crate::{Law, Parameter, Stretch, System};

/// Most force steps in an excitation period: hundreds are many.
const MOST_STEPS: u64 = 20_000;

/// Settings of the exact integrator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExactSettings {
    /// Bound on the error of each force step, relative to the scales of the stretch; see `step_error.rs` for
    /// the formula.
    pub tolerance: f64,
}

impl Default for ExactSettings {
    fn default() -> Self {
        Self { tolerance: 1e-11 }
    }
}

/// Work done since the integrator was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ExactCounts {
    /// Stretches advanced.
    pub stretches: u64,
    /// Looks at the clearances in free flight.
    pub looks: u64,
    /// Force steps accepted.
    pub steps: u64,
    /// Force steps solved, accepted or not.
    pub solves: u64,
    /// Multiplications of all that, to some factor: for limits on work, which must not depend on the machine.
    pub operations: u64,
}

/// Integrates a [`System`] exactly in flight and to a set tolerance in contact.
#[derive(Debug)]
pub struct ExactIntegrator {
    system: System,
    settings: ExactSettings,
    blocks: Blocks,
    laws: Vec<Law>,
    /// Relative displacements of the elements, then further outputs; see `structure.rs`.
    outputs: Vec<Output>,
    inputs: Vec<Vec<f64>>,
    series: Series,
    /// `C A B`, `[output][element]`.
    mobility: Vec<Vec<f64>>,
    /// Rate of each block, `sqrt(k) + c` [1/s].
    rates: Vec<f64>,
    /// Part of each block in the mobility of each element, `[e][i]`.
    shares: Vec<Vec<f64>>,
    /// Of each element, for the proof that its contact stays closed.
    in_common: Vec<enclosure::InCommon>,
    has_contacts: bool,
    has_rigid_stops: bool,
    counts: ExactCounts,
    drive: Drive,
    run: Run,
    step: ForceStep,
    kept_weights: KeptWeights,
    /// Place of the matrices of steps within the reach, while kept ones are in use.
    own_weights: Arc<StepWeights>,
    flight_start: Vec<f64>,
    propagators: Vec<Propagator>,
    touches: Vec<u32>,
    /// See [`ExactIntegrator::at_ends`].
    at_ends: [Vec<AtEnd>; 2],
    /// Whether what happens is noted.
    notes_course: bool,
    course: Course,
    tracing: Option<trace::Tracing>,
    /// Force steps in a stretch, at most; `None` for [`MOST_STEPS`] in each period.
    most_steps: Option<u64>,
    closed_throughout: u64,
    response: Option<(Vec<f64>, Vec<f64>)>,
    parameter: Option<Parameter>,
    by_damping: Option<Box<by_damping::ByDamping>>,
    by_family: Option<Box<by_family::ByFamily>>,
    memory: Option<ContactMemory>,
    /// Whether flows go on within contacts from the stretch before.
    goes_on: bool,
    /// The present stretch.
    stretch: Stretch,
    /// The held structure in use, and others that were.
    holding: Option<Box<hold::Holding>>,
    known_held: Vec<held::Held>,
    contraction: f64,
    rounding: f64,
    cuts_for_volume: u32,
    /// Directions that neighbours lost in the last stretch, at one instant at most.
    directions_lost: usize,
}

impl ExactIntegrator {
    /// An integrator for `system`.
    ///
    /// # Errors
    /// [`MotionError::MergedModes`] if the damping has no block form.
    pub fn new(system: System, settings: ExactSettings) -> Result<Self, MotionError> {
        Self::watching(system, settings, None)
    }

    /// An integrator that can also observe a response point, whose displacement is `shape . q +
    /// support_ratios . u`.
    ///
    /// # Errors
    /// [`MotionError::MergedModes`] if the damping has no block form.
    pub fn watching(
        system: System,
        settings: ExactSettings,
        response: Option<(&[f64], &[f64])>,
    ) -> Result<Self, MotionError> {
        let blocks = Blocks::new(system.model())?;
        let elements = system.elements().iter().map(|e| (e.shape.as_slice(), e.support_ratios.as_slice()));
        let outputs: Vec<Output> =
            elements.chain(response).map(|(shape, ratios)| Output::new(&blocks, shape, ratios)).collect();
        let inputs: Vec<Vec<f64>> = system.elements().iter().map(|e| blocks.input(&e.shape)).collect();
        let laws: Vec<Law> = system.elements().iter().map(|e| e.law.clone()).collect();
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 0.0 };
        let drive = Drive::new(&system, &blocks, &outputs, &stretch);
        let structure = Structure::new(blocks, outputs, inputs, drive);
        let Structure { blocks, outputs, inputs, series, mobility, rates, .. } = structure;
        let Structure { shares, in_common, kept_weights, drive, .. } = structure;
        Ok(Self {
            drive,
            series,
            has_rigid_stops: laws.iter().any(|law| law.rigid().is_some()),
            has_contacts: laws.iter().any(|law| !law.contacts().is_empty()),
            touches: vec![0; laws.iter().map(|law| law.contacts().len()).sum()],
            at_ends: [Vec::new(), Vec::new()],
            system,
            settings,
            rates,
            shares,
            in_common,
            blocks,
            laws,
            outputs,
            inputs,
            mobility,
            counts: ExactCounts::default(),
            run: Run::default(),
            step: ForceStep::default(),
            kept_weights,
            own_weights: Arc::default(),
            flight_start: Vec::new(),
            propagators: Vec::new(),
            notes_course: false,
            course: Course::default(),
            tracing: None,
            most_steps: None,
            closed_throughout: 0,
            response: response.map(|(shape, ratios)| (shape.to_vec(), ratios.to_vec())),
            parameter: None,
            by_damping: None,
            by_family: None,
            memory: None,
            goes_on: false,
            stretch,
            holding: None,
            known_held: Vec::new(),
            contraction: 0.0,
            rounding: 0.0,
            cuts_for_volume: 0,
            directions_lost: 0,
        })
    }

    /// An integrator for another system, with the settings of this one.
    ///
    /// # Errors
    /// [`MotionError::MergedModes`] if the damping has no block form.
    pub fn for_system(&self, system: System) -> Result<Self, MotionError> {
        Self::new(system, self.settings)
    }

    /// The system.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The settings.
    #[must_use]
    pub fn settings(&self) -> ExactSettings {
        self.settings
    }

    /// Has the motion over a stretch end with [`MotionError::TooManySteps`] after so many force steps, or
    /// after the usual number, 20 000 in each period, if that is less; without a number after the usual one.
    pub fn limit_steps(&mut self, most: Option<u64>) {
        self.most_steps = most;
    }

    /// Work done so far.
    #[must_use]
    pub fn counts(&self) -> ExactCounts {
        self.counts
    }

    /// How often each contact closed in the last stretch, in the order of elements and their contacts. A
    /// chatter that came to its end on a rigid stop counts 65536 besides its impacts, whose number says
    /// nothing then, see [`complete_touches`].
    #[must_use]
    pub fn touches(&self) -> &[u32] {
        &self.touches
    }

    /// Each contact at the start and at the end of the last stretch, in the order of
    /// [`touches`](Self::touches).
    #[must_use]
    pub fn at_ends(&self) -> [&[AtEnd]; 2] {
        self.at_ends.each_ref().map(Vec::as_slice)
    }

    /// By how much the contacts changed the logarithm of volumes of states in the last stretch: `2 ln e` for
    /// each impact on a rigid stop, minus infinity where one stuck, and, of a flow with sensitivities, the
    /// integral of the divergence `phi^T phi df/dr'` of forces that depend on the velocity. What the memory
    /// of an impact does besides is counted by [`ExactIntegrator::flow_onwards`] alone; not a number where
    /// that cannot be told (mathematics in `volume.rs`).
    #[must_use]
    pub fn contraction(&self) -> f64 {
        self.contraction
    }

    /// What rounding of the penetration of hard contacts leaves unknown of the change of velocities by
    /// displacements in these contacts, over the last stretch, of a flow with sensitivities [1/s]
    /// (mathematics in `rounding.rs`).
    #[must_use]
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// By how much the rank of the sensitivities of the last stretch is less than that of the state: two for
    /// each rigid stop that held the structure, and one for an impact without restitution that does not
    /// stick, at the instant at which they are most.
    #[must_use]
    pub fn directions_lost(&self) -> usize {
        self.directions_lost
    }

    /// Elements that were closed all through the last stretch, with or without pressure, one bit each (the
    /// first 64).
    #[must_use]
    pub fn closed_throughout(&self) -> u64 {
        self.closed_throughout
    }
}
