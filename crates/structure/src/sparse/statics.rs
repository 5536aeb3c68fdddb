//! Static answers beside the modes that are kept.
//!
//! With `Phi` the kept modes and `f` a load, the deleted modes answer it with `x`, `K x = f - M Phi Phi^T f`,
//! `Phi^T M x = 0`: for kept rigid-body modes this is inertia relief. `K` may be singular, so conjugate
//! gradients with `(K - sigma M)^-1` for a preconditioner find `x`: on what is left of the space, `lambda /
//! (lambda - sigma)` lies close to 1, and what has no mass is right at once.

use faer::Mat;

use super::{
    factor::{Factors, Pencil},
    matrix::SymmetricMatrix,
    pencil_modes::PencilModes,
    vectors::{add, dot},
};

/// Residual at which a static answer is as good as rounding lets it be.
const SOLVED: f64 = 1e-15;
/// Steps of conjugate gradients at most: one for each mode below the shift, and some.
const STEPS: usize = 300;

/// Static answers of a pencil whose lowest modes are kept.
pub(crate) struct Statics<'a> {
    stiffness: &'a SymmetricMatrix,
    factors: Factors<'a>,
    frequencies: &'a [f64],
    /// `Phi`, column by column.
    shapes: Vec<&'a [f64]>,
    /// `M Phi`, column by column.
    heavy: Vec<Vec<f64>>,
}

impl<'a> Statics<'a> {
    /// * `factors`: at the shift below all eigenvalues.
    pub fn new(pencil: &'a Pencil, modes: &'a PencilModes, factors: Factors<'a>) -> Self {
        let shapes: Vec<&[f64]> =
            (0..modes.shapes.ncols()).map(|column| modes.shapes.col_as_slice(column)).collect();
        let heavy = shapes.iter().map(|shape| pencil.mass.times(shape)).collect();
        Self { stiffness: &pencil.stiffness, factors, frequencies: &modes.frequencies, shapes, heavy }
    }

    /// What the deleted modes answer to a load.
    pub fn deleted(&self, load: &[f64]) -> Vec<f64> {
        let mut residual = load.to_vec();
        self.without(&mut residual, &self.shapes, &self.heavy);
        let mut answer = vec![0.0; load.len()];
        let mut step = self.preconditioned(&residual);
        let mut energy = dot(&residual, &step);
        let mut direction = step.clone();
        let small = SOLVED * SOLVED * energy;
        for _ in 0..STEPS {
            if energy <= small || energy <= 0.0 {
                break;
            }
            let bent = self.stiffness.times(&direction);
            let curvature = dot(&direction, &bent);
            if curvature <= 0.0 {
                break;
            }
            let length = energy / curvature;
            add(&mut answer, length, &direction);
            add(&mut residual, -length, &bent);
            self.without(&mut residual, &self.shapes, &self.heavy);
            step = self.preconditioned(&residual);
            let next = dot(&residual, &step);
            direction.iter_mut().zip(&step).for_each(|(to, from)| *to = from + next / energy * *to);
            energy = next;
        }
        answer
    }

    /// What all elastic modes answer to a load: that of the deleted ones and of the kept ones.
    pub fn elastic(&self, load: &[f64]) -> Vec<f64> {
        let mut answer = self.deleted(load);
        for (shape, w) in self.shapes.iter().zip(self.frequencies).filter(|(_, w)| **w > 0.0) {
            add(&mut answer, dot(shape, load) / (w * w), shape);
        }
        answer
    }

    fn preconditioned(&self, residual: &[f64]) -> Vec<f64> {
        let mut solution = Mat::from_fn(residual.len(), 1, |row, _| residual[row]);
        self.factors.solve(solution.as_mut());
        let mut solution = solution.col_as_slice(0).to_vec();
        for (shape, heavy) in self.shapes.iter().zip(&self.heavy) {
            let along = dot(heavy, &solution);
            add(&mut solution, -along, shape);
        }
        solution
    }

    /// Takes the loads off that drive the kept modes.
    fn without(&self, load: &mut [f64], shapes: &[&[f64]], heavy: &[Vec<f64>]) {
        for (shape, heavy) in shapes.iter().zip(heavy) {
            let along = dot(shape, load);
            add(load, -along, heavy);
        }
    }
}
