//! A rigid stop that sticks: at the start of a motion, by an impact without restitution, at the end of a
//! chatter.
//!
//! What the motion was relative to the stop is projected out, of the state and of the sensitivities. Besides,
//! with the jump `psi P`, `P = -v/D`, of the velocities, a neighbour who comes `dx = -dr/(v T)` later has
//! `(h_before - h_behind) dx` (`rigid.rs`), which is
//!
//! `C psi dr/D + (sum_e phi_e [F_e] + sum_j psi_j lambda_j) dr/v`:
//!
//! the dampers of the structure, the forces that jump with the velocities, and what held stops pressed with
//! that the impact throws off. Where a law presses before and behind the impact, `[F_e]/v = -f_v,e (phi_e .
//! psi)/D` with the mean of `f_v,e` between both velocities, and that is its limit as v goes to zero, too.
//! Where its pressure ends or begins with the jump the quotient is taken. Stops that would have to pull
//! behind the impact are let go as after any other (`thrown_off.rs`).

use super::{
    Point,
    stops::{AT_REST, AT_START, Impact},
    system_field::{SystemField, region::switches_of},
};
use crate::vectors::{add_scaled, dot};

/// Force of an element, with its relative displacement and velocity; `None` where the law does not depend on
/// that velocity, or does not press.
type VelocityForce = Option<(f64, [f64; 2])>;

