//! `[structure]`: a beam, lumped masses or matrices.

use serde::Serialize;

use crate::document::{Reading, Table};

use super::{Beam, Lumped, Matrices, beam, lumped, matrices, names::Names};

/// The linear structure of a study.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Structure {
    /// A uniform beam.
    Beam(Beam),
    /// Masses, springs and dampers.
    Lumped(Lumped),
    /// Matrices from files.
    Matrices(Matrices),
}

#[derive(Clone, Copy)]
enum Kind {
    Beam,
    Lumped,
    Matrices,
}

/// Reads the structure and its names.
pub(super) fn read(root: &Table<'_>, reading: &Reading, names: &mut Names) -> Option<Structure> {
    let table = root.required("structure").and_then(|value| value.table())?;
    let kind = table.required("kind").and_then(|value| {
        value.choice(&[("beam", Kind::Beam), ("lumped", Kind::Lumped), ("matrices", Kind::Matrices)])
    })?;
    let structure = match kind {
        Kind::Beam => beam::read(&table, reading, names).map(Structure::Beam),
        Kind::Lumped => lumped::read(&table, reading, names).map(Structure::Lumped),
        Kind::Matrices => matrices::read(&table, reading, names).map(Structure::Matrices),
    };
    table.finish();
    structure
}
