//! One step while forces act: solves `F_k = f(r_k)` at the nodes and maps the state.
//! Equations (S3) and (S7) of the book, `docs/theory`.
//!
//! `r = r_free + W f(r)` is solved by Newton's method with the small matrix `I - W f'`; the state then goes
//! over the step by `x+ = E x + P F`, and its sensitivities `V` by `dr = (I - W f')^-1 (X V + d
//! r_particular)`, `V+ = E V + P f' dr`. Laws that depend on the velocity see `damped_step.rs`.

use std::sync::Arc;

use super::{
    coinciding::Coinciding,
    collocation::{Grading, NODES},
    drive::{Drive, Jet},
    lanes::{add_products, fixed_dot, raise_by_columns, vectorised},
    lu::{FixedLu, SmallLu},
    newton::NotSolved,
    output::Output,
    sensitivity::{ColumnTail, Sensitivity},
    series::{Readings, Series},
    step_error::{Tail, Unresolved},
    weights::StepWeights,
};
use crate::{Law, Parameter};

/// The state is read for steps longer than the first that is tried by this factor: the next try is not seldom
/// longer.
const READ_AHEAD: f64 = 1.3;

/// Forces of a step and what they were solved with. Node values are indexed `[a * NODES + k]` with the a-th
/// active element.
#[derive(Debug, Clone, Default)]
pub(crate) struct ForceStep {
    /// Matrices of the step: its own, or such as are kept for steps of that length.
    pub weights: Arc<StepWeights>,
    /// Length of the step [s].
    pub length: f64,
    pub grading: Option<Grading>,
    /// Start of the step in the time of the stretch [s].
    pub start: f64,
    pub active: Vec<usize>,
    pub(super) coinciding: Coinciding,
    /// Outputs at its end that were read, apart from the direct part of the forces.
    pub known_ends: Vec<(usize, Jet)>,
    pub displacement: Vec<f64>,
    pub force: Vec<f64>,
    pub slope: Vec<f64>,
    /// Of each direction of a hole the derivative of its force by the displacement in the other one; empty
    /// where no hole acts.
    pub cross: Vec<f64>,
    /// Places among the active elements of the first directions of holes.
    pub(super) holes: Vec<usize>,
    /// Whether a law of an active element depends on the velocity: then velocities go with the displacements
    /// (`damped_step.rs`).
    pub damped: bool,
    pub velocity: Vec<f64>,
    /// `df/dr'`.
    pub damping: Vec<f64>,
    pub(super) free_velocity: Vec<f64>,
    /// What each block, and then each order of the load, has in the force; see `step_error.rs`.
    pub unresolved: Vec<Unresolved>,
    pub(super) free: Vec<f64>,
    readings: Vec<Readings>,
    /// Longest step that the readings serve [s].
    readings_reach: f64,
    pub(super) correction: Vec<f64>,
    pub(super) lu: SmallLu,
    pub(super) fixed_lu: FixedLu<NODES>,
    pub(super) work: Vec<f64>,
    /// Of each column of the sensitivities what [`ForceStep::sensitivity_tails`] adds up.
    column_sums: Vec<f64>,
    /// What a parameter that is not in the forces has in the solved step.
    pub(super) driven: Driven,
}

/// What a parameter that is in the structure (`by_damping.rs`) or in the particular solution has in a solved
/// step; empty where there is none.
#[derive(Debug, Clone, Default)]
pub(super) struct Driven {
    /// Derivative of the displacements at the nodes at given forces, `[a * NODES + k]`.
    pub nodes: Vec<f64>,
    /// The same of the velocities; empty where no law can depend on them.
    pub rates: Vec<f64>,
    /// Derivative of the state at the end.
    pub end: Vec<f64>,
}

impl Driven {
    pub fn clear(&mut self) {
        self.nodes.clear();
        self.rates.clear();
        self.end.clear();
    }
}

fn rows_times_state(rows: &[f64], state: &[f64]) -> [f64; NODES] {
    let mut values = [0.0; NODES];
    for (row, &entry) in rows.chunks_exact(NODES).zip(state) {
        values.iter_mut().zip(row).for_each(|(value, weight)| *value += weight * entry);
    }
    values
}

impl ForceStep {
    /// Time of node k since the start of the step.
    pub fn node_time(&self, k: usize) -> f64 {
        self.grading().rule().c[k] * self.length
    }

    /// The grading of the step.
    pub fn grading(&self) -> Grading {
        self.grading.unwrap_or(Grading::Smooth)
    }

    /// Forgets what was read of the state at the start of the last step.
    pub fn start_anew(&mut self) {
        self.active.clear();
        self.holes.clear();
        self.cross.clear();
        self.readings.clear();
        self.known_ends.clear();
    }

