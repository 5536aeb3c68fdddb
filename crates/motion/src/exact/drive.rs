//! The part of the motion that the load drives: the particular solution at one excitation frequency.
//! Equation (F4) of the book, `docs/theory`.
//!
//! For the order m, at the circular frequency `w = m W`, a block driven by `Re [beta; phi] exp(i w t)` has
//! the steady solution `p = (phi + (i w + c) beta)/(k - w^2 + i w c)`, `s = i w p - beta`. Where the
//! denominator nearly vanishes - a constant load on a rigid mode, a load within 1 % of the resonance of a
//! mode that is damped as little - the load is *secular*: the solution that starts from rest with the
//! stretch takes its place (`secular.rs`); it stays finite. So it does for a constant load on a mode that
//! hardly moves in a period, whose sag would be all that rounding leaves room for.

use std::{cell::Cell, f64::consts::TAU};

use faer::c64;

use super::{
    block::Blocks,
    change::Change,
    elementary::sine_and_cosine,
    output::Output,
    secular::{SecularChange, SecularLoad},
};
use crate::{ModalLoad, Stretch, System};

/// Relative distance from resonance below which the steady solution would cost more than two digits. A slow
/// impact of the speed v makes `1/v` times as much of what rounding leaves: with four digits gone, walks of
/// lightly damped structures hung in that noise beside grazings near the resonance.
const RESONANT: f64 = 1e-2;

/// The same where the steady motion itself is wanted: nearer to the resonance of an undamped mode it is taken
/// for one that is driven there, which has none.
const NO_STEADY_MOTION: f64 = 1e-6;

/// Eigenfrequency and damping of a block, relative to the excitation, below which it is slow.
const SLOW: f64 = 1e-2;

/// Steady solution of one order.
#[derive(Debug, Clone)]
pub(super) struct Order {
    /// m.
    pub(super) order: f64,
    /// `[p; s]` complex, length 2n.
    state: Vec<c64>,
    /// Its derivative by the frequency [1/Hz].
    state_by_frequency: Vec<c64>,
    /// Amplitude of each output, and its derivative by the frequency.
    pub(super) outputs: Vec<(c64, c64)>,
    /// The angle asked for last, with its rotation: at one time all elements ask for it.
    last_rotation: Cell<(f64, c64)>,
}

/// The particular solution over a stretch; times are counted from the start of the stretch.
#[derive(Debug, Clone)]
pub(crate) struct Drive {
    pub(super) circular_frequency: f64,
    start_angle: f64,
    pub(super) orders: Vec<Order>,
    pub(super) secular: Vec<SecularLoad>,
    /// In the change by the damping: what the secular loads of the motion itself do.
    secular_changes: Vec<SecularChange>,
    /// Scale of all orders above 0.
    pub(super) scale: f64,
    /// Circular frequency below which constant loads on blocks are secular [rad/s].
    slow: f64,
    /// Relative distance from resonance up to which a load is secular.
    resonant: f64,
}

/// Value of an output and of its first two derivatives by time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Jet {
    pub value: f64,
    pub slope: f64,
    pub curvature: f64,
}

impl Drive {
    /// Solves for the particular solution of `system` over `stretch`.
    pub fn new(system: &System, blocks: &Blocks, outputs: &[Output], stretch: &Stretch) -> Self {
        Self { slow: SLOW * TAU * stretch.frequency_hz, ..Self::silent(system, stretch) }
            .with_loads(system, blocks, outputs)
    }

    /// The steady motion, also of slow blocks and beside a resonance.
    pub fn steady_motion(system: &System, blocks: &Blocks, stretch: &Stretch) -> Self {
        Self { resonant: NO_STEADY_MOTION, ..Self::silent(system, stretch) }.with_loads(system, blocks, &[])
    }

    fn with_loads(self, system: &System, blocks: &Blocks, outputs: &[Output]) -> Self {
        let mut drive = self;
        for (index, &order) in system.orders().iter().enumerate() {
            drive.add_order(system, blocks, outputs, index, f64::from(order));
        }
        drive
    }

