//! Forces of a step whose laws depend on the velocity: `F = f(r, r')`.
//!
//! With `r = r_free + W F` and `r' = r'_free + W' F` at the nodes, Newton's method from a guess of `(r, r')`
//! solves
//!
//! `(I - f_r W - f_v W') dF = f_r d_r + f_v d_v`, `d_r = r_free + W F - r`, `d_v = r'_free + W' F - r'`,
//!
//! and corrects `r` by `d_r + W dF`, `r'` by `d_v + W' dF`. With the same matrix the sensitivities of the
//! forces are
//!
//! `(I - f_r W - f_v W') dF = f_r (X V + d r_particular) + f_v (X' V + d r'_particular) + f_p`,
//!
//! where `f_p` has the change of the speed that the contact remembers, too (`onset.rs`).
//!
//! The forces are those of a contact that presses, continued smoothly beyond its end, so that no kink lies in
//! the step; where the pressure vanishes is an event (`event.rs`).

use super::{
    collocation::{NODES, NodeMatrix},
    drive::Drive,
    force_step::ForceStep,
    newton::{MAX_ITERATIONS, NotSolved},
    output::Output,
    sensitivity::Sensitivity,
};
use crate::{Law, LawConstant, Parameter, law::ForcePoint};

impl ForceStep {
    /// Solves for displacements and velocities from the guess of them, until what is left is below
    /// `precision` times their range and size, or corrections below their roundings.
    #[inline(never)]
    pub(super) fn solve_damped(
        &mut self,
        laws: &[Law],
        (rounding, rate_rounding, precision): (f64, f64, f64),
    ) -> Result<(), NotSolved> {
        let size = self.free.len();
        for values in [&mut self.force, &mut self.slope, &mut self.damping, &mut self.correction] {
            values.resize(size, 0.0);
        }
        for _ in 0..MAX_ITERATIONS {
            self.evaluate_damped(laws);
            let (gap, gap_rate) = (self.gap(&self.weights.convolution, &self.free, &self.displacement), {
                self.gap(&self.weights.velocity_convolution, &self.free_velocity, &self.velocity)
            });
            for i in 0..size {
                self.correction[i] = self.slope[i] * gap[i] + self.damping[i] * gap_rate[i];
            }
            self.factorise_damped()?;
            self.solve_correction();
            let mut part = 0.0_f64;
            let moved = self.response(&self.weights.convolution);
            let moved_rate = self.response(&self.weights.velocity_convolution);
            for a in 0..self.active.len() {
                let nodes = a * NODES..(a + 1) * NODES;
                let (mut change, mut change_rate, mut range, mut speed) =
                    (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
                for i in nodes.clone() {
                    let (dr, dv) = (gap[i] + moved[i], gap_rate[i] + moved_rate[i]);
                    self.displacement[i] += dr;
                    self.velocity[i] += dv;
                    change = change.max(dr.abs());
                    change_rate = change_rate.max(dv.abs());
                    range = range.max((self.displacement[i] - self.displacement[nodes.start]).abs());
                    speed = speed.max(self.velocity[i].abs());
                }
                let beyond = |change: f64, rounding: f64, size: f64| {
                    if change <= rounding { 0.0 } else { change / size }
                };
                let parts = [beyond(change, rounding, range), beyond(change_rate, rate_rounding, speed)];
                part = parts
                    .iter()
                    .fold(part, |part, other| if other.is_nan() { f64::NAN } else { part.max(*other) });
            }
            if !part.is_finite() {
                return Err(NotSolved);
            }
            // Every matrix is fresh: what is left is about the square of this correction.
            if part * part <= precision {
                self.evaluate_damped(laws);
                return self.if_forces_are_numbers();
            }
        }
        Err(NotSolved)
    }

    fn evaluate_damped(&mut self, laws: &[Law]) {
        for (a, &e) in self.active.iter().enumerate() {
            for i in a * NODES..(a + 1) * NODES {
                let force = laws[e].pressing_force(self.displacement[i], self.velocity[i]);
                self.force[i] = force.value;
                self.slope[i] = force.slope;
                self.damping[i] = force.damping;
            }
        }
    }

    /// `free + W F - now`.
    fn gap(&self, weights: &[NodeMatrix], free: &[f64], now: &[f64]) -> Vec<f64> {
        let mut gap = products(weights, &self.force, self.active.len());
        gap.iter_mut().zip(free.iter().zip(now)).for_each(|(gap, (free, now))| *gap += free - now);
        gap
    }

    /// `W dF`.
    fn response(&self, weights: &[NodeMatrix]) -> Vec<f64> {
        products(weights, &self.correction, self.active.len())
    }

    /// Factorises `I - f_r W - f_v W'`.
    fn factorise_damped(&mut self) -> Result<(), NotSolved> {
        let (count, weights) = (self.active.len(), &self.weights);
        let (slope, damping) = (&self.slope, &self.damping);
        let entry = |place: usize, k: usize, j: usize| {
            let row = place / count * NODES + k;
            slope[row] * weights.convolution[place][j][k]
                + damping[row] * weights.velocity_convolution[place][j][k]
        };
        if count == 1 {
            return self
                .fixed_lu
                .factorise(
                    #[inline(always)]
                    |columns| {
                        for (j, column) in columns.iter_mut().enumerate() {
                            *column = std::array::from_fn(|k| -entry(0, k, j));
                            column[j] += 1.0;
                        }
                    },
                )
                .ok_or(NotSolved);
        }
        let size = count * NODES;
        let fill = |matrix: &mut [f64]| {
            for i in 0..size {
                for j in 0..size {
                    let place = i / NODES * count + j / NODES;
                    matrix[i * size + j] = f64::from(u8::from(i == j)) - entry(place, i % NODES, j % NODES);
                }
            }
        };
        self.lu.factorise(size, fill).ok_or(NotSolved)
    }

    /// Solves for the sensitivities of the forces.
    #[inline(never)]
    pub(super) fn solve_damped_sensitivity(
        &mut self,
        drive: &Drive,
        (laws, outputs): (&[Law], &[Output]),
        sensitivity: &Sensitivity,
        parameter: Option<Parameter>,
    ) -> Result<(), NotSolved> {
        self.factorise_damped()?;
        let columns = sensitivity.columns();
        let size = self.active.len() * NODES;
        self.work.clear();
        self.work.resize(size * columns, 0.0);
        let mut rates = vec![0.0; NODES * columns];
        let (span, c) = ((self.start, self.length), &self.grading().rule().c);
        let frequency = sensitivity.frequency_column();
        let last = parameter.zip(sensitivity.parameter_column());
        for (a, &e) in self.active.iter().enumerate() {
            let nodes = a * NODES..(a + 1) * NODES;
            let target = &mut self.work[nodes.start * columns..nodes.end * columns];
            sensitivity.read(&self.weights.rows[a], target);
            rates.fill(0.0);
            sensitivity.read(&self.weights.velocity_rows[a], &mut rates);
            let (value_f, rate_f) = (
                drive.values_by_frequency(e, &outputs[e], span, c),
                drive.rates_by_frequency(e, &outputs[e], span, c),
            );
            for k in 0..NODES {
                target[k * columns + frequency] += value_f[k];
                rates[k * columns + frequency] += rate_f[k];
            }
            if let Some((Parameter::ExcitationScale, column)) = last {
                let (value_a, rate_a) = (
                    drive.values_by_scale(e, &outputs[e], span, c),
                    drive.rates_by_scale(e, &outputs[e], span, c),
                );
                for k in 0..NODES {
                    target[k * columns + column] += value_a[k];
                    rates[k * columns + column] += rate_a[k];
                }
            }
            let impact = sensitivity.impact_speed(e);
            for (k, i) in nodes.enumerate() {
                let place = k * columns..(k + 1) * columns;
                for (value, rate) in target[place.clone()].iter_mut().zip(&rates[place.clone()]) {
                    *value = self.slope[i] * *value + self.damping[i] * rate;
                }
                if let Some(row) = impact {
                    let factor = laws[e].by_impact_speed(self.displacement[i], self.velocity[i]);
                    target[place].iter_mut().zip(row).for_each(|(value, entry)| *value += factor * entry);
                }
                if let Some((parameter, column)) = last {
                    let (r, v) = (self.displacement[i], self.velocity[i]);
                    let at = ForcePoint { displacement: r, velocity: v, force: self.force[i] };
                    target[k * columns + column] += by_parameter(parameter, e, &laws[e], at, self.slope[i]);
                    if let (Some(value), Some(rate)) = (self.driven.nodes.get(i), self.driven.rates.get(i)) {
                        target[k * columns + column] += self.slope[i] * value + self.damping[i] * rate;
                    }
                }
            }
        }
        self.solve_rows(columns);
        Ok(())
    }
}

/// `f_p` of an element.
fn by_parameter(parameter: Parameter, element: usize, law: &Law, at: ForcePoint, slope: f64) -> f64 {
    match parameter.constant_of(element) {
        Some(LawConstant::Gap) => -slope * law.level_by_gap(at.displacement),
        Some(constant) => law.by_constant(constant, at),
        None => 0.0,
    }
}

/// `sum_b W_ab F_b` for every active element a.
fn products(weights: &[NodeMatrix], force: &[f64], count: usize) -> Vec<f64> {
    let mut sums = vec![0.0; count * NODES];
    for (place, matrix) in weights.iter().enumerate() {
        let (target, force) = (&mut sums[place / count * NODES..][..NODES], &force[place % count * NODES..]);
        for (column, force) in matrix.iter().zip(force) {
            target.iter_mut().zip(column).for_each(|(sum, weight)| *sum += weight * force);
        }
    }
    sums
}
