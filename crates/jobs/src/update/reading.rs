//! The data file, read from TOML: every key of it, all faults at once.

use std::path::Path;

use hammerbeam_fit::{Bounds, Deviations};
use hammerbeam_signal::limits::{LARGEST_TEXT, read_text as read_file};
use hammerbeam_study::{
    FaultReport, StudyFile,
    changed::limits,
    document::{Reading, TomlTable, Value, quantity},
    file::StructureTable,
    number::{self, Number},
};
use toml::de::DeTable;

use super::{
    data::{DataError, DataSource, Datum, FittedKey, MeasuredOrbit, UpdateData},
    measured::{read_damping, read_eigenfrequencies, read_orbit},
};

impl UpdateData {
    /// Reads a data file for a study.
    ///
    /// # Errors
    /// [`DataError`]: the file cannot be read, or something in it is not allowed.
    pub fn read(path: &Path, study: &StudyFile) -> Result<Self, DataError> {
        let text = read_file(path, LARGEST_TEXT)
            .map_err(|source| DataError::Unreadable { path: path.to_owned(), source })?;
        Self::parse(&path.display().to_string(), text, study)
    }

    /// Reads data from their text.
    ///
    /// # Errors
    /// [`DataError::Invalid`] with everything that is not allowed.
    pub fn parse(name: &str, text: String, study: &StudyFile) -> Result<Self, DataError> {
        parse(name, text, study).map_err(DataError::Invalid)
    }
}

fn parse(name: &str, text: String, study: &StudyFile) -> Result<UpdateData, FaultReport> {
    let reading = Reading::default();
    let read = read_text(&text, &reading, study);
    let (problems, left_out, places) = reading.into_parts();
    match read {
        Some(read) if problems.is_empty() => {
            let source = DataSource { name: name.to_owned(), text, places };
            let Read { title, deviations, parameters, orbits, data } = read;
            Ok(UpdateData { title, deviations, parameters, orbits, data, source })
        }
        _ => Err(FaultReport::new(name, &text, problems).and(left_out)),
    }
}

struct Read {
    title: String,
    deviations: Deviations,
    parameters: Vec<FittedKey>,
    orbits: Vec<MeasuredOrbit>,
    data: Vec<Datum>,
}

fn read_text(text: &str, reading: &Reading, study: &StudyFile) -> Option<Read> {
    let (document, errors) = DeTable::parse_recoverable(text);
    for error in &errors {
        reading.problem("", error.span(), format!("not TOML: {}", error.message()), Vec::new());
    }
    if !errors.is_empty() {
        return None;
    }
    let root = TomlTable::new(reading, String::new(), 0..0, document.get_ref());
    let read = read_root(&root, reading, study);
    root.finish();
    read
}

fn read_root(root: &TomlTable<'_>, reading: &Reading, study: &StudyFile) -> Option<Read> {
    let before = reading.count();
    let title = root.optional("title").map_or(Some(""), |value| value.text());
    let choices = [("known", Deviations::Known), ("up-to-a-factor", Deviations::UpToFactor)];
    let deviations =
        root.optional("deviations").map_or(Some(Deviations::Known), |value| value.choice(&choices));
    let numbers = number::numbers(&study.text);
    let mut parameters = read_parameters(root, study, &numbers);
    keep_points_on_the_beam(&mut parameters, study);
    let mut data = Vec::new();
    for table in root.tables("eigenfrequency") {
        read_eigenfrequencies(table, &mut data);
    }
    for table in root.tables("damping_ratio") {
        read_damping(table, &mut data);
    }
    let mut orbits = Vec::new();
    for table in root.tables("periodic_response") {
        read_orbit(table, &mut orbits, &mut data);
    }
    if reading.count() > before {
        return None;
    }
    refuse_what_cannot_be_fitted(root, &parameters, &data, deviations?);
    let title = title?.to_owned();
    (reading.count() == before).then_some(Read { title, deviations: deviations?, parameters, orbits, data })
}

/// Nothing to fit, or too few data.
fn refuse_what_cannot_be_fitted(
    root: &TomlTable<'_>,
    parameters: &[FittedKey],
    data: &[Datum],
    deviations: Deviations,
) {
    if parameters.is_empty() {
        let help = vec!["allowed: one [[parameter]] or more, each with its `key`".into()];
        root.problem("parameter", "there is no parameter to fit".into(), help);
        return;
    }
    let more = usize::from(deviations == Deviations::UpToFactor);
    let needed = parameters.len() + more;
    if data.len() < needed {
        let what = format!(
            "{} for {}",
            count(data.len(), "datum", "data"),
            count(parameters.len(), "parameter", "parameters")
        );
        let why = if more == 1 {
            format!(
                "allowed: {needed} data or more, since the standard deviations are estimated from what is \
                left"
            )
        } else {
            format!("allowed: {needed} data or more, or fewer parameters")
        };
        root.problem("parameter", format!("the data are fewer than the fit needs: {what}"), vec![why]);
    }
}

