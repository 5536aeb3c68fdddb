//! Why something is not drawn.

use hammerbeam_attractor::AttractorError;
use hammerbeam_figure::FigureError;
use hammerbeam_jobs::JobError;
use hammerbeam_motion::exact::MotionError;
use hammerbeam_results::{StoreError, whole_file::WriteError};
use hammerbeam_signal::SignalError;

/// Why something is not drawn.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum DrawingError {
    /// The results cannot be read.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// What is drawn cannot be computed from the results.
    #[error(transparent)]
    Job(#[from] JobError),
    /// An orbit cannot be gone over.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// Accelerations cannot be filtered.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// A figure cannot be made into a file of its format.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// Results that do not belong into one diagram.
    #[error("the response diagrams of {folder} cannot be laid over these: {difference}")]
    NotAlike { folder: String, difference: String },
    /// A part of a diagram that would not be drawn again.
    #[error("the detail {detail} cannot be drawn: {reason}")]
    Detail { detail: String, reason: String },
    /// The observer said stop.
    #[error(
        "interrupted while drawing; {written} files are drawn anew in {folder}, the others are as they were"
    )]
    Interrupted { written: u64, folder: String },
}

impl From<AttractorError> for DrawingError {
    fn from(error: AttractorError) -> Self {
        Self::Job(error.into())
    }
}

impl DrawingError {
    /// Whether stored solutions are missing or cannot be read: what does not need them can be drawn.
    #[must_use]
    pub fn is_of_solutions(&self) -> bool {
        match self {
            Self::Store(error) | Self::Job(JobError::Store(error)) => error.is_of_solutions(),
            _ => false,
        }
    }
}
