//! `[structure]`: a beam, lumped masses or matrices.

use serde::Serialize;

use crate::document::{Reading, TomlTable};

use super::{BeamTable, LumpedTable, MatricesTable, beam, lumped, matrices, names::Names};

/// The linear structure of a study.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum StructureTable {
    /// A uniform beam.
    Beam(BeamTable),
    /// Masses, springs and dampers.
    Lumped(LumpedTable),
    /// Matrices from files.
    Matrices(MatricesTable),
}

/// What kind of structure it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StructureKind {
    Beam,
    Lumped,
    Matrices,
}

const KINDS: &[(&str, StructureKind)] = &[
    ("beam", StructureKind::Beam),
    ("lumped", StructureKind::Lumped),
    ("matrices", StructureKind::Matrices),
];

/// Reads the structure and its names: its kind, where that much is right, and what it is.
pub(super) fn read(
    root: &TomlTable<'_>,
    reading: &Reading,
    names: &mut Names,
) -> (Option<StructureKind>, Option<StructureTable>) {
    let Some(table) = root.required("structure").and_then(|value| value.table()) else { return (None, None) };
    let kind = table.required("kind").and_then(|value| value.choice(KINDS));
    let structure = match kind {
        Some(StructureKind::Beam) => beam::read(&table, reading, names).map(StructureTable::Beam),
        Some(StructureKind::Lumped) => lumped::read(&table, reading, names).map(StructureTable::Lumped),
        Some(StructureKind::Matrices) => matrices::read(&table, reading, names).map(StructureTable::Matrices),
        None => return (None, None),
    };
    table.finish();
    (kind, structure)
}
