//! Steps of the method of Runge and Kutta, and impacts.

use std::f64::consts::TAU;

use super::{
    coordinates::Coordinates,
    equations::{Equations, dot, solved},
    stops::Law,
};

/// Steps of an excitation period, at least.
const STEPS: usize = 2000;
/// Angle of the fastest vibration in a step, at most.
const ANGLE: f64 = 0.1;
/// Halvings of the step in which a rigid stop is passed.
const HALVINGS: usize = 50;
/// An impact with less than this part of the fastest speed seen holds.
const REST: f64 = 1e-9;

/// Motion at one excitation frequency.
#[derive(Debug)]
pub struct PlainMotion<'a> {
    equations: &'a Equations,
    frequency_hz: f64,
    steps: usize,
    /// Rigid stops that hold the structure, and others that are in contact: within a step none changes.
    closed: Vec<bool>,
    fastest: f64,
}

impl<'a> PlainMotion<'a> {
    /// * `frequency_hz`: of the excitation.
    #[must_use]
    pub fn new(equations: &'a Equations, frequency_hz: f64) -> Self {
        let steps = STEPS.max((equations.fastest() / frequency_hz / ANGLE) as usize);
        Self { equations, frequency_hz, steps, closed: vec![false; equations.stops.len()], fastest: 0.0 }
    }

    /// Displacement and velocity of the ground at phase 0.
    #[must_use]
    pub fn ground(&self) -> [f64; 2] {
        let at = |ground: &super::equations::Ground| ground.motion(self.frequency_hz, 0.0);
        self.equations.ground.as_ref().map_or([0.0; 2], |ground| [at(ground)[0], at(ground)[1]])
    }

    /// What the numbers of a state are.
    #[must_use]
    pub fn coordinates(&self) -> &Coordinates {
        &self.equations.coordinates
    }

    /// Whether a state is not beyond a rigid stop.
    #[must_use]
    pub fn may_begin(&self, state: &[f64]) -> bool {
        (0..self.closed.len()).all(|index| !self.is_rigid(index) || self.relative(index, state, 0.0)[0] < 0.0)
    }

    /// The state `[y; y']` after one excitation period from phase 0.
    #[must_use]
    pub fn period(&mut self, state: &[f64]) -> Vec<f64> {
        let mut state = state.to_vec();
        let step = 1.0 / (self.frequency_hz * self.steps as f64);
        self.begin(&state);
        for k in 0..self.steps {
            self.step(&mut state, k as f64 * step, step);
        }
        state
    }

    /// Rigid stops hold where the structure went on holding.
    fn begin(&mut self, state: &[f64]) {
        let size = state.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
        for index in 0..self.closed.len() {
            let [depth, speed] = self.relative(index, state, 0.0);
            if self.is_rigid(index) {
                self.closed[index] &= depth.abs() <= 1e-12 * size && speed.abs() <= REST * self.fastest;
            } else {
                self.closed[index] = depth > 0.0;
            }
        }
    }

    fn is_rigid(&self, index: usize) -> bool {
        matches!(self.equations.stops[index].law, Law::Rigid { .. })
    }

    /// How far a stop is passed, and how fast it is approached.
    fn relative(&self, index: usize, state: &[f64], time: f64) -> [f64; 2] {
        let (stop, n) = (&self.equations.stops[index], self.equations.mass.len());
        let [u, v, _] =
            self.equations.ground.as_ref().map_or([0.0; 3], |ground| ground.motion(self.frequency_hz, time));
        let displacement = dot(&stop.row, &state[..n]) - stop.ratio * u;
        let velocity = dot(&stop.row, &state[n..]) - stop.ratio * v;
        [stop.side * displacement - stop.gap, stop.side * velocity]
    }

    /// One step, cut where a stop is reached or left.
    fn step(&mut self, state: &mut Vec<f64>, mut time: f64, mut length: f64) {
        while length > 0.0 {
            let next = self.runge_kutta(state, time, length);
            if self.changed(&next, time + length).is_none() {
                *state = next;
                self.release(state, time + length);
                return;
            }
            let (mut before, mut after) = (0.0, length);
            for _ in 0..HALVINGS {
                let middle = f64::midpoint(before, after);
                let there = self.runge_kutta(state, time, middle);
                match self.changed(&there, time + middle) {
                    Some(_) => after = middle,
                    None => before = middle,
                }
            }
            let there = self.runge_kutta(state, time, after);
            let Some(index) = self.changed(&there, time + after) else { return };
            if self.is_rigid(index) {
                *state = self.runge_kutta(state, time, before);
                self.impact(state, time + before, index);
                (time, length) = (time + before, length - before);
            } else {
                *state = there;
                self.closed[index] = !self.closed[index];
                (time, length) = (time + after, length - after);
            }
        }
    }

    /// The first stop that is reached or left at a state: a rigid one that is passed, or another.
    fn changed(&self, state: &[f64], time: f64) -> Option<usize> {
        (0..self.closed.len()).find(|&index| {
            let is_beyond = self.relative(index, state, time)[0] > 0.0;
            if self.closed[index] { !is_beyond && !self.is_rigid(index) } else { is_beyond }
        })
    }

