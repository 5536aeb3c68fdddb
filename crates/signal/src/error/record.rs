//! Why the content of a file is not a usable record.

use crate::{
    limits::{LARGEST_SAMPLE, MAX_SAMPLES, SMALLEST_SAMPLE},
    text::time_difference,
};

/// Why the content of a file is not a usable record.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum RecordError {
    /// Nothing in the file is a series.
    #[error("there is no channel with samples in it")]
    Empty,
    /// The requested channel does not exist.
    #[error("there is no channel \"{name}\"; there are: {names}")]
    NoSuchChannel { name: String, names: String },
    /// Neither the file nor the user gives the sampling rate.
    #[error("the file does not say the sampling rate")]
    NoSamplingRate,
    /// An invalid step or rate.
    #[error("the step between samples is {step_s:e} s, allowed: 1e-60 to 1e60 s")]
    Step { step_s: f64 },
    /// A time that is too large to be counted with.
    #[error("a time is {time_s:e} s, allowed: -1e60 to 1e60 s")]
    TooFar { time_s: f64 },
    /// Channels were sampled at different times.
    #[error("the channels were not sampled together: {groups}")]
    DifferentSampling { groups: String },
    /// Channels do not have the same length.
    #[error("channels have unequal lengths: {lengths}")]
    UnequalLengths { lengths: String },
    /// Samples that are not numbers.
    #[error("channel \"{channel}\" misses {count} of {of} samples, the first is sample {first}")]
    Missing { channel: String, count: usize, of: usize, first: usize },
    /// Samples whose squares overflow or underflow.
    #[error(
        "the largest sample of channel \"{channel}\" is {found:e} in magnitude, must be 0 or from \
         {SMALLEST_SAMPLE:e} to {LARGEST_SAMPLE:e}"
    )]
    Magnitude { channel: String, found: f64 },
    /// Gaps that are too long to fill.
    #[error("filled up the record would have {samples:e} samples, at most {MAX_SAMPLES} are worked with")]
    TooLong { samples: f64 },
    /// Times that are not numbers.
    #[error("{count} times are missing, the first is that of sample {first}")]
    TimeMissing { count: usize, first: usize },
    /// Time decreases.
    #[error("time runs back {count} times, first at sample {first} ({time_s} s)")]
    TimeDecreases { count: usize, first: usize, time_s: f64 },
    /// The same time twice.
    #[error("{count} samples have the time of the one before, first sample {first} ({time_s} s)")]
    DuplicateTimes { count: usize, first: usize, time_s: f64 },
    /// Samples are missing between two times.
    #[error(
        "there are {count} gaps, the first after {time_s} s, the longest {} s at a step of {} s",
        time_difference(*longest_s),
        time_difference(*step_s)
    )]
    Gaps { count: usize, time_s: f64, longest_s: f64, step_s: f64 },
    /// The step changes.
    #[error(
        "sampling is uneven: times stray by up to {percent:.0} % of a step of {} s",
        time_difference(*step_s)
    )]
    Uneven { percent: f64, step_s: f64 },
}
