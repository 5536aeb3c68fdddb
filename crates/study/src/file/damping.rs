//! `[damping]`: damping of the modes, besides discrete dampers.

use serde::Serialize;

use crate::document::{TomlTable, Value, quantity};

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

pub(super) fn read(root: &TomlTable<'_>) -> Option<DampingTable> {
    let none = DampingTable::Modal(ModalRatio::Every(0.0));
    let Some(value) = root.optional("damping") else { return Some(none) };
    let table = value.table()?;
    let modal = table.optional("modal_ratio");
    let rayleigh = table.optional("rayleigh");
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
        return value.number(&quantity::DAMPING_RATIO).map(ModalRatio::Every);
    }
    let ratios = value.array_of("damping ratios")?;
    if ratios.is_empty() {
        value.problem("`modal_ratio` is an empty list".into(), vec!["allowed: one ratio per mode".into()]);
        return None;
    }
    let ratios: Vec<Option<f64>> =
        ratios.iter().map(|ratio| ratio.number(&quantity::DAMPING_RATIO)).collect();
    ratios.into_iter().collect::<Option<Vec<f64>>>().map(ModalRatio::Each)
}

fn read_rayleigh(value: &Value<'_>) -> Option<DampingTable> {
    let table = value.table()?;
    let mass = table.required("mass_per_s").and_then(|value| value.number(&quantity::RAYLEIGH_MASS));
    let stiffness =
        table.required("stiffness_s").and_then(|value| value.number(&quantity::RAYLEIGH_STIFFNESS));
    table.finish();
    Some(DampingTable::Rayleigh { mass_per_s: mass?, stiffness_s: stiffness? })
}
