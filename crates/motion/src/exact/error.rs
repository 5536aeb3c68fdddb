//! Why a motion was not computed.

use super::MergedModes;
use crate::ParameterError;

/// Why a motion was not computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum MotionError {
    /// The damping has no block form: motion is left to the general integrator, which orbits are not computed
    /// with.
    #[error(transparent)]
    MergedModes(#[from] MergedModes),
    /// The system has no such parameter, or not with this value.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A law needs the speed with which a contact began, and the stretch begins within it. Another phase of
    /// the excitation moves the start.
    #[error(
        "{element} is closed at the start of a stretch, at the phase of {phase} cycles, and its law needs \
            to know how fast it closed"
    )]
    StartsInContact { element: String, phase: f64 },
    /// A contact begins without any speed and is pressed on, and its law loses in proportion to one over that
    /// speed: as from rest against a stop without a gap.
    #[error(
        "{element} is pressed on without an impact, {time:.6e} s after the start of the stretch, and its \
            law needs the speed of one; a motion that begins away from the stop has it"
    )]
    PressedWithoutImpact { element: String, time: f64 },
    /// No force step, however short, reached the tolerance.
    #[error(
        "a contact changes too fast to be followed {time:.6e} s after the start of the stretch, even \
        in steps of {step:.2e} s: its stiffness may be far beyond what the masses beside it allow"
    )]
    StepTooShort { time: f64, step: f64 },
    /// A force that always acts pushes away from rest, and ever harder: the motion is infinite after a finite
    /// time.
    #[error(
        "the motion escapes {time:.6e} s after the start of the stretch: at a displacement of \
        {displacement:.3e} m {element} pushes it away, the harder the farther it is"
    )]
    Escapes { element: String, displacement: f64, time: f64 },
    /// A formula has no value where the motion goes.
    #[error(
        "{element} has no force at displacements just beyond {displacement:.6e} m, where the motion goes \
        {time:.6e} s after the start of the stretch: its formula has no value there"
    )]
    NoForce { element: String, displacement: f64, time: f64 },
    /// The motion takes so many force steps that it does not get on: contacts of ever shorter distance, or
    /// forces far beyond those of the system.
    #[error(
        "contacts follow one another ever faster, or their forces are far beyond those of the system: \
        more than {steps} force steps up to {time:.6e} s after the start of the stretch"
    )]
    TooManySteps { time: f64, steps: u64 },
    /// Contacts close and open, or press and part, without end, and time does not get on: rounding decides
    /// both ways what comes first. It is no property of the system, and a motion beside this one does not
    /// have it.
    #[error(
        "the motion stands still {time:.6e} s after the start of the stretch: {elements} close and open, \
            or press and part, again and again, and time does not get on; with a gap or a phase of the \
            start that is a little different what happens at once there is taken apart"
    )]
    StandsStill { time: f64, elements: String },
    /// A rigid stop is hit again and again in ever shorter distance, and the bounces do not end.
    #[error(
        "more than {impacts} impacts up to {time:.6e} s after the start of the stretch: a structure that \
            is pressed on a rigid stop bounces the longer the nearer its restitution is to 1, and with 1 \
            for ever"
    )]
    TooManyImpacts { time: f64, impacts: u64 },
    /// Rigid stops that are held at once do not act independently of one another.
    #[error("{elements} stick to their rigid stops at once, but the structure cannot move them apart")]
    DependentStops { elements: String },
    /// The search for the next contact does not get on.
    #[error("the search for the next contact does not get on {time:.6e} s after the start of the stretch")]
    FlightStalled { time: f64 },
    /// The state is infinite or not a number.
    #[error(
        "the motion grows beyond all numbers {time:.6e} s after the start of the stretch: it escapes, \
        as over a spring that softens"
    )]
    NotFinite { time: f64 },
}
