//! From what a file says to a record: is the sampling even, is anything missing, is anything suspicious?
//!
//! What makes a record unusable is a [`RecordError`], unless [`Repairs`] allows to mend it; then it is a
//! [`Finding`]. What is only suspicious is a finding always.
//!
//! | file | what it looks at |
//! |---|---|
//! | `times.rs` | order, repeated times, gaps, jitter; the even grid |
//! | `missing.rs` | samples that are no number |
//! | `clipping.rs` | flat tops, constant channels |

mod clipping;
mod missing;
mod times;

use crate::{
    finding::{Finding, Repairs},
    limits::{LARGEST_SAMPLE, MOST_SAMPLES, SMALLEST_SAMPLE},
    raw::{Axis, RawChannel, RawGroup, RawRecord},
    record::{Channel, Record},
    unit::{Quantity, unit},
};

/// Why what is in a file is no usable record.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum RecordError {
    /// Nothing in the file is a series.
    #[error("there is no channel with samples in it")]
    Empty,
    /// A channel that is asked for is not there.
    #[error("there is no channel \"{name}\"; there are: {names}")]
    NoSuchChannel { name: String, names: String },
    /// Neither the file nor the user says how fast it was sampled.
    #[error("the file does not say the sampling rate")]
    NoSamplingRate,
    /// A step or rate that is none.
    #[error("the step between samples is {step_s} s, must be a finite number more than 0")]
    Step { step_s: f64 },
    /// Channels were sampled at different times.
    #[error("the channels were not sampled together: {groups}")]
    DifferentSampling { groups: String },
    /// Channels do not have the same length.
    #[error("channels have unequal lengths: {lengths}")]
    UnequalLengths { lengths: String },
    /// Samples that are no numbers.
    #[error("channel \"{channel}\" misses {count} of {of} samples, the first is sample {first}")]
    Missing { channel: String, count: usize, of: usize, first: usize },
    /// Samples of which squares cannot be had.
    #[error(
        "the largest sample of channel \"{channel}\" is {found:e} in magnitude, must be 0 or from {SMALLEST_SAMPLE:e} to {LARGEST_SAMPLE:e}"
    )]
    Magnitude { channel: String, found: f64 },
    /// Gaps that are too long to be filled.
    #[error("filled up the record would have {samples:e} samples, at most {MOST_SAMPLES} are worked with")]
    TooLong { samples: f64 },
    /// Times that are no numbers.
    #[error("{count} times are missing, the first is that of sample {first}")]
    TimeMissing { count: usize, first: usize },
    /// Time runs back.
    #[error("time runs back {count} times, first at sample {first} ({time_s} s)")]
    TimeDecreases { count: usize, first: usize, time_s: f64 },
    /// The same time twice.
    #[error("{count} samples have the time of the one before, first sample {first} ({time_s} s)")]
    DuplicateTimes { count: usize, first: usize, time_s: f64 },
    /// Samples are left out.
    #[error(
        "there are {count} gaps, the first after {time_s} s, the longest {} s at a step of {} s", difference(*longest_s), difference(*step_s)
    )]
    Gaps { count: usize, time_s: f64, longest_s: f64, step_s: f64 },
    /// The step changes.
    #[error("sampling is uneven: times stray by up to {percent:.0} % of a step of {} s", difference(*step_s))]
    Uneven { percent: f64, step_s: f64 },
}

/// A difference of times to six digits: the others are rounding of the times.
pub(crate) fn difference(seconds: f64) -> f64 {
    format!("{seconds:.5e}").parse().unwrap_or(seconds)
}

/// What the user says about a record beside what is in it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Terms {
    /// Sampling rate [Hz]; the times in the file are not used then.
    pub sampling_rate_hz: Option<f64>,
    /// What may be repaired.
    pub repairs: Repairs,
    /// Names or numbers (from 1 on, in the order of the file) of channels to keep; all if empty. The rest is
    /// not judged.
    pub channels: Vec<String>,
}

impl RawRecord {
    /// Judges what was read.
    ///
    /// # Errors
    /// Each way in which it is unusable and not allowed to be repaired: [`RecordError`].
    pub fn judge(self, terms: &Terms) -> Result<Record, RecordError> {
        let name = |text: &String| self.channel_name(text).map(str::to_owned);
        let wanted = terms.channels.iter().map(name).collect::<Result<Vec<String>, RecordError>>()?;
        let mut findings = self.findings;
        let group = one_group(self.groups, &wanted, terms)?;
        let (axis, channels) = equal_lengths(group, terms, &mut findings)?;
        let (grid, mut channels) = times::even(axis, channels, terms, &mut findings)?;
        for channel in &mut channels {
            missing::fill(channel, &terms.repairs, &mut findings)?;
            clipping::look(channel, &mut findings);
        }
        let channels: Vec<Channel> =
            channels.into_iter().map(|channel| in_si(channel, &mut findings)).collect();
        channels.iter().try_for_each(ensure_magnitude)?;
        Ok(Record { sampling_rate_hz: 1.0 / grid.step_s, start_s: grid.start_s, channels, findings })
    }
}

