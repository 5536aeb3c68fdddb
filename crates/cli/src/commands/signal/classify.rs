//! `hammerbeam signal classify`: periodic or not, and in which multiple of the excitation period.

use hammerbeam_signal::{
    SignalError,
    classify::{Classification, ClassifySettings, Motion, classify, excitation_frequency},
};
use serde_json::{Value, json};

use super::input::{self, Input, named};
use crate::{failure::Failure, output::Output, signal_args::ClassifyOptions};

pub fn run(options: &ClassifyOptions, output: Output) -> Result<(), Failure> {
    if options.aperiodic_above < options.periodic_below {
        let message = "--aperiodic-above must not be less than --periodic-below";
        return Err(Failure::BadInput(message.to_owned()));
    }
    let reference = options.reference.as_deref();
    let input = input::open(&options.input, &reference.into_iter().collect::<Vec<_>>())?;
    let record = &input.record;
    let (channel, frequency) = match (reference, options.frequency) {
        (Some(name), _) => {
            let at = record.find(name)?;
            let found = excitation_frequency(&record.channels[at].samples, record.sampling_rate_hz)?;
            // Without a choice of the user's: the first channel that is not the reference.
            let other = (0..record.channels.len()).find(|index| *index != at).unwrap_or(at);
            let chosen = options.input.channel.first().map(|name| record.find(name)).transpose()?;
            (chosen.unwrap_or(other), found)
        }
        (None, Some(frequency)) => (0, frequency),
        (None, None) => return Err(SignalError::NoReferenceLine { percent: 0.0 }.into()),
    };
    let settings = ClassifySettings {
        most: options.multiples as usize,
        periodic_below: options.periodic_below,
        aperiodic_above: options.aperiodic_above,
        ..ClassifySettings::default()
    };
    let found = classify(&record.channels[channel].samples, record.sampling_rate_hz, frequency, &settings)?;
    output.give(&document(&input, channel, &found), || text(&input, channel, &found));
    Ok(())
}

const fn word(motion: Motion) -> &'static str {
    match motion {
        Motion::Periodic { .. } => "periodic",
        Motion::Aperiodic => "aperiodic",
        Motion::Doubtful { .. } => "doubtful",
    }
}

fn reason(motion: Motion) -> Option<String> {
    match motion {
        Motion::Doubtful { reason } => Some(reason.to_string()),
        _ => None,
    }
}

fn document(input: &Input, channel: usize, found: &Classification) -> Value {
    let multiple = match found.motion {
        Motion::Periodic { period_multiple } => Some(period_multiple),
        _ => None,
    };
    let repetitions = found.repetitions.iter().map(|repetition| {
        json!({
            "period_multiple": repetition.period_multiple,
            "deviation": repetition.deviation,
            "scatter": repetition.scatter,
        })
    });
    let mut document = input.document();
    document["channel"] = json!(input.record.channels[channel].name);
    document["motion"] = json!(word(found.motion));
    document["period_multiple"] = json!(multiple);
    document["reason"] = json!(reason(found.motion));
    document["excitation_frequency_hz"] = json!(found.frequency_hz);
    document["frequency_correction_hz"] = json!(found.correction_hz);
    document["periods"] = json!(found.periods);
    document["root_mean_square"] = json!(found.root_mean_square);
    document["noise_rms"] = json!(found.noise);
    document["repetitions"] = repetitions.collect();
    document
}

fn text(input: &Input, channel: usize, found: &Classification) -> String {
    let mut lines = vec![input.heading()];
    lines.push(format!(
        "{} over {} excitation periods at {:.6} Hz",
        named(&input.record.channels[channel]),
        found.periods,
        found.frequency_hz
    ));
    lines.push("  periods  deviation  scatter".to_owned());
    for repetition in &found.repetitions {
        lines.push(format!(
            "  {:>7}  {:>9.4}  {:>7.4}",
            repetition.period_multiple, repetition.deviation, repetition.scatter
        ));
    }
    if found.correction_hz != 0.0 {
        lines.push(format!("note: the excitation frequency was corrected by {:.3e} Hz", found.correction_hz));
    }
    lines.extend(input.notes());
    lines.push(match found.motion {
        Motion::Periodic { period_multiple: 1 } => "periodic, with the period of the excitation".to_owned(),
        Motion::Periodic { period_multiple } => {
            format!("periodic, with {period_multiple} excitation periods")
        }
        Motion::Aperiodic => "aperiodic".to_owned(),
        Motion::Doubtful { reason } => format!("doubtful: {reason}"),
    });
    lines.join("\n")
}
