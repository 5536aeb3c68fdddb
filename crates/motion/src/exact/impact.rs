//! Impacts on rigid stops, and what comes of chatter.
//!
//! **One impact.** At a touch with `r' = v > 0` the modal velocities jump by `phi P`, and so, with `phi^T phi = C A B = D`,
//!
//! `P = -(1 + e) v/D`, `r' -> -e v`; energy lost `(1 - e^2) v^2/(2 D)`.
//!
//! The particular solution does not jump, the velocity of a moving support is in `v`. While other stops are held, B is the input that their reactions leave, and D is that of the held
//! structure; a stop that would have to pull is let go first.
//!
//! **Sensitivities.** The touch comes `dt = -dr/v` later, with `dr` at fixed time, and is met with the velocity `v + dr' + r'' dt`. Before, the motion goes on for `dt` as it was, after it
//! comes too late by as much:
//!
//! `V+ = V - B (1 + e)/D (dr' + r'' dt) - (A B P + sum_e B_e [F_e]) dt`,
//!
//! where `[F_e]` are the jumps of forces that depend on the velocity, and those `lambda_j` of held stops that the impact throws off; r'' is that of the motion before, with these held. Seen along the motion, `(dr, dr')` goes to `(-e dr, -e dr' - ...)`: the determinant of the jump is `e^2`, so an
//! impact contracts volumes by `2 ln e`. By e itself there is the direct part `-B v/D`.
//!
//! **Grazing.** For `v -> 0` the sensitivities grow like `1/v`, and v like the root of the depth to which the motion would have gone: this is the singularity of grazing impacts, and it is
//! left as it is. A touch within the rounding margin of the clearance is grazed: no impact, no jump (`clearance.rs`).
//!
//! **Chatter.** Pressed on with the acceleration `a = r'' > 0`, the bounces shrink like `v_k+1 = e v_k` and end after the further time `T = 2 e v/(a (1 - e))`. Impacts are followed one by one
//! until the next bounce would rise no higher than `(e v)^2/(2 a) <= `[`CHATTER`]` * margin`, and then the contact sticks at once: an impact with e = 0. What is left out moves y, the
//! structure beside the stop (`held.rs`), through the displacement of the bounces alone, since their impulses do not act on it: by about `v^3/a^2` times a stiffness,
//! of third order in the speed of the first bounce that is left out. Sensitivities err in second order: that of y' jumps by `-A B dr/D`, as at an impact without restitution. The sum of
//! impulses is right, since what presses over T is what the bounces would have given. If the acceleration falls by half within 2 T, the chatter does not come to its end, and bounces are followed as long as they rise
//! above the margin.
//!
//! **Several stops.** Stops that touch at one instant strike one after another, in the order of the elements. An impact that would pull at a held stop throws it off; so stops may chatter against one another. Once a
//! touch beside held stops is itself below the height above, it sticks with them, and those that would have to pull are let go.
//!
//! # Source
//! Nordmark, J. Sound Vib. 145 (1991), 279-297 (grazing); Nordmark and Piiroinen, Nonlinear Dyn. 58 (2009), 85-106 (chatter that ends).

use super::{
    ExactIntegrator, MotionError,
    drive::Jet,
    flight::{Boundary, Touch},
    run::Run,
};

/// Height of a bounce, in rounding margins of the clearance, below which it sticks.
const CHATTER: f64 = 1e3;
/// Most impacts in an excitation period.
pub(super) const MOST_IMPACTS: u64 = 100_000;
/// Steps of Newton's method to a touch; one or two are usual.
const NEWTON_STEPS: usize = 20;
/// Added to the number of touches with every chatter that comes to its end.
pub(super) const STUCK_TOUCHES: u32 = 1 << 16;

/// An impact about to happen.
#[derive(Debug, Clone)]
struct Impact {
    touch: Touch,
    restitution: f64,
    /// Relative displacement and its derivatives before it, forces included.
    before: Jet,
    /// `r''` on the way to it, with all that was held then.
    approach: f64,
    /// `D`.
    mobility: f64,
    /// Held stops that it throws off, and what they pressed with [N].
    thrown_off: Vec<(usize, f64)>,
}

