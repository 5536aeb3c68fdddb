//! One step of the method, for the state and its sensitivities at once.
//!
//! The columns `w = [z, y_1, ..., y_d, y_p]`, `dz/dt = g`, `dy_j/dt = dg/dz y_j`, `dy_p/dt = dg/dz y_p +
//! dg/dp`, lie one after another and go through the same stages. The error of a step is measured as HNW do,
//! but for each part of each column by itself:
//!
//! `error = max over parts of h s_5 / sqrt(s_5 + 0.01 s_3)`, `s_m = sum_i (e_m,i / (tolerance a))^2`,
//!
//! with the largest magnitude `a` of any entry of that part of that column on the way so far; a step is
//! accepted if `error <= 1`. So displacements are held against displacements, velocities against velocities,
//! and a column of the fundamental matrix against itself.

use super::{
    Column, Point, VectorField,
    tableau::{
        ARGUMENTS, Combination, DENSE_ARGUMENTS, DENSE_NODES, END, ERROR_3, ERROR_5, NODES, STAGES, VALUE,
    },
};

/// The columns at the start and at the end of a step, and the slopes between.
pub(super) struct Stepper {
    dimension: usize,
    part: usize,
    /// `w` at the start.
    pub(super) value: Vec<f64>,
    /// `w` at the end.
    pub(super) trial: Vec<f64>,
    slopes: Vec<f64>,
    argument: Vec<f64>,
    third: Vec<f64>,
    largest: Vec<f64>,
    /// Switching functions at the stages, one row each.
    pub(super) switching: Vec<f64>,
    switches: usize,
    /// Calls of [`VectorField::evaluate`].
    pub(super) evaluations: usize,
}

impl Stepper {
    /// Starts from a state, with unit sensitivities if wanted.
    pub(super) fn new(field: &impl VectorField, state: &[f64], sensitivities: bool) -> Self {
        let dimension = state.len();
        let mut value = state.to_vec();
        if sensitivities {
            value.resize(dimension * (dimension + 2), 0.0);
            for i in 0..dimension {
                value[dimension * (i + 1) + i] = 1.0;
            }
        }
        let (length, part, switches) = (value.len(), dimension / field.parts(), field.switches());
        let mut stepper = Self {
            dimension,
            part,
            trial: value.clone(),
            value,
            slopes: vec![0.0; (STAGES + 4) * length],
            argument: vec![0.0; length],
            third: vec![0.0; length],
            largest: vec![0.0; length / part],
            switching: vec![0.0; STAGES * switches],
            switches,
            evaluations: 0,
        };
        stepper.remember_magnitudes(field);
        stepper
    }

    /// The state at the start of the step.
    pub(super) fn state(&self) -> &[f64] {
        &self.value[..self.dimension]
    }

    /// The state at the end of the step.
    pub(super) fn end_state(&self) -> &[f64] {
        &self.trial[..self.dimension]
    }

    /// Slope of that index, its part of the state.
    pub(super) fn slope(&self, index: usize) -> &[f64] {
        &self.slopes[index * self.value.len()..][..self.dimension]
    }

    /// Evaluates the slope at the start.
    pub(super) fn start(&mut self, field: &mut impl VectorField, time: f64, inside: &[bool]) {
        self.argument.copy_from_slice(&self.value);
        self.evaluate(field, 0, time, inside, self.value.len());
    }

    /// Lets the field ready state and sensitivities at the start of a motion.
    pub(super) fn begin(&mut self, field: &mut impl VectorField, time: f64, inside: &mut [bool]) {
        let (state, columns) = self.value.split_at_mut(self.dimension);
        field.begin(time, state, columns, inside);
    }

    /// Lets state and sensitivities jump at a boundary that was crossed.
    pub(super) fn impact(&mut self, field: &mut impl VectorField, time: f64, region: (&mut [bool], &[bool])) {
        let (state, columns) = self.value.split_at_mut(self.dimension);
        field.impact(time, (state, columns), region);
    }

