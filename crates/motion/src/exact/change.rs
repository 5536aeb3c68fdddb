//! How the propagators of the blocks change with the damping of the modes.
//!
//! Let the damping matrix change by `dC` per unit of a parameter. In the fixed coordinates `x = S^-1 z` of
//! the blocks the system matrix changes by `dA = S^-1 [0 0; 0 -dC] S`, of which `K_ij` is the part from block
//! j to block i (one 2 x 2 matrix on each diagonal place where modes are the blocks). The sensitivity obeys
//! `s' = A s + dA x + ...`, so over a time t the free motion x adds
//!
//! `dE(t) x`, `dE_ij = int_0^t E_i(t - u) K_ij E_j(u) du`.
//!
//! - Of a block by itself: `K = alpha I + beta A + gamma A_c + delta A_k`, with the derivatives of A by its
//!   damping and its stiffness, is one decomposition of every 2 x 2 matrix; `alpha I + beta A` commutes with
//!   E, so `dE = t (alpha I + beta A) E + gamma E_c + delta E_k`.
//! - Between blocks whose eigenvalues lie apart: `K = A_i X - X A_j` has one solution, and `dE = E_i X - X
//!   E_j`. With the characteristic polynomial `p_j`, `p_j(A_i) X = A_i K + K A_j + c_j K`.
//! - Between blocks whose eigenvalues (nearly) meet: the corner of the exponential of `[A_i K; 0 A_j]`,
//!   finite whatever their distance.
//!
//! So the derivative is exact for coupled modes too: the coordinates S are held, and need no derivative.

use faer::{Mat, c64};

use super::{block::Blocks, matrix_exponential::exponential, propagator::Propagator};

type Square = [[f64; 2]; 2];

/// Least resultant of the characteristic polynomials of two blocks, relative to the fourth power of their
/// rates, at which their eigenvalues count as apart: a relative distance of 5e-4 of equally fast ones, which
/// costs `dE` three or four digits.
const APART: f64 = 1e-6;

/// How one block changes what another does.
#[derive(Debug, Clone)]
pub(crate) struct Pair {
    /// i: the block that changes.
    pub to: usize,
    /// j: the block that changes it.
    pub from: usize,
    /// `K_ij`.
    pub coupling: Square,
    kind: Kind,
}

#[derive(Debug, Clone, Copy)]
enum Kind {
    /// `alpha`, `beta`, `gamma`, `delta`.
    Own([f64; 4]),
    /// `X`.
    Apart(Square),
    Near,
}

/// Change of the blocks with a parameter.
#[derive(Debug, Clone)]
pub(crate) struct Change {
    blocks: Vec<(f64, f64)>,
    pairs: Vec<Pair>,
    moving: usize,
}

impl Change {
    /// The change by a change `dC` of the modal damping matrix, n x n, where the first `moving` blocks obey
    /// the equations of motion; the others are prescribed and do not change.
    pub fn of_damping(blocks: &Blocks, damping: &Mat<f64>, moving: usize) -> Self {
        let n = blocks.count();
        // -dC times the rows of S that are velocities.
        let damped = blocks.transform.as_ref().map(|transform| {
            Mat::from_fn(n, 2 * n, |row, column| {
                (0..n).map(|m| -damping[(row, m)] * transform.from_blocks[(n + m, column)]).sum::<f64>()
            })
        });
        let entry = |row: usize, column: usize| match (&blocks.transform, &damped) {
            (Some(transform), Some(damped)) => {
                (0..n).map(|m| transform.to_blocks[(row, n + m)] * damped[(m, column)]).sum()
            }
            _ if row >= n && column >= n => -damping[(row - n, column - n)],
            _ => 0.0,
        };
        let list: Vec<(f64, f64)> =
            blocks.stiffness.iter().copied().zip(blocks.damping.iter().copied()).collect();
        let mut pairs = Vec::new();
        for to in 0..moving {
            for from in 0..n {
                let coupling =
                    [[entry(to, from), entry(to, n + from)], [entry(n + to, from), entry(n + to, n + from)]];
                if coupling != [[0.0; 2]; 2] {
                    let kind = Kind::new(list[to], list[from], &coupling, to == from);
                    pairs.push(Pair { to, from, coupling, kind });
                }
            }
        }
        Self { blocks: list, pairs, moving }
    }

    /// How many blocks obey the equations of motion; the others are prescribed.
    pub fn moving(&self) -> usize {
        self.moving
    }

    /// The pairs of blocks that are coupled by the change.
    pub fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    /// `dA x`.
    pub fn times_real(&self, state: &[f64]) -> Vec<f64> {
        let n = self.blocks.len();
        let mut product = vec![0.0; 2 * n];
        for Pair { to, from, coupling, .. } in &self.pairs {
            let (p, s) = apply(coupling, (state[*from], state[n + from]));
            product[*to] += p;
            product[n + to] += s;
        }
        product
    }