    /// Displacements at the nodes if no force acted in the step that starts from `state`.
    pub fn set_free_motion(&mut self, series: &Series, drive: &Drive, outputs: &[Output], state: &[f64]) {
        self.free.clear();
        if self.length > self.readings_reach {
            self.readings.clear();
        }
        for (a, &e) in self.active.iter().enumerate() {
            let mut free = if self.weights.complete {
                rows_times_state(&self.weights.rows[a], state)
            } else {
                if self.readings.len() == a {
                    self.readings_reach = READ_AHEAD * self.length;
                    self.readings.push(series.readings(e, state, self.readings_reach));
                }
                series.free_values(&self.readings[a], self.grading(), self.length)
            };
            let span = (self.start, self.length);
            drive.add_values(e, &outputs[e], span, &self.grading().rule().c, &mut free);
            self.free.extend_from_slice(&free);
        }
        if self.damped {
            self.set_free_velocity(series, drive, outputs, state);
        }
    }

    /// The same for the velocities.
    #[inline(never)]
    fn set_free_velocity(&mut self, series: &Series, drive: &Drive, outputs: &[Output], state: &[f64]) {
        self.free_velocity.clear();
        for (a, &e) in self.active.iter().enumerate() {
            let mut rates = if self.weights.complete {
                rows_times_state(&self.weights.velocity_rows[a], state)
            } else {
                series.free_rates(&self.readings[a], self.grading(), self.length)
            };
            let span = (self.start, self.length);
            drive.add_rates(e, &outputs[e], span, &self.grading().rule().c, &mut rates);
            self.free_velocity.extend_from_slice(&rates);
        }
    }

    /// An output and its derivatives at the end of the solved step from `state`, apart from the direct part
    /// of the forces.
    pub fn end_jet(&self, output: usize, series: &Series, outputs: &[Output], state: &[f64]) -> Jet {
        let active = self.active.iter().position(|&e| e == output);
        if !self.weights.complete {
            let step = (self.grading(), self.length);
            let loads = (self.active.as_slice(), self.force.as_slice());
            return match active {
                Some(a) => series.end_jet((output, &self.readings[a]), step, loads),
                None => series.end_jet((output, &series.readings(output, state, self.length)), step, loads),
            };
        }
        let mut end = state.to_vec();
        self.advance_state(series, &mut end);
        let o = &outputs[output];
        let read = |row: &[f64]| row.iter().zip(&end).map(|(r, x)| r * x).sum();
        Jet { value: read(&o.row), slope: read(&o.velocity_row), curvature: read(&o.acceleration_row) }
    }

    /// State at the end of the step.
    pub fn advance_state(&self, series: &Series, state: &mut [f64]) {
        let n = state.len() / 2;
        for (i, propagator) in self.weights.propagators.iter().enumerate() {
            (state[i], state[n + i]) = propagator.apply(state[i], state[n + i]);
        }
        let forces = self.active.iter().zip(self.force.as_chunks::<NODES>().0);
        for (a, (&element, force)) in forces.enumerate() {
            if !self.weights.complete {
                series.add_force(element, (self.grading(), self.length), force, state);
                continue;
            }
            for (x, weights) in state.iter_mut().zip(self.weights.to_state[a].as_chunks::<NODES>().0) {
                *x += fixed_dot(weights, force);
            }
        }
    }

    /// Solves for the sensitivities `dF = f' (I - W f')^-1 (X V + d r_particular)` of the forces; by a
    /// parameter see `by_parameter.rs`.
    pub fn solve_sensitivity(
        &mut self,
        drive: &Drive,
        (laws, outputs): (&[Law], &[Output]),
        sensitivity: &Sensitivity,
        parameter: Option<Parameter>,
    ) -> Result<(), NotSolved> {
        if self.damped {
            return self.solve_damped_sensitivity(drive, (laws, outputs), sensitivity, parameter);
        }
        self.factorise()?;
        let columns = sensitivity.columns();
        let size = self.active.len() * NODES;
        self.work.clear();
        self.work.resize(size * columns, 0.0);
        let (span, c) = ((self.start, self.length), &self.grading().rule().c);
        for (a, &e) in self.active.iter().enumerate() {
            let target = &mut self.work[a * NODES * columns..(a + 1) * NODES * columns];
            sensitivity.read(&self.weights.rows[a], target);
            let by_frequency = drive.values_by_frequency(e, &outputs[e], span, c);
            for (row, value) in target.chunks_exact_mut(columns).zip(by_frequency) {
                row[sensitivity.frequency_column()] += value;
            }
        }
        let column = parameter.zip(sensitivity.parameter_column());
        if let Some((parameter, column)) = column {
            self.add_parameter(parameter, drive, (laws, outputs), (column, columns));
        }
        self.solve_rows(columns);
        self.turn_into_forces(columns);
        if let Some((parameter, column)) = column {
            self.add_direct_part(parameter, laws, (column, columns));
        }
        Ok(())
    }

    /// Multiplies sensitivities of displacements by the derivatives of the forces.
    fn turn_into_forces(&mut self, columns: usize) {
        let across = self.across_at_nodes(columns);
        vectorised(
            #[inline(always)]
            || {
                for (row, slope) in self.work.chunks_exact_mut(columns).zip(&self.slope) {
                    row.iter_mut().for_each(|value| *value *= slope);
                }
            },
        );
        for (first, added) in across {
            let rows = &mut self.work[first * NODES * columns..(first + 2) * NODES * columns];
            rows.iter_mut().zip(added).for_each(|(value, added)| *value += added);
        }
    }

