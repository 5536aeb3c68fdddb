//! The equations of motion of a [`System`] as a vector field over the phase of the excitation.
//!
//! With `W = 2 pi f` and the phase `x = f t` in cycles, `z = [q; v]` and
//!
//! `dz/dx = g / f`, `g = [v; -C v - diag(w^2) q + Re sum_m b_m(W) exp(i 2 pi m x) + sum_e phi_e f_e(r_e)]`.
//!
//! The ends of a stretch are fixed phases, so `d(dz/dx)/df = (dg/df) / f - g / f^2` with `dg/df = [0; 2 pi Re
//! sum_m db_m/dW exp(i 2 pi m x)]` gives the whole derivative by the frequency: nothing is left to add for
//! the duration.
//!
//! A law that depends on the velocity does so on `r' = phi_e . v + s_e . u'`, where `u'` at a fixed phase is
//! proportional to f: `d(u')/df = u'/f`.
//!
//! A hole has the force of `law/round_hole.rs`, with derivatives by both displacements, and its reading takes
//! the place of r.
//!
//! Switching functions are `sign (r - level)`, one for each contact of each element, the same at the kink of
//! a force, and the pressure of a law that depends on the velocity. In contact a law is continued below its
//! level by its tangent there, and each piece of a force beyond its kink; out of contact the force is zero.
//! Where a force sets in with the jump `-c r'`, the touch comes earlier by `dr/r'` and brings the impulse `-c
//! dr`: the sensitivities of the velocities jump by `-c phi_e (phi_e . dq)`.

mod field;
mod onset;
pub(super) mod region;

use std::f64::consts::TAU;

use faer::c64;

use region::{force_in_region, switches_of};

use super::{Point, stops::RigidStops};
use crate::{
    Law, LocalElement, ModalLoad, System,
    law::HoleForce,
    vectors::{add_scaled, dot},
};

/// A system at one frequency.
pub(super) struct SystemField<'a> {
    pub(super) system: &'a System,
    pub(super) period: f64,
    damping: Damping,
    stiffness: Vec<f64>,
    loads: Vec<ModalLoad>,
    switches: usize,
    /// Least modal displacement that counts [kg^1/2 m].
    length: f64,
    /// `exp(i 2 pi m x)` for each order at the last point.
    rotations: Vec<c64>,
    /// Amplitudes of the displacements of the supports, for each order.
    supports: Vec<Vec<c64>>,
    /// `df_e/dr` and `df_e/dr'` at the last point.
    pub(super) slopes: Vec<(f64, f64)>,
    /// Of the first direction of each hole the derivative of its force by the other displacement, at the last
    /// point.
    cross: Vec<f64>,
    /// The laws, with the speeds of impact that they remember.
    pub(super) laws: Vec<Law>,
    /// `df_e/dv` by the remembered speed v at the last point, and the sensitivities of v.
    impacts: Vec<(f64, Vec<f64>)>,
    /// The rigid stops.
    pub(super) rigid: RigidStops,
    /// Region of the last point, kept where rigid stops need it.
    region: Vec<bool>,
}

/// The modal damping matrix `C`.
enum Damping {
    Diagonal(Vec<f64>),
    /// Row by row.
    Full(Vec<f64>),
}

impl<'a> SystemField<'a> {
    pub(super) fn new(system: &'a System, frequency_hz: f64) -> Self {
        let loads: Vec<_> =
            (0..system.orders().len()).map(|order| system.modal_load(order, TAU * frequency_hz)).collect();
        Self {
            system,
            period: 1.0 / frequency_hz,
            damping: Damping::of(system),
            stiffness: system.model().natural_frequencies.iter().map(|w| w * w).collect(),
            rotations: vec![c64::new(0.0, 0.0); loads.len()],
            supports: (0..loads.len()).map(|k| support_amplitudes(system, k, frequency_hz)).collect(),
            switches: system.elements().iter().map(switches_of).sum(),
            length: 1e-3 * least_length(system, &loads, frequency_hz),
            loads,
            slopes: vec![(0.0, 0.0); system.elements().len()],
            cross: vec![0.0; system.elements().len()],
            laws: system.elements().iter().map(|element| element.law.clone()).collect(),
            impacts: vec![(0.0, Vec::new()); system.elements().len()],
            rigid: RigidStops::of(system),
            region: Vec::new(),
        }
    }

