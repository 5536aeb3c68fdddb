//! Impacts on rigid stops, and what comes of chatter.
//! Equations (G3), (G4) and (G10) of the book, `docs/theory`.
//!
//! **One impact.** At a touch with `r' = v > 0` the modal velocities jump by `phi P`, and so, with `phi^T
//! phi = C A B = D`,
//!
//! `P = -(1 + e) v/D`, `r' -> -e v`; energy lost `(1 - e^2) v^2/(2 D)`.
//!
//! The particular solution does not jump, the velocity of a moving support is in `v`. While other stops are
//! held, B is the input that their reactions leave, and D is that of the held structure; a stop that would
//! have to pull is let go first.
//!
//! **Sensitivities.** The touch comes `dt = -dr/v` later, with `dr` at fixed time, and is met with the
//! velocity `v + dr' + r'' dt`. Before, the motion goes on for `dt` as it was, after it comes too late by as
//! much:
//!
//! `V+ = V - B (1 + e)/D (dr' + r'' dt) - (A B P + sum_e B_e [F_e]) dt`,
//!
//! where `[F_e]` are the jumps of forces that depend on the velocity (`velocity_jump.rs`), and those
//! `lambda_j` of held stops that the impact throws off; r'' is that of the motion before, with these held.
//! Seen along the motion, `(dr, dr')` goes to `(-e dr, -e dr' - ...)`: the determinant of the jump is `e^2`,
//! so an impact contracts volumes by `2 ln e`. With e = 0 the velocity is forgotten: where the structure is
//! not pressed on it leaves at once, and neighbours differ by the instant of that alone. By e itself there is
//! the direct part `-B v/D`.
//!
//! **Grazing.** For `v -> 0` the sensitivities grow like `1/v`, and v like the root of the depth to which the
//! motion would have gone: this is the singularity of grazing impacts, and it is left as it is. A touch
//! within the rounding margin of the clearance is grazed: no impact, no jump (`clearance.rs`).
//!
//! **Chatter.** Pressed on with the acceleration `a = r'' > 0`, the bounces shrink like `v_k+1 = e v_k` and
//! end after the further time `T = 2 e v/(a (1 - e))`. Impacts are followed one by one until the next bounce
//! would rise no higher than `(e v)^2/(2 a) <= `CHATTER * margin` (`stick.rs`), and then the contact sticks
//! at once: an impact with e = 0. What is left out moves y, the structure beside the stop (`held.rs`),
//! through the displacement of the bounces alone, since their impulses do not act on it: by about `v^3/a^2`
//! times a stiffness, of third order in the speed of the first bounce that is left out. Sensitivities err in
//! second order: that of y' jumps by `-A B dr/D`, as at an impact without restitution. The sum of impulses is
//! right, since what presses over T is what the bounces would have given. If the acceleration falls by half
//! within 2 T, the chatter does not come to its end, and bounces are followed as long as they rise above the
//! margin.
//!
//! **Several stops.** Stops that touch at one instant strike one after another, in the order of the elements.
//! An impact that would pull at a held stop throws it off; so stops may chatter against one another. Once a
//! touch beside held stops is itself below the height above, it sticks with them, and those that would have
//! to pull are let go.
//!
//! # Source
//! Nordmark, J. Sound Vib. 145 (1991), 279-297 (grazing); Nordmark and Piiroinen, Nonlinear Dyn. 58 (2009),
//! 85-106 (chatter that ends).

use super::{ExactIntegrator, MotionError, drive::Jet, flight::Touch, hole, run::Run};

/// Most impacts in an excitation period.
pub(super) const MOST_IMPACTS: u64 = 100_000;
/// Steps of Newton's method to a touch; one or two are usual.
const NEWTON_STEPS: usize = 20;

/// An impact about to happen.
#[derive(Debug, Clone)]
pub(super) struct Impact {
    pub(super) touch: Touch,
    pub(super) restitution: f64,
    /// Relative displacement and its derivatives before it, forces included.
    pub(super) before: Jet,
    /// `r''` on the way to it, with all that was held then.
    approach: f64,
    /// `D`.
    pub(super) mobility: f64,
    /// Held stops that it throws off, and what they pressed with [N].
    pub(super) thrown_off: Vec<(usize, f64)>,
}

