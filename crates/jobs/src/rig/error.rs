//! Why a rig cannot be measured.

use hammerbeam_attractor::AttractorError;
use hammerbeam_motion::exact::MotionError;
use hammerbeam_results::StoreError;
use hammerbeam_signal::SignalError;
use hammerbeam_study::file::StudyError;

use crate::comparison::{
    ObservationError, OverlayError,
    history::{HistoryError, NoneSampled},
};

/// Why a rig cannot be measured.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RigError {
    /// The study has no table `[rig]`.
    #[error("{name} has no table [rig]: there is nothing to measure")]
    #[expect(missing_docs, reason = "the message names its fields")]
    NoRig { name: String },
    /// The changes do not make a study.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// The changes cannot be put together with the study.
    #[error("the changes of [rig.changes] cannot be put into the study: {message}")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Changes { message: String },
    /// A motion cannot be followed.
    #[error(transparent)]
    Attractor(#[from] AttractorError),
    /// A motion cannot be computed.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// A record refuses.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// An orbit cannot be gone over.
    #[error(transparent)]
    MotionHistory(#[from] HistoryError),
    /// No orbit of the branches can be gone over.
    #[error(transparent)]
    NoneSampled(#[from] NoneSampled),
    /// Curves of branches.
    #[error(transparent)]
    Observation(#[from] ObservationError),
    /// Signals cannot be laid over one another.
    #[error(transparent)]
    Overlay(OverlayError),
    /// The store refuses.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// Stopped from outside.
    #[error("interrupted")]
    Interrupted,
    /// Stopped from outside while the branches were computed.
    #[error("interrupted; the branches computed so far are kept, the same command goes on")]
    BranchesInterrupted,
    /// The study has no branch.
    #[error("no branch was found to compare with")]
    NothingToCompare,
}

impl RigError {
    /// Whether a motion could not be computed, so that another one may be.
    pub(crate) const fn is_of_the_motion(&self) -> bool {
        matches!(
            self,
            Self::Motion(_)
                | Self::Attractor(AttractorError::Motion(_))
                | Self::MotionHistory(
                    HistoryError::Motion(_) | HistoryError::Attractor(AttractorError::Motion(_))
                )
        )
    }
}

impl From<OverlayError> for RigError {
    fn from(error: OverlayError) -> Self {
        match error {
            OverlayError::Interrupted => Self::Interrupted,
            OverlayError::Store(error) => Self::Store(error),
            other => Self::Overlay(other),
        }
    }
}
