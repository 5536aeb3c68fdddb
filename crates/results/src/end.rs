//! How one side of a branch or a curve ended: an enum from the solver to the database.
//!
//! The sentence for a reader is made where it is shown ([`end_text`](crate::end_text)); here is what programs
//! ask: the word of the table `ends.csv`, whether the end is one or came early, and the form in which an end
//! is stored.

use hammerbeam_orbit::{CurveEnd, ResonantMode, StopReason};

/// How one side of a branch or a curve ended. Places are in the unit in which the parameter is named.
#[derive(Debug, Clone, PartialEq)]
pub enum BranchEnd {
    /// The walk along the branch ended by itself.
    Walk(StopReason),
    /// So did that along a curve of bifurcations.
    Curve(CurveEnd),
    /// The side begins where it leaves a branch of half the period.
    Crossing {
        /// Where [Hz].
        frequency_hz: f64,
    },
    /// The side comes upon another branch, or the upper side of its own, where that one was lost.
    Joins {
        /// Number of the other branch; `None` for the upper side.
        branch: Option<u32>,
        /// Where that one ended [Hz].
        frequency_hz: f64,
    },
    /// The branch could not be followed from its start.
    NotStarted {
        /// Why.
        message: String,
    },
    /// The next solution could not be computed.
    Failed {
        /// Why.
        message: String,
    },
}

impl From<StopReason> for BranchEnd {
    fn from(reason: StopReason) -> Self {
        Self::Walk(reason)
    }
}

impl BranchEnd {
    /// The word for programs: `range-end`, `closed`, ...; `docs/reference/ends.md` has all of them.
    #[must_use]
    pub fn word(&self) -> &'static str {
        self.stored().kind
    }

    /// Where, if there is a place.
    #[must_use]
    pub fn place(&self) -> Option<f64> {
        self.stored().place
    }

    /// Whether the amplitude may be any there: the branch goes to infinity, or a mode vibrates freely.
    #[must_use]
    pub fn has_any_amplitude(&self) -> bool {
        matches!(self, Self::Walk(StopReason::Unbounded { .. } | StopReason::FreeVibration { .. }))
    }

    /// Whether the branch goes to infinity there.
    #[must_use]
    pub fn is_unbounded(&self) -> bool {
        matches!(self, Self::Walk(StopReason::Unbounded { .. }))
    }

    /// Whether more budget lets the walk go on.
    #[must_use]
    pub fn is_budget(&self) -> bool {
        matches!(self, Self::Walk(StopReason::Budget { .. }))
    }

    /// Whether the branch is closed, so that one walk is all of it.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        matches!(self, Self::Walk(StopReason::Closed) | Self::Curve(CurveEnd::Closed))
    }

    /// Whether the branch came to one of shorter period.
    #[must_use]
    pub fn is_shorter_period(&self) -> bool {
        matches!(self, Self::Walk(StopReason::ShorterPeriod { .. }))
    }

    /// Whether the branch came to orbits of which its own are a more general case: of shorter period, or
    /// symmetric.
    #[must_use]
    pub fn meets_simpler(&self) -> bool {
        self.is_shorter_period() || matches!(self, Self::Walk(StopReason::Symmetric { .. }))
    }

    /// Whether the walk ended where it should, and not early.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        let is_end = matches!(
            self,
            Self::Walk(StopReason::RangeEnd { .. }) | Self::Crossing { .. } | Self::Joins { .. }
        );
        is_end || self.is_closed() || self.has_any_amplitude() || self.meets_simpler()
    }
}

/// An end as four columns: what it is, where, its numbers, its text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StoredEnd<'k, 't> {
    pub kind: &'k str,
    pub place: Option<f64>,
    pub numbers: Vec<f64>,
    pub text: Option<&'t str>,
}

impl<'k, 't> StoredEnd<'k, 't> {
    fn plain(kind: &'k str) -> Self {
        Self { kind, place: None, numbers: Vec::new(), text: None }
    }

    fn at(kind: &'k str, place: f64) -> Self {
        Self { place: Some(place), ..Self::plain(kind) }
    }

    fn with(self, numbers: impl Into<Vec<f64>>) -> Self {
        Self { numbers: numbers.into(), ..self }
    }

    fn saying(self, text: &'t str) -> Self {
        Self { text: Some(text), ..self }
    }
}

impl BranchEnd {
    /// The end as it is stored.
    pub(crate) fn stored(&self) -> StoredEnd<'static, '_> {
        match self {
            Self::Walk(reason) => of_walk(reason),
            Self::Curve(end) => of_curve(end),
            Self::Crossing { frequency_hz } => StoredEnd::at("crossing", *frequency_hz),
            Self::Joins { branch, frequency_hz } => StoredEnd::at("joins", *frequency_hz)
                .with(branch.map_or_else(Vec::new, |b| vec![f64::from(b)])),
            Self::NotStarted { message } => StoredEnd::plain("not-started").saying(message),
            Self::Failed { message } => StoredEnd::plain("failed").saying(message),
        }
    }

