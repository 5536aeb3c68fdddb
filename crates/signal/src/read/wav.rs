//! RIFF WAVE: whole numbers of 8 to 32 bits, as parts of full scale, and floating point of 32 and 64 bits.
//!
//! A sample of `b` bits is divided by `2^(b-1)`, so that full scale is 1. A WAV file names no units.

use hound::{SampleFormat, WavReader};

use super::bytes::{NumberFormat, NumberRoom};
use crate::{
    error::ReadError,
    raw::{RawChannel, RawRecord, TimeAxis},
};

pub(super) fn read(bytes: &[u8]) -> Result<RawRecord, ReadError> {
    if let Some(double) = Double::find(bytes) {
        return double.record();
    }
    let mut reader = WavReader::new(bytes).map_err(reason)?;
    NumberRoom::new().take(reader.len() as usize)?;
    let spec = reader.spec();
    let values: Result<Vec<f64>, hound::Error> = match spec.sample_format {
        SampleFormat::Float => reader.samples::<f32>().map(|sample| sample.map(f64::from)).collect(),
        SampleFormat::Int => {
            let full_scale = 2.0_f64.powi(i32::from(spec.bits_per_sample) - 1);
            reader.samples::<i32>().map(|sample| sample.map(|value| f64::from(value) / full_scale)).collect()
        }
    };
    Ok(record(&values.map_err(reason)?, usize::from(spec.channels), spec.sample_rate))
}

/// Channels from interleaved samples.
fn record(values: &[f64], count: usize, rate: u32) -> RawRecord {
    let channel = |index: usize| RawChannel {
        name: format!("channel {}", index + 1),
        unit: None,
        samples: values.iter().skip(index).step_by(count).copied().collect(),
    };
    let axis = TimeAxis::Even { step_s: 1.0 / f64::from(rate), start_s: 0.0 };
    RawRecord::single(axis, (0..count).map(channel).collect(), Vec::new())
}

/// A file of floating-point numbers of 64 bits, which `hound` does not read.
struct Double<'a> {
    channels: u16,
    rate: u32,
    /// The bytes after its `fmt` chunk.
    rest: &'a [u8],
}

const FLOAT: u16 = 3;
const EXTENSIBLE: u16 = 0xfffe;

impl<'a> Double<'a> {
    /// The `fmt` chunk of such a file: format, channels, rate, bytes per second, bytes per frame, bits. In
    /// the extensible form the format is at offset 24.
    fn find(bytes: &'a [u8]) -> Option<Self> {
        let (chunk, rest) = chunk(bytes.get(12..)?, b"fmt ")?;
        let short = |at: usize| Some(u16::from_le_bytes([*chunk.get(at)?, *chunk.get(at + 1)?]));
        let format = if short(0)? == EXTENSIBLE { short(24)? } else { short(0)? };
        let rate = u32::from_le_bytes(chunk.get(4..8)?.try_into().ok()?);
        let found = bytes.starts_with(b"RIFF") && format == FLOAT && short(14)? == 64;
        found.then_some(Self { channels: short(2)?, rate, rest })
    }

    fn record(self) -> Result<RawRecord, ReadError> {
        let truncated = || ReadError::Truncated { what: "the data of the WAV file".to_owned() };
        let (data, _) = chunk(self.rest, b"data").ok_or_else(truncated)?;
        let frame = 8 * usize::from(self.channels);
        if frame == 0 || self.rate == 0 {
            return Err(ReadError::Malformed { what: "no channels or no sampling rate".to_owned() });
        }
        if !data.len().is_multiple_of(frame) {
            return Err(truncated());
        }
        NumberRoom::new().take(data.len() / 8)?;
        Ok(record(&NumberFormat::F64.values(data, false), usize::from(self.channels), self.rate))
    }
}

/// Content of the first chunk of a type, and the bytes after it; chunks have even lengths.
fn chunk<'a>(mut bytes: &'a [u8], kind: &[u8; 4]) -> Option<(&'a [u8], &'a [u8])> {
    loop {
        let length = u32::from_le_bytes(bytes.get(4..8)?.try_into().ok()?) as usize;
        let content = bytes.get(8..8usize.checked_add(length)?)?;
        let rest = bytes.get(8 + length + length % 2..).unwrap_or_default();
        if bytes.starts_with(kind) {
            return Some((content, rest));
        }
        bytes = rest;
    }
}

fn reason(error: hound::Error) -> ReadError {
    match error {
        // The message of `hound` for floating-point numbers of other lengths.
        hound::Error::FormatError("bits per sample is not 32")
        | hound::Error::Unsupported
        | hound::Error::InvalidSampleFormat
        | hound::Error::TooWide => ReadError::Unsupported {
            what: "this kind of WAV samples".to_owned(),
            instead: "save as PCM of 16, 24 or 32 bits or as floating point of 32 or 64 bits",
        },
        hound::Error::FormatError(what) => ReadError::Malformed { what: what.to_owned() },
        other => ReadError::Truncated { what: other.to_string() },
    }
}
