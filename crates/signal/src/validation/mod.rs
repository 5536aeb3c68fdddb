//! From the content of a file to a record: is the sampling even, is anything missing or suspicious?
//!
//! A fault that makes a record unusable is a [`RecordError`], unless [`Repairs`](crate::Repairs) permits its
//! repair; then it is a [`RecordFinding`]. A suspicion is always a finding.
//!
//! | file | what it checks |
//! |---|---|
//! | `options.rs` | what the user specifies and permits |
//! | `times.rs` | order, repeated times, gaps, jitter; the even grid |
//! | `missing.rs` | samples that are not numbers |
//! | `clipping.rs` | flat tops, constant channels |

mod clipping;
mod missing;
mod options;
mod times;

pub use options::RecordOptions;

use crate::{
    error::RecordError,
    finding::RecordFinding,
    limits::{LARGEST_SAMPLE, SMALLEST_SAMPLE},
    raw::{RawChannel, RawGroup, RawRecord, TimeAxis},
    record::{Channel, Record},
    unit::{MeasuredQuantity, unit},
};

impl RawRecord {
    /// Validates the content of a file as a record in SI units.
    ///
    /// # Errors
    /// [`RecordError`] for each fault that is not permitted to be repaired.
    pub fn validate(self, options: &RecordOptions) -> Result<Record, RecordError> {
        let name = |text: &String| self.channel_name(text).map(str::to_owned);
        let wanted = options.channels.iter().map(name).collect::<Result<Vec<String>, RecordError>>()?;
        let mut findings = self.findings;
        let group = one_group(self.groups, &wanted, options)?;
        let (axis, channels) = equal_lengths(group, options, &mut findings)?;
        let (grid, mut channels) = times::to_even_grid(axis, channels, options, &mut findings)?;
        for channel in &mut channels {
            missing::fill(channel, &options.repairs, &mut findings)?;
            clipping::detect(channel, &mut findings);
        }
        let channels: Vec<Channel> =
            channels.into_iter().map(|channel| in_si(channel, &mut findings)).collect();
        channels.iter().try_for_each(ensure_magnitude)?;
        Ok(Record { sampling_rate_hz: 1.0 / grid.step_s, start_s: grid.start_s, channels, findings })
    }
}

/// The requested channels (all if none is named), which must share one time axis.
fn one_group(
    groups: Vec<RawGroup>,
    wanted: &[String],
    options: &RecordOptions,
) -> Result<RawGroup, RecordError> {
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
        // With a rate given by the user the times in the file are irrelevant.
        _ if options.sampling_rate_hz.is_some() => {
            let axis = kept[0].axis.clone();
            Ok(RawGroup { axis, channels: kept.into_iter().flat_map(|group| group.channels).collect() })
        }
        1 => Ok(kept.remove(0)),
        _ => Err(RecordError::DifferentSampling { groups: describe(&kept) }),
    }
}

/// Time axes that a message names.
const MOST_SHOWN: usize = 20;

fn describe(groups: &[RawGroup]) -> String {
    let one = |group: &RawGroup| {
        let names: Vec<&str> = group.channels.iter().map(|channel| channel.name.as_str()).collect();
        let sampling = match &group.axis {
            TimeAxis::Unknown => "rate unknown".to_owned(),
            TimeAxis::Even { step_s, start_s } => format!("{} Hz from {start_s} s", 1.0 / step_s),
            TimeAxis::Times(times) => format!("times of its own, {} samples", times.len()),
        };
        format!("{} ({sampling})", names.join(" + "))
    };
    let shown: Vec<String> = groups.iter().take(MOST_SHOWN).map(one).collect();
    let more = groups.len().saturating_sub(MOST_SHOWN);
    if more > 0 { format!("{}; and {more} more", shown.join("; ")) } else { shown.join("; ") }
}

/// Channels cut to one length, if permitted; times count as a channel unless the rate is given.
fn equal_lengths(
    mut group: RawGroup,
    options: &RecordOptions,
    findings: &mut Vec<RecordFinding>,
) -> Result<(TimeAxis, Vec<RawChannel>), RecordError> {
    let times = match &group.axis {
        TimeAxis::Times(times) if options.sampling_rate_hz.is_none() => Some(times.len()),
        _ => None,
    };
    let lengths = || times.into_iter().chain(group.channels.iter().map(|channel| channel.samples.len()));
    let (shortest, longest) = (lengths().min().unwrap_or(0), lengths().max().unwrap_or(0));
    if shortest == longest {
        return Ok((group.axis, group.channels));
    }
    if !options.repairs.lengths {
        let text = |channel: &RawChannel| format!("{} {}", channel.name, channel.samples.len());
        let all =
            times.map(|length| format!("time {length}")).into_iter().chain(group.channels.iter().map(text));
        return Err(RecordError::UnequalLengths { lengths: all.collect::<Vec<_>>().join(", ") });
    }
    if let TimeAxis::Times(times) = &mut group.axis {
        times.truncate(shortest);
    }
    group.channels.iter_mut().for_each(|channel| channel.samples.truncate(shortest));
    findings.push(RecordFinding::Shortened { length: shortest, longest });
    Ok((group.axis, group.channels))
}

fn ensure_magnitude(channel: &Channel) -> Result<(), RecordError> {
    let found = channel.samples.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    if found == 0.0 || (SMALLEST_SAMPLE..=LARGEST_SAMPLE).contains(&found) {
        return Ok(());
    }
    Err(RecordError::Magnitude { channel: channel.name.clone(), found })
}

fn in_si(channel: RawChannel, findings: &mut Vec<RecordFinding>) -> Channel {
    let RawChannel { name, unit: text, mut samples } = channel;
    let known = text.as_deref().and_then(unit);
    if let Some(known) = known {
        if known.factor != 1.0 {
            samples.iter_mut().for_each(|value| *value *= known.factor);
        }
    } else if let Some(text) = &text
        && !text.is_empty()
    {
        findings.push(RecordFinding::UnknownUnit { channel: name.clone(), unit: text.clone() });
    }
    Channel {
        name,
        unit: text,
        quantity: known.map_or(MeasuredQuantity::Other, |known| known.quantity),
        samples,
    }
}

#[cfg(test)]
mod tests;
