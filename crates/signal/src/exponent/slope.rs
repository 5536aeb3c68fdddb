//! The straight part of a curve, and its slope.

use crate::error::SignalError;

/// Fractions of the rise between which flows are fitted, and up to which maps are fitted.
const FLOW: (f64, f64) = (0.3, 0.7);
const MAP: f64 = 0.6;
/// Fraction of the rise above which the size of the attractor limits distances.
const NEAR_THE_LEVEL: f64 = 0.8;
/// Fraction of the rise below which distances do not fall again after the fitted part.
const STAYS: f64 = 0.5;

/// Fraction of the rise by which the last fifth of a level curve may exceed the fifth before it.
const LEVEL: f64 = 0.05;

/// Whether a curve still rises at its end, so that its final level is unknown.
pub(super) fn rises(curve: &[f64]) -> bool {
    let fifth = (curve.len() / 5).max(1);
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let (rest, last) = curve.split_at(curve.len() - fifth);
    let before = mean(&rest[rest.len() - fifth..]);
    mean(last) - before > LEVEL * (mean(last) - curve[0])
}

/// First and last step of the straight part between two fractions of the rise.
///
/// The first step of a map does not count: in it the difference of two neighbours turns into the growing
/// direction.
///
/// # Errors
/// [`SignalError::NoScaling`].
pub(super) fn straight_part(curve: &[f64], flow: bool) -> Result<(usize, usize), SignalError> {
    let rise = rise(curve)?;
    let reaches = |part: f64| curve.iter().position(|value| *value >= curve[0] + part * rise);
    let from = if flow { reaches(FLOW.0) } else { Some(1) };
    let (Some(from), Some(to)) = (from, reaches(if flow { FLOW.1 } else { MAP })) else {
        return Err(SignalError::NoScaling { reason: "neighbours do not move apart" });
    };
    let to = to.max(from + 2);
    let lowest = curve.iter().skip(to).copied().fold(f64::INFINITY, f64::min);
    if lowest < curve[0] + STAYS * rise {
        return Err(SignalError::NoScaling { reason: "neighbours that move apart come together again" });
    }
    if to < curve.len() {
        return Ok((from, to));
    }
    Err(SignalError::NoScaling { reason: "it rises until the end: follow neighbours for longer" })
}

/// First and last step of the mean period in which the curve grows most, after the first period and before
/// the curve is near its final level.
///
/// Growth over a whole period is used instead of a regression slope, so that oscillations of that period
/// cancel.
///
/// * `period`: mean period in steps.
///
/// # Errors
/// [`SignalError::NoScaling`].
pub(super) fn steepest_period(curve: &[f64], period: usize) -> Result<(usize, usize), SignalError> {
    let near = curve[0] + NEAR_THE_LEVEL * rise(curve)?;
    let end = curve.iter().position(|value| *value >= near).unwrap_or(curve.len() - 1);
    let periods = (period..=end.saturating_sub(period)).map(|from| (from, from + period));
    periods.max_by(|a, b| growth(curve, *a).total_cmp(&growth(curve, *b))).ok_or(SignalError::NoScaling {
        reason: "neighbours are as far apart as they come within two mean periods: there is no whole \
                 one after the first",
    })
}

/// From the first distance to the final level, the mean of the last fifth.
fn rise(curve: &[f64]) -> Result<f64, SignalError> {
    let tail = &curve[curve.len() - (curve.len() / 5).max(1)..];
    let rise = tail.iter().sum::<f64>() / tail.len() as f64 - curve[0];
    // Distances that do not even double do not diverge.
    if rise.is_nan() || rise < std::f64::consts::LN_2 {
        return Err(SignalError::NoScaling { reason: "neighbours do not move apart" });
    }
    Ok(rise)
}

/// Slope of the regression line from one step to another, both included.
pub(super) fn slope(curve: &[f64], (from, to): (usize, usize)) -> f64 {
    let n = (to - from + 1) as f64;
    let x = (from + to) as f64 / 2.0;
    let y = curve[from..=to].iter().sum::<f64>() / n;
    let at = || curve[from..=to].iter().enumerate().map(|(k, value)| ((from + k) as f64 - x, value - y));
    at().map(|(k, value)| k * value).sum::<f64>() / at().map(|(k, _)| k * k).sum::<f64>()
}

/// Mean growth per step from one step to another.
pub(super) fn growth(curve: &[f64], (from, to): (usize, usize)) -> f64 {
    (curve[to] - curve[from]) / (to - from) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line of slope 0.01 up to its level at 400, with oscillations of period 50.
    fn oscillating(level_at: usize) -> Vec<f64> {
        let oscillation = |k: usize| 0.2 * (std::f64::consts::TAU * k as f64 / 50.0 + 0.3).sin();
        (0..1000).map(|k| 0.01 * k.min(level_at) as f64 + oscillation(k)).collect()
    }

    #[test]
    fn oscillations_cancel_over_a_whole_period() {
        let curve = oscillating(400);
        let fit = steepest_period(&curve, 50).unwrap();
        assert!(fit.0 >= 50 && fit.1 - fit.0 == 50 && fit.1 <= 400, "{fit:?}");
        assert!((growth(&curve, fit) - 0.01).abs() < 1e-12, "{fit:?}");
    }

    #[test]
    fn curve_that_is_level_within_two_periods_has_no_steepest_one() {
        assert!(matches!(steepest_period(&oscillating(90), 50), Err(SignalError::NoScaling { .. })));
        assert!(matches!(steepest_period(&oscillating(0), 50), Err(SignalError::NoScaling { .. })));
    }

    /// The first step grows by 0.1, the next ones by 0.5, up to a level.
    #[test]
    fn first_step_of_a_map_does_not_count() {
        let curve: Vec<f64> =
            (0..25).map(|k| if k == 0 { 0.0 } else { 0.1 + 0.5 * f64::from(k.min(9) - 1) }).collect();
        let fit = straight_part(&curve, false).unwrap();
        assert_eq!(fit.0, 1);
        assert!((slope(&curve, fit) - 0.5).abs() < 1e-12, "{fit:?}");
    }
}