impl ExactIntegrator {
    /// An impact on a rigid stop, or the end of its chatter.
    pub(super) fn strike_rigid(&mut self, run: &mut Run, touch: Touch) -> Result<(), MotionError> {
        self.settle_on_the_touch(run, touch);
        let approach = self.jet_with_forces(run, touch.element).curvature;
        let pressing = self.pressing_forces(run, &run.state, run.time);
        let held = run.stuck.clone();
        if !self.comes_to_rest_beside_others(run, touch.element) {
            self.let_go_of_pulling(run, touch.element)?;
        }
        let thrown_off = held.into_iter().filter(|stop| !run.stuck.contains(stop));
        let thrown_off = thrown_off.map(|stop| (stop, pressing[stop])).collect();
        let (element, laws) = (touch.element, &self.laws);
        let restitution = laws[element].rigid().map_or(0.0, crate::law::RigidStop::restitution);
        let mobility = self.mobility[element][element];
        let before = self.jet_with_forces(run, element);
        let impact = Impact { touch, restitution, before, approach, mobility, thrown_off };
        run.impacts += 1;
        if self.sticks(run, &impact) {
            return self.stick(run, &impact);
        }
        if before.slope > 0.0 {
            return self.rebound(run, &impact);
        }
        Ok(())
    }

    /// Moves the run to the very instant of a touch that a flight has come to: the search ends within the
    /// rounding margin, and a small speed makes a long time of it.
    ///
    /// A stretch may also start behind the stop, where a method asks for the motion from a state that cannot
    /// be. Then the impact was before, and the run goes back to it, to a negative time, so that the flow has
    /// a smooth continuation there.
    fn settle_on_the_touch(&mut self, run: &mut Run, touch: Touch) {
        if self.forces_act(run) {
            return;
        }
        let start = run.state.clone();
        let mut shift = 0.0;
        for _ in 0..NEWTON_STEPS {
            let clearance =
                self.distance(self.output_jet(&run.state, touch.element, run.time + shift), touch);
            let step = -clearance.value / clearance.slope;
            // Newton's method is trusted where the curvature is a correction.
            let bent = clearance.curvature * step;
            if !step.is_finite() || clearance.slope >= 0.0 || bent.abs() > -clearance.slope {
                run.state.copy_from_slice(&start);
                return;
            }
            shift += step;
            run.state.copy_from_slice(&start);
            self.blocks.carry(&mut run.state, shift);
            if step.abs() <= 4.0 * f64::EPSILON * (run.time + shift).abs() || step.abs() <= 1e-9 * shift.abs()
            {
                break;
            }
        }
        if run.time + shift > self.stretch.duration() {
            run.state.copy_from_slice(&start);
            return;
        }
        run.time += shift;
        if let Some(sensitivity) = &mut run.sensitivity {
            self.blocks.propagators(shift, &mut self.propagators);
            sensitivity.propagate(&self.propagators);
            self.add_damped_flight(shift, &start, sensitivity);
        }
    }

    /// Turns the velocity round.
    fn rebound(&mut self, run: &mut Run, impact: &Impact) -> Result<(), MotionError> {
        let &Impact { touch, restitution, before, mobility, .. } = impact;
        let impulse = -(1.0 + restitution) * before.slope / mobility;
        let energy = 0.5 * (1.0 - restitution * restitution) * before.slope.powi(2) / mobility;
        self.note_impact(run, impact, (-impulse, energy), false);
        self.contraction += 2.0 * restitution.ln();
        if restitution == 0.0 {
            self.directions_lost = self.directions_lost.max(2 * run.stuck.len() + 1);
        }
        let displacement = self.displacement_sensitivity(run, touch);
        self.jump_at_impact(run, impact, impulse, &displacement);
        let jumps = self.jump_velocities(run, impact, impulse);
        self.jump_with_forces(run, &jumps, &displacement);
        self.throw_off(run, &displacement, impact.before.slope)?;
        if restitution == 0.0 {
            self.look_past(run, touch.element, None);
        }
        Ok(())
    }

