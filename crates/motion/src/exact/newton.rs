//! Newton's method for the forces of a step: `r = r_free + W f(r)` with the small matrix `I - W f'`.
//! Equation (S6) of the book, `docs/theory`.

use super::{
    collocation::{NODES, NodeMatrix},
    force_step::ForceStep,
    lanes::add_products,
};
use crate::Law;

/// Slower convergence than this calls for a new factorisation.
const FACTORISE_ABOVE: f64 = 0.03;
pub(super) const MAX_ITERATIONS: usize = 30;
/// Substitutions by which a first guess is improved at most.
const MAX_SUBSTITUTIONS: usize = 3;
/// Largest response of the last displacement to a unit change of all displacements for which that is tried.
const SHORT: f64 = 2.0;
/// The forces of a step were not found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NotSolved;

impl ForceStep {
    /// Solves for the displacements (and velocities, see `damped_step.rs`) from the guess of them, until what
    /// is left is below `precision` times their range, or a correction below `rounding`.
    ///
    /// The matrix is factorised anew only while the corrections are large: later it is good enough to iterate
    /// with, and so is that of the last step solved if this one is nearly the same (`again`).
    pub fn solve(
        &mut self,
        laws: &[Law],
        (rounding, precision): (f64, f64),
        again: bool,
    ) -> Result<(), NotSolved> {
        let size = self.free.len();
        self.force.resize(size, 0.0);
        self.slope.resize(size, 0.0);
        // Guesses know of each law; coinciding elements have the first one's.
        self.coinciding.gather(&mut self.displacement, 1);
        self.coinciding.spread(&mut self.displacement, 1);
        self.evaluate(laws);
        if !again {
            self.improve_guess(laws);
        }
        let (mut previous, mut fresh) = (f64::NAN, !again);
        for _ in 0..MAX_ITERATIONS {
            self.fill_defect();
            if fresh {
                self.factorise()?;
            }
            self.solve_correction();
            let (mut largest, mut range, mut sum) = (0.0_f64, 0.0_f64, 0.0);
            for correction in &self.correction {
                sum += correction;
                largest = largest.max(correction.abs());
            }
            self.correct();
            for displacement in &self.displacement {
                range = range.max((displacement - self.displacement[0]).abs());
            }
            // Maxima pass over what is not a number, sums do not.
            if !largest.is_finite() || sum.is_nan() {
                return Err(NotSolved);
            }
            self.evaluate(laws);
            // What is left after this correction: its square after a fresh matrix, else as before times the
            // rate.
            let rate = if fresh { largest / range } else { largest / previous };
            if largest * rate <= precision * range || largest <= rounding {
                return self.if_forces_are_numbers();
            }
            fresh = rate > FACTORISE_ABOVE;
            previous = largest;
        }
        Err(NotSolved)
    }

    /// A law may have no value at a node, as the logarithm in a formula: then there is no such step.
    pub(super) fn if_forces_are_numbers(&self) -> Result<(), NotSolved> {
        if self.force.iter().any(|force| force.is_nan()) { Err(NotSolved) } else { Ok(()) }
    }

    /// Puts the forces of the guess into the equations for the next one, as long as that brings it nearer,
    /// where the step is short against the period of the loaded contact: an error of the guess grows with a
    /// power p of the time, and of it only `(w t)^2/((p + 1)(p + 2))` are left.
    fn improve_guess(&mut self, laws: &[Law]) {
        let count = self.coinciding.first().len();
        let mut before = f64::INFINITY;
        for _ in 0..MAX_SUBSTITUTIONS {
            let gain = |w: &NodeMatrix, slope: &[f64]| -> f64 {
                w.iter().zip(slope).map(|(w, slope)| (w[NODES - 1] * slope).abs()).sum()
            };
            let slopes = self.coinciding.summed(&self.slope);
            let largest =
                self.convolutions().zip(slopes.chunks_exact(NODES).cycle()).map(|(w, slope)| gain(w, slope));
            if largest.fold(0.0, f64::max) * count as f64 > SHORT {
                return;
            }
            self.fill_defect();
            let size = self.correction.iter().fold(0.0_f64, |size, defect| size.max(defect.abs()));
            if size.is_nan() || size > 0.5 * before {
                return;
            }
            self.correct();
            self.evaluate(laws);
            before = size;
        }
    }

    /// Between displacements that differ, row by row.
    fn convolutions(&self) -> impl Iterator<Item = &NodeMatrix> {
        let (first, count) = (self.coinciding.first(), self.active.len());
        first.iter().flat_map(move |a| first.iter().map(move |b| &self.weights.convolution[a * count + b]))
    }

    fn correct(&mut self) {
        let corrections = self.correction.as_chunks::<NODES>().0;
        let displacements = self.displacement.as_chunks_mut::<NODES>().0;
        for (nodes, &unknown) in displacements.iter_mut().zip(self.coinciding.unknown()) {
            nodes.iter_mut().zip(&corrections[unknown]).for_each(|(r, correction)| *r -= correction);
        }
    }