/// The channels that are wanted (all if none is named); they have to belong together.
fn one_group(groups: Vec<RawGroup>, wanted: &[String], terms: &Terms) -> Result<RawGroup, RecordError> {
    let wanted = |name: &String| wanted.is_empty() || wanted.contains(name);
    let mut kept: Vec<RawGroup> = Vec::new();
    for RawGroup { axis, mut channels } in groups {
        channels.retain(|channel| wanted(&channel.name) && !channel.samples.is_empty());
        if !channels.is_empty() {
            kept.push(RawGroup { axis, channels });
        }
    }
    match kept.len() {
        0 => Err(RecordError::Empty),
        // With a rate of the user's the times in the file do not tell groups apart.
        _ if terms.sampling_rate_hz.is_some() => {
            let axis = kept[0].axis.clone();
            Ok(RawGroup { axis, channels: kept.into_iter().flat_map(|group| group.channels).collect() })
        }
        1 => Ok(kept.remove(0)),
        _ => Err(RecordError::DifferentSampling { groups: describe(&kept) }),
    }
}

fn describe(groups: &[RawGroup]) -> String {
    let one = |group: &RawGroup| {
        let names: Vec<&str> = group.channels.iter().map(|channel| channel.name.as_str()).collect();
        let sampling = match &group.axis {
            Axis::Unknown => "rate unknown".to_owned(),
            Axis::Even { step_s, start_s } => format!("{} Hz from {start_s} s", 1.0 / step_s),
            Axis::Times(times) => format!("times of its own, {} samples", times.len()),
        };
        format!("{} ({sampling})", names.join(" + "))
    };
    groups.iter().map(one).collect::<Vec<_>>().join("; ")
}

/// The times count as a channel, unless the rate is given.
fn equal_lengths(
    mut group: RawGroup,
    terms: &Terms,
    findings: &mut Vec<Finding>,
) -> Result<(Axis, Vec<RawChannel>), RecordError> {
    let times = match &group.axis {
        Axis::Times(times) if terms.sampling_rate_hz.is_none() => Some(times.len()),
        _ => None,
    };
    let lengths = || times.into_iter().chain(group.channels.iter().map(|channel| channel.samples.len()));
    let (shortest, longest) = (lengths().min().unwrap_or(0), lengths().max().unwrap_or(0));
    if shortest == longest {
        return Ok((group.axis, group.channels));
    }
    if !terms.repairs.lengths {
        let text = |channel: &RawChannel| format!("{} {}", channel.name, channel.samples.len());
        let all =
            times.map(|length| format!("time {length}")).into_iter().chain(group.channels.iter().map(text));
        return Err(RecordError::UnequalLengths { lengths: all.collect::<Vec<_>>().join(", ") });
    }
    if let Axis::Times(times) = &mut group.axis {
        times.truncate(shortest);
    }
    group.channels.iter_mut().for_each(|channel| channel.samples.truncate(shortest));
    findings.push(Finding::Shortened { length: shortest, longest });
    Ok((group.axis, group.channels))
}

fn ensure_magnitude(channel: &Channel) -> Result<(), RecordError> {
    let found = channel.samples.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    if found == 0.0 || (SMALLEST_SAMPLE..=LARGEST_SAMPLE).contains(&found) {
        return Ok(());
    }
    Err(RecordError::Magnitude { channel: channel.name.clone(), found })
}

fn in_si(channel: RawChannel, findings: &mut Vec<Finding>) -> Channel {
    let RawChannel { name, unit: text, mut samples } = channel;
    let known = text.as_deref().and_then(unit);
    if let Some(known) = known {
        if known.factor != 1.0 {
            samples.iter_mut().for_each(|value| *value *= known.factor);
        }
    } else if let Some(text) = &text
        && !text.is_empty()
    {
        findings.push(Finding::UnknownUnit { channel: name.clone(), unit: text.clone() });
    }
    Channel { name, unit: text, quantity: known.map_or(Quantity::Other, |known| known.quantity), samples }
}

#[cfg(test)]
mod tests;
