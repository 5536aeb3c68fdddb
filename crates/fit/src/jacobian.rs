//! The linear algebra of a Jacobian: columns of length one and singular values.

use faer::{Mat, linalg::solvers::Svd};

/// Singular values below this fraction of the largest count as zero: it is the accuracy of derivatives by
/// differences.
pub(crate) const RANK: f64 = 1e-6;

/// `J C^-1 = U S V^T` with scales C of the columns.
#[derive(Debug)]
pub(crate) struct ScaledJacobian {
    svd: Svd<f64>,
    /// C: divisor of each column.
    pub scale: Vec<f64>,
    /// S, largest first.
    pub singular: Vec<f64>,
}

impl ScaledJacobian {
    /// A decomposition with the columns divided by `scale`; `None` if it is not finite.
    pub fn with_scale(jacobian: &Mat<f64>, scale: Vec<f64>) -> Option<Self> {
        let unit = Mat::from_fn(jacobian.nrows(), jacobian.ncols(), |i, j| jacobian[(i, j)] / scale[j]);
        let svd = unit.thin_svd().ok()?;
        let singular: Vec<f64> = svd.S().column_vector().iter().copied().collect();
        singular.iter().all(|s| s.is_finite()).then_some(Self { svd, scale, singular })
    }

    /// A decomposition with columns of length one; zero columns stay zero.
    pub fn with_unit_columns(jacobian: &Mat<f64>) -> Option<Self> {
        let scale = lengths(jacobian).into_iter().map(|l| if l > 0.0 { l } else { 1.0 }).collect();
        Self::with_scale(jacobian, scale)
    }

    /// Number of singular values that do not count as zero.
    pub fn rank(&self) -> usize {
        let largest = self.singular.first().copied().unwrap_or(0.0);
        self.singular.iter().filter(|s| **s > RANK * largest).count()
    }

    /// `V_jk`: component of parameter j in direction k. Directions beyond the number of data have no singular
    /// value.
    pub fn part(&self, parameter: usize, direction: usize) -> f64 {
        self.svd.V()[(parameter, direction)]
    }

    /// `U^T r`, over the singular values.
    pub fn projected(&self, residuals: &[f64]) -> Vec<f64> {
        let along = |k: usize| residuals.iter().enumerate().map(|(i, r)| self.svd.U()[(i, k)] * r).sum();
        (0..self.singular.len()).map(along).collect()
    }

    /// The step `-C^-1 V diag(s/(s^2 + damping)) b`, where b is [`projected`](Self::projected).
    pub fn step(&self, projected: &[f64], damping: f64) -> Vec<f64> {
        let amounts: Vec<f64> = self
            .singular
            .iter()
            .zip(projected)
            .map(|(s, b)| if *s > 0.0 { -s * b / (s * s + damping) } else { 0.0 })
            .collect();
        let of = |j: usize| -> f64 { amounts.iter().enumerate().map(|(k, a)| self.part(j, k) * a).sum() };
        (0..self.scale.len()).map(|j| of(j) / self.scale[j]).collect()
    }

    /// Reduction of the sum of squares of the linear model by that step.
    pub fn predicted(&self, projected: &[f64], damping: f64) -> f64 {
        let gain = |(s, b): (&f64, &f64)| {
            let remaining = if s * s + damping > 0.0 { damping / (s * s + damping) } else { 1.0 };
            b * b * (1.0 - remaining * remaining)
        };
        self.singular.iter().zip(projected).map(gain).sum()
    }
}

/// Lengths of the columns.
pub(crate) fn lengths(jacobian: &Mat<f64>) -> Vec<f64> {
    (0..jacobian.ncols()).map(|j| jacobian.col(j).norm_l2()).collect()
}
