//! From a structure to its reduced model: modes, support motion, damping, outputs and tables.

use std::f64::consts::TAU;

use faer::Mat;

use crate::{
    Damping, FlexibilityError, MeshShape, ModeTables, Plane, PointOutput, ReducedModel, Reduction, Structure,
    StructureError, SupportInput,
    assembly::times,
    error::finite,
    modes::Modes,
    orient::orient,
    reduction::Basis,
    structure::{Kind, Place},
    tables::{flexibility, frequency_errors, relative_error},
};

/// A reduced structure and what was lost on the way.
#[derive(Debug, Clone)]
pub struct Reduced {
    /// The modal form that the motion crate takes over.
    pub model: ReducedModel,
    /// Eigenfrequencies of all stages, and the error of the reduction.
    pub tables: ModeTables,
    /// The shape of the whole structure: of a beam its nodes, of a lumped structure its masses.
    pub outline: Vec<OutlinePoint>,
    /// The mesh of a structure of matrices that has lines.
    pub mesh: Option<MeshShape>,
}

/// A place of a structure and how it moves, for drawing the structure as a whole: `y = shape . q +
/// support_ratios . u`.
#[derive(Debug, Clone, PartialEq)]
pub struct OutlinePoint {
    /// Distance from the left end [m]; of a lumped structure the number of the mass, from 0.
    pub at: f64,
    /// Plane of bending; the first of a structure that has one.
    pub plane: Plane,
    /// Displacement in each mode [kg^-1/2], length n.
    pub shape: Vec<f64>,
    /// Displacement per unit static motion of each support [-].
    pub support_ratios: Vec<f64>,
}

impl Structure {
    /// Reduces the structure and brings it to mass-normalised modal coordinates relative to its supports.
    ///
    /// The absolute motion is `y = sum_s Gamma_s u_s + Phi q`, with the static answers `Gamma_s = -K_ff^-1
    /// K_fs` to the support motions. Modes have the sign that makes them positive at the first interface
    /// point where they move; without one, where they move most. Costs one dense singular value
    /// decomposition of the unreduced structure, and another for each reduction: of the order of a
    /// second each for 1000 coordinates (500 elements), growing with the cube.
    ///
    /// * `interface`: names of the points with local elements or forces; held or prescribed ones may be
    ///   named.
    ///
    /// # Errors
    /// An unknown interface point, a cut-off below the first elastic mode, a lumped structure with a
    /// reduction, damping ratios out of range or number, nothing left free.
    pub fn reduce(
        &self,
        reduction: &Reduction,
        damping: &Damping,
        interface: &[&str],
    ) -> Result<Reduced, StructureError> {
        let coordinates = self.coordinates("the interface", interface)?;
        let full = self.supported_modes()?;
        let basis = reduction.basis(self, &full, &coordinates)?;
        let (frequencies, shapes) = self.relative_modes(&full, basis.as_ref())?;
        let shapes = orient(self.over_all(shapes), &coordinates, &self.assembly.translation);
        let support_shapes = self.support_shapes(&full);
        let outline = self.outline(&shapes, &support_shapes);
        let model = self.modal_form(frequencies, &shapes, &support_shapes, damping)?;
        let mut tables = self.tables(&full, &model, reduction, basis);
        tables.flexibility_errors = self.flexibility_errors(&full, &model, interface);
        Ok(Reduced { model, tables, outline, mesh: None })
    }

    fn outline(&self, shapes: &Mat<f64>, support_shapes: &Mat<f64>) -> Vec<OutlinePoint> {
        let point = |place: &Place| OutlinePoint {
            at: place.at,
            plane: Plane::Y,
            shape: shapes.row(place.coordinate).iter().copied().collect(),
            support_ratios: support_shapes.row(place.coordinate).iter().copied().collect(),
        };
        self.places().iter().map(point).collect()
    }

    /// Frequencies and shapes (over the free coordinates) of the motion relative to the supports.
    fn relative_modes(
        &self,
        full: &Modes,
        basis: Option<&Basis>,
    ) -> Result<(Vec<f64>, Mat<f64>), StructureError> {
        let Some(Basis { relative, mass, .. }) = basis else {
            return Ok((full.frequencies.clone(), full.shapes.clone()));
        };
        let free = self.free_coordinates();
        let own = || {
            let mass = Mat::from_fn(free.len(), free.len(), |i, j| self.assembly.mass[(free[i], free[j])]);
            relative.transpose() * mass * relative
        };
        let mass = mass.clone().unwrap_or_else(own);
        let strains = self.assembly.stiffness.columns(&free) * relative;
        let highest = full.frequencies.last().copied().unwrap_or(0.0);
        let modes = Modes::of(strains.as_ref(), mass.as_ref())?.rigid_beside(highest);
        Ok((modes.frequencies, relative * modes.shapes))
    }

