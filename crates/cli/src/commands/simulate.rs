//! `hammerbeam simulate`: a motion in time, with every contact.

use std::path::Path;

use hammerbeam_attractor::AttractorError;
use hammerbeam_figure::FrequencyUnit;
use hammerbeam_jobs::{
    JobError, JobFolders, PreparedStudy, counted,
    simulate::{
        DurationTooLong, SimulationReport, SimulationRequest, SimulationTime, SimulationTooLarge, simulate,
    },
};

use crate::{
    failure::Failure,
    initial,
    interrupt::Interrupt,
    kept::{place, unfinished, what_is_kept},
    motion_args::SimulateOptions,
    output::Output,
    watch::Watch,
};

/// Periods that are written down if nothing is said.
const USUAL_PERIODS: u64 = 10;
/// Samples in a period if nothing is said.
const USUAL_SAMPLES: u32 = 100;

pub fn run(options: &SimulateOptions, output: Output) -> Result<(), Failure> {
    let study = PreparedStudy::new(options.study.read()?)?;
    let time = match study.file.forced().is_ok() {
        true => forced(options)?,
        false => free(options, &study)?,
    };
    let request = SimulationRequest {
        time,
        section_phase: options.section_phase,
        initial: initial::meant(&options.initial, 2 * study.dof())?,
    };
    let folders = JobFolders { results: options.results.as_deref(), out: options.out.as_deref() };
    let mut watch = Watch::new(Interrupt::listen(output)?);
    let report = simulate(&study, &request, folders, &mut watch);
    let report = report.map_err(|error| refused(options, (&study, &time), error))?;
    output.give(&report, || text(&report, output.frequency_unit))?;
    Ok(())
}

fn bad(message: String) -> Failure {
    Failure::BadInput(message)
}

fn too_long(error: DurationTooLong) -> Failure {
    let DurationTooLong { found, most, things } = error;
    bad(format!("--duration holds {found:e} {things}, must be {most:e} at most"))
}

/// The periods of a study with an excitation.
fn forced(options: &SimulateOptions) -> Result<SimulationTime, Failure> {
    if options.sampling.is_some() {
        let message = "--sampling is for a study without [excitation]; allowed here: --samples-per-period";
        return Err(bad(message.to_owned()));
    }
    let Some(frequency_hz) = options.frequency else {
        return Err(bad("--frequency is missing: the study has an [excitation]".to_owned()));
    };
    let periods = match options.duration {
        None => options.periods.unwrap_or(USUAL_PERIODS),
        Some(duration) => SimulationTime::periods_in(duration, frequency_hz).map_err(too_long)?,
    };
    let samples = options.samples_per_period.unwrap_or(USUAL_SAMPLES);
    Ok(SimulationTime::periods(frequency_hz, options.transient_periods, periods, samples))
}

/// The intervals of a study without one.
fn free(options: &SimulateOptions, study: &PreparedStudy) -> Result<SimulationTime, Failure> {
    let given = [
        ("--frequency", options.frequency.is_some()),
        ("--periods", options.periods.is_some()),
        ("--transient-periods", options.transient_periods > 0),
        ("--samples-per-period", options.samples_per_period.is_some()),
        ("--section-phase", options.section_phase > 0.0),
    ];
    if let Some((flag, _)) = given.iter().find(|(_, given)| *given) {
        let message = "the study has no [excitation], so no period; allowed: --duration S and --sampling HZ";
        return Err(bad(format!("{flag}: {message}")));
    }
    let Some(duration) = options.duration else {
        let message = "--duration is missing: the study has no [excitation], so no period to count";
        return Err(bad(message.to_owned()));
    };
    SimulationTime::free(duration, options.sampling, &study.model).map_err(too_long)
}

