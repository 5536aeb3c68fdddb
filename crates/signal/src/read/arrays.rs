//! Which of named arrays are channels, which is the time, which the sampling rate.
//!
//! * A single number named `fs`, `sampling_rate`, `rate`, ... is the sampling rate, one named `dt`, `ts`, ...
//!   the step.
//! * A vector is a channel. A matrix holds channels along its shorter side; `x[1]`, `x[2]`, ...
//! * A vector whose name is that of a time, or whose name ends in a unit of time, is the time of all of them.
//! * Without any of these, a matrix whose first column rises evenly holds the time there (told as a finding).
//! * Complex channels become two.

use crate::{
    finding::Finding,
    raw::{Axis, RawChannel, RawRecord, TimeColumn},
    read::{
        ReadError,
        csv::unique,
        time::{compare_rates, rises_evenly, time_column},
    },
    unit::split_title,
};

/// An array of numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Array {
    pub name: String,
    /// Its sides; none for a single number.
    pub shape: Vec<usize>,
    /// Entries, the first index running fastest.
    pub real: Vec<f64>,
    /// Imaginary parts of complex numbers.
    pub imaginary: Option<Vec<f64>>,
}

pub(super) fn arrange(arrays: Vec<Array>, mut findings: Vec<Finding>) -> Result<RawRecord, ReadError> {
    let (numbers, arrays): (Vec<Array>, Vec<Array>) =
        arrays.into_iter().partition(|array| array.real.len() == 1);
    let step = step_of(&numbers, &mut findings)?;
    let mut channels: Vec<RawChannel> = arrays.iter().flat_map(|array| split(array, &mut findings)).collect();
    unique(&mut channels);
    let time = take_time(&mut channels, step.is_none(), &mut findings);
    let axis = match (&time, step) {
        (Some(TimeColumn { channel, .. }), _) => {
            let (times, _) = channel.times();
            compare_rates(step.map(|step| 1.0 / step), &times, &mut findings);
            Axis::Times(times)
        }
        (None, Some(step_s)) => Axis::Even { step_s, start_s: 0.0 },
        (None, None) => Axis::Unknown,
    };
    if channels.is_empty() {
        return Err(ReadError::NoNumbers);
    }
    Ok(RawRecord { time, ..RawRecord::single(axis, channels, findings) })
}

/// The step that single numbers name [s].
fn step_of(numbers: &[Array], findings: &mut Vec<Finding>) -> Result<Option<f64>, ReadError> {
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
                findings.push(Finding::LeftOut { name: number.name.clone(), reason });
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
fn split(array: &Array, findings: &mut Vec<Finding>) -> Vec<RawChannel> {
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
            findings.push(Finding::LeftOut { name: array.name.clone(), reason });
            Vec::new()
        }
    }
}

/// Takes the time out of the channels.
fn take_time(
    channels: &mut Vec<RawChannel>,
    search: bool,
    findings: &mut Vec<Finding>,
) -> Option<TimeColumn> {
    // Of a field of a structure the last word counts.
    let kinds: Vec<(&str, Option<&str>)> = channels
        .iter()
        .map(|channel| (channel.name.rsplit('.').next().unwrap_or_default(), channel.unit.as_deref()))
        .collect();
    if let Some(place) = time_column(&kinds) {
        let channel = channels.remove(place);
        findings.extend(channel.times().1);
        return Some(TimeColumn { channel, place });
    }
    if search && channels.len() > 1 && rises_evenly(&channels[0].samples) {
        findings.push(Finding::TimeAssumed);
        return Some(TimeColumn { channel: channels.remove(0), place: 0 });
    }
    None
}
