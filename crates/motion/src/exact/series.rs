//! Power series of a step of length h: its matrices, and outputs in it, from the Markov parameters `C A^m B`.
//!
//! All sums over the modes are made once; a new length costs next to nothing. Terms are scaled by the fastest
//! rate, so that `z = h rate` tells how many are needed; a slow block needs fewer.

use std::sync::OnceLock;

use super::{
    block::Blocks,
    change::Change,
    collocation::{Grading, NODES, REACH, TERMS},
    drive::Jet,
    lanes::{add_multiple, add_products, dot, fixed_dot, vectorised},
    output::Output,
    weights::StepWeights,
};

/// `C (A/rate)^m x` of one output, from `m = 0` on.
pub(crate) type Readings = [f64; TERMS + 2];

/// What the weights are made of: powers of the system on the rows and columns of the elements.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    pub(super) rate: f64,
    /// Rate of each block [1/s].
    rates: Vec<f64>,
    /// Row of element e times `(A/rate)^m`, `[e][m][i]`.
    rows: Vec<Vec<Vec<f64>>>,
    /// `(A/rate)^m` times the column of element e, `[e][m][i]`.
    pub(super) columns: Vec<Vec<Vec<f64>>>,
    /// The same of each element entry by entry, `[i * TERMS + m]`: rows and columns.
    entries: Vec<(Vec<f64>, Vec<f64>)>,
    /// Rows entry by entry from the first power on: those that read velocities, over the rate.
    velocity_entries: Vec<Vec<f64>>,
    /// `C_e (A/rate)^m B_f`, `[e * count + f][m]`.
    pub(super) markov: Vec<Vec<f64>>,
}

