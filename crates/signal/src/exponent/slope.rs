//! The straight part of a curve, and its slope.

use crate::error::SignalError;

/// Parts of the rise between which flows and maps are fitted.
const FLOW: (f64, f64) = (0.3, 0.7);
const MAP: (f64, f64) = (0.0, 0.6);
/// Part of the rise below which distances do not fall again once they have grown.
const STAYS: f64 = 0.5;

/// Part of the whole rise by which the last fifth of a curve may lie above the fifth before it and still be level.
const LEVEL: f64 = 0.05;

/// Whether a curve still rises at its end: then its final level is not known.
pub(super) fn rises(curve: &[f64]) -> bool {
    let fifth = (curve.len() / 5).max(1);
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let (rest, last) = curve.split_at(curve.len() - fifth);
    let before = mean(&rest[rest.len() - fifth..]);
    mean(last) - before > LEVEL * (mean(last) - curve[0])
}

/// First and last step of the straight part.
///
/// The final level is the mean of the last fifth.
///
/// # Errors
/// [`SignalError::NoScaling`].
pub(super) fn straight_part(curve: &[f64], flow: bool) -> Result<(usize, usize), SignalError> {
    let tail = &curve[curve.len() - (curve.len() / 5).max(1)..];
    let level = tail.iter().sum::<f64>() / tail.len() as f64;
    let rise = level - curve[0];
    // Distances that do not even double do not diverge.
    if rise.is_nan() || rise < std::f64::consts::LN_2 {
        return Err(SignalError::NoScaling { reason: "neighbours do not move apart" });
    }
    let (low, high) = if flow { FLOW } else { MAP };
    let reaches = |part: f64| curve.iter().position(|value| *value >= curve[0] + part * rise);
    match (reaches(low), reaches(high)) {
        (Some(from), Some(to)) => {
            let to = to.max(from + 2);
            let lowest = curve.iter().skip(to).copied().fold(f64::INFINITY, f64::min);
            if lowest < curve[0] + STAYS * rise {
                return Err(SignalError::NoScaling {
                    reason: "neighbours that move apart come together again",
                });
            }
            if to < curve.len() {
                return Ok((from, to));
            }
            Err(SignalError::NoScaling { reason: "it rises until the end: follow neighbours for longer" })
        }
        _ => Err(SignalError::NoScaling { reason: "neighbours do not move apart" }),
    }
}

/// Slope of the regression line from one step to another, both included.
pub(super) fn slope(curve: &[f64], (from, to): (usize, usize)) -> f64 {
    let n = (to - from + 1) as f64;
    let x = (from + to) as f64 / 2.0;
    let y = curve[from..=to].iter().sum::<f64>() / n;
    let at = || curve[from..=to].iter().enumerate().map(|(k, value)| ((from + k) as f64 - x, value - y));
    at().map(|(k, value)| k * value).sum::<f64>() / at().map(|(k, _)| k * k).sum::<f64>()
}
