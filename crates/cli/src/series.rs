//! A series of frequencies, as its options have it.

use hammerbeam_jobs::JobError;

use crate::failure::Failure;

/// Ends that are the wrong way round, by the names of their options; any other failure is given back.
///
/// * `first`: the option of the first frequency.
pub fn falling(error: JobError, first: &str) -> Result<Failure, JobError> {
    match error {
        JobError::FallingFrequencies { from_hz, to_hz } => {
            Ok(Failure::BadInput(format!("--to is {to_hz} Hz, which is below {first}, {from_hz} Hz")))
        }
        other => Err(other),
    }
}
