//! Why a series cannot be read, accepted as a record, or evaluated.
//!
//! | file | errors of |
//! |---|---|
//! | `read.rs` | reading a file of measurements |
//! | `record.rs` | validating its content as a record |
//! | `points.rs` | reading a table of measured points |

mod points;
mod read;
mod record;

use std::path::PathBuf;

pub use points::PointsError;
pub use read::ReadError;
pub use record::RecordError;

use crate::limits::MAX_SAMPLES;

/// Why there is no result.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum SignalError {
    /// The operating system cannot give the file.
    #[error("cannot read {path}: {source}")]
    File { path: PathBuf, source: std::io::Error },
    /// The content does not match its format.
    #[error("{path}: {source}")]
    Read { path: PathBuf, source: ReadError },
    /// The file is not a table of measured points.
    #[error("{path}: {source}")]
    Points { path: PathBuf, source: PointsError },
    /// The content of the file is not a usable record.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A value given by the user is outside its range.
    #[error("{what} is {found}, must be {allowed}")]
    Input { what: &'static str, found: f64, allowed: String },
    /// A time interval without samples.
    #[error(
        "there are fewer than two samples between {from_s} s and {to_s} s; the record runs from {start_s} s \
         to {end_s} s"
    )]
    EmptyPart { from_s: f64, to_s: f64, start_s: f64, end_s: f64 },
    /// Too few samples for the evaluation.
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
    /// The fit of the decay did not converge.
    #[error("the fit did not converge in {iterations} iterations (number of modes: {modes})")]
    FitNotConverged { modes: usize, iterations: usize },
    /// Distances do not grow exponentially anywhere.
    #[error("the mean logarithmic distance has no straight part: {reason}")]
    NoScaling { reason: &'static str },
    /// A periodic motion, of which an exponent was requested.
    #[error(
        "the record repeats itself after {samples} samples, to {percent} % of its standard deviation: the \
         motion is periodic, and no distance in it grows"
    )]
    Repeats { samples: usize, percent: f64 },
    /// Too few states have neighbours.
    #[error(
        "only {found} of {asked} states have a neighbour within reach: the record is too short or the \
         dimension too high"
    )]
    TooFewNeighbours { found: usize, asked: usize },
    /// The reference channel has no dominant frequency.
    #[error("the reference channel has no clear line: the largest holds {percent:.1} % of its power")]
    NoReferenceLine { percent: f64 },
    /// The sensor measures a quantity that is not in the record.
    #[error("the record has no {wanted}: its channels are {found}")]
    NoSuchQuantity { wanted: &'static str, found: String },
}

/// Checks a value given by the user.
pub(crate) fn ensure(
    what: &'static str,
    found: f64,
    allowed: impl Into<String>,
    holds: bool,
) -> Result<(), SignalError> {
    if holds { Ok(()) } else { Err(SignalError::Input { what, found, allowed: allowed.into() }) }
}

/// Checks that a series is long enough and finite.
pub(crate) fn ensure_series(what: &'static str, series: &[f64], needed: usize) -> Result<(), SignalError> {
    if series.len() < needed {
        return Err(SignalError::TooShort { what, found: series.len(), needed });
    }
    match series.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(SignalError::NotFinite { index }),
        None => Ok(()),
    }
}

/// Checks the length of a resampled record.
pub(crate) fn ensure_sample_count(samples: f64) -> Result<(), SignalError> {
    let allowed = format!("at most {MAX_SAMPLES}");
    ensure("the number of samples at the new rate", samples, allowed, samples <= MAX_SAMPLES as f64)
}

impl SignalError {
    /// Whether the input is invalid, as opposed to valid input without the result that was requested.
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
