//! Rigid stops that stick, and how they let go.
//!
//! **Going over.** A chatter that comes to its end, or an impact without restitution, leaves the structure held (`held.rs`). It is the limit of an impact with e = 0 and the velocity `v -> 0`: the
//! sensitivities keep `V+ = V - (A B + sum_e B_e f_v,e G_e) dr/D` besides what the projection takes, with `f_v` of forces that depend on the velocity and `G_e = C_e A B`.
//!
//! **Letting go** where the pressing force vanishes continuously changes nothing in the sensitivities. Where it falls to `lambda_j < 0` by a jump, at a touch or an impact that comes
//! `dt = -dr/v` later for a neighbour, the stop presses no more from then on, and `V+ = V + B_j lambda_j dr/v`.
//!
//! Forces of other elements act through all of it: they are in the acceleration that presses, and in the pressing forces (`pressing.rs`).

use super::{
    ExactIntegrator, MotionError,
    clearance::ClearanceBounds,
    flight::{Boundary, Touch},
    impact::Impact,
    run::Run,
};

/// Height of a bounce, in rounding margins of the clearance, below which it sticks.
const CHATTER: f64 = 1e3;
/// Added to the number of touches with every chatter that comes to its end.
pub(super) const STUCK_TOUCHES: u32 = 1 << 16;

impl ExactIntegrator {
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
        let place = self.held_place(run, element);
        let slope = place.map_or(0.0, |place| self.pressing_now(run)[place].jet.slope);
        let rest = run.stuck.iter().copied().filter(|&stuck| stuck != element).collect();
        self.hold(run, rest)?;
        // The clearance grows like `D |lambda'| t^3/6`: until it is out of the margin rounding would decide.
        let margin = self.bounds(&run.state, element, self.stretch.duration()).margin;
        let cubic = (6.0 * CHATTER * margin / (self.mobility_in_free(element) * slope.abs())).cbrt();
        // Where another stop has taken over, it grows like `|r''| t^2/2`.
        let away = -self.jet_with_forces(run, element).curvature;
        let quadratic = (2.0 * CHATTER * margin / away.max(0.0)).sqrt();
        let wait = cubic.min(quadratic);
        run.lifted = Some((element, run.time + wait.min(1e-3 * self.stretch.duration())));
        Ok(())
    }

    fn mobility_in_free(&self, element: usize) -> f64 {
        self.system.elements()[element].shape.iter().map(|phi| phi * phi).sum()
    }

    /// Whether a touch beside held stops is so slow that the impacts with which they would throw one another off, to and fro, are at their end: then all are held, as far as they press.
    pub(super) fn comes_to_rest_beside_others(&self, run: &Run, element: usize) -> bool {
        let before = self.jet_with_forces(run, element);
        let margin = self.bounds(&run.state, element, self.stretch.duration()).margin;
        !run.stuck.is_empty()
            && before.curvature > 0.0
            && before.slope.powi(2) <= 2.0 * before.curvature * CHATTER * margin
    }

    /// Lets held stops go that an impact on an element would pull, the strongest first.
    pub(super) fn let_go_of_pulling(&mut self, run: &mut Run, element: usize) -> Result<(), MotionError> {
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
    pub(super) fn sticks(&self, run: &Run, impact: &Impact) -> bool {
        let (speed, press) = (impact.before.slope.max(0.0), impact.before.curvature);
        let e = impact.restitution;
        let element = impact.touch.element;
        let ClearanceBounds { second, margin, .. } =
            self.bounds(&run.state, element, self.stretch.duration());
        if press <= 0.0 {
            // At rest on the stop with a force that is rounding, it is held: what it presses with then decides.
            let rounding = 8.0 * f64::EPSILON;
            return speed <= rounding * self.speed_bound(&run.state, element) && press >= -rounding * second;
        }
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

    /// `r''` of an element after a time of flight from now, in which forces that act follow the displacements alone.
    fn press_after(&self, run: &Run, element: usize, time: f64) -> f64 {
        let mut state = run.state.clone();
        self.blocks.carry(&mut state, time);
        self.jet_from(run, &state, element, run.time + time).curvature
    }

    /// Holds the element from now on.
    pub(super) fn stick(&mut self, run: &mut Run, impact: &Impact) -> Result<(), MotionError> {
        let element = impact.touch.element;
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
            let pressing = self.pressing_forces(run, &run.state, run.time);
            let weakest = run.stuck.iter().copied().min_by(|&a, &b| pressing[a].total_cmp(&pressing[b]));
            let Some(element) = weakest.filter(|&element| pressing[element] < 0.0) else { return Ok(()) };
            self.lift(run, element)?;
        }
        Ok(())
    }

    /// Lets held stops go that would have to pull after a jump of forces or velocities that comes `-dr/speed` later for a neighbour, the strongest first.
    pub(super) fn throw_off(
        &mut self,
        run: &mut Run,
        displacement: &[f64],
        speed: f64,
    ) -> Result<(), MotionError> {
        loop {
            let pressing = self.pressing_now(run);
            let weakest =
                pressing.iter().zip(&run.stuck).min_by(|a, b| a.0.jet.value.total_cmp(&b.0.jet.value));
            let Some((pressing, &element)) = weakest.filter(|(p, _)| p.jet.value < -p.margin) else {
                return Ok(());
            };
            let force = pressing.jet.value;
            self.lift(run, element)?;
            if let Some(sensitivity) = &mut run.sensitivity {
                sensitivity.add_outer(&self.inputs[element], force / speed, displacement);
            }
        }
    }

    /// `V - (A B + sum_e B_e f_v,e G_e) dr/D`: what an impact without restitution leaves besides the projection.
    fn forget_the_approach(&mut self, run: &mut Run, touch: Touch) {
        if run.sensitivity.is_none() {
            return;
        }
        let displacement = self.displacement_sensitivity(run, touch);
        let input = &self.inputs[touch.element];
        let carried = self.blocks.system_times_column(input);
        let factor = -1.0 / self.mobility[touch.element][touch.element];
        let damped =
            (0..self.laws.len()).filter(|&e| self.acts(run, e) && self.laws[e].depends_on_velocity());
        let by_velocity: Vec<(usize, f64)> = damped
            .map(|e| {
                let jet = self.output_jet(&run.state, e, run.time);
                let damping = self.laws[e].pressing_force(jet.value, jet.slope).damping;
                (e, damping * self.mobility[e][touch.element])
            })
            .collect();
        let Some(sensitivity) = &mut run.sensitivity else { return };
        sensitivity.add_outer(&carried, factor, &displacement);
        for (e, gain) in by_velocity {
            sensitivity.add_outer(&self.inputs[e], factor * gain, &displacement);
        }
    }
}

/// The elements with one more, ascending.
fn joined(elements: &[usize], element: usize) -> Vec<usize> {
    let mut joined: Vec<usize> = elements.iter().copied().chain([element]).collect();
    joined.sort_unstable();
    joined.dedup();
    joined
}
