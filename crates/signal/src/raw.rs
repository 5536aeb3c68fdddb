//! What a file says, before it is judged.

use crate::{finding::Finding, judge::RecordError};

/// The times of samples.
#[derive(Debug, Clone, PartialEq)]
pub enum Axis {
    /// The file does not say.
    Unknown,
    /// Even steps.
    Even {
        /// Step [s].
        step_s: f64,
        /// Time of the first sample [s].
        start_s: f64,
    },
    /// A time for each sample [s]; what is missing is NaN.
    Times(Vec<f64>),
}

/// A channel as it is in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct RawChannel {
    /// Its name; never empty.
    pub name: String,
    /// The text of its unit.
    pub unit: Option<String>,
    /// Samples in that unit; what is missing is NaN.
    pub samples: Vec<f64>,
}

/// Channels with the same times.
#[derive(Debug, Clone, PartialEq)]
pub struct RawGroup {
    /// The times.
    pub axis: Axis,
    /// The channels.
    pub channels: Vec<RawChannel>,
}

/// What a file says.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RawRecord {
    /// Channels, by their times.
    pub groups: Vec<RawGroup>,
    /// What was noticed while reading.
    pub findings: Vec<Finding>,
}

impl RawRecord {
    /// A single group.
    #[must_use]
    pub fn single(axis: Axis, channels: Vec<RawChannel>, findings: Vec<Finding>) -> Self {
        Self { groups: vec![RawGroup { axis, channels }], findings }
    }

    /// Name of a channel that is meant by its name or its number, from 1 on in the order of the file. A name comes before a number.
    ///
    /// # Errors
    /// [`RecordError::NoSuchChannel`] with the names there are.
    pub fn channel_name(&self, text: &str) -> Result<&str, RecordError> {
        let names: Vec<&str> = self
            .groups
            .iter()
            .flat_map(|group| &group.channels)
            .map(|channel| channel.name.as_str())
            .collect();
        let number = || text.parse::<usize>().ok().and_then(|number| names.get(number.checked_sub(1)?));
        names
            .iter()
            .find(|name| **name == text)
            .or_else(number)
            .copied()
            .ok_or_else(|| RecordError::NoSuchChannel { name: text.to_owned(), names: names.join(", ") })
    }

    /// Adds a channel to the group with the same times, which is made if it is not there.
    ///
    /// Steps that differ by less than 1e-6 of themselves are the same: a file in single precision says no more.
    pub fn add(&mut self, axis: Axis, channel: RawChannel) {
        match self.groups.iter_mut().find(|group| same(&group.axis, &axis)) {
            Some(group) => group.channels.push(channel),
            None => self.groups.push(RawGroup { axis, channels: vec![channel] }),
        }
    }
}

fn same(one: &Axis, other: &Axis) -> bool {
    match (one, other) {
        (Axis::Unknown, Axis::Unknown) => true,
        (Axis::Even { step_s: a, start_s: from_a }, Axis::Even { step_s: b, start_s: from_b }) => {
            (a - b).abs() <= 1e-6 * a.abs() && (from_a - from_b).abs() <= 1e-3 * a.abs()
        }
        (Axis::Times(a), Axis::Times(b)) => a == b,
        _ => false,
    }
}
