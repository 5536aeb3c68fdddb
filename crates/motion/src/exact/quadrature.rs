//! Matrices of steps that are too long for the power series, by quadrature fine enough for every mode.
//!
//! With `I_k = int_0^{c_k} exp(A h (c_k - c)) l_j h dc`, `I_k = exp(A h (c_k - c_{k-1})) I_{k-1}` and the
//! integral from one node to the next: one pass over the step serves all nodes.

use super::{
    block::Blocks,
    collocation::{Grading, NODES},
    output::Output,
    propagator::Propagator,
    recurrence::gauss_sixteen,
    weights::StepWeights,
};

/// Radians of a mode that sixteen Gauss points resolve, together with the polynomials of the step, to
/// rounding.
const RADIANS: f64 = 4.0;

/// `int exp(A (end - t)) l_j dt` of one block for each j: entries `[a, b, c, d]` of the propagator.
type Integrals = [[f64; 4]; NODES];

impl StepWeights {
    /// Matrices of a step of any length; `active` lists elements, `velocity` tells whether their velocities
    /// are wanted.
    pub fn by_quadrature(
        blocks: &Blocks,
        outputs: &[Output],
        inputs: &[Vec<f64>],
        (active, velocity): (&[usize], bool),
        grading: Grading,
        length: f64,
    ) -> Self {
        let n = blocks.count();
        let mut weights = Self { complete: true, ..Self::default() };
        weights.resize(active.len(), 2 * n, velocity);
        weights.convolution.fill([[0.0; NODES]; NODES]);
        weights.velocity_convolution.fill([[0.0; NODES]; NODES]);
        weights.set_propagators(blocks, length);
        for i in 0..n {
            let block = (blocks.stiffness[i], blocks.damping[i]);
            weights.set_rows(outputs, active, (i, n), block, (grading, length));
            for (node, integrals) in block_integrals(block, grading, length).iter().enumerate() {
                for (b, &f) in active.iter().enumerate() {
                    let input = (inputs[f][i], inputs[f][n + i]);
                    for (j, response) in integrals
                        .iter()
                        .map(|[aa, bb, cc, dd]| (aa * input.0 + bb * input.1, cc * input.0 + dd * input.1))
                        .enumerate()
                    {
                        weights.add(outputs, active, (i, n), (node, b, j), response);
                    }
                }
            }
        }
        weights
    }

    /// `X` of block i of n.
    fn set_rows(
        &mut self,
        outputs: &[Output],
        active: &[usize],
        (i, n): (usize, usize),
        (stiffness, damping): (f64, f64),
        (grading, length): (Grading, f64),
    ) {
        for (node, c) in grading.rule().c.iter().enumerate() {
            let propagator = Propagator::new(stiffness, damping, length * c);
            let set = |rows: &mut [f64], row: &[f64]| {
                rows[i * NODES + node] = row[i] * propagator.a + row[n + i] * propagator.c;
                rows[(n + i) * NODES + node] = row[i] * propagator.b + row[n + i] * propagator.d;
            };
            for (rows, &e) in self.rows.iter_mut().zip(active) {
                set(rows, &outputs[e].row);
            }
            for (rows, &e) in self.velocity_rows.iter_mut().zip(active) {
                set(rows, &outputs[e].velocity_row);
            }
        }
    }

    /// Adds the response `(p, s)` of block i of n at a node, or at the end, to the j-th force of the b-th
    /// active element.
    fn add(
        &mut self,
        outputs: &[Output],
        active: &[usize],
        (i, n): (usize, usize),
        (node, b, j): (usize, usize, usize),
        (p, s): (f64, f64),
    ) {
        if node == NODES {
            self.to_state[b][i * NODES + j] = p;
            self.to_state[b][(n + i) * NODES + j] = s;
            return;
        }
        for (a, &e) in active.iter().enumerate() {
            let (place, o) = (a * active.len() + b, &outputs[e]);
            self.convolution[place][j][node] += o.row[i] * p + o.row[n + i] * s;
            if let Some(matrix) = self.velocity_convolution.get_mut(place) {
                matrix[j][node] += o.velocity_row[i] * p + o.velocity_row[n + i] * s;
            }
        }
    }
}

