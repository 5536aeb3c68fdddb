//! What is said of matrices besides their modes.

use super::{
    Matrices, MatrixReport, SymmetricMatrix, assemble::Assembled, factor::Pencil, pencil_modes::PencilModes,
    translation::RIGID_MOTIONS, vectors::dot,
};
use crate::StructureError;

/// Adds what the modes show, and refuses mechanisms.
///
/// # Errors
/// More motions without strain than the parts of the structure have as rigid bodies.
pub(super) fn complete(
    report: &mut MatrixReport,
    matrices: &Matrices,
    assembled: &Assembled,
    pencil: &Pencil,
    modes: &PencilModes,
) -> Result<(), StructureError> {
    report.parts = parts(&pencil.stiffness);
    report.rigid_modes = modes.rigid();
    report.rigid_residual = rigid_residual(&pencil.stiffness, modes);
    if report.rigid_modes > RIGID_MOTIONS * report.parts.max(1) {
        let shape = modes.shapes.col_as_slice(report.rigid_modes - 1);
        let most = (0..shape.len()).max_by(|&a, &b| shape[a].abs().total_cmp(&shape[b].abs())).unwrap_or(0);
        let row = assembled.row_of(most).map_or_else(String::new, |row| assembled.joined.label(row));
        let (found, parts) = (report.rigid_modes, report.parts);
        return Err(StructureError::TooManyRigidModes { found, parts, row });
    }
    let joined = &assembled.joined;
    report.extent = extent(matrices);
    if joined.labels.iter().all(Option::is_none) {
        return Ok(());
    }
    report.translation_strain = Some(joined.translation_strain());
    if joined.is_strained() && report.is_free() {
        return Ok(());
    }
    let along = |axis: usize| {
        let motion = joined.translation(std::array::from_fn(|other| f64::from(u8::from(other == axis))))?;
        Ok(dot(&motion, &joined.mass.times(&motion)))
    };
    report.mass = Some([along(0)?, along(1)?, along(2)?]);
    report.centre = centre(matrices, assembled);
    Ok(())
}

impl MatrixReport {
    /// Whether nothing holds the structure: each part has all motions of a rigid body in space.
    #[must_use]
    pub fn is_free(&self) -> bool {
        self.rigid_modes == RIGID_MOTIONS * self.parts.max(1)
    }
}

/// Largest `|K phi| / (|K| |phi|)` of the rigid-body modes.
fn rigid_residual(stiffness: &SymmetricMatrix, modes: &PencilModes) -> f64 {
    let largest = |vector: &[f64]| vector.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
    let stiffest = stiffness.entries().fold(0.0_f64, |largest, (_, _, value)| largest.max(value.abs()));
    let residual = |mode: usize| {
        let shape = modes.shapes.col_as_slice(mode);
        largest(&stiffness.times(shape)) / (stiffest * largest(shape)).max(f64::MIN_POSITIVE)
    };
    (0..modes.rigid()).map(residual).fold(0.0, f64::max)
}

/// Number of parts that entries join.
fn parts(matrix: &SymmetricMatrix) -> usize {
    let mut parent: Vec<usize> = (0..matrix.size()).collect();
    fn root(parent: &mut [usize], mut of: usize) -> usize {
        while parent[of] != of {
            parent[of] = parent[parent[of]];
            of = parent[of];
        }
        of
    }
    let mut count = matrix.size();
    for (row, column, _) in matrix.entries() {
        let (a, b) = (root(&mut parent, row), root(&mut parent, column));
        if a != b {
            parent[a] = b;
            count -= 1;
        }
    }
    count
}

/// `sum_i m_i p_i / m`, each row's mass that of its translation, where all nodes have places.
fn centre(matrices: &Matrices, assembled: &Assembled) -> Option<[f64; 3]> {
    if matrices.nodes.is_empty() {
        return None;
    }
    let joined = &assembled.joined;
    let motion = joined.translation([1.0, 0.0, 0.0]).ok()?;
    let heavy = joined.mass.times(&motion);
    let (mut sums, mut mass) = ([0.0; 3], 0.0);
    for (row, label) in joined.labels.iter().enumerate().filter(|(row, _)| motion[*row] != 0.0) {
        let place = matrices.nodes.get(&label.as_ref()?.node)?;
        mass += heavy[row];
        sums.iter_mut().zip(place).for_each(|(sum, at)| *sum += heavy[row] * at);
    }
    (mass > 0.0).then(|| sums.map(|sum| sum / mass))
}

fn extent(matrices: &Matrices) -> Option<[f64; 3]> {
    let range = |axis: usize| {
        let values = || matrices.nodes.values().map(|place| place[axis]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    (!matrices.nodes.is_empty()).then(|| [range(0), range(1), range(2)])
}
