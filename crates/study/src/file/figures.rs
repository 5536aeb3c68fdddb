//! `[figures]`: what is drawn of a results folder besides what it holds by itself.

use crate::document::{Key, KeyRow, Quantity, Reading, TomlTable, quantity};

use super::response::PERIOD_MULTIPLE;

/// What the figures of a study show; no part of its identity.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figures {
    /// Cut-off of the low-pass filter behind which accelerations of orbits are drawn as well [Hz].
    pub low_pass_hz: Option<f64>,
    /// Orbits that are drawn.
    pub orbits: Vec<DrawnOrbit>,
}

/// An orbit that is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnOrbit {
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Orbit period over excitation period.
    pub period_multiple: u32,
}

const LOW_PASS: Key<Quantity> = Key::new(
    "low_pass_hz",
    quantity::FREQUENCY,
    "cut-off of a low-pass filter, behind which the accelerations of the orbits are drawn as well",
)
.without("none");
const FREQUENCY: Key<Quantity> =
    Key::new("frequency_hz", quantity::FREQUENCY, "excitation frequency of the orbit");

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    let orbit = KeyRow::read_apart("orbit", "list of tables", "none", "orbits that are drawn, below");
    vec![LOW_PASS.row(), orbit]
}

/// Those of `[[figures.orbit]]`.
pub(super) fn rows_of_orbit() -> Vec<KeyRow> {
    vec![FREQUENCY.row(), PERIOD_MULTIPLE.row()]
}

pub(super) fn read(root: &TomlTable<'_>, reading: &Reading) -> Option<Figures> {
    let Some(value) = root.optional("figures") else { return Some(Figures::default()) };
    let table = value.table()?;
    let before = reading.count();
    let low_pass_hz = LOW_PASS.given(&table).flatten();
    let orbits = table.tables("orbit").into_iter().filter_map(read_orbit).collect();
    table.finish();
    (reading.count() == before).then_some(Figures { low_pass_hz, orbits })
}

fn read_orbit(table: TomlTable<'_>) -> Option<DrawnOrbit> {
    let frequency = FREQUENCY.read(&table);
    let multiple = PERIOD_MULTIPLE.read(&table);
    table.finish();
    Some(DrawnOrbit { frequency_hz: frequency?, period_multiple: multiple? })
}
