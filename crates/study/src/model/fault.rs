//! Faults of a structure or a system, at the keys of the study that are to blame.

use hammerbeam_motion::SystemError;
use hammerbeam_structure::{MatrixPart, StructureError};

use super::structure::{self, ReduceError};
use crate::{
    document::{FaultReport, unit::readable},
    file::{MatricesTable, StructureTable, StudyError, StudyFile},
};

/// Faults of a study file, and beside them what only its assembled structure shows: else that came to light
/// when everything else is right.
#[must_use]
pub fn with_structure_fault(error: StudyError) -> StudyError {
    let StudyError::Invalid(report) = error else { return error };
    let Some(file) = StudyFile::parse_structure(&report.name, report.text()) else {
        return StudyError::Invalid(report);
    };
    // What depends on where stops act is left alone: there are none here.
    let fault = match structure::reduce(&file.study, &[]) {
        Err(
            error @ (ReduceError::Files(_)
            | ReduceError::Structure(
                StructureError::CutOffBelowFirstMode { .. }
                | StructureError::NotHeld { .. }
                | StructureError::MovedTwice { .. }
                | StructureError::StiffnessNotPositive { .. }
                | StructureError::NoSuchRow { .. }
                | StructureError::NoSuchNodes { .. }
                | StructureError::NoSuchLabel { .. }
                | StructureError::LabelTwice { .. }
                | StructureError::JoinedTwice { .. }
                | StructureError::NoLabels { .. },
            )),
        ) => reduce_fault(&file, &error),
        _ => return StudyError::Invalid(report),
    };
    let StudyError::Invalid(of_structure) = fault else { return StudyError::Invalid(report) };
    StudyError::Invalid(of_structure.problems.into_iter().fold(report, FaultReport::with))
}

/// The fault of a structure, or of a file of it, at the key that is to blame.
pub(super) fn reduce_fault(file: &StudyFile, error: &ReduceError) -> StudyError {
    match error {
        ReduceError::Structure(error) => structure_fault(file, error),
        ReduceError::Files(problem) => file.fault(&problem.key, problem.message.clone(), Vec::new()),
    }
}

/// The fault of a structure at the key that is to blame.
fn structure_fault(file: &StudyFile, error: &StructureError) -> StudyError {
    if let StructureTable::Matrices(matrices) = &file.study.structure
        && let Some((key, help)) = matrix_fault(matrices, error)
    {
        return file.fault(&key, error.to_string(), help);
    }
    let key = match error {
        StructureError::CutOffBelowFirstMode { .. } => "reduction.cut_off_hz",
        StructureError::LumpedIsNotReduced
        | StructureError::NotHeld { .. }
        | StructureError::NoInterface
        | StructureError::TooManyCoordinates { .. } => "reduction.method",
        StructureError::NoLabels { .. } => "structure.kind",
        StructureError::DampingRatioCount { .. } => "damping.modal_ratio",
        StructureError::MovedTwice { .. } => "excitation.support",
        _ => "structure",
    };
    let help = match error {
        StructureError::CutOffBelowFirstMode { first_hz, .. } => {
            let first = readable(*first_hz, "Hz");
            vec![format!("allowed: more than {first}, so that one elastic mode is kept at least")]
        }
        StructureError::DampingRatioCount { modes, .. } => {
            vec![format!("allowed: one ratio for all modes, or a list of {modes}")]
        }
        _ => Vec::new(),
    };
    file.fault(key, error.to_string(), help)
}

/// The key of a structure of matrices that is to blame, and what is allowed there.
fn matrix_fault(matrices: &MatricesTable, error: &StructureError) -> Option<(String, Vec<String>)> {
    let rows_of = |part| {
        let files = Vec::from_iter(matrices.label_files(part));
        (!files.is_empty()).then(|| format!("what rows are is said by {}", files.join(", ")))
    };
    let none = Vec::new;
    Some(match error {
        StructureError::NoSuchRow { part, .. } => (matrices.key_of(part, false), none()),
        StructureError::NoSuchNodes { part: MatrixPart::Lines, .. } => ("structure.lines".into(), none()),
        StructureError::NoSuchNodes { part, .. } => {
            (matrices.key_of(part, true), rows_of(part).into_iter().collect())
        }
        StructureError::NoSuchLabel { part, .. }
        | StructureError::LabelTwice { part, .. }
        | StructureError::JoinedTwice { part, .. } => {
            (matrices.key_of(part, false), rows_of(part).into_iter().collect())
        }
        StructureError::NoLabels { part: Some(part) } => (matrices.key_of(part, true), none()),
        StructureError::StiffnessNotPositive { .. }
        | StructureError::MasslessMechanism { .. }
        | StructureError::TooManyRigidModes { .. } => ("structure.stiffness".into(), none()),
        StructureError::RowCount { what: "mass", .. }
        | StructureError::NegativeDiagonal { matrix: "mass", .. }
        | StructureError::MassNegative { .. }
        | StructureError::NoMass => ("structure.mass".into(), none()),
        StructureError::RowCount { what: "damping", .. }
        | StructureError::NegativeDiagonal { matrix: "damping", .. } => ("structure.damping".into(), none()),
        StructureError::TooManyModes { .. } => ("reduction.cut_off_hz".into(), none()),
        StructureError::TooMuchMemory { need, .. } => {
            let enough = (need.total() as f64 / 1e8).ceil() / 10.0;
            (
                "structure.memory_gb".into(),
                vec![format!("allowed: `memory_gb = {enough:?}`, if there is so much")],
            )
        }
        _ => return None,
    })
}

/// The fault of a system at the key that is to blame.
pub(super) fn system_fault(file: &StudyFile, error: &SystemError) -> StudyError {
    let key = match error {
        SystemError::NoMovingSupport => "excitation.at",
        _ => "structure",
    };
    file.fault(key, error.to_string(), Vec::new())
}
