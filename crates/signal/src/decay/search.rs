//! Initial values: the decay rate and frequency at which a damped oscillation reduces the residual most.
//!
//! For one oscillation with `s` and `w` the least-squares fit reduces the sum of squares by about `2 |X|² /
//! sum exp(-2 s t)`, with `X = sum_k y_k exp(-s t_k) exp(-i w t_k)`: one Fourier transform for each decay
//! rate. The rates that are tried roughly double from one to the next. In white noise of variance `v`, `|X|²
//! / (v sum exp(-2 s t))` is distributed exponentially with mean 1. So a maximum over `n` independent values
//! exceeds `ln(n / p)` with the probability `p`. The variance is estimated around each frequency in the
//! spectrum without damping (the median over neighbouring values over `ln 2`), so that coloured noise is not
//! a mode.

use std::f64::consts::{LN_2, PI};

use super::model::Oscillation;
use crate::fourier;

/// Decay rates times the duration of the record.
const RATES: [f64; 9] = [0.0, 0.7, 1.5, 3.0, 6.0, 12.0, 25.0, 50.0, 100.0];
/// Values on each side from which the noise is estimated, and nearest ones that are excluded.
const SURROUNDINGS: usize = 60;
const EXCLUDED: usize = 8;
/// Probability of mistaking noise for an oscillation.
const FALSE_ALARM: f64 = 1e-4;

/// The strongest oscillation of a series, if it exceeds the noise.
///
/// * `band`: lower and upper limit of the angular frequency [rad/s].
/// * `certain`: whether it has to exceed the noise; else the strongest one in any case.
pub(super) fn strongest(series: &[f64], step: f64, band: (f64, f64), certain: bool) -> Option<Oscillation> {
    let length = series.len();
    let duration = length as f64 * step;
    let resolution = 2.0 * PI / duration;
    let undamped = fourier::forward(series.to_vec());
    let power: Vec<f64> = undamped.iter().map(|x| x.norm_sqr() / length as f64).collect();
    let noise = noise_power(&power);
    let first = ((band.0 / resolution).ceil() as usize).max(1);
    let last = ((band.1 / resolution).floor() as usize).min(power.len().saturating_sub(2));
    let mut best: Option<(f64, Oscillation)> = None;
    for scaled_rate in RATES {
        let rate = scaled_rate / duration;
        let weighted = |(k, value): (usize, &f64)| value * (-rate * k as f64 * step).exp();
        let spectrum = if scaled_rate == 0.0 {
            undamped.clone()
        } else {
            fourier::forward(series.iter().enumerate().map(weighted).collect())
        };
        let squares: f64 = (0..length).map(|k| (-2.0 * rate * k as f64 * step).exp()).sum();
        for k in first..=last {
            let gain = spectrum[k].norm_sqr() / squares;
            let stands_out =
                !certain || gain > noise[k] * (length as f64 * RATES.len() as f64 / FALSE_ALARM).ln();
            if stands_out && best.is_none_or(|(other, _)| gain > other) {
                let amplitude = spectrum[k] * 2.0 / squares;
                let oscillation = Oscillation {
                    rate: rate.max(0.1 / duration),
                    frequency: k as f64 * resolution,
                    cosine: amplitude.re,
                    sine: -amplitude.im,
                };
                best = Some((gain, oscillation));
            }
        }
    }
    best.map(|(_, oscillation)| oscillation)
}

/// Power of the noise around each frequency, in blocks: the median of the neighbours that are not excluded.
fn noise_power(power: &[f64]) -> Vec<f64> {
    let median = |values: &mut Vec<f64>| {
        let middle = values.len() / 2;
        *values.select_nth_unstable_by(middle, f64::total_cmp).1 / LN_2
    };
    let block = EXCLUDED;
    let of_block = |centre: usize| {
        let low = centre.saturating_sub(SURROUNDINGS);
        let high = (centre + block + SURROUNDINGS).min(power.len());
        let mut values: Vec<f64> = (low..high)
            .filter(|&k| k + EXCLUDED < centre || k >= centre + block + EXCLUDED)
            .map(|k| power[k])
            .collect();
        if values.is_empty() { power.iter().copied().fold(0.0, f64::max) } else { median(&mut values) }
    };
    let blocks: Vec<f64> = (0..power.len()).step_by(block).map(of_block).collect();
    (0..power.len()).map(|k| blocks[k / block]).collect()
}