/// The integrals of one block up to each node and up to the end of the step.
fn block_integrals((k, c): (f64, f64), grading: Grading, length: f64) -> [Integrals; NODES + 1] {
    let rule = grading.rule();
    let mut all = [[[0.0; 4]; NODES]; NODES + 1];
    let mut integrals: Integrals = [[0.0; 4]; NODES];
    let mut from = 0.0;
    for (node, result) in all.iter_mut().enumerate() {
        let to = rule.s.get(node).copied().unwrap_or(1.0);
        let radians = (k.sqrt() + c) * length * (grading.map(to).0 - grading.map(from).0);
        let panels = (radians / RADIANS).ceil().max(1.0) as usize;
        let at = |panel: usize| from + (to - from) * panel as f64 / panels as f64;
        for panel in 0..panels {
            advance(&mut integrals, (k, c), grading, length, (at(panel), at(panel + 1)));
        }
        *result = integrals;
        from = to;
    }
    all
}

/// Takes the integrals from one place of the variable to another.
fn advance(
    integrals: &mut Integrals,
    (k, c): (f64, f64),
    grading: Grading,
    length: f64,
    (from, to): (f64, f64),
) {
    let (start, end) = (grading.map(from).0, grading.map(to).0);
    let over = Propagator::new(k, c, length * (end - start));
    for entries in integrals.iter_mut() {
        let [aa, bb, cc, dd] = *entries;
        ([entries[0], entries[2]], [entries[1], entries[3]]) =
            (over.apply(aa, cc).into(), over.apply(bb, dd).into());
    }
    for &(x, weight) in gauss_sixteen() {
        let s = from + (to - from) * x;
        let (position, slope) = grading.map(s);
        let propagator = Propagator::new(k, c, length * (end - position));
        let measure = weight * (to - from) * slope * length;
        for (entries, lagrange) in integrals.iter_mut().zip(grading.rule().lagrange(s)) {
            let factor = measure * lagrange;
            entries[0] += factor * propagator.a;
            entries[1] += factor * propagator.b;
            entries[2] += factor * propagator.c;
            entries[3] += factor * propagator.d;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::series::Series;

    /// Within the reach of the series both ways give the same matrices.
    #[test]
    fn quadrature_and_series_agree() {
        let blocks = Blocks::of(vec![(1e4, 3.0), (4e6, 9e3), (0.0, 2.0), (9e8, 1e3)], None);
        let shapes = [vec![1.0, -0.8, 0.6, 0.5], vec![0.3, 0.9, -0.2, 0.7]];
        let outputs: Vec<Output> = shapes.iter().map(|shape| Output::new(&blocks, shape, &[])).collect();
        let inputs: Vec<Vec<f64>> = shapes.iter().map(|shape| blocks.input(shape)).collect();
        let series = Series::new(&blocks, &outputs, &inputs);
        let near = |x: &[f64], y: &[f64]| {
            let size = y.iter().fold(0.0_f64, |size, y| size.max(y.abs()));
            x.iter().zip(y).all(|(x, y)| (x - y).abs() < 2e-12 * size)
        };
        for grading in [Grading::Smooth, Grading::Touch, Grading::Release] {
            let length = 0.9 * series.reach();
            let active = [0, 1];
            let found =
                StepWeights::by_quadrature(&blocks, &outputs, &inputs, (&active, true), grading, length);
            let mut expected = StepWeights::default();
            series.prepare((&active, true), grading, length, &mut expected);
            series.complete((&active, true), (grading, length), &mut expected);
            for a in 0..2 {
                assert!(near(&found.rows[a], &expected.rows[a]), "{grading:?}");
                assert!(near(&found.to_state[a], &expected.to_state[a]), "{grading:?}");
                assert!(near(&found.velocity_rows[a], &expected.velocity_rows[a]), "{grading:?}");
                for b in 0..2 {
                    assert!(
                        near(
                            found.convolution[2 * a + b].as_flattened(),
                            expected.convolution[2 * a + b].as_flattened()
                        ),
                        "{grading:?}"
                    );
                    let [found, expected] = [&found, &expected].map(|w| &w.velocity_convolution[2 * a + b]);
                    assert!(near(found.as_flattened(), expected.as_flattened()), "{grading:?}");
                }
            }
        }
    }
}