    /// The end that is stored so; `None` if there is no such end.
    pub(crate) fn of_stored(stored: &StoredEnd<'_, '_>) -> Option<Self> {
        let text = || stored.text.map(str::to_owned);
        let end = match (stored.kind, stored.place, stored.numbers.as_slice()) {
            ("crossing", Some(frequency_hz), []) => Self::Crossing { frequency_hz },
            ("joins", Some(frequency_hz), []) => Self::Joins { branch: None, frequency_hz },
            ("joins", Some(frequency_hz), [branch]) => {
                Self::Joins { branch: Some(*branch as u32), frequency_hz }
            }
            ("not-started", None, []) => Self::NotStarted { message: text()? },
            ("failed", None, []) => Self::Failed { message: text()? },
            _ => return walk_of(stored).map(Self::Walk).or_else(|| curve_of(stored).map(Self::Curve)),
        };
        Some(end)
    }
}

fn of_walk(reason: &StopReason) -> StoredEnd<'static, '_> {
    match reason {
        StopReason::RangeEnd { place } => StoredEnd::at("range-end", *place),
        StopReason::Closed => StoredEnd::plain("closed"),
        StopReason::ShorterPeriod { place, grazes } => {
            StoredEnd::at("shorter-period", *place).with([f64::from(u8::from(*grazes))])
        }
        StopReason::Symmetric { place } => StoredEnd::at("symmetric", *place),
        StopReason::Budget { solutions } => StoredEnd::plain("budget").with([*solutions as f64]),
        StopReason::StepTooShort { place, step, residual, doubt, has_no_losses } => {
            let numbers = [*step, *residual, f64::from(u8::from(*has_no_losses))];
            StoredEnd::at("step-too-short", *place).with(numbers).saying(doubt)
        }
        StopReason::Chatter { place, element, impacts } => {
            StoredEnd::at("chatter", *place).with([*impacts as f64]).saying(element)
        }
        StopReason::ImpactsTogether { place, elements, phase } => {
            StoredEnd::at("impacts-together", *place).with([*phase]).saying(elements)
        }
        StopReason::RunsBack { place, met_arc_length, has_no_losses } => {
            let numbers = [*met_arc_length, f64::from(u8::from(*has_no_losses))];
            StoredEnd::at("runs-back", *place).with(numbers)
        }
        StopReason::ContactReopens { place, element, phase } => {
            StoredEnd::at("contact-reopens", *place).with([*phase]).saying(element)
        }
        StopReason::NoProgress { place, solutions, largest_multiplier, has_no_losses } => {
            let numbers = [*solutions as f64, *largest_multiplier, f64::from(u8::from(*has_no_losses))];
            StoredEnd::at("no-progress", *place).with(numbers)
        }
        StopReason::Unbounded { place, mode } => {
            let of_mode = mode.as_ref().map_or_else(Vec::new, |mode| numbers_of(mode).to_vec());
            StoredEnd::at("unbounded", *place).with(of_mode)
        }
        StopReason::FreeVibration { place, mode } => {
            StoredEnd::at("free-vibration", *place).with(numbers_of(mode))
        }
        StopReason::TooMuchWork { place, solutions, gets_on } => {
            let numbers = [*solutions as f64, f64::from(u8::from(*gets_on))];
            StoredEnd::at("too-much-work", *place).with(numbers)
        }
        StopReason::Motion { place, message } => StoredEnd::at("motion", *place).saying(message),
    }
}

fn numbers_of(mode: &ResonantMode) -> [f64; 3] {
    [mode.number as f64, mode.frequency_hz, mode.damping_ratio]
}

fn mode_of([number, frequency_hz, damping_ratio]: [f64; 3]) -> ResonantMode {
    ResonantMode { number: number as usize, frequency_hz, damping_ratio }
}

