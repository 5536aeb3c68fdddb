//! Where a stop sits: at a point, around one, or between two; and what carries it.

use serde::Serialize;

use super::{Excitation, names::Names};
use crate::document::{TomlTable, Value};

/// Where an element sits; with it goes the relative displacement `r`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// Between a point and its surroundings: `r` is the displacement of the point relative to what the stop
    /// is fixed to.
    At {
        /// Point.
        point: String,
        /// What carries the stop.
        fixed_to: FixedTo,
    },
    /// Around a point, by its displacements in two directions across the axis of a round hole.
    Around {
        /// First direction.
        first: String,
        /// Second direction.
        second: String,
        /// What carries the hole in each.
        fixed_to: [FixedTo; 2],
    },
    /// Between two points: `r = y_first - y_second`.
    Between {
        /// First point.
        first: String,
        /// Second point.
        second: String,
    },
}

/// What carries a stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FixedTo {
    /// It rides on a moving support, of this number from 0.
    Support(usize),
    /// It does not move.
    Space,
}

impl Serialize for FixedTo {
    /// The first support, the only one of most studies, has no number.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Space => serializer.serialize_str("space"),
            Self::Support(0) => serializer.serialize_str("support"),
            Self::Support(number) => serializer.serialize_str(&format!("support {}", number + 1)),
        }
    }
}

pub(super) fn read(table: &TomlTable<'_>, names: &Names, excitation: Option<&Excitation>) -> Option<Place> {
    let Some(between) = table.optional("between") else {
        let at = table.required("at");
        if let Some(pair) = at.as_ref().filter(|value| value.is_list()) {
            return read_around(table, pair, names, excitation);
        }
        let point = at.and_then(|value| names.point(&value));
        let fixed_to = read_fixed_to(table, names, excitation);
        return Some(Place::At { point: point?, fixed_to: fixed_to? });
    };
    for key in ["at", "fixed_to"] {
        if let Some(value) = table.optional(key) {
            let help = vec!["allowed: either `between`, or `at` with `fixed_to`".into()];
            value.problem(format!("`{key}` is given besides `between`"), help);
        }
    }
    let [first, second] = names.pair(&between, false)?;
    Some(Place::Between { first, second })
}

/// A moving support by its name, or what stands still; by default the moving support if there is one.
fn read_fixed_to(table: &TomlTable<'_>, names: &Names, excitation: Option<&Excitation>) -> Option<FixedTo> {
    let Some(value) = table.optional("fixed_to") else {
        return match excitation.map_or(0, |excitation| excitation.supports().len()) {
            0 => Some(FixedTo::Space),
            1 => Some(FixedTo::Support(0)),
            several => {
                let message = format!("`fixed_to` is missing: {several} supports move differently");
                let known = carriers(names, excitation).join(", ");
                table.problem("fixed_to", message, vec![format!("allowed: {known}")]);
                None
            }
        };
    };
    carrier(&value, names, excitation)
}

/// What carries a stop, by its name.
fn carrier(value: &Value<'_>, names: &Names, excitation: Option<&Excitation>) -> Option<FixedTo> {
    let known = carriers(names, excitation);
    let name = value.text()?;
    if let Some(support) = excitation.and_then(|excitation| excitation.support_at(name)) {
        return Some(FixedTo::Support(support));
    }
    if excitation.is_some() && !known.contains(&name) {
        value.unknown_word(name, "a support, \"space\" or \"ground\"", &known);
        return None;
    }
    Some(FixedTo::Space)
}

/// The names of what may carry a stop.
fn carriers<'a>(names: &'a Names, excitation: Option<&'a Excitation>) -> Vec<&'a str> {
    let moving = excitation.map_or_else(Vec::new, Excitation::moving_places);
    let mut known = moving.clone();
    known
        .extend(["space", "ground"].iter().chain(&names.held_ends()).filter(|still| !moving.contains(still)));
    known
}

/// Reads where a hole is, from the two points of `at`.
fn read_around(
    table: &TomlTable<'_>,
    at: &Value<'_>,
    names: &Names,
    excitation: Option<&Excitation>,
) -> Option<Place> {
    let pair = names.pair(at, false);
    let fixed_to = read_carriers(table, names, excitation);
    let [first, second] = pair?;
    Some(Place::Around { first, second, fixed_to: fixed_to? })
}

/// What carries the hole, in both directions alike or in each by itself; without moving supports nothing that
/// moves.
fn read_carriers(
    table: &TomlTable<'_>,
    names: &Names,
    excitation: Option<&Excitation>,
) -> Option<[FixedTo; 2]> {
    let Some(value) = table.optional("fixed_to") else {
        if excitation.is_none_or(|excitation| excitation.supports().is_empty()) {
            return Some([FixedTo::Space; 2]);
        }
        let help = "allowed: \"space\", or two names, as [\"left.y\", \"left.z\"]";
        table.problem(
            "fixed_to",
            "`fixed_to` is missing: supports move, and a round hole has two directions".to_owned(),
            vec![help.to_owned()],
        );
        return None;
    };
    if !value.is_list() {
        return carrier(&value, names, excitation).map(|carrier| [carrier; 2]);
    }
    value.exactly::<2, FixedTo>("2 names", |name| carrier(name, names, excitation))
}