    /// Lets the sensitivities at the start jump at a boundary that was crossed, into one region from another.
    pub(super) fn jump(
        &mut self,
        field: &mut impl VectorField,
        time: f64,
        (inside, before): (&[bool], &[bool]),
    ) {
        let (state, columns) = self.value.split_at_mut(self.dimension);
        field.jump(Point { time, state, inside }, before, columns);
    }

    /// Carries the columns over a step from `time`.
    pub(super) fn attempt(&mut self, field: &mut impl VectorField, time: f64, step: f64, inside: &[bool]) {
        self.carry(field, (time, step), inside, self.value.len());
    }

    /// Carries the state alone over a step from `time`.
    pub(super) fn attempt_state(
        &mut self,
        field: &mut impl VectorField,
        time: f64,
        step: f64,
        inside: &[bool],
    ) {
        self.carry(field, (time, step), inside, self.dimension);
    }

    /// Carries the first `active` entries.
    fn carry(
        &mut self,
        field: &mut impl VectorField,
        (time, step): (f64, f64),
        inside: &[bool],
        active: usize,
    ) {
        let stride = self.value.len();
        self.store_switching(field, 0, time);
        for stage in 1..STAGES {
            let argument = &mut self.argument[..active];
            combine(argument, &self.value, step, ARGUMENTS[stage], &self.slopes, stride);
            let stage_time = time + NODES[stage] * step;
            self.store_switching(field, stage, stage_time);
            self.evaluate(field, stage, stage_time, inside, active);
        }
        combine(&mut self.trial[..active], &self.value, step, VALUE, &self.slopes, stride);
    }

    fn store_switching(&mut self, field: &impl VectorField, stage: usize, time: f64) {
        if self.switches > 0 {
            let state = if stage == 0 { &self.value } else { &self.argument };
            let values = &mut self.switching[stage * self.switches..][..self.switches];
            field.switching(time, &state[..self.dimension], values);
        }
    }

    fn evaluate(
        &mut self,
        field: &mut impl VectorField,
        index: usize,
        time: f64,
        inside: &[bool],
        active: usize,
    ) {
        let (state, columns) = self.argument[..active].split_at(self.dimension);
        let slopes = &mut self.slopes[index * self.value.len()..][..active];
        let (derivative, column_slopes) = slopes.split_at_mut(self.dimension);
        let at = Point { time, state, inside };
        field.evaluate(at, derivative);
        self.evaluations += 1;
        if !columns.is_empty() {
            field.tangents(at, columns, column_slopes);
            let last = column_slopes.len() - self.dimension;
            field.add_by_parameter(at, derivative, &mut column_slopes[last..]);
        }
    }

    /// Error of the attempted step over the tolerance; not a number if the step is not finite.
    pub(super) fn error(&mut self, step: f64, tolerance: f64) -> f64 {
        let length = self.value.len();
        combine_from_zero(&mut self.argument, ERROR_5, &self.slopes, length);
        combine_from_zero(&mut self.third, ERROR_3, &self.slopes, length);
        let parts = self.argument.chunks_exact(self.part).zip(self.third.chunks_exact(self.part));
        let ends = self.trial.chunks_exact(self.part).zip(&self.largest);
        let mut error = 0.0_f64;
        for ((fifth, third), (end, &largest)) in parts.zip(ends) {
            let (fifth, third) = (square(fifth), square(third));
            let scale = tolerance * magnitude(end).max(largest);
            let part = step * fifth / ((fifth + 0.01 * third).sqrt() * scale);
            if !(fifth + third).is_finite() {
                return f64::NAN;
            }
            if fifth > 0.0 && scale > 0.0 {
                error = error.max(part);
            }
        }
        error
    }

    /// Evaluates the slope at the end of the attempted step.
    pub(super) fn finish(&mut self, field: &mut impl VectorField, end: f64, inside: &[bool]) {
        self.argument.copy_from_slice(&self.trial);
        self.evaluate(field, END, end, inside, self.value.len());
    }

