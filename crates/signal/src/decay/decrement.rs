//! The classical logarithmic decrement: the slope of the logarithms of successive maxima.
//!
//! The strongest mode is looked at; other modes that were fitted and the offset are taken off first. Each
//! maximum is that of the parabola which is fitted to the samples within an eighth of a period about it. With
//! maxima `y_k` of noise `e`, `ln y_k` has the standard error `e / y_k`; so the regression `ln y_k = c - k L`
//! is weighted by `y_k²` (that of the fitted mode: weights from the maxima themselves would favour those
//! which noise has raised), and it ends where `y_k` falls below [`LOWEST`] times the noise.

use std::f64::consts::PI;

use hammerbeam_fit::distribution::student_quantile;

use super::{Decay, Estimate};
use crate::error::SignalError;

/// Maxima below so many times the noise do not count: below that the logarithm is biased by the noise.
const LOWEST: f64 = 5.0;
/// Fewest maxima.
const FEWEST: usize = 4;
/// Fewest maxima in half of a decay that say something about a change.
const FEWEST_OF_HALF: usize = 4;

/// A logarithmic decrement by successive maxima.
#[derive(Debug, Clone, PartialEq)]
pub struct Decrement {
    /// Eigenfrequency of the mode it is of [Hz].
    pub frequency_hz: f64,
    /// The decrement.
    pub decrement: Estimate,
    /// The damping ratio, `L / sqrt(4 pi² + L²)`.
    pub damping_ratio: Estimate,
    /// Number of maxima.
    pub maxima: usize,
    /// Decrement over the first and the second half of the maxima, if each has at least four.
    pub halves: Option<[Estimate; 2]>,
}

impl Decrement {
    /// Whether the decrement changes over the decay: the intervals of both halves do not meet. Nothing if
    /// there are too few maxima to tell.
    #[must_use]
    pub fn changes(&self) -> Option<bool> {
        let [first, second] = self.halves?;
        Some((first.value - second.value).abs() > first.half_width + second.half_width)
    }
}

/// The decrement of the strongest mode.
///
/// * `series`, `sampling_rate_hz`: what `decay` was found in.
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
    let mut rest: Vec<f64> = series.iter().map(|value| value - decay.offset).collect();
    for (m, oscillation) in decay.oscillations.iter().enumerate() {
        if m != strongest {
            oscillation.subtract(&mut rest, step);
        }
    }
    let oscillation = &decay.oscillations[strongest];
    let period = 2.0 * PI * sampling_rate_hz / oscillation.frequency;
    // A maximum lies where the phase is the angle by which damping leads it.
    let lead = (oscillation.rate / oscillation.frequency).atan();
    let first = (-decay.modes[strongest].phase - lead).rem_euclid(2.0 * PI) / (2.0 * PI) * period;
    let logarithms = maxima(&rest, first, period, LOWEST * decay.residual);
    if logarithms.len() < FEWEST {
        return Err(SignalError::NoDecay);
    }
    let expected = 2.0 * PI * oscillation.rate / oscillation.frequency;
    let decrement = slope(&logarithms, expected);
    let halves = logarithms.split_at(logarithms.len() / 2);
    let chain = 4.0 * PI * PI / (4.0 * PI * PI + decrement.value.powi(2)).powf(1.5);
    Ok(Decrement {
        frequency_hz: decay.modes[strongest].frequency_hz.value,
        decrement,
        damping_ratio: Estimate {
            value: decrement.value / (2.0 * PI).hypot(decrement.value),
            half_width: decrement.half_width * chain,
        },
        maxima: logarithms.len(),
        halves: (halves.0.len() >= FEWEST_OF_HALF)
            .then(|| [slope(halves.0, expected), slope(halves.1, expected)]),
    })
}

/// Number of the period and logarithm of each maximum, up to where they sink into the noise.
fn maxima(series: &[f64], first: f64, period: f64, lowest: f64) -> Vec<(f64, f64)> {
    let reach = (period / 8.0).max(1.0);
    let mut found = Vec::new();
    for k in 0.. {
        let place = first + f64::from(k) * period;
        if place + reach >= series.len() as f64 {
            break;
        }
        if place < reach {
            continue;
        }
        match parabola(series, place, reach) {
            Some(value) if value > lowest => found.push((f64::from(k), value.ln())),
            _ => break,
        }
    }
    found
}

/// Maximum of the parabola fitted to the samples about a place.
fn parabola(series: &[f64], place: f64, reach: f64) -> Option<f64> {
    let (low, high) = ((place - reach).ceil() as usize, (place + reach).floor() as usize);
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
    let (level, bend) = ((s4 * y0 - s2 * y2) / determinant, (n * y2 - s2 * y0) / determinant);
    let tilt = y1 / s2;
    (bend < 0.0).then(|| level - tilt * tilt / (4.0 * bend))
}

/// Regression, weighted for an expected decrement; the slope's sign turned.
fn slope(points: &[(f64, f64)], expected: f64) -> Estimate {
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
    Estimate { value: -slope, half_width: student_quantile(0.95, free) * (squares / free / xx).sqrt() }
}
