//! The state at which a motion begins, as `--initial` has it.

use hammerbeam_jobs::{InitialState, InitialStateError, InitialWordsError, JobError, counted};

use crate::failure::Failure;

/// What `--initial` means.
///
/// * `size`: entries of a modal state.
pub fn meant(text: &str, size: usize) -> Result<InitialState, Failure> {
    InitialState::parse(text, size).map_err(|error| Failure::BadInput(format!("--initial: {error}")))
}

/// Why a motion cannot begin there, or another failure of its job.
pub fn refused(text: &str, size: usize, error: JobError) -> Result<Failure, JobError> {
    let error = match error {
        JobError::Initial(error) => error,
        other => return Err(other),
    };
    Ok(Failure::BadInput(match &error {
        InitialStateError::NotInFront { frequency_hz, source } => {
            let place = frequency_hz.map_or_else(String::new, |hertz| format!(", at {hertz} Hz"));
            format!("--initial {text}{place}: {source}")
        }
        InitialStateError::Length { found, .. } => {
            let error =
                InitialWordsError::not_numbers(&format!("found {}", counted(*found as u64, "number")), size);
            return Ok(Failure::BadInput(format!("--initial: {error}")));
        }
        InitialStateError::NoResults => "--initial branch:N needs --results DIR".to_owned(),
        InitialStateError::NoSuchBranch { last } => {
            let branch = text.strip_prefix("branch:").unwrap_or(text);
            let allowed = last.map_or_else(
                || "the folder of --results has no branches".to_owned(),
                |last| format!("allowed: 1 to {last}"),
            );
            format!("--initial: there is no branch {branch:?}; {allowed}")
        }
        InitialStateError::Points(error) => format!("--initial: {error}"),
        other => return Ok(Failure::NoResult(other.to_string())),
    }))
}