    /// Makes it that of another stretch, if only the phase differs. Secular loads begin with their stretch:
    /// so they have to be constant.
    ///
    /// # Returns
    /// Whether it is now.
    pub fn turn_to(&mut self, stretch: &Stretch) -> bool {
        let other = Self::start_angle(stretch);
        let serves = self.circular_frequency == TAU * stretch.frequency_hz
            && (self.start_angle == other || self.secular.iter().all(SecularLoad::is_constant));
        if serves {
            self.start_angle = other;
        }
        serves
    }

    /// From now on it is of no stretch: the system has changed.
    pub fn forget(&mut self) {
        self.circular_frequency = f64::NAN;
    }

    /// Angle of the first order at the start of a stretch.
    fn start_angle(stretch: &Stretch) -> f64 {
        TAU * (stretch.start - stretch.start.floor())
    }

    /// Without any load yet.
    pub fn silent(system: &System, stretch: &Stretch) -> Self {
        let circular_frequency = TAU * stretch.frequency_hz;
        let start_angle = Self::start_angle(stretch);
        let (secular, secular_changes) = (Vec::new(), Vec::new());
        let (orders, scale) = (Vec::new(), system.excitation_scale());
        Self {
            circular_frequency,
            start_angle,
            orders,
            secular,
            secular_changes,
            scale,
            slow: 0.0,
            resonant: RESONANT,
        }
    }

    fn add_order(&mut self, system: &System, blocks: &Blocks, outputs: &[Output], index: usize, order: f64) {
        let load = system.modal_load(index, self.circular_frequency);
        let (state, state_by_frequency) = self.steady(blocks, blocks.count(), (&load, order));
        let supports = system.support_amplitudes(index, self.circular_frequency);
        self.push(outputs, (order, &supports), state, state_by_frequency);
    }

    /// Adds an order of a held structure (`held.rs`): `load` drives the blocks that move, the others are
    /// `prescribed`, and what acts on the pressing forces, the last outputs, directly is `forces`. Supports,
    /// prescribed blocks and forces come with their derivatives by the circular frequency.
    pub fn add_held(
        &mut self,
        blocks: &Blocks,
        outputs: &[Output],
        (order, supports): (f64, &[(c64, c64)]),
        (load, prescribed): (&ModalLoad, &[(c64, c64)]),
        forces: &[(c64, c64)],
    ) {
        let (n, moving) = (blocks.count(), blocks.count() - prescribed.len());
        let (mut state, mut state_by_frequency) = self.steady(blocks, moving, (load, order));
        let rate = c64::new(0.0, order * self.circular_frequency);
        for (j, (value, by_circular)) in prescribed.iter().enumerate() {
            let slope = *by_circular * TAU;
            state[moving + j] = *value;
            state[n + moving + j] = *value * rate;
            state_by_frequency[moving + j] = slope;
            state_by_frequency[n + moving + j] = *value * c64::new(0.0, order * TAU) + slope * rate;
        }
        self.push(outputs, (order, supports), state, state_by_frequency);
        let last = self.orders.last_mut().into_iter().flat_map(|order| order.outputs.iter_mut().rev());
        for (output, (force, by_circular_frequency)) in last.zip(forces.iter().rev()) {
            output.0 += force;
            output.1 += *by_circular_frequency * TAU;
        }
    }

