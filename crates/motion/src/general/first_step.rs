//! How long a first step is, at the start and behind a boundary.

use super::{GeneralSettings, VectorField, stepper::Stepper};

/// Length of a first step behind a boundary whose error does not count, see `March::good_enough`.
pub(super) fn negligible(smooth_step: f64, settings: &GeneralSettings) -> f64 {
    smooth_step * settings.tolerance.powf(2.0 / 3.0)
}

/// Shortest first step, in parts of the stretch: a velocity that is rounding alone, where the motion turns,
/// doubles in no time. A step that is too long is done again.
const SHORTEST_FIRST: f64 = 1e-6;

/// A hundredth of the time in which a part of the state would double, at most a tenth of the stretch.
pub(super) fn first_step(field: &impl VectorField, stepper: &Stepper, duration: f64) -> f64 {
    (0.01 * doubling_time(field, stepper)).min(0.1 * duration).max(SHORTEST_FIRST * duration)
}

/// The shortest time in which a part of the state would double; infinite at rest.
pub(super) fn doubling_time(field: &impl VectorField, stepper: &Stepper) -> f64 {
    let part = stepper.state().len() / field.parts();
    let norm = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>().sqrt();
    let parts = stepper.state().chunks_exact(part).zip(stepper.slope(0).chunks_exact(part));
    let times = parts.map(|(value, slope)| norm(value) / norm(slope)).filter(|&time| time > 0.0);
    times.fold(f64::INFINITY, f64::min)
}
