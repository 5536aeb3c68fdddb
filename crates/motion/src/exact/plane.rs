//! Newton's method on one invariant plane of a structure with coupling dampers.
//!
//! With displacements `u_p` and `u_s` the two columns of a block are `[u_p; -k u_s]` and `[u_s; u_p - c
//! u_s]`, and they span an invariant plane if
//!
//! `(k - W^2) u_p + k (C - c) u_s = 0`, `(c - C) u_p + (k - W^2 + c C - c^2) u_s = 0`, `W = diag(w)`.
//!
//! Unknown are `u_p`, `u_s`, `k` and `c`; the two ways in which the columns may change within the plane are
//! held. Rows and columns are scaled by their own sizes, so slow planes of stiff structures keep their
//! digits.

use faer::{Mat, linalg::solvers::Solve};
use hammerbeam_structure::ReducedModel;

/// Newton steps at most; two or three bring rounding.
const MAX_STEPS: usize = 8;

/// A block and the displacements of its columns.
#[derive(Debug, Clone)]
pub(super) struct InvariantPlane {
    pub stiffness: f64,
    pub damping: f64,
    pub p: Vec<f64>,
    pub s: Vec<f64>,
}

impl InvariantPlane {
    /// The column of p: displacements and velocities.
    pub fn column_p(&self) -> Vec<f64> {
        let velocities = self.s.iter().map(|s| -self.stiffness * s);
        self.p.iter().copied().chain(velocities).collect()
    }

    /// The column of s.
    pub fn column_s(&self) -> Vec<f64> {
        let velocities = self.p.iter().zip(&self.s).map(|(p, s)| p - self.damping * s);
        self.s.iter().copied().chain(velocities).collect()
    }

    /// Newton's method, as long as the corrections become smaller.
    pub fn refine(&mut self, model: &ReducedModel, group: &[usize]) {
        let mut last = f64::INFINITY;
        for _ in 0..MAX_STEPS {
            let Some((candidate, correction)) = self.newton_step(model, group) else { return };
            if correction.is_nan() || correction >= last {
                return;
            }
            *self = candidate;
            last = correction;
        }
    }

    /// One step, and the size of its correction.
    fn newton_step(&self, model: &ReducedModel, group: &[usize]) -> Option<(Self, f64)> {
        let m = group.len();
        let (rate, length) = (self.rate(), self.length());
        let (mut matrix, mut defect) = self.equations(model, group);
        for column in 0..2 {
            for i in 0..2 * m {
                matrix[(i, 2 * m + column)] /= length;
                matrix[(2 * m + column, i)] /= length;
            }
        }
        for row in 0..2 * m {
            let size = (0..2 * m).map(|j| matrix[(row, j)].abs()).fold(f64::MIN_POSITIVE, f64::max);
            (0..2 * m + 2).for_each(|j| matrix[(row, j)] /= size);
            defect[(row, 0)] /= size * length;
        }
        let change = matrix.partial_piv_lu().solve(&defect);
        let size = change.norm_l2();
        if !size.is_finite() {
            return None;
        }
        let candidate = Self {
            stiffness: self.stiffness - change[(2 * m, 0)] * rate * rate,
            damping: self.damping - change[(2 * m + 1, 0)] * rate,
            p: (0..m).map(|i| self.p[i] - change[(i, 0)] * rate * length).collect(),
            s: (0..m).map(|i| self.s[i] - change[(m + i, 0)] * length).collect(),
        };
        Some((candidate, size))
    }

    /// Displacements of s count as much as those of p over this rate.
    fn rate(&self) -> f64 {
        self.stiffness.abs().sqrt().max(self.damping.abs())
    }

    /// Size of the plane's displacements.
    fn length(&self) -> f64 {
        let rate = self.rate();
        self.p.iter().map(|p| (p / rate).powi(2)).chain(self.s.iter().map(|s| s * s)).sum::<f64>().sqrt()
    }

    /// Matrix and defect of the linearised equations in the file header, then the two rows that hold the
    /// changes within the plane.
    ///
    /// Columns: p over the rate, s, k over the rate squared, c over the rate.
    fn equations(&self, model: &ReducedModel, group: &[usize]) -> (Mat<f64>, Mat<f64>) {
        let m = group.len();
        let (k, c, rate) = (self.stiffness, self.damping, self.rate());
        let (k_scale, c_scale) = (rate * rate, rate);
        let square = |i: usize| model.natural_frequencies[group[i]].powi(2);
        let mut matrix = Mat::<f64>::zeros(2 * m + 2, 2 * m + 2);
        let mut defect = Mat::<f64>::zeros(2 * m + 2, 1);
        for i in 0..m {
            let (mut first, mut second) = ((k - square(i)) * self.p[i], (k - square(i)) * self.s[i]);
            for j in 0..m {
                let unit = if i == j { 1.0 } else { 0.0 };
                let full = model.damping[(group[i], group[j])];
                let relative = full - c * unit;
                first += k * relative * self.s[j];
                second += -relative * self.p[j] + c * relative * self.s[j];
                matrix[(i, j)] = (k - square(i)) * unit * rate;
                matrix[(i, m + j)] = k * relative;
                matrix[(m + i, j)] = -relative * rate;
                matrix[(m + i, m + j)] = (k - square(i)) * unit + c * relative;
                matrix[(i, 2 * m)] += relative * self.s[j] * k_scale;
                matrix[(m + i, 2 * m + 1)] += (full - 2.0 * c * unit) * self.s[j] * c_scale;
            }
            matrix[(i, 2 * m)] += self.p[i] * k_scale;
            matrix[(i, 2 * m + 1)] = -k * self.s[i] * c_scale;
            matrix[(m + i, 2 * m)] = self.s[i] * k_scale;
            matrix[(m + i, 2 * m + 1)] += self.p[i] * c_scale;
            (defect[(i, 0)], defect[(m + i, 0)]) = (first, second);
            // The changes within the plane: in length, and along `A`.
            matrix[(2 * m, i)] = self.p[i] / rate;
            matrix[(2 * m, m + i)] = self.s[i];
            matrix[(2 * m + 1, i)] = -k * self.s[i] / (rate * rate);
            matrix[(2 * m + 1, m + i)] = (self.p[i] - c * self.s[i]) / rate;
        }
        (matrix, defect)
    }
}
