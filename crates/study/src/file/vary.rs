//! `[[vary]]` and `[[curve]]`: branches in another parameter than the frequency, and curves of bifurcations
//! in two.

use serde::Serialize;

use crate::document::{
    Key, KeyRow, Quantity, Reading, TomlTable,
    key::{Whole, Words},
    quantity,
};

use super::{
    Excitation, VariedParameter,
    parameter::{self, Variable},
    response::PERIOD_MULTIPLE,
};

/// Branches in a parameter at a fixed frequency.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Vary {
    /// What varies.
    pub parameter: VariedParameter,
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Orbit period over excitation period.
    pub period_multiple: u32,
    /// The largest step of the parameter is this part of its range; left out of the identity where it is that
    /// of all branches before it could be chosen.
    #[serde(skip_serializing_if = "is_default")]
    pub steps: u32,
}

/// Steps over the range of a parameter by default.
const DEFAULT_STEPS: u32 = 1000;

#[allow(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_default(steps: &u32) -> bool {
    *steps == DEFAULT_STEPS
}

/// A curve of bifurcations in the frequency and a parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Curve {
    /// What is followed.
    pub of: CurveOf,
    /// The curve begins at the event of a branch that is nearest to this frequency [Hz].
    pub near_hz: f64,
    /// The second parameter.
    pub parameter: VariedParameter,
    /// Orbit period over excitation period.
    pub period_multiple: u32,
}

/// What a curve is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CurveOf {
    /// Folds.
    Fold,
    /// Flips.
    Flip,
    /// Neimark-Sacker points.
    NeimarkSacker,
    /// Grazing orbits.
    Grazing,
}

impl CurveOf {
    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        KINDS.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }
}

const KINDS: &[(&str, CurveOf)] = &[
    ("fold", CurveOf::Fold),
    ("flip", CurveOf::Flip),
    ("neimark-sacker", CurveOf::NeimarkSacker),
    ("grazing", CurveOf::Grazing),
];

const FREQUENCY: Key<Quantity> = Key::new("frequency_hz", quantity::FREQUENCY, "excitation frequency");
const STEPS: Key<Whole> = Key::new(
    "steps",
    Whole(1, 1_000_000),
    "largest change of the parameter from one solution to the next, as a part of the range: its 1/`steps`; \
     amplitudes are resolved as finely",
)
.or(DEFAULT_STEPS);
const OF: Key<Words<CurveOf>> = Key::new("of", Words(KINDS), "what is followed");
const NEAR: Key<Quantity> = Key::new("near_hz", quantity::FREQUENCY, "about where the event is");

/// Rows of the page of keys: those of `[[vary]]`.
pub(super) fn rows_of_vary() -> Vec<KeyRow> {
    let range = KeyRow::read_apart(
        "range",
        "[low, high], in the unit of the name, with the value of the study between",
        "required",
        "branches are cut exactly at its ends; it must not hold zero inside",
    );
    let parameter = KeyRow::read_apart("parameter", "a name of the table below", "required", "what varies");
    vec![parameter, range, FREQUENCY.row(), PERIOD_MULTIPLE.row(), STEPS.row()]
}

/// Those of `[[curve]]`.
pub(super) fn rows_of_curve() -> Vec<KeyRow> {
    let as_in_vary = "as in `[[vary]]`";
    let parameter = KeyRow::read_apart("parameter", as_in_vary, "required", "the second parameter");
    let ends = "the curve is cut exactly at its ends";
    let range = KeyRow::read_apart("range", as_in_vary, "required", ends);
    vec![OF.row(), NEAR.row(), parameter, range, PERIOD_MULTIPLE.meaning("of the branch").row()]
}

pub(super) fn read(
    root: &TomlTable<'_>,
    reading: &Reading,
    study: Variable<'_>,
) -> Option<(Vec<Vary>, Vec<Curve>)> {
    let before = reading.count();
    if study.excitation == Some(&Excitation::None) {
        for key in ["vary", "curve"].into_iter().filter(|key| root.has(key)) {
            let message = format!("`{key}` needs a frequency, and there is no [excitation]");
            root.problem(key, message, vec!["allowed: only with [excitation]".into()]);
        }
    }
    let varies = root.tables("vary").into_iter().filter_map(|table| read_vary(table, study)).collect();
    let curves = root.tables("curve").into_iter().filter_map(|table| read_curve(table, study)).collect();
    (reading.count() == before).then_some((varies, curves))
}

/// What is there of both, unread.
pub(super) fn passed_over(root: &TomlTable<'_>) -> (Vec<Vary>, Vec<Curve>) {
    ["vary", "curve"].iter().for_each(|key| drop(root.optional(key)));
    (Vec::new(), Vec::new())
}

fn read_vary(table: TomlTable<'_>, study: Variable<'_>) -> Option<Vary> {
    let parameter = parameter::read(&table, study);
    let frequency = FREQUENCY.read(&table);
    let multiple = PERIOD_MULTIPLE.read(&table);
    let steps = STEPS.read(&table);
    table.finish();
    Some(Vary { parameter: parameter?, frequency_hz: frequency?, period_multiple: multiple?, steps: steps? })
}

fn read_curve(table: TomlTable<'_>, study: Variable<'_>) -> Option<Curve> {
    let of = OF.read(&table);
    let near = NEAR.read(&table);
    let parameter = parameter::read(&table, study);
    let multiple = PERIOD_MULTIPLE.read(&table);
    table.finish();
    Some(Curve { of: of?, near_hz: near?, parameter: parameter?, period_multiple: multiple? })
}
