//! `hammerbeam signal filter`: channels filtered and resampled.

use hammerbeam_figure::plain_number;
use hammerbeam_results::export::{Table, number};
use hammerbeam_signal::{
    Channel, Record,
    filter::DigitalFilter,
    resample::{Ratio, resample},
};
use serde_json::json;

use super::input::{self, Input, largest, named, title};
use crate::{failure::Failure, output::Output, signal_args::FilterOptions};

pub fn run(options: &FilterOptions, output: Output) -> Result<(), Failure> {
    let input = input::open(&options.input, None)?;
    let record = &input.record;
    let filter = input::filter(&options.band, record.sampling_rate_hz)?;
    if filter.is_none() && options.resample.is_none() {
        let message = "there is nothing to do: give --low-pass, --high-pass or --resample";
        return Err(Failure::BadInput(message.to_owned()));
    }
    let sections = filter.map(|(_, sections)| sections);
    let filtered = filtered(record, sections.as_ref(), options)?;
    let path = write(&filtered, options)?;
    let document = || {
        let channel = |(before, after): (&Channel, &Channel)| {
            json!({
                "name": before.name,
                "unit": input::unit(before),
                "max_abs_before": largest(&before.samples),
                "max_abs_after": largest(&after.samples),
            })
        };
        let mut document = input.document();
        document["low_pass_hz"] = json!(options.band.low_pass);
        document["high_pass_hz"] = json!(options.band.high_pass);
        document["order"] = json!(options.band.order);
        document["zero_phase"] = json!(!options.causal);
        document["filtered_sampling_rate_hz"] = json!(filtered.sampling_rate_hz);
        document["filtered"] = record.channels.iter().zip(&filtered.channels).map(channel).collect();
        document["results"] = json!(path);
        document
    };
    output.give(&document(), || text(&input, &filtered, path.as_deref()))?;
    Ok(())
}

fn filtered(
    record: &Record,
    sections: Option<&DigitalFilter>,
    options: &FilterOptions,
) -> Result<Record, Failure> {
    let ratio = options.resample.map(|rate| Ratio::of_rates(rate, record.sampling_rate_hz)).transpose()?;
    let channel = |channel: &Channel| {
        let mut samples = match sections {
            Some(sections) if options.causal => sections.causal(&channel.samples),
            Some(sections) => sections.zero_phase(&channel.samples)?,
            None => channel.samples.clone(),
        };
        if let Some(ratio) = ratio {
            samples = resample(&samples, ratio)?;
        }
        Ok(Channel { samples, ..channel.clone() })
    };
    let channels = record.channels.iter().map(channel).collect::<Result<Vec<_>, Failure>>()?;
    let sampling_rate_hz = record.sampling_rate_hz * ratio.map_or(1.0, Ratio::value);
    Ok(Record { sampling_rate_hz, channels, start_s: record.start_s, findings: Vec::new() })
}

fn write(record: &Record, options: &FilterOptions) -> Result<Option<String>, Failure> {
    let Some(folder) = &options.out else { return Ok(None) };
    Ok(Some(write_record(record, folder, "filtered.csv")?))
}

/// Writes a record as a table.
pub fn write_record(record: &Record, folder: &std::path::Path, name: &str) -> Result<String, Failure> {
    let titles: Vec<String> =
        std::iter::once("time_s".to_owned()).chain(record.channels.iter().map(title)).collect();
    let mut table = Table::begin(folder, name, &titles)?;
    for k in 0..record.len() {
        let time = record.start_s + k as f64 / record.sampling_rate_hz;
        let row = std::iter::once(time).chain(record.channels.iter().map(|channel| channel.samples[k]));
        table.row(&row.map(number).collect::<Vec<_>>())?;
    }
    Ok(table.finish()?.display().to_string())
}

fn text(input: &Input, filtered: &Record, path: Option<&str>) -> String {
    let mut lines = vec![input.heading()];
    for (before, after) in input.record.channels.iter().zip(&filtered.channels) {
        lines.push(format!(
            "  {:<28} largest {:.6e}, filtered {:.6e}",
            named(before),
            largest(&before.samples),
            largest(&after.samples)
        ));
    }
    if filtered.sampling_rate_hz != input.record.sampling_rate_hz {
        lines.push(format!(
            "  resampled to {} Hz, {} samples",
            plain_number(filtered.sampling_rate_hz),
            filtered.len()
        ));
    }
    lines.extend(path.map(|path| format!("{path}: the filtered channels")));
    lines.extend(input.notes());
    lines.join("\n")
}
