//! What was found in matrices, as a document.

use hammerbeam_structure::MatrixReport;
use serde_json::{Value, json};

/// What `check`, `modes` and `import` say of matrices with `--json`.
pub fn matrix_document(report: &MatrixReport) -> Value {
    json!({
        "rows": report.rows,
        "coordinates": report.coordinates,
        "massless": report.massless,
        "joined": report.joined,
        "empty_rows": report.empty_rows,
        "lagrange_rows": report.lagrange_rows,
        "fixed_rows": report.fixed_rows,
        "internal_rows": report.internal_rows,
        "unplaced_rows": report.unplaced_rows,
        "translation_strain": report.translation_strain,
        "parts": report.parts,
        "rigid_modes": report.rigid_modes,
        "rigid_residual": report.rigid_residual,
        "mass_kg": report.mass,
        "centre_m": report.centre,
    })
}
