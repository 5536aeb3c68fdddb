//! `[search]`: how thoroughly a run looks for branches that nothing leads to.

use serde::Serialize;

use crate::document::{
    Key, KeyRow, TomlTable,
    key::{TrueOrFalse, Whole},
};

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

const FREQUENCIES: Key<Whole> = Key::new(
    "frequencies",
    Whole(0, 100_000),
    "number of frequencies, in the middles of equal parts of the range; with 0 there are no others either",
)
.or(24);
const STARTS: Key<Whole> = Key::new(
    "starts",
    Whole(0, 100_000),
    "starting states at each frequency, in addition to the linear response; always the same ones",
)
.or(6);
const SETTLING_PERIODS: Key<Whole> = Key::new(
    "settling_periods",
    Whole(1, 1_000_000),
    "excitation periods that a motion has to settle; a structure with little damping needs more",
)
.or(128);
const TRIALS: Key<Whole> = Key::new(
    "trials",
    Whole(0, 100_000),
    "trials of Newton's method without a new harmonic solution, at each of eight frequencies in each part of \
     the range; 0 for none, and none without `unstable_starts`",
)
.or(12);
const UNSTABLE_STARTS: Key<TrueOrFalse> = Key::new(
    "unstable_starts",
    TrueOrFalse,
    "whether branches also start at unstable solutions. If not, they start at attractors and where a \
     solution loses its stability, and are followed through their unstable parts all the same. Much quicker \
     where motion is chaotic, and enough for every attractor",
)
.or(true);

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    vec![FREQUENCIES.row(), STARTS.row(), SETTLING_PERIODS.row(), TRIALS.row(), UNSTABLE_STARTS.row()]
}

pub(super) fn read(root: &TomlTable<'_>) -> Option<Search> {
    let table = match root.optional("search") {
        Some(value) => Some(value.table()?),
        None => None,
    };
    let frequencies = FREQUENCIES.read(&table);
    let starts = STARTS.read(&table);
    let settling = SETTLING_PERIODS.read(&table);
    let trials = TRIALS.read(&table);
    let unstable = UNSTABLE_STARTS.read(&table);
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