    pub(super) fn solve_correction(&mut self) {
        if let [_] = self.coinciding.first() {
            let mut right: [f64; NODES] = std::array::from_fn(|k| self.correction[k]);
            self.fixed_lu.solve(&mut right);
            self.correction.copy_from_slice(&right);
        } else {
            self.lu.solve(&mut self.correction);
        }
    }

    /// Solves for the rows in `work`, of `columns` entries for each node of each active element.
    pub(super) fn solve_rows(&mut self, columns: usize) {
        self.coinciding.gather(&mut self.work, columns);
        match self.coinciding.first().len() {
            1 => self.fixed_lu.solve_rows(&mut self.work[..NODES * columns], columns),
            unknowns => self.lu.solve_rows(&mut self.work[..unknowns * NODES * columns], columns),
        }
        self.coinciding.spread(&mut self.work, columns);
    }

    fn evaluate(&mut self, laws: &[Law]) {
        for (a, &e) in self.active.iter().enumerate() {
            let nodes = a * NODES..(a + 1) * NODES;
            let (force, slope) = (&mut self.force[nodes.clone()], &mut self.slope[nodes.clone()]);
            laws[e].elastic_forces(&self.displacement[nodes], force, slope);
        }
        for place in 0..self.holes.len() {
            self.evaluate_hole(laws, self.holes[place]);
        }
    }

    /// Forces of a hole whose first direction is the a-th active element, and their derivatives.
    fn evaluate_hole(&mut self, laws: &[Law], a: usize) {
        let Some(hole) = laws[self.active[a]].round_hole() else { return };
        self.cross.resize(self.free.len(), 0.0);
        for (y, z) in (a * NODES..(a + 1) * NODES).map(|y| (y, y + NODES)) {
            let force = hole.force_at([self.displacement[y], self.displacement[z]]);
            [self.force[y], self.force[z]] = force.value;
            [self.slope[y], self.slope[z]] = force.slopes;
            [self.cross[y], self.cross[z]] = [force.cross; 2];
        }
    }

    /// `r - r_free - W f(r)` for the displacements that differ.
    fn fill_defect(&mut self) {
        let Self { coinciding, correction, weights, .. } = self;
        let (first, count) = (coinciding.first(), self.active.len());
        let forces = coinciding.summed(&self.force);
        correction.resize(first.len() * NODES, 0.0);
        for (target, &a) in correction.as_chunks_mut::<NODES>().0.iter_mut().zip(first) {
            let at = |k: usize| a * NODES + k;
            *target = std::array::from_fn(|k| self.displacement[at(k)] - self.free[at(k)]);
            for (&b, force) in first.iter().zip(forces.as_chunks::<NODES>().0) {
                let w = &weights.convolution[a * count + b];
                add_products(target, w.as_flattened(), NODES, |_| force.iter().map(|f| -f));
            }
        }
    }

    /// Factorises `I - W f'`.
    pub(super) fn factorise(&mut self) -> Result<(), NotSolved> {
        let (first, active) = (self.coinciding.first(), self.active.len());
        let (count, weights) = (first.len(), &self.weights);
        let slope = self.coinciding.summed(&self.slope);
        let (holes, cross) = (&self.holes, &self.cross);
        if count == 1 {
            let (convolution, slope) = (&weights.convolution[0], &slope[..NODES]);
            return self
                .fixed_lu
                .factorise(
                    #[inline(always)]
                    |columns| {
                        for ((column, weights), slope) in columns.iter_mut().zip(convolution).zip(slope) {
                            *column = weights.map(|weight| -weight * slope);
                        }
                        (0..NODES).for_each(|k| columns[k][k] += 1.0);
                    },
                )
                .ok_or(NotSolved);
        }
        let size = count * NODES;
        let fill = |matrix: &mut [f64]| {
            for a in 0..count {
                for b in 0..count {
                    let convolution = &weights.convolution[first[a] * active + first[b]];
                    for k in 0..NODES {
                        for j in 0..NODES {
                            matrix[(a * NODES + k) * size + b * NODES + j] =
                                -convolution[j][k] * slope[b * NODES + j];
                        }
                    }
                }
            }
            (0..size).for_each(|i| matrix[i * size + i] += 1.0);
            // The derivative of one direction's force by the displacement in the other.
            for (hole, a) in holes.iter().flat_map(|hole| (0..count).map(move |a| (*hole, a))) {
                for (b, other) in [(hole, hole + 1), (hole + 1, hole)] {
                    let convolution = &weights.convolution[a * count + other];
                    for k in 0..NODES {
                        for j in 0..NODES {
                            matrix[(a * NODES + k) * size + b * NODES + j] -=
                                convolution[j][k] * cross[b * NODES + j];
                        }
                    }
                }
            }
        };
        self.lu.factorise(size, fill).ok_or(NotSolved)
    }
}
