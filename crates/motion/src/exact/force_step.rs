//! One step while forces act: solves `F_k = f(r_k)` at the nodes and maps the state.
//!
//! `r = r_free + W f(r)` is solved by Newton's method with the small matrix `I - W f'`; the state then goes over the step
//! by `x+ = E x + P F`, and its sensitivities `V` by `dr = (I - W f')^-1 (X V + d r_particular)`, `V+ = E V + P f' dr`.

use super::{
    block::Blocks,
    collocation::{Grading, NODES},
    drive::{Drive, Jet},
    lu::SmallLu,
    output::Output,
    sensitivity::Sensitivity,
    weights::{Readings, Series, StepWeights},
};
use crate::Law;

/// Newton's method has converged when the last correction is this small against the largest penetration: it converges
/// quadratically, so what is left is below rounding.
const CONVERGED: f64 = 1e-8;
const MAX_ITERATIONS: usize = 30;

/// Forces of a step and what they were solved with. Node values are indexed `[a * NODES + k]` with the a-th active element.
#[derive(Debug, Clone, Default)]
pub(crate) struct ForceStep {
    pub weights: StepWeights,
    pub grading: Option<Grading>,
    /// Start of the step in the time of the stretch [s].
    pub start: f64,
    pub active: Vec<usize>,
    pub displacement: Vec<f64>,
    pub force: Vec<f64>,
    pub slope: Vec<f64>,
    free: Vec<f64>,
    readings: Vec<Readings>,
    correction: Vec<f64>,
    lu: SmallLu,
    work: Vec<f64>,
}

fn rows_times_state(rows: &[f64], state: &[f64]) -> [f64; NODES] {
    let mut values = [0.0; NODES];
    for (row, &entry) in rows.chunks_exact(NODES).zip(state) {
        values.iter_mut().zip(row).for_each(|(value, weight)| *value += weight * entry);
    }
    values
}

/// The forces of a step were not found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NotSolved;

impl ForceStep {
    /// Time of node k since the start of the step.
    pub fn node_time(&self, k: usize) -> f64 {
        self.grading().rule().c[k] * self.weights.length
    }

    /// The grading of the step.
    pub fn grading(&self) -> Grading {
        self.grading.unwrap_or(Grading::Smooth)
    }

    /// Displacements at the nodes if no force acted in the step that starts from `state`.
    pub fn set_free_motion(&mut self, series: &Series, drive: &Drive, outputs: &[Output], state: &[f64]) {
        self.free.clear();
        self.readings.clear();
        for (a, &e) in self.active.iter().enumerate() {
            let mut free = if self.weights.complete {
                rows_times_state(&self.weights.rows[a], state)
            } else {
                let readings = series.readings(e, state, self.weights.length);
                self.readings.push(readings);
                series.free_values(&readings, self.grading(), self.weights.length)
            };
            for (k, value) in free.iter_mut().enumerate() {
                *value += drive.value(e, &outputs[e], self.start + self.node_time(k));
            }
            self.free.extend_from_slice(&free);
        }
    }

    /// Value and slope of the a-th active element at the end of the solved step from `state`, without the direct part of forces.
    pub fn end_jet(&self, a: usize, series: &Series, drive: &Drive, outputs: &[Output], next_state: &[f64]) -> Jet {
        let e = self.active[a];
        let mut jet = drive.jet(e, &outputs[e], self.start + self.weights.length);
        if self.weights.complete {
            for (i, &x) in next_state.iter().enumerate() {
                jet.value += outputs[e].row[i] * x;
                jet.slope += outputs[e].velocity_row[i] * x;
            }
            return jet;
        }
        let step = (self.grading(), self.weights.length);
        let (value, slope) =
            series.end_values((e, &self.readings[a]), step, (self.active.as_slice(), self.force.as_slice()));
        jet.value += value;
        jet.slope += slope;
        jet
    }

    /// Solves for the displacements from the guess in `displacement`. `scale` is a length below which corrections are rounding.
    pub fn solve(&mut self, laws: &[Law], scale: f64) -> Result<(), NotSolved> {
        let size = self.free.len();
        self.force.resize(size, 0.0);
        self.slope.resize(size, 0.0);
        self.correction.resize(size, 0.0);
        self.evaluate(laws);
        for _ in 0..MAX_ITERATIONS {
            self.fill_defect();
            self.factorise()?;
            self.lu.solve(&mut self.correction, 1);
            let (mut largest, mut range) = (0.0_f64, 0.0_f64);
            for i in 0..size {
                self.displacement[i] -= self.correction[i];
                largest = largest.max(self.correction[i].abs());
                range = range.max((self.displacement[i] - self.displacement[0]).abs());
            }
            if !largest.is_finite() {
                return Err(NotSolved);
            }
            self.evaluate(laws);
            if largest <= CONVERGED * range || largest <= scale {
                return Ok(());
            }
        }
        Err(NotSolved)
    }

