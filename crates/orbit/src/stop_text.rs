//! Why a walk or a curve ended, in a sentence for whoever drives it. Places are in the unit of what varies.

use std::fmt::{Display, Formatter, Result};

use crate::{CurveEnd, ResonantMode, StopReason};

impl Display for StopReason {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        match self {
            Self::RangeEnd { place } => write!(formatter, "end of the range at {place}"),
            Self::Closed => write!(formatter, "the branch came back to its start"),
            Self::ShorterPeriod { place, grazes } => {
                let what = if *grazes { "grazing" } else { "flip" };
                write!(formatter, "met the {what} of a branch of shorter period at {place}")
            }
            Self::Symmetric { place } => {
                write!(formatter, "met a branch of symmetric orbits at {place}")
            }
            Self::Budget { solutions } => write!(formatter, "the budget of {solutions} solutions is used up"),
            Self::StepTooShort { place, step, residual, doubt, .. } => write!(
                formatter,
                "no solution was accepted beyond {place} (last step {step:.1e}, residual \
                {residual:.1e}: {doubt})"
            ),
            Self::Chatter { place, element, impacts } => write!(
                formatter,
                "chatter at {element} beyond {place}: {impacts} impacts in a row, each slower"
            ),
            Self::ImpactsTogether { place, elements, phase } => write!(
                formatter,
                "beyond {place} {elements} are struck in another order at the phase of {phase:.4} \
                cycles"
            ),
            Self::RunsBack { place, met_arc_length, .. } => write!(
                formatter,
                "beyond {place} every step led back to the branch (at arc length {met_arc_length:.6})"
            ),
            Self::ContactReopens { place, element, phase } => write!(
                formatter,
                "beyond {place} {element} opens and is pressed on again at the phase of {phase:.4} \
                cycles"
            ),
            Self::NoProgress { place, solutions, largest_multiplier, .. } => write!(
                formatter,
                "no progress at {place} in {solutions} solutions, with a multiplier of \
                {largest_multiplier:.1e}"
            ),
            Self::Unbounded { place, .. } => {
                write!(formatter, "the amplitude has no bound at {place}")
            }
            Self::FreeVibration { place, mode } => {
                write!(formatter, "{mode} and vibrates freely besides at {place}")
            }
            Self::TooMuchWork { place, solutions, .. } => {
                write!(formatter, "too much work at {place}, after {solutions} solutions")
            }
            Self::Motion { place, message } => {
                write!(formatter, "the motion could not be computed at {place}: {message}")
            }
        }
    }
}

impl Display for CurveEnd {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        match self {
            Self::RangeEnd => write!(formatter, "end of the range of the second parameter"),
            Self::FrequencyRangeEnd => write!(formatter, "end of the frequency range"),
            Self::Closed => write!(formatter, "the curve came back to its start"),
            Self::Resonance => write!(formatter, "resonance 1:1 or 1:2 of a Neimark-Sacker point"),
            Self::OwnImage { parameter, mirrored } => {
                let what = if *mirrored { "symmetric" } else { "orbits of half their period" };
                write!(formatter, "the orbits become {what} at {parameter}")
            }
            Self::Grazing { parameter, cause: None } => write!(formatter, "met a grazing at {parameter}"),
            Self::Grazing { parameter, cause: Some(cause) } => {
                write!(formatter, "met a grazing at {parameter} ({cause})")
            }
            Self::GrazedAsWell { parameter, element } => {
                write!(formatter, "{element} is grazed as well at {parameter}")
            }
            Self::ContactReopens { parameter, element, phase } => write!(
                formatter,
                "beyond {parameter} {element} opens and is pressed on again at the phase of {phase:.4} cycles"
            ),
            Self::NoProgress { parameter, rows } => {
                write!(formatter, "no progress at {parameter} in {rows} rows")
            }
            Self::Budget => write!(formatter, "the budget of rows is used up"),
            Self::Stopped { parameter, message } => write!(formatter, "stopped at {parameter}: {message}"),
        }
    }
}

impl Display for ResonantMode {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        let Self { number, frequency_hz, damping_ratio } = self;
        write!(formatter, "mode {number} ({frequency_hz:.6} Hz) has ")?;
        // What rounding leaves of a damper between two points that move alike is none.
        if *damping_ratio > f64::EPSILON {
            write!(formatter, "next to no damping, a ratio of {damping_ratio:.1e}")
        } else {
            write!(formatter, "no damping")
        }
    }
}
