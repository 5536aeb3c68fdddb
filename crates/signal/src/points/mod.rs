//! Tables of measured points: one row per excitation frequency, with the largest measured values.
//!
//! A table has a line of titles with units, `frequency [Hz],max acceleration [m/s^2],kind,period`, and one
//! row for each measurement:
//!
//! | column | identified by | meaning |
//! |---|---|---|
//! | excitation frequency | its unit, Hz or kHz | required |
//! | maxima | a unit of length, speed, acceleration or force | largest absolute value |
//! | excitation | the name `excitation`, `table`, `shaker`, `support`, `drive`, and a unit | its amplitude |
//! | kind | the name `kind`, `motion` or `class` | `periodic`, `aperiodic` or `doubtful` |
//! | period | the name `period`, `multiple` or `period_multiple` | motion period over excitation period |
//!
//! At least one column of maxima is required, and at most one per quantity. The name of an excitation column
//! may have further words after the first. An aperiodic motion may also be named `chaotic` or
//! `quasi-periodic`; an empty field means an unknown kind.
//!
//! Other columns are left out, with a finding. Every column that looks like a quantity needs its unit. Fields
//! are validated strictly: a field that is not a number is an error, and nothing is guessed.
//!
//! | file | what |
//! |---|---|
//! | `measured.rs` | the points |
//! | `columns.rs` | roles of the columns |
//! | `table.rs` | lines, fields, points |

mod columns;
mod measured;
mod table;

use std::path::Path;

pub use measured::{MeasuredKind, MeasuredMaxima, MeasuredPoint, MeasuredTable};
pub use table::parse;

use crate::{
    error::SignalError,
    limits::{self, LARGEST_FILE},
};

/// Reads a table of measured points.
///
/// # Errors
/// [`SignalError::File`], [`SignalError::Points`].
pub fn read(path: &Path) -> Result<MeasuredTable, SignalError> {
    let bytes = limits::read_bytes(path, LARGEST_FILE)
        .map_err(|source| SignalError::File { path: path.to_owned(), source })?;
    parse(&bytes).map_err(|source| SignalError::Points { path: path.to_owned(), source })
}
