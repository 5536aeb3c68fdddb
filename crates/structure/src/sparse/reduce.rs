//! From matrices to the modal form.
//!
//! The coordinates are `x = [x_f; u]`, free ones and the displacements of supports that move. The absolute
//! motion is `x_f = sum_s Gamma_s u_s + Phi q` as for beams (see the crate's documentation), with `Gamma_s` a
//! trial shape and the static answer to the forces that it leaves. Each method of reduction is a file of its
//! own.

use std::f64::consts::TAU;

use super::{
    Matrices, MatrixReport,
    craig_bampton::FixedInterface,
    free_interface::FreeInterfaceReduction,
    guyan::guyan_modes,
    modal_form::{modal_form, support_shapes},
    pencil_modes::PencilModes,
    prepared::{Prepared, ReducedModes, Weights, dense, ensure_elastic, over_all},
    report,
    statics::Statics,
};
use crate::{
    Damping, MeshShape, ModeTables, OutlinePoint, Plane, Reduced, ReducedModel, Reduction, StructureError,
    error::positive,
    reduction::ResidualInertia,
    tables::{FrequencyError, relative_error},
};

impl Matrices {
    /// Reduces the structure and brings it to mass-normalised modal coordinates relative to its supports.
    ///
    /// * `moving`: groups of names of supports; those of a group move alike, each in its direction.
    /// * `interface`: names of the points with local elements or forces.
    ///
    /// # Errors
    /// Names, rows or nodes that are not there, matrices that do not fit together, stiffness or mass that is
    /// not positive semi-definite, mechanisms, a cut-off below the first elastic mode, and what takes too
    /// much memory.
    pub fn reduce(
        &self,
        moving: &[&[&str]],
        reduction: &Reduction,
        damping: &Damping,
        interface: &[&str],
    ) -> Result<(Reduced, MatrixReport), StructureError> {
        if let Some(cut_off_hz) = reduction.cut_off_hz() {
            positive("cut-off frequency", cut_off_hz)?;
        }
        let prepared = Prepared::new(self, moving)?;
        let cut_off_hz = reduction.cut_off_hz().unwrap_or(f64::INFINITY);
        let precision = prepared.assembled.joined.precision;
        let (full, factors) = prepared.modes(&prepared.supported, cut_off_hz, precision)?;
        let statics = Statics::new(&prepared.supported, &full, factors);
        let loads = prepared.interface(interface)?;
        let stage = Stage { full: &full, statics: &statics, cut_off_hz };
        let ReducedModes { frequencies, mut shapes, kept_hz } =
            reduced_modes(reduction, &prepared, &stage, &loads)?;
        prepared.orient(&mut shapes, &loads);
        let of_supports = support_shapes(self, &prepared, moving, &statics)?;
        let model = modal_form(self, &prepared, frequencies, &shapes, &of_supports, damping)?;
        let is_fixed = matches!(reduction, Reduction::FixedInterface { .. });
        let tables = ModeTables {
            clamped_hz: full.frequencies.iter().map(|w| w / TAU).collect(),
            free_interface_hz: if is_fixed { Vec::new() } else { kept_hz.clone() },
            fixed_interface_hz: if is_fixed { kept_hz } else { Vec::new() },
            reduced_hz: model.natural_frequencies.iter().map(|w| w / TAU).collect(),
            frequency_errors: frequency_errors(&full, &model, cut_off_hz),
            flexibility_errors: prepared.flexibility_errors(&statics, &model, &loads),
        };
        let outline = model.points.iter().enumerate().map(|(at, point)| OutlinePoint {
            at: at as f64,
            plane: Plane::Y,
            shape: point.shape.clone(),
            support_ratios: point.support_ratios.clone(),
        });
        let outline = outline.collect();
        let mut report = prepared.assembled.report.clone();
        report::complete(&mut report, self, &prepared.assembled, &prepared.supported, &full)?;
        let mesh = MeshShape::of(self, &prepared, moving, (&shapes, &of_supports))?;
        Ok((Reduced { model, tables, outline, mesh }, report))
    }
}

/// What is known of the supported structure.
struct Stage<'a> {
    /// Its modes up to the cut-off.
    full: &'a PencilModes,
    statics: &'a Statics<'a>,
    cut_off_hz: f64,
}

/// The modes that a method of reduction leaves.
fn reduced_modes(
    reduction: &Reduction,
    prepared: &Prepared,
    stage: &Stage<'_>,
    loads: &[(String, Weights)],
) -> Result<ReducedModes, StructureError> {
    let Stage { full, statics, cut_off_hz } = *stage;
    let free = |inertia| FreeInterfaceReduction { prepared, full, statics, cut_off_hz, inertia }.modes(loads);
    match reduction {
        Reduction::Truncation { .. } => {
            ensure_elastic(&prepared.supported, full, cut_off_hz)?;
            let shapes = over_all(&full.shapes, prepared.assembled.map.columns());
            Ok(ReducedModes { frequencies: full.frequencies.clone(), shapes, kept_hz: Vec::new() })
        }
        Reduction::FixedInterface { .. } | Reduction::Guyan { .. } => {
            if full.rigid() > 0 {
                return Err(StructureError::NotHeld { rigid_modes: full.rigid() });
            }
            let loads: Vec<Vec<f64>> =
                loads.iter().map(|(_, weights)| dense(weights, prepared.assembled.free)).collect();
            let modes = if matches!(reduction, Reduction::Guyan { .. }) {
                guyan_modes(&prepared.supported, statics, &loads)?
            } else {
                let precision = prepared.assembled.joined.precision;
                let pencil = &prepared.supported;
                FixedInterface { pencil, statics, loads, cut_off_hz, precision }.modes()?
            };
            let shapes = over_all(&modes.shapes, prepared.assembled.map.columns());
            Ok(ReducedModes { frequencies: modes.frequencies, shapes, kept_hz: modes.kept_hz })
        }
        Reduction::MacNeal { .. } => free(ResidualInertia::Neglected),
        Reduction::FreeInterface { .. } | Reduction::None => free(ResidualInertia::Kept),
    }
}

fn frequency_errors(full: &PencilModes, model: &ReducedModel, cut_off_hz: f64) -> Vec<FrequencyError> {
    let compare = |(&full, &reduced): (&f64, &f64)| FrequencyError {
        full_hz: full / TAU,
        reduced_hz: reduced / TAU,
        relative: relative_error(full, reduced),
        below_cut_off: full / TAU <= cut_off_hz,
    };
    full.frequencies.iter().zip(&model.natural_frequencies).map(compare).collect()
}
