//! The part of the motion that the load drives: the particular solution at one excitation frequency.
//!
//! For the order m, at the circular frequency `w = m W`, a block driven by `Re [beta; phi] exp(i w t)` has the steady solution
//! `p = (phi + (i w + c) beta)/(k - w^2 + i w c)`, `s = i w p - beta`. Where the denominator (nearly) vanishes - a constant load on a
//! rigid mode, a load on an undamped eigenfrequency - the solution that starts from rest with the stretch takes its place
//! (`secular.rs`); it stays finite.

use std::f64::consts::TAU;

use faer::c64;

use super::{block::Blocks, change::Change, collocation::NODES, output::Output, secular::SecularLoad};
use crate::{ModalLoad, Stretch, System};

/// Relative distance from resonance below which the steady solution would cost more than four digits.
const RESONANT: f64 = 1e-4;

/// Steady solution of one order.
#[derive(Debug, Clone)]
struct Order {
    /// m.
    order: f64,
    /// `[p; s]` complex, length 2n.
    state: Vec<c64>,
    /// Its derivative by the frequency [1/Hz].
    state_by_frequency: Vec<c64>,
    /// Amplitude of each output, and its derivative by the frequency.
    outputs: Vec<(c64, c64)>,
}

/// The particular solution over a stretch; times are counted from the start of the stretch.
#[derive(Debug, Clone)]
pub(crate) struct Drive {
    circular_frequency: f64,
    start_angle: f64,
    orders: Vec<Order>,
    secular: Vec<SecularLoad>,
    /// Scale of all orders above 0.
    scale: f64,
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
        let mut drive = Self::silent(system, stretch);
        for (index, &order) in system.orders().iter().enumerate() {
            drive.add_order(system, blocks, outputs, index, f64::from(order));
        }
        drive
    }

    /// Without any load yet.
    pub fn silent(system: &System, stretch: &Stretch) -> Self {
        let circular_frequency = TAU * stretch.frequency_hz;
        let start_angle = TAU * (stretch.start - stretch.start.floor());
        let (orders, secular, scale) = (Vec::new(), Vec::new(), system.excitation_scale());
        Self { circular_frequency, start_angle, orders, secular, scale }
    }

    fn add_order(&mut self, system: &System, blocks: &Blocks, outputs: &[Output], index: usize, order: f64) {
        let load = system.modal_load(index, self.circular_frequency);
        let (state, state_by_frequency) = self.steady(blocks, blocks.count(), (&load, order));
        let support = system.support_amplitude(index, self.circular_frequency);
        self.push(outputs, (order, support), state, state_by_frequency);
    }

    /// Adds an order of a held structure (`held.rs`): `load` drives the blocks that move, the others are `prescribed`, and what acts on the pressing forces, the last outputs,
    /// directly is `forces`. Support, prescribed blocks and forces come with their derivatives by the circular frequency.
    pub fn add_held(
        &mut self,
        blocks: &Blocks,
        outputs: &[Output],
        (order, support): (f64, (c64, c64)),
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
        self.push(outputs, (order, support), state, state_by_frequency);
        let last = self.orders.last_mut().into_iter().flat_map(|order| order.outputs.iter_mut().rev());
        for (output, (force, by_circular_frequency)) in last.zip(forces.iter().rev()) {
            output.0 += force;
            output.1 += *by_circular_frequency * TAU;
        }
    }

    /// Steady solution of the first `moving` blocks under one order, and its derivative by the frequency; what is resonant becomes secular.
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
            if denominator.norm() <= RESONANT * (k + w * w) {
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
        (order, (support, by_circular)): (f64, (c64, c64)),
        state: Vec<c64>,
        state_by_frequency: Vec<c64>,
    ) {
        let amplitude = |output: &Output| {
            let read = |values: &[c64]| output.row.iter().zip(values).map(|(r, v)| *v * *r).sum::<c64>();
            let slope = by_circular * (TAU * output.support_ratio);
            (read(&state) + support * output.support_ratio, read(&state_by_frequency) + slope)
        };
        let outputs = outputs.iter().map(amplitude).collect();
        self.orders.push(Order { order, state, state_by_frequency, outputs });
    }

    /// Circular excitation frequency [rad/s].
    pub fn circular_frequency(&self) -> f64 {
        self.circular_frequency
    }

    /// `exp(i w t)` of an order.
    #[inline]
    fn rotation(&self, order: &Order, time: f64) -> c64 {
        let (sin, cos) = (order.order * (self.start_angle + self.circular_frequency * time)).sin_cos();
        c64::new(cos, sin)
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
        for load in &self.secular {
            let [p, s] = load.state(time);
            state[load.block] += factor * p;
            state[n + load.block] += factor * s;
        }
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
            let response = load.response(time);
            add(load.block, response.by_frequency[0]);
            add(n + load.block, response.by_frequency[1]);
        }
    }

    /// Adds the derivative of the particular state at `time` by the scale of the excitation, times `factor`, to `state`.
    pub fn add_state_by_scale(&self, time: f64, factor: f64, state: &mut [f64]) {
        self.scaled_part().add_state(time, factor / self.scale, state);
    }

    /// Derivatives of the particular part of output `index` by the scale of the excitation at `start + c_k length`.
    pub fn values_by_scale(
        &self,
        index: usize,
        output: &Output,
        span: (f64, f64),
        c: &[f64; NODES],
    ) -> [f64; NODES] {
        let mut values = [0.0; NODES];
        self.scaled_part().add_values(index, output, span, c, &mut values);
        values.map(|value| value / self.scale)
    }

    /// The part of the change `s' = A s + dA x` of the motion that the particular solution drives, for a change `dA` of the blocks: the steady
    /// solution where there is one, from rest elsewhere. Of it only states and values are told.
    pub fn change(&self, blocks: &Blocks, outputs: &[Output], change: &Change) -> Self {
        let n = blocks.count();
        let mut changed = Self { orders: Vec::new(), secular: Vec::new(), ..*self };
        for order in &self.orders {
            let w = order.order * self.circular_frequency;
            let input = change.times(&order.state);
            let mut state = vec![c64::new(0.0, 0.0); 2 * n];
            for i in (0..n).filter(|&i| input[i].norm() + input[n + i].norm() > 0.0) {
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
            changed.orders.push(Order { order: order.order, state_by_frequency: Vec::new(), state, outputs });
        }
        for load in &self.secular {
            for pair in change.pairs().iter().filter(|pair| pair.from == load.block) {
                let block = (blocks.stiffness[pair.to], blocks.damping[pair.to]);
                changed.secular.push(load.change(pair.to, block, &pair.coupling));
            }
        }
        changed
    }

    /// What is proportional to the scale of the excitation.
    fn scaled_part(&self) -> Self {
        let orders = self.orders.iter().filter(|order| order.order > 0.0).cloned().collect();
        let secular = self.secular.iter().filter(|load| !load.is_constant()).cloned().collect();
        Self { orders, secular, ..*self }
    }

    /// Adds the particular part of output `index` (with the row `output`) at `start + c_k length` to `values`.
    pub fn add_values(
        &self,
        index: usize,
        output: &Output,
        (start, length): (f64, f64),
        c: &[f64; NODES],
        values: &mut [f64; NODES],
    ) {
        for order in &self.orders {
            let amplitude = order.outputs[index].0 * self.rotation(order, start);
            let turning = order.order * self.circular_frequency * length;
            let [cosines, sines] = cosines_and_sines(&c.map(|c| c * turning));
            for k in 0..NODES {
                values[k] += amplitude.re * cosines[k] - amplitude.im * sines[k];
            }
        }
        let n = output.row.len() / 2;
        for load in &self.secular {
            for (value, c) in values.iter_mut().zip(c) {
                let state = load.state(start + c * length);
                *value += output.row[load.block] * state[0] + output.row[n + load.block] * state[1];
            }
        }
    }

    /// Particular part of output `index` (with the row `output`) and its derivatives at `time`.
    pub fn jet(&self, index: usize, output: &Output, time: f64) -> Jet {
        let mut jet = Jet::default();
        for order in &self.orders {
            let w = order.order * self.circular_frequency;
            let value = order.outputs[index].0 * self.rotation(order, time);
            jet.value += value.re;
            jet.slope -= w * value.im;
            jet.curvature -= w * w * value.re;
        }
        let n = output.row.len() / 2;
        for load in &self.secular {
            let (b, response) = (load.block, load.response(time));
            let [p, s] = [output.row[b], output.row[n + b]];
            jet.value += p * response.state[0] + s * response.state[1];
            jet.slope += p * response.rate[0] + s * response.rate[1];
            jet.curvature += p * response.curvature[0] + s * response.curvature[1];
        }
        jet
    }

    /// Derivatives of the particular part of output `index` by the frequency at the fixed times `start + c_k length`.
    pub fn values_by_frequency(
        &self,
        index: usize,
        output: &Output,
        (start, length): (f64, f64),
        c: &[f64; NODES],
    ) -> [f64; NODES] {
        let mut values = [0.0; NODES];
        for order in &self.orders {
            let (amplitude, by_frequency) = order.outputs[index];
            let rotation = self.rotation(order, start);
            let (amplitude, by_frequency) = (amplitude * rotation, by_frequency * rotation);
            let turning = order.order * self.circular_frequency * length;
            let [cosines, sines] = cosines_and_sines(&c.map(|c| c * turning));
            for k in 0..NODES {
                let time = TAU * order.order * (start + c[k] * length);
                let (re, im) = (by_frequency.re - time * amplitude.im, by_frequency.im + time * amplitude.re);
                values[k] += re * cosines[k] - im * sines[k];
            }
        }
        let n = output.row.len() / 2;
        for load in &self.secular {
            for (value, c) in values.iter_mut().zip(c) {
                let by_frequency = load.response(start + c * length).by_frequency;
                *value +=
                    output.row[load.block] * by_frequency[0] + output.row[n + load.block] * by_frequency[1];
            }
        }
        values
    }

    /// Adds the rate of the particular part of output `index` (with the row `output`) at `start + c_k length` to `rates`.
    pub fn add_rates(
        &self,
        index: usize,
        output: &Output,
        (start, length): (f64, f64),
        c: &[f64; NODES],
        rates: &mut [f64; NODES],
    ) {
        for (rate, c) in rates.iter_mut().zip(c) {
            *rate += self.jet(index, output, start + c * length).slope;
        }
    }

    /// Derivatives of the rate of the particular part of output `index` by the scale of the excitation at `start + c_k length`.
    pub fn rates_by_scale(
        &self,
        index: usize,
        output: &Output,
        span: (f64, f64),
        c: &[f64; NODES],
    ) -> [f64; NODES] {
        let mut rates = [0.0; NODES];
        self.scaled_part().add_rates(index, output, span, c, &mut rates);
        rates.map(|rate| rate / self.scale)
    }

    /// Derivatives of the rate of the particular part of output `index` by the frequency at the fixed times `start + c_k length`.
    ///
    /// That of `Re(i w A exp(i w t))` with `w_f = 2 pi m` is `Re(i (w A_f + w_f A + w w_f i t A) exp(i w t))`.
    pub fn rates_by_frequency(
        &self,
        index: usize,
        output: &Output,
        (start, length): (f64, f64),
        c: &[f64; NODES],
    ) -> [f64; NODES] {
        let n = output.row.len() / 2;
        let at = |time: f64| {
            let mut rate = 0.0;
            for order in &self.orders {
                let (amplitude, by_frequency) = order.outputs[index];
                let (w, w_f) = (order.order * self.circular_frequency, TAU * order.order);
                let sum = by_frequency * w + amplitude * w_f + amplitude * c64::new(0.0, w * w_f * time);
                rate -= (sum * self.rotation(order, time)).im;
            }
            for load in &self.secular {
                let by_frequency = load.rate_by_frequency(time);
                rate +=
                    output.row[load.block] * by_frequency[0] + output.row[n + load.block] * by_frequency[1];
            }
            rate
        };
        c.map(|c| at(start + c * length))
    }

    /// Bounds on the second and third derivative of the particular part of output `index` until `until`.
    pub fn bounds(&self, index: usize, output: &Output, until: f64) -> (f64, f64) {
        let mut bounds = (0.0, 0.0);
        for order in &self.orders {
            let w = order.order * self.circular_frequency;
            let amplitude = order.outputs[index].0.norm();
            bounds.0 += amplitude * w * w;
            bounds.1 += amplitude * w * w * w;
        }
        for load in &self.secular {
            let (second, third) = load.bounds(output, until);
            bounds.0 += second;
            bounds.1 += third;
        }
        bounds
    }

    /// Bound on the fourth derivative of the particular part of output `index` until `until`.
    pub fn fourth_bound(&self, index: usize, output: &Output, until: f64) -> f64 {
        let of_order =
            |order: &Order| order.outputs[index].0.norm() * (order.order * self.circular_frequency).powi(4);
        self.orders.iter().map(of_order).sum::<f64>()
            + self.secular.iter().map(|load| load.fourth_bound(output, until)).sum::<f64>()
    }

    /// Largest value that the part of resonant loads in an output can take until `until`, for rounding margins.
    pub fn secular_magnitude(&self, output: &Output, until: f64) -> f64 {
        self.secular.iter().map(|load| load.magnitude(output, until)).sum()
    }

    /// Largest velocity that the steady part of output `index` can take.
    pub fn speed(&self, index: usize) -> f64 {
        let of_order = |order: &Order| order.outputs[index].0.norm() * order.order * self.circular_frequency;
        self.orders.iter().map(of_order).sum()
    }

    /// Largest value that the steady part of output `index` can take, for rounding margins.
    pub fn magnitude(&self, index: usize) -> f64 {
        self.orders.iter().map(|order| order.outputs[index].0.norm()).sum()
    }
}

