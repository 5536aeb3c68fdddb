//! A structure of matrices made ready for its reduction: coordinates, pencils, points.

use faer::Mat;

use super::{
    Matrices, MatrixPoint,
    assemble::Assembled,
    factor::{Factors, Pencil},
    map::CoordinateMap,
    memory::MemoryBudget,
    passive::ensure_passive,
    pencil_modes::PencilModes,
    statics::Statics,
    vectors::dot,
};
use crate::{
    FlexibilityError, ReducedModel, StructureError,
    tables::{flexibility, relative_error},
};

/// A mode that is at rest at a point moves less than this part of its largest displacement there.
const AT_REST: f64 = 1e-6;

/// Weighted coordinates.
pub(super) type Weights = Vec<(usize, f64)>;

/// A structure whose supports are told apart, with its pencils.
pub(super) struct Prepared {
    pub assembled: Assembled,
    /// Over the free coordinates.
    pub supported: Pencil,
    /// Weights of each point over all coordinates x.
    pub points: Vec<(String, Weights)>,
}

/// What a reduction leaves.
pub(super) struct ReducedModes {
    /// `w` [rad/s].
    pub frequencies: Vec<f64>,
    /// Shapes over all coordinates x, one column a mode.
    pub shapes: Mat<f64>,
    /// Frequencies of the modes of the basis [Hz].
    pub kept_hz: Vec<f64>,
}

impl Prepared {
    /// The structure with the supports of these groups told apart.
    pub fn new(matrices: &Matrices, moving: &[&[&str]]) -> Result<Self, StructureError> {
        let assembled = matrices.assembled(moving)?;
        let free: Vec<usize> = (0..assembled.free).collect();
        let selected = CoordinateMap::selecting(assembled.map.columns(), &free);
        let supported = Pencil::new(
            selected.congruence(&assembled.stiffness),
            selected.congruence(&assembled.mass),
            MemoryBudget::of(matrices.memory_limit_bytes),
        )?;
        ensure_passive(&assembled)?;
        let weights = |point: &MatrixPoint| {
            let weights = point.weights(&assembled.joined)?;
            Ok((point.name.clone(), assembled.map.pulled_back(&weights)))
        };
        let points: Result<Vec<(String, Weights)>, StructureError> =
            matrices.points.iter().map(weights).collect();
        Ok(Self { points: points?, supported, assembled })
    }

    /// Modes of a pencil, mechanisms named by their rows.
    pub fn modes<'a>(
        &self,
        pencil: &'a Pencil,
        cut_off_hz: f64,
        precision: f64,
    ) -> Result<(PencilModes, Factors<'a>), StructureError> {
        pencil.modes_and_factors(cut_off_hz, precision).map_err(|error| self.assembled.named(error))
    }

    /// Names and weights of the interface points.
    pub fn interface(&self, names: &[&str]) -> Result<Vec<(String, Weights)>, StructureError> {
        let find = |name: &&str| {
            let known = self.points.iter().find(|(known, _)| known == name);
            known.cloned().ok_or_else(|| StructureError::UnknownPoint {
                what: "the interface".into(),
                name: (*name).into(),
                known: self.points.iter().map(|(known, _)| known.clone()).collect(),
            })
        };
        names.iter().map(find).collect()
    }

    /// Turns each mode so that it is positive at the first interface point where it moves, else where it
    /// moves most.
    pub fn orient(&self, shapes: &mut Mat<f64>, loads: &[(String, Weights)]) {
        for mode in 0..shapes.ncols() {
            let shape = shapes.col_as_slice(mode);
            let largest = shape.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
            let at =
                |weights: &Weights| weights.iter().map(|&(row, weight)| weight * shape[row]).sum::<f64>();
            let mut at_points = loads.iter().map(|(_, weights)| at(weights));
            let reference = at_points.find(|value| value.abs() > AT_REST * largest);
            let most = || shape.iter().copied().find(|entry| entry.abs() >= 0.999 * largest);
            if reference.or_else(most).is_some_and(|value| value < 0.0) {
                shapes.col_mut(mode).iter_mut().for_each(|entry| *entry = -*entry);
            }
        }
    }

    pub fn flexibility_errors(
        &self,
        statics: &Statics<'_>,
        model: &ReducedModel,
        loads: &[(String, Weights)],
    ) -> Vec<FlexibilityError> {
        let error = |(name, weights): &(String, Weights)| {
            let load = dense(weights, self.assembled.free);
            let full = dot(&load, &statics.elastic(&load));
            let reduced = model
                .point(name)
                .map_or(0.0, |point| flexibility(&model.natural_frequencies, point.shape.iter()));
            FlexibilityError { point: name.clone(), full, reduced, relative: relative_error(full, reduced) }
        };
        loads.iter().map(error).collect()
    }
}

/// Weights as a vector over the first coordinates.
pub(super) fn dense(weights: &Weights, size: usize) -> Vec<f64> {
    let mut vector = vec![0.0; size];
    weights.iter().filter(|(row, _)| *row < size).for_each(|&(row, weight)| vector[row] += weight);
    vector
}

/// Rows of zeros below, up to `rows` in all.
pub(super) fn over_all(shapes: &Mat<f64>, rows: usize) -> Mat<f64> {
    Mat::from_fn(rows, shapes.ncols(), |i, j| if i < shapes.nrows() { shapes[(i, j)] } else { 0.0 })
}

/// Refuses a cut-off that keeps rigid-body modes alone where there are others.
pub(super) fn ensure_elastic(
    pencil: &Pencil,
    modes: &PencilModes,
    cut_off_hz: f64,
) -> Result<(), StructureError> {
    if modes.rigid() < modes.frequencies.len() || !cut_off_hz.is_finite() {
        return Ok(());
    }
    match pencil.first_beyond(modes)? {
        Some(first_hz) => Err(StructureError::CutOffBelowFirstMode { cut_off_hz, first_hz }),
        None => Ok(()),
    }
}
