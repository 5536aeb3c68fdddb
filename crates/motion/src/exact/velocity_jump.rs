//! What the jump of the velocities at an impact does to forces that depend on them.
//!
//! An impact with the impulse P takes the relative velocity of an element e from `r_e'` to `r_e' + G_e P`,
//! with `G_e = C_e A B`, and its force jumps by `[F_e]`. A neighbour comes `dt = -dr/v` later, and for so
//! long has the force before the impact in place of the one behind it: `V+ = V + sum_e B_e [F_e] dr/v`.
//!
//! **Pressure.** Every law of a contact is linear in the velocity while it presses. Where one presses before
//! and behind the impact, `[F_e] = f_v,e G_e P`, and since P is proportional to v the quotient `[F_e]/v` does
//! not depend on the speed: it is taken so, and keeps its digits as `v -> 0`. A formula that always acts need
//! not be linear; of it `f_v,e` is the mean between both velocities. Where the jump ends the pressure or
//! begins it, one of both forces is zero and the other one is pressure that the jump of velocity takes or
//! gives: `[F_e]/v` lies between zero and `f_v,e G_e P/v`, and is computed as it stands.

use super::{
    ExactIntegrator,
    flight::{Boundary, Touch},
    impact::Impact,
    run::Run,
};

/// An element and its force, `None` where it does not press.
type VelocityForce = (usize, Option<f64>);

impl ExactIntegrator {
    /// Lets the velocities jump by an impulse on the element that is hit, and the pressures with them;
    /// `[F_e]/v` of each force that jumps, v the speed of the impact.
    pub(super) fn jump_velocities(&self, run: &mut Run, impact: &Impact, impulse: f64) -> Vec<(usize, f64)> {
        let hit = impact.touch.element;
        let before = self.velocity_forces(run);
        run.state.iter_mut().zip(&self.inputs[hit]).for_each(|(x, b)| *x += impulse * b);
        self.turn_pressures(run);
        let speed = impact.before.slope;
        let of_element = |((e, before), (_, behind)): (&VelocityForce, &VelocityForce)| {
            let jump = match (*before, *behind) {
                (None, None) => 0.0,
                (Some(_), Some(_)) => {
                    let jet = self.output_jet(&run.state, *e, run.time);
                    let before = jet.slope - self.mobility[*e][hit] * impulse;
                    let damping = self.laws[*e].mean_damping(jet.value, [before, jet.slope]);
                    damping * self.mobility[*e][hit] * (impulse / speed)
                }
                (before, behind) => (behind.unwrap_or(0.0) - before.unwrap_or(0.0)) / speed,
            };
            (*e, jump)
        };
        before.iter().zip(&self.velocity_forces(run)).map(of_element).collect()
    }

    /// `r''` of the element that is hit behind an impact that leaves it no speed.
    pub(super) fn press_behind(&self, run: &mut Run, impact: &Impact) -> f64 {
        let before = (run.state.clone(), run.closed.clone(), run.parted.clone());
        self.jump_velocities(run, impact, -impact.before.slope / impact.mobility);
        let press = self.jet_with_forces(run, impact.touch.element).curvature;
        (run.state, run.closed, run.parted) = before;
        press
    }

    /// Contacts that press only while their pressure is positive part, or press again.
    fn turn_pressures(&self, run: &mut Run) {
        for element in 0..self.laws.len() {
            let contact = run.closed[element].or(run.parted[element]);
            let Some(contact) = contact.filter(|_| self.laws[element].has_pressure()) else {
                continue;
            };
            let touch = Touch { element, contact, boundary: Boundary::Presses };
            let missing = self.distance(self.output_jet(&run.state, element, run.time), touch).value;
            run.closed[element] = Some(contact).filter(|_| missing < 0.0);
            run.parted[element] = Some(contact).filter(|_| missing >= 0.0);
        }
    }

    /// Forces that depend on the velocity, of what acts or is parted; `None` where it does not press.
    fn velocity_forces(&self, run: &Run) -> Vec<VelocityForce> {
        let within = |e: usize| self.acts(run, e) || run.parted[e].is_some();
        let damped = (0..self.laws.len()).filter(|&e| within(e) && self.laws[e].depends_on_velocity());
        let force = |e: usize| {
            let jet = self.output_jet(&run.state, e, run.time);
            self.acts(run, e).then(|| self.laws[e].pressing_force(jet.value, jet.slope).value)
        };
        damped.map(|e| (e, force(e))).collect()
    }
}
