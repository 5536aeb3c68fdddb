//! Files of measurements, as users have them.
//!
//! Readers take bytes and give a [`RawRecord`]: the content of the file in its own units. Whether that is a
//! usable record is decided by [`RawRecord::validate`].
//!
//! | file | format |
//! |---|---|
//! | `csv/` | comma-, semicolon- or tab-separated values, decimal point or comma, header with units |
//! | `uff/` | Universal File Format, dataset 58, as text and binary (58b) |
//! | `wav.rs` | RIFF WAVE |
//! | `npy.rs`, `npz.rs` | NumPy arrays and archives |
//! | `mat/` | MATLAB, level 5 |
//! | `arrays.rs` | channels, time and sampling rate among named arrays, for NumPy and MATLAB |
//! | `time.rs` | which of several columns is the time; comparison with a named sampling rate |
//! | `bytes.rs` | numbers from bytes |

mod arrays;
mod bytes;
pub mod csv;
mod mat;
mod npy;
mod npz;
mod time;
mod uff;
mod wav;

use std::path::Path;

use crate::{
    error::{ReadError, SignalError},
    limits::{self, LARGEST_FILE},
    raw::RawRecord,
    record::Record,
    text::is_control,
    validation::RecordOptions,
};

/// A file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RecordFormat {
    /// Values separated by commas, semicolons, tabs or blanks.
    Csv,
    /// Universal File Format with datasets 58 and 58b.
    Universal,
    /// RIFF WAVE.
    Wav,
    /// One NumPy array.
    Npy,
    /// NumPy archive.
    Npz,
    /// MATLAB level 5.
    Matlab,
}

impl RecordFormat {
    /// Its name on the command line and in reports.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Universal => "uff",
            Self::Wav => "wav",
            Self::Npy => "npy",
            Self::Npz => "npz",
            Self::Matlab => "mat",
        }
    }

    /// The format by the first bytes; content of no other format is read as separated values.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        if bytes.starts_with(b"\x93NUMPY") {
            Self::Npy
        } else if bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06") {
            Self::Npz
        } else if bytes.starts_with(b"RIFF") || bytes.starts_with(b"RIFX") {
            Self::Wav
        } else if mat::is_matlab(bytes) {
            Self::Matlab
        } else if uff::is_universal(bytes) {
            Self::Universal
        } else {
            Self::Csv
        }
    }
}

/// Reads the content of a file.
///
/// # Errors
/// See [`ReadError`].
pub fn parse(bytes: &[u8]) -> Result<RawRecord, ReadError> {
    if bytes.trim_ascii().is_empty() {
        return Err(ReadError::Empty);
    }
    let mut raw = match RecordFormat::of(bytes) {
        RecordFormat::Csv => csv::read(bytes),
        RecordFormat::Universal => uff::read(bytes),
        RecordFormat::Wav => wav::read(bytes),
        RecordFormat::Npy => npy::read(bytes),
        RecordFormat::Npz => npz::read(bytes),
        RecordFormat::Matlab => mat::read(bytes),
    }?;
    // Names are printed in tables and on terminals.
    for channel in raw.groups.iter_mut().flat_map(|group| &mut group.channels) {
        let texts = [Some(&mut channel.name), channel.unit.as_mut()];
        texts.into_iter().flatten().for_each(|text| *text = text.replace(is_control, "\u{fffd}"));
    }
    Ok(raw)
}

/// Reads a file.
///
/// # Returns
/// Its content, and its format.
/// # Errors
/// [`SignalError::File`], [`SignalError::Read`].
pub fn read_raw(path: &Path) -> Result<(RawRecord, RecordFormat), SignalError> {
    let bytes = limits::read_bytes(path, LARGEST_FILE)
        .map_err(|source| SignalError::File { path: path.to_owned(), source })?;
    let raw = parse(&bytes).map_err(|source| SignalError::Read { path: path.to_owned(), source })?;
    Ok((raw, RecordFormat::of(&bytes)))
}

/// Reads and validates a file.
///
/// # Returns
/// The record, and the file format.
/// # Errors
/// [`SignalError::File`], [`SignalError::Read`], [`SignalError::Record`].
pub fn read(path: &Path, options: &RecordOptions) -> Result<(Record, RecordFormat), SignalError> {
    let (raw, format) = read_raw(path)?;
    Ok((raw.validate(options)?, format))
}
