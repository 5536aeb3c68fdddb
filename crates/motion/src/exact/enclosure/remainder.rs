//! The bound on the derivatives of a guard over a step with forces: theorems 2 to 5 of `enclosure.rs`.

use super::{
    super::{
        ExactIntegrator,
        block::Blocks,
        collocation::{Grading, NODES},
        lanes::vectorised,
        majorant::Majorant,
        output::Output,
        run::Run,
    },
    Hermite, MOST,
};
use crate::law::RoundHole;

/// Binomial coefficients of `NODES - 1`.
pub(super) const BINOMIALS: [f64; NODES] = binomials();

const _: () = assert!(MOST < Majorant::DERIVATIVES as usize, "every coefficient in use is bounded");

/// What the blocks of a structure have in common in the bound on the derivatives of an output.
#[derive(Debug, Clone, Default)]
pub(in crate::exact) struct InCommon {
    /// Of the fastest block, `z/h`.
    rate: f64,
    /// Factors of the energy norms in `D_0/h`.
    of_norms: Vec<f64>,
    /// Factors of `max |F_a|` in `D_0/h^2` and of `phi_a` in the driving series over `h^2`, for each input.
    of_forces: Vec<[f64; 2]>,
}

impl InCommon {
    pub(in crate::exact) fn new(blocks: &Blocks, output: &Output, inputs: &[Vec<f64>]) -> Self {
        let n = blocks.count();
        let rates = blocks.rates();
        let of_norms: Vec<f64> = (0..n).map(|i| start_factor(output, i, rates[i])).collect();
        let of_input = |input: &Vec<f64>| {
            let mut sums = [0.0; 2];
            for i in 0..n {
                sums[0] += of_norms[i] * norm_by_force(blocks, input, i);
                sums[1] += sigma(output, input, (i, rates[i]));
            }
            sums
        };
        let of_forces = inputs.iter().map(of_input).collect();
        Self { rate: rates.into_iter().fold(0.0, f64::max), of_norms, of_forces }
    }
}

/// `D_0/h` of block i per its energy norm.
fn start_factor(output: &Output, i: usize, rate: f64) -> f64 {
    output.first_bound[i].max(if rate > 0.0 { output.second_bound[i] / rate } else { 0.0 })
}

/// `|B_a|` in the energy norm of block i.
fn norm_by_force(blocks: &Blocks, input: &[f64], i: usize) -> f64 {
    let (on_p, on_s) = (input[i], input[blocks.count() + i]);
    (blocks.stiffness[i] * on_p * on_p + on_s * on_s).sqrt()
}

/// `sigma_a` of block i.
fn sigma(output: &Output, input: &[f64], (i, rate): (usize, f64)) -> f64 {
    let n = input.len() / 2;
    let part = |row: &[f64]| (row[i] * input[i] + row[n + i] * input[n + i]).abs();
    let second = part(&output.acceleration_row);
    part(&output.velocity_row).max(if rate > 0.0 { second / rate } else { 0.0 })
}

impl ExactIntegrator {
    /// A bound on `r_n` from what all blocks have in common: never below [`remainder`](Self::remainder).
    pub(super) fn common_remainder(&self, run: &Run, element: usize, [alpha, beta]: [f64; 2]) -> f64 {
        let (step, common) = (&self.step, &self.in_common[element]);
        let (length, rule) = (step.length, step.grading().rule());
        let norms = common.of_norms.iter().enumerate();
        let mut start: f64 = norms.map(|(i, factor)| factor * self.energy_norm(&run.state, i)).sum();
        let (mut rate, mut driven) = (common.rate, [0.0; NODES]);
        for (force, &active) in step.force.as_chunks::<NODES>().0.iter().zip(&step.active) {
            let (majorant, factors) =
                (force_majorant(rule.bernstein_of_whole(force)), common.of_forces[active]);
            start += length * factors[0] * majorant[0];
            (0..NODES).for_each(|j| driven[j] += length * length * factors[1] * majorant[j]);
        }
        for of_load in self.of_loads(element) {
            start += of_load.speed;
            rate = rate.max(of_load.rate);
            driven[0] += length * length * of_load.acceleration;
        }
        let series = DerivativeSeries::of(step.grading());
        let [displacement, velocity] = series.last(rate * length, start * length, &driven);
        alpha * displacement + beta * velocity / length
    }

