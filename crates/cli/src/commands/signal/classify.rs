//! `hammerbeam signal classify`: periodic or not, and in which multiple of the excitation period.

use hammerbeam_signal::classify::{
    Classification, ClassifySettings, MotionClass, classify, excitation_frequency,
};
use serde_json::{Value, json};

use super::input::{self, Input, named};
use crate::{failure::Failure, output::Output, signal_args::ClassifyOptions};

pub fn run(options: &ClassifyOptions, output: Output) -> Result<(), Failure> {
    if options.aperiodic_above < options.periodic_below {
        let message = "--aperiodic-above must not be less than --periodic-below";
        return Err(Failure::BadInput(message.to_owned()));
    }
    let input = input::open(&options.input, options.reference.as_deref())?;
    let rate = input.record.sampling_rate_hz;
    let frequency = match (input.reference(), options.frequency) {
        (Some(reference), _) => excitation_frequency(&reference.samples, rate)?,
        (None, Some(frequency)) => frequency,
        (None, None) => {
            let message = "give --frequency or --reference";
            return Err(Failure::BadInput(message.to_owned()));
        }
    };
    let settings = ClassifySettings {
        max_period_multiple: options.multiples as usize,
        periodic_below: options.periodic_below,
        aperiodic_above: options.aperiodic_above,
        ..ClassifySettings::default()
    };
    let found = classify(&input.channel().samples, rate, frequency, &settings)?;
    output.give(&document(&input, &found), || text(&input, &found))?;
    Ok(())
}

/// The kind of a motion.
pub const fn word(motion: MotionClass) -> &'static str {
    match motion {
        MotionClass::Periodic { .. } => "periodic",
        MotionClass::Aperiodic => "aperiodic",
        MotionClass::Doubtful { .. } => "doubtful",
    }
}

fn reason(motion: MotionClass) -> Option<String> {
    match motion {
        MotionClass::Doubtful { reason } => Some(reason.to_string()),
        _ => None,
    }
}

fn document(input: &Input, found: &Classification) -> Value {
    let multiple = match found.motion {
        MotionClass::Periodic { period_multiple } => Some(period_multiple),
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
    document["channel"] = json!(input.channel().name);
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

fn text(input: &Input, found: &Classification) -> String {
    let mut lines = vec![input.heading()];
    lines.push(format!(
        "{} over {} excitation periods at {:.6} Hz",
        named(input.channel()),
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
        MotionClass::Periodic { period_multiple: 1 } => {
            "periodic, with the period of the excitation".to_owned()
        }
        MotionClass::Periodic { period_multiple } => {
            format!("periodic, with {period_multiple} excitation periods")
        }
        MotionClass::Aperiodic => "aperiodic".to_owned(),
        MotionClass::Doubtful { reason } => format!("doubtful: {reason}"),
    });
    lines.join("\n")
}
