//! `[continuation]`: how finely and how far branches are followed.

use serde::Serialize;

use crate::document::{TomlTable, Value, quantity};

use super::Excitation;

/// Settings of the branch following.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContinuationTable {
    /// Largest step of the excitation frequency [Hz].
    pub max_step_hz: f64,
    /// Relative tolerance of the periodic solutions.
    pub tolerance: f64,
    /// Number of shooting segments per excitation period.
    pub segments: SegmentChoice,
    /// Largest number of solutions on each side of a start; no part of the identity.
    #[serde(skip)]
    pub budget_solutions: usize,
    /// Time after which a run begins no new piece of work [s]; no part of the identity.
    #[serde(skip)]
    pub budget_time_s: Option<f64>,
}

/// Number of shooting segments.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SegmentChoice {
    /// Chosen by the program.
    Auto,
    /// Given.
    Given(u32),
}

/// Steps over the frequency range by default.
const DEFAULT_STEPS: f64 = 5000.0;

pub(super) fn read(root: &TomlTable<'_>, excitation: Option<&Excitation>) -> Option<ContinuationTable> {
    let table = match root.optional("continuation") {
        Some(value) => Some(value.table()?),
        None => None,
    };
    let key = |key| table.as_ref().and_then(|table| table.optional(key));
    let step = key("max_step_hz").map(|value| value.number(&quantity::STEP));
    let tolerance = key("tolerance").map_or(Some(1e-10), |value| value.number(&quantity::TOLERANCE));
    let segments = key("segments").map_or(Some(SegmentChoice::Auto), |value| read_segments(&value));
    let budget = key("budget_solutions").map_or(Some(200_000), |value| value.whole(1, 100_000_000));
    let time = key("budget_time_s").map_or(Some(None), |value| value.number(&quantity::TIME).map(Some));
    if let Some(table) = table {
        table.finish();
    }
    let step = match step {
        Some(step) => step?,
        None => {
            let [low, high] = excitation?.range_hz();
            (high - low) / DEFAULT_STEPS
        }
    };
    Some(ContinuationTable {
        max_step_hz: step,
        tolerance: tolerance?,
        segments: segments?,
        budget_solutions: budget? as usize,
        budget_time_s: time?,
    })
}

fn read_segments(value: &Value<'_>) -> Option<SegmentChoice> {
    if value.is_text() {
        return value.choice(&[("auto", SegmentChoice::Auto)]);
    }
    value.whole(1, 1000).map(SegmentChoice::Given)
}
