//! `[reduction]`: which modes are kept.

use serde::Serialize;

use crate::document::{Table, quantity};

use super::Structure;

/// How the structure is reduced.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Reduction {
    /// The basis.
    pub method: ReductionMethod,
    /// Highest eigenfrequency kept [Hz]; not used by [`ReductionMethod::None`].
    pub cut_off_hz: f64,
}

/// The reduction basis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ReductionMethod {
    /// Free-interface modes with residual flexibility.
    FreeInterface,
    /// Fixed-interface modes with constraint modes.
    FixedInterface,
    /// The eigenmodes of the supported structure up to the cut-off.
    Truncation,
    /// The eigenmodes of the supported structure themselves.
    None,
}

const METHODS: [(&str, ReductionMethod); 4] = [
    ("free-interface", ReductionMethod::FreeInterface),
    ("fixed-interface", ReductionMethod::FixedInterface),
    ("truncation", ReductionMethod::Truncation),
    ("none", ReductionMethod::None),
];

/// A beam and matrices have to say how they are reduced; lumped masses are not reduced unless they say so.
pub(super) fn read(root: &Table<'_>, structure: Option<&Structure>) -> Option<Reduction> {
    let lumped = matches!(structure, Some(Structure::Lumped(_)));
    if !root.has("reduction") && (lumped || structure.is_none()) {
        root.optional("reduction");
        return Some(Reduction { method: ReductionMethod::None, cut_off_hz: 0.0 });
    }
    let table = root.required("reduction").and_then(|value| value.table())?;
    let method = table.required("method").and_then(|value| value.choice(&METHODS));
    let cut_off_hz = match method {
        Some(ReductionMethod::None) => Some(0.0),
        _ => table.required("cut_off_hz").and_then(|value| value.number(&quantity::FREQUENCY)),
    };
    table.finish();
    Some(Reduction { method: method?, cut_off_hz: cut_off_hz? })
}
