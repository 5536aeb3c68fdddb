//! What can be wrong with a file of matrices, and where.

use std::{fmt, io, path::PathBuf};

/// Where in a file something is wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilePlace {
    /// A line, counted from 1.
    Line(u64),
    /// A byte, counted from 0.
    Byte(u64),
    /// The file as a whole.
    Whole,
}

impl fmt::Display for FilePlace {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(formatter, ", line {line}"),
            Self::Byte(byte) => write!(formatter, ", byte {byte}"),
            Self::Whole => Ok(()),
        }
    }
}

/// What is wrong.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum MatrixFault {
    /// The machine does not give the file.
    #[error("cannot be read: {0}")]
    Unreadable(#[from] io::Error),
    /// Something else stands where a number should.
    #[error("{what} should be a number, found \"{found}\"")]
    NotANumber { what: &'static str, found: String },
    /// A value that is infinite or not a number.
    #[error("{what} is {found}, must be finite")]
    NotFinite { what: &'static str, found: f64 },
    /// A number that is not allowed.
    #[error("{what} is {found}, allowed: {allowed}")]
    OutOfRange { what: &'static str, found: i64, allowed: String },
    /// The file has another number of something than it says.
    #[error("there are {found} {what}, the file says {expected}")]
    WrongCount { what: &'static str, found: u64, expected: u64 },
    /// The file ends too early.
    #[error("the file ends within {what}")]
    Truncated { what: &'static str },
    /// A line that does not belong there.
    #[error("expected {expected}, found \"{found}\"")]
    Unexpected { expected: &'static str, found: String },
    /// A form of the format that is not read.
    #[error("{what} is not read; {instead}")]
    Unsupported { what: String, instead: &'static str },
    /// No format fits the file.
    #[error("the format is not known; allowed: {}", known.join(", "))]
    UnknownFormat { known: Vec<&'static str> },
    /// Nothing of the name that was asked for.
    #[error("there is no matrix {name}, the file has \
    {}", if known.is_empty() { "none".to_owned() } else { listed(known) })]
    NoSuchMatrix { name: String, known: Vec<String> },
    /// Rows and columns differ in number.
    #[error("matrix {name} has {rows} rows and {columns} columns, must be square")]
    NotSquare { name: String, rows: u64, columns: u64 },
    /// The entries of two mirrored places differ.
    #[error(
        "matrix {name} is not symmetric: row {row}, column {column} is {value:e}, and mirrored {mirrored:e}"
    )]
    NotSymmetric { name: String, row: u64, column: u64, value: f64, mirrored: f64 },
    /// One label for two rows that must differ.
    #[error("{label} stands for row {first} and for row {second}")]
    DuplicateLabel { label: String, first: u64, second: u64 },
    /// The numbers of rows of two matrices differ.
    #[error("{what} has {found} rows, the stiffness has {expected}")]
    RowCount { what: &'static str, found: u64, expected: u64 },
}

/// A fault with the file and the place of it.
#[derive(Debug, thiserror::Error)]
#[error("{}{place}: {fault}", path.display())]
pub struct MatrixError {
    /// The file.
    pub path: PathBuf,
    /// Where in it.
    pub place: FilePlace,
    /// What is wrong.
    pub fault: MatrixFault,
}

/// A fault at a place of a file whose name the reader does not know.
#[derive(Debug)]
pub(crate) struct PlacedFault {
    pub place: FilePlace,
    pub fault: MatrixFault,
}

/// The first names of many.
fn listed(names: &[String]) -> String {
    const MOST: usize = 20;
    let more = names.len().saturating_sub(MOST);
    let more = (more > 0).then(|| format!("and {more} more"));
    names.iter().take(MOST).cloned().chain(more).collect::<Vec<_>>().join(", ")
}

impl MatrixFault {
    pub(crate) fn at(self, place: FilePlace) -> PlacedFault {
        PlacedFault { place, fault: self }
    }
}

impl From<io::Error> for PlacedFault {
    fn from(error: io::Error) -> Self {
        MatrixFault::Unreadable(error).at(FilePlace::Whole)
    }
}
