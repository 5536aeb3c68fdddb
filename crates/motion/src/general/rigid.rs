//! Rigid stops in the vector field of a system: impacts, and the contact that sticks.
//!
//! Everything is at a fixed phase x, so `dr = phi . dq`, and `dr' = phi . dv` but for the column of the
//! frequency, where `s u'/f` is added; `s u` is the sum over the supports.
//!
//! - An impact takes v to `v + psi P`, `P = -(1 + e) r'/(phi . psi)`, with `psi = phi - Phi D^-1 Phi^T phi`
//!   where other stops Phi are held. With the rates `h` of the state by the phase and the delay `dx = -dr/(r'
//!   T)`, `dz+ = dz + [0; psi] dP + (h_before - h_after) dx`, `dP = -(1 + e)/(phi . psi) (dr' + r'' T dx)`.
//!   The jump of a velocity may begin or end the pressure of contacts that depend on it: those of the motion
//!   after it are in `h_after`.
//! - A stop that sticks (`stick.rs`) is an acceleration constraint: `lambda = D^-1 (Phi^T g + s u'')` is
//!   taken from the rates g of the velocities, forces of other elements included, and from their derivatives.
//!   Its switching function is `lambda_j` itself.
//! - A stop whose `lambda_j` falls below zero by a jump is let go then (`thrown_off.rs`).
//! - Other contacts of the same place rest as long as a stop is held (`resting.rs`).
//! - Chatter is followed until the height of the next bounce is below 1e-12 of what the fastest impact would
//!   go in a period.
//!
//! It is the same mechanics as in [`exact`](crate::exact), by other means: no held structure is made, no
//! flight is known, and impacts are zeros of dense output.

use faer::{Mat, linalg::solvers::Solve};

use super::{
    Point, VectorField,
    stops::{AT_REST, Impact},
    system_field::{SystemField, region::switches_of},
};
use crate::vectors::{add_scaled, dot};

/// Height of a bounce, relative to the way of the fastest impact in a period, below which it sticks.
const CHATTER: f64 = 1e-12;
/// What a state that leaves a stop may be beyond it, relative to the same: as far as orbits are compared.
const LEAVING: f64 = 1e-9;

