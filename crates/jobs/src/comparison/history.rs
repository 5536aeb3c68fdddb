//! An orbit in samples: displacement, velocity and acceleration of the response point over one of its
//! periods.

use hammerbeam_attractor::{AttractorError, Simulation};
use hammerbeam_motion::exact::{ExactIntegrator, ExactSettings, MotionError};
use hammerbeam_orbit::{PeriodicSolution, states_at_phase};
use hammerbeam_signal::{SignalError, filter::periodic_low_pass};
use hammerbeam_study::Model;

use crate::counted;

/// A low-pass filter of an instrument: Butterworth, analogue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Filter {
    /// Order.
    pub order: usize,
    /// Cut-off, at half the power [Hz].
    pub cut_off_hz: f64,
}

/// Why an orbit cannot be sampled.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HistoryError {
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

/// No orbit can be gone over.
#[derive(Debug, thiserror::Error)]
#[error("none of {} can be gone over; the first: {first}", counted(*count as u64, "orbit"))]
#[expect(missing_docs, reason = "the message names its fields")]
pub struct NoneSampled {
    pub count: usize,
    pub first: HistoryError,
}

/// What came of an orbit: something was made of its history, or it could not be gone over.
pub type Sampled<T, E> = Result<Result<T, HistoryError>, E>;

/// What was made of each orbit, `None` for one that could not be gone over, and how many of these there are.
///
/// # Errors
/// [`NoneSampled`] if there are orbits and none could be gone over; the first error that is of something
/// else.
pub fn sampled<T, E: From<NoneSampled>>(
    tried: impl IntoIterator<Item = Sampled<T, E>>,
) -> Result<(Vec<Option<T>>, usize), E> {
    let (mut kept, mut skipped) = (Vec::new(), Vec::new());
    for one in tried {
        match one? {
            Ok(one) => kept.push(Some(one)),
            Err(reason) => {
                kept.push(None);
                skipped.push(reason);
            }
        }
    }
    let count = skipped.len();
    match skipped.into_iter().next() {
        Some(first) if count == kept.len() => Err(NoneSampled { count, first }.into()),
        _ => Ok((kept, count)),
    }
}

/// Samples at equal steps over an orbit period, the first at phase 0 of the excitation.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MotionHistory {
    /// Orbit period [s].
    pub duration_s: f64,
    /// Displacement of the response point [m].
    pub displacement: Vec<f64>,
    /// Velocity [m/s].
    pub velocity: Vec<f64>,
    /// Acceleration [m/s²].
    pub acceleration: Vec<f64>,
    /// Displacement of each moving support [m].
    pub supports: Vec<Vec<f64>>,
}

/// Goes over an orbit.
///
/// * `samples`: in an excitation period.
///
/// # Errors
/// [`HistoryError`].
pub fn history(
    model: &Model,
    orbit: &PeriodicSolution,
    samples: usize,
) -> Result<MotionHistory, HistoryError> {
    let settings = ExactSettings::default();
    let state = if orbit.phase == 0.0 {
        orbit.nodes.first().cloned()
    } else {
        let mut integrator = ExactIntegrator::new(model.system.clone(), settings)?;
        states_at_phase(&mut integrator, orbit, 0.0)?.into_iter().next()
    };
    let state = state.ok_or(HistoryError::NoState)?;
    let mut simulation = Simulation::new(model.system.clone(), orbit.frequency_hz, &state, settings)?;
    let mut history = follow(model, &mut simulation, orbit.frequency_hz, orbit.period_multiple, samples)?;
    history.duration_s = f64::from(orbit.period_multiple) / orbit.frequency_hz;
    Ok(history)
}

/// Goes on with a motion over some periods.
///
/// # Errors
/// [`HistoryError::Attractor`].
pub fn follow(
    model: &Model,
    simulation: &mut Simulation,
    frequency_hz: f64,
    periods: u32,
    samples: usize,
) -> Result<MotionHistory, HistoryError> {
    let supports = vec![Vec::new(); model.system.model().supports.len()];
    let duration_s = f64::from(periods) / frequency_hz;
    let mut history = MotionHistory { duration_s, supports, ..MotionHistory::default() };
    let response = model.response_motion(frequency_hz);
    for _ in 0..periods {
        for sample in simulation.period(samples)?.0 {
            let [y, v, a] = response.at(sample.phase, &sample.state, &sample.forces);
            history.displacement.push(y);
            history.velocity.push(v);
            history.acceleration.push(a);
            let motions = model.system.support_motions(frequency_hz, sample.phase);
            history.supports.iter_mut().zip(motions).for_each(|(series, [u, ..])| series.push(u));
        }
    }
    Ok(history)
}

/// Part of the motion that a filter has to leave: one step of a converter of 24 bits. What rounding leaves of
/// the mean is 1e-16 of it, and would be compared otherwise.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, thiserror::Error)]
    enum Refused {
        #[error(transparent)]
        None(#[from] NoneSampled),
        #[error(transparent)]
        Signal(#[from] SignalError),
    }

    #[test]
    fn orbit_that_cannot_be_gone_over_leaves_a_gap_and_is_counted() {
        let skipped = || Ok(Err(HistoryError::NoState));
        let of = |tried: Vec<Sampled<u32, Refused>>| sampled(tried);
        let (kept, count) = of(vec![skipped(), Ok(Ok(3)), skipped(), Ok(Ok(5))]).unwrap();
        assert_eq!((kept, count), (vec![None, Some(3), None, Some(5)], 2));
        assert_eq!(of(Vec::new()).unwrap(), (Vec::new(), 0));
        let none = of(vec![skipped(), skipped()]).unwrap_err();
        assert!(
            matches!(none, Refused::None(NoneSampled { count: 2, first: HistoryError::NoState })),
            "{none}"
        );
        // What is wrong with the measurement is wrong for all.
        let wrong = of(vec![Ok(Ok(3)), Err(Refused::Signal(SignalError::Constant))]).unwrap_err();
        assert!(matches!(wrong, Refused::Signal(SignalError::Constant)), "{wrong}");
    }
}
