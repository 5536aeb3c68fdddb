//! Why there is no orbit or branch to give.

use hammerbeam_motion::exact::MotionError;
use hammerbeam_path::PathError;

use crate::{NoEigenvalues, ResonantMode};

/// Why there is no orbit or branch to give.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum OrbitError {
    /// The motion could not be computed.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The path could not be started.
    #[error(transparent)]
    Path(#[from] PathError),
    /// The multipliers were not found.
    #[error(transparent)]
    Eigenvalues(#[from] NoEigenvalues),
    /// Newton's method did not come to a periodic orbit.
    #[error(
        "no periodic orbit near the guess at {frequency_hz} Hz: correction {correction:.2e} \
        after {iterations} iterations"
    )]
    NotConverged { frequency_hz: f64, correction: f64, iterations: u32 },
    /// No start led to an orbit of that period.
    #[error(
        "no periodic orbit of period {period_multiple} was found at {frequency_hz} Hz \
        from {starts} starts"
    )]
    NoOrbit { frequency_hz: f64, period_multiple: u32, starts: usize },
    /// A law needs the speed with which its contact began, and the contact never begins.
    #[error(
        "{element} is closed over the whole motion at {frequency_hz} Hz: its law needs to know \
        how fast a contact began, and no orbit can begin within one"
    )]
    NeverOpens { element: String, frequency_hz: f64 },
    /// No other branch was found where one should leave.
    #[error("no other branch was found beside the crossing at {frequency_hz} Hz")]
    NoCrossing { frequency_hz: f64 },
    /// The orbit does not have what a curve is to follow.
    #[error(
        "the orbit at {frequency_hz} Hz has no such touch of a contact or pair of multipliers to follow; \
        a contact with damping that opens, in the midst of its penetration, is none"
    )]
    NoEvent { frequency_hz: f64 },
    /// The period asked for is not one that is looked for.
    #[error("the period multiple is {found}, must be from 1 to {most}")]
    PeriodMultiple { found: u32, most: u32 },
    /// A search has used up the solutions it may spend on following branches; there may be more orbits.
    #[error("the search at {frequency_hz} Hz ended after following branches over {solutions} solutions")]
    SearchBudget { frequency_hz: f64, solutions: usize },
    /// A search has used up its trials while they still found orbits that were met only once; there may be
    /// more.
    #[error("the search at {frequency_hz} Hz has used up its trials, and there may be more solutions")]
    SearchTrials { frequency_hz: f64 },
    /// Of the orbits that touch nothing there are as many as free vibrations of a mode; one is kept.
    #[error(
        "{mode} and vibrates freely at a multiple of {base_hz:.6} Hz: motions of every amplitude and phase \
        of it are periodic; with damping ([damping]) there is one"
    )]
    FreeVibration { base_hz: f64, mode: ResonantMode },
    /// The excitation drives an undamped mode at its own frequency.
    #[error(
        "{mode} and is driven at its frequency, {frequency_hz:.6} Hz or a multiple of it: nothing but \
        contacts can bound its motion; with damping ([damping]) it is bounded"
    )]
    Resonance { frequency_hz: f64, mode: ResonantMode },
    /// The caller asked to stop.
    #[error("interrupted")]
    Interrupted,
    /// A stored checkpoint does not fit this system or version.
    #[error("the checkpoint does not belong to this system")]
    Checkpoint,
}
