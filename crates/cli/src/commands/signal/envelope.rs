//! `hammerbeam signal envelope`: the envelope of a channel.

use hammerbeam_signal::{Channel, Record, envelope::envelope};
use serde_json::json;

use super::{
    filter::write_record,
    input::{self, largest, named},
};
use crate::{failure::Failure, output::Output, signal_args::EnvelopeOptions};

pub fn run(options: &EnvelopeOptions, output: Output) -> Result<(), Failure> {
    let input = input::open(&options.input, None)?;
    let (record, channel) = (&input.record, input.channel());
    let samples = match input::filter(&options.band, record.sampling_rate_hz)? {
        Some((_, sections)) => sections.zero_phase(&channel.samples)?,
        None => channel.samples.clone(),
    };
    let values = envelope(&samples)?;
    let highest = largest(&values);
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let enveloped = Record {
        channels: vec![Channel { samples: values, ..channel.clone() }],
        findings: Vec::new(),
        ..*record
    };
    let path =
        options.out.as_ref().map(|folder| write_record(&enveloped, folder, "envelope.csv")).transpose()?;
    let mut document = input.document();
    document["channel"] = json!(channel.name);
    document["low_pass_hz"] = json!(options.band.low_pass);
    document["high_pass_hz"] = json!(options.band.high_pass);
    document["max_envelope"] = json!(highest);
    document["mean_envelope"] = json!(mean);
    document["results"] = json!(path);
    output.give(&document, || {
        let mut lines = vec![input.heading()];
        lines.push(format!("envelope of {} about its mean", named(channel)));
        lines.push(format!("  largest {highest:.6e}, mean {mean:.6e}"));
        lines.extend(path.as_ref().map(|path| format!("{path}: the envelope")));
        lines.extend(input.notes());
        lines.join("\n")
    })?;
    Ok(())
}
