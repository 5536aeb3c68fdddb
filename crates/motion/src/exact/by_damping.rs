//! The column of the sensitivities that belongs to an added part of the damping, which acts on the whole
//! motion.
//!
//! With `C = C(0) + z D` (and what the support transmits, `d = d(0) + z d_z`) the sensitivity `s = dx/dz` in
//! the fixed coordinates of the blocks obeys
//!
//! `s' = A s + dA x + db + B f' C s`, `dA` by the change of the damping matrix, D (`change.rs`), `db = S^-1
//! [0; -d_z u']`.
//!
//! The motion x has three parts, and `dA x` drives one part of s with each:
//!
//! - the particular solution of the load drives another particular solution, steady or from rest
//!   ([`Drive::change`]);
//! - the free motion adds `dE x` over a flight or a step, and `dX x` to the displacements at the nodes of a
//!   step;
//! - the forces of a step add `dP F` to the state at its end and `dW F` to the displacements at its nodes.
//!
//! So a step solves `(I - W f') dr = X s + dX x + d r_particular + dW F` and ends with `s+ = E s + dE x + dP
//! F + P f' dr`. For short steps `dX`, `dW` and `dP` come from the power series with the changed Markov
//! parameters `d(C A^m B)`; for long ones x and s go through the step together, from node to node, the force
//! by quadrature fine enough for every block. Forces that depend on velocities need `dr'`, too: C reads
//! displacements and `dA` acts on velocities, so `C dA = 0` and `d(r') = C A s`.

use faer::c64;

use super::{
    block::Blocks,
    change::Change,
    collocation::{Grading, NODES},
    drive::Drive,
    force_step::Driven,
    output::Output,
    recurrence::gauss_sixteen,
    series::Series,
    structure::Structure,
};
use crate::{DampingPart, System};

/// Radians of the fastest block that sixteen Gauss points resolve, together with the polynomials of the step,
/// to rounding.
const RADIANS: f64 = 4.0;

/// What the column by a part of the damping is made of.
#[derive(Debug)]
pub(crate) struct ByDamping {
    /// Number of the part.
    part: usize,
    change: Change,
    series: Series,
    /// Part of the sensitivity that the particular solution drives.
    pub drive: Drive,
    fastest: f64,
}

/// A solved step, for its part in the sensitivity.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SolvedStep<'a> {
    pub grading: Grading,
    pub length: f64,
    /// Active elements.
    pub active: &'a [usize],
    /// Forces at the nodes, `[a * NODES + k]`.
    pub force: &'a [f64],
    /// Homogeneous block state at the start of the step.
    pub state: &'a [f64],
}

impl ByDamping {
    pub fn new((system, part): (&System, usize), blocks: &Blocks, series: &Series, drive: &Drive) -> Self {
        let change = Change::of_damping(blocks, &system.damping_parts()[part].matrix, blocks.count());
        Self::of_change((part, change), (blocks, series), drive.clone())
    }

    /// The same of a structure that is held on rigid stops, over the stretch of its particular solution.
    pub fn of_held((system, part): (&System, usize), structure: &Structure, held: usize) -> Self {
        let Structure { blocks, series, drive, outputs, .. } = structure;
        let change = Change::of_damping(blocks, &system.damping_parts()[part].matrix, blocks.count() - held);
        let drive = drive.change(blocks, outputs, (&change, &transmitted(system, part, drive)));
        Self::of_change((part, change), (blocks, series), drive)
    }

    fn of_change(
        (part, change): (usize, Change),
        (blocks, series): (&Blocks, &Series),
        drive: Drive,
    ) -> Self {
        let fastest = blocks.rates().into_iter().fold(0.0, f64::max);
        Self { part, series: series.change(blocks, &change), change, drive, fastest }
    }

    /// Prepares for a stretch with that particular solution.
    pub fn start(&mut self, system: &System, drive: &Drive, blocks: &Blocks, outputs: &[Output]) {
        let loads = transmitted(system, self.part, drive);
        self.drive = drive.change(blocks, outputs, (&self.change, &loads));
    }

    /// `dE x`.
    pub fn over_flight(&self, time: f64, state: &[f64]) -> Vec<f64> {
        self.change.over(time, state)
    }

