//! The bound on the derivatives of a guard over a step with forces: theorem 2 of `enclosure.rs`.

use super::{
    super::{
        ExactIntegrator,
        collocation::{Grading, NODES},
        run::Run,
    },
    Hermite,
};

/// Binomial coefficients of `NODES - 1`.
pub(super) const BINOMIALS: [f64; NODES] = binomials();

impl ExactIntegrator {
    /// `r_n` of the guard with these parts of an element's displacement and velocity in the solved step;
    /// infinite where a load is resonant.
    pub(super) fn remainder(&self, run: &Run, element: usize, [alpha, beta]: [f64; 2]) -> f64 {
        let Some(orders) = self.drive.amplitudes(element) else { return f64::INFINITY };
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
            let (k, rate) = (self.blocks.stiffness[i], self.rates[i]);
            let (mut norm, mut driven) = (self.energy_norm(&run.state, i), [0.0; NODES]);
            for (majorant, input) in &forces {
                let (on_p, on_s) = (input[i], input[n + i]);
                let part = |row: &[f64]| (row[i] * on_p + row[n + i] * on_s).abs();
                let second = part(&output.acceleration_row);
                let sigma = part(&output.velocity_row).max(if rate > 0.0 { second / rate } else { 0.0 });
                norm += length * (k * on_p * on_p + on_s * on_s).sqrt() * majorant[0];
                (0..NODES).for_each(|j| driven[j] += length * length * sigma * majorant[j]);
            }
            let second = if rate > 0.0 { output.second_bound[i] / rate } else { 0.0 };
            add((rate * length, length * output.first_bound[i].max(second) * norm), &driven);
        }
        for (amplitude, frequency) in orders {
            let z = frequency * length;
            add((z, amplitude * z), &[0.0; NODES]);
        }
        alpha * sum[0] + beta * sum[1] / length
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

/// `phi_j` of a force, from its Bernstein coefficients.
fn force_majorant(mut differences: [f64; NODES]) -> [f64; NODES] {
    std::array::from_fn(|j| {
        if j > 0 {
            (0..NODES - j).for_each(|i| differences[i] = differences[i + 1] - differences[i]);
        }
        let largest = differences[..NODES - j].iter().fold(0.0_f64, |largest, d| largest.max(d.abs()));
        BINOMIALS[j] * largest
    })
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
