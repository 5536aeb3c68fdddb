//! `hammerbeam lyapunov`: the exponents of a motion.

use hammerbeam_figure::FrequencyUnit;
use hammerbeam_jobs::{
    FrequencySeries, JobError, JobFolders, PreparedStudy, counted,
    exponents::{ExponentsRequest, SpectrumReport, exponents},
};

use crate::{
    failure::Failure,
    initial,
    interrupt::Interrupt,
    kept::{unfinished, what_is_kept},
    motion_args::LyapunovOptions,
    output::Output,
    series::falling,
    watch::Watch,
};

/// What contacts take is shown where it is more than this share of what dampers take.
const ROUNDING: f64 = 1e-12;

pub fn run(options: &LyapunovOptions, output: Output) -> Result<(), Failure> {
    let file = options.study.read()?;
    file.forced()?;
    let study = PreparedStudy::new(file)?;
    let frequencies = FrequencySeries {
        from_hz: options.frequency,
        to_hz: options.to.unwrap_or(options.frequency),
        step_hz: options.step,
    };
    let request = ExponentsRequest {
        frequencies,
        initial: initial::meant(&options.initial, 2 * study.dof())?,
        transient_periods: options.transient_periods,
        periods: options.periods,
        sections_per_period: options.sections_per_period,
    };
    let folders = JobFolders { results: options.results.as_deref(), out: options.out.as_deref() };
    let mut watch = Watch::new(Interrupt::listen(output)?);
    let report = exponents(&study, &request, folders, &mut watch);
    let report = report.map_err(|error| refused(options, (&study, &frequencies), error))?;
    let words = || text(&report.spectra, output.frequency_unit);
    match &report.spectra[..] {
        [only] if options.to.is_none() => output.give(only, words)?,
        _ => output.give(&report, words)?,
    }
    Ok(())
}

fn refused(
    options: &LyapunovOptions,
    (study, frequencies): (&PreparedStudy, &FrequencySeries),
    error: JobError,
) -> Failure {
    let what_is_kept = |number| {
        let all = frequencies.frequencies().map_or(0, |all| all.len());
        format!("{number} of {all} spectra {}", what_is_kept(number, options.out.as_deref()))
    };
    match initial::refused(&options.initial, 2 * study.dof(), error) {
        Ok(failure) => failure,
        Err(error) => falling(error, "--frequency").unwrap_or_else(|error| unfinished(error, what_is_kept)),
    }
}

/// The exponents at a frequency.
fn one_text(report: &SpectrumReport, unit: FrequencyUnit) -> String {
    let spectrum = &report.record.spectrum;
    let mut lines = vec![format!(
        "exponents at {} over {:.6} s, {} in a period, with intervals of 95 %",
        unit.words(report.record.frequency_hz),
        spectrum.time,
        counted(report.record.sections_per_period, "section")
    )];
    for exponent in &spectrum.exponents {
        lines.push(format!("  {:>14.6} +- {:.6} 1/s", exponent.value, exponent.half_width));
    }
    lines.push(format!("  sum            {:.9} 1/s", spectrum.sum));
    lines.push(format!("  -tr(M^-1 C)    {:.9} 1/s", report.record.divergence));
    let adds = |expected: &f64| (expected / report.record.divergence - 1.0).abs() > ROUNDING;
    if let Some(expected) = spectrum.expected_sum.filter(adds) {
        lines.push(format!("  with contacts  {expected:.9} 1/s"));
    }
    if spectrum.sum == f64::NEG_INFINITY {
        lines.push("  a rigid stop sticks: what is minus infinity was forgotten there".to_owned());
    }
    lines.push(format!(
        "  Kaplan-Yorke dimension of the stroboscopic section {:.4}",
        spectrum.kaplan_yorke_dimension
    ));
    if let Some(k) = report.record.zero_one {
        lines.push(format!("  K of the 0-1 test {k:.3}"));
    }
    lines.push(format!("the largest exponent is {}", report.verdict()));
    if report.is_correlated() {
        let correlation = spectrum.block_correlation;
        lines.push(format!(
            "neighbouring blocks are correlated ({correlation:.2}): the intervals are too \
        small; take more periods"
        ));
    }
    lines.join("\n")
}

/// All of the only spectrum, or a row for each of a series.
fn text(results: &[SpectrumReport], unit: FrequencyUnit) -> String {
    if let [only] = results {
        return one_text(only, unit);
    }
    let mut lines = vec![format!(
        "{:>12} {:>28} {:>10} {:>6}  {}",
        unit.symbol(),
        "largest exponent 1/s",
        "dimension",
        "K",
        "which is"
    )];
    for result in results {
        let (record, spectrum) = (&result.record, &result.record.spectrum);
        let largest = spectrum.exponents[0];
        let k = record.zero_one.map_or_else(String::new, |k| format!("{k:.2}"));
        lines.push(format!(
            "{:>12.6} {:>14.6} +- {:<10.6} {:>10.4} {k:>6}  {}",
            unit.factor() * record.frequency_hz,
            largest.value,
            largest.half_width,
            spectrum.kaplan_yorke_dimension,
            result.verdict()
        ));
    }
    lines.join("\n")
}