fn count(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

fn read_parameters(root: &TomlTable<'_>, study: &StudyFile, numbers: &[Number]) -> Vec<FittedKey> {
    let mut read: Vec<FittedKey> = Vec::new();
    for table in root.tables("parameter") {
        let Some(parameter) = read_parameter(&table, study, numbers) else {
            table.finish();
            continue;
        };
        if read.iter().any(|other| other.number.span == parameter.number.span) {
            let message = format!("`key` is \"{}\", which is fitted already", parameter.key);
            table.problem("key", message, vec!["allowed: each number once".into()]);
        }
        read.push(parameter);
        table.finish();
    }
    read
}

fn read_parameter(table: &TomlTable<'_>, study: &StudyFile, numbers: &[Number]) -> Option<FittedKey> {
    let any = &quantity::ANY;
    let key = table.required("key").and_then(|value| read_key(&value, numbers));
    let start = table.optional("start").map(|value| value.number(any));
    let low = table.optional("low").map_or(Some(f64::NEG_INFINITY), |value| value.number(any));
    let high = table.optional("high").map_or(Some(f64::INFINITY), |value| value.number(any));
    let ((key, number), bounds) = (key?, Bounds { low: low?, high: high? });
    let start = start.unwrap_or(Some(number.value))?;
    if bounds.low >= bounds.high {
        let help = vec!["allowed: `low` less than `high`".into()];
        table.problem("low", format!("`low` is {}, but `high` is {}", bounds.low, bounds.high), help);
        return None;
    }
    if bounds.clamp(start) != start {
        let named = if table.has("start") { "`start`" } else { "the value of the study" };
        let help = vec![format!("allowed: {} to {}", bounds.low, bounds.high)];
        table.problem("start", format!("{named} is {start}, which is not within `low` and `high`"), help);
        return None;
    }
    let typical = if start == 0.0 { bounds.high - bounds.low } else { start.abs() };
    if !typical.is_finite() {
        let help = vec!["allowed: another `start`, or `low` and `high`, which give its size".into()];
        table.problem("start", format!("`{key}` starts at 0, so that its size is not known"), help);
        return None;
    }
    let (low, high) = limits(study, &number);
    let bounds = Bounds { low: bounds.low.max(low), high: bounds.high.min(high) };
    if bounds.clamp(start) != start {
        let help = vec![format!("allowed by the study file: {} to {}", bounds.low, bounds.high)];
        table.problem("start", format!("`{key}` starts at {start}"), help);
        return None;
    }
    Some(FittedKey { key, number, start, typical, bounds })
}

fn read_key(value: &Value<'_>, numbers: &[Number]) -> Option<(String, Number)> {
    let text = value.text()?;
    let known = numbers.iter().find(|number| number.keys.iter().any(|key| key == text));
    if let Some(number) = known {
        return Some((text.to_owned(), number.clone()));
    }
    let names: Vec<&str> =
        numbers.iter().filter_map(|number| number.keys.first()).map(String::as_str).collect();
    value.unknown_word(
        text,
        "a number in the text of the study (a default has to be written out first)",
        &names,
    );
    None
}

/// Points stay on a beam whose length is not fitted, and a beam stays as long as its points ask that are not
/// fitted.
fn keep_points_on_the_beam(parameters: &mut [FittedKey], study: &StudyFile) {
    let StructureTable::Beam(beam) = &study.study.structure else { return };
    let is = |parameter: &FittedKey, key: &str| parameter.number.keys.last().is_some_and(|last| last == key);
    let place = |index: usize| format!("structure.point.{}.at_m", index + 1);
    let fits_length = parameters.iter().any(|parameter| is(parameter, "structure.length_m"));
    let fixed = |index: &usize| !parameters.iter().any(|parameter| is(parameter, &place(*index)));
    let farthest =
        (0..beam.points.len()).filter(fixed).map(|index| beam.points[index].at_m).fold(0.0, f64::max);
    for parameter in parameters {
        if is(parameter, "structure.length_m") {
            parameter.bounds.low = parameter.bounds.low.max(farthest);
        } else if !fits_length && (0..beam.points.len()).any(|index| is(parameter, &place(index))) {
            parameter.bounds.high = parameter.bounds.high.min(beam.length_m);
        }
    }
}
