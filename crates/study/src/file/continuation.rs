//! `[continuation]`: how finely and how far branches are followed.

use serde::Serialize;

use crate::document::{
    Key, KeyRow, Quantity, TomlTable, Value,
    key::{KeyRange, Whole, words},
    quantity,
};

use super::Excitation;

/// Settings of the branch following.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContinuationTable {
    /// Largest step of the excitation frequency [Hz].
    pub max_step_hz: f64,
    /// Relative tolerance of the periodic solutions.
    pub tolerance: f64,
    /// Number of shooting segments of an orbit.
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

const MAX_STEP: Key<Quantity> = Key::new(
    "max_step_hz",
    quantity::STEP,
    "largest change of frequency from one solution to the next; amplitudes are resolved as finely",
);
const TOLERANCE: Key<Quantity> =
    Key::new("tolerance", quantity::TOLERANCE, "error allowed in a periodic solution, relative to the orbit")
        .or(1e-10);
const SEGMENTS: Key<Segments> =
    Key::new("segments", Segments { number: Whole(1, 1000) }, "number of shooting segments of an orbit")
        .or(SegmentChoice::Auto);
const BUDGET_SOLUTIONS: Key<Whole> = Key::new(
    "budget_solutions",
    Whole(1, 100_000_000),
    "solutions after which a side of a branch ends as `budget`. Raise it and run again, and the branch goes \
     on; the result does not depend on earlier budgets",
)
.or(200_000);
const BUDGET_TIME: Key<Quantity> = Key::new(
    "budget_time_s",
    quantity::TIME,
    "time after which a run starts nothing new; what is under way is finished, and running again goes on",
)
.without("none");

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    let step = KeyRow { default: format!("1/{DEFAULT_STEPS} of the frequency range"), ..MAX_STEP.row() };
    vec![step, TOLERANCE.row(), SEGMENTS.row(), BUDGET_SOLUTIONS.row(), BUDGET_TIME.row()]
}

pub(super) fn read(root: &TomlTable<'_>, excitation: Option<&Excitation>) -> Option<ContinuationTable> {
    let table = match root.optional("continuation") {
        Some(value) => Some(value.table()?),
        None => None,
    };
    let step = MAX_STEP.given(&table);
    let tolerance = TOLERANCE.read(&table);
    let segments = SEGMENTS.read(&table);
    let budget = BUDGET_SOLUTIONS.read(&table);
    let time = BUDGET_TIME.given(&table);
    if let Some(table) = table {
        table.finish();
    }
    let step = match step? {
        Some(step) => step,
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

/// `"auto"`, or a number.
#[derive(Clone, Copy)]
struct Segments {
    number: Whole,
}

impl Segments {
    const AUTO: &str = "auto";
}

impl KeyRange for Segments {
    type Read = SegmentChoice;

    fn take(&self, value: &Value<'_>) -> Option<SegmentChoice> {
        if value.is_text() {
            return value.choice(&[(Self::AUTO, SegmentChoice::Auto)]);
        }
        self.number.take(value).map(SegmentChoice::Given)
    }

    fn allowed(&self) -> String {
        format!("{}, or {}", words([Self::AUTO].into_iter()), self.number.allowed())
    }

    fn written(&self, value: SegmentChoice) -> String {
        match value {
            SegmentChoice::Auto => words([Self::AUTO].into_iter()),
            SegmentChoice::Given(number) => self.number.written(number),
        }
    }
}
