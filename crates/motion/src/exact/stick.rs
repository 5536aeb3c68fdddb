//! Rigid stops that stick, and how they let go.
//!
//! **Going over.** An impact without restitution, or a chatter that comes to its end, leaves the structure
//! held (`held.rs`) if it is pressed on behind the impact: there, as dampers have lost the speed that the
//! impact took, `r''` is not lower than before, as long as the same stops are held. With the rates `h` of the
//! state a neighbour, who comes `dt = -dr/v` later, has `V+ = V + (h_before - h_behind) dt` besides what the
//! projection takes, and since the velocities jump by `B P`, `P = -v/D`,
//!
//! `V+ = V - A B dr/D + (sum_e B_e [F_e] + sum_j B_j lambda_j) dr/v`,
//!
//! where `[F_e]` are the jumps of forces that depend on the velocity (`velocity_jump.rs`), and `lambda_j` is
//! what held stops pressed with that the impact throws off. As v goes to zero `[F_e]/v` keeps its value
//! `-f_v,e G_e/D`, `G_e = C_e A B`, so the end of a chatter is no exception; a stop that sticks at the start
//! of a stretch has this limit alone.
//!
//! **Letting go** where the pressing force vanishes continuously changes nothing in the sensitivities. Where
//! it falls to `lambda_j < 0` by a jump, at a touch or an impact, whether that sticks or not, that comes
//! `dt = -dr/v` later for a neighbour, the stop presses no more from then on, and
//! `V+ = V + B_j lambda_j dr/v`.
//!
//! Forces of other elements act through all of it: they are in the acceleration that presses, and in the
//! pressing forces (`pressing.rs`).

use super::{
    ExactIntegrator, MotionError,
    clearance::ClearanceBounds,
    contact_phase::AT_REST,
    flight::{Boundary, Touch},
    impact::Impact,
    run::{Left, Run},
};