    /// Turns the relative velocity at a rigid stop round, or holds it there.
    fn impact(&mut self, state: &mut [f64], time: f64, index: usize) {
        let equations = self.equations;
        let (stop, n) = (&equations.stops[index], equations.mass.len());
        let Law::Rigid { restitution } = stop.law else { return };
        let speed = self.relative(index, state, time)[1];
        self.fastest = self.fastest.max(speed.abs());
        let slow = speed.abs() <= REST * self.fastest;
        let change = if slow { speed } else { (1.0 + restitution) * speed };
        let mobility: f64 = (0..n).map(|i| stop.row[i].powi(2) / equations.mass[i]).sum();
        for i in 0..n {
            state[n + i] -= stop.side * stop.row[i] / equations.mass[i] * change / mobility;
        }
        self.closed[index] = slow;
    }

    /// Lets go where a stop would have to pull.
    fn release(&mut self, state: &[f64], time: f64) {
        let pushes = self.accelerations(state, time).1;
        for (index, push) in pushes.into_iter().enumerate() {
            self.closed[index] &= !self.is_rigid(index) || push > 0.0;
        }
    }

    fn runge_kutta(&self, state: &[f64], time: f64, length: f64) -> Vec<f64> {
        let slope = |state: &[f64], time: f64| {
            let mut slope = state[self.equations.mass.len()..].to_vec();
            slope.extend(self.accelerations(state, time).0);
            slope
        };
        let moved = |slope: &[f64], by: f64| -> Vec<f64> {
            state.iter().zip(slope).map(|(entry, slope)| entry + by * slope).collect()
        };
        let first = slope(state, time);
        let second = slope(&moved(&first, length / 2.0), time + length / 2.0);
        let third = slope(&moved(&second, length / 2.0), time + length / 2.0);
        let fourth = slope(&moved(&third, length), time + length);
        let sum = |i: usize| first[i] + 2.0 * second[i] + 2.0 * third[i] + fourth[i];
        (0..state.len()).map(|i| state[i] + length / 6.0 * sum(i)).collect()
    }

    /// Accelerations of the masses, and what each holding stop pushes with.
    fn accelerations(&self, state: &[f64], time: f64) -> (Vec<f64>, Vec<f64>) {
        let equations = self.equations;
        let n = equations.mass.len();
        let (y, v) = state.split_at(n);
        let mut force: Vec<f64> =
            (0..n).map(|i| -dot(&equations.stiffness[i], y) - dot(&equations.damping[i], v)).collect();
        for harmonic in &equations.forces {
            let angle = TAU * harmonic.order * self.frequency_hz * time + harmonic.phase;
            let now = harmonic.size.at(harmonic.order, self.frequency_hz) * angle.cos();
            force.iter_mut().zip(&harmonic.row).for_each(|(sum, part)| *sum += part * now);
        }
        let mut shaken = [0.0; 3];
        if let Some(ground) = &equations.ground {
            shaken = ground.motion(self.frequency_hz, time);
            for (i, sum) in force.iter_mut().enumerate() {
                *sum += ground.springs[i] * shaken[0] + ground.dampers[i] * shaken[1];
            }
        }
        for index in 0..equations.stops.len() {
            let push = self.push(index, state, time);
            let stop = &equations.stops[index];
            force.iter_mut().zip(&stop.row).for_each(|(sum, part)| *sum -= stop.side * part * push);
        }
        let pushes = self.holding(&force, shaken[2]);
        for (stop, push) in equations.stops.iter().zip(&pushes) {
            force.iter_mut().zip(&stop.row).for_each(|(sum, part)| *sum -= stop.side * part * push);
        }
        ((0..n).map(|i| force[i] / equations.mass[i]).collect(), pushes)
    }

    /// The force of an elastic stop, against its side.
    fn push(&self, index: usize, state: &[f64], time: f64) -> f64 {
        let [depth, rate] = self.relative(index, state, time);
        let is_closed = self.closed[index];
        match &self.equations.stops[index].law {
            Law::Power { terms } => depth * (terms[0] + depth * (terms[1] + depth * terms[2])),
            Law::Linear { stiffness, damping, .. } if is_closed => {
                (stiffness * depth + damping * rate).max(0.0)
            }
            Law::Hertz { stiffness, loss } if is_closed => {
                (stiffness * depth.max(0.0).powf(1.5) * (1.0 + 1.5 * loss * rate)).max(0.0)
            }
            _ => 0.0,
        }
    }

    /// Forces with which holding stops keep their relative acceleration at nothing.
    fn holding(&self, force: &[f64], ground: f64) -> Vec<f64> {
        let equations = self.equations;
        let is_held = |index: &usize| self.closed[*index] && self.is_rigid(*index);
        let held: Vec<usize> = (0..self.closed.len()).filter(is_held).collect();
        let mut pushes = vec![0.0; self.closed.len()];
        if held.is_empty() {
            return pushes;
        }
        let through = |a: usize, b: &dyn Fn(usize) -> f64| -> f64 {
            let stop = &equations.stops[a];
            (0..force.len()).map(|i| stop.side * stop.row[i] * b(i) / equations.mass[i]).sum()
        };
        let matrix = held
            .iter()
            .map(|&a| {
                let column = |b: usize| through(a, &|i| equations.stops[b].side * equations.stops[b].row[i]);
                held.iter().map(|&b| column(b)).collect()
            })
            .collect();
        let asked = held
            .iter()
            .map(|&a| through(a, &|i| force[i]) - equations.stops[a].side * equations.stops[a].ratio * ground)
            .collect();
        for (index, push) in held.iter().zip(solved(matrix, asked)) {
            pushes[*index] = push;
        }
        pushes
    }
}