    /// `V+ = V + sum_e B_e [F_e] dr/v`.
    pub(super) fn jump_with_forces(&self, run: &mut Run, jumps: &[(usize, f64)], displacement: &[f64]) {
        let Some(sensitivity) = &mut run.sensitivity else { return };
        for &(element, jump) in jumps {
            sensitivity.add_outer(&self.inputs[element], jump, displacement);
        }
    }

    /// `V+ = V + B dP - A B P dt`.
    fn jump_at_impact(&self, run: &mut Run, impact: &Impact, impulse: f64, displacement: &[f64]) {
        let &Impact { touch, restitution, before, approach, mobility, .. } = impact;
        let mut by_impulse = self.velocity_sensitivity(run, touch.element);
        let delay = -1.0 / before.slope;
        for (v, r) in by_impulse.iter_mut().zip(displacement) {
            *v = -(1.0 + restitution) / mobility * (*v + approach * delay * r);
        }
        let input = &self.inputs[touch.element];
        let carried = self.blocks.system_times_column(input);
        let Some(sensitivity) = &mut run.sensitivity else { return };
        if let Some((parameter, column)) = self.parameter.zip(sensitivity.parameter_column())
            && parameter.constant_of(touch.element) == Some(crate::LawConstant::Restitution)
        {
            by_impulse[column] -= before.slope / mobility;
        }
        sensitivity.add_outer(input, 1.0, &by_impulse);
        sensitivity.add_outer(&carried, -impulse * delay, displacement);
        self.jump_with_stops(run, impact, displacement);
    }

    /// `V+ = V + sum_j B_j lambda_j dr/v` over the stops that an impact throws off.
    pub(super) fn jump_with_stops(&self, run: &mut Run, impact: &Impact, displacement: &[f64]) {
        let Some(sensitivity) = &mut run.sensitivity else { return };
        for &(stop, force) in &impact.thrown_off {
            sensitivity.add_outer(&self.inputs[stop], force / impact.before.slope, displacement);
        }
    }

    /// Writes an impact down wherever it is wanted.
    pub(super) fn note_impact(
        &mut self,
        run: &Run,
        impact: &Impact,
        (impulse, energy): (f64, f64),
        sticks: bool,
    ) {
        let element = impact.touch.element;
        if !self.ends_a_brief_hop(run, element) {
            let place = self.first_touch(element);
            self.touches[place] = self.touches[place].saturating_add(1);
            if self.notes_course {
                self.course.touch(element, impact.before.slope);
            }
        }
        if self.notes_course {
            self.course.impact(element, (impulse, energy), sticks);
        }
        self.trace_impact(run, impact.touch, (impulse, energy), sticks);
    }

    /// Place of the first contact of an element among the numbers of touches.
    pub(super) fn first_touch(&self, element: usize) -> usize {
        self.laws[..element].iter().map(|law| law.contacts().len()).sum()
    }

    /// An output and its derivatives with the direct part of the forces.
    pub(super) fn jet_with_forces(&self, run: &Run, output: usize) -> Jet {
        self.jet_from(run, &run.state, output, run.time)
    }

    /// The same from the homogeneous state at a time.
    pub(super) fn jet_from(&self, run: &Run, state: &[f64], output: usize, time: f64) -> Jet {
        let mut jet = self.output_jet(state, output, time);
        for other in (0..self.laws.len()).filter(|&e| self.acts(run, e)) {
            let force = hole::force_of(&self.laws, other, |e| self.output_jet(state, e, time));
            jet.curvature += self.mobility[output][other] * force.value;
        }
        jet
    }

    /// The relative displacement of an element and its derivatives, of a hole its reading, with the forces
    /// that act now.
    pub(super) fn element_jet_with_forces(&self, run: &Run, element: usize) -> Jet {
        let own = self.jet_with_forces(run, element);
        match self.laws[element].round_hole() {
            Some(hole) => hole::reading(hole, own, self.jet_with_forces(run, element + 1)),
            None => own,
        }
    }
}
