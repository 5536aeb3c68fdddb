//! A run over a stretch: from its start through flights and contacts to the state and the sensitivities
//! at its end. Equations (F7) and (F8) of the book, `docs/theory`.

use faer::Mat;

use super::{
    AtEnd, ExactIntegrator, MOST_STEPS, MotionError,
    drive::{Drive, Jet},
    flight::{Boundary, Touch, clearance_of},
    hole,
    impact::MOST_IMPACTS,
    maxima::{bit, closed_bits},
    run::{Left, Run},
    standstill::Standstill,
};
use crate::{Flow, Law, Stretch};

impl ExactIntegrator {
    /// State at the end of a stretch, from `state` (`[q; q']`, length 2n) at its start.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn advance(&mut self, stretch: &Stretch, state: &[f64]) -> Result<Vec<f64>, MotionError> {
        let mut run = self.begin(stretch, state, false)?;
        let result = self.complete(&mut run, stretch);
        let end = self.modal_state(&run, stretch.duration());
        self.let_go();
        self.run = run;
        result?;
        self.remember_end(stretch, &end);
        Ok(end)
    }

    /// State of the steady motion without local forces at the start of a stretch (of the motion from rest,
    /// where resonant).
    pub fn steady_state(&mut self, stretch: &Stretch) -> Vec<f64> {
        self.let_go();
        let n = self.blocks.count();
        let mut block = vec![0.0; 2 * n];
        Drive::steady_motion(&self.system, &self.blocks, stretch).add_state(0.0, 1.0, &mut block);
        self.blocks.to_modal(block)
    }

    /// Readies the particular solution over a stretch.
    pub(super) fn drive_over(&mut self, stretch: &Stretch) {
        if !self.drive.turn_to(stretch) {
            self.drive = Drive::new(&self.system, &self.blocks, &self.outputs, stretch);
        }
    }

    /// Flow over a stretch: the state at its end and its sensitivities.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn flow(&mut self, stretch: &Stretch, state: &[f64]) -> Result<Flow, MotionError> {
        let mut run = self.begin(stretch, state, true)?;
        let result = self.complete(&mut run, stretch);
        let flow = result.map(|()| self.flow_of(&mut run, stretch));
        self.let_go();
        self.run = run;
        let mut flow = flow?;
        if let Some(column) = self.family_column((stretch, state), &flow.state)? {
            flow.by_parameter = column;
        }
        self.remember_end(stretch, &flow.state);
        if self.goes_on {
            self.remember_speeds(&flow.by_state);
        }
        Ok(flow)
    }

    pub(super) fn begin(
        &mut self,
        stretch: &Stretch,
        state: &[f64],
        sensitivities: bool,
    ) -> Result<Run, MotionError> {
        self.let_go();
        self.stretch = *stretch;
        self.contraction = 0.0;
        self.rounding = 0.0;
        self.cuts_for_volume = 0;
        self.directions_lost = 0;
        let n = self.blocks.count();
        self.drive_over(stretch);
        let mut run = std::mem::take(&mut self.run);
        run.time = 0.0;
        run.proposal = 0.0;
        run.graded = 0.0;
        run.touched = None;
        run.pressed = None;
        run.slack = 0.0;
        run.release = None;
        run.stuck.clear();
        run.left.clear();
        run.left.resize(self.laws.len(), Left::NEVER);
        run.impacts = 0;
        run.state.resize(2 * n, 0.0);
        self.blocks.of_modal(state, &mut run.state);
        self.drive.add_state(0.0, -1.0, &mut run.state);
        let reused = run.sensitivity.take();
        run.sensitivity = sensitivities.then(|| {
            let mut by_frequency = vec![0.0; 2 * n];
            self.drive.for_state_by_frequency(0.0, n, |i, value| by_frequency[i] -= value);
            let by_parameter = self.parameter_column_at_start();
            let mut sensitivity = reused.unwrap_or_default();
            sensitivity.start(&self.blocks, &by_frequency, by_parameter.as_deref());
            sensitivity
        });
        self.forget_impacts();
        if !sensitivities || self.goes_on {
            self.recall_impacts(stretch, state, run.sensitivity.as_mut());
        }
        self.find_pieces(&run);
        run.closed.clear();
        run.parted.clear();
        for element in 0..self.laws.len() {
            let contact = self.contact_at_start(&run, element, stretch.duration());
            let presses = contact.is_some_and(|contact| self.presses_at_start(&run, element, contact));
            run.closed.push(contact.filter(|_| presses));
            run.parted.push(contact.filter(|_| !presses));
        }
        self.touches.fill(0);
        self.note_end(&run, 0);
        self.counts.stretches += 1;
        if self.has_rigid_stops {
            self.stick_at_start(&mut run)?;
        }
        if self.notes_course {
            self.course.begin(stretch, state, &run);
        }
        Ok(run)
    }

    /// Whether a contact with penetration at the start of a stretch has pressure, as far as its law asks for
    /// it.
    fn presses_at_start(&self, run: &Run, element: usize, contact: usize) -> bool {
        let touch = Touch { element, contact, boundary: Boundary::Presses };
        let jet = self.element_jet(&run.state, element, 0.0);
        !self.laws[element].has_pressure() || self.distance(jet, touch).value < 0.0
    }

    /// The contact of an element that is closed at the start of a stretch.
    fn contact_at_start(&self, run: &Run, element: usize, duration: f64) -> Option<usize> {
        let jet = self.element_jet(&run.state, element, 0.0);
        let margin = self.element_bounds(&run.state, element, (0.0, duration)).margin;
        if self.laws[element].rigid().is_some() {
            return None;
        }
        self.laws[element].contacts().iter().position(|c| {
            let clearance = clearance_of(jet, c.level, c.sign);
            clearance.value < -margin
        })
    }

    /// Runs to the end of the stretch.
    pub(super) fn complete(&mut self, run: &mut Run, stretch: &Stretch) -> Result<(), MotionError> {
        let end = stretch.duration();
        self.check_start(run, stretch)?;
        self.closed_throughout = closed_bits(run);
        let usual = MOST_STEPS * (1 + (stretch.end - stretch.start) as u64);
        let steps = self.most_steps.map_or(usual, |most| most.min(usual));
        let most = self.counts.steps + steps;
        // Besides those there are flights and touches, which need no step.
        let mut further = steps + 2 * MOST_IMPACTS * (1 + (stretch.end - stretch.start) as u64);
        let mut standstill = Standstill::new(run);
        while run.time < end {
            further -= 1;
            if self.counts.steps > most || further == 0 {
                return Err(MotionError::TooManySteps { time: run.time, steps });
            }
            if standstill.lasts(run, end) {
                let elements = self.names(&standstill.changing(run));
                return Err(MotionError::StandsStill { time: run.time, elements });
            }
            if run.impacts > MOST_IMPACTS * (1 + (stretch.end - stretch.start) as u64) {
                return Err(MotionError::TooManyImpacts { time: run.time, impacts: run.impacts });
            }
            if self.forces_act(run) {
                self.contact_phase(run, end)?;
            } else if let Some(touch) = self.fly(run, end)? {
                self.close(run, touch)?;
            }
            if !run.state.iter().all(|value| value.is_finite()) {
                return Err(MotionError::NotFinite { time: run.time });
            }
            self.closed_throughout &= closed_bits(run);
        }
        self.note_end(run, 1);
        Ok(())
    }

    /// Notes which contacts are closed, at the start (0) or the end (1) of a stretch.
    fn note_end(&mut self, run: &Run, end: usize) {
        let mut noted = std::mem::take(&mut self.at_ends[end]);
        noted.clear();
        for (element, law) in self.laws.iter().enumerate() {
            let first = noted.len();
            noted.resize(first + law.contacts().len(), AtEnd::Open);
            if let Some(contact) = run.closed[element].or(run.parted[element]) {
                let closing =
                    law.contacts()[contact].sign * self.element_jet(&run.state, element, run.time).slope;
                noted[first + contact] = if closing > 0.0 { AtEnd::Closing } else { AtEnd::Opening };
            }
        }
        self.at_ends[end] = noted;
    }

    pub(super) fn forces_act(&self, run: &Run) -> bool {
        (0..self.laws.len()).any(|element| self.acts(run, element))
    }

    /// Whether an element may have a force.
    pub(super) fn acts(&self, run: &Run, element: usize) -> bool {
        let owner = hole::owner(&self.laws, element);
        run.closed[owner].is_some() || self.laws[owner].contacts().is_empty()
    }

    /// Notes that a contact without force crosses a boundary.
    pub(super) fn close(&mut self, run: &mut Run, touch: Touch) -> Result<(), MotionError> {
        run.proposal = 0.0;
        run.graded = 0.0;
        run.release = None;
        run.slack = 0.0;
        match touch.boundary {
            Boundary::Leaves => run.parted[touch.element] = None,
            Boundary::Presses => {
                run.closed[touch.element] = run.parted[touch.element].take();
                run.pressed = Some(touch.element);
            }
            Boundary::Lifts => self.lift(run, touch.element)?,
            Boundary::Kink { deeper } => self.cross_kink(touch.element, deeper),
            Boundary::Closes if self.laws[touch.element].rigid().is_some() => {
                self.strike_rigid(run, touch)?;
            }
            Boundary::Closes => {
                self.check_impact(run, touch)?;
                self.strike(run, touch)?;
            }
        }
        Ok(())
    }

    /// Notes that an open contact closes.
    fn strike(&mut self, run: &mut Run, touch: Touch) -> Result<(), MotionError> {
        if self.notes_course {
            self.course.touch(touch.element, self.element_jet(&run.state, touch.element, run.time).slope);
        }
        self.trace_touch(run, touch);
        self.jump_at_onset(run, touch);
        self.remember_impact(run, touch);
        self.start_with_first_piece(touch);
        run.closed[touch.element] = Some(touch.contact);
        run.touched = Some(touch.element);
        let before: usize = self.laws[..touch.element].iter().map(|law| law.contacts().len()).sum();
        self.touches[before + touch.contact] += 1;
        self.closed_throughout &= !bit(touch.element);
        if !run.stuck.is_empty() && self.laws[touch.element].onset_damping() > 0.0 {
            let speed = self.output_jet(&run.state, touch.element, run.time).slope;
            let displacement = self.displacement_sensitivity(run, touch);
            self.throw_off(run, &displacement, speed)?;
        }
        Ok(())
    }

    /// An output and its derivatives from the homogeneous block state at `time`, apart from the direct part
    /// of forces.
    pub(super) fn output_jet(&self, state: &[f64], output: usize, time: f64) -> Jet {
        let o = &self.outputs[output];
        let mut jet = self.drive.jet(output, o, time);
        for (i, &x) in state.iter().enumerate() {
            jet.value += o.row[i] * x;
            jet.slope += o.velocity_row[i] * x;
            jet.curvature += o.acceleration_row[i] * x;
        }
        jet
    }

    /// The relative displacement of an element and its derivatives, of a hole its reading; apart from the
    /// direct part of forces.
    pub(super) fn element_jet(&self, state: &[f64], element: usize, time: f64) -> Jet {
        self.reading_of(state, element, (time, self.output_jet(state, element, time)))
    }

    /// The same, from the output of the element.
    pub(super) fn reading_of(&self, state: &[f64], element: usize, (time, own): (f64, Jet)) -> Jet {
        match self.laws.get(element).and_then(Law::round_hole) {
            Some(hole) => hole::reading(hole, own, self.output_jet(state, element + 1, time)),
            None => own,
        }
    }

    pub(super) fn modal_state(&self, run: &Run, time: f64) -> Vec<f64> {
        self.modal_of(run.state.clone(), time)
    }

    /// Modal state of a homogeneous block state at a time.
    pub(super) fn modal_of(&self, mut block: Vec<f64>, time: f64) -> Vec<f64> {
        self.drive.add_state(time, 1.0, &mut block);
        self.blocks.to_modal(block)
    }

    fn flow_of(&mut self, run: &mut Run, stretch: &Stretch) -> Flow {
        let n = self.blocks.count();
        let time = stretch.duration();
        let state = self.modal_state(run, time);
        let mut by_state = Mat::zeros(2 * n, 2 * n);
        let mut by_frequency = vec![0.0; 2 * n];
        let mut particular = vec![0.0; 2 * n];
        let mut by_parameter = vec![0.0; if self.parameter.is_some() { 2 * n } else { 0 }];
        if let Some(parameter) = self.parameter {
            self.add_particular(parameter, time, 1.0, &mut particular);
        }
        let duration_by_frequency = -time / stretch.frequency_hz;
        let rate = self.modal_rate(run, &state, stretch);
        if let Some(sensitivity) = &mut run.sensitivity {
            let column = sensitivity.frequency_column();
            self.drive.for_state_by_frequency(time, n, |i, value| sensitivity.add_to(column, i, value));
            if let Some(column) = sensitivity.parameter_column() {
                let entries = particular.iter().enumerate();
                entries.for_each(|(i, &value)| sensitivity.add_to(column, i, value));
            }
            sensitivity.write(&self.blocks, &mut by_state, &mut by_frequency, &mut by_parameter);
        }
        by_frequency.iter_mut().zip(&rate).for_each(|(b, r)| *b += duration_by_frequency * r);
        Flow { state, by_state, by_frequency, by_parameter }
    }

    /// `z'` at the end of a stretch: the equations of motion in modal coordinates.
    fn modal_rate(&self, run: &Run, state: &[f64], stretch: &Stretch) -> Vec<f64> {
        let (n, model) = (self.blocks.count(), self.system.model());
        let (q, v) = state.split_at(n);
        let mut rate = v.to_vec();
        for i in 0..n {
            let damping: f64 = (0..n).map(|j| model.damping[(i, j)] * v[j]).sum();
            rate.push(-model.natural_frequencies[i].powi(2) * q[i] - damping);
        }
        let omega = std::f64::consts::TAU * stretch.frequency_hz;
        for (index, &order) in self.system.orders().iter().enumerate() {
            let load = self.system.modal_load(index, omega);
            let angle = std::f64::consts::TAU * f64::from(order) * (stretch.end - stretch.end.floor());
            let rotation = faer::c64::new(angle.cos(), angle.sin());
            (0..n).for_each(|i| rate[n + i] += (load.amplitude[i] * rotation).re);
        }
        for (e, element) in self.system.elements().iter().enumerate() {
            let jet = |e: usize| self.output_jet(&run.state, e, stretch.duration());
            // A law that depends on the velocity may jump at the level, where its contact is what counts.
            if self.laws[e].depends_on_velocity() && !self.acts(run, e) {
                continue;
            }
            let force = hole::force_of(&self.laws, e, jet).value;
            (0..n).for_each(|i| rate[n + i] += element.shape[i] * force);
        }
        if self.holding.is_some() {
            let pressing = self.pressing_forces(run, &run.state, stretch.duration());
            for (element, force) in self.system.elements().iter().zip(pressing) {
                (0..n).for_each(|i| rate[n + i] -= element.shape[i] * force);
            }
        }
        rate
    }
}
