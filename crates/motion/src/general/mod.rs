//! The general integrator: any vector field, with its variational equations.
//!
//! For `dz/dt = g(t, z; p)` the sensitivities `Y = dz(t)/dz(0)` and `y_p = dz(t)/dp` obey
//!
//! `dY/dt = G Y`, `Y(0) = 1`; `dy_p/dt = G y_p + dg/dp`, `y_p(0) = 0`; `G = dg/dz`.
//!
//! State and sensitivities go through the same stages of the method of Dormand and Prince of order 8 with
//! estimators of order 5 and 3. The tolerance bounds the error of every *step*, in the norm
//!
//! `max over columns and parts of |e| / a`,
//!
//! where the columns are `z`, those of `Y`, and `y_p`; the parts of a column are its displacements and its
//! velocities (for a field of its own kind: what [`VectorField::parts`] says); and `a` is the largest entry
//! of that part of that column met on the way; a field may raise it ([`VectorField::raise_magnitudes`]), and
//! a system does: velocities count at least as much as displacements times the circular frequency of the
//! excitation, displacements at least a thousandth of the shortest length in the clearances of the contacts.
//! A step ends where the field switches its smooth region, at the onset and the release of a contact.
//!
//! This is the independent check of the integrator that uses the structure of the equations, and the baseline
//! of its benchmarks. It knows nothing of modes beyond their right-hand sides.
//!
//! # Source
//! Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I* (1993), sections II.4 to II.6.
//! What differs: the norm, the limit of shortening, and the restart at switching points.

mod dense;
mod dip;
mod error;
mod field;
mod march;
mod observe;
mod resting;
mod rigid;
mod search;
mod stepper;
mod stick;
mod switching;
mod system_field;
mod tableau;
mod thrown_off;
mod watch;

use faer::Mat;

use march::March;
use system_field::SystemField;
use watch::Samples;

pub use error::GeneralError;
pub use field::{Column, Point, VectorField};
pub use observe::{ElementMaxima, Observed, observe};

use crate::{Flow, Stretch, System};

/// How to integrate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GeneralSettings {
    /// Bound of the error of a step, relative to the largest entries; see the module. From 1e-14 to 1e-2, but
    /// below 3e-13 rounding decides where crossings lie: one motion with a chatter of two stops was off by
    /// half its size at 1e-13, without an error.
    pub tolerance: f64,
    /// Whether the sensitivities are wanted; without them their matrix and vector are empty.
    pub sensitivities: bool,
    /// Bound of the number of steps, rejected ones included.
    pub max_steps: usize,
    /// Length of the first step, in the unit of the independent variable (cycles for a system); estimated if
    /// `None`.
    pub first_step: Option<f64>,
}

impl GeneralSettings {
    /// Settings of that tolerance, with sensitivities.
    #[must_use]
    pub fn with_tolerance(tolerance: f64) -> Self {
        Self { tolerance, sensitivities: true, max_steps: 1_000_000, first_step: None }
    }

    /// The same without sensitivities.
    #[must_use]
    pub fn state_only(self) -> Self {
        Self { sensitivities: false, ..self }
    }
}

impl Default for GeneralSettings {
    /// Tolerance 1e-10.
    fn default() -> Self {
        Self::with_tolerance(1e-10)
    }
}

/// The work of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Steps accepted.
    pub steps: usize,
    /// Steps tried and given up.
    pub rejected: usize,
    /// Evaluations of the field, with or without sensitivities.
    pub evaluations: usize,
    /// Boundaries between smooth regions crossed.
    pub crossings: usize,
}

/// Flow of a system over a stretch, and what it cost.
#[derive(Debug, Clone)]
pub struct GeneralFlow {
    /// Final state and sensitivities.
    pub flow: Flow,
    /// Work done.
    pub counts: Counts,
    /// Length of the step that would have come next, as [`GeneralSettings::first_step`] of the stretch that
    /// follows.
    pub next_step: f64,
}

/// Flow of a vector field, and what it cost.
#[derive(Debug, Clone)]
pub struct FieldFlow {
    /// State at the end.
    pub state: Vec<f64>,
    /// Derivative of the final state by the initial one, `dimension` x `dimension`.
    pub by_state: Mat<f64>,
    /// Derivative of the final state by the parameter, at fixed ends.
    pub by_parameter: Vec<f64>,
    /// Work done.
    pub counts: Counts,
    /// Length of the step that would have come next, as [`GeneralSettings::first_step`] of what follows.
    pub next_step: f64,
}