    /// Steady solution of the first `moving` blocks under one order, and its derivative by the frequency;
    /// where there is none the load is secular.
    fn steady(
        &mut self,
        blocks: &Blocks,
        moving: usize,
        (load, order): (&ModalLoad, f64),
    ) -> (Vec<c64>, Vec<c64>) {
        let n = blocks.count();
        let input = complex_input(blocks, &load.amplitude);
        let input_by_frequency = complex_input(blocks, &load.by_frequency);
        let w = order * self.circular_frequency;
        let mut state = vec![c64::new(0.0, 0.0); 2 * n];
        let mut state_by_frequency = state.clone();
        for i in 0..moving {
            let (k, c) = (blocks.stiffness[i], blocks.damping[i]);
            let (beta, phi) = (input[i], input[n + i]);
            let (beta_w, phi_w) = (input_by_frequency[i] * TAU, input_by_frequency[n + i] * TAU);
            if beta == c64::new(0.0, 0.0) && phi == beta {
                continue;
            }
            let denominator = c64::new(k - w * w, w * c);
            let is_slow = w == 0.0 && k <= self.slow * self.slow && c <= k.sqrt();
            if is_slow || denominator.norm() <= self.resonant * (k + w * w) {
                let rate = TAU * order;
                let angle = order * self.start_angle;
                self.secular.push(SecularLoad::new(
                    i,
                    (k, c),
                    [beta, phi],
                    [beta_w, phi_w],
                    (w, rate),
                    angle,
                ));
                continue;
            }
            let iw = c64::new(0.0, w);
            let p = (phi + (iw + c) * beta) / denominator;
            let rate = TAU * order;
            let slope = c64::new(-2.0 * w, c) * rate;
            let p_f = (phi_w + (iw + c) * beta_w + c64::new(0.0, rate) * beta - p * slope) / denominator;
            state[i] = p;
            state[n + i] = iw * p - beta;
            state_by_frequency[i] = p_f;
            state_by_frequency[n + i] = iw * p_f + c64::new(0.0, rate) * p - beta_w;
        }
        (state, state_by_frequency)
    }

    fn push(
        &mut self,
        outputs: &[Output],
        (order, supports): (f64, &[(c64, c64)]),
        state: Vec<c64>,
        state_by_frequency: Vec<c64>,
    ) {
        let amplitude = |output: &Output| {
            let read = |values: &[c64]| output.row.iter().zip(values).map(|(r, v)| *v * *r).sum::<c64>();
            let moved = || supports.iter().zip(&output.support_ratios);
            let carried = moved().map(|((support, _), ratio)| support * ratio).sum::<c64>();
            let slope = moved().map(|((_, by_circular), ratio)| by_circular * (TAU * ratio)).sum::<c64>();
            (read(&state) + carried, read(&state_by_frequency) + slope)
        };
        let outputs = outputs.iter().map(amplitude).collect();
        let last_rotation = Cell::new((0.0, c64::new(1.0, 0.0)));
        self.orders.push(Order { order, state, state_by_frequency, outputs, last_rotation });
    }

    /// Circular excitation frequency [rad/s].
    pub fn circular_frequency(&self) -> f64 {
        self.circular_frequency
    }

    /// `exp(i w t)` of an order.
    #[inline]
    pub(super) fn rotation(&self, order: &Order, time: f64) -> c64 {
        let angle = order.order * (self.start_angle + self.circular_frequency * time);
        let (known, mut rotation) = order.last_rotation.get();
        if angle != known {
            let (sin, cos) = sine_and_cosine(angle);
            rotation = c64::new(cos, sin);
            order.last_rotation.set((angle, rotation));
        }
        rotation
    }

    /// Adds the particular state at `time`, times `factor`, to `state`.
    pub fn add_state(&self, time: f64, factor: f64, state: &mut [f64]) {
        for order in &self.orders {
            let rotation = self.rotation(order, time) * factor;
            for (entry, amplitude) in state.iter_mut().zip(&order.state) {
                *entry += amplitude.re * rotation.re - amplitude.im * rotation.im;
            }
        }
        let n = state.len() / 2;
        for (block, [[p, s]]) in self.secular_states(time) {
            state[block] += factor * p;
            state[n + block] += factor * s;
        }
    }

    /// The blocks of secular loads, with what these make of their states at `time` and of the derivatives
    /// by the time.
    pub(super) fn secular_states<const N: usize>(
        &self,
        time: f64,
    ) -> impl Iterator<Item = (usize, [[f64; 2]; N])> {
        let loads = self.secular.iter().map(move |load| (load.block, load.derivatives(time)));
        loads.chain(self.secular_changes.iter().map(move |load| (load.block, load.derivatives(time))))
    }