    /// `r_n` of the guard with these parts of an element's displacement and velocity in the solved step.
    pub(super) fn remainder(&self, run: &Run, element: usize, [alpha, beta]: [f64; 2]) -> f64 {
        let (n, step, output) = (self.blocks.count(), &self.step, &self.outputs[element]);
        let (length, rule) = (step.length, step.grading().rule());
        let of_force = |force: &[f64; NODES]| force_majorant(rule.bernstein_of_whole(force));
        let forces: Vec<([f64; NODES], &[f64])> = step
            .force
            .as_chunks::<NODES>()
            .0
            .iter()
            .zip(&step.active)
            .map(|(force, &active)| (of_force(force), self.inputs[active].as_slice()))
            .collect();
        let series = DerivativeSeries::of(step.grading());
        let mut sum = [0.0; 2];
        let mut add = |(z, start): (f64, f64), driven: &[f64; NODES]| {
            let [displacement, velocity] = series.last(z, start, driven);
            sum[0] += displacement;
            sum[1] += velocity;
        };
        for i in 0..n {
            let rate = self.rates[i];
            let (mut norm, mut driven) = (self.energy_norm(&run.state, i), [0.0; NODES]);
            for (majorant, input) in &forces {
                norm += length * norm_by_force(&self.blocks, input, i) * majorant[0];
                let sigma = sigma(output, input, (i, rate));
                (0..NODES).for_each(|j| driven[j] += length * length * sigma * majorant[j]);
            }
            add((rate * length, length * start_factor(output, i, rate) * norm), &driven);
        }
        for of_load in self.of_loads(element) {
            add((of_load.rate * length, of_load.speed * length), &driven_by(&of_load, length));
        }
        alpha * sum[0] + beta * sum[1] / length
    }

    /// `r_n` of the reading of a hole in the solved step (theorem 5).
    pub(super) fn reading_remainder(&self, run: &Run, element: usize, hole: &RoundHole) -> f64 {
        let count = Hermite::of(self.step.grading()).count;
        let of_output = |output: usize| {
            let series = self.displacement_series(run, output);
            (0..=count).map(|j| series[j] * series[count - j]).sum::<f64>()
        };
        0.5 * (of_output(element) + of_output(element + 1)) / hole.clearance()
    }

    /// The series Y with `y << Y` over the solved step for an output y.
    pub(super) fn displacement_series(&self, run: &Run, output: usize) -> [f64; MOST] {
        let (step, read) = (&self.step, &self.outputs[output]);
        let (length, rule) = (step.length, step.grading().rule());
        let forces: Vec<([f64; NODES], &[f64])> = (step.force.as_chunks::<NODES>().0.iter())
            .zip(&step.active)
            .map(|(force, &active)| {
                (force_majorant(rule.bernstein_of_whole(force)), self.inputs[active].as_slice())
            })
            .collect();
        let recurrence = DerivativeSeries::of(step.grading());
        let mut series = [0.0; MOST];
        series[0] = run.start[output].output.value.abs();
        let mut add = |(z, start): (f64, f64), driven: &[f64; NODES]| {
            series[0] += start;
            recurrence.add_displacements((z, start), driven, &mut series);
        };
        for (i, &rate) in self.rates.iter().enumerate() {
            let (mut norm, mut driven) = (self.energy_norm(&run.state, i), [0.0; NODES]);
            for (majorant, input) in &forces {
                norm += length * norm_by_force(&self.blocks, input, i) * majorant[0];
                let sigma = sigma(read, input, (i, rate));
                (0..NODES).for_each(|j| driven[j] += length * length * sigma * majorant[j]);
            }
            add((rate * length, length * start_factor(read, i, rate) * norm), &driven);
        }
        for of_load in self.of_loads(output) {
            add((of_load.rate * length, of_load.speed * length), &driven_by(&of_load, length));
        }
        series
    }

