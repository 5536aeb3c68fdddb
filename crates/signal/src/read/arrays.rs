//! Channels, time and sampling rate among named arrays.
//!
//! * A single number named `fs`, `sampling_rate`, `rate`, ... is the sampling rate, one named `dt`, `ts`, ...
//!   the step.
//! * A vector is a channel. A matrix holds channels along its shorter side; `x[1]`, `x[2]`, ...
//! * A vector named like a time, or with a name that ends in a unit of time, is the time of all channels.
//! * Without any of these, the first column of a matrix is the time if it rises evenly (a finding reports
//!   it).
//! * Complex channels become two.

use super::time::{compare_rates, rises_evenly, time_column};
use crate::{
    error::ReadError,
    finding::RecordFinding,
    raw::{RawChannel, RawRecord, TimeAxis, TimeColumn, number_repeated_names},
    title::split_title,
};

/// An array of numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Array {
    pub name: String,
    /// Its side lengths; empty for a single number.
    pub shape: Vec<usize>,
    /// Entries, the first index running fastest.
    pub real: Vec<f64>,
    /// Imaginary parts of complex numbers.
    pub imaginary: Option<Vec<f64>>,
}

/// A record from the arrays of a file.
pub(super) fn arrange(arrays: Vec<Array>, mut findings: Vec<RecordFinding>) -> Result<RawRecord, ReadError> {
    let (numbers, arrays): (Vec<Array>, Vec<Array>) =
        arrays.into_iter().partition(|array| array.real.len() == 1);
    let step = step_of(&numbers, &mut findings)?;
    let mut channels: Vec<RawChannel> = arrays.iter().flat_map(|array| split(array, &mut findings)).collect();
    number_repeated_names(&mut channels);
    let time = take_time(&mut channels, step.is_none(), &mut findings);
    let axis = match (&time, step) {
        (Some(TimeColumn { channel, .. }), _) => {
            let (times, _) = channel.times();
            compare_rates(step.map(|step| 1.0 / step), &times, &mut findings);
            TimeAxis::Times(times)
        }
        (None, Some(step_s)) => TimeAxis::Even { step_s, start_s: 0.0 },
        (None, None) => TimeAxis::Unknown,
    };
    if channels.is_empty() {
        return Err(ReadError::NoNumbers);
    }
    Ok(RawRecord { time, ..RawRecord::single(axis, channels, findings) })
}

/// The step given by single numbers [s].
fn step_of(numbers: &[Array], findings: &mut Vec<RecordFinding>) -> Result<Option<f64>, ReadError> {
    let mut step: Option<f64> = None;
    for number in numbers {
        let value = number.real[0];
        let name = number.name.rsplit('.').next().unwrap_or_default().to_lowercase();
        let bare = name.strip_suffix("_hz").or_else(|| name.strip_suffix("_s")).unwrap_or(&name);
        let found = match bare {
            "fs" | "f_s" | "rate" | "sampling_rate" | "samplingrate" | "sample_rate" | "samplerate"
            | "sampling_frequency" | "sample_frequency" | "fsample" => 1.0 / value,
            "dt" | "delta_t" | "deltat" | "t_s" | "sampling_period" | "sample_period" | "step" => value,
            "ts" => value,
            _ => {
                let reason = "a single number that is neither a sampling rate nor a step".to_owned();
                findings.push(RecordFinding::LeftOut { name: number.name.clone(), reason });
                continue;
            }
        };
        if let Some(other) = step.filter(|other| (other / found - 1.0).abs() > 1e-6) {
            return Err(ReadError::TwoRates { first: 1.0 / other, second: 1.0 / found });
        }
        step = Some(found);
    }
    Ok(step)
}

/// Channels of an array.
fn split(array: &Array, findings: &mut Vec<RecordFinding>) -> Vec<RawChannel> {
    let sides: Vec<usize> = array.shape.iter().copied().filter(|side| *side != 1).collect();
    let (name, unit) = split_title(&array.name);
    let parts: Vec<(&str, &[f64])> = match &array.imaginary {
        None => vec![("", &array.real)],
        Some(imaginary) => vec![(" (real)", &array.real), (" (imaginary)", imaginary)],
    };
    let channel = |label: String, samples: Vec<f64>| RawChannel { name: label, unit: unit.clone(), samples };
    match sides[..] {
        [] | [0] => Vec::new(),
        [_] => parts.iter().map(|(part, values)| channel(format!("{name}{part}"), values.to_vec())).collect(),
        [rows, columns] => {
            let (count, along) = if rows >= columns { (columns, 1) } else { (rows, rows) };
            let length = rows.max(columns);
            let start = |k: usize| if rows >= columns { k * rows } else { k };
            (0..count)
                .flat_map(|k| parts.iter().map(move |part| (k, part)))
                .map(|(k, (part, values))| {
                    let samples = (0..length).map(|i| values[start(k) + i * along]).collect();
                    channel(format!("{name}[{}]{part}", k + 1), samples)
                })
                .collect()
        }
        _ => {
            let reason = format!("an array of {} dimensions", sides.len());
            findings.push(RecordFinding::LeftOut { name: array.name.clone(), reason });
            Vec::new()
        }
    }
}

/// Moves the time out of the channels.
///
/// * `search`: whether an untitled column that rises evenly counts.
fn take_time(
    channels: &mut Vec<RawChannel>,
    search: bool,
    findings: &mut Vec<RecordFinding>,
) -> Option<TimeColumn> {
    // Of the name of a structure's field the last word counts.
    let titles: Vec<(&str, Option<&str>)> = channels
        .iter()
        .map(|channel| (channel.name.rsplit('.').next().unwrap_or_default(), channel.unit.as_deref()))
        .collect();
    if let Some(index) = time_column(&titles) {
        let channel = channels.remove(index);
        findings.extend(channel.times().1);
        return Some(TimeColumn { channel, index });
    }
    if search && channels.len() > 1 && rises_evenly(&channels[0].samples) {
        findings.push(RecordFinding::TimeAssumed);
        return Some(TimeColumn { channel: channels.remove(0), index: 0 });
    }
    None
}
