//! The same physics with another origin of time, another direction, or other names.

use std::f64::consts::{PI, TAU};

use toml::{Table, Value};

use super::units::number;

/// All harmonics earlier by a part of the excitation period: of order m by m times its angle.
#[must_use]
pub fn shifted(study: &Table, cycles: f64) -> Table {
    let mut study = study.clone();
    turn_phase(table(&mut study, "excitation"), 1, TAU * cycles);
    for load in tables(&mut study, "load") {
        turn_phase(load, 0, TAU * cycles);
    }
    study
}

/// All displacements negated. The amplitude of the excitation is positive, so its phase turns by half a
/// cycle.
#[must_use]
pub fn mirrored(study: &Table) -> Table {
    let mut study = study.clone();
    let excitation = table(&mut study, "excitation");
    let phase = excitation.get("phase_rad").and_then(number).unwrap_or(0.0);
    excitation.insert("phase_rad".into(), Value::Float(phase + PI));
    for load in tables(&mut study, "load") {
        for key in ["acceleration_m_s2", "amplitude_n", "amplitude_m"] {
            if let Some(amplitude) = load.get(key).and_then(number) {
                load.insert(key.into(), Value::Float(-amplitude));
            }
        }
    }
    tables(&mut study, "stop").for_each(turn_stop);
    study
}

/// Masses, springs, dampers, loads and stops in the reverse order, masses under other names, pairs the other
/// way round; a beam with its ends exchanged.
#[must_use]
pub fn swapped(study: &Table) -> Table {
    let mut study = with_response_point(study);
    for stop in tables(&mut study, "stop") {
        if let Some(Value::Array(pair)) = stop.get_mut("between") {
            pair.reverse();
            turn_stop(stop);
        }
    }
    let structure = table(&mut study, "structure");
    let length = structure.get("length_m").and_then(number);
    for key in ["spring", "damper"] {
        for connection in tables(structure, key) {
            if let Some(Value::Array(pair)) = connection.get_mut("between") {
                pair.reverse();
            }
        }
    }
    if let (Some(left), Some(right)) = (structure.remove("left"), structure.remove("right")) {
        structure.extend([("left".into(), right), ("right".into(), left)]);
    }
    for point in tables(structure, "point") {
        if let Some((at, length)) = point.get("at_m").and_then(number).zip(length) {
            point.insert("at_m".into(), Value::Float(length - at));
        }
    }
    for key in ["mass", "spring", "damper", "point"] {
        reverse(structure, key);
    }
    reverse(&mut study, "stop");
    reverse(&mut study, "load");
    renamed_in(&mut study);
    study
}

/// A stop on the other side; one on both sides stays.
fn turn_stop(stop: &mut Table) {
    let other = match stop.get("side").and_then(Value::as_str) {
        Some("above") => Some("below"),
        Some("below") => Some("above"),
        _ => None,
    };
    if let Some(other) = other {
        stop.insert("side".into(), Value::String(other.into()));
    }
    if let (Some(above), Some(below)) = (stop.remove("gap_above_m"), stop.remove("gap_below_m")) {
        stop.extend([("gap_above_m".into(), below), ("gap_below_m".into(), above)]);
    }
}

fn turn_phase(harmonic: &mut Table, default_order: i64, angle: f64) {
    let order = harmonic.get("order").and_then(Value::as_integer).unwrap_or(default_order);
    if order > 0 {
        let phase = harmonic.get("phase_rad").and_then(number).unwrap_or(0.0);
        harmonic.insert("phase_rad".into(), Value::Float(phase + order as f64 * angle));
    }
}

/// The study with the response point written out, since the default is that of the first stop or mass.
fn with_response_point(study: &Table) -> Table {
    let mut study = study.clone();
    let of_stop = tables(&mut study, "stop").next().and_then(|stop| {
        let between = stop.get("between").and_then(Value::as_array).and_then(|pair| pair.first());
        stop.get("at").or(between).cloned()
    });
    let structure = table(&mut study, "structure");
    let first = |structure: &mut Table, key| {
        tables(structure, key).next().and_then(|entry| entry.get("name").cloned())
    };
    let of_structure = first(structure, "mass").or_else(|| first(structure, "point"));
    let point = of_stop.or(of_structure).unwrap_or_else(|| "right".into());
    let response = study.entry("response").or_insert_with(|| Table::new().into());
    if let Some(response) = response.as_table_mut() {
        response.entry("point").or_insert(point);
    }
    study
}

/// Other names wherever a name stands; the ends of a beam become each other.
fn renamed_in(table: &mut Table) {
    for (key, value) in table.iter_mut() {
        match value {
            Value::Table(inner) => renamed_in(inner),
            Value::Array(entries) if entries.iter().all(Value::is_table) => {
                entries.iter_mut().filter_map(Value::as_table_mut).for_each(renamed_in);
            }
            Value::Array(entries) if ["between", "at"].contains(&key.as_str()) => {
                entries.iter_mut().for_each(rename);
            }
            _ if ["at", "fixed_to", "point", "name"].contains(&key.as_str()) => rename(value),
            _ => {}
        }
    }
}

fn rename(name: &mut Value) {
    let renamed = match name.as_str() {
        Some("left") => "right".to_owned(),
        Some("right") => "left".to_owned(),
        Some(kept @ ("ground" | "space" | "support")) => kept.to_owned(),
        Some(other) => format!("{other}, renamed"),
        None => return,
    };
    *name = Value::String(renamed);
}

fn reverse(table: &mut Table, key: &str) {
    if let Some(Value::Array(entries)) = table.get_mut(key) {
        entries.reverse();
    }
}

fn table<'a>(of: &'a mut Table, key: &str) -> &'a mut Table {
    of.get_mut(key).and_then(Value::as_table_mut).expect("a study has a structure and an excitation")
}

fn tables<'a>(of: &'a mut Table, key: &str) -> impl Iterator<Item = &'a mut Table> {
    let entries = of.get_mut(key).and_then(Value::as_array_mut);
    entries.into_iter().flatten().filter_map(Value::as_table_mut)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn study() -> Table {
        include_str!("../../../studies/two-masses.toml").parse().expect("a study")
    }

    #[test]
    fn the_mirror_image_of_a_mirror_image_is_the_study_half_a_cycle_twice_later() {
        let twice = mirrored(&mirrored(&study()));
        assert_eq!(twice["stop"], study()["stop"]);
        assert_eq!(twice["excitation"]["phase_rad"].as_float(), Some(TAU));
    }

    #[test]
    fn swapping_twice_changes_names_only() {
        let twice = swapped(&swapped(&study()));
        let text = twice.to_string().replace(", renamed", "");
        let back: Table = text.parse().expect("a study");
        assert_eq!(back["structure"], study()["structure"]);
        assert_eq!(back["stop"], study()["stop"]);
    }
}
