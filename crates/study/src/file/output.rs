//! `[[output]]`: what is read off the stored orbits, besides the response that every row has.
//!
//! Outputs are no part of the identity of a study: they are computed from stored orbits in a pass of their
//! own, so they may be added, changed and left out at any time.

use serde::{Deserialize, Serialize};

use crate::document::{
    Key, KeyRow, Reading, TomlTable, Value,
    key::{Whole, words},
};

use super::{
    Excitation, Stop,
    names::Names,
    output_value::{OutputQuantity, OutputValue},
};

/// Most outputs of a study.
const MOST: usize = 200;
const HARMONICS: Key<Whole> = Key::new(
    "harmonics",
    Whole(0, 50),
    "orders of the excitation frequency up to which there are amplitudes and phases",
)
.or(3);

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    let row =
        |name, allowed: String, default: &str, meaning| KeyRow::read_apart(name, allowed, default, meaning);
    let quantity = |of_stop: bool| {
        let is_of = move |quantity: &OutputQuantity| of_stop == (*quantity == OutputQuantity::Force);
        words(OutputQuantity::ALL.iter().copied().filter(is_of).map(OutputQuantity::word))
    };
    let [displacement, force] = [OutputQuantity::Displacement, OutputQuantity::Force]
        .map(|quantity| words([quantity.word()].into_iter()));
    let usual: Vec<String> = OutputValue::USUAL.iter().map(|value| format!("\"{}\"", value.word())).collect();
    vec![
        row(
            "name",
            "text".into(),
            "`\"output 1\"`, `\"output 2\"`, ...",
            "name in tables and figures, one for each output",
        ),
        row(
            "at",
            "a point, an end, a mass, a support that moves".into(),
            "required, or one of the next two",
            "the motion of this place, in space",
        ),
        row(
            "between",
            "two such names; also `\"ground\"` and `\"space\"`, which stand still".into(),
            "none",
            "the motion of the first place relative to the second",
        ),
        row(
            "stop",
            "the name of a stop".into(),
            "none",
            "the force on the stop; of a stop on both sides also one side, as `\"NAME (below)\"`",
        ),
        row(
            "quantity",
            format!("{}; of a stop {}", quantity(false), quantity(true)),
            &format!("{displacement}, of a stop {force}"),
            "what is read there",
        ),
        HARMONICS.row(),
        row(
            "figures",
            format!("list of {}", words(OutputValue::ALL.iter().copied().map(OutputValue::word))),
            &format!("`[{}]`", usual.join(", ")),
            "numbers that figures and the page show; tables have all of them",
        ),
    ]
}

/// Something that is read off orbits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OutputEntry {
    /// Its name in tables and figures.
    pub name: String,
    /// Where it is read.
    pub source: OutputSource,
    /// What is read there.
    pub quantity: OutputQuantity,
    /// Orders of the excitation frequency up to which there are harmonics.
    pub harmonics: u32,
    /// Numbers that figures show; computed are all of them.
    #[serde(skip)]
    pub figures: Vec<OutputValue>,
}

/// Where an output is read.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OutputSource {
    /// A point in space.
    At(OutputPlace),
    /// The first place relative to the second.
    Between(OutputPlace, OutputPlace),
    /// The force on a stop.
    Stop {
        /// Its places in the list of stops, each with whether it counts the other way: of one on both sides
        /// the side below.
        sides: Vec<(usize, bool)>,
    },
}

/// A place that moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OutputPlace {
    /// A point of the structure.
    Point(String),
    /// A support that moves, by its number from 0.
    Support(usize),
    /// What stands still.
    Space,
}

/// What outputs may refer to.
pub(super) struct Referred<'a> {
    pub names: &'a Names,
    pub excitation: Option<&'a Excitation>,
    pub stops: Option<&'a [Stop]>,
}

pub(super) fn read(
    root: &TomlTable<'_>,
    reading: &Reading,
    referred: &Referred<'_>,
) -> Option<Vec<OutputEntry>> {
    let before = reading.count();
    let tables = root.tables("output");
    if tables.len() > MOST {
        let help = vec![format!("allowed: at most {MOST}")];
        root.problem("output", format!("there are {} outputs", tables.len()), help);
    }
    let mut outputs: Vec<OutputEntry> = Vec::new();
    for (index, table) in tables.into_iter().enumerate() {
        let name = read_name(&table, index, &outputs);
        let read = read_output(table, referred);
        if let (Some(name), Some(output)) = (name, read) {
            outputs.push(OutputEntry { name, ..output });
        }
    }
    (reading.count() == before).then_some(outputs)
}

