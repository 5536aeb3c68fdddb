//! Sensitivities of the homogeneous block state to the initial state, to the frequency and to a parameter.

use faer::Mat;

use super::{
    block::Blocks,
    collocation::NODES,
    lanes::{add_products, raise_by_columns, vectorised},
    propagator::Propagator,
    step_error::Tail,
};

/// Of one column of sensitivities in a step.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ColumnTail {
    /// Largest velocity before the step.
    pub velocity: f64,
    /// Largest sensitivity of the force.
    pub largest: f64,
    /// Tail of the sensitivity of the force.
    pub tail: Tail,
}

/// The matrix `V` of 2n rows: a column per initial state, one for the frequency, one for a parameter if
/// wanted, and padding to a multiple of four.
///
/// Rows are contiguous, so every inner loop runs along a row.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sensitivity {
    rows: usize,
    columns: usize,
    values: Vec<f64>,
    has_parameter: bool,
    /// Sensitivities of the speed with which the last contact of an element began; empty where nothing is
    /// remembered.
    impact_speeds: Vec<Vec<f64>>,
}

impl Sensitivity {
    /// Sensitivities at the start of a stretch: `S^-1`, `frequency`, and the column of a parameter, if one is
    /// wanted.
    pub fn start(&mut self, blocks: &Blocks, frequency: &[f64], parameter: Option<&[f64]>) {
        self.rows = 2 * blocks.count();
        // An even number of rows leaves room for two columns besides.
        self.columns = (self.rows + 4) / 4 * 4;
        self.has_parameter = parameter.is_some();
        self.impact_speeds.clear();
        self.values.clear();
        self.values.resize(self.rows * self.columns, 0.0);
        for i in 0..self.rows {
            match &blocks.transform {
                None => self.values[i * self.columns + i] = 1.0,
                Some(transform) => {
                    (0..self.rows)
                        .for_each(|j| self.values[i * self.columns + j] = transform.to_blocks[(i, j)]);
                }
            }
            self.values[i * self.columns + self.rows] = frequency[i];
            if let Some(parameter) = parameter {
                self.values[i * self.columns + self.rows + 1] = parameter[i];
            }
        }
    }

    pub fn columns(&self) -> usize {
        self.columns
    }

    pub fn frequency_column(&self) -> usize {
        self.rows
    }

    /// Column of the parameter, if there is one.
    pub fn parameter_column(&self) -> Option<usize> {
        self.has_parameter.then_some(self.rows + 1)
    }

    /// Columns that are not padding.
    pub fn used_columns(&self) -> usize {
        self.rows + 1 + usize::from(self.has_parameter)
    }

    /// One column, length 2n.
    pub fn column(&self, column: usize) -> Vec<f64> {
        self.values.chunks_exact(self.columns).map(|row| row[column]).collect()
    }

    /// Writes one column, length 2n.
    pub fn set_column(&mut self, column: usize, values: &[f64]) {
        let rows = self.values.chunks_exact_mut(self.columns);
        rows.zip(values).for_each(|(row, value)| row[column] = *value);
    }

    fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.values[i * self.columns..(i + 1) * self.columns]
    }

    /// Takes the sensitivities over a flight or the linear part of a step.
    pub fn propagate(&mut self, propagators: &[Propagator]) {
        let half = self.values.len() / 2;
        let columns = self.columns;
        let (positions, velocities) = self.values.split_at_mut(half);
        let rows = positions.chunks_exact_mut(columns).zip(velocities.chunks_exact_mut(columns));
        vectorised(
            #[inline(always)]
            || {
                for ((p, s), propagator) in rows.zip(propagators) {
                    for (p, s) in p.iter_mut().zip(s) {
                        (*p, *s) = propagator.apply(*p, *s);
                    }
                }
            },
        );
    }

    /// Adds `X V` for the rows of one element to `[k * columns + column]`.
    pub fn read(&self, rows: &[f64], into: &mut [f64]) {
        add_products(into, &self.values, self.columns, |k| rows[k..].iter().step_by(NODES).copied());
    }

    /// Adds `P dF` for one element.
    pub fn add(&mut self, to_state: &[f64], force: &[f64]) {
        let weights = to_state.as_chunks::<NODES>().0;
        add_products(&mut self.values, force, self.columns, |i| weights[i].iter().copied());
    }

    /// Keeps the sensitivities of the speed with which a contact of an element began.
    pub fn remember_impact(&mut self, element: usize, row: Vec<f64>) {
        if self.impact_speeds.len() <= element {
            self.impact_speeds.resize(element + 1, Vec::new());
        }
        self.impact_speeds[element] = row;
    }

    /// The same for a contact that began before, by the initial states alone.
    pub fn recall_impact(&mut self, element: usize, by_state: &[f64]) {
        let mut row = by_state.to_vec();
        row.resize(self.columns, 0.0);
        self.remember_impact(element, row);
    }

    /// Sensitivities of the speed with which the present contact of an element began, if it is remembered.
    pub fn impact_speed(&self, element: usize) -> Option<&[f64]> {
        self.impact_speeds.get(element).map(Vec::as_slice).filter(|row| !row.is_empty())
    }

    /// With nothing but a unit, in the first column, in the speed with which the present contact of an
    /// element began.
    pub fn by_impact_speed_alone(&self, element: usize) -> Self {
        let values = vec![0.0; self.values.len()];
        let mut alone = Self { values, impact_speeds: Vec::new(), has_parameter: false, ..*self };
        let mut unit = vec![0.0; self.columns];
        unit[0] = 1.0;
        alone.remember_impact(element, unit);
        alone
    }

    /// The columns by initial states, 2n x 2n.
    pub fn by_initial_state(&self) -> Mat<f64> {
        Mat::from_fn(self.rows, self.rows, |i, j| self.values[i * self.columns + j])
    }

    /// `row V`, one entry per column.
    pub fn combined(&self, row: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.columns];
        for (weight, values) in row.iter().zip(self.values.chunks_exact(self.columns)) {
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
        }
        sums
    }

    /// Adds `factor column row`.
    pub fn add_outer(&mut self, column: &[f64], factor: f64, row: &[f64]) {
        for (weight, values) in column.iter().zip(self.values.chunks_exact_mut(self.columns)) {
            values.iter_mut().zip(row).for_each(|(value, entry)| *value += factor * weight * entry);
        }
    }

    /// Largest velocity of each column, raised from what is in `norms`.
    pub fn raise_velocity_norms(&self, norms: &mut [f64]) {
        raise_by_columns(norms, &self.values[self.values.len() / 2..]);
    }

    /// Largest `sqrt(k p^2 + s^2)/scale` of block i over the columns of initial states.
    pub fn largest_energy_norm(&self, i: usize, stiffness: f64, scale: &impl Fn(usize) -> f64) -> f64 {
        let (positions, velocities) = self.values.split_at(self.values.len() / 2);
        let row = i * self.columns..i * self.columns + self.rows;
        let columns = positions[row.clone()].iter().zip(&velocities[row]).enumerate();
        let squares = columns.map(|(j, (p, s))| (stiffness * p * p + s * s) / scale(j).powi(2));
        squares.fold(0.0, f64::max).sqrt()
    }

    /// Largest `sqrt(k p^2 + s^2)` over the blocks of one column: the largest velocity that it can reach.
    pub fn energy_norm_of(&self, column: usize, stiffness: &[f64]) -> f64 {
        let (positions, velocities) = self.values.split_at(self.values.len() / 2);
        let rows = positions.chunks_exact(self.columns).zip(velocities.chunks_exact(self.columns));
        let squares =
            rows.zip(stiffness).map(|((p, s), k)| k * p[column] * p[column] + s[column] * s[column]);
        squares.fold(0.0, f64::max).sqrt()
    }

    /// Adds to an entry of a column.
    pub fn add_to(&mut self, column: usize, i: usize, value: f64) {
        self.row_mut(i)[column] += value;
    }

    /// Writes the modal fundamental matrix, frequency column and parameter column (which may be empty).
    pub fn write(
        &self,
        blocks: &Blocks,
        by_state: &mut Mat<f64>,
        by_frequency: &mut [f64],
        by_parameter: &mut [f64],
    ) {
        let rows = self.rows;
        let entry = |i: usize, j: usize| self.values[i * self.columns + j];
        let modal = |i: usize, j: usize| match &blocks.transform {
            None => entry(i, j),
            Some(transform) => (0..rows).map(|k| transform.from_blocks[(i, k)] * entry(k, j)).sum(),
        };
        for j in 0..rows {
            (0..rows).for_each(|i| by_state[(i, j)] = modal(i, j));
        }
        (0..rows).for_each(|i| by_frequency[i] = modal(i, rows));
        by_parameter.iter_mut().enumerate().for_each(|(i, value)| *value = modal(i, rows + 1));
    }
}
