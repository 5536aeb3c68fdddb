//! What a file says, before it is judged.

use crate::{
    finding::Finding,
    judge::RecordError,
    unit::{Quantity, unit},
};

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
    /// Name of the column that was taken for the time.
    pub time_name: Option<String>,
    /// What was noticed while reading.
    pub findings: Vec<Finding>,
}

impl RawRecord {
    /// A single group.
    #[must_use]
    pub fn single(axis: Axis, channels: Vec<RawChannel>, findings: Vec<Finding>) -> Self {
        Self { groups: vec![RawGroup { axis, channels }], time_name: None, findings }
    }

    /// With a channel as the time, by its name or number. What was taken for the time becomes a channel again.
    ///
    /// # Errors
    /// [`RecordError::NoSuchChannel`].
    pub fn with_time(mut self, text: &str) -> Result<Self, RecordError> {
        if self.time_name.as_deref() == Some(text) {
            return Ok(self);
        }
        let name = self.channel_name(text)?.to_owned();
        let Some((group, index)) = self.groups.iter_mut().find_map(|group| {
            let index = group.channels.iter().position(|channel| channel.name == name)?;
            Some((group, index))
        }) else {
            return Ok(self);
        };
        let channel = group.channels.remove(index);
        let known = channel.unit.as_deref().and_then(unit).filter(|unit| unit.quantity == Quantity::Time);
        let factor = known.map_or(1.0, |unit| unit.factor);
        let times = channel.samples.iter().map(|value| value * factor).collect();
        let before = std::mem::replace(&mut group.axis, Axis::Times(times));
        let assumed =
            |finding: &Finding| matches!(finding, Finding::TimeAssumed | Finding::TimeUnitAssumed { .. });
        self.findings.retain(|finding| !assumed(finding));
        if let (Axis::Times(samples), Some(name)) = (before, self.time_name.take()) {
            group.channels.insert(0, RawChannel { name, unit: Some("s".to_owned()), samples });
        }
        if known.is_none() {
            self.findings.push(Finding::TimeUnitAssumed { name: name.clone() });
        }
        self.time_name = Some(name);
        Ok(self)
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