    /// Bounds on the parts of the loads in an output over the solved step.
    fn of_loads(&self, output: usize) -> impl Iterator<Item = Majorant> {
        self.drive.majorants(output, &self.outputs[output], self.step.start + self.step.length)
    }
}

/// The recurrence of theorem 2 for one grading.
#[derive(Debug, Clone, Copy)]
pub(super) struct DerivativeSeries {
    /// `n`.
    count: usize,
    /// The coefficients of gamma.
    gamma: [f64; 2],
}

impl DerivativeSeries {
    pub(super) fn of(grading: Grading) -> Self {
        let gamma = if grading == Grading::Smooth { [1.0, 0.0] } else { [2.0, 2.0] };
        Self { count: Hermite::of(grading).count, gamma }
    }

    /// Adds `[gamma D]_(j-1)/j` for j from 1 to n, from z, `D_0` and the coefficients of `h^2 sum sigma_a
    /// phi_a`.
    fn add_displacements(self, (z, start): (f64, f64), driven: &[f64; NODES], sums: &mut [f64; MOST]) {
        let (mut current, mut before, mut rate_before) = (start, 0.0, 0.0);
        for j in 0..self.count {
            sums[j + 1] += (self.gamma[0] * current + self.gamma[1] * before) / (j + 1) as f64;
            let rate = z * current + driven.get(j).copied().unwrap_or(0.0);
            let next = (self.gamma[0] * rate + self.gamma[1] * rate_before) / (j + 1) as f64;
            (before, current, rate_before) = (current, next, rate);
        }
    }

    /// `[gamma D]_(n-1)/n` and `D_n`, from z, `D_0` and the coefficients of `h^2 sum sigma_a phi_a`.
    pub(super) fn last(self, z: f64, start: f64, driven: &[f64; NODES]) -> [f64; 2] {
        let (mut current, mut rate_before, mut displacement) = (start, 0.0, 0.0);
        let mut before = 0.0;
        for j in 0..self.count {
            if j + 1 == self.count {
                displacement = (self.gamma[0] * current + self.gamma[1] * before) / self.count as f64;
            }
            let rate = z * current + driven.get(j).copied().unwrap_or(0.0);
            let next = (self.gamma[0] * rate + self.gamma[1] * rate_before) / (j + 1) as f64;
            (before, current, rate_before) = (current, next, rate);
        }
        [displacement, current]
    }
}

/// The driving series of the part of a load.
fn driven_by(of_load: &Majorant, length: f64) -> [f64; NODES] {
    let mut driven = [0.0; NODES];
    driven[0] = length * length * of_load.acceleration;
    driven
}

/// `phi_j` of a force, from its Bernstein coefficients.
fn force_majorant(coefficients: [f64; NODES]) -> [f64; NODES] {
    vectorised(
        #[inline(always)]
        || {
            let (mut differences, mut majorant) = (coefficients, BINOMIALS);
            for (j, bound) in majorant.iter_mut().enumerate() {
                *bound *= differences.iter().fold(0.0, |most, d| if d.abs() > most { d.abs() } else { most });
                // There is one difference less. All loops have a fixed length: what they work on stays in
                // registers.
                differences = std::array::from_fn(|i| {
                    if i + 1 + j < NODES { differences[(i + 1) % NODES] - differences[i] } else { 0.0 }
                });
            }
            majorant
        },
    )
}

const fn binomials() -> [f64; NODES] {
    let mut all = [1.0; NODES];
    let mut i = 1;
    while i < NODES {
        all[i] = all[i - 1] * (NODES - i) as f64 / i as f64;
        i += 1;
    }
    all
}
