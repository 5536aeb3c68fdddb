//! Directions: names, vectors.

use hammerbeam_structure::Direction;

use crate::document::{Value, quantity};

use super::entries::DirectionEntry;

pub(super) fn read_name_of_direction(value: &Value<'_>) -> Option<String> {
    let name = value.text()?;
    if Direction::named(name).is_none() {
        value.unknown_word(name, "a direction", &["x", "y", "z", "rx", "ry", "rz"]);
        return None;
    }
    Some(name.to_owned())
}

pub(super) fn read_direction(value: &Value<'_>) -> Option<DirectionEntry> {
    if value.is_text() {
        return read_name_of_direction(value).map(DirectionEntry::Named);
    }
    read_vector(value).map(DirectionEntry::Vector)
}

/// A direction in space: `x`, `-y`, or three numbers.
pub(super) fn read_vector(value: &Value<'_>) -> Option<[f64; 3]> {
    if !value.is_text() {
        let vector = value.numbers::<3>(&quantity::DIRECTION)?;
        if vector == [0.0; 3] {
            value.problem(
                "the direction has no length".into(),
                vec!["allowed: three numbers, not all 0".into()],
            );
            return None;
        }
        return Some(vector);
    }
    let name = value.text()?;
    let (sign, axis) = name.strip_prefix('-').map_or((1.0, name), |axis| (-1.0, axis));
    match axis {
        "x" => Some([sign, 0.0, 0.0]),
        "y" => Some([0.0, sign, 0.0]),
        "z" => Some([0.0, 0.0, sign]),
        _ => {
            value.unknown_word(name, "a direction in space", &["x", "y", "z", "-x", "-y", "-z"]);
            None
        }
    }
}
