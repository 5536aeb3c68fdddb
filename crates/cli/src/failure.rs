//! Why a command does not end well, and with which exit code.

use std::process::ExitCode;

use hammerbeam_attractor::AttractorError;
use hammerbeam_drawing::DrawingError;
use hammerbeam_jobs::{
    JobError,
    comparison::{ComparisonError, MeasuredError, ObservationError, OverlayError},
    rig::RigError,
    run::RunError,
};
use hammerbeam_results::{StoreError, export::ExportError, whole_file::WriteError};
use hammerbeam_signal::SignalError;
use hammerbeam_study::{FaultReport, StudyError};

/// Why a command does not end well.
#[derive(Debug)]
pub enum Failure {
    /// A study file with faults.
    Study(FaultReport),
    /// Anything else the user gave that is not right.
    BadInput(String),
    /// There is nothing to give.
    NoResult(String),
    /// Stored results are not what they are recomputed to; the result was given all the same.
    Disagreement(String),
    /// The user stopped it.
    Interrupted(String),
    /// The user stopped it; what was found by then was given all the same.
    InterruptedWithResult(String),
    /// The machine refuses.
    Other(anyhow::Error),
}

impl Failure {
    /// With what is kept all the same, if it is not the user's mistake.
    pub fn and(self, kept: &str) -> Self {
        match self {
            Self::NoResult(message) => Self::NoResult(format!("{message}; {kept}")),
            Self::Other(error) => Self::Other(anyhow::anyhow!("{error:#}; {kept}")),
            other => other,
        }
    }

    /// Exit code, as a number.
    pub fn code(&self) -> u8 {
        match self {
            Self::NoResult(_) | Self::Other(_) => 1,
            Self::Study(_) | Self::BadInput(_) => 2,
            Self::Disagreement(_) => 3,
            Self::Interrupted(_) | Self::InterruptedWithResult(_) => 130,
        }
    }

    /// Exit code of the process.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(self.code())
    }

    /// Whether the result was given before it: that is the one document in JSON.
    pub fn has_result(&self) -> bool {
        matches!(self, Self::Disagreement(_) | Self::InterruptedWithResult(_))
    }

    /// What to report, without colours.
    pub fn message(&self) -> String {
        match self {
            Self::Study(report) => report.to_string(),
            Self::BadInput(message)
            | Self::NoResult(message)
            | Self::Disagreement(message)
            | Self::Interrupted(message)
            | Self::InterruptedWithResult(message) => message.clone(),
            Self::Other(error) => format!("{error:#}"),
        }
    }
}

impl From<JobError> for Failure {
    fn from(error: JobError) -> Self {
        match error {
            JobError::Study(error) => error.into(),
            JobError::Store(error) => error.into(),
            JobError::Export(error) => error.into(),
            JobError::Write(error) => error.into(),
            JobError::Run(error) => error.into(),
            JobError::Motion(error) => error.into(),
            JobError::Comparison(error) => error.into(),
            JobError::Observation(error) => error.into(),
            JobError::Overlay(error) => error.into(),
            JobError::Rig(error) => error.into(),
            JobError::Signal(error) => error.into(),
            JobError::Stopped { source, .. } => (*source).into(),
            JobError::Interrupted { .. } | JobError::TablesInterrupted => {
                Self::Interrupted(error.to_string())
            }
            JobError::NoSearch { .. } | JobError::NoBranches { .. } => Self::NoResult(error.to_string()),
            JobError::Measured(error) => error.into(),
            _ => Self::BadInput(error.to_string()),
        }
    }
}

impl From<DrawingError> for Failure {
    fn from(error: DrawingError) -> Self {
        match error {
            DrawingError::Store(error) => error.into(),
            DrawingError::Job(error) => error.into(),
            DrawingError::Signal(error) => error.into(),
            DrawingError::Write(error) => error.into(),
            DrawingError::Motion(error) => Self::NoResult(error.to_string()),
            DrawingError::NotAlike { .. } | DrawingError::Detail { .. } => Self::BadInput(error.to_string()),
            DrawingError::Interrupted { .. } => Self::Interrupted(error.to_string()),
            other => Self::Other(other.into()),
        }
    }
}

impl From<AttractorError> for Failure {
    fn from(error: AttractorError) -> Self {
        match error {
            AttractorError::Input { .. }
            | AttractorError::StateLength { .. }
            | AttractorError::BehindRigidStop { .. }
            | AttractorError::WithinContact { .. } => Self::BadInput(error.to_string()),
            other => Self::NoResult(other.to_string()),
        }
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Invalid(report) => Self::Study(report),
            other => Self::BadInput(other.to_string()),
        }
    }
}

