//! A record: channels with one sampling rate, in SI units, nothing missing.

use crate::{
    error::{RecordError, SignalError},
    finding::RecordFinding,
    unit::MeasuredQuantity,
};

/// One measured or computed quantity over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Name in the file.
    pub name: String,
    /// Unit as written in the file.
    pub unit: Option<String>,
    /// What it measures.
    pub quantity: MeasuredQuantity,
    /// Samples; in SI, or in the unit of the file for [`MeasuredQuantity::Other`].
    pub samples: Vec<f64>,
}

/// Channels that were sampled together; sample `k` is the value at `start + k / rate`.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Sampling rate [Hz].
    pub sampling_rate_hz: f64,
    /// Time of the first sample [s].
    pub start_s: f64,
    /// The channels, all of one length.
    pub channels: Vec<Channel>,
    /// What is suspicious, and what was repaired.
    pub findings: Vec<RecordFinding>,
}

impl Record {
    /// Number of samples of each channel.
    #[must_use]
    pub fn len(&self) -> usize {
        self.channels.first().map_or(0, |channel| channel.samples.len())
    }

    /// Whether it has no samples.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of samples over the sampling rate: the last sample counts with its step [s].
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.len() as f64 / self.sampling_rate_hz
    }

    /// Index of a channel by its name.
    ///
    /// # Errors
    /// [`RecordError::NoSuchChannel`] with the names of all channels.
    pub fn find(&self, name: &str) -> Result<usize, RecordError> {
        self.channels.iter().position(|channel| channel.name == name).ok_or_else(|| {
            RecordError::NoSuchChannel {
                name: name.to_owned(),
                names: self
                    .channels
                    .iter()
                    .map(|channel| channel.name.clone())
                    .collect::<Vec<_>>()
                    .join(", "),
            }
        })
    }

    /// The samples from one time to another [s], on the time axis of the record.
    ///
    /// # Errors
    /// [`SignalError::EmptyPart`] if fewer than two samples lie there.
    pub fn part(&self, from_s: f64, to_s: f64) -> Result<Self, SignalError> {
        let index = |time: f64| ((time - self.start_s) * self.sampling_rate_hz).clamp(0.0, self.len() as f64);
        // The tolerance keeps the sample at a time that rounding has moved past it.
        let first = (index(from_s) - 1e-6).ceil() as usize;
        let last = ((index(to_s) + 1e-6).floor() as usize + 1).min(self.len());
        if last < first + 2 {
            return Err(SignalError::EmptyPart {
                from_s,
                to_s,
                start_s: self.start_s,
                end_s: self.start_s + self.duration_s(),
            });
        }
        let cut =
            |channel: &Channel| Channel { samples: channel.samples[first..last].to_vec(), ..channel.clone() };
        Ok(Self {
            sampling_rate_hz: self.sampling_rate_hz,
            start_s: self.start_s + first as f64 / self.sampling_rate_hz,
            channels: self.channels.iter().map(cut).collect(),
            findings: self.findings.clone(),
        })
    }
}