    fn rotate(&mut self, phase: f64) {
        for (rotation, order) in self.rotations.iter_mut().zip(self.system.orders()) {
            *rotation = rotation_at(*order, phase);
        }
    }

    /// `[v; -C v - diag(w^2) q + load]`: the rates by time without local elements.
    pub(super) fn linear_acceleration(&self, phase: f64, state: &[f64]) -> Vec<f64> {
        let n = self.system.dof();
        let mut rates = vec![0.0; 2 * n];
        linear_rates(&self.stiffness, &self.damping, 1.0, state, &mut rates);
        for (load, &order) in self.loads.iter().zip(self.system.orders()) {
            let rotation = rotation_at(order, phase);
            for (sum, amplitude) in rates[n..].iter_mut().zip(&load.amplitude) {
                *sum += amplitude.re * rotation.re - amplitude.im * rotation.im;
            }
        }
        rates
    }

    /// Adds the forces of local elements to rates of velocities by time.
    pub(super) fn add_forces_in_region(&self, at: Point<'_>, rate: &mut [f64]) {
        let (q, v) = at.state.split_at(self.system.dof());
        let mut flags = at.inside;
        for (e, (law, element)) in self.laws.iter().zip(self.system.elements()).enumerate() {
            let (inside, rest) = flags.split_at(switches_of(element));
            flags = rest;
            if let Some(force) = self.hole_force(e, q, at.time, inside) {
                add_scaled(rate, force.value[0], &element.shape);
                add_scaled(rate, force.value[1], &self.system.elements()[e + 1].shape);
            } else if law.rigid().is_none() {
                let r = self.relative_displacement(element, q, at.time);
                let speed = self.relative_velocity(element, v, at.time);
                add_scaled(rate, force_in_region(law, (r, speed), inside).value, &element.shape);
            }
        }
    }

    /// `C x`.
    pub(super) fn damped(&self, vector: &[f64]) -> Vec<f64> {
        let n = vector.len();
        let state: Vec<f64> = std::iter::repeat_n(0.0, n).chain(vector.iter().copied()).collect();
        let mut rates = vec![0.0; 2 * n];
        linear_rates(&self.stiffness, &self.damping, 1.0, &state, &mut rates);
        rates[n..].iter().map(|rate| -rate).collect()
    }

    /// Adds `Re sum_m b_m exp(i 2 pi m x)`, or the same of the derivatives of `b_m`.
    fn add_load(&self, of: impl Fn(&ModalLoad) -> &[c64], factor: f64, sum: &mut [f64]) {
        for (load, rotation) in self.loads.iter().zip(&self.rotations) {
            let (cos, sin) = (factor * rotation.re, factor * rotation.im);
            for (sum, amplitude) in sum.iter_mut().zip(of(load)) {
                *sum += amplitude.re * cos - amplitude.im * sin;
            }
        }
    }

    /// What the supports add to `r`, `r'` and `r''` of a displacement with these ratios: `s . u`, `u_s = Re
    /// sum_m U_sm exp(i 2 pi m x)`.
    pub(super) fn carried(&self, ratios: &[f64], phase: f64) -> [f64; 3] {
        let mut carried = [0.0; 3];
        for (support, ratio) in ratios.iter().enumerate().filter(|(_, ratio)| **ratio != 0.0) {
            let motion = self.support_motion(support, phase);
            carried.iter_mut().zip(motion).for_each(|(sum, value)| *sum += ratio * value);
        }
        carried
    }

    /// The derivatives of that by the frequency at a fixed phase.
    pub(super) fn carried_by_frequency(&self, ratios: &[f64], phase: f64) -> [f64; 3] {
        self.system.carried_by_frequency(ratios, self.period.recip(), phase)
    }

