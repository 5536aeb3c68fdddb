//! Records folded onto the periods of an excitation.

use super::band_limit::band_limited;
use crate::{
    error::{SignalError, ensure, ensure_series},
    resample::{ACCURATE_BELOW, Interpolation, REACH},
};

/// A record averaged over its pieces of a number of excitation periods.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    /// Means at equal steps of the phase, from the start of a piece.
    pub samples: Vec<f64>,
    /// Samples in an excitation period.
    pub per_period: usize,
    /// Highest line of its spectrum, in cycles over its length.
    pub lines: usize,
    /// Number of averaged pieces.
    pub pieces: usize,
    /// Root mean square deviation of the pieces from their mean.
    pub scatter: f64,
}

/// Minimum number of pieces of a mean.
const MIN_PIECES: usize = 2;

/// Folds a record onto the periods of an excitation.
///
/// Pieces start at a given time and at whole pieces before and after it. An error of the frequency shifts a
/// piece in proportion to its distance from that time: use a time within the record, or an exact frequency.
///
/// * `start_s`: start of one of the pieces after the first sample; it may be outside the record [s].
/// * `frequency_hz`: excitation frequency.
/// * `periods`, `per_period`: excitation periods of a piece, and samples in each of them.
///
/// # Errors
/// [`SignalError::TooShort`] if fewer than two pieces are in it, [`SignalError::NotFinite`],
/// [`SignalError::Input`].
pub fn folded(
    samples: &[f64],
    (sampling_rate_hz, start_s): (f64, f64),
    frequency_hz: f64,
    (periods, per_period): (usize, usize),
) -> Result<Waveform, SignalError> {
    ensure("the excitation frequency", frequency_hz, "more than 0", frequency_hz > 0.0)?;
    ensure("the number of periods", periods as f64, "at least 1", periods > 0)?;
    let samples_of_piece = periods as f64 * sampling_rate_hz / frequency_hz;
    let needed = ((MIN_PIECES as f64 * samples_of_piece).ceil() as usize).saturating_add(1);
    ensure_series("averaging over periods", samples, needed)?;
    let length = periods * per_period;
    let lines = ((ACCURATE_BELOW * samples_of_piece) as usize).min(length.saturating_sub(1) / 2);
    let allowed = "enough for a line in a piece, in the record and in the waveform";
    ensure("the number of samples in a piece", samples_of_piece.min(length as f64), allowed, lines > 0)?;
    let first_sample = -start_s * frequency_hz / periods as f64;
    let last_sample = first_sample + (samples.len() - 1) as f64 / samples_of_piece;
    // Next to the ends interpolation lacks samples: such pieces are used only if there are too few others.
    let margin = REACH as f64 / samples_of_piece;
    let inner = ((first_sample + margin).ceil() as i64, (last_sample - margin).floor() as i64);
    let enough = inner.1 - inner.0 >= MIN_PIECES as i64;
    let (first, last) = if enough { inner } else { (first_sample.ceil() as i64, last_sample.floor() as i64) };
    let pieces = (last - first).max(0) as usize;
    if pieces < MIN_PIECES {
        // A piece is lost if none starts at the first sample.
        let needed = (((MIN_PIECES + 1) as f64 * samples_of_piece).ceil() as usize).saturating_add(1);
        return Err(SignalError::TooShort { what: "averaging over periods", found: samples.len(), needed });
    }
    // At least as many phases as the record has samples.
    let phases = length * (samples_of_piece / length as f64).ceil() as usize;
    let interpolation = Interpolation::new();
    let (mut sums, mut squares) = (vec![0.0; phases], vec![0.0; phases]);
    let level = samples.iter().sum::<f64>() / samples.len() as f64;
    for piece in first..last {
        for k in 0..phases {
            let position = (piece as f64 + k as f64 / phases as f64 - first_sample) * samples_of_piece;
            let value = interpolation.at(samples, position) - level;
            sums[k] += value;
            squares[k] += value * value;
        }
    }
    let count = pieces as f64;
    let spread: f64 = sums.iter().zip(&squares).map(|(s, q)| (q - s * s / count).max(0.0)).sum();
    let scatter = (spread / (phases as f64 * (count - 1.0))).sqrt();
    let means: Vec<f64> = sums.iter().map(|sum| level + sum / count).collect();
    Ok(Waveform { samples: band_limited(&means, length, lines)?, per_period, lines, pieces, scatter })
}
