//! Why a job has no result.

use std::path::PathBuf;

use hammerbeam_attractor::AttractorError;
use hammerbeam_results::{StoreError, export::ExportError, whole_file::WriteError};
use hammerbeam_signal::SignalError;
use hammerbeam_study::{Drift, StudyError, readable};

use crate::{
    comparison::{ComparisonError, MeasuredError, ObservationError, OverlayError},
    grid_coordinate::CoordinateError,
    initial_error::InitialStateError,
    rig::RigError,
    run::RunError,
    simulate::SimulationTooLarge,
};

/// Why a job has no result.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum JobError {
    /// The study has faults.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// The results folder cannot be used.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A table cannot be written.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A run cannot go on.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A motion cannot be computed, or what is asked of it makes no sense.
    #[error(transparent)]
    Motion(#[from] AttractorError),
    /// A state at which a motion cannot begin.
    #[error(transparent)]
    Initial(#[from] InitialStateError),
    /// A series of frequencies whose last one is below its first.
    #[error("the last frequency is {to_hz} Hz, which is below the first, {from_hz} Hz")]
    FallingFrequencies { from_hz: f64, to_hz: f64 },
    /// A coordinate that a state does not have.
    #[error(transparent)]
    Coordinate(#[from] CoordinateError),
    /// A motion that takes too much of memory or of the disk.
    #[error(transparent)]
    TooLarge(#[from] SimulationTooLarge),
    /// Motions of orbits that take too much of memory, `most_samples` 0 if there is no number that is small
    /// enough.
    #[error(
        "the motions of {orbits} orbits are {numbers} numbers, must be {most} at most; allowed: {}",
        fewer(*most_samples)
    )]
    MotionsTooLarge { orbits: usize, numbers: u64, most: u64, most_samples: u64 },
    /// Measured points cannot be compared.
    #[error(transparent)]
    Comparison(#[from] ComparisonError),
    /// An output that a results folder does not hold.
    #[error("the results hold no output \"{name}\"; {}", known_outputs(known))]
    NoOutput { name: String, known: Vec<String> },
    /// A special point that a results folder does not have.
    #[error("{} has no special point {number}: it has {count}, numbered from 1", results.display())]
    NoSpecialPoint { results: PathBuf, number: u32, count: u32 },
    /// A special point that no orbit of its branch near by is in the range of the study to begin at.
    #[error(
        "special point {number} of {} lies at {}, outside the range of this study, {} to {}",
        results.display(), readable(*at_hz, "Hz"), readable(range_hz[0], "Hz"), readable(range_hz[1], "Hz")
    )]
    SpecialPointOutside { results: PathBuf, number: u32, at_hz: f64, range_hz: [f64; 2] },
    /// A sweep that cannot be cut into parts.
    #[error(
        "a sweep with the state carried over has no parts: each motion starts where the one before has \
         ended; allowed: motions from many states at every frequency, which depend on nothing else"
    )]
    SweepWithoutParts,
    /// There is nothing to compare with.
    #[error("{} holds no branch to compare with", results.display())]
    NoBranches { results: PathBuf },
    /// Measured points cannot be read.
    #[error(transparent)]
    Measured(#[from] MeasuredError),
    /// What was measured cannot be computed along branches.
    #[error(transparent)]
    Observation(#[from] ObservationError),
    /// A recorded motion cannot be laid over orbits.
    #[error(transparent)]
    Overlay(#[from] OverlayError),
    /// A rig cannot be measured.
    #[error(transparent)]
    Rig(#[from] RigError),
    /// A record cannot be read or used.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// Nothing holds the structure.
    #[error(
        "{0}: none of them is isolated, so none can be found or followed; allowed: a structure with a \
        spring or a stop that acts on this motion"
    )]
    Drifts(Drift),
    /// The range of the excitation reaches too high.
    #[error(
        "`frequency_hz` of the excitation reaches {high_hz:e} Hz, where a period is so short that rounding \
        hides what the structure does in it; allowed: up to {resolved_hz:.3e} Hz, ten million times the \
        highest eigenfrequency"
    )]
    FrequencyNotResolved { high_hz: f64, resolved_hz: f64 },
    /// No periodic solution could be looked for.
    #[error("{message}")]
    NoSearch { message: String },
    /// The work came to this point and is kept as far as it is stored, but then something refused.
    ///
    /// * `done`: pieces of the work that are done, of what the job counts.
    #[error("{source}")]
    Stopped { source: Box<JobError>, done: u64 },
    /// The observer said stop before the tables were written.
    #[error("interrupted before the tables were written; everything is kept")]
    TablesInterrupted,
    /// The observer said stop.
    ///
    /// * `done`: pieces of the work that are done.
    /// * `part_s`: time over which one more was averaged [s], which the tables have as well.
    #[error("interrupted")]
    Interrupted { done: u64, part_s: Option<f64> },
}

impl JobError {
    /// With the number of pieces that are done all the same.
    #[must_use]
    pub fn stopped_after(self, done: u64) -> Self {
        match self {
            stopped @ (Self::Stopped { .. } | Self::Interrupted { .. } | Self::TablesInterrupted) => stopped,
            // Nothing is left of what was done.
            gone @ Self::Store(StoreError::Gone { .. }) => gone,
            other => Self::Stopped { source: Box::new(other), done },
        }
    }
}

/// Which outputs there are, in words.
fn known_outputs(known: &[String]) -> String {
    match known {
        [] => "they have none: `hammerbeam run` computes those of [[output]]".to_owned(),
        _ => format!("they have {}", known.join(", ")),
    }
}

/// What takes less of memory than motions that are too large.
fn fewer(most_samples: u64) -> String {
    match most_samples {
        0 => "fewer orbits".to_owned(),
        _ => format!("fewer orbits, or at most {most_samples} samples in a period"),
    }
}