    /// Of each hole the parts of the sensitivities of its forces that come from the other direction.
    fn across_at_nodes(&self, columns: usize) -> Vec<(usize, Vec<f64>)> {
        let of_hole = |&first: &usize| {
            let row = |a: usize, k: usize| &self.work[(a * NODES + k) * columns..][..columns];
            let mut added = Vec::with_capacity(2 * NODES * columns);
            for (a, other) in [(first, first + 1), (first + 1, first)] {
                for k in 0..NODES {
                    let cross = self.cross[a * NODES + k];
                    added.extend(row(other, k).iter().map(|value| cross * value));
                }
            }
            (first, added)
        };
        self.holes.iter().map(of_hole).collect()
    }

    /// Whether a round hole acts.
    pub fn has_holes(&self) -> bool {
        !self.holes.is_empty()
    }

    /// Displacements at the nodes of the a-th active element; the readings of a hole, if it is its first
    /// direction.
    pub fn nodal_readings(&self, laws: &[Law], a: usize) -> [f64; NODES] {
        let own = |a: usize, k: usize| self.displacement[a * NODES + k];
        let hole = laws[self.active[a]].round_hole();
        std::array::from_fn(|k| match hole {
            Some(hole) => hole.reading([own(a, k), 0.0, 0.0], [own(a + 1, k), 0.0, 0.0])[0],
            None => own(a, k),
        })
    }

    /// Takes the sensitivities over the step, once those of its forces are solved for.
    pub fn advance_sensitivity(&self, sensitivity: &mut Sensitivity, parameter: Option<Parameter>) {
        let columns = sensitivity.columns();
        sensitivity.propagate(&self.weights.propagators);
        if let (Some(_), Some(column)) = (parameter, sensitivity.parameter_column()) {
            self.driven.end.iter().enumerate().for_each(|(i, &value)| sensitivity.add_to(column, i, value));
        }
        for (a, to_state) in self.weights.to_state.iter().enumerate().take(self.active.len()) {
            sensitivity.add(to_state, &self.work[a * NODES * columns..(a + 1) * NODES * columns]);
        }
    }

    /// Tail and largest value of each sensitivity of the force of the a-th active element, once solved for,
    /// and the largest velocity before the step.
    pub fn sensitivity_tails(
        &mut self,
        a: usize,
        sensitivity: &Sensitivity,
    ) -> impl Iterator<Item = ColumnTail> {
        let columns = sensitivity.columns();
        let coefficients = &self.grading().rule().coefficients;
        let work = &self.work[a * NODES * columns..(a + 1) * NODES * columns];
        let degrees = [NODES - 1, NODES - 2, NODES / 2, NODES / 2 - 1];
        // Largest velocities, largest forces, and a coefficient of each degree.
        let all = &mut self.column_sums;
        all.clear();
        all.resize((2 + degrees.len()) * columns, 0.0);
        let (velocities, forces) = all.split_at_mut(columns);
        let (largest, sums) = forces.split_at_mut(columns);
        sensitivity.raise_velocity_norms(velocities);
        raise_by_columns(largest, work);
        add_products(sums, work, columns, |row| coefficients[degrees[row]].iter().copied());
        (0..sensitivity.used_columns()).map(move |c| {
            let pair = |row: usize| all[row * columns + c].abs() + all[(row + 1) * columns + c].abs();
            let tail = Tail { highest: pair(2), middle: pair(4) };
            ColumnTail { velocity: all[c], largest: all[columns + c], tail }
        })
    }

    /// Moves the displacements of the last solution to a step whose length differs by the part `change`.
    pub fn shift_guess(&mut self, change: f64) {
        let rule = self.grading().rule();
        for values in self.displacement.chunks_exact_mut(NODES).chain(self.velocity.chunks_exact_mut(NODES)) {
            let nodal: [f64; NODES] = std::array::from_fn(|k| values[k]);
            let slope = rule.derivative(&nodal);
            (0..NODES).for_each(|k| values[k] += slope[k] * rule.lag[k] * change);
        }
    }

    /// Value of a polynomial over the step, given at the nodes of the a-th active element, at `s` in [0, 1].
    pub fn interpolate(&self, values: &[f64], a: usize, s: f64) -> f64 {
        let lagrange = self.grading().rule().lagrange(s);
        (0..NODES).map(|k| lagrange[k] * values[a * NODES + k]).sum()
    }

    /// How the orthonormal expansion of nodal values ends.
    pub fn tail(&self, values: &[f64; NODES]) -> Tail {
        let coefficients = &self.grading().rule().coefficients;
        let of = |degree: usize| fixed_dot(&coefficients[degree], values).abs();
        let pair = |degree: usize| of(degree) + of(degree - 1);
        Tail { highest: pair(NODES - 1), middle: pair(NODES / 2) }
    }
}
