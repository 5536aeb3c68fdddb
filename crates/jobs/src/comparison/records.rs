//! Records of single excitation frequencies, reduced to points: the kind of the motion, and the largest value
//! of each quantity.

use std::path::Path;

use hammerbeam_signal::{
    Channel, Finding, Quantity, Record, SignalError, Terms,
    classify::{ClassifySettings, Motion, classify, excitation_frequency},
    points::{Kind, Maxima, MeasuredPoint},
    read::read_raw,
    spectrum::{Window, amplitude_spectrum},
};

use super::{course::largest, measured::MeasuredError};

/// Whether a file can be read as a time series with times or a rate.
pub(super) fn looks_like_record(path: &Path) -> bool {
    read_raw(path).is_ok_and(|(raw, _)| raw.judge(&Terms::default()).is_ok())
}

/// Reduces a record.
///
/// * `reference`: the channel that is excited.
pub(super) fn reduce(
    path: &Path,
    reference: Option<&str>,
) -> Result<(MeasuredPoint, Vec<Finding>), MeasuredError> {
    let of_record = |source: SignalError| MeasuredError::Record { path: path.to_owned(), source };
    let (raw, _) = read_raw(path).map_err(of_record)?;
    let reference = reference.map(|text| raw.channel_name(text).map(str::to_owned)).transpose();
    let reference = reference.map_err(SignalError::from).map_err(of_record)?;
    let record = raw.judge(&Terms::default()).map_err(SignalError::from).map_err(of_record)?;
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
        let measured = [Quantity::Displacement, Quantity::Velocity, Quantity::Acceleration, Quantity::Force];
        Some(*index) != reference && measured.contains(&channel.quantity)
    };
    let mut maxima = Maxima::default();
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
        Motion::Periodic { period_multiple } => {
            Kind::Periodic { period_multiple: Some(period_multiple as u32) }
        }
        Motion::Aperiodic => Kind::Aperiodic,
        Motion::Doubtful { .. } => Kind::Doubtful,
    };
    let excitation = reference
        .map(|index| &record.channels[index])
        .filter(|channel| channel.quantity != Quantity::Other)
        .map(|channel| amplitude(channel, record.sampling_rate_hz))
        .transpose()?;
    let origin = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    Ok(Some(MeasuredPoint { origin, frequency_hz: found.frequency_hz, maxima, kind, excitation }))
}

/// Amplitude of the strongest line, by the flat-top window, which reads amplitudes to 0.1 %.
fn amplitude(channel: &Channel, sampling_rate_hz: f64) -> Result<(Quantity, f64), SignalError> {
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