fn walk_of(stored: &StoredEnd<'_, '_>) -> Option<StopReason> {
    let text = || stored.text.map(str::to_owned);
    let reason = match (stored.kind, stored.numbers.as_slice()) {
        ("closed", []) => return Some(StopReason::Closed),
        ("budget", [solutions]) => return Some(StopReason::Budget { solutions: *solutions as usize }),
        (kind, numbers) => (kind, numbers, stored.place?),
    };
    Some(match reason {
        ("range-end", [], place) => StopReason::RangeEnd { place },
        ("shorter-period", [grazes], place) => StopReason::ShorterPeriod { place, grazes: *grazes != 0.0 },
        ("symmetric", [], place) => StopReason::Symmetric { place },
        ("step-too-short", [step, residual, lossless], place) => {
            let (step, residual, doubt, has_no_losses) = (*step, *residual, text()?, *lossless != 0.0);
            StopReason::StepTooShort { place, step, residual, doubt, has_no_losses }
        }
        ("chatter", [impacts], place) => {
            StopReason::Chatter { place, element: text()?, impacts: *impacts as usize }
        }
        ("impacts-together", [phase], place) => {
            StopReason::ImpactsTogether { place, elements: text()?, phase: *phase }
        }
        ("runs-back", [met, lossless], place) => {
            StopReason::RunsBack { place, met_arc_length: *met, has_no_losses: *lossless != 0.0 }
        }
        ("contact-reopens", [phase], place) => {
            StopReason::ContactReopens { place, element: text()?, phase: *phase }
        }
        ("no-progress", [solutions, largest, lossless], place) => {
            let (solutions, largest_multiplier) = (*solutions as u64, *largest);
            let has_no_losses = *lossless != 0.0;
            StopReason::NoProgress { place, solutions, largest_multiplier, has_no_losses }
        }
        ("unbounded", [], place) => StopReason::Unbounded { place, mode: None },
        ("unbounded", &[number, at_hz, ratio], place) => {
            StopReason::Unbounded { place, mode: Some(mode_of([number, at_hz, ratio])) }
        }
        ("free-vibration", &[number, at_hz, ratio], place) => {
            StopReason::FreeVibration { place, mode: mode_of([number, at_hz, ratio]) }
        }
        ("too-much-work", [solutions, gets_on], place) => {
            let solutions = *solutions as u64;
            StopReason::TooMuchWork { place, solutions, gets_on: *gets_on != 0.0 }
        }
        ("motion", [], place) => StopReason::Motion { place, message: text()? },
        _ => return None,
    })
}

fn of_curve(end: &CurveEnd) -> StoredEnd<'static, '_> {
    match end {
        CurveEnd::RangeEnd => StoredEnd::plain("curve-range-end"),
        CurveEnd::FrequencyRangeEnd => StoredEnd::plain("curve-frequency-range-end"),
        CurveEnd::Closed => StoredEnd::plain("curve-closed"),
        CurveEnd::Resonance => StoredEnd::plain("curve-resonance"),
        CurveEnd::Budget => StoredEnd::plain("curve-budget"),
        CurveEnd::OwnImage { parameter, mirrored } => {
            StoredEnd::at("curve-own-image", *parameter).with([f64::from(u8::from(*mirrored))])
        }
        CurveEnd::Grazing { parameter, cause } => {
            StoredEnd { text: cause.as_deref(), ..StoredEnd::at("curve-grazing", *parameter) }
        }
        CurveEnd::GrazedAsWell { parameter, element } => {
            StoredEnd::at("curve-grazed-as-well", *parameter).saying(element)
        }
        CurveEnd::ContactReopens { parameter, element, phase } => {
            StoredEnd::at("curve-contact-reopens", *parameter).with([*phase]).saying(element)
        }
        CurveEnd::NoProgress { parameter, rows } => {
            StoredEnd::at("curve-no-progress", *parameter).with([f64::from(*rows)])
        }
        CurveEnd::Stopped { parameter, message } => {
            StoredEnd::at("curve-stopped", *parameter).saying(message)
        }
    }
}

