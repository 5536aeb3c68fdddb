//! An orbit in samples: displacement, velocity and acceleration of the response point over one of its periods.

use hammerbeam_attractor::{AttractorError, Simulation};
use hammerbeam_motion::exact::{ExactIntegrator, ExactSettings, MotionError};
use hammerbeam_orbit::{PeriodicSolution, states_at_phase};
use hammerbeam_signal::{SignalError, filter::periodic_low_pass};

use super::Filter;
use crate::Model;

/// Why an orbit cannot be sampled.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CourseError {
    /// Its motion cannot be computed.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// Its motion cannot be followed.
    #[error(transparent)]
    Attractor(#[from] AttractorError),
    /// A state is missing.
    #[error("the orbit has no state at phase 0")]
    NoState,
}

/// Samples at equal steps over an orbit period, the first at phase 0 of the excitation.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Course {
    /// Orbit period [s].
    pub duration_s: f64,
    /// Displacement of the response point [m].
    pub displacement: Vec<f64>,
    /// Velocity [m/s].
    pub velocity: Vec<f64>,
    /// Acceleration [m/s²].
    pub acceleration: Vec<f64>,
    /// Displacement of the support [m].
    pub support: Vec<f64>,
}

/// Goes over an orbit.
///
/// * `samples`: in an excitation period.
///
/// # Errors
/// [`CourseError`].
pub fn course(model: &Model, orbit: &PeriodicSolution, samples: usize) -> Result<Course, CourseError> {
    let settings = ExactSettings::default();
    let state = if orbit.phase == 0.0 {
        orbit.nodes.first().cloned()
    } else {
        let mut integrator = ExactIntegrator::new(model.system.clone(), settings)?;
        states_at_phase(&mut integrator, orbit, 0.0)?.into_iter().next()
    };
    let state = state.ok_or(CourseError::NoState)?;
    let mut simulation = Simulation::new(model.system.clone(), orbit.frequency_hz, &state, settings)?;
    let mut course = follow(model, &mut simulation, orbit.frequency_hz, orbit.period_multiple, samples)?;
    course.duration_s = f64::from(orbit.period_multiple) / orbit.frequency_hz;
    Ok(course)
}

/// Goes on with a motion over some periods.
///
/// # Errors
/// [`CourseError::Attractor`].
pub fn follow(
    model: &Model,
    simulation: &mut Simulation,
    frequency_hz: f64,
    periods: u32,
    samples: usize,
) -> Result<Course, CourseError> {
    let mut course = Course { duration_s: f64::from(periods) / frequency_hz, ..Course::default() };
    let response = model.response_motion(frequency_hz);
    for _ in 0..periods {
        for sample in simulation.period(samples)?.0 {
            let [y, v, a] = response.at(sample.phase, &sample.state, &sample.forces);
            course.displacement.push(y);
            course.velocity.push(v);
            course.acceleration.push(a);
            course.support.push(model.system.support_motion(frequency_hz, sample.phase)[0]);
        }
    }
    Ok(course)
}

/// Part of the motion that a filter has to leave: one step of a converter of 24 bits. What rounding leaves of the mean is 1e-16 of it, and would be compared otherwise.
pub const LEFT: f64 = 1.0 / (1 << 24) as f64;

/// Largest absolute value of a periodic series behind a filter, and the part of its motion that is left.
///
/// # Errors
/// [`SignalError`].
pub fn largest_behind(series: &[f64], duration_s: f64, filter: Filter) -> Result<(f64, f64), SignalError> {
    let filtered = periodic_low_pass(series, duration_s, (filter.order, filter.cut_off_hz))?;
    Ok((largest(&filtered), size(&filtered) / size(series)))
}

/// Root mean square about the mean.
#[must_use]
pub fn size(series: &[f64]) -> f64 {
    let mean = series.iter().sum::<f64>() / series.len() as f64;
    (series.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / series.len() as f64).sqrt()
}

/// Largest absolute value.
#[must_use]
pub fn largest(series: &[f64]) -> f64 {
    series.iter().fold(0.0, |largest, value| largest.max(value.abs()))
}
