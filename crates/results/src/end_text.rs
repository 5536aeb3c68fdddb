//! How a side of a branch or a curve ended, in a sentence that speaks of the structure: what happened to its
//! motion, and what can be done where it ends early.
//!
//! Made where it is shown, never stored and never read back. `docs/reference/ends.md` has the sentences
//! beside the words for programs ([`BranchEnd::word`]).

use hammerbeam_orbit::{BranchEventKind, CurveEnd, ResonantMode, StopReason};
use hammerbeam_study::file::CurveOf;

use crate::end::BranchEnd;

/// What a branch runs along, as its sentences speak of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BranchOver<'a> {
    /// The frequency.
    Frequency,
    /// Another parameter, by its name.
    Parameter(&'a str),
    /// The frequency and another parameter, by its name: a curve of bifurcations.
    Curve(&'a str, CurveOf),
}

/// What is shown of a side that is not finished.
pub const NOT_FINISHED: &str = "not finished: the same run goes on from here";

impl BranchOver<'_> {
    /// What ends at the end of the range.
    fn range(self) -> &'static str {
        match self {
            Self::Frequency => "the frequency range",
            Self::Parameter(_) | Self::Curve(..) => "the range",
        }
    }

    /// What shows the motion where its branch was lost.
    fn look(self) -> &'static str {
        match self {
            Self::Frequency => {
                "`sweep` shows the motion there, `run --from` begins branches at what it finds"
            }
            Self::Parameter(_) | Self::Curve(..) => {
                "`sweep` of a study with the parameter set beyond shows the motion there"
            }
        }
    }

    /// What happens with a larger budget.
    fn larger_budget(self) -> &'static str {
        match self {
            Self::Frequency => "the same command goes on from here",
            Self::Parameter(_) | Self::Curve(..) => "a new run gets further",
        }
    }

    /// A place on the branch as a reader knows it: `31.250000 Hz`, `stop.wall.gap_m = 0.002`.
    fn place(self, value: f64) -> String {
        match self {
            Self::Frequency => format!("{value:.6} Hz"),
            // As one would write it in a study file.
            Self::Parameter(name) | Self::Curve(name, _)
                if (1e-4..1e6).contains(&value.abs()) || value == 0.0 =>
            {
                format!("{name} = {value}")
            }
            Self::Parameter(name) | Self::Curve(name, _) => format!("{name} = {value:e}"),
        }
    }
}

/// The end in a sentence.
#[must_use]
pub fn sentence(end: &BranchEnd, along: BranchOver<'_>) -> String {
    match end {
        BranchEnd::Walk(reason) => of_walk(reason, along),
        BranchEnd::Curve(end) => of_curve(end, along),
        BranchEnd::Crossing { frequency_hz } => {
            format!("leaves a branch of half the period at {frequency_hz:.6} Hz")
        }
        BranchEnd::Joins { branch: Some(branch), frequency_hz } => {
            format!("beyond {frequency_hz:.6} Hz it is branch {branch}")
        }
        BranchEnd::Joins { branch: None, frequency_hz } => {
            format!("came round to the end of the up side at {frequency_hz:.6} Hz")
        }
        BranchEnd::NotStarted { message } => {
            format!("the branch could not be followed from its start: {message}")
        }
        BranchEnd::Failed { message } => format!("the next solution cannot be computed: {message}"),
    }
}

/// The sentence over the frequency.
impl std::fmt::Display for BranchEnd {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.pad(&sentence(self, BranchOver::Frequency))
    }
}

/// Why a walk among motions without losses may end, and what to do.
const NO_LOSSES: &str = "nothing takes energy out of it, and motions that differ by a free vibration may lie \
    closer together than rounding tells apart; with damping ([damping]) they are apart";