    /// `dA x` of complex amplitudes.
    pub fn times(&self, state: &[c64]) -> Vec<c64> {
        let part = |f: fn(&c64) -> f64| self.times_real(&state.iter().map(f).collect::<Vec<f64>>());
        part(|v| v.re).into_iter().zip(part(|v| v.im)).map(|(re, im)| c64::new(re, im)).collect()
    }

    /// `row dA`.
    pub fn row_times(&self, row: &[f64]) -> Vec<f64> {
        let n = self.blocks.len();
        let mut product = vec![0.0; 2 * n];
        for Pair { to, from, coupling, .. } in &self.pairs {
            let (p, s) = apply(&transpose(coupling), (row[*to], row[n + to]));
            product[*from] += p;
            product[n + from] += s;
        }
        product
    }

    /// `dE x` over a time.
    pub fn over(&self, time: f64, state: &[f64]) -> Vec<f64> {
        let (mut state, mut change) = (state.to_vec(), vec![0.0; state.len()]);
        self.propagate(time, &mut state, &mut change);
        change
    }

    /// Takes a state and its change over a time without inputs: `s -> E s + dE x`, `x -> E x`.
    pub fn propagate(&self, time: f64, state: &mut [f64], change: &mut [f64]) {
        let n = self.blocks.len();
        let all: Vec<_> =
            self.blocks.iter().map(|&(k, c)| Propagator::with_derivatives(k, c, time)).collect();
        let at = |values: &[f64], i: usize| (values[i], values[n + i]);
        for (i, (propagator, ..)) in all.iter().enumerate() {
            (change[i], change[n + i]) = propagator.apply(change[i], change[n + i]);
        }
        for pair in &self.pairs {
            let (to, from) = (pair.to, pair.from);
            let x = at(state, from);
            let ((own, by_damping, by_stiffness), other) = (&all[to], &all[from].0);
            let (p, s) = match &pair.kind {
                Kind::Own([alpha, beta, gamma, delta]) => {
                    let (moved, (k, c)) = (own.apply(x.0, x.1), self.blocks[to]);
                    let (by_c, by_k) = (by_damping.apply(x.0, x.1), by_stiffness.apply(x.0, x.1));
                    let rate = -k * moved.0 - c * moved.1;
                    (
                        time * (alpha * moved.0 + beta * moved.1) + gamma * by_c.0 + delta * by_k.0,
                        time * (alpha * moved.1 + beta * rate) + gamma * by_c.1 + delta * by_k.1,
                    )
                }
                Kind::Apart(solution) => {
                    let before = apply(solution, x);
                    let after = apply(solution, other.apply(x.0, x.1));
                    let moved = own.apply(before.0, before.1);
                    (moved.0 - after.0, moved.1 - after.1)
                }
                Kind::Near => apply(&corner(self.blocks[to], self.blocks[from], &pair.coupling, time), x),
            };
            change[to] += p;
            change[n + to] += s;
        }
        for (i, (propagator, ..)) in all.iter().enumerate() {
            (state[i], state[n + i]) = propagator.apply(state[i], state[n + i]);
        }
    }
}

impl Kind {
    fn new((k, c): (f64, f64), other: (f64, f64), coupling: &Square, own: bool) -> Self {
        if own {
            let [[alpha, beta], [lower, diagonal]] = *coupling;
            // A_c = [0 0; 0 -1], A_k = [0 0; -1 0].
            return Self::Own([alpha, beta, alpha - c * beta - diagonal, -k * beta - lower]);
        }
        sylvester((k, c), other, coupling).map_or(Self::Near, Self::Apart)
    }
}

