//! The record that a command works on, and what is said about it.

use hammerbeam_figure::plain_number;
use hammerbeam_results::export::word;
use hammerbeam_signal::{
    Channel, MeasuredQuantity, Record, RecordError, RecordFinding, RecordFormat, RecordOptions, Repairs,
    SignalError,
    filter::{Band, DigitalFilter, butterworth},
    read::read_raw,
};
use serde_json::{Value, json};

use crate::{
    failure::Failure,
    signal_args::{BandOptions, InputOptions, Repair},
};

/// A record with where it is from.
pub struct Input {
    pub record: Record,
    channel: usize,
    reference: Option<usize>,
    format: RecordFormat,
    file: String,
}

/// Reads and judges a file.
///
/// * `reference`: a channel that is wanted besides those the user names.
pub fn open(options: &InputOptions, reference: Option<&str>) -> Result<Input, Failure> {
    let (mut raw, format) = read_raw(&options.file)?;
    if let Some(time) = &options.time {
        raw = raw.with_time(time).map_err(SignalError::from)?;
    }
    let name = |text: &str| raw.channel_name(text).map(str::to_owned).map_err(SignalError::from);
    let chosen = options.channel.iter().map(|text| name(text)).collect::<Result<Vec<_>, _>>()?;
    let reference = reference.map(name).transpose()?;
    let channels =
        if chosen.is_empty() { Vec::new() } else { chosen.iter().chain(&reference).cloned().collect() };
    let terms = RecordOptions { sampling_rate_hz: options.rate, repairs: repairs(&options.repair), channels };
    let record = raw.validate(&terms).map_err(with_hint)?;
    let record = if options.from.is_some() || options.to.is_some() {
        record.part(options.from.unwrap_or(f64::NEG_INFINITY), options.to.unwrap_or(f64::INFINITY))?
    } else {
        record
    };
    let index = |name: &String| record.find(name).map_err(SignalError::from);
    let reference = reference.as_ref().map(index).transpose()?;
    let channel = match chosen.first() {
        Some(name) => index(name)?,
        None => usual_channel(&record.channels, reference),
    };
    Ok(Input { record, channel, reference, format, file: options.file.display().to_string() })
}

/// The first channel of a motion or a force; if no unit says so, the first that is not the reference.
fn usual_channel(channels: &[Channel], reference: Option<usize>) -> usize {
    let free = |index: &usize| Some(*index) != reference;
    let moves = |index: &usize| {
        let quantity = channels[*index].quantity;
        matches!(
            quantity,
            MeasuredQuantity::Displacement
                | MeasuredQuantity::Velocity
                | MeasuredQuantity::Acceleration
                | MeasuredQuantity::Force
        )
    };
    let mut indices = (0..channels.len()).filter(free);
    indices.clone().find(moves).or_else(|| indices.next()).unwrap_or(0)
}

fn repairs(allowed: &[Repair]) -> Repairs {
    let allows = |repair: Repair| allowed.contains(&repair);
    Repairs {
        missing: allows(Repair::Missing),
        gaps: allows(Repair::Gaps),
        uneven: allows(Repair::Uneven),
        duplicates: allows(Repair::Duplicates),
        order: allows(Repair::Order),
        lengths: allows(Repair::Lengths),
    }
}

/// A refusal, with the option that helps.
fn with_hint(error: RecordError) -> Failure {
    let hint = match &error {
        RecordError::NoSamplingRate => "give it with --rate, or the column of the time with --time",
        RecordError::DifferentSampling { .. } => "choose channels of one group with --channel",
        RecordError::UnequalLengths { .. } => "--repair lengths cuts them to the shortest",
        RecordError::Missing { .. } => "--repair missing interpolates them",
        RecordError::TimeMissing { .. } => "with --rate the times in the file are not used",
        RecordError::TimeDecreases { .. } => "--repair order sorts by time",
        RecordError::DuplicateTimes { .. } => {
            "if the times are rounded, give the sampling rate with --rate; --repair duplicates drops the \
            samples"
        }
        RecordError::Gaps { .. } => "--repair gaps fills them by interpolation",
        RecordError::Uneven { .. } => "--repair uneven interpolates to an even grid",
        _ => return SignalError::from(error).into(),
    };
    Failure::BadInput(format!("{error}\nhelp: {hint}"))
}

impl Input {
    /// The channel a command works on.
    pub fn channel(&self) -> &Channel {
        &self.record.channels[self.channel]
    }

    /// The reference, if one was named.
    pub fn reference(&self) -> Option<&Channel> {
        self.reference.map(|index| &self.record.channels[index])
    }

    /// What is said of the record in every document.
    pub fn document(&self) -> Value {
        let channel = |channel: &Channel| {
            json!({
                "name": channel.name,
                "quantity": channel.quantity.word(),
                "unit": unit(channel),
                "unit_in_file": channel.unit,
            })
        };
        json!({
            "file": self.file,
            "format": self.format.word(),
            "sampling_rate_hz": self.record.sampling_rate_hz,
            "start_s": self.record.start_s,
            "samples": self.record.len(),
            "duration_s": self.record.duration_s(),
            "channels": self.record.channels.iter().map(channel).collect::<Vec<_>>(),
            "findings": findings(&self.record),
        })
    }

    /// What is said of the record before the result.
    pub fn heading(&self) -> String {
        let record = &self.record;
        format!(
            "{} ({}): {} samples at {} Hz, {} s from {} s on",
            self.file,
            self.format.word(),
            record.len(),
            plain_number(record.sampling_rate_hz),
            plain_number(record.duration_s()),
            plain_number(record.start_s),
        )
    }

    /// Findings, behind the result.
    pub fn notes(&self) -> Vec<String> {
        notes(&self.record)
    }
}

/// Findings about a record, for documents.
pub fn findings(record: &Record) -> Vec<Value> {
    let finding = |finding: &RecordFinding| json!({ "kind": finding.kind(), "channel": finding.channel(), "message": finding.to_string() });
    record.findings.iter().map(finding).collect()
}

/// Findings about a record, for people.
pub fn notes(record: &Record) -> Vec<String> {
    record.findings.iter().map(|finding| format!("note: {finding}")).collect()
}

/// Unit in which a channel's samples are.
pub fn unit(channel: &Channel) -> Option<&str> {
    match channel.quantity {
        MeasuredQuantity::Other => channel.unit.as_deref(),
        quantity => Some(quantity.symbol()),
    }
}

/// A channel with its unit, for people.
pub fn named(channel: &Channel) -> String {
    unit(channel).map_or_else(|| channel.name.clone(), |unit| format!("{} [{unit}]", channel.name))
}

/// Title of a channel's column: its name with the unit as its ending, as all tables have it.
pub fn title(channel: &Channel) -> String {
    match channel.quantity.key() {
        "" => word(&channel.name),
        key => format!("{}_{key}", word(&channel.name)),
    }
}

/// The filter that is asked for, if any.
pub fn filter(
    options: &BandOptions,
    sampling_rate_hz: f64,
) -> Result<Option<(Band, DigitalFilter)>, Failure> {
    let band = match (options.low_pass, options.high_pass) {
        (None, None) => return Ok(None),
        (Some(cut_off_hz), None) => Band::LowPass { cut_off_hz },
        (None, Some(cut_off_hz)) => Band::HighPass { cut_off_hz },
        (Some(high_hz), Some(low_hz)) => Band::BandPass { low_hz, high_hz },
    };
    Ok(Some((band, butterworth(options.order as usize, band, sampling_rate_hz)?)))
}

/// Largest absolute value.
pub fn largest(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |largest, value| largest.max(value.abs()))
}
