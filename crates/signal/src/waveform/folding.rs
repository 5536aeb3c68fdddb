//! Records folded onto the periods of an excitation.

use super::within_lines;
use crate::{
    error::{SignalError, ensure, ensure_series},
    resample::{Interpolation, KNOWN_BELOW, REACH},
};

/// A record, averaged over its pieces of some excitation periods.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    /// Means at equal steps of the phase, from the beginning of a piece on.
    pub samples: Vec<f64>,
    /// Samples in an excitation period.
    pub per_period: usize,
    /// Highest line of its spectrum, in cycles over its length.
    pub lines: usize,
    /// Pieces that were averaged.
    pub pieces: usize,
    /// Root mean square of what the pieces differ from their mean by.
    pub scatter: f64,
}

/// Fewest pieces of a mean.
const PIECES: usize = 2;

/// Folds a record.
///
/// Pieces begin at one time, and whole pieces before and after it. An error of the frequency moves a piece by
/// as much more as it is further from that time, so take one within the record, or a frequency that is exact.
///
/// * `begin_s`: a time at which a piece begins, from the first sample on; it need not be within the record
///   [s].
/// * `frequency_hz`: of the excitation.
/// * `periods`, `per_period`: excitation periods of a piece, and samples in each of them.
///
/// # Errors
/// [`SignalError::TooShort`] if fewer than two pieces are in it, [`SignalError::NotFinite`],
/// [`SignalError::Input`].
pub fn folded(
    samples: &[f64],
    (sampling_rate_hz, begin_s): (f64, f64),
    frequency_hz: f64,
    (periods, per_period): (usize, usize),
) -> Result<Waveform, SignalError> {
    ensure("the excitation frequency", frequency_hz, "more than 0", frequency_hz > 0.0)?;
    ensure("the number of periods", periods as f64, "at least 1", periods > 0)?;
    let samples_of_piece = periods as f64 * sampling_rate_hz / frequency_hz;
    let needed = ((PIECES as f64 * samples_of_piece).ceil() as usize).saturating_add(1);
    ensure_series("averaging over periods", samples, needed)?;
    let length = periods * per_period;
    let lines = ((KNOWN_BELOW * samples_of_piece) as usize).min(length.saturating_sub(1) / 2);
    let allowed = "enough for a line in a piece, in the record and in the waveform";
    ensure("the number of samples in a piece", samples_of_piece.min(length as f64), allowed, lines > 0)?;
    let begin = -begin_s * frequency_hz / periods as f64;
    let end = begin + (samples.len() - 1) as f64 / samples_of_piece;
    // Beside the ends interpolation has too few samples: such pieces are taken only where there are too few
    // others.
    let margin = REACH as f64 / samples_of_piece;
    let inner = ((begin + margin).ceil() as i64, (end - margin).floor() as i64);
    let enough = inner.1 - inner.0 >= PIECES as i64;
    let (first, last) = if enough { inner } else { (begin.ceil() as i64, end.floor() as i64) };
    let pieces = (last - first).max(0) as usize;
    if pieces < PIECES {
        // A piece is lost where none begins with the record.
        let needed = (((PIECES + 1) as f64 * samples_of_piece).ceil() as usize).saturating_add(1);
        return Err(SignalError::TooShort { what: "averaging over periods", found: samples.len(), needed });
    }
    // As many phases as the record has samples at least.
    let phases = length * (samples_of_piece / length as f64).ceil() as usize;
    let interpolation = Interpolation::new();
    let (mut sums, mut squares) = (vec![0.0; phases], vec![0.0; phases]);
    let level = samples.iter().sum::<f64>() / samples.len() as f64;
    for piece in first..last {
        for k in 0..phases {
            let place = (piece as f64 + k as f64 / phases as f64 - begin) * samples_of_piece;
            let value = interpolation.at(samples, place) - level;
            sums[k] += value;
            squares[k] += value * value;
        }
    }
    let count = pieces as f64;
    let spread: f64 = sums.iter().zip(&squares).map(|(s, q)| (q - s * s / count).max(0.0)).sum();
    let scatter = (spread / (phases as f64 * (count - 1.0))).sqrt();
    let means: Vec<f64> = sums.iter().map(|sum| level + sum / count).collect();
    Ok(Waveform { samples: within_lines(&means, length, lines)?, per_period, lines, pieces, scatter })
}
