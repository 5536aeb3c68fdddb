//! `hammerbeam signal chain`: what an instrument would have shown of a computed motion.

use hammerbeam_figure::plain_number;
use hammerbeam_signal::{
    MeasuredQuantity, Record,
    chain::{Converter, MeasuringChain, RecordCoverage},
};
use serde_json::json;

use super::{
    filter::write_record,
    input::{self, Input, largest, named},
};
use crate::{
    failure::Failure,
    output::Output,
    signal_args::{ChainOptions, Sensor},
};

pub fn run(options: &ChainOptions, output: Output) -> Result<(), Failure> {
    let input = input::open(&options.input, None)?;
    let filter = input::filter(&options.band, input.record.sampling_rate_hz)?;
    let chain = MeasuringChain {
        sensor: quantity(options.sensor),
        filter: filter.map(|(_, sections)| (sections, options.zero_phase)),
        sampling_rate_hz: options.sampling,
        noise: options.noise,
        seed: options.seed,
        converter: options.range.zip(options.bits).map(|(range, bits)| Converter { range, bits }),
    };
    let motion = if options.periodic { RecordCoverage::WholePeriods } else { RecordCoverage::Excerpt };
    let measured = chain.measure(&input.record, motion)?;
    let path =
        options.out.as_ref().map(|folder| write_record(&measured, folder, "measured.csv")).transpose()?;
    let mut document = input.document();
    document["sensor"] = json!(chain.sensor.word());
    document["source"] = json!(measured.channels[0].name);
    document["periodic"] = json!(options.periodic);
    document["low_pass_hz"] = json!(options.band.low_pass);
    document["high_pass_hz"] = json!(options.band.high_pass);
    document["measured_sampling_rate_hz"] = json!(measured.sampling_rate_hz);
    document["measured_samples"] = json!(measured.len());
    document["max_abs_before"] = json!(before(&input, &chain));
    document["max_abs_measured"] = json!(largest(&measured.channels[0].samples));
    document["noise"] = json!(options.noise);
    document["seed"] = json!(options.seed);
    document["measured_findings"] = json!(input::findings(&measured));
    document["results"] = json!(path);
    output.give(&document, || text(&input, &chain, &measured, path.as_deref()))?;
    Ok(())
}

/// What a sensor measures.
pub const fn quantity(sensor: Sensor) -> MeasuredQuantity {
    match sensor {
        Sensor::Displacement => MeasuredQuantity::Displacement,
        Sensor::Velocity => MeasuredQuantity::Velocity,
        Sensor::Acceleration => MeasuredQuantity::Acceleration,
    }
}

/// Largest value of the quantity in the file, if it is there.
fn before(input: &Input, chain: &MeasuringChain) -> Option<f64> {
    let channel = input.record.channels.iter().find(|channel| channel.quantity == chain.sensor);
    channel.map(|channel| largest(&channel.samples))
}

fn text(input: &Input, chain: &MeasuringChain, measured: &Record, path: Option<&str>) -> String {
    let channel = &measured.channels[0];
    let mut lines = vec![input.heading()];
    lines.push(format!(
        "{} measured as {}: {} samples at {} Hz",
        named(channel),
        chain.sensor.word(),
        measured.len(),
        plain_number(measured.sampling_rate_hz)
    ));
    if let Some(before) = before(input, chain) {
        lines.push(format!("  largest in the file   {before:.6e}"));
    }
    lines.push(format!("  largest as measured   {:.6e}", largest(&channel.samples)));
    lines.extend(path.map(|path| format!("{path}: the measured channel")));
    lines.extend(input.notes());
    lines.extend(input::notes(measured));
    lines.join("\n")
}
