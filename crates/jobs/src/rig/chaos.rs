//! Whether aperiodic motions of the rig are chaotic: their largest Lyapunov exponents, from the record and
//! from the motion itself.
//!
//! The paper calls most of its aperiodic signals chaotic and points to exponents of the series by Wolf's
//! method. The same is done with the record here, behind the filter and with its noise. Beside it stands what
//! no real rig can show: the exponent of the motion by its tangent vectors, from the last state of the record
//! on.

use hammerbeam_attractor::{LyapunovSettings, SystemMap, lyapunov};
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_signal::{
    SignalError,
    exponent::{EmbeddingChoice, ExponentEstimate, WolfSettings, embedding, wolf},
};
use hammerbeam_study::Model;

/// Excitation periods in which tangent vectors turn into their directions, and over which their growth is
/// averaged.
const ALIGNING: u64 = 20;
const AVERAGED: u64 = 200;

/// Largest exponents of an aperiodic motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionExponents {
    /// From the record by Wolf's method [1/s]; `None` if it has none.
    pub of_record: Option<ExponentEstimate>,
    /// Of the motion, with the half width of its interval of 95 % [1/s]; `None` where tangent vectors cannot
    /// be followed.
    pub of_motion: Option<(f64, f64)>,
}

/// Exponents of a motion that does not repeat.
///
/// * `acceleration`: as recorded; `state`: of the motion at phase 0.
pub(super) fn exponents(
    model: &Model,
    frequency_hz: f64,
    (acceleration, sampling_rate_hz): (&[f64], f64),
    state: &[f64],
) -> MotionExponents {
    MotionExponents {
        of_record: of_record(acceleration, sampling_rate_hz).ok(),
        of_motion: of_motion(model, frequency_hz, state),
    }
}

fn of_record(acceleration: &[f64], sampling_rate_hz: f64) -> Result<ExponentEstimate, SignalError> {
    let embedding = embedding(acceleration, &EmbeddingChoice::default())?;
    Ok(wolf(acceleration, sampling_rate_hz, &embedding, &WolfSettings::default())?.exponent)
}

fn of_motion(model: &Model, frequency_hz: f64, state: &[f64]) -> Option<(f64, f64)> {
    let mut map = SystemMap::new(model.system.clone(), frequency_hz, 1, ExactSettings::default()).ok()?;
    let settings = LyapunovSettings { aligning: ALIGNING, averaged: AVERAGED };
    let spectrum = lyapunov(&mut map, state, settings).ok()?;
    let largest = spectrum.exponents.first()?;
    largest.value.is_finite().then_some((largest.value, largest.half_width))
}
