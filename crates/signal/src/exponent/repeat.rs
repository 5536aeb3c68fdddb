//! Whether a record repeats itself: then it has no exponent.
//!
//! `D(L)` is the mean square of `x_{k+L} - x_k`: the sums of squares from `L` on and up to `N-L`, minus twice
//! the correlation at `L`, over `N - L`. A record repeats after the first `L`, up to half of its length, at
//! which the root of `D` falls below [`SAME`] standard deviations. Before that, `D` must have exceeded half
//! of the variance: a signal that changes little from sample to sample does not repeat after one. Coinciding
//! states are no neighbours, since their distance is rounding.

use crate::fourier;

/// Difference up to which samples are equal, in standard deviations.
pub const SAME: f64 = 1e-3;

/// Number of samples in which a repetition is searched for; it is then checked on all samples.
const SEARCHED: usize = 1 << 22;

/// Samples after which a series repeats, if it holds at least two repetitions.
pub(super) fn repeats_after(all: &[f64]) -> Option<usize> {
    let series = &all[..all.len().min(SEARCHED)];
    let length = series.len();
    let mean = series.iter().sum::<f64>() / length as f64;
    let centred: Vec<f64> = series.iter().map(|value| value - mean).collect();
    let variance = centred.iter().map(|value| value * value).sum::<f64>() / length as f64;
    let correlation = correlation(&centred);
    let mut squares = 2.0 * variance * length as f64;
    let mut apart = false;
    for lag in 1..=length / 2 {
        squares -= centred[lag - 1].powi(2) + centred[length - lag].powi(2);
        let difference = (squares - 2.0 * correlation[lag]) / (length - lag) as f64;
        apart |= difference > 0.5 * variance;
        // Sums of squares carry rounding, so an apparent repetition is checked exactly.
        if apart && difference < 1.001 * SAME * SAME * variance {
            let exact: f64 = all.iter().zip(&all[lag..]).map(|(one, other)| (other - one).powi(2)).sum();
            if exact < SAME * SAME * variance * (all.len() - lag) as f64 {
                return Some(lag);
            }
        }
    }
    None
}

/// `sum x_k x_{k+L}` for all `L`, by a transform of the series padded with as many zeros.
fn correlation(series: &[f64]) -> Vec<f64> {
    let mut padded = series.to_vec();
    padded.resize(2 * series.len(), 0.0);
    let length = padded.len();
    let mut spectrum = fourier::forward(padded);
    spectrum.iter_mut().for_each(|value| *value *= value.conj());
    fourier::backward(spectrum, length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repetition_is_found_where_it_is() {
        // Seven values repeatedly; a slow sine whose neighbours hardly differ; noise of 1 % on it.
        let seven: Vec<f64> = (0..300).map(|k| f64::from((k % 7) * (k % 7) % 5)).collect();
        assert_eq!(repeats_after(&seven), Some(7));
        let slow = |k: u32| (std::f64::consts::PI * f64::from(k) / 1000.0).sin();
        assert_eq!(repeats_after(&(0..6000).map(slow).collect::<Vec<_>>()), Some(2000));
        assert_eq!(repeats_after(&(0..3000).map(slow).collect::<Vec<_>>()), None, "not twice in it");
        let mut random = crate::random::RandomSource::new(1);
        let noisy: Vec<f64> = (0..6000).map(|k| slow(k) + 0.01 * random.normal()).collect();
        assert_eq!(repeats_after(&noisy), None);
    }

    #[test]
    fn chaos_does_not_repeat() {
        let mut x = 0.3;
        let series: Vec<f64> = (0..5000)
            .map(|_| {
                x = 3.9 * x * (1.0 - x);
                x
            })
            .collect();
        assert_eq!(repeats_after(&series), None);
    }
}
