//! RIFF WAVE: whole numbers of 8 to 32 bits, as parts of full scale, and 32-bit floating point.
//!
//! A sample of `b` bits is divided by `2^(b-1)`, so that full scale is 1. A WAV file names no units.

use hound::{SampleFormat, WavReader};

use super::ReadError;
use crate::raw::{Axis, RawChannel, RawRecord};

pub(super) fn read(bytes: &[u8]) -> Result<RawRecord, ReadError> {
    let mut reader = WavReader::new(bytes).map_err(reason)?;
    let spec = reader.spec();
    let values: Result<Vec<f64>, hound::Error> = match spec.sample_format {
        SampleFormat::Float => reader.samples::<f32>().map(|sample| sample.map(f64::from)).collect(),
        SampleFormat::Int => {
            let full_scale = 2.0_f64.powi(i32::from(spec.bits_per_sample) - 1);
            reader.samples::<i32>().map(|sample| sample.map(|value| f64::from(value) / full_scale)).collect()
        }
    };
    let values = values.map_err(reason)?;
    let count = usize::from(spec.channels);
    let channel = |index: usize| RawChannel {
        name: format!("channel {}", index + 1),
        unit: None,
        samples: values.iter().skip(index).step_by(count).copied().collect(),
    };
    let axis = Axis::Even { step_s: 1.0 / f64::from(spec.sample_rate), start_s: 0.0 };
    Ok(RawRecord::single(axis, (0..count).map(channel).collect(), Vec::new()))
}

fn reason(error: hound::Error) -> ReadError {
    match error {
        // The library's word for floating-point numbers of 64 bits.
        hound::Error::FormatError("bits per sample is not 32")
        | hound::Error::Unsupported
        | hound::Error::InvalidSampleFormat
        | hound::Error::TooWide => ReadError::Unsupported {
            what: "this kind of WAV samples".to_owned(),
            instead: "save as PCM of 16, 24 or 32 bits or as 32-bit floating point",
        },
        hound::Error::FormatError(what) => ReadError::Malformed { what: what.to_owned() },
        other => ReadError::Truncated { what: other.to_string() },
    }
}
