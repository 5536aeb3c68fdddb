//! An update as a document, and its files.

use std::{
    fs,
    path::{Path, PathBuf},
};

use hammerbeam_fit::{FitEnd, Interval};
use hammerbeam_results::whole_file::{WriteError, replace};
use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::{FittedDatum, FittedParameter, MeasuredDatum, Update, UpdateData, UpdateError};

/// The updated study in the folder of results.
const STUDY: &str = "updated.toml";
/// The document in the folder of results.
const DOCUMENT: &str = "update.json";

/// What came of an update.
#[derive(Debug)]
pub struct UpdateReport {
    /// The fit.
    pub found: Update,
    /// What was measured.
    pub data: UpdateData,
    /// The file with the updated study, once it is written.
    pub study: Option<PathBuf>,
}

impl Serialize for UpdateReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut document = document(&self.found, &self.data);
        if let Some(study) = &self.study {
            document["study"] = json!(study);
        }
        document.serialize(serializer)
    }
}

/// Writes `updated.toml` and `update.json` into a folder, made if it is not there.
///
/// * `inputs`: files that are not to be overwritten.
///
/// # Errors
/// [`UpdateError::Write`], [`UpdateError::OverInput`].
pub fn write_update(report: &mut UpdateReport, folder: &Path, inputs: &[&Path]) -> Result<(), UpdateError> {
    let study = folder.join(STUDY);
    report.study = Some(study.clone());
    let cannot = |source| WriteError { path: folder.to_owned(), source };
    fs::create_dir_all(folder).map_err(cannot)?;
    let same =
        |other: &&Path| matches!((study.canonicalize(), other.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if inputs.iter().any(same) {
        return Err(UpdateError::OverInput { study });
    }
    let document = serde_json::to_value(&*report).expect("an update is plain data with text keys");
    replace(&study, report.found.study_text.as_bytes())?;
    replace(&folder.join(DOCUMENT), format!("{document:#}\n").as_bytes())?;
    Ok(())
}

impl Update {
    /// Why there is no result, if the fit did not converge.
    #[must_use]
    pub fn not_converged(&self) -> Option<String> {
        let found = self;
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
            "the fit does not converge: {why}, and a further step would still be {:.1e} standard errors \
            long. It had come to {}, with chi-squared {:.4e}. \
             Another start, bounds, or fewer parameters may help",
            found.end.distance(),
            reached.join(", "),
            found.inference.chi_squared.value
        ))
    }
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

impl FittedDatum {
    /// What it is, in words.
    #[must_use]
    pub fn name(&self, data: &UpdateData) -> String {
        match self.datum.observation {
            MeasuredDatum::Eigenfrequency(of) => format!("{} {}", of.table.name(), of.mode + 1),
            MeasuredDatum::Damping(of) => format!("damping ratio {}", of.mode + 1),
            MeasuredDatum::Response(of) => {
                let orbit = &data.orbits[of.orbit];
                format!("{} at {} Hz, period {}", of.of.name(), orbit.frequency_hz, orbit.period_multiple)
            }
        }
    }
}

fn measured(datum: &FittedDatum, data: &UpdateData) -> Value {
    json!({
        "name": datum.name(data),
        "measured": datum.datum.value,
        "deviation": datum.datum.deviation,
        "at_start": datum.at_start,
        "fitted": datum.fitted,
        "residual": datum.residual,
    })
}