    /// Rows over the free coordinates spread over all of them, zero elsewhere.
    fn over_all(&self, shapes: Mat<f64>) -> Mat<f64> {
        let mut all = Mat::zeros(self.assembly.translation.len(), shapes.ncols());
        for (row, index) in self.free_coordinates().into_iter().enumerate() {
            all.row_mut(index).copy_from(shapes.row(row));
        }
        all
    }

    fn modal_form(
        &self,
        frequencies: Vec<f64>,
        shapes: &Mat<f64>,
        support_shapes: &Mat<f64>,
        damping: &Damping,
    ) -> Result<ReducedModel, StructureError> {
        let damper_strains = self.assembly.damping.of(shapes.as_ref());
        let damping = damping.matrix(&frequencies, damper_strains.as_ref())?;
        let output = |name: &str, row: usize| PointOutput {
            name: name.into(),
            shape: shapes.row(row).iter().copied().collect(),
            support_ratios: support_shapes.row(row).iter().copied().collect(),
        };
        let points = self.points().iter().map(|point| output(&point.name, point.coordinate)).collect();
        // `Phi^T C [Gamma; 1] = (D Phi)^T (D [Gamma; 1])`.
        let on_supports =
            damper_strains.transpose() * self.assembly.damping.of(support_shapes.as_ref()).as_ref();
        let input = |support: usize| SupportInput {
            inertia: projected(shapes, &times(&self.assembly.mass, support_shapes.col_as_slice(support))),
            damping: on_supports.col(support).iter().copied().collect(),
        };
        let supports = (0..support_shapes.ncols()).map(input).collect();
        let uniform_acceleration = projected(shapes, &self.uniform_load());
        let model = ReducedModel {
            natural_frequencies: frequencies,
            damping,
            points,
            supports,
            uniform_acceleration,
        };
        check_finite(&model).map(|()| model)
    }

    fn tables(
        &self,
        full: &Modes,
        model: &ReducedModel,
        reduction: &Reduction,
        basis: Option<Basis>,
    ) -> ModeTables {
        let clamped_hz = full.frequencies_hz();
        if self.kind == Kind::Lumped {
            return ModeTables { clamped_hz, ..ModeTables::default() };
        }
        let kept_hz = basis.map(|basis| basis.kept_hz).unwrap_or_default();
        let (free_interface_hz, fixed_interface_hz) = match reduction {
            Reduction::FixedInterface { .. } => (Vec::new(), kept_hz),
            Reduction::Truncation { .. } | Reduction::Guyan { .. } => (Vec::new(), Vec::new()),
            Reduction::FreeInterface { .. } | Reduction::MacNeal { .. } | Reduction::None => {
                (kept_hz, Vec::new())
            }
        };
        ModeTables {
            clamped_hz,
            free_interface_hz,
            fixed_interface_hz,
            reduced_hz: model.natural_frequencies.iter().map(|w| w / TAU).collect(),
            frequency_errors: frequency_errors(full, &model.natural_frequencies, reduction),
            flexibility_errors: Vec::new(),
        }
    }

    fn flexibility_errors(
        &self,
        full: &Modes,
        model: &ReducedModel,
        interface: &[&str],
    ) -> Vec<FlexibilityError> {
        let free = self.free_coordinates();
        let named = self.points().iter().filter(|point| interface.contains(&point.name.as_str()));
        let compare = |name: &str, row: usize| {
            let exact = flexibility(&full.frequencies, full.shapes.row(row).iter());
            let reduced = model
                .point(name)
                .map_or(0.0, |point| flexibility(&model.natural_frequencies, point.shape.iter()));
            let relative = relative_error(exact, reduced);
            FlexibilityError { point: name.into(), full: exact, reduced, relative }
        };
        named
            .filter_map(|point| {
                free.iter().position(|&index| index == point.coordinate).map(|row| (point, row))
            })
            .map(|(point, row)| compare(&point.name, row))
            .collect()
    }
}

/// `Phi^T v`.
fn projected(shapes: &Mat<f64>, vector: &[f64]) -> Vec<f64> {
    shapes.col_iter().map(|shape| shape.iter().zip(vector).map(|(a, b)| a * b).sum()).collect()
}

/// Refuses a model whose numbers left the range of floating point: the input was absurd in size.
pub(crate) fn check_finite(model: &ReducedModel) -> Result<(), StructureError> {
    for (mode, &w) in model.natural_frequencies.iter().enumerate() {
        finite(&format!("eigenfrequency {}", mode + 1), w)?;
        finite(&format!("square of eigenfrequency {}", mode + 1), w * w)?;
    }
    let shapes = model.points.iter().flat_map(|point| &point.shape);
    shapes
        .chain(model.damping.col_iter().flat_map(|column| column.iter()))
        .try_for_each(|&value| finite("an entry of the reduced model", value).map(drop))
}
