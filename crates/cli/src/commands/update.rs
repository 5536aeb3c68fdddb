//! `hammerbeam update`: parameters of a study fitted to measurements.

use hammerbeam_fit::Interval;
use hammerbeam_jobs::{
    counted,
    update::{
        CandidateError, DataError, FittedDatum, FittedParameter, Update, UpdateData, UpdateError,
        UpdateReport, UpdateSettings, update, write_update,
    },
};
use hammerbeam_study::StudyError;

use crate::{
    args::UpdateOptions,
    failure::Failure,
    output::{Output, notify},
};

pub fn run(options: &UpdateOptions, output: Output) -> Result<(), Failure> {
    let study = options.study.read()?;
    let data = UpdateData::read(&options.data, &study).map_err(data_failure)?;
    if !data.orbits.is_empty() {
        study.forced()?;
    }
    let settings = UpdateSettings {
        confidence: options.confidence / 100.0,
        profiles: options.profile,
        further_starts: options.starts,
        ..UpdateSettings::default()
    };
    let found = update(&study, &data, &settings).map_err(failure)?;
    if let Some(message) = found.not_converged() {
        return Err(Failure::NoResult(message));
    }
    let mut report = UpdateReport { found, data, study: None };
    if let Some(folder) = &options.out {
        let inputs = [options.study.path.as_path(), options.data.as_path()];
        write_update(&mut report, folder, &inputs).map_err(failure)?;
    }
    for finding in &report.found.findings {
        notify(&format!("warning: {finding}"));
    }
    output.give(&report, || text(&report))?;
    Ok(())
}

fn data_failure(error: DataError) -> Failure {
    match error {
        DataError::Invalid(report) => Failure::Study(report),
        other => Failure::BadInput(other.to_string()),
    }
}

fn failure(error: UpdateError) -> Failure {
    match error {
        UpdateError::Data(error) => data_failure(error),
        UpdateError::Write(error) => error.into(),
        UpdateError::OverInput { .. } => Failure::BadInput(error.to_string()),
        UpdateError::Start(CandidateError::Study(StudyError::Invalid(report))) => Failure::Study(report),
        other => Failure::NoResult(other.to_string()),
    }
}

fn text(UpdateReport { found, data, study }: &UpdateReport) -> String {
    let inference = &found.inference;
    let mut lines = Vec::new();
    let parameters = counted(found.parameters.len() as u64, "parameter");
    let iterations = counted(found.iterations as u64, "iteration");
    lines.push(format!("{}: {parameters}, {} data, after {iterations}", title(data), found.data.len()));
    if found.starts.tried > 1 {
        let next = found.starts.next_chi_squared;
        let other =
            next.map_or(String::new(), |value| format!("; the next minimum has chi-squared {value:.4e}"));
        lines.push(format!("{} of {} starts led here{other}", found.starts.led_here, found.starts.tried));
    }
    lines.push(String::new());
    let percent = 100.0 * inference.confidence;
    let width = found.parameters.iter().map(|parameter| parameter.key.len()).max().unwrap_or(0);
    let interval = format!("{percent} % interval");
    lines.push(format!(
        "{:<width$} {:>14} {:>14} {:>10}  {interval}",
        "parameter", "in the study", "fitted", "error"
    ));
    lines.extend(found.parameters.iter().map(|parameter| parameter_line(parameter, width)));
    lines.push(String::new());
    lines.extend(correlation_lines(found));
    lines.extend(data_lines(found, data));
    lines.push(String::new());
    lines.push(test_line(found));
    if let Some(study) = study {
        lines.push(format!("updated study: {}", study.display()));
    }
    lines.join("\n")
}

fn title(data: &UpdateData) -> &str {
    if data.title.is_empty() { "update" } else { &data.title }
}

fn parameter_line(parameter: &FittedParameter, width: usize) -> String {
    let error = parameter.standard_error.map_or("-".to_owned(), |error| format!("{error:.2e}"));
    let interval = match (parameter.interval, parameter.at_bound) {
        (Some(Interval { low, high, .. }), _) => format!("{low:.7e} to {high:.7e}"),
        (None, true) => "at its bound".to_owned(),
        (None, false) => "not determined".to_owned(),
    };
    let end = |end: Option<f64>| end.map_or("open".to_owned(), |end| format!("{end:.7e}"));
    let profile = parameter
        .profile
        .map_or(String::new(), |profile| format!("; profile {} to {}", end(profile.low), end(profile.high)));
    let (in_study, value) = (parameter.in_study, parameter.value);
    format!("{:<width$} {in_study:>14.7e} {value:>14.7e} {error:>10}  {interval}{profile}", parameter.key)
}

fn correlation_lines(found: &Update) -> Vec<String> {
    if found.parameters.len() < 2 {
        return Vec::new();
    }
    let cell = |entry: &Option<f64>| entry.map_or("     -".to_owned(), |entry| format!("{entry:>6.3}"));
    let row = |row: &Vec<Option<f64>>| format!("  {}", row.iter().map(cell).collect::<Vec<_>>().join(" "));
    let mut lines = vec!["correlation, in the order of the parameters".to_owned()];
    lines.extend(found.inference.correlation.iter().map(row));
    lines.push(String::new());
    lines
}

fn data_lines(found: &Update, data: &UpdateData) -> Vec<String> {
    let names: Vec<String> = found.data.iter().map(|datum| datum.name(data)).collect();
    let width = names.iter().map(String::len).max().unwrap_or(0);
    let head = format!(
        "{:<width$} {:>13} {:>10} {:>13} {:>13} {:>9}",
        "datum", "measured", "deviation", "at the start", "fitted", "residual"
    );
    let line = |(name, datum): (&String, &FittedDatum)| {
        let (value, deviation) = (datum.datum.value, datum.datum.deviation);
        let (start, fitted, residual) = (datum.at_start, datum.fitted, datum.residual);
        format!(
            "{name:<width$} {value:>13.6e} {deviation:>10.2e} {start:>13.6e} {fitted:>13.6e} {residual:>9.3}"
        )
    };
    std::iter::once(head).chain(names.iter().zip(&found.data).map(line)).collect()
}

fn test_line(found: &Update) -> String {
    let test = &found.inference.chi_squared;
    let degrees = counted(test.degrees_of_freedom as u64, "degree");
    let value = format!("chi-squared {:.4} with {degrees} of freedom", test.value);
    match (test.probability, found.inference.variance) {
        (Some(probability), _) => {
            format!("{value}: errors of the stated size exceed it with a probability of {probability:.3}")
        }
        (None, Some(variance)) if test.degrees_of_freedom > 0 => {
            format!("{value}: the standard deviations are {:.4} times those stated", variance.sqrt())
        }
        _ => value,
    }
}
