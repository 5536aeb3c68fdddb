//! Matrices of a structure before anything is held.

use faer::Mat;

use crate::strain::Strains;

/// Matrices over all coordinates, before anything is held: `M`, `K = G^T G`, `C = D^T D`.
#[derive(Debug, Clone)]
pub(crate) struct Assembly {
    /// `M` [kg, kg m, kg m^2].
    pub mass: Mat<f64>,
    /// Rows of `G`.
    pub stiffness: Strains,
    /// Rows of `D`, discrete dampers only.
    pub damping: Strains,
    /// 1 for transverse displacements, 0 for rotations: the motion in a uniform translation.
    pub translation: Vec<f64>,
}

/// `matrix * vector`.
pub(crate) fn times(matrix: &Mat<f64>, vector: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; matrix.nrows()];
    for (column, factor) in vector.iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
        for (row, sum) in product.iter_mut().enumerate() {
            *sum += matrix[(row, column)] * factor;
        }
    }
    product
}
