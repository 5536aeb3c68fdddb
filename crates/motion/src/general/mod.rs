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
mod settings;
mod stepper;
mod stick;
mod stops;
mod switching;
mod system_field;
mod tableau;
mod thrown_off;
mod watch;
mod zero;

use march::March;
use settings::{check, check_frequency, ensure};
use system_field::SystemField;
use watch::Samples;

pub use error::GeneralError;
pub use field::{Column, Point, VectorField};
pub use observe::{ElementMaxima, Observed, observe};
pub use settings::{Counts, FieldFlow, GeneralSettings};

use crate::{Flow, Stretch, System};

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