/// Motion of a system over a stretch.
///
/// * `state`: `[q; q']` in modal coordinates at the start, length 2n.
///
/// # Errors
/// See [`GeneralError`].
pub fn advance(
    system: &System,
    stretch: &Stretch,
    state: &[f64],
    settings: &GeneralSettings,
) -> Result<GeneralFlow, GeneralError> {
    check_frequency(stretch)?;
    let mut field = SystemField::new(system, stretch.frequency_hz);
    field.check_start(stretch.start, state)?;
    let FieldFlow { state, by_state, by_parameter, counts, next_step } =
        integrate(&mut field, stretch.start, stretch.end, state, settings)?;
    Ok(GeneralFlow {
        flow: Flow { state, by_state, by_frequency: by_parameter, by_parameter: Vec::new() },
        counts,
        next_step,
    })
}

/// States of a system at given phases of a stretch; sensitivities are not computed.
///
/// * `phases`: in cycles, ascending, within the stretch.
///
/// # Returns
/// One state per phase, from dense output of order 7, about as accurate as the steps.
/// # Errors
/// See [`GeneralError`].
pub fn sample(
    system: &System,
    stretch: &Stretch,
    state: &[f64],
    phases: &[f64],
    settings: &GeneralSettings,
) -> Result<Vec<Vec<f64>>, GeneralError> {
    check_frequency(stretch)?;
    let mut field = SystemField::new(system, stretch.frequency_hz);
    field.check_start(stretch.start, state)?;
    sample_field(&mut field, (stretch.start, stretch.end), state, phases, settings)
}

/// Motion along a vector field from `start` to `end >= start`.
///
/// # Errors
/// See [`GeneralError`].
pub fn integrate(
    field: &mut impl VectorField,
    start: f64,
    end: f64,
    state: &[f64],
    settings: &GeneralSettings,
) -> Result<FieldFlow, GeneralError> {
    check(field, (start, end), state, settings)?;
    let mut march = March::new(field, settings, (start, end), state);
    march.run(&mut Samples { times: &[], states: Vec::new() })?;
    Ok(march.flow())
}

/// States along a vector field at given times, ascending and within the stretch `(start, end)`.
///
/// # Errors
/// See [`GeneralError`].
pub fn sample_field(
    field: &mut impl VectorField,
    (start, end): (f64, f64),
    state: &[f64],
    times: &[f64],
    settings: &GeneralSettings,
) -> Result<Vec<Vec<f64>>, GeneralError> {
    check(field, (start, end), state, settings)?;
    let mut before = start;
    for &time in times {
        ensure("a sample", time, "ascending and within the stretch", time >= before && time <= end)?;
        before = time;
    }
    let settings = settings.state_only();
    let mut samples = Samples { times, states: Vec::with_capacity(times.len()) };
    March::new(field, &settings, (start, end), state).run(&mut samples)?;
    Ok(samples.states)
}

fn check_frequency(stretch: &Stretch) -> Result<(), GeneralError> {
    let found = stretch.frequency_hz;
    ensure("the frequency", found, "finite and positive", found.is_finite() && found > 0.0)
}

fn check(
    field: &impl VectorField,
    (start, end): (f64, f64),
    state: &[f64],
    settings: &GeneralSettings,
) -> Result<(), GeneralError> {
    let (found, expected) = (state.len(), field.dimension());
    if found != expected {
        return Err(GeneralError::StateLength { found, expected });
    }
    if !(1e-14..=1e-2).contains(&settings.tolerance) {
        return Err(GeneralError::Tolerance { found: settings.tolerance });
    }
    for &value in state {
        ensure("the state", value, "finite", value.is_finite())?;
    }
    ensure("the start", start, "finite", start.is_finite())?;
    ensure("the end", end, "finite and not before the start", end.is_finite() && end >= start)?;
    let step = settings.first_step.unwrap_or(1.0);
    ensure("the first step", step, "finite and positive", step.is_finite() && step > 0.0)
}

fn ensure(what: &'static str, found: f64, allowed: &'static str, holds: bool) -> Result<(), GeneralError> {
    if holds { Ok(()) } else { Err(GeneralError::Input { what, found, allowed }) }
}
