//! A virtual rig: a "measurement" made with another model than the one it is held against.
//!
//! The rig is a study of its own, made of a study by the changes of its table `[rig.changes]`: another
//! stiffness, a contact that loses energy, a shaker that does not keep its amplitude. Its motion is swept up
//! and down in steps; at each frequency it settles, is recorded through a measuring chain, and the record is
//! classified as a measured one would be. What the rig knows of itself (the state once in each period,
//! without noise) is kept beside it, to tell how often that is right.
//!
//! | file | what |
//! |---|---|
//! | `build.rs` | the study of the rig |
//! | `sweep.rs` | stepped sweeps; a record at each frequency, and its point |
//! | `chaos.rs` | largest exponents of aperiodic motions, from record and motion |
//! | `decay.rs` | a free decay of the structure without its stops: eigenfrequencies and damping as they are measured |
//! | `modes.rs` | which modes these are |
//! | `filter.rs` | what low-pass filters leave of the maxima along the branches |
//! | `signals.rs` | measured and computed signals laid over one another |
//! | `whole.rs` | all of it |
//! | `tables.rs`, `document.rs`, `signal_document.rs` | its tables and its document |
//!
//! Everything follows from the study and the seed: noise has a seed for each frequency and direction, and
//! threads take whole sweeps, signals or solutions.

mod build;
mod chaos;
mod decay;
mod document;
mod filter;
mod modes;
mod signal_document;
mod signals;
mod sweep;
mod tables;
mod whole;

use hammerbeam_attractor::AttractorError;
use hammerbeam_motion::exact::MotionError;
use hammerbeam_results::StoreError;
use hammerbeam_signal::SignalError;
use hammerbeam_study::file::StudyError;

pub use build::changed_study;
pub use chaos::MotionExponents;
pub use filter::{
    Filtered, FilteredBranch, FilteredPoint, FilteredRatio, acceleration_curves, filtered_branches,
};
pub use modes::{MeasuredMode, RigMode, rig_modes};
pub use signal_document::signal_document;
pub use signals::{SignalPair, compare_signal};
pub use sweep::{Direction, RigPoint, sweep};
pub use tables::{RigChaos, figure_name, write_rig_tables};
pub use whole::{RigReport, measure_rig};

use crate::comparison::{
    ObservationError, OverlayError,
    course::{CourseError, NoneSampled},
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
    Course(#[from] CourseError),
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
                | Self::Course(CourseError::Motion(_) | CourseError::Attractor(AttractorError::Motion(_)))
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
