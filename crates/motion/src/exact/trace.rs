//! A motion written down: its states at given phases, and each of its contacts.
//!
//! In flight a state is that of the closed form; inside a step with forces it is carried there from the start of the step, forces included
//! (`sampling.rs`). Of a contact force `F(t)` that acts along the relative displacement `r` are noted
//!
//! `impulse = int F dt`, `energy lost = - int F r' dt`
//!
//! by Gauss' rule on the nodes of the steps, where `F` and `r` obey the law and `r'` follows from the convolution with the modes. The energy lost by a
//! law that depends on the displacement alone is zero over a whole contact; what comes out is the error of the steps. The largest force is that
//! of its polynomial, which is good to about 1e-5; maxima that are better are those of `maxima.rs`.

use super::{
    ExactIntegrator, MotionError, collocation::NODES, flight::Touch, flight_maximum::Flown, run::Run,
};
use crate::Stretch;

/// Begin of a contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Touchdown {
    /// Time since the start of the stretch [s].
    pub time: f64,
    /// `r'` of the element as the contact closes [m/s].
    pub velocity: f64,
    /// Modal state `[q; q']` then, length 2n.
    pub state: Vec<f64>,
}

/// What an impact on a rigid stop does at once.
#[derive(Debug, Clone, PartialEq)]
pub struct Jump {
    /// Magnitude of the impulse [N s].
    pub impulse: f64,
    /// Modal state `[q; q']` right after it, length 2n.
    pub state: Vec<f64>,
}

/// A contact, or the part of it that lies within a stretch.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactPiece {
    /// Number of the local element.
    pub element: usize,
    /// Number of the contact of its law.
    pub contact: usize,
    /// Where it closed; `None` if it was closed at the start of the stretch.
    pub begin: Option<Touchdown>,
    /// Of an impact on a rigid stop what it did then; `None` where a force acts over a time.
    pub jump: Option<Jump>,
    /// When it opened, since the start of the stretch [s]; `None` if it is closed at the end of the stretch.
    pub end: Option<f64>,
    /// Integral of the magnitude of the force [N s].
    pub impulse: f64,
    /// Largest magnitude of the force [N]; of an impact on a rigid stop 0, of one that sticks that of the pressing force after it.
    pub peak_force: f64,
    /// Energy that the structure gave to the contact and did not get back [J].
    pub energy_lost: f64,
}

/// What was written down of a motion.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trace {
    /// State at the end of the stretch, bit by bit that of [`ExactIntegrator::advance`].
    pub state: Vec<f64>,
    /// Modal states at the phases asked for.
    pub samples: Vec<Vec<f64>>,
    /// Forces of the elements along their relative displacements at these phases [N].
    pub forces: Vec<Vec<f64>>,
    /// Contacts in the order in which they closed.
    pub contacts: Vec<ContactPiece>,
}

/// What is being written down.
#[derive(Debug, Clone, Default)]
pub(super) struct Tracing {
    /// Times since the start of the stretch at which the state is wanted, ascending [s].
    times: Vec<f64>,
    trace: Trace,
    /// Index of the open piece of each element.
    open: Vec<Option<usize>>,
}

impl Tracing {
    fn due(&self, before: f64) -> Option<f64> {
        self.times.get(self.trace.samples.len()).copied().filter(|time| *time < before)
    }

    /// Ends the pieces of elements without force. Those that have parted before their penetration has ended may go on.
    fn end_open(&mut self, run: &Run) {
        for (element, open) in self.open.iter_mut().enumerate() {
            let Some(piece) = *open else { continue };
            let contact = &mut self.trace.contacts[piece];
            if run.closed[element].is_some() || run.stuck.contains(&element) {
                contact.end = None;
                continue;
            }
            contact.end.get_or_insert(run.time);
            if run.parted[element].is_none() {
                *open = None;
            }
        }
    }

    fn begin(&mut self, element: usize, contact: usize, begin: Option<Touchdown>) {
        self.open[element] = Some(self.trace.contacts.len());
        self.trace.contacts.push(ContactPiece {
            element,
            contact,
            begin,
            jump: None,
            end: None,
            impulse: 0.0,
            peak_force: 0.0,
            energy_lost: 0.0,
        });
    }
}