impl SystemField<'_> {
    /// At the start of a motion: stops that stick are held, none is behind.
    pub(super) fn begin_rigid(
        &mut self,
        time: f64,
        state: &mut [f64],
        columns: &mut [f64],
        inside: &mut [bool],
    ) {
        for &(_, switch) in &self.rigid.stops {
            inside[switch] = false;
        }
        for (e, switch) in self.rigid.stops.clone() {
            if self.rests(e) {
                continue;
            }
            let [r, speed, press] = self.relative(e, Point { time, state, inside });
            let level = self.laws[e].contacts()[0].level;
            let way = AT_START * self.usual_speed(e, state) * self.period;
            if (r - level).abs() <= way && press > 0.0 && speed * speed <= 2.0 * press * way {
                let forces = self.velocity_forces(time, state, inside);
                let jumps = self.jumps((e, 0.0), &forces, &forces);
                self.hold(e, &jumps, time, (state, columns));
                inside[switch] = true;
            }
        }
    }

    /// Takes the speed of an impact from the velocities, and turns the pressures that depend on them.
    pub(super) fn take_speed(
        &self,
        (e, speed): (usize, f64),
        time: f64,
        state: &mut [f64],
        inside: &mut [bool],
    ) {
        let n = self.system.dof();
        let direction = self.free_direction(e);
        let mobility = dot(&self.system.elements()[e].shape, &direction);
        add_scaled(&mut state[n..], -speed / mobility, &direction);
        self.turn_pressures(time, state, inside);
    }

    /// An impact on an element that is held from then on; `thrown_off` are stops that it has thrown off, with
    /// what they pressed with.
    pub(super) fn strike_and_stick(
        &mut self,
        (e, speed): (usize, f64),
        thrown_off: &[(usize, f64)],
        time: f64,
        (state, columns): (&mut [f64], &mut [f64]),
        inside: &mut [bool],
    ) {
        let mobility = dot(&self.system.elements()[e].shape, &self.free_direction(e));
        let impulse = speed.max(0.0) / mobility;
        self.rigid.impacts.push(Impact { element: e, speed, impulse, sticks: true, depth: f64::INFINITY });
        let before = self.velocity_forces(time, state, inside);
        if speed <= AT_REST * self.usual_speed(e, state) {
            let jumps = self.jumps((e, 0.0), &before, &before);
            return self.hold(e, &jumps, time, (state, columns));
        }
        let delays = self.delays((e, speed), time, columns);
        self.take_speed((e, speed), time, state, inside);
        let behind = self.velocity_forces(time, state, inside);
        let jumps = self.jumps((e, speed), &before, &behind);
        for &stop in thrown_off {
            self.throw_off(stop, columns, &delays);
        }
        self.hold(e, &jumps, time, (state, columns));
        self.let_go_of_tension(time, (state, columns), inside, &delays);
    }

    /// How much later an impact on an element comes, for each column [s].
    fn delays(&self, (e, speed): (usize, f64), time: f64, columns: &[f64]) -> Vec<f64> {
        let n = self.system.dof();
        let (shape, last) = (&self.system.elements()[e].shape, columns.len() / (2 * n));
        let delay = |(index, column): (usize, &[f64])| {
            let moved = self.support_change(e, time, index + 1 == last)[0];
            -(dot(shape, &column[..n]) + moved) / speed
        };
        columns.chunks_exact(2 * n).enumerate().map(delay).collect()
    }

    /// The forces of all elements that depend on the velocity.
    fn velocity_forces(&self, time: f64, state: &[f64], inside: &[bool]) -> Vec<VelocityForce> {
        let n = self.system.dof();
        let mut flags = inside;
        let of_element = |(law, element): (&crate::Law, &crate::LocalElement)| {
            let (region, rest) = flags.split_at(switches_of(element));
            flags = rest;
            let presses = law.depends_on_velocity() && region.iter().all(|inside| *inside);
            presses.then(|| {
                let u = self.carried(&element.support_ratios, time);
                let r = dot(&element.shape, &state[..n]) + u[0];
                let velocity = dot(&element.shape, &state[n..]) + u[1];
                (law.pressing_force(r, velocity).value, [r, velocity])
            })
        };
        self.laws.iter().zip(self.system.elements()).map(of_element).collect()
    }

    /// `[F_e]/v` of every element at an impact that takes the speed v of one of them, from the forces before
    /// it and behind.
    fn jumps(
        &self,
        (e, speed): (usize, f64),
        before: &[VelocityForce],
        behind: &[VelocityForce],
    ) -> Vec<f64> {
        let direction = self.free_direction(e);
        let mobility = dot(&self.system.elements()[e].shape, &direction);
        let jump = |e: usize| match (before[e], behind[e]) {
            (None, None) => 0.0,
            (Some((_, [r, before])), Some((_, [_, behind]))) => {
                let damping = self.laws[e].mean_damping(r, [before, behind]);
                -damping * dot(&self.system.elements()[e].shape, &direction) / mobility
            }
            (Some((force, _)), None) => -force / speed,
            (None, Some((force, _))) => force / speed,
        };
        (0..before.len()).map(jump).collect()
    }

    /// Holds an element: `r` is its level and `r'` zero from now on. `jumps` are the `[F_e]/v` of all
    /// elements.
    fn hold(&mut self, e: usize, jumps: &[f64], time: f64, (state, columns): (&mut [f64], &mut [f64])) {
        let n = self.system.dof();
        let direction = self.free_direction(e);
        let shape = self.system.elements()[e].shape.clone();
        let mut jump = self.damped(&direction);
        let mobility = dot(&shape, &direction);
        jump.iter_mut().for_each(|entry| *entry /= mobility);
        for (element, factor) in self.system.elements().iter().zip(jumps) {
            add_scaled(&mut jump, *factor, &element.shape);
        }
        self.add_held(e);
        let held = self.rigid.held.clone();
        let carried = |h: usize| self.carried(&self.system.elements()[h].support_ratios, time);
        let levels: Vec<f64> =
            held.iter().map(|&h| self.laws[h].contacts()[0].level - carried(h)[0]).collect();
        let speeds: Vec<f64> = held.iter().map(|&h| -carried(h)[1]).collect();
        self.constrain(&held, &levels, &mut state[..n]);
        self.constrain(&held, &speeds, &mut state[n..]);
        let last = columns.len() / (2 * n);
        for (index, column) in columns.chunks_exact_mut(2 * n).enumerate() {
            let of_frequency = index + 1 == last;
            let displacement = dot(&shape, &column[..n]) + self.support_change(e, time, of_frequency)[0];
            add_scaled(&mut column[n..], displacement, &jump);
            let of = |k: usize| -> Vec<f64> {
                held.iter().map(|&h| -self.support_change(h, time, of_frequency)[k]).collect()
            };
            let (displacements, velocities) = (of(0), of(1));
            self.constrain(&held, &displacements, &mut column[..n]);
            self.constrain(&held, &velocities, &mut column[n..]);
        }
    }
}
