//! Files of measurements, as users have them.
//!
//! Readers take bytes and give a [`RawRecord`]: what the file says, in its units. Whether that is a usable
//! record is judged elsewhere ([`RawRecord::judge`]).
//!
//! | file | format |
//! |---|---|
//! | `csv/` | comma-, semicolon- or tab-separated values, decimal point or comma, header with units |
//! | `uff/` | Universal File Format, dataset 58, as text and binary (58b) |
//! | `wav.rs` | RIFF WAVE |
//! | `npy.rs`, `npz.rs` | NumPy arrays and archives |
//! | `mat/` | MATLAB, level 5 |
//! | `arrays.rs` | which of named arrays are channels, time, sampling rate: shared by NumPy and MATLAB |
//! | `time.rs` | which of several columns is the time; a rate named beside it |

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
    error::SignalError,
    judge::Terms,
    limits::{self, LARGEST_FILE, is_control},
    raw::RawRecord,
    record::Record,
};

/// A format of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
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

impl Format {
    /// The word for it.
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

    /// Told by the first bytes; whatever is no other format is taken for separated values.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        if bytes.starts_with(b"\x93NUMPY") {
            Self::Npy
        } else if bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06") {
            Self::Npz
        } else if bytes.starts_with(b"RIFF") || bytes.starts_with(b"RIFX") {
            Self::Wav
        } else if mat::begins(bytes) {
            Self::Matlab
        } else if uff::begins(bytes) {
            Self::Universal
        } else {
            Self::Csv
        }
    }
}

/// Why a file is not what it should be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum ReadError {
    /// Nothing in it.
    #[error("the file is empty")]
    Empty,
    /// Bytes that no text has.
    #[error(
        "the file is in no known format: it is binary, but neither WAV, NumPy, MATLAB nor universal file"
    )]
    UnknownFormat,
    /// No rows of numbers.
    #[error("there are no rows of numbers in it")]
    NoNumbers,
    /// Text where numbers should be.
    #[error("line {line}, column {column}: \"{text}\" is not a number")]
    NotANumber { line: usize, column: usize, text: String },
    /// Rows of different length.
    #[error("line {line} has {found} values, the other rows have {expected}")]
    RaggedRow { line: usize, found: usize, expected: usize },
    /// The file ends too early.
    #[error("the file ends early: {what}")]
    Truncated { what: String },
    /// A format, or a part of it, that is not read.
    #[error("{what} is not read; {instead}")]
    Unsupported { what: String, instead: &'static str },
    /// The file contradicts its own format.
    #[error("not as the format has it: {what}")]
    Malformed { what: String },
    /// An archive that grows beyond all bounds when it is unpacked.
    #[error("it unpacks to more than {} MiB, the most that is read", LARGEST_FILE >> 20)]
    TooLarge,
    /// A sampling rate that contradicts another one in the file.
    #[error("the file names two sampling rates, {first} Hz and {second} Hz")]
    TwoRates { first: f64, second: f64 },
}

/// Reads what bytes say.
///
/// # Errors
/// See [`ReadError`].
pub fn parse(bytes: &[u8]) -> Result<RawRecord, ReadError> {
    if bytes.trim_ascii().is_empty() {
        return Err(ReadError::Empty);
    }
    let mut raw = match Format::of(bytes) {
        Format::Csv => csv::read(bytes),
        Format::Universal => uff::read(bytes),
        Format::Wav => wav::read(bytes),
        Format::Npy => npy::read(bytes),
        Format::Npz => npz::read(bytes),
        Format::Matlab => mat::read(bytes),
    }?;
    // Names go into tables and onto terminals.
    for channel in raw.groups.iter_mut().flat_map(|group| &mut group.channels) {
        let texts = [Some(&mut channel.name), channel.unit.as_mut()];
        texts.into_iter().flatten().for_each(|text| *text = text.replace(is_control, "\u{fffd}"));
    }
    Ok(raw)
}

/// Reads what a file says.
///
/// # Returns
/// That, and the format of the file.
/// # Errors
/// [`SignalError::File`], [`SignalError::Read`].
pub fn read_raw(path: &Path) -> Result<(RawRecord, Format), SignalError> {
    let bytes = limits::read_bytes(path, LARGEST_FILE)
        .map_err(|source| SignalError::File { path: path.to_owned(), source })?;
    let raw = parse(&bytes).map_err(|source| SignalError::Read { path: path.to_owned(), source })?;
    Ok((raw, Format::of(&bytes)))
}

/// Reads a file and judges it.
///
/// # Returns
/// The record, and the format of the file.
/// # Errors
/// [`SignalError::File`], [`SignalError::Read`], [`SignalError::Record`].
pub fn read(path: &Path, terms: &Terms) -> Result<(Record, Format), SignalError> {
    let (raw, format) = read_raw(path)?;
    Ok((raw.judge(terms)?, format))
}
