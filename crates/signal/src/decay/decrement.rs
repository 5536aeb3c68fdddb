//! The classical logarithmic decrement: the slope of the logarithms of successive maxima.
//!
//! The strongest mode is evaluated, after subtraction of the offset and of the other fitted modes. Each
//! maximum is taken from the parabola fitted to the samples within an eighth of a period about it. With
//! maxima `y_k` of noise `e`, `ln y_k` has the standard error `e / y_k`; so the regression `ln y_k = c - k L`
//! is weighted by `y_k²`. The weights come from the fitted mode: those of the maxima themselves would favour
//! maxima raised by noise. The regression ends where `y_k` falls below [`LOWEST`] times the noise.

use std::f64::consts::PI;

use hammerbeam_fit::distribution::student_quantile;

use super::modes::{Decay, DecayEstimate};
use crate::error::SignalError;

/// Least maximum that counts, over the noise: the noise biases the logarithm of smaller ones.
const LOWEST: f64 = 5.0;
/// Minimum number of maxima.
const MIN_MAXIMA: usize = 4;
/// Minimum number of maxima in half of a decay for a statement about a change.
const MIN_MAXIMA_OF_HALF: usize = 4;

/// A logarithmic decrement by successive maxima.
#[derive(Debug, Clone, PartialEq)]
pub struct Decrement {
    /// Eigenfrequency of the mode [Hz].
    pub frequency_hz: f64,
    /// The decrement.
    pub decrement: DecayEstimate,
    /// The damping ratio, `L / sqrt(4 pi² + L²)`.
    pub damping_ratio: DecayEstimate,
    /// Number of maxima.
    pub maxima: usize,
    /// Decrement over the first and the second half of the maxima, if each has at least four.
    pub halves: Option<[DecayEstimate; 2]>,
}

impl Decrement {
    /// Whether the decrement changes over the decay: the intervals of both halves do not overlap. `None` if
    /// there are too few maxima.
    #[must_use]
    pub fn changes(&self) -> Option<bool> {
        let [first, second] = self.halves?;
        Some((first.value - second.value).abs() > first.half_width + second.half_width)
    }
}

/// The decrement of the strongest mode.
///
/// * `series`, `sampling_rate_hz`: the series that `decay` was fitted to.
///
/// # Errors
/// [`SignalError::NoDecay`] if fewer than four maxima stand out of the noise.
pub fn decrement(series: &[f64], sampling_rate_hz: f64, decay: &Decay) -> Result<Decrement, SignalError> {
    let step = 1.0 / sampling_rate_hz;
    let strength =
        |m: usize| decay.modes[m].amplitude.powi(2) / decay.modes[m].damping_ratio.value.abs().max(1e-9);
    let strongest = (0..decay.modes.len())
        .max_by(|&a, &b| strength(a).total_cmp(&strength(b)))
        .ok_or(SignalError::NoDecay)?;
    let mut remainder: Vec<f64> = series.iter().map(|value| value - decay.offset).collect();
    for (m, oscillation) in decay.oscillations.iter().enumerate() {
        if m != strongest {
            oscillation.subtract(&mut remainder, step);
        }
    }
    let oscillation = &decay.oscillations[strongest];
    let period = 2.0 * PI * sampling_rate_hz / oscillation.frequency;
    // At a maximum the phase equals the lead angle that the damping causes.
    let lead = (oscillation.rate / oscillation.frequency).atan();
    let first = (-decay.modes[strongest].phase - lead).rem_euclid(2.0 * PI) / (2.0 * PI) * period;
    let logarithms = maxima(&remainder, first, period, LOWEST * decay.residual);
    if logarithms.len() < MIN_MAXIMA {
        return Err(SignalError::NoDecay);
    }
    let expected = 2.0 * PI * oscillation.rate / oscillation.frequency;
    let decrement = slope(&logarithms, expected);
    let halves = logarithms.split_at(logarithms.len() / 2);
    let derivative = 4.0 * PI * PI / (4.0 * PI * PI + decrement.value.powi(2)).powf(1.5);
    Ok(Decrement {
        frequency_hz: decay.modes[strongest].frequency_hz.value,
        decrement,
        damping_ratio: DecayEstimate {
            value: decrement.value / (2.0 * PI).hypot(decrement.value),
            half_width: decrement.half_width * derivative,
        },
        maxima: logarithms.len(),
        halves: (halves.0.len() >= MIN_MAXIMA_OF_HALF)
            .then(|| [slope(halves.0, expected), slope(halves.1, expected)]),
    })
}

/// Number of the period and logarithm of each maximum above the noise.
fn maxima(series: &[f64], first: f64, period: f64, lowest: f64) -> Vec<(f64, f64)> {
    let reach = (period / 8.0).max(1.0);
    let mut found = Vec::new();
    for k in 0.. {
        let position = first + f64::from(k) * period;
        if position + reach >= series.len() as f64 {
            break;
        }
        if position < reach {
            continue;
        }
        match parabola(series, position, reach) {
            Some(value) if value > lowest => found.push((f64::from(k), value.ln())),
            _ => break,
        }
    }
    found
}

/// Maximum of the parabola fitted to the samples about a position.
fn parabola(series: &[f64], position: f64, reach: f64) -> Option<f64> {
    let (low, high) = ((position - reach).ceil() as usize, (position + reach).floor() as usize);
    let centre = (low + high) as f64 / 2.0;
    let (mut n, mut s2, mut s4, mut y0, mut y1, mut y2) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for k in low..=high {
        let (x, y) = (k as f64 - centre, series[k]);
        n += 1.0;
        s2 += x * x;
        s4 += x.powi(4);
        y0 += y;
        y1 += x * y;
        y2 += x * x * y;
    }
    let determinant = n * s4 - s2 * s2;
    if determinant <= 0.0 {
        return None;
    }
    let (level, curvature) = ((s4 * y0 - s2 * y2) / determinant, (n * y2 - s2 * y0) / determinant);
    let tilt = y1 / s2;
    (curvature < 0.0).then(|| level - tilt * tilt / (4.0 * curvature))
}

/// Negative slope of a regression with the weights of an expected decrement.
fn slope(points: &[(f64, f64)], expected: f64) -> DecayEstimate {
    let first = points.first().map_or(0.0, |point| point.0);
    let weights: Vec<f64> = points.iter().map(|point| (-2.0 * expected * (point.0 - first)).exp()).collect();
    let all = || points.iter().zip(&weights);
    let total: f64 = weights.iter().sum();
    let x = all().map(|((x, _), w)| w * x).sum::<f64>() / total;
    let y = all().map(|((_, y), w)| w * y).sum::<f64>() / total;
    let xx: f64 = all().map(|((at, _), w)| w * (at - x).powi(2)).sum();
    let xy: f64 = all().map(|((at, value), w)| w * (at - x) * (value - y)).sum();
    let slope = xy / xx;
    let free = (points.len() as f64 - 2.0).max(1.0);
    let squares: f64 = all().map(|((at, value), w)| w * (value - y - slope * (at - x)).powi(2)).sum();
    DecayEstimate { value: -slope, half_width: student_quantile(0.95, free) * (squares / free / xx).sqrt() }
}
