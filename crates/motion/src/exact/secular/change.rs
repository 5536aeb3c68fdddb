//! How the motion from rest under a secular load changes with the damping (`change.rs`, `by_damping.rs`).
//!
//! A block with the matrix A changes by what another one (or itself), x, does: `y' = A y + K x` from rest,
//! with `x' = A_x x + Re(u exp(i w t))`. With `C = cos(w t)` and `S = sin(w t)` these six are one linear
//! system with constant coefficients, and its exponential is finite however the eigenvalues of both blocks
//! and the frequency lie to one another.
//!
//! Displacements are scaled to velocities by the rates of their blocks, u and K to the size 1: so the number
//! of squarings, which costs digits, follows from the rates alone. The derivatives by the time follow by the
//! matrix.

use faer::c64;

use super::super::matrix_exponential::{Square, exponential};

/// Number of states: y, x, C and S.
const SIZE: usize = 6;
/// The place of C, which is 1 at the start.
const COSINE: usize = 4;

/// Change of one block by what a secular load does to another.
#[derive(Debug, Clone)]
pub(crate) struct SecularChange {
    /// The block that changes.
    pub block: usize,
    /// Of the scaled states.
    system: Square<SIZE>,
    /// What the scaled states of the block are to be multiplied by.
    factors: [f64; 2],
}

/// A load on a block, from rest.
#[derive(Debug, Clone, Copy)]
pub(super) struct Source {
    /// `(k, c)`.
    pub block: (f64, f64),
    /// `u` at the start.
    pub input: [c64; 2],
    /// w.
    pub frequency: f64,
}

impl SecularChange {
    /// * `block`, `(k, c)`: the block that changes; `coupling`: `K`.
    pub(super) fn new(block: usize, (k, c): (f64, f64), coupling: &[[f64; 2]; 2], source: &Source) -> Self {
        let rate = |(k, c): (f64, f64)| if k + c.abs() > 0.0 { k.sqrt() + c.abs() } else { 1.0 };
        let (own, other) = (rate((k, c)), rate(source.block));
        let mut system = [[0.0; SIZE]; SIZE];
        for (offset, (k, c), rate) in [(0, (k, c), own), (2, source.block, other)] {
            system[offset][offset + 1] = rate;
            system[offset + 1][offset] = -k / rate;
            system[offset + 1][offset + 1] = -c;
        }
        let [[pp, ps], [sp, ss]] = *coupling;
        let coupling = [[pp * own / other, ps * own], [sp / other, ss]];
        let input = [source.input[0] * other, source.input[1]];
        let strength = largest(coupling.as_flattened().iter().copied());
        let size = largest(input.iter().map(|value| value.norm()));
        for row in 0..2 {
            (0..2).for_each(|column| system[row][2 + column] = coupling[row][column] / strength);
            system[2 + row][COSINE] = input[row].re / size;
            system[2 + row][COSINE + 1] = -input[row].im / size;
        }
        system[COSINE][COSINE + 1] = -source.frequency;
        system[COSINE + 1][COSINE] = source.frequency;
        Self { block, system, factors: [strength * size / own, strength * size] }
    }

    /// The change of `[p, s]` at `time` after the start, and its derivatives by the time.
    pub fn derivatives<const N: usize>(&self, time: f64) -> [[f64; 2]; N] {
        let exponential = exponential(&self.system, time);
        let mut states = exponential.map(|row| row[COSINE]);
        std::array::from_fn(|_| {
            let here = states;
            states = self.system.map(|row| row.iter().zip(&here).map(|(a, x)| a * x).sum());
            [0, 1].map(|row| self.factors[row] * here[row])
        })
    }
}

/// The largest magnitude, 1 of nothing.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    let largest = values.fold(0.0_f64, |largest, value| largest.max(value.abs()));
    if largest > 0.0 { largest } else { 1.0 }
}
