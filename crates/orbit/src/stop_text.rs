//! Why a walk ended, in a sentence for whoever drives it. Places are in the unit of what varies.

use std::fmt::{Display, Formatter, Result};

use crate::{ResonantMode, StopReason};

impl Display for StopReason {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        match self {
            Self::RangeEnd { frequency_hz } => write!(formatter, "end of the range at {frequency_hz}"),
            Self::Closed => write!(formatter, "the branch came back to its start"),
            Self::ShorterPeriod { frequency_hz, grazes } => {
                let what = if *grazes { "grazing" } else { "flip" };
                write!(formatter, "met the {what} of a branch of shorter period at {frequency_hz}")
            }
            Self::Symmetric { frequency_hz } => {
                write!(formatter, "met a branch of symmetric orbits at {frequency_hz}")
            }
            Self::Budget { solutions } => write!(formatter, "the budget of {solutions} solutions is used up"),
            Self::StepTooShort { frequency_hz, step, residual, doubt, .. } => write!(
                formatter,
                "no solution was accepted beyond {frequency_hz} (last step {step:.1e}, residual \
                {residual:.1e}: {doubt})"
            ),
            Self::Chatter { frequency_hz, element, impacts } => write!(
                formatter,
                "chatter at {element} beyond {frequency_hz}: {impacts} impacts in a row, each slower"
            ),
            Self::ImpactsTogether { frequency_hz, elements, phase } => write!(
                formatter,
                "beyond {frequency_hz} {elements} are struck in another order at the phase of {phase:.4} \
                cycles"
            ),
            Self::RunsBack { frequency_hz, met_arc_length, .. } => write!(
                formatter,
                "beyond {frequency_hz} every step led back to the branch (at arc length {met_arc_length:.6})"
            ),
            Self::ContactReopens { frequency_hz, element, phase } => write!(
                formatter,
                "beyond {frequency_hz} {element} opens and is pressed on again at the phase of {phase:.4} \
                cycles"
            ),
            Self::NoProgress { frequency_hz, solutions, largest_multiplier, .. } => write!(
                formatter,
                "no progress at {frequency_hz} in {solutions} solutions, with a multiplier of \
                {largest_multiplier:.1e}"
            ),
            Self::Unbounded { frequency_hz, .. } => {
                write!(formatter, "the amplitude has no bound at {frequency_hz}")
            }
            Self::FreeVibration { frequency_hz, mode } => {
                write!(formatter, "{mode} and vibrates freely besides at {frequency_hz}")
            }
            Self::TooMuchWork { frequency_hz, solutions, .. } => {
                write!(formatter, "too much work at {frequency_hz}, after {solutions} solutions")
            }
            Self::Motion { frequency_hz, message } => {
                write!(formatter, "the motion could not be computed at {frequency_hz}: {message}")
            }
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
