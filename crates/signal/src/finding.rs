//! What is suspicious in a record, and what was repaired with the permission of the user.

use crate::text::time_difference;

/// A finding about a record that does not make it unusable.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum RecordFinding {
    /// Successive samples are equal to the largest or smallest one, which a steep step leads to.
    #[error(
        "channel \"{channel}\" is clipped: {samples} samples in {places} places stand at {level:e} \
         (from sample {first} on)"
    )]
    Clipped { channel: String, samples: usize, places: usize, level: f64, first: usize },
    /// Aliasing: the sampling rate is too low for what passes the filter.
    #[error(
        "what is above half the sampling rate, {half_rate_hz} Hz, is folded down: {percent:.1} % of the \
         root mean square"
    )]
    Folded { half_rate_hz: f64, percent: f64 },
    /// All samples are the same.
    #[error("channel \"{channel}\" is constant")]
    Constant { channel: String },
    /// Times differ from an even grid, by so little that they are taken as even.
    #[error("sampling times stray by up to {percent:.2} % of a step; they are taken as even")]
    Jitter { percent: f64 },
    /// The sampling rate given by the user differs from that of the times in the file.
    #[error("the sampling rate given is {given_hz} Hz; by the times in the file it is {found_hz} Hz")]
    RateDisagrees { given_hz: f64, found_hz: f64 },
    /// The file names a sampling rate that contradicts its times.
    #[error(
        "the file names a sampling rate of {named_hz} Hz; by the times in it, which are taken, it is \
         {found_hz} Hz"
    )]
    NamedRateDisagrees { named_hz: f64, found_hz: f64 },
    /// There is no header; a column that rises evenly is taken for the time.
    #[error("column 1 has no title and rises evenly: it is taken for the time in seconds")]
    TimeAssumed,
    /// Rows without titles that have one comma each.
    #[error(
        "no title says whether commas separate columns or are decimal signs: they are taken to separate two \
         columns"
    )]
    CommasSeparate,
    /// The time column has no unit.
    #[error("the time column \"{name}\" names no unit: seconds are assumed")]
    TimeUnitAssumed { name: String },
    /// An unknown unit; values are not converted.
    #[error("channel \"{channel}\": the unit \"{unit}\" is not known, values are kept as they are")]
    UnknownUnit { channel: String, unit: String },
    /// A channel names its quantity, but not the unit.
    #[error("channel \"{channel}\" names no unit: {unit} is assumed")]
    UnitAssumed { channel: String, unit: String },
    /// Bytes that are not UTF-8 were read as Latin-1.
    #[error("the file is not UTF-8; it was read as Latin-1")]
    Latin1,
    /// Content of the file that is no time series and was left out.
    #[error("\"{name}\" was left out: {reason}")]
    LeftOut { name: String, reason: String },
    /// Repaired: missing samples were interpolated.
    #[error("channel \"{channel}\": {count} missing samples were interpolated, the first is sample {first}")]
    MissingInterpolated { channel: String, count: usize, first: usize },
    /// Repaired: gaps in time were filled.
    #[error("{count} gaps were filled by interpolation, the longest is {} s", time_difference(*longest_s))]
    GapsFilled { count: usize, longest_s: f64 },
    /// Repaired: samples with the time of another were dropped.
    #[error("{count} samples with a time that had been there were dropped")]
    DuplicatesDropped { count: usize },
    /// Repaired: samples were sorted by time.
    #[error("samples were sorted by time: it ran back {count} times")]
    Sorted { count: usize },
    /// Repaired: uneven samples were interpolated to an even grid.
    #[error("samples strayed by up to {percent:.1} % of a step and were interpolated to {rate_hz} Hz")]
    Evened { percent: f64, rate_hz: f64 },
    /// Repaired: channels were cut to the shortest.
    #[error("channels were cut to the shortest, {length} samples; the longest had {longest}")]
    Shortened { length: usize, longest: usize },
}

impl RecordFinding {
    /// Identifier of the kind of finding, for programs.
    #[must_use]
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Clipped { .. } => "clipped",
            Self::Folded { .. } => "folded",
            Self::Constant { .. } => "constant",
            Self::Jitter { .. } => "jitter",
            Self::RateDisagrees { .. } => "rate-disagrees",
            Self::NamedRateDisagrees { .. } => "named-rate-disagrees",
            Self::TimeAssumed => "time-assumed",
            Self::CommasSeparate => "commas-separate",
            Self::TimeUnitAssumed { .. } => "time-unit-assumed",
            Self::UnknownUnit { .. } => "unknown-unit",
            Self::UnitAssumed { .. } => "unit-assumed",
            Self::Latin1 => "latin-1",
            Self::LeftOut { .. } => "left-out",
            Self::MissingInterpolated { .. } => "missing-interpolated",
            Self::GapsFilled { .. } => "gaps-filled",
            Self::DuplicatesDropped { .. } => "duplicates-dropped",
            Self::Sorted { .. } => "sorted",
            Self::Evened { .. } => "evened",
            Self::Shortened { .. } => "shortened",
        }
    }

    /// The channel concerned, if it is a single one.
    #[must_use]
    pub fn channel(&self) -> Option<&str> {
        match self {
            Self::Clipped { channel, .. }
            | Self::Constant { channel }
            | Self::UnknownUnit { channel, .. }
            | Self::UnitAssumed { channel, .. }
            | Self::MissingInterpolated { channel, .. } => Some(channel),
            _ => None,
        }
    }
}

/// Repairs that the user permits; without permission each fault is an error.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a permission of its own")]
pub struct Repairs {
    /// Interpolate missing samples.
    pub missing: bool,
    /// Fill gaps in time by interpolation.
    pub gaps: bool,
    /// Interpolate uneven samples to an even grid.
    pub uneven: bool,
    /// Drop samples with the time of an earlier one.
    pub duplicates: bool,
    /// Sort by time.
    pub order: bool,
    /// Cut channels to the shortest.
    pub lengths: bool,
}