    fn evaluate(&mut self, laws: &[Law]) {
        for (a, &e) in self.active.iter().enumerate() {
            for i in a * NODES..(a + 1) * NODES {
                let force = laws[e].force(self.displacement[i]);
                self.force[i] = force.value;
                self.slope[i] = force.slope;
            }
        }
    }

    /// `r - r_free - W f(r)`.
    fn fill_defect(&mut self) {
        let count = self.active.len();
        for a in 0..count {
            for k in 0..NODES {
                let mut defect = self.displacement[a * NODES + k] - self.free[a * NODES + k];
                for b in 0..count {
                    let row = &self.weights.convolution[a * count + b][k * NODES..(k + 1) * NODES];
                    let force = &self.force[b * NODES..(b + 1) * NODES];
                    defect -= row.iter().zip(force).map(|(w, f)| w * f).sum::<f64>();
                }
                self.correction[a * NODES + k] = defect;
            }
        }
    }

    /// Factorises `I - W f'`.
    fn factorise(&mut self) -> Result<(), NotSolved> {
        let (count, weights, slope) = (self.active.len(), &self.weights, &self.slope);
        let size = count * NODES;
        let fill = |matrix: &mut [f64]| {
            for a in 0..count {
                for b in 0..count {
                    let convolution = &weights.convolution[a * count + b];
                    for k in 0..NODES {
                        for j in 0..NODES {
                            matrix[(a * NODES + k) * size + b * NODES + j] =
                                -convolution[k * NODES + j] * slope[b * NODES + j];
                        }
                    }
                }
            }
            (0..size).for_each(|i| matrix[i * size + i] += 1.0);
        };
        self.lu.factorise(size, fill).ok_or(NotSolved)
    }

    /// State at the end of the step.
    pub fn advance_state(&self, blocks: &Blocks, state: &mut [f64]) {
        let n = blocks.count();
        for (i, propagator) in self.weights.propagators.iter().enumerate() {
            (state[i], state[n + i]) = propagator.apply(state[i], state[n + i]);
        }
        for a in 0..self.active.len() {
            for (j, column) in self.weights.to_state[a].chunks_exact(2 * n).enumerate() {
                let force = self.force[a * NODES + j];
                state.iter_mut().zip(column).for_each(|(x, p)| *x += p * force);
            }
        }
    }

    /// Takes the sensitivities over the step.
    pub fn advance_sensitivity(
        &mut self,
        drive: &Drive,
        outputs: &[Output],
        sensitivity: &mut Sensitivity,
    ) -> Result<(), NotSolved> {
        self.factorise()?;
        let columns = sensitivity.columns();
        let size = self.active.len() * NODES;
        self.work.clear();
        self.work.resize(size * columns, 0.0);
        let times: [f64; NODES] = std::array::from_fn(|k| self.start + self.node_time(k));
        for (a, &e) in self.active.iter().enumerate() {
            let target = &mut self.work[a * NODES * columns..(a + 1) * NODES * columns];
            sensitivity.read(&self.weights.rows[a], target);
            for (k, &time) in times.iter().enumerate() {
                target[k * columns + sensitivity.frequency_column()] +=
                    drive.output_by_frequency(e, &outputs[e], time);
            }
        }
        self.lu.solve(&mut self.work, columns);
        for (row, slope) in self.work.chunks_exact_mut(columns).zip(&self.slope) {
            row.iter_mut().for_each(|value| *value *= slope);
        }
        sensitivity.propagate(&self.weights.propagators);
        for a in 0..self.active.len() {
            sensitivity.add(&self.weights.to_state[a], &self.work[a * NODES * columns..(a + 1) * NODES * columns]);
        }
        Ok(())
    }

    /// Value of a polynomial over the step, given at the nodes of the a-th active element, at `s` in [0, 1].
    pub fn interpolate(&self, values: &[f64], a: usize, s: f64) -> f64 {
        let lagrange = self.grading().rule().lagrange(s);
        (0..NODES).map(|k| lagrange[k] * values[a * NODES + k]).sum()
    }

    /// The two highest coefficients of the orthonormal expansion of nodal values, in magnitude, added.
    pub fn tail(&self, values: &[f64], a: usize) -> f64 {
        let coefficients = &self.grading().rule().coefficients;
        let coefficient = |degree: usize| {
            (0..NODES).map(|k| coefficients[degree][k] * values[a * NODES + k]).sum::<f64>().abs()
        };
        coefficient(NODES - 1) + coefficient(NODES - 2)
    }
}