/// Cosines and sines of the angles of the nodes of a step: small ones by their series, all at once.
fn cosines_and_sines(angles: &[f64; NODES]) -> [[f64; NODES]; 2] {
    if angles[NODES - 1].abs() > 0.25 {
        return [angles.map(f64::cos), angles.map(f64::sin)];
    }
    let squares = angles.map(|x| x * x);
    let series =
        |terms: [f64; 6]| squares.map(|x| terms.iter().fold(1.0, |sum, divisor| 1.0 - x / divisor * sum));
    // Horner's scheme from the last term: 1 - x^2/(2 m - 1)(2 m) (...).
    let cosines = series([132.0, 90.0, 56.0, 30.0, 12.0, 2.0]);
    let sines = series([156.0, 110.0, 72.0, 42.0, 20.0, 6.0]);
    [cosines, std::array::from_fn(|k| angles[k] * sines[k])]
}

fn complex_input(blocks: &Blocks, modal_load: &[c64]) -> Vec<c64> {
    let part = |f: fn(&c64) -> f64| blocks.input(&modal_load.iter().map(f).collect::<Vec<f64>>());
    let (re, im) = (part(|v| v.re), part(|v| v.im));
    re.into_iter().zip(im).map(|(re, im)| c64::new(re, im)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_of_small_angles_reach_rounding() {
        for largest in [0.0, 1e-3, 0.1, 0.2499, 0.3, 20.0] {
            let angles: [f64; NODES] = std::array::from_fn(|k| largest * (k + 1) as f64 / NODES as f64);
            let [cosines, sines] = cosines_and_sines(&angles);
            for k in 0..NODES {
                assert!(
                    (cosines[k] - angles[k].cos()).abs() < 3e-16
                        && (sines[k] - angles[k].sin()).abs() < 2e-16
                );
            }
        }
    }
}