    /// `u`, `u'` and `u''` of a support.
    fn support_motion(&self, support: usize, phase: f64) -> [f64; 3] {
        let mut motion = [0.0; 3];
        for (amplitudes, &order) in self.supports.iter().zip(self.system.orders()) {
            let Some(amplitude) = amplitudes.get(support) else { continue };
            let (sin, cos) = (TAU * (f64::from(order) * phase.fract()).fract()).sin_cos();
            let (real, imaginary) =
                (amplitude.re * cos - amplitude.im * sin, amplitude.re * sin + amplitude.im * cos);
            let rate = TAU * f64::from(order) / self.period;
            motion[0] += real;
            motion[1] -= rate * imaginary;
            motion[2] -= rate * rate * real;
        }
        motion
    }

    pub(super) fn relative_displacement(&self, element: &LocalElement, q: &[f64], phase: f64) -> f64 {
        dot(&element.shape, q) + self.carried(&element.support_ratios, phase)[0]
    }

    /// Relative displacement and velocity of an element; of a hole its reading and its rate.
    pub(super) fn reading(&self, e: usize, (q, v): (&[f64], &[f64]), phase: f64) -> [f64; 2] {
        let own = |e: usize| {
            let element = &self.system.elements()[e];
            [self.relative_displacement(element, q, phase), self.relative_velocity(element, v, phase), 0.0]
        };
        match self.laws[e].round_hole() {
            Some(hole) => {
                let [value, rate, _] = hole.reading(own(e), own(e + 1));
                [value, rate]
            }
            None => [own(e)[0], own(e)[1]],
        }
    }

    fn relative_velocity(&self, element: &LocalElement, v: &[f64], phase: f64) -> f64 {
        dot(&element.shape, v) + self.carried(&element.support_ratios, phase)[1]
    }

    /// The force of a hole that is held closed or open, from its place among the elements.
    pub(super) fn hole_force(
        &self,
        first: usize,
        q: &[f64],
        phase: f64,
        inside: &[bool],
    ) -> Option<HoleForce> {
        let hole = self.laws[first].round_hole().filter(|_| inside.contains(&true))?;
        let elements = self.system.elements();
        Some(
            hole.continued_force_at(
                [0, 1].map(|k| self.relative_displacement(&elements[first + k], q, phase)),
            ),
        )
    }

    /// Adds the forces of a hole in both directions, and keeps their derivatives.
    fn add_hole_force(&mut self, first: usize, (q, phase, inside): (&[f64], f64, &[bool]), rate: &mut [f64]) {
        let force = self.hole_force(first, q, phase, inside);
        for (k, element) in self.system.elements()[first..first + 2].iter().enumerate() {
            self.slopes[first + k] = (force.map_or(0.0, |force| force.slopes[k]), 0.0);
            add_scaled(rate, self.period * force.map_or(0.0, |force| force.value[k]), &element.shape);
        }
        self.cross[first] = force.map_or(0.0, |force| force.cross);
    }

    fn add_local_forces(&mut self, at: Point<'_>, rate: &mut [f64]) {
        let (q, v) = at.state.split_at(self.system.dof());
        let mut flags = at.inside;
        for (e, element) in self.system.elements().iter().enumerate() {
            let (inside, rest) = flags.split_at(switches_of(element));
            flags = rest;
            if element.law.is_across_hole() {
                continue;
            }
            if element.law.round_hole().is_some() {
                self.add_hole_force(e, (q, at.time, inside), rate);
                continue;
            }
            let r = self.relative_displacement(element, q, at.time);
            let damped = self.laws[e].depends_on_velocity();
            let speed = if damped { self.relative_velocity(element, v, at.time) } else { 0.0 };
            let force = force_in_region(&self.laws[e], (r, speed), inside);
            self.slopes[e] = (force.slope, force.damping);
            if force.damping != 0.0 {
                self.impacts[e].0 = self.laws[e].by_impact_speed(r, speed);
            } else {
                self.impacts[e].0 = 0.0;
            }
            add_scaled(rate, self.period * force.value, &element.shape);
        }
    }
}