fn curve_of(stored: &StoredEnd<'_, '_>) -> Option<CurveEnd> {
    let text = || stored.text.map(str::to_owned);
    Some(match (stored.kind, stored.place, stored.numbers.as_slice()) {
        ("curve-range-end", None, []) => CurveEnd::RangeEnd,
        ("curve-frequency-range-end", None, []) => CurveEnd::FrequencyRangeEnd,
        ("curve-closed", None, []) => CurveEnd::Closed,
        ("curve-resonance", None, []) => CurveEnd::Resonance,
        ("curve-budget", None, []) => CurveEnd::Budget,
        ("curve-own-image", Some(parameter), [mirrored]) => {
            CurveEnd::OwnImage { parameter, mirrored: *mirrored != 0.0 }
        }
        ("curve-grazing", Some(parameter), []) => CurveEnd::Grazing { parameter, cause: text() },
        ("curve-grazed-as-well", Some(parameter), []) => {
            CurveEnd::GrazedAsWell { parameter, element: text()? }
        }
        ("curve-contact-reopens", Some(parameter), [phase]) => {
            CurveEnd::ContactReopens { parameter, element: text()?, phase: *phase }
        }
        ("curve-no-progress", Some(parameter), [rows]) => {
            CurveEnd::NoProgress { parameter, rows: *rows as u32 }
        }
        ("curve-stopped", Some(parameter), []) => CurveEnd::Stopped { parameter, message: text()? },
        _ => return None,
    })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// One of every end.
    pub(crate) fn every_end() -> Vec<BranchEnd> {
        let frequency_hz = 12.5;
        let parameter = 12.5;
        let text = || "x".to_owned();
        let mode = ResonantMode { number: 2, frequency_hz: 12.0, damping_ratio: 0.0 };
        let too_short = |has_no_losses: bool| StopReason::StepTooShort {
            place: frequency_hz,
            step: 1e-9,
            residual: f64::INFINITY,
            doubt: text(),
            has_no_losses,
        };
        let walks = [
            StopReason::RangeEnd { place: frequency_hz },
            StopReason::Closed,
            StopReason::ShorterPeriod { place: frequency_hz, grazes: true },
            StopReason::ShorterPeriod { place: frequency_hz, grazes: false },
            StopReason::Symmetric { place: frequency_hz },
            StopReason::Budget { solutions: 3 },
            too_short(false),
            too_short(true),
            StopReason::Chatter { place: frequency_hz, element: "stop".to_owned(), impacts: 12 },
            StopReason::ImpactsTogether {
                place: frequency_hz,
                elements: "s1 and s2".to_owned(),
                phase: 0.25,
            },
            StopReason::RunsBack { place: frequency_hz, met_arc_length: 3.0, has_no_losses: true },
            StopReason::ContactReopens { place: frequency_hz, element: "stop s2".to_owned(), phase: 0.25 },
            StopReason::NoProgress {
                place: frequency_hz,
                solutions: 2000,
                largest_multiplier: f64::INFINITY,
                has_no_losses: false,
            },
            StopReason::Unbounded { place: frequency_hz, mode: Some(mode) },
            StopReason::Unbounded { place: frequency_hz, mode: None },
            StopReason::FreeVibration { place: frequency_hz, mode },
            StopReason::TooMuchWork { place: frequency_hz, solutions: 5, gets_on: false },
            StopReason::Motion { place: frequency_hz, message: text() },
        ];
        let curves = [
            CurveEnd::RangeEnd,
            CurveEnd::FrequencyRangeEnd,
            CurveEnd::Closed,
            CurveEnd::Resonance,
            CurveEnd::Budget,
            CurveEnd::OwnImage { parameter, mirrored: true },
            CurveEnd::Grazing { parameter, cause: None },
            CurveEnd::Grazing { parameter, cause: Some(text()) },
            CurveEnd::GrazedAsWell { parameter, element: text() },
            CurveEnd::ContactReopens { parameter, element: text(), phase: 0.25 },
            CurveEnd::NoProgress { parameter, rows: 7 },
            CurveEnd::Stopped { parameter, message: text() },
        ];
        let others = [
            BranchEnd::Crossing { frequency_hz },
            BranchEnd::Joins { branch: Some(3), frequency_hz },
            BranchEnd::Joins { branch: None, frequency_hz },
            BranchEnd::NotStarted { message: text() },
            BranchEnd::Failed { message: text() },
        ];
        walks.map(BranchEnd::Walk).into_iter().chain(curves.map(BranchEnd::Curve)).chain(others).collect()
    }

    #[test]
    fn every_word_stands_in_the_book() {
        let page = include_str!("../../../docs/reference/ends.md");
        let of_curves = |end: &BranchEnd| matches!(end, BranchEnd::Curve(_));
        for end in every_end().into_iter().filter(|end| !of_curves(end)) {
            let word = end.word();
            assert!(page.contains(&format!("\n| `{word}` |")), "{word} is not in ends.md");
        }
    }

    #[test]
    fn every_end_comes_back_from_its_columns() {
        for end in every_end() {
            assert_eq!(BranchEnd::of_stored(&end.stored()), Some(end.clone()), "{end:?}");
        }
        assert_eq!(BranchEnd::of_stored(&StoredEnd::plain("other")), None);
        assert_eq!(BranchEnd::of_stored(&StoredEnd::plain("range-end")), None, "without its place");
    }

    /// An end at the range, at itself, at another branch or at infinity is one; every other came early.
    #[test]
    fn only_ends_where_nothing_is_left_are_complete() {
        let at_others = ["shorter-period", "symmetric", "crossing", "joins"];
        let complete = [&at_others[..], &["range-end", "closed", "unbounded", "free-vibration"]].concat();
        for end in every_end().iter().filter(|end| !matches!(end, BranchEnd::Curve(_))) {
            assert_eq!(end.is_complete(), complete.contains(&end.word()), "{end:?}");
        }
    }
}
