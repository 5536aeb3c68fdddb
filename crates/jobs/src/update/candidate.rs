//! The study with other numbers, built.

use hammerbeam_study::{Model, StudyError, StudyFile, changed::model_with, number::Number};

use crate::{comparison::history::HistoryError, counted};

/// Why a model with some values of the parameters does not exist.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum CandidateError {
    /// A value is out of the range of the study file, or does not fit the structure.
    #[error("{0}")]
    Study(#[from] StudyError),
    /// A mode is no longer in its table.
    #[error("mode {mode} was measured, but this table of the model has {}", counted(*modes as u64, "mode"))]
    NoMode { mode: usize, modes: usize, place: String },
    /// No stable orbit was found where one was measured.
    #[error(
        "the model has no stable periodic response of {} at {frequency_hz} Hz that simulation finds",
        counted((*period_multiple).into(), "excitation period")
    )]
    NoResponse { frequency_hz: f64, period_multiple: u32 },
    /// An orbit could not be followed to these parameters.
    #[error("the response at {frequency_hz} Hz is lost on the way")]
    ResponseLost { frequency_hz: f64 },
    /// An orbit cannot be gone over.
    #[error("the velocity of the response at {frequency_hz} Hz cannot be computed: {source}")]
    MotionHistory { frequency_hz: f64, source: HistoryError },
    /// Its motion cannot be computed.
    #[error("the response at {frequency_hz} Hz cannot be computed: {source}")]
    Orbit { frequency_hz: f64, source: hammerbeam_orbit::OrbitError },
}

/// The study with these values of these numbers.
///
/// # Errors
/// [`CandidateError::Study`].
pub(super) fn candidate(
    study: &StudyFile,
    numbers: &[Number],
    values: &[f64],
) -> Result<StudyFile, CandidateError> {
    Ok(model_with(study, numbers, values)?)
}

/// Builds the study with these values of these numbers.
///
/// # Errors
/// [`CandidateError::Study`].
pub(super) fn built(study: &StudyFile, numbers: &[Number], values: &[f64]) -> Result<Model, CandidateError> {
    Ok(Model::build(&candidate(study, numbers, values)?)?)
}
