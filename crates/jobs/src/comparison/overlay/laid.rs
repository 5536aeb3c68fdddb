//! One orbit laid under the measurement.

use hammerbeam_signal::{
    MeasuredQuantity, SignalError,
    filter::{periodic_low_pass, periodic_zero_phase},
    waveform::{Alignment, Shifts, Waveform, align, band_limited, delayed},
};
use hammerbeam_study::Model;

use super::{candidates::Candidate, error::OverlayError, found::Overlay, settings::OverlaySettings};
use crate::comparison::history::{LEFT, MotionHistory, Sampled, history, largest, size};

/// Samples of an orbit in an excitation period, before the filter; a multiple of those of the waveform.
const SAMPLES: usize = 4096;

/// What came of an orbit.
type Tried = Sampled<Overlay, OverlayError>;

/// Lays an orbit under the measurement.
pub(super) fn laid(
    model: &Model,
    (branch, row, orbit): &Candidate,
    measured: &Waveform,
    settings: &OverlaySettings,
) -> Tried {
    let finer = SAMPLES.div_ceil(measured.per_period);
    let history = match history(model, orbit, finer * measured.per_period) {
        Ok(history) => history,
        Err(reason) => return Ok(Err(reason)),
    };
    let unfiltered = sensed(&history, settings.quantity)?;
    let filtered = behind(unfiltered, history.duration_s, settings)?;
    let shown = band_limited(&filtered, measured.samples.len(), measured.lines)?;
    let lay = lay(&measured.samples, &shown, settings.shifts, settings.factor)?;
    // What is delayed by whole samples of the orbit has no overshoot at a contact.
    let turned = |series: &[f64]| -> Vec<f64> {
        let mut series = series.to_vec();
        let steps = (lay.alignment.shift * finer as f64).round() as usize % series.len();
        series.rotate_right(steps);
        series.into_iter().step_by(finer).collect()
    };
    Ok(Ok(Overlay {
        frequency_hz: orbit.frequency_hz,
        branch: *branch,
        row: *row,
        factor: lay.factor,
        residual_before: lay.residual_before,
        residual_after: lay.residual_after,
        turned_correlation: lay.turned_correlation,
        filtered: delayed(&shown, lay.alignment.shift)?,
        unfiltered: turned(unfiltered),
        displacement: turned(&history.displacement),
        supports: history.supports.iter().map(|series| turned(series)).collect(),
        largest: (largest(unfiltered), largest(&filtered)),
        alignment: lay.alignment,
        alike: None,
        tried: 0,
        skipped: 0,
    }))
}

/// The quantity of a history.
fn sensed(history: &MotionHistory, quantity: MeasuredQuantity) -> Result<&[f64], OverlayError> {
    match quantity {
        MeasuredQuantity::Displacement => Ok(&history.displacement),
        MeasuredQuantity::Velocity => Ok(&history.velocity),
        MeasuredQuantity::Acceleration => Ok(&history.acceleration),
        other => Err(OverlayError::NoSuchSensor { quantity: other.word() }),
    }
}

/// A history behind the filter of the measurement.
fn behind(unfiltered: &[f64], duration_s: f64, settings: &OverlaySettings) -> Result<Vec<f64>, OverlayError> {
    let Some((filter, zero_phase)) = settings.filter else { return Ok(unfiltered.to_vec()) };
    let low_pass = if zero_phase { periodic_zero_phase } else { periodic_low_pass };
    let filtered = low_pass(unfiltered, duration_s, (filter.order, filter.cut_off_hz))?;
    let left = size(&filtered) / size(unfiltered);
    if left < LEFT {
        return Err(OverlayError::FilteredAway { cut_off_hz: filter.cut_off_hz, left });
    }
    Ok(filtered)
}

/// How a measured waveform lies over a computed one.
#[derive(Debug)]
struct Lay {
    alignment: Alignment,
    factor: f64,
    residual_before: f64,
    residual_after: f64,
    turned_correlation: f64,
}

