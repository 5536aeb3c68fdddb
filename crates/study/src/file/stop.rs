//! `[[stop]]`: a local element, where it sits and what it pushes against.

use serde::Serialize;

use crate::document::{Reading, TomlTable};

use super::{
    Excitation, StopLaw,
    names::Names,
    read_stop_law::{self, ReadLaw},
};

/// A local non-linear element.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Stop {
    /// Name for reports.
    pub name: String,
    /// Place in the list of the file, from 0, if it has that place alone; no part of the identity.
    #[serde(skip)]
    pub entry: StopEntry,
    /// Where it sits.
    pub place: Place,
    /// Its force law.
    pub law: StopLaw,
}

/// What of the list of a file a stop is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopEntry {
    /// The entry with this number, from 0.
    Whole(usize),
    /// One side of it.
    OneSide(usize),
}

impl StopEntry {
    /// The number of the entry, from 0.
    #[must_use]
    pub fn number(self) -> usize {
        match self {
            Self::Whole(number) | Self::OneSide(number) => number,
        }
    }
}

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

pub(super) fn read(
    root: &TomlTable<'_>,
    reading: &Reading,
    names: &Names,
    excitation: Option<&Excitation>,
) -> Option<Vec<Stop>> {
    let before = reading.count();
    let mut stops: Vec<Stop> = Vec::new();
    let mut taken: Vec<String> = Vec::new();
    for (index, table) in root.tables("stop").into_iter().enumerate() {
        let name = read_name(&table, index, &taken);
        let read = read_stop(table, names, excitation);
        if let (Some(name), Some((place, law))) = (name, read) {
            let found = of_law(&name, index, &place, law);
            let clash = found.iter().filter(|stop| stop.name != name).find(|stop| taken.contains(&stop.name));
            if let Some(clash) = clash {
                let message =
                    format!("a side of stop \"{name}\" is \"{}\", a name that is taken", clash.name);
                root.problem("stop", message, vec!["allowed: a name of its own for each stop".into()]);
            }
            taken.extend(found.iter().map(|stop| stop.name.clone()).chain([name]));
            stops.extend(found);
        }
    }
    (reading.count() == before).then_some(stops)
}

/// The stop, or its two sides, "NAME (above)" and "NAME (below)".
fn of_law(name: &str, index: usize, place: &Place, law: ReadLaw) -> Vec<Stop> {
    let stop = |name: String, entry, law| Stop { name, entry, place: place.clone(), law };
    match law {
        ReadLaw::One(law) => vec![stop(name.to_owned(), StopEntry::Whole(index), law)],
        ReadLaw::Pair([above, below]) => vec![
            stop(format!("{name} (above)"), StopEntry::OneSide(index), above),
            stop(format!("{name} (below)"), StopEntry::OneSide(index), below),
        ],
    }
}

/// The name given, or "stop 1", "stop 2", ...
fn read_name(table: &TomlTable<'_>, index: usize, taken: &[String]) -> Option<String> {
    let Some(value) = table.optional("name") else { return Some(format!("stop {}", index + 1)) };
    let name = value.text()?;
    if name.trim().is_empty() || taken.iter().any(|other| other == name) {
        let message = format!(
            "`name` is \"{name}\", which is {}",
            if name.trim().is_empty() { "empty" } else { "taken" }
        );
        value.problem(message, vec!["allowed: a name of its own for each stop".into()]);
        return None;
    }
    Some(name.to_owned())
}

fn read_stop(
    table: TomlTable<'_>,
    names: &Names,
    excitation: Option<&Excitation>,
) -> Option<(Place, ReadLaw)> {
    let place = read_place(&table, names, excitation);
    // Which keys a stop may have, its law says.
    let description = read_stop_law::read_description(&table)?;
    let law = read_stop_law::read(&table, description);
    table.finish();
    Some((place?, law?))
}

fn read_place(table: &TomlTable<'_>, names: &Names, excitation: Option<&Excitation>) -> Option<Place> {
    let Some(between) = table.optional("between") else {
        let point = table.required("at").and_then(|value| names.point(&value));
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
    let moving = excitation.map_or_else(Vec::new, Excitation::moving_places);
    let mut known = moving.clone();
    known
        .extend(["space", "ground"].iter().chain(&names.held_ends()).filter(|still| !moving.contains(still)));
    let Some(value) = table.optional("fixed_to") else {
        return match excitation.map_or(0, |excitation| excitation.supports().len()) {
            0 => Some(FixedTo::Space),
            1 => Some(FixedTo::Support(0)),
            several => {
                let message = format!("`fixed_to` is missing: {several} supports move differently");
                table.problem("fixed_to", message, vec![format!("allowed: {}", known.join(", "))]);
                None
            }
        };
    };
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