/// The name given, or "output 1", "output 2", ...
fn read_name(table: &TomlTable<'_>, index: usize, others: &[OutputEntry]) -> Option<String> {
    let Some(value) = table.optional("name") else { return Some(format!("output {}", index + 1)) };
    let name = value.text()?;
    let is_taken = others.iter().any(|other| other.name == name);
    if name.trim().is_empty() || is_taken {
        let what = if is_taken { "taken" } else { "empty" };
        let help = vec!["allowed: a name of its own for each output".to_owned()];
        value.problem(format!("`name` is \"{name}\", which is {what}"), help);
        return None;
    }
    Some(name.to_owned())
}

fn read_output(table: TomlTable<'_>, referred: &Referred<'_>) -> Option<OutputEntry> {
    let source = read_source(&table, referred);
    let quantity = read_quantity(&table, source.as_ref());
    let harmonics = HARMONICS.read(&table);
    let figures = table.optional("figures").map_or(Some(OutputValue::USUAL.into()), read_figures);
    table.finish();
    let figures: Vec<OutputValue> = figures?;
    let harmonics = harmonics?;
    Some(OutputEntry { name: String::new(), source: source?, quantity: quantity?, harmonics, figures })
}

fn read_source(table: &TomlTable<'_>, referred: &Referred<'_>) -> Option<OutputSource> {
    let keys = ["at", "between", "stop"];
    let given: Vec<&str> = keys.into_iter().filter(|key| table.has(key)).collect();
    if given.len() != 1 {
        keys.iter().for_each(|key| drop(table.optional(key)));
        let what = if given.is_empty() { "none".to_owned() } else { given.join(" and ") };
        let help = vec!["allowed: `at` a point, `between` two places, or a `stop`".to_owned()];
        table.problem("name", format!("of `at`, `between` and `stop` there is {what}"), help);
        return None;
    }
    let [at, between, stop] = keys.map(|key| table.optional(key));
    if let Some(value) = at {
        return read_place(&value, referred).map(OutputSource::At);
    }
    if let Some(value) = between {
        let read = |value: &Value<'_>| read_place(value, referred);
        let [first, second] = value.exactly::<2, OutputPlace>("2 names", read)?;
        if first == second {
            let help = vec!["allowed: two different places".to_owned()];
            value.problem("`between` names one place twice".to_owned(), help);
            return None;
        }
        return Some(OutputSource::Between(first, second));
    }
    read_stop(&stop?, referred.stops?)
}

/// A point, a support that moves, or `space`.
fn read_place(value: &Value<'_>, referred: &Referred<'_>) -> Option<OutputPlace> {
    let name = value.text()?;
    if let Some(support) = referred.excitation.and_then(|excitation| excitation.support_at(name)) {
        return Some(OutputPlace::Support(support));
    }
    if name == "space" || name == "ground" && !referred.names.observable().contains(&name) {
        return Some(OutputPlace::Space);
    }
    referred.names.point(value).map(OutputPlace::Point)
}

/// A stop as a whole, or one side of it.
fn read_stop(value: &Value<'_>, stops: &[Stop]) -> Option<OutputSource> {
    let name = value.text()?;
    if let Some(index) = stops.iter().position(|stop| stop.name == name) {
        return Some(OutputSource::Stop { sides: vec![(index, false)] });
    }
    if let Some(above) = stops.iter().position(|stop| stop.name_of_both_sides() == Some(name)) {
        return Some(OutputSource::Stop { sides: vec![(above, false), (above + 1, true)] });
    }
    let known: Vec<&str> = stops.iter().map(|stop| stop.name.as_str()).collect();
    value.unknown_word(name, "a stop of this study", &known);
    None
}

/// Of a stop the force, of places a displacement or what it changes by.
fn read_quantity(table: &TomlTable<'_>, source: Option<&OutputSource>) -> Option<OutputQuantity> {
    let is_stop = matches!(source, Some(OutputSource::Stop { .. }));
    let usual = if is_stop { OutputQuantity::Force } else { OutputQuantity::Displacement };
    let Some(value) = table.optional("quantity") else { return Some(usual) };
    let known = OutputQuantity::ALL.map(|quantity| (quantity.word(), quantity));
    let quantity = value.choice(&known)?;
    if source.is_some() && is_stop != (quantity == OutputQuantity::Force) {
        let what = if is_stop { "a stop has a force" } else { "a point moves" };
        let allowed: Vec<&str> = known
            .iter()
            .filter(|(_, known)| is_stop == (*known == OutputQuantity::Force))
            .map(|(word, _)| *word)
            .collect();
        let help = vec![format!("allowed: {}", allowed.join(", "))];
        value.problem(format!("`quantity` is \"{}\", but {what}", quantity.word()), help);
        return None;
    }
    Some(quantity)
}

fn read_figures(value: Value<'_>) -> Option<Vec<OutputValue>> {
    let known = OutputValue::ALL.map(|known| (known.word(), known));
    let elements = value.array_of("numbers of an output")?;
    let read: Vec<Option<OutputValue>> = elements.iter().map(|element| element.choice(&known)).collect();
    read.into_iter().collect()
}