impl ExactIntegrator {
    /// An impact on a rigid stop, or the end of its chatter.
    pub(super) fn strike_rigid(&mut self, run: &mut Run, touch: Touch) -> Result<(), MotionError> {
        self.settle_on_the_touch(run, touch);
        let approach = self.jet_with_forces(run, touch.element).curvature;
        let pressing = self.pressing_forces(&run.state, run.time);
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
            self.rebound(run, &impact);
        }
        Ok(())
    }

    /// Moves the run to the very instant of a touch that a flight has come to: the search ends within the rounding margin, and a small speed makes a long time of it.
    ///
    /// A stretch may also start behind the stop, where a method asks for the motion from a state that cannot be. Then the impact was before, and the run goes back to it, to a negative
    /// time, so that the flow has a smooth continuation there.
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

    /// A rigid stop whose state at the start of a stretch is that of a contact that sticks, is held.
    pub(super) fn stick_at_start(&mut self, run: &mut Run) -> Result<(), MotionError> {
        for element in 0..self.laws.len() {
            if self.laws[element].rigid().is_none() {
                continue;
            }
            let touch = Touch { element, contact: 0, boundary: Boundary::Closes };
            let before = self.jet_with_forces(run, element);
            let clearance = self.distance(before, touch);
            let margin = self.bounds(&run.state, element, self.stretch.duration()).margin;
            let slow = before.slope.powi(2) <= 2.0 * before.curvature * CHATTER * margin;
            if clearance.value.abs() <= CHATTER * margin && before.curvature > 0.0 && slow {
                if self.forces_act(run) {
                    return Err(self.sticks_under_forces(run, element));
                }
                self.forget_the_approach(run, touch);
                self.contraction = f64::NEG_INFINITY;
                let elements = joined(&run.stuck, element);
                self.hold(run, elements)?;
            }
        }
        self.let_go_of_tension(run)
    }

    /// Lets a held stop go whose pressing force has come to its end.
    pub(super) fn lift(&mut self, run: &mut Run, element: usize) -> Result<(), MotionError> {
        let output = self.watched_output(run, element, Boundary::Lifts);
        let slope = self.output_jet(&run.state, output, run.time).slope;
        let rest = run.stuck.iter().copied().filter(|&stuck| stuck != element).collect();
        self.hold(run, rest)?;
        // The clearance grows like `D |lambda'| t^3/6`: until it is out of the margin rounding would decide.
        let margin = self.bounds(&run.state, element, self.stretch.duration()).margin;
        let cubic = (6.0 * CHATTER * margin / (self.mobility_in_free(element) * slope.abs())).cbrt();
        // Where another stop has taken over, it grows like `|r''| t^2/2`.
        let away = -self.output_jet(&run.state, element, run.time).curvature;
        let quadratic = (2.0 * CHATTER * margin / away.max(0.0)).sqrt();
        let wait = cubic.min(quadratic);
        run.lifted = Some((element, run.time + wait.min(1e-3 * self.stretch.duration())));
        Ok(())
    }

    fn mobility_in_free(&self, element: usize) -> f64 {
        self.system.elements()[element].shape.iter().map(|phi| phi * phi).sum()
    }

    /// Whether a touch beside held stops is so slow that the impacts with which they would throw one another off, to and fro, are at their end: then all are held, as far as they press.
    fn comes_to_rest_beside_others(&self, run: &Run, element: usize) -> bool {
        let before = self.jet_with_forces(run, element);
        let margin = self.bounds(&run.state, element, self.stretch.duration()).margin;
        !run.stuck.is_empty()
            && before.curvature > 0.0
            && before.slope.powi(2) <= 2.0 * before.curvature * CHATTER * margin
    }

    /// Lets held stops go that an impact on an element would pull, the strongest first.
    fn let_go_of_pulling(&mut self, run: &mut Run, element: usize) -> Result<(), MotionError> {
        while let Some(holding) = &self.holding {
            // The impulse on the element is negative, and so must those on held stops be.
            let reactions = holding.held.reactions[element].iter().enumerate();
            let pulled = reactions.min_by(|a, b| a.1.total_cmp(b.1)).filter(|(_, r)| **r < -1e-12);
            let Some((place, _)) = pulled else { return Ok(()) };
            let mut rest = run.stuck.clone();
            rest.remove(place);
            self.hold(run, rest)?;
        }
        Ok(())
    }

    /// Whether a touch is the end of a chatter.
    fn sticks(&self, run: &Run, impact: &Impact) -> bool {
        let (speed, press) = (impact.before.slope.max(0.0), impact.before.curvature);
        if press <= 0.0 {
            return false;
        }
        let e = impact.restitution;
        let element = impact.touch.element;
        let margin = self.bounds(&run.state, element, self.stretch.duration()).margin;
        let height = (e * speed).powi(2) / (2.0 * press);
        if height > CHATTER * margin {
            return false;
        }
        if height <= margin {
            return true;
        }
        let rest = 2.0 * e * speed / (press * (1.0 - e));
        self.press_after(run, element, 2.0 * rest) >= 0.5 * press
    }

    /// `r''` of an element after a time of flight from now.
    fn press_after(&self, run: &Run, element: usize, time: f64) -> f64 {
        let mut state = run.state.clone();
        self.blocks.carry(&mut state, time);
        self.output_jet(&state, element, run.time + time).curvature
    }

    /// Holds the element from now on.
    fn stick(&mut self, run: &mut Run, impact: &Impact) -> Result<(), MotionError> {
        let element = impact.touch.element;
        if self.forces_act(run) {
            return Err(self.sticks_under_forces(run, element));
        }
        let speed = impact.before.slope.max(0.0);
        let energy = 0.5 * speed * speed / impact.mobility;
        self.note_impact(run, impact, (speed / impact.mobility, energy), true);
        let place = self.first_touch(element);
        self.touches[place] = self.touches[place].saturating_add(STUCK_TOUCHES);
        self.contraction = f64::NEG_INFINITY;
        self.forget_the_approach(run, impact.touch);
        let elements = joined(&run.stuck, element);
        self.hold(run, elements)?;
        self.let_go_of_tension(run)
    }

    /// Lets held stops go that would have to pull, now that another one is held, too; the strongest first.
    fn let_go_of_tension(&mut self, run: &mut Run) -> Result<(), MotionError> {
        while run.stuck.len() > 1 {
            let pressing = self.pressing_forces(&run.state, run.time);
            let weakest = run.stuck.iter().copied().min_by(|&a, &b| pressing[a].total_cmp(&pressing[b]));
            let Some(element) = weakest.filter(|&element| pressing[element] < 0.0) else { return Ok(()) };
            self.lift(run, element)?;
        }
        Ok(())
    }

    pub(super) fn sticks_under_forces(&self, run: &Run, element: usize) -> MotionError {
        let others: Vec<usize> = (0..self.laws.len()).filter(|&other| self.acts(run, other)).collect();
        MotionError::SticksUnderForces {
            element: self.names(&[element]),
            others: self.names(&others),
            time: run.time,
        }
    }

    /// `V - A B dr/D`: what an impact without restitution leaves besides the projection.
    fn forget_the_approach(&mut self, run: &mut Run, touch: Touch) {
        if run.sensitivity.is_none() {
            return;
        }
        let displacement = self.displacement_sensitivity(run, touch);
        let input = &self.inputs[touch.element];
        let carried = self.blocks.system_times_column(input);
        let factor = -1.0 / self.mobility[touch.element][touch.element];
        if let Some(sensitivity) = &mut run.sensitivity {
            sensitivity.add_outer(&carried, factor, &displacement);
        }
    }

    /// Turns the velocity round.
    fn rebound(&mut self, run: &mut Run, impact: &Impact) {
        let &Impact { touch, restitution, before, mobility, .. } = impact;
        let impulse = -(1.0 + restitution) * before.slope / mobility;
        let energy = 0.5 * (1.0 - restitution * restitution) * before.slope.powi(2) / mobility;
        self.note_impact(run, impact, (-impulse, energy), false);
        self.contraction += 2.0 * restitution.ln();
        let forces = self.velocity_forces(run);
        let displacement = self.displacement_sensitivity(run, touch);
        self.jump_at_impact(run, impact, impulse, &displacement);
        let input = &self.inputs[touch.element];
        run.state.iter_mut().zip(input).for_each(|(x, b)| *x += impulse * b);
        let jumps = self.velocity_forces(run);
        let Some(sensitivity) = &mut run.sensitivity else { return };
        for ((element, after), (_, before)) in jumps.iter().zip(&forces) {
            let factor = (after - before) / impact.before.slope;
            sensitivity.add_outer(&self.inputs[*element], factor, &displacement);
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
        if let Some((crate::Parameter::Restitution { element }, column)) =
            self.parameter.zip(sensitivity.parameter_column())
            && element == touch.element
        {
            by_impulse[column] -= before.slope / mobility;
        }
        sensitivity.add_outer(input, 1.0, &by_impulse);
        sensitivity.add_outer(&carried, -impulse * delay, displacement);
        for &(stop, force) in &impact.thrown_off {
            sensitivity.add_outer(&self.inputs[stop], -force * delay, displacement);
        }
    }

    /// Forces that depend on the velocity and act now.
    fn velocity_forces(&self, run: &Run) -> Vec<(usize, f64)> {
        let damped =
            (0..self.laws.len()).filter(|&e| self.acts(run, e) && self.laws[e].depends_on_velocity());
        let force = |e: usize| {
            let jet = self.output_jet(&run.state, e, run.time);
            self.laws[e].pressing_force(jet.value, jet.slope).value
        };
        damped.map(|e| (e, force(e))).collect()
    }

    /// Writes an impact down wherever it is wanted.
    fn note_impact(&mut self, run: &Run, impact: &Impact, (impulse, energy): (f64, f64), sticks: bool) {
        let place = self.first_touch(impact.touch.element);
        self.touches[place] = self.touches[place].saturating_add(1);
        if self.notes_course {
            self.course.touch(impact.before.slope);
            self.course.impact(impact.touch.element, (impulse, energy), sticks);
        }
        self.trace_impact(run, impact.touch, (impulse, energy), sticks);
    }

    /// Place of the first contact of an element among the numbers of touches.
    fn first_touch(&self, element: usize) -> usize {
        self.laws[..element].iter().map(|law| law.contacts().len()).sum()
    }

    /// An output and its derivatives with the direct part of the forces.
    pub(super) fn jet_with_forces(&self, run: &Run, output: usize) -> Jet {
        let mut jet = self.output_jet(&run.state, output, run.time);
        for other in (0..self.laws.len()).filter(|&e| self.acts(run, e)) {
            let at = self.output_jet(&run.state, other, run.time);
            jet.curvature +=
                self.mobility[output][other] * self.laws[other].pressing_force(at.value, at.slope).value;
        }
        jet
    }
}

/// The elements with one more, ascending.
fn joined(elements: &[usize], element: usize) -> Vec<usize> {
    let mut joined: Vec<usize> = elements.iter().copied().chain([element]).collect();
    joined.sort_unstable();
    joined.dedup();
    joined
}
