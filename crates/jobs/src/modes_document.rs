//! Eigenfrequencies and mode shapes of a model, as a document.

use hammerbeam_structure::FlexibilityError;
use hammerbeam_study::Model;
use serde_json::{Value, json};

use crate::matrix_document;

/// What `modes` says with `--json`: eigenfrequencies before and after the reduction [Hz], shapes at points.
#[must_use]
pub fn modes_document(model: &Model) -> Value {
    let tables = &model.tables;
    let points = &model.system.model().points;
    let shapes: serde_json::Map<String, Value> =
        points.iter().map(|point| (point.name.clone(), json!(point.shape))).collect();
    let errors: Vec<f64> = tables.frequency_errors.iter().map(|error| error.relative).collect();
    let flexibility = |error: &FlexibilityError| {
        let (full, reduced) = (error.full, error.reduced);
        json!({ "point": error.point, "full_m_n": full, "reduced_m_n": reduced, "relative": error.relative })
    };
    json!({
        "clamped_hz": tables.clamped_hz,
        "free_interface_hz": tables.free_interface_hz,
        "reduced_hz": tables.reduced_hz,
        "fixed_interface_hz": tables.fixed_interface_hz,
        "reduced_relative_error": errors,
        "mass_normalised_shapes": shapes,
        "matrices": model.matrices.as_ref().map(matrix_document),
        "static_flexibility": tables.flexibility_errors.iter().map(flexibility).collect::<Vec<_>>(),
    })
}
