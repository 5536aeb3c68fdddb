//! Why a file of measurements cannot be read.

use crate::limits::{LARGEST_FILE, LONGEST_NAME, MAX_COLUMNS, MAX_DEPTH, MAX_SAMPLES};

/// Why the content of a file is not a record of the format it appears to have.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum ReadError {
    /// The file has no content.
    #[error("the file is empty")]
    Empty,
    /// Binary content that starts as no known format does.
    #[error(
        "the file is in no known format: it is binary, but neither WAV, NumPy, MATLAB nor universal file"
    )]
    UnknownFormat,
    /// No rows of numbers.
    #[error("there are no rows of numbers in it")]
    NoNumbers,
    /// Text where a number is expected.
    #[error("line {line}, column {column}: \"{text}\" is not a number")]
    NotANumber { line: usize, column: usize, text: String },
    /// Rows of different length.
    #[error("line {line} has {found} values, the other rows have {expected}")]
    RaggedRow { line: usize, found: usize, expected: usize },
    /// The file ends too early.
    #[error("the file ends early: {what}")]
    Truncated { what: String },
    /// A format, or a part of one, that is not supported.
    #[error("{what} is not read; {instead}")]
    Unsupported { what: String, instead: &'static str },
    /// The file violates its own format.
    #[error("not as the format has it: {what}")]
    Malformed { what: String },
    /// An archive whose unpacked content is too large.
    #[error("it unpacks to more than {} MiB, the most that is read", LARGEST_FILE >> 20)]
    TooLarge,
    /// More numbers than are worked with.
    #[error("it has more than {MAX_SAMPLES} numbers, the most that are read")]
    TooManyNumbers,
    /// A table that is too wide.
    #[error("it has {found} columns, at most {MAX_COLUMNS} are read")]
    TooManyColumns { found: usize },
    /// Structures within one another.
    #[error("it has more than {MAX_DEPTH} structures within one another, the most that are read")]
    TooDeep,
    /// A name that is too long.
    #[error("it has a name of {found} bytes, at most {LONGEST_NAME} are read")]
    LongName { found: usize },
    /// Two sampling rates in one file that contradict each other.
    #[error("the file names two sampling rates, {first} Hz and {second} Hz")]
    TwoRates { first: f64, second: f64 },
}
