//! The measured numbers of a data file: eigenfrequencies, damping ratios, responses, each with its standard
//! deviation.

use hammerbeam_study::document::{Quantity, TomlTable, Value, quantity};

use super::data::{
    DampingDatum, Datum, EigenfrequencyDatum, FrequencyTable, Maximum, MeasuredDatum, MeasuredOrbit,
    ResponseDatum,
};

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
fn read_deviations(
    table: &TomlTable<'_>,
    own: (&'static str, &Quantity),
    values: &[f64],
) -> Option<Vec<f64>> {
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
    table: &TomlTable<'_>,
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

pub(super) fn read_eigenfrequencies(table: TomlTable<'_>, data: &mut Vec<Datum>) {
    let which = table.optional("table").map_or(Some(FrequencyTable::Clamped), |value| value.choice(&TABLES));
    let rows = modes_and_values(&table, ("hz", &quantity::FREQUENCY), ("deviation_hz", &quantity::FREQUENCY));
    let place = table.path_of("mode");
    table.finish();
    let (Some(which), Some(rows)) = (which, rows) else { return };
    data.extend(rows.into_iter().map(|(mode, value, deviation)| Datum {
        observation: MeasuredDatum::Eigenfrequency(EigenfrequencyDatum { table: which, mode }),
        value,
        deviation,
        place: place.clone(),
    }));
}

pub(super) fn read_damping(table: TomlTable<'_>, data: &mut Vec<Datum>) {
    let quantity = &quantity::MEASURED_RATIO;
    let rows = modes_and_values(&table, ("ratio", quantity), ("deviation", quantity));
    let place = table.path_of("mode");
    table.finish();
    data.extend(rows.into_iter().flatten().map(|(mode, value, deviation)| Datum {
        observation: MeasuredDatum::Damping(DampingDatum { mode }),
        value,
        deviation,
        place: place.clone(),
    }));
}

/// Maxima with the keys of their values and standard deviations.
const MAXIMA: [(&str, &str, Maximum); 5] = [
    ("max_abs_displacement_m", "displacement_deviation_m", Maximum::Displacement),
    ("max_abs_velocity_m_s", "abs_velocity_deviation_m_s", Maximum::Velocity),
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

pub(super) fn read_orbit(table: TomlTable<'_>, orbits: &mut Vec<MeasuredOrbit>, data: &mut Vec<Datum>) {
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
        observation: MeasuredDatum::Response(ResponseDatum { orbit, of }),
        value,
        deviation,
        place: place.clone(),
    }));
}
