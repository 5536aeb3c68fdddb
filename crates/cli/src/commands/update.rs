//! `hammerbeam update`: parameters of a study fitted to measurements.

use std::{fs, path::Path};

use anyhow::Context;
use hammerbeam_fit::{FitEnd, Interval};
use hammerbeam_jobs::update::{
    CandidateError, DataError, FittedDatum, FittedParameter, Observation, Update, UpdateData, UpdateError,
    UpdateSettings, update,
};
use hammerbeam_results::whole_file::{WriteError, replace};
use hammerbeam_study::{StudyError, StudyFile};
use serde_json::{Value, json};

use crate::{
    args::UpdateOptions,
    failure::Failure,
    output::{Output, tell},
};

/// The updated study in the folder of results.
const STUDY: &str = "updated.toml";
/// The document in the folder of results.
const DOCUMENT: &str = "update.json";

pub fn run(options: &UpdateOptions, output: Output) -> Result<(), Failure> {
    let study = StudyFile::read(&options.study)?;
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
    if let Some(message) = not_converged(&found) {
        return Err(Failure::NoResult(message));
    }
    let mut document = document(&found, &data);
    if let Some(folder) = &options.out {
        document["study"] = json!(folder.join(STUDY));
        write(folder, options, &found, &document)?;
    }
    for finding in &found.findings {
        tell(&format!("warning: {finding}"));
    }
    output.give(&document, || text(&found, &data, options))?;
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
        UpdateError::Start(CandidateError::Study(StudyError::Invalid(report))) => Failure::Study(report),
        other => Failure::NoResult(other.to_string()),
    }
}

/// Why there is no result, if the fit did not converge.
fn not_converged(found: &Update) -> Option<String> {
    let why = match found.end {
        FitEnd::Converged { .. } => return None,
        FitEnd::Stalled { .. } => "no step improves it".to_owned(),
        FitEnd::Blocked { .. } => {
            let refusal = found.refusal.as_deref().unwrap_or("it cannot be computed there");
            format!(
                "the way leads to where there is no such model ({})",
                refusal.lines().next().unwrap_or_default()
            )
        }
        FitEnd::OutOfIterations { .. } => format!("it was left after {} iterations", found.iterations),
    };
    let reached: Vec<String> = found
        .parameters
        .iter()
        .map(|parameter| format!("{} = {:e}", parameter.key, parameter.value))
        .collect();
    Some(format!(
        "the fit does not converge: {why}, and a further step would still be {:.1e} standard errors long. It had come to {}, with chi-squared {:.4e}. \
         Another start, bounds, or fewer parameters may help",
        found.end.distance(),
        reached.join(", "),
        found.inference.chi_squared.value
    ))
}

fn write(folder: &Path, options: &UpdateOptions, found: &Update, document: &Value) -> Result<(), Failure> {
    let cannot = |source| WriteError { path: folder.to_owned(), source };
    fs::create_dir_all(folder).map_err(cannot)?;
    let study = folder.join(STUDY);
    let same =
        |other: &Path| matches!((study.canonicalize(), other.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if same(&options.study) || same(&options.data) {
        return Err(Failure::BadInput(format!(
            "{} is an input of this update and is not overwritten: give another folder",
            study.display()
        )));
    }
    let document = serde_json::to_string_pretty(document).context("cannot write the document")?;
    replace(&study, found.study_text.as_bytes())?;
    Ok(replace(&folder.join(DOCUMENT), (document + "\n").as_bytes())?)
}

fn document(found: &Update, data: &UpdateData) -> Value {
    let inference = &found.inference;
    let direction = |direction: &hammerbeam_fit::ParameterDirection| {
        let parts: serde_json::Map<String, Value> = data
            .parameters
            .iter()
            .zip(&direction.parts)
            .map(|(parameter, part)| (parameter.key.clone(), json!(part)))
            .collect();
        let keys: Vec<&str> =
            direction.parameters.iter().map(|&index| data.parameters[index].key.as_str()).collect();
        json!({ "parameters": keys, "direction": parts, "measure": finite(direction.measure) })
    };
    let open = &found.identifiability;
    json!({
        "title": data.title,
        "confidence": inference.confidence,
        "quantile": finite(inference.quantile),
        "iterations": found.iterations,
        "starts": found.starts.tried,
        "starts_that_led_here": found.starts.led_here,
        "next_minimum_chi_squared": found.starts.next_chi_squared,
        "parameters": found.parameters.iter().map(parameter).collect::<Vec<_>>(),
        "data": found.data.iter().map(|datum| measured(datum, data)).collect::<Vec<_>>(),
        "chi_squared": inference.chi_squared.value,
        "degrees_of_freedom": inference.chi_squared.degrees_of_freedom,
        "chi_squared_probability": inference.chi_squared.probability,
        "variance_factor": inference.variance,
        "correlation": inference.correlation,
        "singular_values": open.singular_values,
        "collinearity_index": finite(open.collinearity_index),
        "left_open": open.undetermined.iter().map(direction).collect::<Vec<_>>(),
        "collinear": open.collinear.iter().map(direction).collect::<Vec<_>>(),
        "warnings": found.findings.iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

/// A number as JSON has it: what is infinite is null.
fn finite(number: f64) -> Value {
    if number.is_finite() { json!(number) } else { Value::Null }
}

fn parameter(parameter: &FittedParameter) -> Value {
    let interval = |interval: Interval| json!([interval.low, interval.high]);
    json!({
        "key": parameter.key,
        "in_study": parameter.in_study,
        "start": parameter.start,
        "value": parameter.value,
        "standard_error": parameter.standard_error,
        "interval": parameter.interval.map(interval),
        "profile_interval": parameter.profile.map(|profile| json!([profile.low, profile.high])),
        "at_bound": parameter.at_bound,
    })
}

/// What a datum is, in words.
fn name(datum: &FittedDatum, data: &UpdateData) -> String {
    match datum.datum.observation {
        Observation::Eigenfrequency(of) => format!("{} {}", of.table.name(), of.mode + 1),
        Observation::Damping(of) => format!("damping ratio {}", of.mode + 1),
        Observation::Response(of) => {
            let orbit = &data.orbits[of.orbit];
            format!("{} at {} Hz, period {}", of.of.name(), orbit.frequency_hz, orbit.period_multiple)
        }
    }
}

fn measured(datum: &FittedDatum, data: &UpdateData) -> Value {
    json!({
        "name": name(datum, data),
        "measured": datum.datum.value,
        "deviation": datum.datum.deviation,
        "at_start": datum.at_start,
        "fitted": datum.fitted,
        "residual": datum.residual,
    })
}

fn text(found: &Update, data: &UpdateData, options: &UpdateOptions) -> String {
    let inference = &found.inference;
    let mut lines = Vec::new();
    let counts = format!("{} parameter(s), {} data", found.parameters.len(), found.data.len());
    lines.push(format!("{}: {counts}, after {} iteration(s)", title(data), found.iterations));
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
    if let Some(folder) = &options.out {
        lines.push(format!("updated study: {}", folder.join(STUDY).display()));
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
    let names: Vec<String> = found.data.iter().map(|datum| name(datum, data)).collect();
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
    let value =
        format!("chi-squared {:.4} with {} degree(s) of freedom", test.value, test.degrees_of_freedom);
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
