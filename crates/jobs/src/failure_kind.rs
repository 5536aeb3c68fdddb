//! Whose fault it is that a job has no result: what the exit codes of the command and the classes of
//! exceptions in Python follow.

use hammerbeam_attractor::AttractorError;
use hammerbeam_results::{StoreError, export::ExportError, whole_file::WriteError};

use crate::{
    InitialStateError, JobError,
    comparison::{ComparisonError, MeasuredError, ObservationError, OverlayError},
    rig::RigError,
    run::RunError,
};

/// Whose fault it is that a job has no result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FailureKind {
    /// What was given is not right: exit code 2.
    BadInput,
    /// There is nothing to give, or the machine refuses: exit code 1.
    NoResult,
    /// The observer said stop: exit code 130.
    Interrupted,
}

impl FailureKind {
    /// Exit code of the command.
    #[must_use]
    pub fn exit_code(self) -> u8 {
        match self {
            Self::NoResult => 1,
            Self::BadInput => 2,
            Self::Interrupted => 130,
        }
    }

    fn bad_input_if(is_bad: bool) -> Self {
        if is_bad { Self::BadInput } else { Self::NoResult }
    }
}

impl JobError {
    /// Whose fault it is.
    #[must_use]
    pub fn kind(&self) -> FailureKind {
        match self {
            Self::Store(error) | Self::Run(RunError::Store(error)) => of_store(error),
            Self::Export(error) => of_export(error),
            Self::Write(error) => of_write(error),
            Self::Run(_) | Self::NoSearch { .. } | Self::NoBranches { .. } => FailureKind::NoResult,
            Self::Motion(error) => of_motion(error),
            Self::Initial(InitialStateError::NoCrossing { .. } | InitialStateError::Orbit(_)) => {
                FailureKind::NoResult
            }
            Self::Comparison(error) => {
                FailureKind::bad_input_if(!matches!(error, ComparisonError::TooFewPoints { .. }))
            }
            Self::Measured(MeasuredError::Table(error)) | Self::Signal(error) => {
                FailureKind::bad_input_if(error.is_bad_input())
            }
            Self::Observation(error) => of_observation(error),
            Self::Overlay(error) => of_overlay(error),
            Self::Rig(error) => of_rig(error),
            Self::Stopped { source, .. } => source.kind(),
            Self::Interrupted { .. } | Self::TablesInterrupted => FailureKind::Interrupted,
            _ => FailureKind::BadInput,
        }
    }
}

fn of_store(error: &StoreError) -> FailureKind {
    FailureKind::bad_input_if(error.is_bad_input())
}

fn of_write(error: &WriteError) -> FailureKind {
    FailureKind::bad_input_if(error.is_wrong_place())
}

fn of_export(error: &ExportError) -> FailureKind {
    match error {
        ExportError::Store(error) => of_store(error),
        ExportError::Write(error) => of_write(error),
        _ => FailureKind::BadInput,
    }
}

fn of_motion(error: &AttractorError) -> FailureKind {
    FailureKind::bad_input_if(matches!(
        error,
        AttractorError::Input { .. }
            | AttractorError::StateLength { .. }
            | AttractorError::BehindRigidStop { .. }
            | AttractorError::WithinContact { .. }
    ))
}

fn of_observation(error: &ObservationError) -> FailureKind {
    match error {
        ObservationError::Store(error) => of_store(error),
        ObservationError::Signal(error) => FailureKind::bad_input_if(error.is_bad_input()),
        other => FailureKind::bad_input_if(matches!(other, ObservationError::FilteredAway { .. })),
    }
}

fn of_overlay(error: &OverlayError) -> FailureKind {
    match error {
        OverlayError::Store(error) => of_store(error),
        OverlayError::Signal(error) => FailureKind::bad_input_if(error.is_bad_input()),
        OverlayError::Interrupted => FailureKind::Interrupted,
        other => FailureKind::bad_input_if(matches!(
            other,
            OverlayError::NoSuchSensor { .. } | OverlayError::FilteredAway { .. }
        )),
    }
}

fn of_rig(error: &RigError) -> FailureKind {
    match error {
        RigError::Study(_) | RigError::NoRig { .. } | RigError::Changes { .. } => FailureKind::BadInput,
        RigError::Store(error) => of_store(error),
        RigError::Observation(error) => of_observation(error),
        RigError::BranchesInterrupted | RigError::Interrupted => FailureKind::Interrupted,
        _ => FailureKind::NoResult,
    }
}
