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

impl RawChannel {
    /// Its samples as times [s], and what is told if no unit of time says what they are in.
    pub(crate) fn times(&self) -> (Vec<f64>, Option<Finding>) {
        let known = self.unit.as_deref().and_then(unit).filter(|unit| unit.quantity == Quantity::Time);
        let factor = known.map_or(1.0, |unit| unit.factor);
        let told = known.is_none().then(|| Finding::TimeUnitAssumed { name: self.name.clone() });
        (self.samples.iter().map(|value| value * factor).collect(), told)
    }
}

/// The column of the first group that was taken for the time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TimeColumn {
    /// As it is in the file.
    pub channel: RawChannel,
    /// Its place among the columns, from 0 on.
    pub place: usize,
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
    /// The column that was taken for the time.
    pub(crate) time: Option<TimeColumn>,
    /// What was noticed while reading.
    pub findings: Vec<Finding>,
}

impl RawRecord {
    /// A single group.
    #[must_use]
    pub fn single(axis: Axis, channels: Vec<RawChannel>, findings: Vec<Finding>) -> Self {
        Self { groups: vec![RawGroup { axis, channels }], time: None, findings }
    }

    /// With a column as the time, by its name or its number among all columns, from 1 on in the order of the
    /// file. What was taken for the time becomes a channel again, where it stands in the file.
    ///
    /// # Errors
    /// [`RecordError::NoSuchChannel`].
    pub fn with_time(mut self, text: &str) -> Result<Self, RecordError> {
        let before = self.time.take();
        if let (Some(TimeColumn { channel, place }), Some(group)) = (before.clone(), self.groups.first_mut())
        {
            group.channels.insert(place, channel);
        }
        let name = self.channel_name(text)?.to_owned();
        let found = self.groups.iter().enumerate().find_map(|(group, RawGroup { channels, .. })| {
            Some((group, channels.iter().position(|channel| channel.name == name)?))
        });
        let Some((group, place)) = found else { return Ok(self) };
        let channel = self.groups[group].channels.remove(place);
        if before.is_some_and(|before| before.channel == channel) {
            self.time = Some(TimeColumn { channel, place });
            return Ok(self);
        }
        let (times, told) = channel.times();
        self.groups[group].axis = Axis::Times(times);
        let assumed =
            |finding: &Finding| matches!(finding, Finding::TimeAssumed | Finding::TimeUnitAssumed { .. });
        self.findings.retain(|finding| !assumed(finding));
        self.findings.extend(told);
        // Only the first group has a column of times in any format.
        self.time = (group == 0).then_some(TimeColumn { channel, place });
        Ok(self)
    }

    /// Name of a channel that is meant by its name or its number, from 1 on in the order of the file, the
    /// time not counted. A name comes before a number.
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
    /// Steps that differ by less than 1e-6 of themselves are the same: a file in single precision says no
    /// more.
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