fn refused(
    options: &SimulateOptions,
    (study, time): (&PreparedStudy, &SimulationTime),
    error: JobError,
) -> Failure {
    let out = options.out.as_deref();
    match initial::refused(&options.initial, 2 * study.dof(), error) {
        Ok(failure) => failure,
        Err(JobError::TooLarge(error)) => bad(too_large(&error)),
        Err(JobError::Stopped { source, done }) => match *source {
            JobError::Motion(error) => ended(time, &error, (done, out)),
            other => unfinished(other.stopped_after(done), |done| fate_of(time, done, out)),
        },
        Err(error) => unfinished(error, |done| fate_of(time, done, out)),
    }
}

/// What takes too much, by the options that ask for it.
fn too_large(error: &SimulationTooLarge) -> String {
    match *error {
        SimulationTooLarge::Free { numbers, most, sampling_hz } => format!(
            "the motion is {numbers} numbers, must be {most} at most with --out; allowed: a shorter \
            --duration, or a \
             lower --sampling than {sampling_hz} Hz"
        ),
        SimulationTooLarge::Period { samples, dof, elements, numbers, most, most_samples } => format!(
            "--samples-per-period {samples} of {dof} degrees of freedom and {elements} local elements is \
            {numbers} numbers in a period, must be {most} at most; allowed: 1 to {most_samples} samples"
        ),
        SimulationTooLarge::Periods { periods, of_period, numbers, most, most_periods, samples } => format!(
            "--periods {periods} of {of_period} numbers each is {numbers} numbers, must be {most} at most \
            with --out; allowed: 1 to {most_periods} periods with --samples-per-period {samples}"
        ),
        _ => error.to_string(),
    }
}

/// What becomes of the periods that are done.
fn fate_of(time: &SimulationTime, done: u64, out: Option<&Path>) -> String {
    let (number, part) = place_of(time, done);
    format!("{}{part} {}", counted(number, time.pieces.word()), what_is_kept(number, out))
}

/// A motion that ends early.
fn ended(time: &SimulationTime, error: &AttractorError, (done, out): (u64, Option<&Path>)) -> Failure {
    let word = time.pieces.word();
    let (period, part) = place_of(time, done + 1);
    let (number, of) = place_of(time, done);
    let finished = counted(number, word);
    Failure::NoResult(format!("{word} {period}{part}: {error}; {finished}{of} {}", place(number, out)))
}

/// The number of a period in its part of the motion, and that part.
fn place_of(time: &SimulationTime, period: u64) -> (u64, &'static str) {
    match time.transient {
        0 => (period, ""),
        transient if period > transient => (period - transient, ""),
        _ => (period, " of the transient"),
    }
}

fn text(report: &SimulationReport, unit: FrequencyUnit) -> String {
    let seconds = report.time_s;
    let mut lines = vec![
        match (report.frequency_hz, report.periods) {
            (Some(frequency_hz), Some(periods)) => {
                format!("{periods} periods at {}, {seconds:.6} s", unit.words(frequency_hz))
            }
            _ => {
                let sampling_hz = report.sampling_hz.unwrap_or_default();
                format!("{seconds:.6} s of free vibration, {sampling_hz} samples in a second")
            }
        },
        format!(
            "  largest sampled displacement  {:.6e} m ({} samples)",
            report.max_abs_sampled_displacement_m, report.samples
        ),
        format!("  contacts                      {}", report.contacts),
        format!("  largest contact force         {:.6e} N", report.max_contact_force_n),
        format!("  largest impact velocity       {:.6e} m/s", report.max_impact_velocity_m_s),
        format!("  impulse of all contacts       {:.6e} N s", report.impulse_n_s),
        format!("  energy lost in all contacts   {:.3e} J", report.energy_lost_j),
    ];
    if report.is_cut_in_contact {
        lines.push("    (with what a contact holds that is closed at the start or the end)".to_owned());
    }
    if let Some(folder) = &report.results {
        lines.push(format!("samples.csv, contacts.csv and stroboscopic.csv are in {folder}"));
    }
    lines.join("\n")
}