impl ExactIntegrator {
    /// A motion over a stretch from `state`, with its states at `phases` [cycles, ascending, within the stretch] and its contacts.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn trace(&mut self, stretch: &Stretch, state: &[f64], phases: &[f64]) -> Result<Trace, MotionError> {
        let times = phases.iter().map(|phase| (phase - stretch.start) / stretch.frequency_hz).collect();
        let mut tracing = Tracing { times, trace: Trace::default(), open: vec![None; self.laws.len()] };
        let mut run = self.begin(stretch, state, false)?;
        for element in 0..self.laws.len() {
            if let Some(contact) = run.closed[element] {
                tracing.begin(element, contact, None);
            } else if run.stuck.contains(&element) {
                tracing.begin(element, 0, None);
            }
        }
        self.tracing = Some(tracing);
        let result = self.complete(&mut run, stretch);
        let mut tracing = self.tracing.take().unwrap_or_default();
        tracing.end_open(&run);
        let end = self.modal_state(&run, stretch.duration());
        self.remember_end(stretch, &end);
        // Samples at the very end, or within rounding of it.
        while tracing.trace.samples.len() < tracing.times.len() {
            tracing.trace.samples.push(end.clone());
            tracing.trace.forces.push(self.forces_of(&run, &run.state, stretch.duration()));
        }
        self.let_go();
        self.run = run;
        result.map(|()| Trace { state: end, ..tracing.trace })
    }

    /// Writes down a flight of that duration from the state at its start.
    pub(super) fn trace_flight(&mut self, run: &Run, duration: f64) {
        let Some(mut tracing) = self.tracing.take() else { return };
        tracing.end_open(run);
        while let Some(time) = tracing.due(run.time + duration) {
            let mut state = self.flight_start.clone();
            self.blocks.carry(&mut state, (time - run.time).max(0.0));
            let pressing = self.pressing_forces(run, &state, time);
            tracing.trace.forces.push(pressing.into_iter().map(|force| 0.0 - force).collect());
            tracing.trace.samples.push(self.modal_of(state, time));
        }
        if !run.stuck.is_empty() {
            self.trace_held(run, duration, &mut tracing);
        }
        self.tracing = Some(tracing);
    }

    /// Adds what held stops press with during a flight from the state at its start.
    fn trace_held(&self, run: &Run, duration: f64, tracing: &mut Tracing) {
        let impulses = self.held_impulses(&self.flight_start, run.time, duration);
        let flown =
            Flown { piece: 0, start: run.time, duration, state: &self.flight_start, held: &run.stuck };
        let first = self.outputs.len() - run.stuck.len();
        for (j, (&element, impulse)) in run.stuck.iter().zip(impulses).enumerate() {
            let Some(piece) = tracing.open[element] else { continue };
            let piece = &mut tracing.trace.contacts[piece];
            piece.impulse += impulse;
            piece.peak_force = self.flight_maximum(&flown, (first + j, 0), piece.peak_force);
        }
    }

    /// Writes down an impact on a rigid stop, after which the contact sticks or opens.
    pub(super) fn trace_impact(
        &mut self,
        run: &Run,
        touch: Touch,
        (impulse, energy): (f64, f64),
        sticks: bool,
    ) {
        if self.tracing.is_none() {
            return;
        }
        self.trace_touch(run, touch);
        let mut after = run.state.clone();
        after.iter_mut().zip(&self.inputs[touch.element]).for_each(|(x, b)| *x -= impulse * b);
        let jump = Jump { impulse, state: self.modal_of(after, run.time) };
        let Some(tracing) = &mut self.tracing else { return };
        let open = if sticks { tracing.open[touch.element] } else { tracing.open[touch.element].take() };
        let Some(piece) = open else { return };
        let piece = &mut tracing.trace.contacts[piece];
        piece.jump = (impulse > 0.0).then_some(jump);
        piece.impulse += impulse;
        piece.energy_lost += energy;
        piece.end = (!sticks).then_some(run.time);
    }

    /// Writes down a contact that closes now.
    pub(super) fn trace_touch(&mut self, run: &Run, touch: Touch) {
        let Some(mut tracing) = self.tracing.take() else { return };
        tracing.end_open(run);
        let velocity = self.output_jet(&run.state, touch.element, run.time).slope;
        let state = self.modal_state(run, run.time);
        tracing.begin(touch.element, touch.contact, Some(Touchdown { time: run.time, velocity, state }));
        self.tracing = Some(tracing);
    }

    /// Writes down the solved step that is being accepted; `run` stands at its start.
    pub(super) fn trace_step(&mut self, run: &Run) {
        let Some(mut tracing) = self.tracing.take() else { return };
        tracing.end_open(run);
        while let Some(time) = tracing.due(run.time + self.step.length) {
            let mut state = run.state.clone();
            self.carry_in_step(&mut state, 0.0, (time - run.time).max(0.0));
            tracing.trace.forces.push(self.forces_of(run, &state, time));
            tracing.trace.samples.push(self.modal_of(state, time));
        }
        for (a, &element) in self.step.active.iter().enumerate() {
            let Some(piece) = tracing.open[element] else { continue };
            let piece = &mut tracing.trace.contacts[piece];
            let (impulse, energy_lost) = self.work_of(run, a);
            piece.impulse += impulse.abs();
            piece.energy_lost += energy_lost;
            let force = &self.step.force[a * NODES..(a + 1) * NODES];
            piece.peak_force = piece.peak_force.max(self.step.grading().rule().extremum(force).0);
        }
        if !run.stuck.is_empty() {
            let impulses = self.pressing_impulses(&run.state);
            for (j, (&element, impulse)) in run.stuck.iter().zip(impulses).enumerate() {
                let Some(piece) = tracing.open[element] else { continue };
                let piece = &mut tracing.trace.contacts[piece];
                piece.impulse += impulse;
                piece.peak_force = self.pressing_maximum(&run.state, j, piece.peak_force);
            }
        }
        self.tracing = Some(tracing);
    }

    /// Impulse of the force of the a-th active element in the solved step, and the energy that it took.
    fn work_of(&self, run: &Run, a: usize) -> (f64, f64) {
        let (step, rule) = (&self.step, self.step.grading().rule());
        let force = &step.force[a * NODES..(a + 1) * NODES];
        let velocity = self.velocity_nodes(run, step.active[a]);
        let (mut impulse, mut work) = (0.0, 0.0);
        for k in 0..NODES {
            let part = rule.at_end[0][k] * step.length * force[k];
            impulse += part;
            work += part * velocity[k];
        }
        (impulse, -work)
    }

    /// Velocity of an output at the nodes of the solved step.
    fn velocity_nodes(&self, run: &Run, output: usize) -> [f64; NODES] {
        let step = &self.step;
        let length = step.length;
        if length > self.series.reach() {
            return std::array::from_fn(|k| self.jet_in_step(&run.state, output, step.node_time(k)).slope);
        }
        let loads = (step.active.as_slice(), step.force.as_slice());
        let mut values = self.series.node_values((output, 1), (step.grading(), length), &run.state, loads);
        for (k, value) in values.iter_mut().enumerate() {
            *value += self.drive.jet(output, &self.outputs[output], step.start + step.node_time(k)).slope;
        }
        values
    }

    /// Forces of the elements that act, from the homogeneous block state at a time.
    fn forces_of(&self, run: &Run, state: &[f64], time: f64) -> Vec<f64> {
        let force = |element: usize| {
            let jet = self.output_jet(state, element, time);
            self.laws[element].pressing_force(jet.value, jet.slope).value
        };
        let pressing = self.pressing_forces(run, state, time).into_iter().enumerate();
        pressing
            .map(|(element, held)| if self.acts(run, element) { force(element) } else { 0.0 - held })
            .collect()
    }

    /// Modal state of a homogeneous block state at a time.
    fn modal_of(&self, mut block: Vec<f64>, time: f64) -> Vec<f64> {
        self.drive.add_state(time, 1.0, &mut block);
        let mut modal = vec![0.0; block.len()];
        self.blocks.to_modal(&block, &mut modal);
        modal
    }
}