/// Height of a bounce, in rounding margins of the clearance, below which it sticks.
const CHATTER: f64 = 1e3;
/// How long a brief hop takes at most [cycles]. Its height is about 6e-12 of the motion then, some thousand
/// rounding margins.
const BRIEF_HOP: f64 = 1e-4;
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
                let displacement = self.displacement_sensitivity(run, touch);
                self.forget_the_approach(run, touch, &displacement);
                self.forget_damped_approach(run, touch, &displacement);
                self.contraction = f64::NEG_INFINITY;
                let elements = joined(&run.stuck, element);
                self.hold(run, elements)?;
            }
        }
        self.let_go_of_tension(run, None)
    }

    /// Lets a held stop go whose pressing force has come to its end.
    pub(super) fn lift(&mut self, run: &mut Run, element: usize) -> Result<(), MotionError> {
        let place = self.held_place(run, element);
        let slope = place.map_or(0.0, |place| self.pressing_now(run)[place].jet.slope);
        let rest = run.stuck.iter().copied().filter(|&stuck| stuck != element).collect();
        self.hold(run, rest)?;
        self.look_past(run, element, Some(self.mobility_in_free(element) * slope.abs()));
        Ok(())
    }

    /// A stop that is left without speed is not looked at until the clearance is out of the margin, within
    /// which rounding would decide.
    ///
    /// * `third`: `|r'''|` where it is known, as `D |lambda'|` where the pressing force ends; else its
    ///   bound is taken [m/s^3].
    pub(super) fn look_past(&self, run: &mut Run, element: usize, third: Option<f64>) {
        // The clearance grows like `|r'''| t^3/6`,
        let bounds = self.bounds(&run.state, element, self.stretch.duration());
        let margin = bounds.margin;
        let cubic = (6.0 * CHATTER * margin / third.unwrap_or(bounds.third)).cbrt();
        // or, behind an impact or where another stop has taken over, like `|r''| t^2/2`.
        let away = -self.jet_with_forces(run, element).curvature;
        let quadratic = (2.0 * CHATTER * margin / away.max(0.0)).sqrt();
        let wait = cubic.min(quadratic);
        let until = run.time + wait.min(1e-3 * self.stretch.duration());
        let briefly = !self.laws[element].chatters() && self.hops_briefly(run, element);
        run.left[element] = Left { at: run.time, until, briefly };
    }

    /// Whether an element that moves off its stop without speed is pressed on again at once. What presses
    /// says so, to all digits: with `r'' = -a + j t`, behind an impact, it comes back after `3 a/j`; with
    /// `r'' = -b t + c t^2/2`, where it was let go, after `4 b/c`, two thirds of that. When it does so is
    /// known less well, since it comes slowly.
    fn hops_briefly(&self, run: &Run, element: usize) -> bool {
        self.press_after(run, element, BRIEF_HOP / (3.0 * self.stretch.frequency_hz)) > 0.0
    }

    /// Whether a touch is the end of such a hop. Its contact is taken to have gone on: where what presses on
    /// a stop that gives nothing back vanishes for an instant it opens by next to nothing, and rounding says
    /// whether at all, while the motion goes on smoothly.
    pub(super) fn ends_a_brief_hop(&self, run: &Run, element: usize) -> bool {
        let away = run.time - run.left[element].at;
        run.left[element].briefly && away * self.stretch.frequency_hz < 10.0 * BRIEF_HOP
    }

    fn mobility_in_free(&self, element: usize) -> f64 {
        self.system.elements()[element].shape.iter().map(|phi| phi * phi).sum()
    }

    /// Whether a touch beside held stops is so slow that the impacts with which they would throw one another
    /// off, to and fro, are at their end: then all are held, as far as they press.
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
    pub(super) fn sticks(&self, run: &mut Run, impact: &Impact) -> bool {
        let (speed, press) = (impact.before.slope.max(0.0), impact.before.curvature);
        let e = impact.restitution;
        let element = impact.touch.element;
        let ClearanceBounds { second, margin, .. } =
            self.bounds(&run.state, element, self.stretch.duration());
        if self.is_at_rest(run, element, speed) && press <= 0.0 {
            // With a force that is rounding it is held: what it presses with then decides.
            return press >= -AT_REST * second;
        }
        if e == 0.0 {
            return self.press_behind(run, impact) > 0.0;
        }
        if press <= 0.0 {
            return false;
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

    /// Whether a speed is rounding.
    fn is_at_rest(&self, run: &Run, element: usize, speed: f64) -> bool {
        speed <= AT_REST * self.speed_bound(&run.state, element)
    }

    /// `r''` of an element after a time of flight from now, in which forces that act follow the displacements
    /// alone.
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
        if self.laws[element].chatters() {
            let place = self.first_touch(element);
            self.touches[place] = self.touches[place].saturating_add(STUCK_TOUCHES);
        }
        self.contraction = f64::NEG_INFINITY;
        let displacement = self.displacement_sensitivity(run, impact.touch);
        self.forget_the_approach(run, impact.touch, &displacement);
        let moves = !self.is_at_rest(run, element, speed);
        if moves {
            self.jump_with_stops(run, impact, &displacement);
            let jumps = self.jump_velocities(run, impact, -speed / impact.mobility);
            self.jump_with_forces(run, &jumps, &displacement);
        } else {
            self.forget_damped_approach(run, impact.touch, &displacement);
        }
        let elements = joined(&run.stuck, element);
        self.hold(run, elements)?;
        self.let_go_of_tension(run, moves.then_some((&displacement, speed)))
    }

    /// Lets held stops go that would have to pull, now that another one is held, too, by an impact with this
    /// speed; the strongest first.
    fn let_go_of_tension(&mut self, run: &mut Run, impact: Option<(&[f64], f64)>) -> Result<(), MotionError> {
        while run.stuck.len() > 1 {
            let pressing = self.pressing_forces(run, &run.state, run.time);
            let weakest = run.stuck.iter().copied().min_by(|&a, &b| pressing[a].total_cmp(&pressing[b]));
            let Some(element) = weakest.filter(|&element| pressing[element] < 0.0) else { return Ok(()) };
            self.lift(run, element)?;
            if let Some((sensitivity, (displacement, speed))) = run.sensitivity.as_mut().zip(impact) {
                sensitivity.add_outer(&self.inputs[element], pressing[element] / speed, displacement);
            }
        }
        Ok(())
    }

    /// Lets held stops go that would have to pull after a jump of forces or velocities that comes `-dr/speed`
    /// later for a neighbour, the strongest first.
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

    /// `V - A B dr/D`.
    fn forget_the_approach(&self, run: &mut Run, touch: Touch, displacement: &[f64]) {
        let Some(sensitivity) = &mut run.sensitivity else { return };
        let carried = self.blocks.system_times_column(&self.inputs[touch.element]);
        let factor = -1.0 / self.mobility[touch.element][touch.element];
        sensitivity.add_outer(&carried, factor, displacement);
    }

    /// `V - sum_e B_e f_v,e G_e dr/D`: the jumps of forces in the limit of no speed.
    fn forget_damped_approach(&self, run: &mut Run, touch: Touch, displacement: &[f64]) {
        let hit = touch.element;
        let damped =
            (0..self.laws.len()).filter(|&e| self.acts(run, e) && self.laws[e].depends_on_velocity());
        let jump = |e: usize| {
            let jet = self.output_jet(&run.state, e, run.time);
            let damping = self.laws[e].pressing_force(jet.value, jet.slope).damping;
            (e, -damping * self.mobility[e][hit] / self.mobility[hit][hit])
        };
        let jumps: Vec<(usize, f64)> = damped.map(jump).collect();
        self.jump_with_forces(run, &jumps, displacement);
    }
}

/// The elements with one more, ascending.
fn joined(elements: &[usize], element: usize) -> Vec<usize> {
    let mut joined: Vec<usize> = elements.iter().copied().chain([element]).collect();
    joined.sort_unstable();
    joined.dedup();
    joined
}
