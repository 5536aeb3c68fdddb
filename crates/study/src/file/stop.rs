//! `[[stop]]`: a local element, where it sits and what it pushes against.

use serde::Serialize;

use crate::document::{Reading, TomlTable};

use super::{
    Excitation, StopLaw,
    names::Names,
    read_round_hole,
    read_stop_law::{self, ReadLaw},
    stop_place::{self, Place},
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

impl Stop {
    /// The name of the entry of which this is the side above; the side below is the next stop.
    #[must_use]
    pub fn name_of_both_sides(&self) -> Option<&str> {
        let is_side = matches!(self.entry, StopEntry::OneSide(_));
        self.name.strip_suffix(ABOVE).filter(|_| is_side)
    }
}

/// What the names of the sides of a stop end with.
const ABOVE: &str = " (above)";
const BELOW: &str = " (below)";

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
            stop(format!("{name}{ABOVE}"), StopEntry::OneSide(index), above),
            stop(format!("{name}{BELOW}"), StopEntry::OneSide(index), below),
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
    let place = stop_place::read(&table, names, excitation);
    // Which keys a stop may have, its law says.
    let description = read_stop_law::read_description(&table)?;
    let is_around = table.optional("at").is_some_and(|value| value.is_list());
    let law = if is_around {
        read_round_hole::read(&table, description)
    } else {
        read_stop_law::read(&table, description)
    };
    table.finish();
    Some((place?, law?))
}
