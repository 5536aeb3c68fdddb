//! How the time of a motion is cut: into periods of its excitation, or, where there is none, into intervals
//! of equally spaced samples.
//!
//! A motion is computed, stored and taken up again in equal pieces. Without an excitation nothing says how
//! long they are, and the motion does not depend on it: the user asks for a duration and a sampling rate, and
//! an interval holds some hundred samples, or fewer where these would be much longer than a period of the
//! lowest eigenfrequency. Its number of samples, from `m` to `2 m`, is the one with which whole intervals
//! reach the least beyond the duration.

use std::f64::consts::TAU;

use hammerbeam_study::Model;

/// Samples in a period of the lowest eigenfrequency, if nothing is said.
const USUAL_SAMPLES: u32 = 100;
/// Samples of a free motion of a structure that nothing restrains, if nothing is said.
const OF_UNRESTRAINED: f64 = 1000.0;
/// Periods at most.
const MOST_PERIODS: f64 = 1e8;
/// Samples of a free motion at most.
const MOST_SAMPLES: f64 = 4e9;

/// What the pieces of the time are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionPieces {
    /// Periods of the excitation.
    Periods,
    /// Intervals of a free motion.
    Intervals,
}

impl MotionPieces {
    /// The word for one of them.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Periods => "period",
            Self::Intervals => "interval",
        }
    }

    /// The word for several of them.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Periods => "periods",
            Self::Intervals => "intervals",
        }
    }
}

/// The time of a motion in equal pieces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimulationTime {
    /// What the pieces are.
    pub pieces: MotionPieces,
    /// Their number in a second [Hz]: the excitation frequency, where there is one.
    pub per_second: f64,
    /// Pieces that are run first and not written down.
    pub transient: u64,
    /// Pieces that are written down.
    pub count: u64,
    /// Samples in each.
    pub samples: u32,
}

/// A time with too many pieces or samples.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("the duration holds {found:e} {things}, must be {most:e} at most")]
pub struct DurationTooLong {
    /// Number of pieces or samples that it has,
    pub found: f64,
    /// and that are allowed.
    pub most: f64,
    /// `periods` or `samples`.
    pub things: &'static str,
}

impl SimulationTime {
    /// Periods of an excitation.
    #[must_use]
    pub fn periods(frequency_hz: f64, transient: u64, count: u64, samples: u32) -> Self {
        Self { pieces: MotionPieces::Periods, per_second: frequency_hz, transient, count, samples }
    }

    /// Number of periods that hold a duration, rounded up.
    ///
    /// * `duration_s`: more than 0 [s].
    ///
    /// # Errors
    /// [`DurationTooLong`]: too many.
    pub fn periods_in(duration_s: f64, frequency_hz: f64) -> Result<u64, DurationTooLong> {
        whole(duration_s * frequency_hz, (MOST_PERIODS, "periods"))
    }

    /// Intervals of a motion that nothing shakes.
    ///
    /// * `duration_s`: that is written down, rounded up to intervals [s].
    /// * `sampling_hz`: samples in a second; 100 in a period of the lowest eigenfrequency if nothing is said.
    ///
    /// # Errors
    /// [`DurationTooLong`]: too many samples.
    pub fn free(duration_s: f64, sampling_hz: Option<f64>, model: &Model) -> Result<Self, DurationTooLong> {
        let frequencies = &model.system.model().natural_frequencies;
        let lowest = frequencies.iter().copied().filter(|w| *w > 0.0).fold(f64::INFINITY, f64::min) / TAU;
        let usual = match lowest {
            f64::INFINITY => OF_UNRESTRAINED / duration_s,
            lowest => f64::from(USUAL_SAMPLES) * lowest,
        };
        let sampling_hz = sampling_hz.unwrap_or(usual);
        let samples = whole(duration_s * sampling_hz, (MOST_SAMPLES, "samples"))?;
        let per_interval = samples_per_interval(samples, (sampling_hz / lowest) as u64);
        Ok(Self {
            pieces: MotionPieces::Intervals,
            per_second: sampling_hz / f64::from(per_interval),
            transient: 0,
            count: samples.div_ceil(u64::from(per_interval)),
            samples: per_interval,
        })
    }
}

/// Rounds a product of two numbers up, but not where it exceeds a whole number by its rounding alone.
fn whole(number: f64, (most, things): (f64, &'static str)) -> Result<u64, DurationTooLong> {
    if number > most {
        return Err(DurationTooLong { found: number, most, things });
    }
    Ok(((number * (1.0 - 4.0 * f64::EPSILON)).ceil() as u64).max(1))
}

/// Samples in an interval.
///
/// * `in_a_period`: of the lowest eigenfrequency, rounded down.
fn samples_per_interval(samples: u64, in_a_period: u64) -> u32 {
    let few = in_a_period.clamp(1, u64::from(USUAL_SAMPLES));
    let beyond = |per_interval: &u64| samples.div_ceil(*per_interval) * per_interval - samples;
    let best = if samples <= 2 * few { Some(samples) } else { (few..=2 * few).min_by_key(beyond) };
    best.map_or(1, |samples| samples as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_intervals_end_with_the_duration_or_a_few_samples_later() {
        for samples in (1..3000).chain([1_000_003, 100_000_007]) {
            let per_interval = u64::from(samples_per_interval(samples, 100));
            let intervals = samples.div_ceil(per_interval);
            let beyond = intervals * per_interval - samples;
            assert!(per_interval <= 200 && intervals * per_interval >= samples);
            assert!(beyond * 50 <= samples.min(500), "{beyond} of {samples}");
        }
    }

    #[test]
    fn an_interval_is_no_longer_than_some_periods_of_the_lowest_eigenfrequency() {
        assert_eq!((samples_per_interval(1000, 0), samples_per_interval(1001, 1)), (1, 1));
        assert!(samples_per_interval(1000, 7) <= 14);
    }

    #[test]
    fn a_product_that_is_whole_but_for_rounding_is_that_number() {
        for (one, other, product) in [(0.1, 3.0, 1), (0.7, 10.0, 7), (1.1, 1000.0, 1100), (2.0, 50.0, 100)] {
            assert_eq!(whole(one * other, (1e4, "samples")).unwrap(), product);
        }
        assert!(whole(1e11, (1e4, "samples")).is_err());
    }
}