/// `X` with `A X - X B = K`; `None` where eigenvalues of A and B (nearly) meet.
fn sylvester((k, c): (f64, f64), (l, d): (f64, f64), coupling: &Square) -> Option<Square> {
    let (alpha, beta) = (l - k, d - c);
    let resultant = alpha * alpha - alpha * beta * c + beta * beta * k;
    if resultant.abs() <= APART * (k + l + c * c + d * d).powi(2) {
        return None;
    }
    let (a, b) = (system((k, c)), system((l, d)));
    // The inverse of `alpha I + beta A` is `((alpha - beta c) I - beta A)/resultant`.
    let solve = |right: &Square| {
        let sum = combine(&combine(&multiply(&a, right), &multiply(right, &b), 1.0), right, d);
        let product = multiply(&a, &sum);
        let entry = |i: usize, j: usize| ((alpha - beta * c) * sum[i][j] - beta * product[i][j]) / resultant;
        [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
    };
    let first = solve(coupling);
    let found = combine(&multiply(&a, &first), &multiply(&first, &b), -1.0);
    Some(combine(&first, &solve(&combine(coupling, &found, -1.0)), 1.0))
}

/// `int_0^t E_i(t - u) K E_j(u) du` from the exponential of both blocks together, with displacements scaled
/// to velocities.
fn corner((k, c): (f64, f64), (l, d): (f64, f64), coupling: &Square, time: f64) -> Square {
    let rate = |k: f64, c: f64| if k + c.abs() > 0.0 { k.sqrt() + c.abs() } else { 1.0 };
    let (r, q) = (rate(k, c), rate(l, d));
    let [[pp, ps], [sp, ss]] = *coupling;
    let joined =
        [[0.0, r, pp * r / q, ps * r], [-k / r, -c, sp / q, ss], [0.0, 0.0, 0.0, q], [0.0, 0.0, -l / q, -d]];
    let found = exponential(&joined, time);
    [[found[0][2] * q / r, found[0][3] / r], [found[1][2] * q, found[1][3]]]
}

fn system((k, c): (f64, f64)) -> Square {
    [[0.0, 1.0], [-k, -c]]
}

fn apply(matrix: &Square, (p, s): (f64, f64)) -> (f64, f64) {
    (matrix[0][0] * p + matrix[0][1] * s, matrix[1][0] * p + matrix[1][1] * s)
}

fn transpose(matrix: &Square) -> Square {
    [[matrix[0][0], matrix[1][0]], [matrix[0][1], matrix[1][1]]]
}

fn multiply(x: &Square, y: &Square) -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| x[i][0] * y[0][j] + x[i][1] * y[1][j]))
}

/// `x + factor y`.
fn combine(x: &Square, y: &Square, factor: f64) -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| x[i][j] + factor * y[i][j]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUPLING: Square = [[0.3, -0.02], [2.0, -0.7]];
    const TIMES: [f64; 3] = [1e-3, 0.4, 9.0];

    /// `dE` of a pair, column by column.
    fn found(to: (f64, f64), from: (f64, f64), kind: Kind, time: f64) -> Square {
        let own = to == from && matches!(kind, Kind::Own(_));
        let (blocks, j) = if own { (vec![to], 0) } else { (vec![to, from], 1) };
        let n = blocks.len();
        let pairs = vec![Pair { to: 0, from: j, coupling: COUPLING, kind }];
        let change = Change { blocks, pairs, moving: n };
        let column = |entry: usize| {
            let (mut state, mut changed) = (vec![0.0; 2 * n], vec![0.0; 2 * n]);
            state[entry] = 1.0;
            change.propagate(time, &mut state, &mut changed);
            [changed[0], changed[n]]
        };
        let (p, s) = (column(j), column(n + j));
        [[p[0], s[0]], [p[1], s[1]]]
    }

    fn assert_near(found: &Square, expected: &Square, tolerance: f64, what: &str) {
        let size = expected.as_flattened().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        let pairs = found.as_flattened().iter().zip(expected.as_flattened());
        let error = pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / size;
        assert!(error < tolerance, "{what}: {error:e}");
    }

    /// Against the exponential of both blocks together, for light, critical and heavy damping.
    #[test]
    fn closed_forms_agree_with_the_exponential_of_both_blocks() {
        let list = [(4.0, 0.2), (9.0, 0.3), (1.0, 2.0), (30.0, 25.0), (0.0, 1.0), (400.0, 1.0)];
        for to in list {
            for from in list {
                let kind = Kind::new(to, from, &COUPLING, to == from);
                for time in TIMES {
                    let expected = corner(to, from, &COUPLING, time);
                    let what = format!("{to:?} {from:?} {kind:?} {time}");
                    // `E_i X - X E_j` is of the size `t K` and rounds like X, which is up to 60 here.
                    assert_near(&found(to, from, kind, time), &expected, 3e-12 + 2e-14 / time, &what);
                }
            }
        }
    }

    #[test]
    fn blocks_with_eigenvalues_in_common_are_near() {
        let near = |to, from| matches!(Kind::new(to, from, &COUPLING, false), Kind::Near);
        // Roots -1 and -2, -2 and -5; then 0 and -3, 0 and -1.
        assert!(
            near((2.0, 3.0), (10.0, 7.0)) && near((0.0, 3.0), (0.0, 1.0)) && near((4.0, 0.2), (4.0, 0.2))
        );
        assert!(near((4.0, 0.2), (4.0004, 0.2)) && !near((4.0, 0.2), (4.1, 0.2)));
    }
}
