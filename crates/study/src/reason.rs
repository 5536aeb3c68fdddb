//! Why a side of a branch ended, in words that speak of the structure: what happened to its motion, and what
//! can be done where the branch ends early.
//!
//! The words for programs (`range-end`, `crawls`) are those of [`StoredReason`](crate::store::StoredReason);
//! `docs/reference/ends.md` has both beside each other.

use hammerbeam_orbit::{ResonantMode, StopReason};

/// What a branch runs over, as its reasons speak of it.
pub(crate) struct Course {
    /// What ends at the end of the range.
    range: &'static str,
    /// What shows the motion where its branch was lost.
    look: &'static str,
    /// What happens with a larger budget.
    larger_budget: &'static str,
}

/// Over the frequency.
pub(crate) const OVER_FREQUENCY: Course = Course {
    range: "the frequency range",
    look: "`sweep` shows the motion there, `run --from` begins branches at what it finds",
    larger_budget: "the same command goes on from here",
};

/// Over another parameter.
pub(crate) const OVER_PARAMETER: Course = Course {
    range: "the range",
    look: "`sweep` of a study with the parameter set beyond shows the motion there",
    larger_budget: "a new run gets further",
};

/// The reason in words.
///
/// * `at`: a place on the branch as a reader knows it: `31.25 Hz`, `stop.wall.gap_m = 0.002`.
pub(crate) fn in_words(reason: &StopReason, course: &Course, at: impl Fn(f64) -> String) -> String {
    let Course { range, look, larger_budget } = course;
    match reason {
        StopReason::RangeEnd { frequency_hz } => format!("end of {range} at {}", at(*frequency_hz)),
        StopReason::Closed => "the branch came back to its start".to_owned(),
        StopReason::ShorterPeriod { frequency_hz, grazes: true } => format!(
            "met the grazing of a branch of shorter period at {}, beyond which the motion is that one",
            at(*frequency_hz)
        ),
        StopReason::ShorterPeriod { frequency_hz, grazes: false } => format!(
            "met the flip of a branch of shorter period at {}, beyond which the same motions come again, \
                some excitation periods later",
            at(*frequency_hz)
        ),
        StopReason::Budget { solutions } => format!(
            "the budget of {solutions} solutions is used up; with a larger budget_solutions \
                ([continuation]) {larger_budget}"
        ),
        StopReason::StepTooShort { frequency_hz, step, residual, doubt } => format!(
            "no periodic motion next to the last one was found beyond {}, however near it was looked for; \
                {look} (last step {step:.1e}, residual {residual:.1e}: {doubt})",
            at(*frequency_hz)
        ),
        StopReason::RunsBack { frequency_hz, met_arc_length } => format!(
            "beyond {} every step led back to motions that the branch already has; {look} (met again at \
                arc length {met_arc_length:.6})",
            at(*frequency_hz)
        ),
        StopReason::ContactSplits { frequency_hz, element, phase } => {
            format!("beyond {} {}", at(*frequency_hz), splits(element, *phase, course))
        }
        StopReason::Crawls { frequency_hz, solutions, largest_multiplier } => format!(
            "at {} the last {solutions} solutions brought the branch no further: in a period of the \
                motion a disturbance of it becomes {largest_multiplier:.1e} times as large; {look}",
            at(*frequency_hz)
        ),
        StopReason::Unbounded { frequency_hz, mode } => {
            format!("at {} {}", at(*frequency_hz), unbounded(*mode))
        }
        StopReason::TooLaborious { frequency_hz, solutions, gets_on } => {
            format!("at {} {}", at(*frequency_hz), too_laborious(*solutions, *gets_on))
        }
        StopReason::Motion { frequency_hz, message } => {
            format!("the motion could not be computed at {}: {message}", at(*frequency_hz))
        }
    }
}

/// What happens beyond the end of a branch whose contact splits.
pub(crate) fn splits(element: &str, phase: f64, course: &Course) -> String {
    let look = course.look;
    format!(
        "{element} opens and is pressed on again at once, at the phase of {phase:.4} cycles: the force of \
            its law depends on how fast the contact began, so it jumps there, and so does the motion; \
            {look}"
    )
}

/// What becomes of a branch that takes too much work, and what helps.
fn too_laborious(solutions: u64, gets_on: bool) -> String {
    let what = if gets_on {
        format!("the work that a side of a branch may take is used up after {solutions} solutions")
    } else {
        format!("the branch does not get on, after {solutions} solutions: each takes too much work")
    };
    format!(
        "{what}; `sweep` shows the motion there, a narrower range or fewer modes ([reduction]) make it \
            cheaper"
    )
}

/// What a branch does that goes to infinity, and what keeps it finite.
fn unbounded(mode: Option<ResonantMode>) -> String {
    let why = match mode {
        Some(ResonantMode { number, frequency_hz, damping_ratio }) if damping_ratio > 0.0 => {
            format!(
                "mode {number} ({frequency_hz:.6} Hz) has next to no damping, a ratio of {damping_ratio:.1e}"
            )
        }
        Some(ResonantMode { number, frequency_hz, .. }) => {
            format!("mode {number} ({frequency_hz:.6} Hz) has no damping")
        }
        None => "nothing there takes energy out of the motion".to_owned(),
    };
    format!("the amplitude grows without bound: {why}; with damping ([damping]) it stays finite")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every reason at a place names it once, and no word of the method stands before the numbers in
    /// brackets.
    #[test]
    fn reasons_name_their_place_and_speak_of_the_motion() {
        let frequency_hz = 12.5;
        let mode = Some(ResonantMode { number: 2, frequency_hz: 12.0, damping_ratio: 0.0 });
        let reasons = [
            StopReason::RangeEnd { frequency_hz },
            StopReason::ShorterPeriod { frequency_hz, grazes: true },
            StopReason::ShorterPeriod { frequency_hz, grazes: false },
            StopReason::StepTooShort { frequency_hz, step: 1e-9, residual: 1e-3, doubt: "x".to_owned() },
            StopReason::RunsBack { frequency_hz, met_arc_length: 3.0 },
            StopReason::ContactSplits { frequency_hz, element: "stop s2".to_owned(), phase: 0.25 },
            StopReason::Crawls { frequency_hz, solutions: 2000, largest_multiplier: 1e9 },
            StopReason::Unbounded { frequency_hz, mode },
            StopReason::TooLaborious { frequency_hz, solutions: 5, gets_on: false },
            StopReason::Motion { frequency_hz, message: "x".to_owned() },
        ];
        for reason in reasons {
            let text = in_words(&reason, &OVER_FREQUENCY, |value| format!("{value} Hz"));
            assert_eq!(text.matches("12.5 Hz").count(), 1, "{text}");
            let sentence = text.split(" (last step").next().unwrap();
            for word in ["arc length", "multiplier", "residual", "tangent", "converge", "walk"] {
                assert!(!sentence.split(" (met").next().unwrap().contains(word), "{word} in {sentence}");
            }
        }
    }
}