    /// Calls `add(i, value)` with the derivative of the particular state by the frequency at fixed `time`.
    pub fn for_state_by_frequency(&self, time: f64, n: usize, mut add: impl FnMut(usize, f64)) {
        for order in &self.orders {
            let rotation = self.rotation(order, time);
            let turning = c64::new(0.0, TAU * order.order * time);
            for i in 0..2 * n {
                add(i, ((order.state_by_frequency[i] + turning * order.state[i]) * rotation).re);
            }
        }
        for load in &self.secular {
            let [[p, s], _] = load.by_frequency(time);
            add(load.block, p);
            add(n + load.block, s);
        }
    }

    /// Adds the derivative of the particular state at `time` by the scale of the excitation, times `factor`,
    /// to `state`.
    pub fn add_state_by_scale(&self, time: f64, factor: f64, state: &mut [f64]) {
        self.scaled_part().add_state(time, factor / self.scale, state);
    }

    /// The part of the change `s' = A s + dA x + db` of the motion that the particular solution drives, for
    /// a change `dA` of the blocks, and modal loads `db` of its orders (as many as there are): the steady
    /// solution where there is one, from rest elsewhere. Of it only values and their derivatives by the
    /// time are told, and no bounds.
    pub fn change(
        &self,
        blocks: &Blocks,
        outputs: &[Output],
        (change, loads): (&Change, &[Vec<c64>]),
    ) -> Self {
        let n = blocks.count();
        let mut changed = self.without_loads();
        for (index, order) in self.orders.iter().enumerate() {
            let w = order.order * self.circular_frequency;
            let mut input = change.times(&order.state);
            if let Some(load) = loads.get(index) {
                input.iter_mut().zip(complex_input(blocks, load)).for_each(|(sum, part)| *sum += part);
            }
            let mut state = vec![c64::new(0.0, 0.0); 2 * n];
            for i in (0..change.moving()).filter(|&i| input[i].norm() + input[n + i].norm() > 0.0) {
                let (k, c, beta, phi) = (blocks.stiffness[i], blocks.damping[i], input[i], input[n + i]);
                let denominator = c64::new(k - w * w, w * c);
                if denominator.norm() <= RESONANT * (k + w * w) {
                    let (zero, angle) = (c64::new(0.0, 0.0), order.order * self.start_angle);
                    let rate = TAU * order.order;
                    let load = SecularLoad::new(i, (k, c), [beta, phi], [zero; 2], (w, rate), angle);
                    changed.secular.push(load);
                    continue;
                }
                state[i] = (phi + (c64::new(0.0, w) + c) * beta) / denominator;
                state[n + i] = c64::new(0.0, w) * state[i] - beta;
            }
            let read = |o: &Output| o.row.iter().zip(&state).map(|(r, v)| *v * *r).sum::<c64>();
            let outputs = outputs.iter().map(|o| (read(o), c64::new(0.0, 0.0))).collect();
            changed.orders.push(Order {
                order: order.order,
                state_by_frequency: Vec::new(),
                state,
                outputs,
                last_rotation: order.last_rotation.clone(),
            });
        }
        for load in &self.secular {
            for pair in change.pairs().iter().filter(|pair| pair.from == load.block) {
                let block = (blocks.stiffness[pair.to], blocks.damping[pair.to]);
                changed.secular_changes.push(load.change(pair.to, block, &pair.coupling));
            }
        }
        changed
    }

    /// What is proportional to the scale of the excitation.
    pub(super) fn scaled_part(&self) -> Self {
        let orders = self.orders.iter().filter(|order| order.order > 0.0).cloned().collect();
        let secular = self.secular.iter().filter(|load| !load.is_constant()).cloned().collect();
        Self { orders, secular, ..self.without_loads() }
    }

    fn without_loads(&self) -> Self {
        Self { orders: Vec::new(), secular: Vec::new(), secular_changes: Vec::new(), ..*self }
    }
}

fn complex_input(blocks: &Blocks, modal_load: &[c64]) -> Vec<c64> {
    let part = |f: fn(&c64) -> f64| blocks.input(&modal_load.iter().map(f).collect::<Vec<f64>>());
    let (re, im) = (part(|v| v.re), part(|v| v.im));
    re.into_iter().zip(im).map(|(re, im)| c64::new(re, im)).collect()
}
