//! The data file, read from TOML: every key of it, all faults at once.

use std::{collections::BTreeMap, ops::Range};

use hammerbeam_fit::{Bounds, Deviations};
use toml::de::DeTable;

use crate::{
    Report, StudyFile,
    document::{Problem, Quantity, Reading, Table, Value, place, quantity},
    file::Structure,
};

use super::data::{
    DampingDatum, Datum, EigenfrequencyDatum, FittedKey, FrequencyTable, Maximum, MeasuredOrbit, Observation,
    ResponseDatum, UpdateData,
};
use super::number::{self, Number};

/// The text of a data file and where its keys stand.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Source {
    name: String,
    text: String,
    places: BTreeMap<String, Range<usize>>,
}

impl Source {
    pub fn fault(&self, key: &str, message: String, help: Vec<String>) -> Report {
        let problem = Problem { key: key.to_owned(), span: place(&self.places, key), message, help };
        Report::new(&self.name, &self.text, vec![problem])
    }
}

/// Reads a data file for a study.
pub(super) fn parse(name: &str, text: String, study: &StudyFile) -> Result<UpdateData, Report> {
    let reading = Reading::default();
    let read = read_text(&text, &reading, study);
    let (problems, places) = reading.into_parts();
    match read {
        Some(read) if problems.is_empty() => {
            let source = Source { name: name.to_owned(), text, places };
            let Read { title, deviations, parameters, orbits, data } = read;
            Ok(UpdateData { title, deviations, parameters, orbits, data, source })
        }
        _ => Err(Report::new(name, &text, problems)),
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
    let root = Table::new(reading, String::new(), 0..0, document.get_ref());
    let read = read_root(&root, reading, study);
    root.finish();
    read
}

fn read_root(root: &Table<'_>, reading: &Reading, study: &StudyFile) -> Option<Read> {
    let before = reading.count();
    let title = root.optional("title").map_or(Some(""), |value| value.text());
    let choices = [("known", Deviations::Known), ("up-to-a-factor", Deviations::UpToFactor)];
    let deviations =
        root.optional("deviations").map_or(Some(Deviations::Known), |value| value.choice(&choices));
    let numbers = number::numbers(study);
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
    root: &Table<'_>,
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
                "allowed: {needed} data or more, since the standard deviations are estimated from what is left"
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

fn read_parameters(root: &Table<'_>, study: &StudyFile, numbers: &[Number]) -> Vec<FittedKey> {
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

fn read_parameter(table: &Table<'_>, study: &StudyFile, numbers: &[Number]) -> Option<FittedKey> {
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
        let help = vec!["allowed: another `start`, or `low` and `high`, which tell its size".into()];
        table.problem("start", format!("`{key}` starts at 0, so that its size is not known"), help);
        return None;
    }
    let (low, high) = number::limits(study, &number);
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

/// Points stay on a beam whose length is not fitted, and a beam stays as long as its points ask that are not fitted.
fn keep_points_on_the_beam(parameters: &mut [FittedKey], study: &StudyFile) {
    let Structure::Beam(beam) = &study.study.structure else { return };
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

/// One number or a list of them.
fn one_or_more<T>(value: &Value<'_>, read: impl Fn(&Value<'_>) -> Option<T>) -> Option<Vec<T>> {
    if !value.is_list() {
        return read(value).map(|one| vec![one]);
    }
    let elements = value.array_of("numbers")?;
    if elements.is_empty() {
        value.problem("the list is empty".into(), vec!["allowed: one number or more".into()]);
        return None;
    }
    let read: Vec<Option<T>> = elements.iter().map(read).collect();
    read.into_iter().collect()
}

/// Standard deviations of `values`: their own, or a part of each value.
fn read_deviations(table: &Table<'_>, own: (&'static str, &Quantity), values: &[f64]) -> Option<Vec<f64>> {
    let (key, quantity) = own;
    let absolute = table.optional(key);
    let relative = table.optional("deviation_relative");
    let (value, scaled) = match (absolute, relative) {
        (Some(value), None) => (value, false),
        (None, Some(value)) => (value, true),
        (given, _) => {
            let what = if given.is_some() { "given twice" } else { "missing" };
            let help = vec![format!("allowed: one of `{key}` and `deviation_relative`")];
            table.problem(key, format!("the standard deviation is {what}"), help);
            return None;
        }
    };
    let quantity = if scaled { &quantity::RELATIVE_DEVIATION } else { quantity };
    let mut read = one_or_more(&value, |value| value.number(quantity))?;
    if read.len() == 1 {
        read = vec![read[0]; values.len()];
    }
    if read.len() != values.len() {
        let message = format!("there are {} standard deviations for {} numbers", read.len(), values.len());
        value.problem(message, vec!["allowed: one for all, or one for each".into()]);
        return None;
    }
    Some(if scaled { read.iter().zip(values).map(|(d, v)| d * v.abs()).collect() } else { read })
}

/// Numbers of modes, from 0, and as many values.
fn modes_and_values(
    table: &Table<'_>,
    values: (&'static str, &Quantity),
    deviations: (&'static str, &Quantity),
) -> Option<Vec<(usize, f64, f64)>> {
    let modes = table.required("mode").and_then(|value| one_or_more(&value, |mode| mode.whole(1, 10_000)));
    let measured = table.required(values.0).and_then(|value| one_or_more(&value, |one| one.number(values.1)));
    let deviations = measured.as_ref().and_then(|measured| read_deviations(table, deviations, measured));
    let (modes, measured, deviations) = (modes?, measured?, deviations?);
    if modes.len() != measured.len() {
        let message = format!("there are {} modes for {} numbers", modes.len(), measured.len());
        table.problem("mode", message, vec![format!("allowed: as many as in `{}`", values.0)]);
        return None;
    }
    let rows = modes.into_iter().zip(measured).zip(deviations);
    Some(rows.map(|((mode, value), deviation)| (mode as usize - 1, value, deviation)).collect())
}

const TABLES: [(&str, FrequencyTable); 4] = [
    ("clamped", FrequencyTable::Clamped),
    ("free-interface", FrequencyTable::FreeInterface),
    ("fixed-interface", FrequencyTable::FixedInterface),
    ("reduced", FrequencyTable::Reduced),
];

impl FrequencyTable {
    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        TABLES.iter().find(|(_, table)| *table == self).map_or("", |(name, _)| name)
    }
}

fn read_eigenfrequencies(table: Table<'_>, data: &mut Vec<Datum>) {
    let which = table.optional("table").map_or(Some(FrequencyTable::Clamped), |value| value.choice(&TABLES));
    let rows = modes_and_values(&table, ("hz", &quantity::FREQUENCY), ("deviation_hz", &quantity::FREQUENCY));
    let place = table.path_of("mode");
    table.finish();
    let (Some(which), Some(rows)) = (which, rows) else { return };
    data.extend(rows.into_iter().map(|(mode, value, deviation)| Datum {
        observation: Observation::Eigenfrequency(EigenfrequencyDatum { table: which, mode }),
        value,
        deviation,
        place: place.clone(),
    }));
}

fn read_damping(table: Table<'_>, data: &mut Vec<Datum>) {
    let quantity = &quantity::MEASURED_RATIO;
    let rows = modes_and_values(&table, ("ratio", quantity), ("deviation", quantity));
    let place = table.path_of("mode");
    table.finish();
    data.extend(rows.into_iter().flatten().map(|(mode, value, deviation)| Datum {
        observation: Observation::Damping(DampingDatum { mode }),
        value,
        deviation,
        place: place.clone(),
    }));
}

/// Maxima with the keys of their values and standard deviations.
const MAXIMA: [(&str, &str, Maximum); 4] = [
    ("max_abs_displacement_m", "displacement_deviation_m", Maximum::Displacement),
    ("max_abs_acceleration_m_s2", "acceleration_deviation_m_s2", Maximum::Acceleration),
    ("max_contact_force_n", "force_deviation_n", Maximum::ContactForce),
    ("max_impact_velocity_m_s", "velocity_deviation_m_s", Maximum::ImpactVelocity),
];

impl Maximum {
    /// Its key.
    #[must_use]
    pub fn name(self) -> &'static str {
        MAXIMA.iter().find(|(.., maximum)| *maximum == self).map_or("", |(name, ..)| name)
    }
}

fn read_orbit(table: Table<'_>, orbits: &mut Vec<MeasuredOrbit>, data: &mut Vec<Datum>) {
    let frequency = table.required("frequency_hz").and_then(|value| value.number(&quantity::FREQUENCY));
    let multiple = table.optional("period_multiple").map_or(Some(1), |value| value.whole(1, 64));
    let mut measured = Vec::new();
    for (key, deviation, of) in MAXIMA {
        let Some(value) = table.optional(key) else {
            if let Some(left) = table.optional(deviation) {
                left.problem(format!("`{deviation}` is given without `{key}`"), Vec::new());
            }
            continue;
        };
        let Some(value) = value.number(&quantity::MAXIMUM) else { continue };
        if let Some(deviations) = read_deviations(&table, (deviation, &quantity::MAXIMUM), &[value]) {
            measured.push((of, value, deviations[0]));
        }
    }
    if !MAXIMA.iter().any(|(key, ..)| table.has(key)) {
        let names: Vec<&str> = MAXIMA.iter().map(|(key, ..)| *key).collect();
        let help = vec![format!("allowed: one or more of {}", names.join(", "))];
        table.problem("frequency_hz", "nothing was measured of this response".into(), help);
    }
    let place = table.path_of("frequency_hz");
    table.finish();
    let (Some(frequency_hz), Some(period_multiple)) = (frequency, multiple) else { return };
    let orbit = orbits.len();
    orbits.push(MeasuredOrbit { frequency_hz, period_multiple, place: place.clone() });
    data.extend(measured.into_iter().map(|(of, value, deviation)| Datum {
        observation: Observation::Response(ResponseDatum { orbit, of }),
        value,
        deviation,
        place: place.clone(),
    }));
}
