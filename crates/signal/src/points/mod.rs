//! Measured points: one row for each excitation frequency, with the largest values that were seen there.
//!
//! A table has a line of titles with units, `frequency [Hz],max acceleration [m/s^2],kind,period`, and one
//! row for each measurement:
//!
//! | column | told by | meaning |
//! |---|---|---|
//! | excitation frequency | its unit, Hz or kHz | required |
//! | maxima | a unit of length, speed, acceleration or force | largest absolute value; one column or more, at most one of each |
//! | excitation | a name that begins with `excitation`, `table`, `shaker`, `support` or `drive`, and such a unit | amplitude of what shakes |
//! | kind | the name `kind`, `motion` or `class` | `periodic`, `aperiodic` (or `chaotic`, `quasi-periodic`), `doubtful`; nothing: not known |
//! | period | the name `period`, `multiple` or `period_multiple` | excitation periods after which the motion repeats |
//!
//! Other columns are left out, and that is told. Every column that looks like a quantity needs its unit. What
//! a row says is judged at once: nothing is taken for a number that is none, and nothing is guessed.
//!
//! | file | what |
//! |---|---|
//! | `columns.rs` | which column is what |
//! | `table.rs` | lines, fields, points |

mod columns;
mod table;

use std::path::Path;

use crate::{
    Finding, SignalError,
    limits::{self, LARGEST_FILE},
    unit::Quantity,
};

pub use table::parse;

/// Largest absolute values at one excitation frequency, in SI.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Maxima {
    /// Of the displacement [m].
    pub displacement: Option<f64>,
    /// Of the velocity [m/s].
    pub velocity: Option<f64>,
    /// Of the acceleration [m/s²].
    pub acceleration: Option<f64>,
    /// Of the contact force [N].
    pub force: Option<f64>,
}

impl Maxima {
    /// That of a quantity.
    #[must_use]
    pub const fn of(&self, quantity: Quantity) -> Option<f64> {
        match quantity {
            Quantity::Displacement => self.displacement,
            Quantity::Velocity => self.velocity,
            Quantity::Acceleration => self.acceleration,
            Quantity::Force => self.force,
            _ => None,
        }
    }

    /// Sets that of a quantity; a quantity that has no maximum changes nothing.
    pub const fn set(&mut self, quantity: Quantity, value: f64) {
        match quantity {
            Quantity::Displacement => self.displacement = Some(value),
            Quantity::Velocity => self.velocity = Some(value),
            Quantity::Acceleration => self.acceleration = Some(value),
            Quantity::Force => self.force = Some(value),
            _ => {}
        }
    }
}

/// What kind of motion was measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// It repeats.
    Periodic {
        /// After so many excitation periods, if that is known.
        period_multiple: Option<u32>,
    },
    /// It does not repeat.
    Aperiodic,
    /// The measurement does not tell.
    Doubtful,
    /// Nothing is said of it.
    Unknown,
}

impl Kind {
    /// The word for it.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Periodic { .. } => "periodic",
            Self::Aperiodic => "aperiodic",
            Self::Doubtful => "doubtful",
            Self::Unknown => "unknown",
        }
    }

    /// Excitation periods after which it repeats, if that is known.
    #[must_use]
    pub const fn period_multiple(self) -> Option<u32> {
        match self {
            Self::Periodic { period_multiple } => period_multiple,
            _ => None,
        }
    }
}

/// What was measured at one excitation frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredPoint {
    /// Where it is from: line of the table, or name of the record.
    pub origin: String,
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Largest values.
    pub maxima: Maxima,
    /// Kind of the motion.
    pub kind: Kind,
    /// Amplitude of the excitation, in SI, and what it is of.
    pub excitation: Option<(Quantity, f64)>,
}

impl MeasuredPoint {
    /// Amplitude of the excitation as a displacement [m] (from a harmonic velocity or acceleration) or a
    /// force [N].
    #[must_use]
    pub fn excitation_amplitude(&self) -> Option<(Quantity, f64)> {
        let rate = std::f64::consts::TAU * self.frequency_hz;
        self.excitation.map(|(quantity, amplitude)| match quantity {
            Quantity::Velocity => (Quantity::Displacement, amplitude / rate),
            Quantity::Acceleration => (Quantity::Displacement, amplitude / (rate * rate)),
            other => (other, amplitude),
        })
    }
}

/// A table of measured points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeasuredTable {
    /// The points, in the order of the file.
    pub points: Vec<MeasuredPoint>,
    /// What was left out.
    pub findings: Vec<Finding>,
}

/// Why a file is no table of measured points.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum PointsError {
    /// Nothing in it.
    #[error("there is no table: it needs a line of titles with units, and a row for each measured point")]
    Empty,
    /// Titles without rows.
    #[error("there is a line of titles, but no row below it")]
    NoRows,
    /// A binary file.
    #[error("it is no text: a table of points is read from comma-, semicolon- or tab-separated values")]
    NotText,
    /// No excitation frequency.
    #[error(
        "no column is the excitation frequency: one title must have the unit Hz or kHz, as in \"frequency [Hz]\"; the titles are {titles}"
    )]
    NoFrequency { titles: String },
    /// Nothing was measured.
    #[error(
        "no column is a maximum: a title must have a unit of length, speed, acceleration or force, as in \"max acceleration [m/s^2]\"; the titles are {titles}"
    )]
    NoMaximum { titles: String },
    /// Two columns for one thing.
    #[error("columns \"{first}\" and \"{second}\" are both {what}")]
    TwoColumns { first: String, second: String, what: &'static str },
    /// A quantity without a unit.
    #[error("column \"{column}\" names no unit; write it as in \"{column} [{example}]\"")]
    NoUnit { column: String, example: &'static str },
    /// A unit that is not known.
    #[error("column \"{column}\" has the unit \"{unit}\", which is not known")]
    UnknownUnit { column: String, unit: String },
    /// A row of another length.
    #[error("line {line} has {found} fields, the titles have {expected}")]
    RaggedRow { line: usize, found: usize, expected: usize },
    /// Text where a number should be.
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
    /// A kind that is none.
    #[error(
        "line {line}: the kind \"{text}\" is not known; allowed: periodic, aperiodic, chaotic, quasi-periodic, doubtful, or nothing"
    )]
    UnknownKind { line: usize, text: String },
    /// A period that is none.
    #[error("line {line}: the period \"{text}\" must be a whole number of excitation periods from 1 to 64")]
    BadPeriod { line: usize, text: String },
    /// A motion that does not repeat, with a period.
    #[error("line {line}: the motion is {kind} and has the period {period}; only periodic motions have one")]
    PeriodOfAperiodic { line: usize, kind: &'static str, period: u32 },
}

/// Reads a table of measured points.
///
/// # Errors
/// [`SignalError::File`], [`SignalError::Points`].
pub fn read(path: &Path) -> Result<MeasuredTable, SignalError> {
    let bytes = limits::read_bytes(path, LARGEST_FILE)
        .map_err(|source| SignalError::File { path: path.to_owned(), source })?;
    parse(&bytes).map_err(|source| SignalError::Points { path: path.to_owned(), source })
}
