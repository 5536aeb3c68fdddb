//! `[damping]`: damping of the modes, besides discrete dampers.

use serde::Serialize;

use crate::document::{Key, KeyRow, Quantity, TomlTable, Value, quantity};

/// Damping of the motion relative to the support. Discrete dampers count besides.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum DampingTable {
    /// Ratio to critical damping of the modes.
    Modal(ModalRatio),
    /// `C = a M + b K`.
    Rayleigh {
        /// `a` [1/s].
        mass_per_s: f64,
        /// `b` [s].
        stiffness_s: f64,
    },
}

/// Ratios to critical damping.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ModalRatio {
    /// The same for every mode.
    Every(f64),
    /// One for each mode of the reduced model, lowest first.
    Each(Vec<f64>),
}

const MODAL_RATIO: Key<Quantity> = Key::new(
    "modal_ratio",
    quantity::DAMPING_RATIO,
    "ratio to critical damping, of every mode or of each mode of the reduced model, lowest first; 1.5 % is \
     `0.015`",
)
.further(", or a list of such numbers")
.without("none");
const RAYLEIGH: &str = "rayleigh";
const RAYLEIGH_MASS: Key<Quantity> =
    Key::new("mass_per_s", quantity::RAYLEIGH_MASS, "part `a` of `C = a M + b K`");
const RAYLEIGH_STIFFNESS: Key<Quantity> =
    Key::new("stiffness_s", quantity::RAYLEIGH_STIFFNESS, "part `b` of it");

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    let table = "table, below";
    vec![MODAL_RATIO.row(), KeyRow::read_apart(RAYLEIGH, table, "none", "damping after Rayleigh")]
}

/// Those of `rayleigh`.
pub(super) fn rows_of_rayleigh() -> Vec<KeyRow> {
    vec![RAYLEIGH_MASS.row(), RAYLEIGH_STIFFNESS.row()]
}

pub(super) fn read(root: &TomlTable<'_>) -> Option<DampingTable> {
    let none = DampingTable::Modal(ModalRatio::Every(0.0));
    let Some(value) = root.optional("damping") else { return Some(none) };
    let table = value.table()?;
    let modal = table.optional(MODAL_RATIO.name);
    let rayleigh = table.optional(RAYLEIGH);
    let damping = match (modal, rayleigh) {
        (Some(_), Some(rayleigh)) => {
            let help = vec!["allowed: one of `modal_ratio` and `rayleigh`".into()];
            rayleigh.problem("`rayleigh` is given besides `modal_ratio`".into(), help);
            None
        }
        (Some(modal), None) => read_modal(&modal).map(DampingTable::Modal),
        (None, Some(rayleigh)) => read_rayleigh(&rayleigh),
        (None, None) => Some(none),
    };
    table.finish();
    damping
}

fn read_modal(value: &Value<'_>) -> Option<ModalRatio> {
    if !value.is_list() {
        return value.number(&MODAL_RATIO.range).map(ModalRatio::Every);
    }
    let ratios = value.array_of("damping ratios")?;
    if ratios.is_empty() {
        value.problem("`modal_ratio` is an empty list".into(), vec!["allowed: one ratio per mode".into()]);
        return None;
    }
    let ratios: Vec<Option<f64>> = ratios.iter().map(|ratio| ratio.number(&MODAL_RATIO.range)).collect();
    ratios.into_iter().collect::<Option<Vec<f64>>>().map(ModalRatio::Each)
}

fn read_rayleigh(value: &Value<'_>) -> Option<DampingTable> {
    let table = value.table()?;
    let mass = RAYLEIGH_MASS.read(&table);
    let stiffness = RAYLEIGH_STIFFNESS.read(&table);
    table.finish();
    Some(DampingTable::Rayleigh { mass_per_s: mass?, stiffness_s: stiffness? })
}