    /// Over a step: `dX x + dW F` at the nodes, if `damped` with the rates, and `dE x + dP F` at the end.
    pub fn over_step(
        &self,
        step: &SolvedStep,
        (outputs, inputs): (&[Output], &[Vec<f64>]),
        damped: bool,
        driven: &mut Driven,
    ) {
        driven.clear();
        if step.length > self.series.reach() {
            let size = step.active.len() * NODES;
            driven.nodes.resize(size, 0.0);
            driven.rates.resize(if damped { size } else { 0 }, 0.0);
            return self.by_quadrature(step, (outputs, inputs), driven);
        }
        let (shape, loads) = ((step.grading, step.length), (step.active, step.force));
        for &element in step.active {
            driven.nodes.extend(self.series.node_values((element, 0), shape, step.state, loads));
            if damped {
                driven.rates.extend(self.series.node_values((element, 1), shape, step.state, loads));
            }
        }
        driven.end.extend(self.over_flight(step.length, step.state));
        for (&element, force) in step.active.iter().zip(step.force.as_chunks::<NODES>().0) {
            self.series.add_force(element, shape, force, &mut driven.end);
        }
    }

    fn by_quadrature(
        &self,
        step: &SolvedStep,
        (outputs, inputs): (&[Output], &[Vec<f64>]),
        Driven { nodes, rates, end }: &mut Driven,
    ) {
        let (grading, length) = (step.grading, step.length);
        let rule = grading.rule();
        let mut state = step.state.to_vec();
        end.resize(state.len(), 0.0);
        let read = |row: &[f64], end: &[f64]| row.iter().zip(end).map(|(r, s)| r * s).sum();
        let mut from = 0.0;
        for node in 0..=NODES {
            let to = rule.s.get(node).copied().unwrap_or(1.0);
            let radians = self.fastest * length * (grading.map(to).0 - grading.map(from).0);
            let panels = (radians / RADIANS).ceil().max(1.0) as usize;
            let at = |panel: usize| from + (to - from) * panel as f64 / panels as f64;
            for panel in 0..panels {
                self.over_panel(step, inputs, (at(panel), at(panel + 1)), (&mut state, end));
            }
            if node < NODES {
                for (a, &element) in step.active.iter().enumerate() {
                    let place = a * NODES + node;
                    nodes[place] = read(&outputs[element].row, end);
                    if let Some(rate) = rates.get_mut(place) {
                        *rate = read(&outputs[element].velocity_row, end);
                    }
                }
            }
            from = to;
        }
    }

    /// Takes the motion and its change from one place of the variable of the step to another.
    fn over_panel(
        &self,
        step: &SolvedStep,
        inputs: &[Vec<f64>],
        (from, to): (f64, f64),
        (state, change): (&mut [f64], &mut [f64]),
    ) {
        let (grading, length) = (step.grading, step.length);
        let end = grading.map(to).0;
        self.change.propagate(length * (end - grading.map(from).0), state, change);
        for &(x, weight) in gauss_sixteen() {
            let s = from + (to - from) * x;
            let (position, slope) = grading.map(s);
            let lagrange = grading.rule().lagrange(s);
            let measure = weight * (to - from) * slope * length;
            let (mut impulse, mut changed) = (vec![0.0; state.len()], vec![0.0; state.len()]);
            for (&element, force) in step.active.iter().zip(step.force.as_chunks::<NODES>().0) {
                let value: f64 = lagrange.iter().zip(force).map(|(l, f)| l * f).sum();
                impulse.iter_mut().zip(&inputs[element]).for_each(|(x, b)| *x += measure * value * b);
            }
            self.change.propagate(length * (end - position), &mut impulse, &mut changed);
            state.iter_mut().zip(&impulse).for_each(|(x, part)| *x += part);
            change.iter_mut().zip(&changed).for_each(|(s, part)| *s += part);
        }
    }
}

/// What a unit of a part of the damping adds to the modal load of each order of the particular solution: `-i
/// m W sum_s U_sm d_s`; empty where the supports transmit nothing.
fn transmitted(system: &System, part: usize, drive: &Drive) -> Vec<Vec<c64>> {
    let DampingPart { supports, .. } = &system.damping_parts()[part];
    if supports.iter().flatten().all(|value| *value == 0.0) {
        return Vec::new();
    }
    let frequency = drive.circular_frequency();
    let of_order = |(index, &order): (usize, &u32)| {
        let rate = c64::new(0.0, f64::from(order) * frequency);
        let moved = system.support_amplitudes(index, frequency);
        let load =
            |i: usize| moved.iter().zip(supports).map(|((u, _), values)| -(*u * rate) * values[i]).sum();
        (0..system.dof()).map(load).collect()
    };
    system.orders().iter().enumerate().map(of_order).collect()
}