impl SystemField<'_> {
    /// `D^-1 right` for the held elements.
    fn solve_held(&self, held: &[usize], right: &[f64]) -> Vec<f64> {
        let shape = |j: usize| &self.system.elements()[held[j]].shape;
        let s = held.len();
        let gram = Mat::from_fn(s, s, |j, k| dot(shape(j), shape(k)));
        let right = Mat::from_fn(s, 1, |j, _| right[j]);
        let solved = gram.partial_piv_lu().solve(&right);
        (0..s).map(|j| solved[(j, 0)]).collect()
    }

    /// Takes from a vector over the modes what lies along held shapes, so that `phi_j . vector = targets_j`;
    /// gives `D^-1 (Phi^T vector - targets)`.
    pub(super) fn constrain(&self, held: &[usize], targets: &[f64], vector: &mut [f64]) -> Vec<f64> {
        let shape = |e: usize| &self.system.elements()[e].shape;
        let excess: Vec<f64> = held.iter().zip(targets).map(|(&e, t)| dot(shape(e), vector) - t).collect();
        let forces = self.solve_held(held, &excess);
        for (&e, force) in held.iter().zip(&forces) {
            add_scaled(vector, -force, shape(e));
        }
        forces
    }

    /// Holds the rates of the velocities: `phi_j . g = -s_j . u''`, with rates by the phase.
    pub(super) fn hold_rates(&self, phase: f64, rate: &mut [f64]) {
        let held = &self.rigid.held;
        if held.is_empty() {
            return;
        }
        let carried = |e: usize| self.carried(&self.system.elements()[e].support_ratios, phase)[2];
        let targets: Vec<f64> = held.iter().map(|&e| -self.period * carried(e)).collect();
        self.constrain(held, &targets, rate);
    }

    /// The same for the derivatives by the state.
    pub(super) fn hold_tangent(&self, rate: &mut [f64]) {
        let held = &self.rigid.held;
        if !held.is_empty() {
            self.constrain(held, &vec![0.0; held.len()], rate);
        }
    }

    /// The same for what the frequency changes at a fixed state and phase.
    pub(super) fn hold_by_frequency(&self, phase: f64, change: &mut [f64]) {
        let held = &self.rigid.held;
        if held.is_empty() {
            return;
        }
        let ratios = |e: usize| &self.system.elements()[e].support_ratios;
        let carried = |e: usize| self.carried_by_frequency(ratios(e), phase)[2];
        let targets: Vec<f64> = held.iter().map(|&e| -self.period * carried(e)).collect();
        self.constrain(held, &targets, change);
    }

    /// Pressing forces of all elements, zero for those that are not held [N].
    pub(super) fn pressing_forces(&self, phase: f64, state: &[f64], inside: &[bool]) -> Vec<f64> {
        let mut pressing = vec![0.0; self.system.elements().len()];
        let held = &self.rigid.held;
        if held.is_empty() {
            return pressing;
        }
        let n = self.system.dof();
        let mut rate = self.linear_acceleration(phase, state);
        self.add_forces_in_region(Point { time: phase, state, inside }, &mut rate[n..]);
        let carried = |e: usize| self.carried(&self.system.elements()[e].support_ratios, phase)[2];
        let targets: Vec<f64> = held.iter().map(|&e| -carried(e)).collect();
        let mut moved = rate[n..].to_vec();
        let forces = self.constrain(held, &targets, &mut moved);
        held.iter().zip(forces).for_each(|(&e, force)| pressing[e] = force);
        pressing
    }

    /// `[r, r', r'']` of an element in the region that is told.
    pub(super) fn relative(&mut self, e: usize, at: Point<'_>) -> [f64; 3] {
        let n = self.system.dof();
        let mut rates = vec![0.0; 2 * n];
        self.evaluate(at, &mut rates);
        let element = &self.system.elements()[e];
        let u = self.carried(&element.support_ratios, at.time);
        [
            dot(&element.shape, &at.state[..n]) + u[0],
            dot(&element.shape, &at.state[n..]) + u[1],
            dot(&element.shape, &rates[n..]) / self.period + u[2],
        ]
    }

    /// Speed against which those of an element are small: of the fastest impact, and of its parts now.
    pub(super) fn usual_speed(&self, e: usize, state: &[f64]) -> f64 {
        let n = self.system.dof();
        let (shape, w) = (&self.system.elements()[e].shape, &self.system.model().natural_frequencies);
        let part = |i: usize| shape[i].abs() * (state[n + i].abs() + w[i] * state[i].abs());
        (0..n).map(part).sum::<f64>().max(self.rigid.fastest)
    }

    /// What happens to rigid stops as boundaries are crossed.
    pub(super) fn cross_rigid(
        &mut self,
        time: f64,
        (state, columns): (&mut [f64], &mut [f64]),
        (inside, before): (&mut [bool], &[bool]),
    ) {
        for (e, switch) in self.rigid.stops.clone() {
            if before[switch] && !inside[switch] {
                self.release(e, inside);
            }
        }
        self.meet_companions(inside, before);
        for (e, switch) in self.rigid.stops.clone() {
            if !before[switch] && inside[switch] && !self.rests(e) {
                self.open_companions(e, time, state, (inside, before));
            }
        }
        self.throw_off_by_dampers(time, (state, columns), (inside, before));
        for (e, switch) in self.rigid.stops.clone() {
            if before[switch] || !inside[switch] {
                continue;
            }
            inside[switch] = false;
            if self.rests(e) {
                continue;
            }
            self.meet((e, switch), time, (state, columns), inside);
        }
    }

    /// Meets a rigid stop.
    fn meet(
        &mut self,
        (e, switch): (usize, usize),
        time: f64,
        (state, columns): (&mut [f64], &mut [f64]),
        inside: &mut [bool],
    ) {
        let mut before_it = vec![0.0; state.len()];
        self.evaluate(Point { time, state, inside }, &mut before_it);
        let [_, speed, press] = self.relative(e, Point { time, state, inside });
        let approach = press;
        let pressing = self.pressing_forces(time, state, inside);
        let held = self.rigid.held.clone();
        let way = CHATTER * self.usual_speed(e, state) * self.period;
        if self.rigid.held.is_empty() || press <= 0.0 || speed * speed > 2.0 * press * way {
            self.let_go_of_pulling(e, inside);
        }
        let [_, speed, press] = self.relative(e, Point { time, state, inside });
        self.rigid.fastest = self.rigid.fastest.max(speed);
        let restitution = self.laws[e].rigid().map_or(0.0, crate::law::RigidStop::restitution);
        if self.sticks((e, restitution), (speed, press), time, (state, inside)) {
            let thrown_off = held.into_iter().filter(|stop| !self.rigid.held.contains(stop));
            let thrown_off: Vec<_> = thrown_off.map(|stop| (stop, pressing[stop])).collect();
            inside[switch] = true;
            self.strike_and_stick((e, speed), &thrown_off, time, (state, columns), inside);
        } else if speed > 0.0 {
            self.rebound((e, restitution, approach), time, (state, columns), (inside, &before_it));
        } else {
            self.put_before(e, time, state);
        }
    }

    /// Moves an element that leaves its stop to before it, if it is no farther beyond than orbits
    /// are known, or than it has drifted while it was held. A stop that is left without speed would be
    /// met again with each next step else.
    fn put_before(&self, e: usize, time: f64, state: &mut [f64]) {
        let n = self.system.dof();
        let element = &self.system.elements()[e];
        let level = self.laws[e].contacts()[0].level;
        let parts = element.shape.iter().zip(&state[..n]).map(|(shape, q)| (shape * q).abs());
        let carried = self.carried(&element.support_ratios, time)[0].abs();
        let rounding = AT_REST * parts.fold(level.abs() + carried, |sum, part| sum + part);
        let beyond = self.relative_displacement(element, &state[..n], time) - level;
        let way = LEAVING * self.usual_speed(e, state) * self.period;
        if (-rounding..way).contains(&beyond) {
            let direction = self.free_direction(e);
            let back = (beyond + rounding) / dot(&element.shape, &direction);
            add_scaled(&mut state[..n], -back, &direction);
        }
    }

    /// Whether an impact is the end of a chatter, or without restitution and pressed on behind it, where
    /// dampers have lost the speed that it took.
    fn sticks(
        &mut self,
        (e, restitution): (usize, f64),
        (speed, press): (f64, f64),
        time: f64,
        (state, inside): (&[f64], &[bool]),
    ) -> bool {
        if restitution == 0.0 && speed > 0.0 {
            let (mut behind, mut region) = (state.to_vec(), inside.to_vec());
            self.take_speed((e, speed), time, &mut behind, &mut region);
            return self.relative(e, Point { time, state: &behind, inside: &region })[2] > 0.0;
        }
        if speed < -AT_REST * self.usual_speed(e, state) {
            // Another stop of its place has turned the speed round.
            return false;
        }
        let height = (restitution * speed).powi(2) / (2.0 * press);
        press > 0.0 && height <= CHATTER * self.usual_speed(e, state) * self.period
    }

    /// `psi`: the shape of an element less what held stops take of it.
    pub(super) fn free_direction(&self, e: usize) -> Vec<f64> {
        let mut direction = self.system.elements()[e].shape.clone();
        let held = &self.rigid.held;
        if !held.is_empty() {
            self.constrain(held, &vec![0.0; held.len()], &mut direction);
        }
        direction
    }

    /// An impact on an element, with `r''` and the rates of the motion before it.
    fn rebound(
        &mut self,
        (e, restitution, approach): (usize, f64, f64),
        time: f64,
        (state, columns): (&mut [f64], &mut [f64]),
        (inside, before): (&mut [bool], &[f64]),
    ) {
        let n = self.system.dof();
        let mut delays = Vec::new();
        let mut after = vec![0.0; 2 * n];
        let [_, speed, press] = self.relative(e, Point { time, state, inside });
        let direction = self.free_direction(e);
        let shape = self.system.elements()[e].shape.clone();
        let factor = -(1.0 + restitution) / dot(&shape, &direction);
        add_scaled(&mut state[n..], factor * speed, &direction);
        self.turn_pressures(time, state, inside);
        self.evaluate(Point { time, state, inside }, &mut after);
        let depth = if press < 0.0 { -0.5 * speed * speed / press } else { f64::INFINITY };
        self.rigid.impacts.push(Impact { element: e, speed, impulse: -factor * speed, sticks: false, depth });
        let last = columns.len() / (2 * n);
        for (index, column) in columns.chunks_exact_mut(2 * n).enumerate() {
            let [moved, rate] = self.support_change(e, time, index + 1 == last);
            let displacement = dot(&shape, &column[..n]) + moved;
            let velocity = dot(&shape, &column[n..]) + rate;
            let delay = -displacement / (speed * self.period);
            delays.push(delay * self.period);
            for i in 0..2 * n {
                column[i] += (before[i] - after[i]) * delay;
            }
            let impulse = factor * (velocity + approach * self.period * delay);
            add_scaled(&mut column[n..], impulse, &direction);
        }
        self.let_go_of_tension(time, (state, columns), inside, &delays);
    }

    /// After a jump of velocities: which contacts press whose force depends on them.
    pub(super) fn turn_pressures(&self, time: f64, state: &[f64], inside: &mut [bool]) {
        let mut values = vec![0.0; inside.len()];
        self.switching(time, state, &mut values);
        let mut end = 0;
        for element in self.system.elements() {
            end += switches_of(element);
            if element.law.has_pressure() {
                inside[end - 1] = values[end - 1] > 0.0;
            }
        }
    }

    /// What the column of the frequency has besides in a relative displacement and velocity.
    pub(super) fn support_change(&self, e: usize, time: f64, of_frequency: bool) -> [f64; 2] {
        if !of_frequency {
            return [0.0; 2];
        }
        let [u, v, _] = self.carried_by_frequency(&self.system.elements()[e].support_ratios, time);
        [u, v]
    }
}
