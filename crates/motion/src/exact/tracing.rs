//! What flights, impacts, touches and force steps add to the motion that is being written down (`trace.rs`).

use super::{
    ExactIntegrator,
    collocation::{Grading, NODES},
    flight::Touch,
    flight_maximum::Flown,
    hole,
    panels::MotionSpan,
    run::Run,
    trace::{Jump, Touchdown, Tracing},
};

impl ExactIntegrator {
    /// Writes down a flight of that duration from the state at its start.
    pub(super) fn trace_flight(&mut self, run: &Run, duration: f64) {
        let Some(mut tracing) = self.tracing.take() else { return };
        tracing.end_open(run);
        let span = MotionSpan { start: run.time, length: duration, grading: Grading::Smooth };
        tracing.note(span, |times| {
            let states = self.blocks.states_at((&self.flight_start, run.time), times);
            let read = |(state, &time): (Vec<f64>, &f64)| {
                let pressing = self.pressing_forces(run, &state, time);
                let forces = pressing.into_iter().map(|force| 0.0 - force).collect();
                (self.modal_of(state, time), forces)
            };
            states.into_iter().zip(times).map(read).collect()
        });
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
        piece.clear = piece.end;
    }

    /// Writes down a contact that closes now.
    pub(super) fn trace_touch(&mut self, run: &Run, touch: Touch) {
        let Some(mut tracing) = self.tracing.take() else { return };
        tracing.end_open(run);
        let velocity = self.element_jet(&run.state, touch.element, run.time).slope;
        let state = self.modal_state(run, run.time);
        tracing.begin(touch.element, touch.contact, Some(Touchdown { time: run.time, velocity, state }));
        self.tracing = Some(tracing);
    }

    /// Writes down the solved step that is being accepted; `run` stands at its start.
    pub(super) fn trace_step(&mut self, run: &Run) {
        let Some(mut tracing) = self.tracing.take() else { return };
        tracing.end_open(run);
        let (length, grading) = (self.step.length, self.step.grading());
        tracing.note(MotionSpan { start: run.time, length, grading }, |times| {
            let read = |&time: &f64| {
                let mut state = run.state.clone();
                self.carry_in_step(&mut state, 0.0, (time - run.time).max(0.0));
                let forces = self.forces_of(run, &state, time);
                (self.modal_of(state, time), forces)
            };
            times.iter().map(read).collect()
        });
        for (a, &element) in self.step.active.iter().enumerate() {
            let Some(piece) = tracing.open[element] else { continue };
            let piece = &mut tracing.trace.contacts[piece];
            let (impulse, energy_lost) = self.work_of(run, a);
            piece.impulse += impulse.abs();
            piece.energy_lost += energy_lost;
            let force = hole::magnitudes(&self.laws[element], self.step.force.as_chunks().0, a);
            let force: &[f64; NODES] = &force;
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

    /// Impulse of the force of the a-th active element in the solved step, and the energy that it took; of a
    /// hole those of its magnitude, and of both directions.
    fn work_of(&self, run: &Run, a: usize) -> (f64, f64) {
        let law = &self.laws[self.step.active[a]];
        let (impulse, energy) = self.work_along(run, a);
        if law.round_hole().is_none() {
            return (impulse, energy);
        }
        let force: [f64; NODES] = hole::magnitudes(law, self.step.force.as_chunks().0, a);
        let weights = &self.step.grading().rule().at_end[0];
        let impulse: f64 = weights.iter().zip(force).map(|(weight, force)| weight * force).sum();
        (impulse * self.step.length, energy + self.work_along(run, a + 1).1)
    }

    /// The same along the output of that element.
    fn work_along(&self, run: &Run, a: usize) -> (f64, f64) {
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
    pub(super) fn forces_of(&self, run: &Run, state: &[f64], time: f64) -> Vec<f64> {
        let force =
            |element: usize| hole::force_of(&self.laws, element, |e| self.output_jet(state, e, time)).value;
        let pressing = self.pressing_forces(run, state, time).into_iter().enumerate();
        pressing
            .map(|(element, held)| if self.acts(run, element) { force(element) } else { 0.0 - held })
            .collect()
    }
}