/// Shortest modal displacement among those that take an element from rest to its contact, or as far as the
/// supports move it; zero if there are none.
fn shortest_length(system: &System, frequency_hz: f64) -> f64 {
    let orders = 0..system.orders().len();
    let amplitudes: Vec<Vec<c64>> =
        orders.map(|order| support_amplitudes(system, order, frequency_hz)).collect();
    let largest = |support: usize| amplitudes.iter().map(|order| order[support].norm()).sum::<f64>();
    let lengths = system.elements().iter().flat_map(|element| {
        let ratios = element.support_ratios.iter().enumerate();
        let moved: f64 = ratios.map(|(support, ratio)| (ratio * largest(support)).abs()).sum();
        let levels = element.law.contacts().iter().map(move |contact| contact.level.abs().max(moved));
        levels.map(|length| length / dot(&element.shape, &element.shape).sqrt())
    });
    lengths.filter(|length| *length > 0.0 && length.is_finite()).reduce(f64::min).unwrap_or(0.0)
}

/// [`shortest_length`], or how far the loads move the structure where that is less: far above its frequencies
/// they move it by a millionth of a gap.
fn least_length(system: &System, loads: &[ModalLoad], frequency_hz: f64) -> f64 {
    let shortest = shortest_length(system, frequency_hz);
    let moved = |mode: usize, natural: f64| {
        let by = |(load, order): (&ModalLoad, &u32)| {
            let rate = natural.max(TAU * frequency_hz * f64::from(*order));
            if rate > 0.0 { load.amplitude[mode].norm() / (rate * rate) } else { 0.0 }
        };
        loads.iter().zip(system.orders()).map(by).sum::<f64>()
    };
    let modes = system.model().natural_frequencies.iter().enumerate();
    let driven = modes.map(|(mode, &natural)| moved(mode, natural)).fold(0.0, f64::max);
    if driven > 0.0 { shortest.min(driven) } else { shortest }
}

/// Amplitudes of the displacements of all supports of an order.
fn support_amplitudes(system: &System, order: usize, frequency_hz: f64) -> Vec<c64> {
    system.support_amplitudes(order, TAU * frequency_hz).into_iter().map(|(amplitude, _)| amplitude).collect()
}

impl Damping {
    fn of(system: &System) -> Self {
        let (n, matrix) = (system.dof(), &system.model().damping);
        let couples = (0..n).any(|i| (0..n).any(|j| i != j && matrix[(i, j)] != 0.0));
        if couples {
            Self::Full((0..n * n).map(|k| matrix[(k / n, k % n)]).collect())
        } else {
            Self::Diagonal((0..n).map(|i| matrix[(i, i)]).collect())
        }
    }
}

/// Writes `T [v; -diag(w^2) q - C v]`.
#[inline]
fn linear_rates(stiffness: &[f64], damping: &Damping, period: f64, state: &[f64], derivative: &mut [f64]) {
    let n = stiffness.len();
    let (q, v) = (&state[..n], &state[n..2 * n]);
    let (velocity, rate) = derivative[..2 * n].split_at_mut(n);
    for i in 0..n {
        velocity[i] = period * v[i];
    }
    match damping {
        Damping::Diagonal(damping) => {
            let damping = &damping[..n];
            for i in 0..n {
                rate[i] = -period * (stiffness[i] * q[i] + damping[i] * v[i]);
            }
        }
        Damping::Full(damping) => {
            for (i, row) in damping.chunks_exact(n).enumerate() {
                rate[i] = -period * (stiffness[i] * q[i] + dot(row, v));
            }
        }
    }
}

fn rotation_at(order: u32, phase: f64) -> c64 {
    let (sin, cos) = (TAU * (f64::from(order) * phase.fract()).fract()).sin_cos();
    c64::new(cos, sin)
}