    /// Moves on: the end of the attempted step becomes the start of the next.
    pub(super) fn accept(&mut self, field: &impl VectorField) {
        std::mem::swap(&mut self.value, &mut self.trial);
        let length = self.value.len();
        self.slopes.copy_within(END * length..(END + 1) * length, 0);
        self.remember_magnitudes(field);
    }

    fn remember_magnitudes(&mut self, field: &impl VectorField) {
        for (largest, part) in self.largest.iter_mut().zip(self.value.chunks_exact(self.part)) {
            *largest = largest.max(magnitude(part));
        }
        let last = self.dimension + 1;
        for (index, magnitudes) in self.largest.chunks_exact_mut(self.dimension / self.part).enumerate() {
            let column = match index {
                0 => Column::State,
                _ if index == last => Column::ByParameter,
                _ => Column::ByState,
            };
            field.raise_magnitudes(column, magnitudes);
        }
    }

    /// Evaluates the further slopes of the state which dense output needs, and that at the end if it is not
    /// there yet.
    pub(super) fn densify(
        &mut self,
        field: &mut impl VectorField,
        time: f64,
        step: f64,
        inside: &[bool],
        finished: bool,
    ) {
        let (d, length) = (self.dimension, self.value.len());
        if !finished {
            let at = Point { time: time + step, state: &self.trial[..d], inside };
            field.evaluate(at, &mut self.slopes[END * length..][..d]);
            self.evaluations += 1;
        }
        for (k, (node, terms)) in DENSE_NODES.iter().zip(DENSE_ARGUMENTS).enumerate() {
            combine(&mut self.argument[..d], &self.value, step, terms, &self.slopes, length);
            let at = Point { time: time + node * step, state: &self.argument[..d], inside };
            field.evaluate(at, &mut self.slopes[(END + 1 + k) * length..][..d]);
            self.evaluations += 1;
        }
    }

    /// `sum_j a_j k_j` of the state.
    pub(super) fn combination(&self, terms: &Combination, sum: &mut [f64]) {
        combine_from_zero(sum, terms, &self.slopes, self.value.len());
    }
}

#[inline]
fn square(values: &[f64]) -> f64 {
    let mut sum = 0.0;
    for value in values {
        sum += value * value;
    }
    sum
}

#[inline]
fn magnitude(values: &[f64]) -> f64 {
    let mut largest = 0.0_f64;
    for value in values {
        largest = largest.max(value.abs());
    }
    largest
}

/// `sum = base + step sum_j a_j k_j` with slopes `stride` apart.
fn combine(sum: &mut [f64], base: &[f64], step: f64, terms: &Combination, slopes: &[f64], stride: usize) {
    combine_from_zero(sum, terms, slopes, stride);
    for (sum, base) in sum.iter_mut().zip(base) {
        *sum = base + step * *sum;
    }
}

/// `sum = sum_j a_j k_j`, in blocks which stay in registers while the slopes go by.
fn combine_from_zero(sum: &mut [f64], terms: &Combination, slopes: &[f64], stride: usize) {
    let (blocks, rest) = sum.as_chunks_mut::<BLOCK>();
    for (b, block) in blocks.iter_mut().enumerate() {
        *block = block_of(terms, slopes, stride, b * BLOCK);
    }
    let first = BLOCK * blocks.len();
    let (blocks, rest) = rest.as_chunks_mut::<2>();
    for (b, block) in blocks.iter_mut().enumerate() {
        *block = block_of(terms, slopes, stride, first + 2 * b);
    }
    for last in rest {
        [*last] = block_of(terms, slopes, stride, first + 2 * blocks.len());
    }
}

const BLOCK: usize = 8;

#[inline]
fn block_of<const N: usize>(terms: &Combination, slopes: &[f64], stride: usize, offset: usize) -> [f64; N] {
    let mut sum = [0.0; N];
    for &(index, weight) in terms {
        if let Some(slope) = slopes[index * stride + offset..].first_chunk::<N>() {
            for i in 0..N {
                sum[i] += weight * slope[i];
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests;