fn of_walk(reason: &StopReason, along: BranchOver<'_>) -> String {
    let (at, look) = (|value: f64| along.place(value), along.look());
    let advice = |has_no_losses: bool| if has_no_losses { NO_LOSSES } else { look };
    match reason {
        StopReason::RangeEnd { place } => {
            // The end of the range is what the study says, with all its digits.
            let place = match along {
                BranchOver::Frequency => format!("{place} Hz"),
                along => along.place(*place),
            };
            format!("end of {} at {place}", along.range())
        }
        StopReason::Closed => "the branch came back to its start".to_owned(),
        StopReason::ShorterPeriod { place, grazes: true } => format!(
            "met the grazing of a branch of shorter period at {}, beyond which the motion is that one",
            at(*place)
        ),
        StopReason::ShorterPeriod { place, grazes: false } => format!(
            "met the flip of a branch of shorter period at {}, beyond which the same motions come again, \
                some excitation periods later",
            at(*place)
        ),
        StopReason::Symmetric { place } => format!(
            "met a branch of symmetric motions at {}, beyond which it repeats as its mirror image",
            at(*place)
        ),
        StopReason::Budget { solutions } => format!(
            "the budget of {solutions} solutions is used up; with a larger budget_solutions \
                ([continuation]) {}",
            along.larger_budget()
        ),
        StopReason::StepTooShort { place, step, residual, doubt, has_no_losses } => {
            format!(
                "no periodic motion next to the last one was found beyond {}, however near it was looked \
                for; {} (last step {step:.1e}, residual {residual:.1e}: {doubt})",
                at(*place),
                advice(*has_no_losses)
            )
        }
        StopReason::Chatter { place, element, impacts } => format!(
            "beyond {} {element} chatters: in the last motion {impacts} impacts follow one another, each \
                slower than the one before, and no motion next to it was found; {look}",
            at(*place)
        ),
        StopReason::ImpactsTogether { place, elements, phase } => format!(
            "at {} {elements} are struck at one instant, at the phase of {phase:.4} cycles, and the motion \
                beyond depends on which comes first; {look}",
            at(*place)
        ),
        StopReason::RunsBack { place, met_arc_length, has_no_losses } => format!(
            "beyond {} every step led back to motions that the branch already has; {} (met again at arc \
                length {met_arc_length:.6})",
            at(*place),
            advice(*has_no_losses)
        ),
        StopReason::ContactReopens { place, element, phase } => {
            format!("beyond {} {}", at(*place), splits(element, *phase, look))
        }
        StopReason::NoProgress { place, solutions, largest_multiplier, has_no_losses } => format!(
            "at {} the last {solutions} solutions brought the branch no further: in a period of the \
                motion a disturbance of it becomes {largest_multiplier:.1e} times as large; {}",
            at(*place),
            advice(*has_no_losses)
        ),
        StopReason::Unbounded { place, mode } => {
            format!("at {} {}", at(*place), unbounded(*mode))
        }
        StopReason::FreeVibration { place, mode } => format!(
            "at {} {mode} and vibrates freely at a multiple of the frequency of the motion: motions of every \
                amplitude of it are periodic there; with damping ([damping]) there is one",
            at(*place)
        ),
        StopReason::TooMuchWork { place, solutions, gets_on } => {
            format!("at {} {}", at(*place), too_much_work(*solutions, *gets_on))
        }
        StopReason::Motion { place, message } => {
            format!("the motion could not be computed at {}: {message}", at(*place))
        }
    }
}

fn of_curve(end: &CurveEnd, along: BranchOver<'_>) -> String {
    let at = |value: f64| along.place(value);
    match end {
        CurveEnd::RangeEnd => "end of the range of the parameter".to_owned(),
        CurveEnd::FrequencyRangeEnd => "end of the frequency range".to_owned(),
        CurveEnd::Closed => "the curve came back to its start".to_owned(),
        CurveEnd::Resonance => "the second frequency of the motion came into a resonance of 1:1 or 1:2 \
            with its own, where its pair of multipliers becomes real and Neimark-Sacker points end"
            .to_owned(),
        CurveEnd::OwnImage { parameter, mirrored } => own_image(&at(*parameter), *mirrored),
        CurveEnd::Grazing { parameter, cause } => {
            let cause = cause.as_ref().map_or(String::new(), |cause| format!(" ({cause})"));
            let resonant = resonant_grazing(along).map_or(String::new(), |kind| {
                let name = kind.name();
                format!(": a resonant grazing ({name}) where the curve ends on that of the grazing")
            });
            format!("met a grazing at {}{resonant}{cause}", at(*parameter))
        }
        CurveEnd::GrazedAsWell { parameter, element } => {
            format!("{element} is grazed as well at {} and struck beyond", at(*parameter))
        }
        CurveEnd::ContactReopens { parameter, element, phase } => {
            format!("beyond {} {}", at(*parameter), splits(element, *phase, along.look()))
        }
        CurveEnd::NoProgress { parameter, rows } => {
            format!(
                "ended early at {}: the last {rows} solutions brought the curve no further",
                at(*parameter)
            )
        }
        CurveEnd::Budget => "the budget of solutions is used up; with a larger budget_solutions \
            ([continuation]) a new run gets further"
            .to_owned(),
        CurveEnd::Stopped { parameter, message } => {
            format!("ended early at {}: {message}", at(*parameter))
        }
    }
}

