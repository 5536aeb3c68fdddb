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

#[derive(Clone, Copy)]
enum Kind {
    Beam,
    Lumped,
    Matrices,
}

/// Reads the structure and its names.
pub(super) fn read(root: &TomlTable<'_>, reading: &Reading, names: &mut Names) -> Option<StructureTable> {
    let table = root.required("structure").and_then(|value| value.table())?;
    let kind = table.required("kind").and_then(|value| {
        value.choice(&[("beam", Kind::Beam), ("lumped", Kind::Lumped), ("matrices", Kind::Matrices)])
    })?;
    let structure = match kind {
        Kind::Beam => beam::read(&table, reading, names).map(StructureTable::Beam),
        Kind::Lumped => lumped::read(&table, reading, names).map(StructureTable::Lumped),
        Kind::Matrices => matrices::read(&table, reading, names).map(StructureTable::Matrices),
    };
    table.finish();
    structure
}
