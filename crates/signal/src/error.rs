//! Why a series cannot be read, taken as a record, or evaluated.

use std::path::PathBuf;

use crate::{judge::RecordError, points::PointsError, read::ReadError};

/// Why there is nothing to give.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum SignalError {
    /// The machine does not give the file.
    #[error("cannot read {path}: {source}")]
    File { path: PathBuf, source: std::io::Error },
    /// The file is not what it should be.
    #[error("{path}: {source}")]
    Read { path: PathBuf, source: ReadError },
    /// The file is no table of measured points.
    #[error("{path}: {source}")]
    Points { path: PathBuf, source: PointsError },
    /// What is in the file is no usable record.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A number that was asked for makes no sense.
    #[error("{what} is {found}, must be {allowed}")]
    Input { what: &'static str, found: f64, allowed: String },
    /// A stretch of time with nothing in it.
    #[error(
        "there are fewer than two samples between {from_s} s and {to_s} s; the record runs from {start_s} s to {end_s} s"
    )]
    EmptyPart { from_s: f64, to_s: f64, start_s: f64, end_s: f64 },
    /// Too few samples for what was asked.
    #[error("{what} needs at least {needed} samples, there are {found}")]
    TooShort { what: &'static str, found: usize, needed: usize },
    /// A record without any motion.
    #[error("the signal is constant")]
    Constant,
    /// The series holds a number that is not finite.
    #[error("sample {index} is not a finite number")]
    NotFinite { index: usize },
    /// No decaying oscillation was found.
    #[error("no decaying oscillation stands out of the noise")]
    NoDecay,
    /// The fit of the decay did not come to an end.
    #[error("the fit of {modes} mode(s) did not converge in {iterations} iterations")]
    FitNotConverged { modes: usize, iterations: usize },
    /// Distances do not grow in a way that has a rate.
    #[error("the mean logarithmic distance has no straight part: {reason}")]
    NoScaling { reason: &'static str },
    /// A periodic motion, where an exponent was asked for.
    #[error(
        "the record repeats itself after {samples} samples, to {percent} % of its standard deviation: the motion is periodic, and no distance in it grows"
    )]
    Repeats { samples: usize, percent: f64 },
    /// Neighbours are too rare.
    #[error(
        "only {found} of {asked} states have a neighbour within reach: the record is too short or the dimension too high"
    )]
    TooFewNeighbours { found: usize, asked: usize },
    /// The reference channel has no frequency.
    #[error("the reference channel has no clear line: the largest holds {percent:.1} % of its power")]
    NoReferenceLine { percent: f64 },
    /// The sensor measures what is not in the record.
    #[error("the record has no {wanted}: its channels are {found}")]
    NoSuchQuantity { wanted: &'static str, found: String },
}

/// Refuses a number.
pub(crate) fn ensure(
    what: &'static str,
    found: f64,
    allowed: impl Into<String>,
    holds: bool,
) -> Result<(), SignalError> {
    if holds { Ok(()) } else { Err(SignalError::Input { what, found, allowed: allowed.into() }) }
}

/// Refuses a series that is too short or holds what is not finite.
pub(crate) fn ensure_series(what: &'static str, series: &[f64], needed: usize) -> Result<(), SignalError> {
    if series.len() < needed {
        return Err(SignalError::TooShort { what, found: series.len(), needed });
    }
    match series.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(SignalError::NotFinite { index }),
        None => Ok(()),
    }
}

impl SignalError {
    /// Whether the input is at fault, not that there is nothing to find in it.
    #[must_use]
    pub const fn is_bad_input(&self) -> bool {
        !matches!(
            self,
            Self::NoDecay
                | Self::FitNotConverged { .. }
                | Self::NoScaling { .. }
                | Self::Repeats { .. }
                | Self::TooFewNeighbours { .. }
        )
    }
}