/// The resonant grazing at which a curve ends that meets a grazing; `None` for a curve of grazings.
fn resonant_grazing(along: BranchOver<'_>) -> Option<BranchEventKind> {
    match along {
        BranchOver::Curve(_, CurveOf::Fold) => Some(BranchEventKind::GrazingFold),
        BranchOver::Curve(_, CurveOf::Flip) => Some(BranchEventKind::GrazingFlip),
        BranchOver::Curve(_, CurveOf::NeimarkSacker) => Some(BranchEventKind::GrazingNeimarkSacker),
        _ => None,
    }
}

fn own_image(place: &str, mirrored: bool) -> String {
    let (what, leave, images) = if mirrored {
        ("symmetric", "pairs of mirror images branch off", "the mirror images")
    } else {
        ("those of half their period", "they branch off in a flip", "the same orbits half a period later")
    };
    format!(
        "the orbits become {what} at {place}, where {leave}: the curve comes back from there as that of \
            {images}, over the same values"
    )
}

/// What happens beyond the end of a branch whose contact splits.
fn splits(element: &str, phase: f64, look: &str) -> String {
    format!(
        "{element} opens and is pressed on again at once, at the phase of {phase:.4} cycles: the force of \
            its law depends on how fast the contact began, so it jumps there, and so does the motion; \
            {look}"
    )
}

/// What becomes of a branch that takes too much work, and what helps.
fn too_much_work(solutions: u64, gets_on: bool) -> String {
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

/// What a branch does that goes to infinity, and what keeps it finite. Where no mode resonates, it was
/// followed as far as it could be, and has a bound or not.
fn unbounded(mode: Option<ResonantMode>) -> String {
    let (what, why) = match mode {
        Some(mode) => ("has no bound", mode.to_string()),
        None => {
            ("goes beyond all that was followed", "nothing there takes energy out of the motion".to_owned())
        }
    };
    format!("the amplitude {what}: {why}; with damping ([damping]) it has a bound")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::end::tests::every_end;

    /// Every end at a place names it once, and no word of the method stands before the numbers in brackets.
    #[test]
    fn sentences_name_their_place_and_speak_of_the_motion() {
        for end in every_end() {
            let along = match end {
                BranchEnd::Curve(_) => BranchOver::Curve("gap_m", CurveOf::Grazing),
                _ => BranchOver::Parameter("gap_m"),
            };
            let text = sentence(&end, along);
            assert_eq!(text.matches("12.5").count(), usize::from(end.place().is_some()), "{text}");
            let spoken = text.split(" (last step").next().unwrap().split(" (met").next().unwrap();
            let spoken = spoken.replace("pair of multipliers", "");
            for word in ["arc length", "multiplier", "residual", "tangent", "converge", "walk"] {
                assert!(!spoken.contains(word), "{word} in {spoken}");
            }
        }
    }

    /// Without losses the advice is damping, else to look at what is there.
    #[test]
    fn the_advice_where_a_walk_gets_no_further_depends_on_losses() {
        for lossless in [false, true] {
            let (place, has_no_losses) = (12.5, lossless);
            for reason in [
                StopReason::RunsBack { place, met_arc_length: 3.0, has_no_losses },
                StopReason::NoProgress { place, solutions: 9, largest_multiplier: 1e9, has_no_losses },
            ] {
                let end = BranchEnd::Walk(reason);
                assert_eq!(BranchEnd::of_stored(&end.stored()).as_ref(), Some(&end));
                let text = end.to_string();
                assert_eq!((text.contains("[damping]"), text.contains("`sweep`")), (lossless, !lossless));
            }
        }
    }

    #[test]
    fn over_the_frequency_the_end_of_the_range_has_its_digits_and_other_places_six() {
        let range_end = BranchEnd::Walk(StopReason::RangeEnd { place: 12.5 });
        assert_eq!(range_end.to_string(), "end of the frequency range at 12.5 Hz");
        let splits = StopReason::ContactReopens { place: 12.5, element: "s2".to_owned(), phase: 0.25 };
        assert!(BranchEnd::Walk(splits).to_string().starts_with("beyond 12.500000 Hz s2 opens"));
    }

    #[test]
    fn small_and_large_values_of_a_parameter_have_no_row_of_zeros() {
        let at = |value: f64| BranchOver::Parameter("stop.1.gap_m").place(value);
        assert_eq!(at(6e-8), "stop.1.gap_m = 6e-8");
        assert_eq!(at(0.002), "stop.1.gap_m = 0.002");
        assert_eq!(at(-4.5e9), "stop.1.gap_m = -4.5e9");
        assert_eq!(at(0.0), "stop.1.gap_m = 0");
    }
}
