//! Matrices of one force step of length h, for the active elements.
//! Equations (S2) to (S4) of the book, `docs/theory`.
//!
//! `r_k = r_particular + X_k x + sum W_kj F_j` at the nodes and `x+ = E x + P F` at the end (see the crate
//! docs). For short steps all of them come from power series in h (`collocation.rs`, `series.rs`): the sums
//! over the modes are in the Markov parameters `C A^m B`, made once, so a new step length costs next to
//! nothing. Where `h` times the fastest rate exceeds [`REACH`](super::collocation::REACH), they come from
//! quadrature (`quadrature.rs`) fine enough for every mode; such steps have lengths on a grid and their
//! matrices are kept.
//!
//! Where a law depends on the velocity, `r'_k = r'_particular + X'_k x + sum W'_kj F_j` is wanted besides.
//! `W'` and `X'` are the same with `C A` instead of C (`C B` vanishes); elsewhere they are not made.

use super::{
    block::Blocks,
    collocation::{NODES, NodeMatrix},
    propagator::Propagator,
};

/// Row over the block state at each node, `[i * NODES + k]`.
pub(crate) type NodeRows = Vec<f64>;

/// Matrices of a step. `a` and `b` count the active elements.
#[derive(Debug, Clone, Default)]
pub(crate) struct StepWeights {
    /// `E`, one propagator per block; empty until they are wanted.
    pub propagators: Vec<Propagator>,
    /// `X` of each active element.
    pub rows: Vec<NodeRows>,
    /// `W`, indexed `[a * active + b][j][k]`: a column per node that reads, a row per force.
    pub convolution: Vec<NodeMatrix>,
    /// `P` of each active element, `[i * NODES + j]`.
    pub to_state: Vec<Vec<f64>>,
    /// `X'` of each active element and `W'`; empty where no law depends on the velocity.
    pub velocity_rows: Vec<NodeRows>,
    pub velocity_convolution: Vec<NodeMatrix>,
    /// How many terms of their series the blocks need: slow ones few.
    pub terms: Vec<usize>,
    /// Whether more than the convolution has been made.
    pub complete: bool,
}

impl StepWeights {
    pub fn resize(&mut self, active: usize, size: usize, velocity: bool) {
        self.velocity_rows.resize(if velocity { active } else { 0 }, Vec::new());
        self.velocity_rows.iter_mut().for_each(|row| row.resize(size * NODES, 0.0));
        self.velocity_convolution.resize(if velocity { active * active } else { 0 }, [[0.0; NODES]; NODES]);
        self.rows.resize(active, Vec::new());
        self.rows.iter_mut().for_each(|row| row.resize(size * NODES, 0.0));
        self.to_state.resize(active, Vec::new());
        self.to_state.iter_mut().for_each(|p| p.resize(size * NODES, 0.0));
        self.convolution.resize(active * active, [[0.0; NODES]; NODES]);
    }

    pub fn set_propagators(&mut self, blocks: &Blocks, length: f64) {
        blocks.propagators(length, &mut self.propagators);
    }
}
