//! Why a file is not a table of measured points.

/// Why a file is not a table of measured points.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum PointsError {
    /// The file has no content.
    #[error("there is no table: it needs a line of titles with units, and a row for each measured point")]
    Empty,
    /// Titles without rows.
    #[error("there is a line of titles, but no row below it")]
    NoRows,
    /// A binary file.
    #[error("it is no text: a table of points is read from comma-, semicolon- or tab-separated values")]
    NotText,
    /// No column of excitation frequencies.
    #[error(
        "no column is the excitation frequency: one title must have the unit Hz or kHz, as in \
         \"frequency [Hz]\"; the titles are {titles}"
    )]
    NoFrequency { titles: String },
    /// No column of measured values.
    #[error(
        "no column is a maximum: a title must have a unit of length, speed, acceleration or force, as in \
         \"max acceleration [m/s^2]\"; the titles are {titles}"
    )]
    NoMaximum { titles: String },
    /// Two columns with the same content.
    #[error("columns \"{first}\" and \"{second}\" are both {what}")]
    TwoColumns { first: String, second: String, what: &'static str },
    /// A quantity without a unit.
    #[error("column \"{column}\" names no unit; write it as in \"{column} [{example}]\"")]
    NoUnit { column: String, example: &'static str },
    /// An unknown unit.
    #[error("column \"{column}\" has the unit \"{unit}\", which is not known")]
    UnknownUnit { column: String, unit: String },
    /// A row of another length.
    #[error("line {line} has {found} fields, the titles have {expected}")]
    RaggedRow { line: usize, found: usize, expected: usize },
    /// Text where a number is expected.
    #[error("line {line}, column \"{column}\": \"{text}\" is not a number")]
    NotANumber { line: usize, column: String, text: String },
    /// A number that must be positive.
    #[error("line {line}, column \"{column}\": {value} must be finite and more than 0")]
    NotPositive { line: usize, column: String, value: f64 },
    /// A row without a frequency.
    #[error("line {line} has no excitation frequency")]
    MissingFrequency { line: usize },
    /// A row without any maximum.
    #[error("line {line} has no maximum")]
    MissingMaximum { line: usize },
    /// An unknown kind of motion.
    #[error(
        "line {line}: the kind \"{text}\" is not known; allowed: periodic, aperiodic, chaotic, \
         quasi-periodic, doubtful, or nothing"
    )]
    UnknownKind { line: usize, text: String },
    /// An invalid period.
    #[error("line {line}: the period \"{text}\" must be a whole number of excitation periods from 1 to 64")]
    BadPeriod { line: usize, text: String },
    /// A period of a motion that does not repeat.
    #[error("line {line}: the motion is {kind} and has the period {period}; only periodic motions have one")]
    PeriodOfAperiodic { line: usize, kind: &'static str, period: u32 },
}
