//! Records of single excitation frequencies, reduced to points: the kind of the motion, and the largest value
//! of each quantity.

use std::path::Path;

use hammerbeam_signal::{
    Channel, MeasuredQuantity, Record, RecordFinding, RecordOptions, SignalError,
    classify::{ClassifySettings, MotionClass, classify, excitation_frequency},
    points::{MeasuredKind, MeasuredMaxima, MeasuredPoint},
    read::read_raw,
    spectrum::{Window, amplitude_spectrum},
};

use super::{history::largest, measured_error::MeasuredError};

/// Whether a file can be read as a time series with times or a rate.
pub(super) fn looks_like_record(path: &Path) -> bool {
    read_raw(path).is_ok_and(|(raw, _)| raw.validate(&RecordOptions::default()).is_ok())
}

/// Reduces a record.
///
/// * `reference`: the channel that is excited.
pub(super) fn reduce(
    path: &Path,
    reference: Option<&str>,
) -> Result<(MeasuredPoint, Vec<RecordFinding>), MeasuredError> {
    let of_record = |source: SignalError| MeasuredError::Record { path: path.to_owned(), source };
    let (raw, _) = read_raw(path).map_err(of_record)?;
    let reference = reference.map(|text| raw.channel_name(text).map(str::to_owned)).transpose();
    let reference = reference.map_err(SignalError::from).map_err(of_record)?;
    let record = raw.validate(&RecordOptions::default()).map_err(SignalError::from).map_err(of_record)?;
    let reference = reference.map(|name| record.find(&name)).transpose();
    let reference = reference.map_err(SignalError::from).map_err(of_record)?;
    let frequency_hz = match reference {
        Some(index) => {
            let samples = &record.channels[index].samples;
            excitation_frequency(samples, record.sampling_rate_hz).map_err(of_record)?
        }
        None => {
            frequency_in_name(path).ok_or_else(|| MeasuredError::NoFrequency { path: path.to_owned() })?
        }
    };
    let point = point(path, &record, reference, frequency_hz).map_err(of_record)?;
    let point = point.ok_or_else(|| MeasuredError::NoQuantity { path: path.to_owned() })?;
    Ok((point, record.findings))
}

fn point(
    path: &Path,
    record: &Record,
    reference: Option<usize>,
    frequency_hz: f64,
) -> Result<Option<MeasuredPoint>, SignalError> {
    let answers = |(index, channel): &(usize, &Channel)| {
        let measured = [
            MeasuredQuantity::Displacement,
            MeasuredQuantity::Velocity,
            MeasuredQuantity::Acceleration,
            MeasuredQuantity::Force,
        ];
        Some(*index) != reference && measured.contains(&channel.quantity)
    };
    let mut maxima = MeasuredMaxima::default();
    let mut first: Option<&Channel> = None;
    for (_, channel) in record.channels.iter().enumerate().filter(answers) {
        if maxima.of(channel.quantity).is_none() {
            maxima.set(channel.quantity, largest(&channel.samples));
            first = first.or(Some(channel));
        }
    }
    let Some(first) = first else { return Ok(None) };
    let found =
        classify(&first.samples, record.sampling_rate_hz, frequency_hz, &ClassifySettings::default())?;
    let kind = match found.motion {
        MotionClass::Periodic { period_multiple } => {
            MeasuredKind::Periodic { period_multiple: Some(period_multiple as u32) }
        }
        MotionClass::Aperiodic => MeasuredKind::Aperiodic,
        MotionClass::Doubtful { .. } => MeasuredKind::Doubtful,
    };
    let excitation = reference
        .map(|index| &record.channels[index])
        .filter(|channel| channel.quantity != MeasuredQuantity::Other)
        .map(|channel| amplitude(channel, record.sampling_rate_hz))
        .transpose()?;
    let origin = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    Ok(Some(MeasuredPoint { origin, frequency_hz: found.frequency_hz, maxima, kind, excitation }))
}

/// Amplitude of the strongest line, by the flat-top window, which reads amplitudes to 0.1 %.
fn amplitude(channel: &Channel, sampling_rate_hz: f64) -> Result<(MeasuredQuantity, f64), SignalError> {
    let spectrum = amplitude_spectrum(&channel.samples, sampling_rate_hz, Window::FlatTop)?;
    let line = spectrum.lines(1, 1).first().map_or(0.0, |line| line.value);
    Ok((channel.quantity, line))
}

/// The number before "Hz" in the name of a file, as in `run3_31.5Hz.csv` [Hz].
#[must_use]
pub fn frequency_in_name(path: &Path) -> Option<f64> {
    let name = path.file_stem()?.to_str()?;
    let end = name.to_lowercase().rfind("hz")?;
    let before = name.get(..end)?.trim_end_matches([' ', '_', '-']);
    let start = before.rfind(|c: char| !c.is_ascii_digit() && c != '.').map_or(0, |at| at + 1);
    before.get(start..)?.parse().ok().filter(|frequency: &f64| *frequency > 0.0)
}
