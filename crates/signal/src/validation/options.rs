//! Options for the validation of a record.

use crate::finding::Repairs;

/// Information and permissions that the user adds to the content of a file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RecordOptions {
    /// Sampling rate [Hz]; the times in the file are then not used.
    pub sampling_rate_hz: Option<f64>,
    /// Permitted repairs.
    pub repairs: Repairs,
    /// Names or numbers (from 1, in the order of the file) of channels to keep; all if empty. The others are
    /// not validated.
    pub channels: Vec<String>,
}
