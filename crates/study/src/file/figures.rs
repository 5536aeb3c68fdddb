//! `[figures]`: what is drawn of a results folder besides what it holds by itself.

use crate::document::{Reading, TomlTable, quantity};

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

pub(super) fn read(root: &TomlTable<'_>, reading: &Reading) -> Option<Figures> {
    let Some(value) = root.optional("figures") else { return Some(Figures::default()) };
    let table = value.table()?;
    let before = reading.count();
    let low_pass_hz = table.optional("low_pass_hz").and_then(|value| value.number(&quantity::FREQUENCY));
    let orbits = table.tables("orbit").into_iter().filter_map(read_orbit).collect();
    table.finish();
    (reading.count() == before).then_some(Figures { low_pass_hz, orbits })
}

fn read_orbit(table: TomlTable<'_>) -> Option<DrawnOrbit> {
    let frequency = table.required("frequency_hz").and_then(|value| value.number(&quantity::FREQUENCY));
    let multiple = table.optional("period_multiple").map_or(Some(1), |value| value.whole(1, 64));
    table.finish();
    Some(DrawnOrbit { frequency_hz: frequency?, period_multiple: multiple? })
}
