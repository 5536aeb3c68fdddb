//! The content of a file, before validation.

use std::collections::{HashMap, HashSet};

use crate::{
    error::RecordError,
    finding::RecordFinding,
    unit::{MeasuredQuantity, unit},
};

/// The times of samples.
#[derive(Debug, Clone, PartialEq)]
pub enum TimeAxis {
    /// The file has neither times nor a sampling rate.
    Unknown,
    /// Even steps.
    Even {
        /// Step [s].
        step_s: f64,
        /// Time of the first sample [s].
        start_s: f64,
    },
    /// A time for each sample [s]; missing ones are NaN.
    Times(Vec<f64>),
}

/// A channel as it is in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct RawChannel {
    /// Its name; never empty.
    pub name: String,
    /// The text of its unit.
    pub unit: Option<String>,
    /// Samples in that unit; missing ones are NaN.
    pub samples: Vec<f64>,
}

impl RawChannel {
    /// Its samples as times [s], and a finding if it has no unit of time.
    pub(crate) fn times(&self) -> (Vec<f64>, Option<RecordFinding>) {
        let known =
            self.unit.as_deref().and_then(unit).filter(|unit| unit.quantity == MeasuredQuantity::Time);
        let factor = known.map_or(1.0, |unit| unit.factor);
        let assumed = known.is_none().then(|| RecordFinding::TimeUnitAssumed { name: self.name.clone() });
        (self.samples.iter().map(|value| value * factor).collect(), assumed)
    }
}

/// The column of the first group that holds the times.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TimeColumn {
    /// As it is in the file.
    pub channel: RawChannel,
    /// Its index among the columns.
    pub index: usize,
}

/// Channels with the same time axis.
#[derive(Debug, Clone, PartialEq)]
pub struct RawGroup {
    /// The time axis.
    pub axis: TimeAxis,
    /// The channels.
    pub channels: Vec<RawChannel>,
}

/// The content of a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RawRecord {
    /// Channels, grouped by their time axis.
    pub groups: Vec<RawGroup>,
    /// The column that holds the times.
    pub(crate) time: Option<TimeColumn>,
    /// Findings of the reader.
    pub findings: Vec<RecordFinding>,
}

impl RawRecord {
    /// A single group.
    #[must_use]
    pub fn single(axis: TimeAxis, channels: Vec<RawChannel>, findings: Vec<RecordFinding>) -> Self {
        Self { groups: vec![RawGroup { axis, channels }], time: None, findings }
    }

    /// The same content with another column as the time, given by its name or its number among all columns
    /// (from 1, in the order of the file). The previous time column becomes a channel again, at its place in
    /// the file.
    ///
    /// # Errors
    /// [`RecordError::NoSuchChannel`].
    pub fn with_time(mut self, text: &str) -> Result<Self, RecordError> {
        let before = self.time.take();
        if let (Some(TimeColumn { channel, index }), Some(group)) = (before.clone(), self.groups.first_mut())
        {
            group.channels.insert(index, channel);
        }
        let name = self.channel_name(text)?.to_owned();
        let found = self.groups.iter().enumerate().find_map(|(group, RawGroup { channels, .. })| {
            Some((group, channels.iter().position(|channel| channel.name == name)?))
        });
        let Some((group, index)) = found else { return Ok(self) };
        let channel = self.groups[group].channels.remove(index);
        if before.is_some_and(|before| before.channel == channel) {
            self.time = Some(TimeColumn { channel, index });
            return Ok(self);
        }
        let (times, assumed) = channel.times();
        self.groups[group].axis = TimeAxis::Times(times);
        let concerns_time = |finding: &RecordFinding| {
            matches!(finding, RecordFinding::TimeAssumed | RecordFinding::TimeUnitAssumed { .. })
        };
        self.findings.retain(|finding| !concerns_time(finding));
        self.findings.extend(assumed);
        // In every format only the first group can have a column of times.
        self.time = (group == 0).then_some(TimeColumn { channel, index });
        Ok(self)
    }

    /// Name of a channel given by its name or its number (from 1, in the order of the file, without the time
    /// column). A name takes precedence over a number.
    ///
    /// # Errors
    /// [`RecordError::NoSuchChannel`] with the names of all channels.
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

    /// Adds a channel to the group with the same time axis, which is created if it does not exist.
    ///
    /// Steps with a relative difference of at most 1e-6 are equal: a file in single precision is not more
    /// accurate.
    pub fn add(&mut self, axis: TimeAxis, channel: RawChannel) {
        match self.groups.iter_mut().find(|group| same(&group.axis, &axis)) {
            Some(group) => group.channels.push(channel),
            None => self.groups.push(RawGroup { axis, channels: vec![channel] }),
        }
    }
}

fn same(one: &TimeAxis, other: &TimeAxis) -> bool {
    match (one, other) {
        (TimeAxis::Unknown, TimeAxis::Unknown) => true,
        (TimeAxis::Even { step_s: a, start_s: from_a }, TimeAxis::Even { step_s: b, start_s: from_b }) => {
            (a - b).abs() <= 1e-6 * a.abs() && (from_a - from_b).abs() <= 1e-3 * a.abs()
        }
        (TimeAxis::Times(a), TimeAxis::Times(b)) => a == b,
        _ => false,
    }
}

/// Appends numbers to names that occur more than once.
pub(crate) fn number_repeated_names(channels: &mut [RawChannel]) {
    let mut taken = HashSet::new();
    // The next number of each name: all smaller ones are taken.
    let mut next: HashMap<String, usize> = HashMap::new();
    for channel in channels {
        if !taken.insert(channel.name.clone()) {
            let number = next.entry(channel.name.clone()).or_insert(2);
            let mut name = format!("{} ({number})", channel.name);
            while !taken.insert(name.clone()) {
                *number += 1;
                name = format!("{} ({number})", channel.name);
            }
            *number += 1;
            channel.name = name;
        }
    }
}
