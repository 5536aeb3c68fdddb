//! `hammerbeam signal spectrum`: amplitudes, power or density over frequency, and lines.

use hammerbeam_results::export::{Table, header, number};
use hammerbeam_signal::{
    Channel, Record,
    spectrum::{
        Detrend, FrequencySpectrum, Scaling, SpectralLine, WelchSettings, Window, amplitude_spectrum, welch,
    },
};
use serde_json::json;

use super::input::{self, Input, named, unit};
use crate::{
    failure::Failure,
    output::Output,
    signal_args::{DetrendName, SpectrumKind, SpectrumOptions, WindowName},
};

/// Bins within which only the highest line counts: half the width of the widest main lobe but one.
const APART: usize = 3;

pub fn run(options: &SpectrumOptions, output: Output) -> Result<(), Failure> {
    let input = input::open(&options.input, None)?;
    let channel = input.channel();
    let spectrum = spectrum(&input.record, channel, options)?;
    let lines = spectrum.lines(options.lines, APART);
    let path = write(&spectrum, options)?;
    let root_mean_square = root_mean_square(&channel.samples);
    let mut document = input.document();
    document["channel"] = json!(channel.name);
    document["kind"] = json!(key(options.kind));
    document["value_unit"] = json!(value_unit(channel, options.kind));
    document["frequency_step_hz"] = json!(spectrum.step_hz);
    document["root_mean_square"] = json!(root_mean_square);
    document["lines"] =
        lines.iter().map(|line| json!({ "frequency_hz": line.frequency_hz, "value": line.value })).collect();
    document["results"] = json!(path);
    output.give(&document, || text(&input, (&spectrum, &lines), options, path.as_deref()))?;
    Ok(())
}

fn spectrum(
    record: &Record,
    channel: &Channel,
    options: &SpectrumOptions,
) -> Result<FrequencySpectrum, Failure> {
    let window = match options.window {
        WindowName::Rectangular => Window::Rectangular,
        WindowName::Hann => Window::Hann,
        WindowName::Hamming => Window::Hamming,
        WindowName::Blackman => Window::Blackman,
        WindowName::FlatTop => Window::FlatTop,
    };
    let scaling = match options.kind {
        SpectrumKind::Amplitude => {
            return Ok(amplitude_spectrum(&channel.samples, record.sampling_rate_hz, window)?);
        }
        SpectrumKind::Density => Scaling::Density,
        SpectrumKind::Power => Scaling::Power,
    };
    let segment = options.segment.map_or((record.len() / 8).max(2), |segment| segment as usize);
    let settings = WelchSettings {
        segment,
        overlap: (segment as f64 * options.overlap) as usize,
        window,
        scaling,
        detrend: match options.detrend {
            DetrendName::None => Detrend::None,
            DetrendName::Constant => Detrend::Constant,
            DetrendName::Linear => Detrend::Linear,
        },
    };
    Ok(welch(&channel.samples, record.sampling_rate_hz, &settings)?)
}

const fn key(kind: SpectrumKind) -> &'static str {
    match kind {
        SpectrumKind::Amplitude => "amplitude",
        SpectrumKind::Density => "density",
        SpectrumKind::Power => "power",
    }
}

fn value_unit(channel: &Channel, kind: SpectrumKind) -> Option<String> {
    let unit = unit(channel)?;
    Some(match kind {
        SpectrumKind::Amplitude => unit.to_owned(),
        SpectrumKind::Density => format!("({unit})^2/Hz"),
        SpectrumKind::Power => format!("({unit})^2"),
    })
}

/// About the mean.
fn root_mean_square(samples: &[f64]) -> f64 {
    let count = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / count;
    (samples.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt()
}

fn write(spectrum: &FrequencySpectrum, options: &SpectrumOptions) -> Result<Option<String>, Failure> {
    let Some(folder) = &options.out else { return Ok(None) };
    let mut table = Table::begin(folder, "spectrum.csv", &header(&["frequency_hz", key(options.kind)]))?;
    for (index, value) in spectrum.values.iter().enumerate() {
        table.row(&[number(spectrum.frequency_hz(index)), number(*value)])?;
    }
    Ok(Some(table.finish()?.display().to_string()))
}

fn text(
    input: &Input,
    (spectrum, lines): (&FrequencySpectrum, &[SpectralLine]),
    options: &SpectrumOptions,
    path: Option<&str>,
) -> String {
    let channel = input.channel();
    let unit = value_unit(channel, options.kind).unwrap_or_default();
    let mut text = vec![input.heading()];
    text.push(format!(
        "{} of {}, one value each {:.6} Hz",
        key(options.kind),
        named(channel),
        spectrum.step_hz
    ));
    text.push("highest lines:".to_owned());
    for line in lines {
        text.push(format!("  {:>14.6} Hz  {:.6e} {unit}", line.frequency_hz, line.value));
    }
    text.extend(path.map(|path| format!("{path}: the whole spectrum")));
    text.extend(input.notes());
    text.join("\n")
}