impl From<StoreError> for Failure {
    fn from(error: StoreError) -> Self {
        if error.is_bad_input() { Self::BadInput(error.to_string()) } else { Self::Other(error.into()) }
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Store(error) => error.into(),
            other => Self::Other(other.into()),
        }
    }
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        match error {
            ExportError::Store(error) => error.into(),
            ExportError::Write(error) => error.into(),
            // The user named the folder; the message has the cause already.
            other => Self::BadInput(other.to_string()),
        }
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        // The user named the folder, but neither fills the disk nor breaks it.
        if error.is_wrong_place() {
            Self::BadInput(error.to_string())
        } else {
            Self::NoResult(error.to_string())
        }
    }
}

impl From<ComparisonError> for Failure {
    fn from(error: ComparisonError) -> Self {
        match error {
            ComparisonError::TooFewPoints { .. } => Self::NoResult(error.to_string()),
            other => Self::BadInput(other.to_string()),
        }
    }
}

impl From<ObservationError> for Failure {
    fn from(error: ObservationError) -> Self {
        match error {
            ObservationError::Store(error) => error.into(),
            ObservationError::Signal(error) => error.into(),
            ObservationError::FilteredAway { .. } => Self::BadInput(error.to_string()),
            ObservationError::NoneSampled { .. } => Self::NoResult(error.to_string()),
            other => Self::Other(other.into()),
        }
    }
}

impl From<MeasuredError> for Failure {
    fn from(error: MeasuredError) -> Self {
        match error {
            MeasuredError::Table(error) => error.into(),
            MeasuredError::NoFrequency { .. } => Self::BadInput(format!("{error} with --reference")),
            other => Self::BadInput(other.to_string()),
        }
    }
}

impl From<OverlayError> for Failure {
    fn from(error: OverlayError) -> Self {
        match error {
            OverlayError::Store(error) => error.into(),
            OverlayError::Signal(error) => error.into(),
            OverlayError::NoSuchSensor { .. } | OverlayError::FilteredAway { .. } => {
                Self::BadInput(error.to_string())
            }
            OverlayError::NoneSampled { .. } => Self::NoResult(error.to_string()),
            OverlayError::Interrupted => Self::Interrupted("interrupted; nothing was written".to_owned()),
            other => Self::Other(other.into()),
        }
    }
}

impl From<RigError> for Failure {
    fn from(error: RigError) -> Self {
        match error {
            RigError::Study(error) => error.into(),
            RigError::Store(error) => error.into(),
            RigError::Observation(error) => error.into(),
            RigError::NoRig { .. } | RigError::Changes { .. } => Self::BadInput(error.to_string()),
            RigError::BranchesInterrupted => Self::Interrupted(error.to_string()),
            RigError::Interrupted => Self::Interrupted(
                "interrupted; the branches are kept, the measurement begins anew".to_owned(),
            ),
            other => Self::NoResult(other.to_string()),
        }
    }
}

impl From<SignalError> for Failure {
    fn from(error: SignalError) -> Self {
        if error.is_bad_input() {
            Self::BadInput(error.to_string())
        } else {
            Self::NoResult(error.to_string())
        }
    }
}

impl From<anyhow::Error> for Failure {
    fn from(error: anyhow::Error) -> Self {
        error.downcast::<WriteError>().map_or_else(Self::Other, Self::from)
    }
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;

    /// The exit code of a job's error is the one that its kind says, which the exceptions of Python follow.
    #[test]
    fn an_error_has_the_exit_code_of_its_kind() {
        let folder = PathBuf::from("results");
        let errors: [fn(PathBuf) -> JobError; 8] = [
            |folder| StoreError::NoResults { folder }.into(),
            |folder| StoreError::Locked { folder }.into(),
            |_| StoreError::OtherThanStored.into(),
            |results| JobError::NoBranches { results },
            |_| JobError::FallingFrequencies { from_hz: 2.0, to_hz: 1.0 },
            |_| JobError::NoSearch { message: String::new() },
            |_| JobError::NoSearch { message: String::new() }.stopped_after(3),
            |_| JobError::Interrupted { done: 3, part_s: None },
        ];
        for error in errors {
            let kind = error(folder.clone()).kind();
            assert_eq!(
                Failure::from(error(folder.clone())).code(),
                kind.exit_code(),
                "{:?}",
                error(folder.clone())
            );
        }
    }
}
