//! `[reduction]`: which modes are kept.

use serde::Serialize;

use crate::document::{Key, KeyRow, Quantity, TomlTable, key::Words, quantity};

use super::structure::StructureKind;

/// How the structure is reduced.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ReductionTable {
    /// The basis.
    pub method: ReductionMethod,
    /// Highest eigenfrequency kept [Hz]; not used by [`ReductionMethod::None`] and
    /// [`ReductionMethod::Given`].
    pub cut_off_hz: f64,
}

/// The reduction basis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ReductionMethod {
    /// Free-interface modes with residual flexibility.
    FreeInterface,
    /// The same without the inertia of the residual modes.
    #[serde(rename = "macneal")]
    MacNeal,
    /// Fixed-interface modes with constraint modes.
    FixedInterface,
    /// Constraint modes alone.
    Guyan,
    /// The eigenmodes of the supported structure up to the cut-off.
    Truncation,
    /// The eigenmodes of the supported structure themselves.
    None,
    /// The same of matrices that are reduced already.
    Given,
}

impl ReductionMethod {
    /// Whether modes are cut off at a frequency.
    #[must_use]
    pub fn cuts_off(self) -> bool {
        !matches!(self, Self::None | Self::Given)
    }
}

/// The methods; those of Rubin and of Craig and Bampton have two names.
pub(super) const METHODS: &[(&str, ReductionMethod)] = &[
    ("free-interface", ReductionMethod::FreeInterface),
    ("rubin", ReductionMethod::FreeInterface),
    ("macneal", ReductionMethod::MacNeal),
    ("fixed-interface", ReductionMethod::FixedInterface),
    ("craig-bampton", ReductionMethod::FixedInterface),
    ("guyan", ReductionMethod::Guyan),
    ("given", ReductionMethod::Given),
    ("truncation", ReductionMethod::Truncation),
    ("none", ReductionMethod::None),
];

const METHOD: Key<Words<ReductionMethod>> = Key::new("method", Words(METHODS), "the basis, below");
const CUT_OFF: Key<Quantity> = Key::new("cut_off_hz", quantity::FREQUENCY, "highest eigenfrequency kept")
    .further("; above the first elastic mode")
    .without("required, but not a key of `\"none\"` and `\"given\"`");

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    vec![METHOD.row(), CUT_OFF.row()]
}

/// A beam and matrices have to say how they are reduced; lumped masses are not reduced unless they say so.
///
/// * `structure`: its kind, if it is known.
pub(super) fn read(root: &TomlTable<'_>, structure: Option<StructureKind>) -> Option<ReductionTable> {
    if !root.has("reduction") && matches!(structure, Some(StructureKind::Lumped) | None) {
        root.optional("reduction");
        return Some(ReductionTable { method: ReductionMethod::None, cut_off_hz: 0.0 });
    }
    let table = root.required("reduction").and_then(|value| value.table())?;
    let method = METHOD.read(&table);
    let cut_off_hz = match method {
        Some(method) if !method.cuts_off() => Some(0.0),
        _ => CUT_OFF.read(&table),
    };
    let is_matrices = matches!(structure, Some(StructureKind::Matrices) | None);
    if method == Some(ReductionMethod::Given) && !is_matrices {
        let help = vec!["allowed: \"given\" for matrices that are reduced already, or \"none\"".to_owned()];
        table.problem("method", "`method` is \"given\", but the structure is not".to_owned(), help);
    }
    table.finish();
    Some(ReductionTable { method: method?, cut_off_hz: cut_off_hz? })
}
