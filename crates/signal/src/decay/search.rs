//! Where oscillations are, roughly: the decay rate and frequency at which a damped oscillation takes most off
//! a series.
//!
//! For one oscillation of given `s` and `w` the least-squares fit takes about `2 |X|² / sum exp(-2 s t)` off
//! the sum of squares, with `X = sum_k y_k exp(-s t_k) exp(-i w t_k)`: one Fourier transform for each decay
//! rate. The rates looked at halve the error from one to the next. In white noise of variance `v`, `|X|² / (v
//! sum exp(-2 s t))` is distributed exponentially with mean 1, so a maximum over `n` independent values
//! exceeds `ln(n / p)` with the probability `p`. The variance is taken from the surroundings of each
//! frequency in the spectrum without damping (the median over neighbouring values over `ln 2`), so that
//! coloured noise does not look like a mode.

use std::f64::consts::{LN_2, PI};

use super::Oscillation;
use crate::fourier;

/// Decay rates times the length of the record.
const RATES: [f64; 9] = [0.0, 0.7, 1.5, 3.0, 6.0, 12.0, 25.0, 50.0, 100.0];
/// Values to each side that tell the noise, and nearest ones that do not count.
const SURROUNDINGS: usize = 60;
const LINE: usize = 8;
/// Probability with which noise alone passes for an oscillation.
const CHANCE: f64 = 1e-4;

/// The strongest oscillation of a series, if it stands out of the noise.
///
/// * `band`: angular frequencies between which to look [rad/s].
pub(super) fn strongest(series: &[f64], step: f64, band: (f64, f64), certain: bool) -> Option<Oscillation> {
    let length = series.len();
    let duration = length as f64 * step;
    let resolution = 2.0 * PI / duration;
    let undamped = fourier::forward(series.to_vec());
    let power: Vec<f64> = undamped.iter().map(|x| x.norm_sqr() / length as f64).collect();
    let floor = floor(&power);
    let first = ((band.0 / resolution).ceil() as usize).max(1);
    let last = ((band.1 / resolution).floor() as usize).min(power.len().saturating_sub(2));
    let mut best: Option<(f64, Oscillation)> = None;
    for decades in RATES {
        let rate = decades / duration;
        let weighted = |(k, value): (usize, &f64)| value * (-rate * k as f64 * step).exp();
        let spectrum = if decades == 0.0 {
            undamped.clone()
        } else {
            fourier::forward(series.iter().enumerate().map(weighted).collect())
        };
        let squares: f64 = (0..length).map(|k| (-2.0 * rate * k as f64 * step).exp()).sum();
        for k in first..=last {
            let gain = spectrum[k].norm_sqr() / squares;
            let stands_out = !certain || gain > floor[k] * (length as f64 * RATES.len() as f64 / CHANCE).ln();
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

/// Power of the noise about each frequency: the median of the neighbours that are not next to it, in blocks.
fn floor(power: &[f64]) -> Vec<f64> {
    let median = |values: &mut Vec<f64>| {
        let middle = values.len() / 2;
        *values.select_nth_unstable_by(middle, f64::total_cmp).1 / LN_2
    };
    let block = LINE;
    let of_block = |centre: usize| {
        let low = centre.saturating_sub(SURROUNDINGS);
        let high = (centre + block + SURROUNDINGS).min(power.len());
        let mut values: Vec<f64> = (low..high)
            .filter(|&k| k + LINE < centre || k >= centre + block + LINE)
            .map(|k| power[k])
            .collect();
        if values.is_empty() { power.iter().copied().fold(0.0, f64::max) } else { median(&mut values) }
    };
    let blocks: Vec<f64> = (0..power.len()).step_by(block).map(of_block).collect();
    (0..power.len()).map(|k| blocks[k / block]).collect()
}