/// Lays a measured waveform over a computed one; turned around, if the factor is given and negative.
fn lay(measured: &[f64], computed: &[f64], shifts: Shifts, given: Option<f64>) -> Result<Lay, SignalError> {
    let sign = given.map_or(1.0, f64::signum);
    let lie = |sign: f64| {
        let oriented: Vec<f64> = measured.iter().map(|value| sign * value).collect();
        align(&oriented, computed, shifts)
    };
    let alignment = lie(sign)?;
    let factor = given.unwrap_or(alignment.factor);
    // The alignment is that of the measurement times the sign.
    let residual = |factor: f64| alignment.residual(sign * factor);
    Ok(Lay {
        factor,
        residual_before: residual(factor.signum()),
        residual_after: residual(factor),
        turned_correlation: lie(-sign)?.correlation,
        alignment,
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::comparison::{Filter, Sought};

    const LENGTH: usize = 96;

    fn wave(phase: f64) -> f64 {
        (TAU * phase).cos() + 0.5 * (2.0 * TAU * phase + 1.0).sin() + 0.2 * (5.0 * TAU * phase).cos()
    }

    /// Samples from a phase on, and something else besides.
    fn sampled(from: f64, other: f64) -> Vec<f64> {
        let at = |k: usize| k as f64 / LENGTH as f64;
        (0..LENGTH).map(|k| wave(at(k) + from) + other * (3.0 * TAU * at(k)).sin()).collect()
    }

    /// Root mean square of `factor a - b` over that of `b`, about the means.
    fn direct(a: &[f64], b: &[f64], factor: f64) -> f64 {
        let difference: Vec<f64> = a.iter().zip(b).map(|(a, b)| factor * a - b).collect();
        size(&difference) / size(b)
    }

    #[test]
    fn residuals_are_direct_sums_whatever_the_sign_of_the_factor() {
        let computed = sampled(0.0, 0.0);
        for sign in [1.0, -1.0] {
            // Delayed by 0.2 of the period, on another level, with something that the orbit lacks.
            let measured: Vec<f64> =
                sampled(-0.2, 0.3).iter().map(|value| 0.4 * sign * value + 2.0).collect();
            for given in [None, Some(2.5), Some(-2.5), Some(-0.7)] {
                let found = lay(&measured, &computed, Shifts::Any, given).unwrap();
                let b = delayed(&computed, found.alignment.shift).unwrap();
                let (before, after) =
                    (direct(&measured, &b, found.factor.signum()), direct(&measured, &b, found.factor));
                assert!(
                    (found.residual_before - before).abs() < 1e-12,
                    "{sign} {given:?}: {before} {found:?}"
                );
                assert!((found.residual_after - after).abs() < 1e-12, "{sign} {given:?}: {after} {found:?}");
                assert!(given.is_none_or(|given| given == found.factor));
            }
        }
    }

    /// Where no delay is allowed the best factor of a mirror image is negative.
    #[test]
    fn residual_of_a_fitted_negative_factor_is_a_direct_sum() {
        let computed = sampled(0.0, 0.0);
        let measured: Vec<f64> = sampled(0.0, 0.3).iter().map(|value| -0.4 * value).collect();
        let still = Shifts::NearWhole { period: LENGTH, most: 0.0 };
        let found = lay(&measured, &computed, still, None).unwrap();
        assert!(found.factor < 0.0 && found.alignment.shift == 0.0, "{found:?}");
        assert!(
            (found.residual_after - direct(&measured, &computed, found.factor)).abs() < 1e-12,
            "{found:?}"
        );
        assert!((found.residual_before - direct(&measured, &computed, -1.0)).abs() < 1e-12, "{found:?}");
    }

    /// Order 4 at a hundredth of the frequency leaves 1e-8 of a harmonic, at a tenth 1e-4.
    #[test]
    fn motion_that_is_filtered_to_nothing_is_refused() {
        let settings = |cut_off_hz: f64| OverlaySettings {
            quantity: MeasuredQuantity::Displacement,
            filter: Some((Filter { order: 4, cut_off_hz }, false)),
            sought: Sought::At(10.0),
            branch: None,
            shifts: Shifts::Any,
            factor: None,
        };
        let harmonic: Vec<f64> = (0..LENGTH).map(|k| 5.0 + (TAU * k as f64 / LENGTH as f64).cos()).collect();
        let refused = behind(&harmonic, 0.1, &settings(0.1)).unwrap_err();
        let OverlayError::FilteredAway { cut_off_hz, left } = refused else { panic!("{refused}") };
        assert!(cut_off_hz == 0.1 && (left / 1e-8 - 1.0).abs() < 1e-6, "{left}");
        assert!(
            (size(&behind(&harmonic, 0.1, &settings(1.0)).unwrap()) / size(&harmonic) / 1e-4 - 1.0).abs()
                < 1e-6
        );
    }
}
