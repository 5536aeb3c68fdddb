//! `[structure]` of kind "lumped": masses, springs and dampers on a line.

use serde::Serialize;

use crate::document::{Key, KeyRow, Quantity, Reading, TomlTable, quantity};

use super::names::{Names, read_name};

/// Masses that move along one line, joined by springs and dampers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LumpedTable {
    /// The masses; one degree of freedom each.
    pub masses: Vec<Mass>,
    /// Linear springs.
    pub springs: Vec<Spring>,
    /// Linear dampers.
    pub dampers: Vec<Damper>,
}

/// A mass.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mass {
    /// Name.
    pub name: String,
    /// Mass [kg].
    pub mass_kg: f64,
}

/// A linear spring between two masses, or a mass and the ground.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Spring {
    /// What it joins.
    pub between: [String; 2],
    /// Stiffness [N/m].
    pub stiffness_n_m: f64,
}

/// A linear damper between two masses, or a mass and the ground.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Damper {
    /// What it joins.
    pub between: [String; 2],
    /// Damping constant [N s/m].
    pub damping_n_s_m: f64,
}

const MASS: Key<Quantity> = Key::new("mass_kg", quantity::MASS, "its mass");
const STIFFNESS: Key<Quantity> = Key::new("stiffness_n_m", quantity::STIFFNESS, "stiffness of the spring");
const DAMPING: Key<Quantity> = Key::new("damping_n_s_m", quantity::DAMPER, "constant of the damper");

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    let list = |name, allowed: &str, default, meaning| KeyRow::read_apart(name, allowed, default, meaning);
    vec![
        list("kind", "`\"lumped\"`", "required", "what the structure is"),
        list("mass", "list of tables, at least one", "required", "the masses"),
        list("spring", "list of tables", "none", "linear springs"),
        list("damper", "list of tables", "none", "linear dampers"),
    ]
}

/// Those of `[[structure.mass]]`.
pub(super) fn rows_of_mass() -> Vec<KeyRow> {
    vec![KeyRow::read_apart("name", "text", "required", "name, each once"), MASS.row()]
}

/// Those of `[[structure.spring]]`.
pub(super) fn rows_of_spring() -> Vec<KeyRow> {
    vec![row_of_between(), STIFFNESS.row()]
}

/// Those of `[[structure.damper]]`.
pub(super) fn rows_of_damper() -> Vec<KeyRow> {
    vec![row_of_between(), DAMPING.row()]
}

fn row_of_between() -> KeyRow {
    KeyRow::read_apart("between", "two masses, or a mass and `\"ground\"`", "required", "what it joins")
}

pub(super) fn read(table: &TomlTable<'_>, reading: &Reading, names: &mut Names) -> Option<LumpedTable> {
    let before = reading.count();
    names.add_ground();
    table.required("mass")?;
    let masses = table.tables("mass");
    if masses.is_empty() && reading.count() == before {
        table.problem("mass", "`mass` is an empty list".into(), vec!["allowed: one mass or more".into()]);
    }
    let masses: Vec<Mass> = masses.into_iter().filter_map(|mass| read_mass(mass, names)).collect();
    let links = |key, constant: Key<Quantity>| -> Vec<([String; 2], f64)> {
        table.tables(key).into_iter().filter_map(|link| read_link(link, constant, names)).collect()
    };
    let (springs, dampers) = (links("spring", STIFFNESS), links("damper", DAMPING));
    (reading.count() == before).then(|| LumpedTable {
        masses,
        springs: springs.into_iter().map(|(between, k)| Spring { between, stiffness_n_m: k }).collect(),
        dampers: dampers.into_iter().map(|(between, d)| Damper { between, damping_n_s_m: d }).collect(),
    })
}

fn read_mass(table: TomlTable<'_>, names: &mut Names) -> Option<Mass> {
    let name = read_name(&table, names);
    let mass = MASS.read(&table);
    table.finish();
    Some(Mass { name: name?, mass_kg: mass? })
}

fn read_link(table: TomlTable<'_>, constant: Key<Quantity>, names: &Names) -> Option<([String; 2], f64)> {
    let between = table.required("between").and_then(|value| names.pair(&value, true));
    let constant = constant.read(&table);
    table.finish();
    Some((between?, constant?))
}
