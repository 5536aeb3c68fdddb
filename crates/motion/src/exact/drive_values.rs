//! Outputs of the particular solution (`drive.rs`) at a time and at the nodes of a step, and their
//! derivatives by the frequency and by the scale of the excitation.

use std::f64::consts::TAU;

use faer::c64;

use super::{
    collocation::NODES,
    drive::{Drive, Jet},
    elementary::{self, TURNING},
    lanes::vectorised,
    output::Output,
};

impl Drive {
    /// Acceleration of the particular part of output `index` (with the row `output`) and its derivatives at
    /// `time`.
    pub fn acceleration_jet(&self, index: usize, output: &Output, time: f64) -> Jet {
        let mut jet = Jet::default();
        for order in &self.orders {
            let square = (order.order * self.circular_frequency).powi(2);
            let value = order.outputs[index].0 * self.rotation(order, time);
            jet.value -= square * value.re;
            jet.slope += square * order.order * self.circular_frequency * value.im;
            jet.curvature += square * square * value.re;
        }
        for [value, slope, curvature] in self.secular_parts::<5>(output, time).map(|[.., a, b, c]| [a, b, c])
        {
            jet.value += value;
            jet.slope += slope;
            jet.curvature += curvature;
        }
        jet
    }

    /// What `output` reads of each secular load at `time`, and its derivatives by the time.
    fn secular_parts<const N: usize>(&self, output: &Output, time: f64) -> impl Iterator<Item = [f64; N]> {
        self.secular_states(time).map(|(block, states)| states.map(|state| read(output, block, state)))
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
        for [value, slope, curvature] in self.secular_parts(output, time) {
            jet.value += value;
            jet.slope += slope;
            jet.curvature += curvature;
        }
        jet
    }

    /// Adds the particular part of output `index` (with the row `output`) at `start + c_k length` to
    /// `values`.
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
        for (value, c) in values.iter_mut().zip(c) {
            for [part] in self.secular_parts(output, start + c * length) {
                *value += part;
            }
        }
    }

    /// Derivatives of the particular part of output `index` by the scale of the excitation at `start + c_k
    /// length`.
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

    /// Derivatives of the particular part of output `index` by the frequency at the fixed times `start + c_k
    /// length`.
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
        for load in &self.secular {
            for (value, c) in values.iter_mut().zip(c) {
                let [by_frequency, _] = load.by_frequency(start + c * length);
                *value += read(output, load.block, by_frequency);
            }
        }
        values
    }

    /// Adds the rate of the particular part of output `index` (with the row `output`) at `start + c_k length`
    /// to `rates`.
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

    /// Derivatives of the rate of the particular part of output `index` by the scale of the excitation at
    /// `start + c_k length`.
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

    /// Derivatives of the rate of the particular part of output `index` by the frequency at the fixed times
    /// `start + c_k length`.
    ///
    /// That of `Re(i w A exp(i w t))` with `w_f = 2 pi m` is `Re(i (w A_f + w_f A + w w_f i t A) exp(i w
    /// t))`.
    pub fn rates_by_frequency(
        &self,
        index: usize,
        output: &Output,
        (start, length): (f64, f64),
        c: &[f64; NODES],
    ) -> [f64; NODES] {
        let at = |time: f64| {
            let mut rate = 0.0;
            for order in &self.orders {
                let (amplitude, by_frequency) = order.outputs[index];
                let (w, w_f) = (order.order * self.circular_frequency, TAU * order.order);
                let sum = by_frequency * w + amplitude * w_f + amplitude * c64::new(0.0, w * w_f * time);
                rate -= (sum * self.rotation(order, time)).im;
            }
            for load in &self.secular {
                let [_, by_frequency] = load.by_frequency(time);
                rate += read(output, load.block, by_frequency);
            }
            rate
        };
        c.map(|c| at(start + c * length))
    }
}

/// What an output reads of the state of a block.
fn read(output: &Output, block: usize, [p, s]: [f64; 2]) -> f64 {
    output.row[block] * p + output.row[output.row.len() / 2 + block] * s
}

/// Cosines and sines of the angles of the nodes of a step.
fn cosines_and_sines(angles: &[f64; NODES]) -> [[f64; NODES]; 2] {
    if angles.iter().any(|angle| angle.abs() > TURNING) {
        return [angles.map(f64::cos), angles.map(f64::sin)];
    }
    vectorised(
        #[inline(always)]
        || elementary::cosines_and_sines(angles),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cosines_and_sines_of_all_nodes_reach_rounding() {
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
