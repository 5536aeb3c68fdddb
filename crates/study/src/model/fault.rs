//! Faults of a structure or a system, at the keys of the study that are to blame.

use hammerbeam_motion::SystemError;
use hammerbeam_structure::StructureError;

use super::structure::{self, ReduceError};
use crate::{
    document::{FaultReport, unit::readable},
    file::{StudyError, StudyFile},
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
                | StructureError::StiffnessNotPositive { .. },
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
        ReduceError::Files(problem) => {
            file.fault(&format!("structure.{}", problem.key), problem.message.clone(), Vec::new())
        }
    }
}

/// The fault of a structure at the key that is to blame.
fn structure_fault(file: &StudyFile, error: &StructureError) -> StudyError {
    let key = match error {
        StructureError::CutOffBelowFirstMode { .. } => "reduction.cut_off_hz",
        StructureError::LumpedIsNotReduced
        | StructureError::NotHeld { .. }
        | StructureError::NoInterface
        | StructureError::TooManyCoordinates { .. } => "reduction.method",
        StructureError::StiffnessNotPositive { .. } => "structure.stiffness",
        StructureError::RowCount { what: "mass", .. } => "structure.mass",
        StructureError::RowCount { what: "damping", .. } => "structure.damping",
        StructureError::NoLabels => "structure.kind",
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

/// The fault of a system at the key that is to blame.
pub(super) fn system_fault(file: &StudyFile, error: &SystemError) -> StudyError {
    let key = match error {
        SystemError::NoMovingSupport => "excitation.at",
        _ => "structure",
    };
    file.fault(key, error.to_string(), Vec::new())
}
