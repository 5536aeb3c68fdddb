//! `[search]`: how thoroughly a run looks for branches that nothing leads to.

use serde::Serialize;

use crate::document::TomlTable;

/// Where and how thoroughly orbits are looked for by simulation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Search {
    /// Number of frequencies, in the middles of equal parts of the range.
    pub frequencies: u32,
    /// Starting states at each of them, besides the linear response.
    pub starts: u32,
    /// Excitation periods that a motion has to settle.
    pub settling_periods: u32,
    /// Trials without a new harmonic solution at each of eight frequencies in each part of the range.
    pub trials: u32,
    /// Whether branches also begin at unstable solutions, and leave at the flips of unstable ones.
    pub unstable_starts: bool,
}

pub(super) fn read(root: &TomlTable<'_>) -> Option<Search> {
    let table = match root.optional("search") {
        Some(value) => Some(value.table()?),
        None => None,
    };
    let key = |key, low, high, default| {
        let value = table.as_ref().and_then(|table| table.optional(key));
        value.map_or(Some(default), |value| value.whole(low, high))
    };
    let frequencies = key("frequencies", 0, 100_000, 24);
    let starts = key("starts", 0, 100_000, 6);
    let settling = key("settling_periods", 1, 1_000_000, 128);
    let trials = key("trials", 0, 100_000, 12);
    let unstable = table.as_ref().and_then(|table| table.optional("unstable_starts"));
    let unstable = unstable.map_or(Some(true), |value| value.boolean());
    if let Some(table) = table {
        table.finish();
    }
    Some(Search {
        frequencies: frequencies?,
        starts: starts?,
        settling_periods: settling?,
        trials: trials?,
        unstable_starts: unstable?,
    })
}
