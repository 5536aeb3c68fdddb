//! A multiplier at +1 or -1: the bordered matrix of `A - mu I`.
//!
//! `[A - mu I, b; c^T, 0] [v; g] = [0; 1]` and `[w^T, h] [A - mu I, b; c^T, 0] = [0, 1]`; `g = h` vanishes
//! with the determinant of `A - mu I`, and `dg = -w^T (dA) v`. Since `c^T v = b^T w = 1`, borders that are
//! renewed as `v` and `w` along the curve keep the sign of `g`.

use hammerbeam_motion::exact::MotionError;
use hammerbeam_path::DenseLu;

use super::{
    linear::Linear,
    null::null_space,
    shooting::{CurveOrbit, Shooting},
};
use crate::by_rows::{dot, shifted, times, transposed};

/// The borders.
#[derive(Debug, Clone)]
pub(super) struct Bordered {
    /// +1 or -1.
    pub multiplier: f64,
    left: Vec<f64>,
    right: Vec<f64>,
}

/// The vectors at one place.
#[derive(Debug, Clone)]
pub(super) struct Vectors {
    pub value: f64,
    pub left: Vec<f64>,
    pub right: Vec<f64>,
}

impl Bordered {
    /// Borders that suit the monodromy matrix of the last evaluated place.
    pub fn new(multiplier: f64, shooting: &Shooting) -> Self {
        let size = shooting.size();
        let matrix = shifted(size, shooting.monodromy(), [multiplier, 0.0]);
        let right = null_space(size, &matrix, 1).swap_remove(0);
        let left = null_space(size, &transposed(size, &matrix), 1).swap_remove(0);
        Self { multiplier, left, right }
    }

    /// Vectors of the bordered matrix at the last evaluated place; `None` if it is singular.
    pub fn vectors(&self, shooting: &Shooting) -> Option<Vectors> {
        let size = shooting.size();
        let matrix = shifted(size, shooting.monodromy(), [self.multiplier, 0.0]);
        let right = solve(size, &matrix, &self.left, &self.right)?;
        let left = solve(size, &transposed(size, &matrix), &self.right, &self.left)?;
        Some(Vectors { value: right[size], left: left[..size].to_vec(), right: right[..size].to_vec() })
    }

    /// Renews the borders at the last evaluated place.
    pub fn renew(&mut self, shooting: &Shooting) {
        let Some(Vectors { left, right, .. }) = self.vectors(shooting) else { return };
        let unit = |vector: Vec<f64>| -> Vec<f64> {
            let length = dot(&vector, &vector).sqrt();
            vector.into_iter().map(|x| x / length).collect()
        };
        (self.left, self.right) = (unit(left), unit(right));
    }

    /// The borders of orbits that are cut elsewhere, at the last evaluated place: null vectors there, with
    /// the signs of `P^-T w` and `P v`.
    ///
    /// * `matrix`: `P`, the fundamental matrix from the old first node to the new one, by rows.
    pub fn carry(&mut self, shooting: &Shooting, matrix: &[f64]) {
        let new = Self::new(self.multiplier, shooting);
        let toward = |new: Vec<f64>, old: &[f64]| -> Vec<f64> {
            let sign = dot(&new, &times(matrix, old)).signum();
            new.into_iter().map(|x| sign * x).collect()
        };
        // (P^-T w) . (P w) = w . w.
        (self.left, self.right) = (toward(new.left, &self.left), toward(new.right, &self.right));
    }

    /// `g` and its gradient, and the tests `w^T v` and `w^T D^2 Z (v, v)`, for vectors of length one.
    pub fn evaluate(
        &self,
        shooting: &mut Shooting,
        place: &CurveOrbit,
    ) -> Result<Option<Linear>, MotionError> {
        let Some(Vectors { value, left, right }) = self.vectors(shooting) else { return Ok(None) };
        let mut gradient = shooting.gradient(place, &left, &right)?;
        gradient.iter_mut().for_each(|entry| *entry = -*entry);
        let lengths = dot(&left, &left).sqrt() * dot(&right, &right).sqrt();
        let carried: Vec<f64> = shooting.carried(&right).concat();
        let second = -dot(&gradient[..carried.len()], &carried) / (lengths * dot(&right, &right).sqrt());
        let tests = vec![dot(&left, &right) / lengths, second];
        Ok(Some(Linear { values: vec![value], rows: vec![gradient], tests }))
    }
}

/// `[matrix, column; row^T, 0] x = [0; 1]`.
fn solve(size: usize, matrix: &[f64], column: &[f64], row: &[f64]) -> Option<Vec<f64>> {
    let mut bordered = Vec::with_capacity((size + 1) * (size + 1));
    for (entries, last) in matrix.chunks_exact(size).zip(column) {
        bordered.extend_from_slice(entries);
        bordered.push(*last);
    }
    bordered.extend_from_slice(row);
    bordered.push(0.0);
    let mut lu = DenseLu::new();
    lu.factorise(size + 1, &bordered).ok()?;
    let mut solution = vec![0.0; size + 1];
    solution[size] = 1.0;
    lu.solve(&mut solution);
    solution.iter().all(|x| x.is_finite()).then_some(solution)
}