impl Series {
    pub fn new(blocks: &Blocks, outputs: &[Output], inputs: &[Vec<f64>]) -> Self {
        // Powers of a rigid block end by themselves; they only need a scale.
        let rate = blocks.rates().into_iter().fold(1e-6, f64::max);
        let scaled = |values: Vec<f64>| values.into_iter().map(|value| value / rate).collect::<Vec<f64>>();
        let powers = |first: &Vec<f64>, next: &dyn Fn(&[f64]) -> Vec<f64>| {
            let mut list = vec![first.clone()];
            for m in 1..=TERMS {
                list.push(scaled(next(&list[m - 1])));
            }
            list
        };
        let rows: Vec<_> =
            outputs.iter().map(|o| powers(&o.row, &|row| blocks.row_times_system(row))).collect();
        let columns: Vec<_> =
            inputs.iter().map(|b| powers(b, &|column| blocks.system_times_column(column))).collect();
        let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(a, b)| a * b).sum::<f64>();
        let markov = outputs
            .iter()
            .flat_map(|output| {
                columns.iter().map(move |powers| powers.iter().map(|c| dot(&output.row, c)).collect())
            })
            .collect();
        let entries = rows.iter().zip(&columns).map(|(r, c)| (by_entry(r), by_entry(c))).collect();
        let velocity_entries = rows.iter().take(columns.len()).map(|r| by_entry(&r[1..])).collect();
        Self { rate, rates: blocks.rates(), entries, velocity_entries, rows, columns, markov }
    }

    /// The change of the series with the blocks: what they give is then the change of node values and states,
    /// `d(C A^m) = d(C A^(m-1)) A + C A^(m-1) dA`.
    pub fn change(&self, blocks: &Blocks, change: &Change) -> Self {
        let chain = |powers: &Vec<Vec<f64>>,
                     next: &dyn Fn(&[f64]) -> Vec<f64>,
                     own: &dyn Fn(&[f64]) -> Vec<f64>| {
            let mut list = vec![vec![0.0; powers[0].len()]];
            for m in 1..powers.len() {
                let (carried, new) = (next(&list[m - 1]), own(&powers[m - 1]));
                list.push(carried.iter().zip(&new).map(|(x, y)| (x + y) / self.rate).collect::<Vec<f64>>());
            }
            list
        };
        let of_rows =
            |powers| chain(powers, &|row| blocks.row_times_system(row), &|row| change.row_times(row));
        let of_columns = |powers| {
            chain(powers, &|column| blocks.system_times_column(column), &|column| change.times_real(column))
        };
        let rows: Vec<_> = self.rows.iter().map(of_rows).collect();
        let columns: Vec<_> = self.columns.iter().map(of_columns).collect();
        let markov = self.rows.iter().flat_map(|row| {
            columns.iter().map(|powers| powers.iter().map(|column| dot(&row[0], column)).collect())
        });
        let markov = markov.collect();
        let (entries, velocity_entries) = (Vec::new(), Vec::new());
        Self { rate: self.rate, rates: self.rates.clone(), rows, columns, entries, velocity_entries, markov }
    }

    /// Longest step that the series serve [s].
    pub fn reach(&self) -> f64 {
        REACH / self.rate
    }

    /// Derivative `d` of output `o` at the nodes of a step within the reach, apart from the particular part
    /// and from direct forces: `C A^d (exp(A t) x + int exp(A (t - s)) B F ds)`.
    ///
    /// * `state`: block state at the start of the step; `force`: node values, `[a * NODES + k]`.
    pub fn node_values(
        &self,
        (output, derivative): (usize, usize),
        (grading, length): (Grading, f64),
        state: &[f64],
        (active, force): (&[usize], &[f64]),
    ) -> [f64; NODES] {
        let rule = grading.rule();
        let z = length * self.rate;
        let terms = Self::terms(z).min(TERMS - derivative);
        let (powers, factors) = (Self::factors(1.0, z, terms), Self::factors(length, z, terms));
        let (mut values, mut weights) = ([0.0; NODES], [[0.0; NODES]; TERMS]);
        let mut free = [0.0; TERMS];
        vectorised(
            #[inline(always)]
            || {
                let rows = self.rows[output][derivative..].iter().zip(&powers[..terms]);
                free.iter_mut().zip(rows).for_each(|(free, (row, power))| *free = power * dot(row, state));
            },
        );
        add_products(&mut values, rule.powers.as_flattened(), NODES, |_| free[..terms].iter().copied());
        for (&e, force) in active.iter().zip(force.as_chunks::<NODES>().0) {
            let markov = &self.markov[output * self.columns.len() + e][derivative..];
            for ((weights, factor), markov) in weights.iter_mut().zip(&factors[..terms]).zip(markov) {
                *weights = force.map(|force| factor * markov * force);
            }
            let source = rule.at_nodes.as_flattened().as_flattened();
            add_products(&mut values, source, NODES, |_| weights[..terms].as_flattened().iter().copied());
        }
        values.map(|value| value * self.rate.powi(derivative as i32))
    }

    /// Terms needed at `z = h rate`: two more than those above rounding, since slow blocks have their first
    /// powers there.
    pub(super) fn terms(z: f64) -> usize {
        // Up to which z the term m is rounding: `z^m/m! < 1e-18`.
        static LIMITS: OnceLock<Vec<f64>> = OnceLock::new();
        let limits = LIMITS.get_or_init(|| {
            let logarithm = |m: usize| (1..=m).map(|k| (k as f64).ln()).sum::<f64>();
            (1..TERMS - 4).map(|m| ((logarithm(m) + 1e-18_f64.ln()) / m as f64).exp()).collect()
        });
        limits.partition_point(|&limit| limit <= z) + 3
    }

    /// `first z^m`.
    fn factors(first: f64, z: f64, terms: usize) -> [f64; TERMS] {
        let mut factors = [0.0; TERMS];
        let mut factor = first;
        for entry in &mut factors[..terms] {
            *entry = factor;
            factor *= z;
        }
        factors
    }

    /// Prepares a step within the reach: its convolution `W`, and `W'` if `velocity` says so. The rest
    /// follows with [`StepWeights::set_propagators`] and [`Series::complete`].
    pub fn prepare(
        &self,
        (active, velocity): (&[usize], bool),
        grading: Grading,
        length: f64,
        into: &mut StepWeights,
    ) {
        let rule = grading.rule();
        let z = length * self.rate;
        let terms = Self::terms(z);
        let count = self.columns.len();
        into.complete = false;
        into.propagators.clear();
        let pairs = active.len() * active.len();
        into.convolution.resize(pairs, [[0.0; NODES]; NODES]);
        into.velocity_convolution.resize(if velocity { pairs } else { 0 }, [[0.0; NODES]; NODES]);
        let factors = Self::factors(length, z, terms);
        for (a, &e) in active.iter().enumerate() {
            for (b, &f) in active.iter().enumerate() {
                let convolution = &mut into.convolution[a * active.len() + b];
                let (markov, at_nodes) = (&self.markov[e * count + f], &rule.at_nodes[..terms]);
                let mut weights = factors;
                weights.iter_mut().zip(markov).for_each(|(weight, markov)| *weight *= markov);
                convolution.fill([0.0; NODES]);
                let target = convolution.as_flattened_mut();
                let source = at_nodes.as_flattened().as_flattened();
                add_products(target, source, NODES * NODES, |_| weights[..terms].iter().copied());
            }
        }
        if velocity {
            self.prepare_velocities(active, grading, &factors[..terms], into);
        }
    }

    /// `W'` of a step.
    #[inline(never)]
    fn prepare_velocities(
        &self,
        active: &[usize],
        grading: Grading,
        factors: &[f64],
        into: &mut StepWeights,
    ) {
        let source = grading.rule().at_nodes[..factors.len()].as_flattened().as_flattened();
        for (place, convolution) in into.velocity_convolution.iter_mut().enumerate() {
            let (e, f) = (active[place / active.len()], active[place % active.len()]);
            let markov = &self.markov[e * self.columns.len() + f][1..];
            let rates = factors.iter().zip(markov).map(|(factor, m)| factor * m * self.rate);
            convolution.fill([0.0; NODES]);
            add_products(convolution.as_flattened_mut(), source, NODES * NODES, |_| rates.clone());
        }
    }

    /// Completes a prepared step: `X` and `P`, and `X'` if `velocity` says so.
    pub fn complete(
        &self,
        (active, velocity): (&[usize], bool),
        (grading, length): (Grading, f64),
        step: &mut StepWeights,
    ) {
        let rule = grading.rule();
        let size = self.columns[0][0].len();
        let z = length * self.rate;
        let terms = Self::terms(z);
        step.resize(active.len(), size, velocity);
        step.complete = true;
        step.terms.clear();
        step.terms.extend(self.rates.iter().map(|rate| Self::terms(length * rate)));
        let (powers, factors) = (Self::factors(1.0, z, terms), Self::factors(length, z, terms));
        for (a, &e) in active.iter().enumerate() {
            let (rows, columns) = &self.entries[e];
            sum_powers(rows, &powers, &rule.powers, &step.terms, &mut step.rows[a]);
            sum_powers(columns, &factors, &rule.at_end, &step.terms, &mut step.to_state[a]);
        }
        if velocity {
            self.complete_velocities(active, grading, &powers, step);
        }
    }

    /// `X'` of a step.
    #[inline(never)]
    fn complete_velocities(
        &self,
        active: &[usize],
        grading: Grading,
        powers: &[f64; TERMS],
        step: &mut StepWeights,
    ) {
        for (rows, &e) in step.velocity_rows.iter_mut().zip(active) {
            sum_powers(&self.velocity_entries[e], powers, &grading.rule().powers, &step.terms, rows);
            rows.iter_mut().for_each(|entry| *entry *= self.rate);
        }
    }

    /// Adds `P F` of one element to a state.
    pub fn add_force(
        &self,
        element: usize,
        (grading, length): (Grading, f64),
        force: &[f64; NODES],
        state: &mut [f64],
    ) {
        let z = length * self.rate;
        let mut factor = length;
        let columns = self.columns[element].iter().zip(&grading.rule().at_end[..Self::terms(z)]);
        vectorised(
            #[inline(always)]
            || {
                for (column, at_end) in columns {
                    add_multiple(state, factor * fixed_dot(at_end, force), column);
                    factor *= z;
                }
            },
        );
    }

    /// Row of output `o` and its derivatives read from `state`: `C (A/rate)^m x`.
    pub fn readings(&self, output: usize, state: &[f64], length: f64) -> Readings {
        let terms = Self::terms(length * self.rate) + 2;
        let mut readings = [0.0; TERMS + 2];
        vectorised(
            #[inline(always)]
            || {
                for (reading, row) in readings.iter_mut().zip(&self.rows[output]).take(terms) {
                    *reading = dot(row, state);
                }
            },
        );
        readings
    }

    /// Free motion at the nodes of a step from the readings at its start, apart from the particular part.
    pub fn free_values(&self, readings: &Readings, grading: Grading, length: f64) -> [f64; NODES] {
        let z = length * self.rate;
        vectorised(
            #[inline(always)]
            || {
                // Copies of its own keep the loop on vectors.
                let (c, mut values) = (grading.rule().c, [0.0; NODES]);
                for m in (0..Self::terms(z)).rev() {
                    let (reading, share) = (readings[m], z / (m + 1) as f64);
                    values = std::array::from_fn(|k| reading + values[k] * share * c[k]);
                }
                values
            },
        )
    }

    /// Velocities of the free motion at the nodes of a step from the readings at its start, apart from the
    /// particular part.
    pub fn free_rates(&self, readings: &Readings, grading: Grading, length: f64) -> [f64; NODES] {
        let z = length * self.rate;
        let rates = vectorised(
            #[inline(always)]
            || {
                let (c, mut rates) = (grading.rule().c, [0.0; NODES]);
                for m in (0..Self::terms(z)).rev() {
                    let (reading, share) = (readings[m + 1], z / (m + 1) as f64);
                    rates = std::array::from_fn(|k| reading + rates[k] * share * c[k]);
                }
                rates
            },
        );
        rates.map(|rate| rate * self.rate)
    }

    /// Output `o` and its derivatives at the end of a step, apart from the particular part and from the
    /// direct part of the forces.
    pub fn end_jet(
        &self,
        (output, readings): (usize, &Readings),
        (grading, length): (Grading, f64),
        (active, force): (&[usize], &[f64]),
    ) -> Jet {
        let rule = grading.rule();
        let z = length * self.rate;
        let count = self.columns.len();
        let terms = Self::terms(z);
        let sums = vectorised(
            #[inline(always)]
            || {
                // The fourth sum fills the vector.
                let (mut sums, mut power, mut factor) = ([0.0; 4], 1.0, length);
                for (m, at_end) in rule.at_end[..terms].iter().enumerate() {
                    let add = |sums: &mut [f64; 4], factor: f64, list: &[f64]| {
                        let four = &list[m..m + 4];
                        (0..4).for_each(|d| sums[d] += factor * four[d]);
                    };
                    add(&mut sums, power, readings);
                    power *= z / (m + 1) as f64;
                    for (force, &e) in force.as_chunks::<NODES>().0.iter().zip(active) {
                        let moment = factor * fixed_dot(at_end, force);
                        add(&mut sums, moment, &self.markov[output * count + e]);
                    }
                    factor *= z;
                }
                sums
            },
        );
        Jet { value: sums[0], slope: sums[1] * self.rate, curvature: sums[2] * self.rate * self.rate }
    }
}

/// `sum_m L_im f_m R_m` for each entry i of the state, with as many terms as its block needs; `list` is
/// indexed `[i * TERMS + m]`.
#[inline(always)]
fn sum_powers(
    list: &[f64],
    factors: &[f64; TERMS],
    rows: &[[f64; NODES]],
    terms: &[usize],
    into: &mut [f64],
) {
    let list = list.as_chunks::<TERMS>().0;
    let weights = |i: usize| {
        let needed = list[i][..terms[i % terms.len()]].iter().zip(factors);
        needed.map(|(entry, factor)| entry * factor)
    };
    into.fill(0.0);
    add_products(into, rows.as_flattened(), NODES, weights);
}

/// Entry i of each power, `[i * TERMS + m]`.
fn by_entry(powers: &[Vec<f64>]) -> Vec<f64> {
    (0..powers[0].len()).flat_map(|i| powers[..TERMS].iter().map(move |power| power[i])).collect()
}
