//! `hammerbeam overlay`: a recorded motion laid over the computed orbit that is most alike.

mod give;
mod laid;

use std::path::Path;

use hammerbeam_jobs::{
    Observer, StoredBranches,
    comparison::{Filter, OverlaySettings, Sought, frequency_in_name, nothing_alike, overlay},
    counted,
    pool::threads,
};
use hammerbeam_results::Store;
use hammerbeam_signal::{
    MeasuredQuantity,
    classify::{Classification, ClassifySettings, MotionClass, classify, excitation_frequency},
    waveform::{Shifts, folded},
};
use hammerbeam_study::StudyFile;

use laid::Laid;

use super::{
    compare::observed,
    signal::{Input, open, quantity},
};
use crate::{
    failure::Failure, interrupt::Interrupt, output::Output, overlay_args::OverlayOptions, watch::Watch,
};

/// Samples of a waveform in an excitation period.
const SHOWN: usize = 1024;

pub fn run(options: &OverlayOptions, output: Output) -> Result<(), Failure> {
    let store = Store::open(&options.results)?;
    let file = StudyFile::parse("study.toml", store.about("study")?)?;
    drop(store);
    file.forced()?;
    let (model, point) = observed(&file, options.point.as_deref())?;
    let input = open(&options.input, options.reference.as_deref())?;
    let quantity = sensor(&input, options)?;
    let rate = input.record.sampling_rate_hz;
    let samples = &input.channel().samples;
    let frequency_hz = frequency(&input, options)?;
    let settings = ClassifySettings {
        max_period_multiple: ClassifySettings::default()
            .max_period_multiple
            .max(options.period.unwrap_or(1) as usize),
        ..ClassifySettings::default()
    };
    let classification = classify(samples, rate, frequency_hz, &settings)?;
    let period_multiple = period(&classification, options)?;
    // Pieces begin with the record: where its clock had its zero is no matter of the motion.
    let pieces = (period_multiple as usize, SHOWN);
    let measured = folded(samples, (rate, 0.0), classification.frequency_hz, pieces)?;
    let branches = StoredBranches::open(&options.results, &file)?;
    let settings = settings_of(options, quantity, classification.frequency_hz);
    let mut watch = Watch::new(Interrupt::listen(output)?);
    let work: (usize, &mut dyn Observer) = (threads(None), &mut watch);
    let found = overlay((&model, &branches), (&measured, period_multiple), &settings, work)?;
    let overlay = found.ok_or_else(|| nothing(&branches, period_multiple, &settings))?;
    if let Some(reason) = nothing_alike(&overlay) {
        return Err(Failure::NoResult(format!("{reason}; are frequency, sensor and filter right?")));
    }
    let laid = Laid { input, quantity, point, classification, period_multiple, measured, overlay };
    let table = options.out.as_deref().map(|folder| give::write(folder, &laid)).transpose()?;
    output.give(&give::document(&laid, options, table.as_deref()), || {
        give::text(&laid, options, table.as_deref())
    })?;
    Ok(())
}

/// What the channel shows: its unit says so, or the user.
fn sensor(input: &Input, options: &OverlayOptions) -> Result<MeasuredQuantity, Failure> {
    let channel = input.channel();
    let given = options.sensor.map(quantity);
    match (channel.quantity, given) {
        (MeasuredQuantity::Other, Some(given)) => Ok(given),
        (MeasuredQuantity::Other, None) => Err(Failure::BadInput(format!(
            "the unit of channel {} does not say what it measures: give --sensor",
            channel.name
        ))),
        (found, Some(given)) if found != given => Err(Failure::BadInput(format!(
            "--sensor {}: channel {} is a {} by its unit",
            given.word(),
            channel.name,
            found.word()
        ))),
        (found, _) => Ok(found),
    }
}

fn frequency(input: &Input, options: &OverlayOptions) -> Result<f64, Failure> {
    let path: &Path = &options.input.file;
    match (input.reference(), options.frequency) {
        (Some(reference), _) => Ok(excitation_frequency(&reference.samples, input.record.sampling_rate_hz)?),
        (None, Some(frequency)) => Ok(frequency),
        (None, None) => frequency_in_name(path).ok_or_else(|| {
            let shown = path.display();
            Failure::BadInput(format!(
                "{shown}: the excitation frequency is not known; give --frequency or --reference, or name \
                the file like \"31.5Hz.csv\""
            ))
        }),
    }
}

/// The period that the waveform has: given, or found.
fn period(found: &Classification, options: &OverlayOptions) -> Result<u32, Failure> {
    if let Some(period) = options.period {
        return Ok(period);
    }
    let kind = match found.motion {
        MotionClass::Periodic { period_multiple } => return Ok(period_multiple as u32),
        MotionClass::Aperiodic => "the measured motion is aperiodic".to_owned(),
        MotionClass::Doubtful { reason } => {
            format!("it is doubtful whether the measured motion repeats ({reason})")
        }
    };
    Err(Failure::NoResult(format!(
        "{kind}: it is no periodic orbit; --period N lays its mean over N excitation periods over one all \
        the same"
    )))
}

fn settings_of(options: &OverlayOptions, quantity: MeasuredQuantity, measured_hz: f64) -> OverlaySettings {
    let filter = |cut_off_hz| (Filter { order: options.order as usize, cut_off_hz }, options.zero_phase);
    let near = || Sought::Near {
        frequency_hz: options.frequency_factor * measured_hz,
        part: options.within / 100.0,
    };
    OverlaySettings {
        quantity,
        filter: options.low_pass.map(filter),
        sought: options.at.map_or_else(near, Sought::At),
        branch: options.branch,
        shifts: Shifts::Any,
        factor: options.amplitude_factor,
    }
}

/// That no orbit is there, and what is.
fn nothing(branches: &StoredBranches, period_multiple: u32, settings: &OverlaySettings) -> Failure {
    let place = match settings.sought {
        Sought::Near { frequency_hz, part } => {
            format!("between {:.4} and {:.4} Hz", (1.0 - part) * frequency_hz, (1.0 + part) * frequency_hz)
        }
        Sought::At(frequency_hz) => format!("at {frequency_hz} Hz"),
    };
    let of = settings.branch.map_or_else(String::new, |branch| format!(" of branch {branch}"));
    let mut periods: Vec<u32> =
        branches.branches().iter().map(|branch| branch.record.period_multiple).collect();
    periods.sort_unstable();
    periods.dedup();
    let periods: Vec<String> = periods.iter().map(u32::to_string).collect();
    Failure::NoResult(format!(
        "no stable orbit{of} of {} is stored {place}; the branches have periods {}",
        counted(period_multiple.into(), "excitation period"),
        periods.join(", ")
    ))
}
