//! How the time of a motion is cut: into periods of its excitation, or, where there is none, into intervals
//! of equally spaced samples.
//!
//! A motion is computed, stored and taken up again in equal pieces. Without an excitation nothing says how
//! long they are, and the motion does not depend on it: the user asks for a duration and a sampling rate, and
//! an interval holds some hundred samples, or fewer where these would be much longer than a period of the
//! lowest eigenfrequency. Its number of samples, from `m` to `2 m`, is the one with which whole intervals
//! reach the least beyond the duration.

use std::f64::consts::TAU;

use hammerbeam_results::store::SimulationLayout;
use hammerbeam_study::{Model, StudyFile};

use crate::{failure::Failure, motion_args::SimulateOptions};

/// Periods that are written down if nothing is said.
const USUAL_PERIODS: u64 = 10;
/// Samples in a period, or in a period of the lowest eigenfrequency, if nothing is said.
const USUAL_SAMPLES: u32 = 100;
/// Samples of a free motion of a structure that nothing restrains, if nothing is said.
const OF_UNRESTRAINED: f64 = 1000.0;
/// Periods at most.
const MOST_PERIODS: f64 = 1e8;
/// Samples of a free motion at most.
const MOST_SAMPLES: f64 = 4e9;

/// What the pieces of the time are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pieces {
    /// Periods of the excitation.
    Periods,
    /// Intervals of a free motion.
    Intervals,
}

impl Pieces {
    /// The word for one of them.
    pub fn word(self) -> &'static str {
        match self {
            Self::Periods => "period",
            Self::Intervals => "interval",
        }
    }

    /// The word for several of them.
    pub fn words(self) -> &'static str {
        match self {
            Self::Periods => "periods",
            Self::Intervals => "intervals",
        }
    }
}

/// What is to be written down of a motion, and what its pieces are.
pub fn layout(
    options: &SimulateOptions,
    (file, model): (&StudyFile, &Model),
) -> Result<(SimulationLayout, Pieces), Failure> {
    let pieces = if file.forced().is_ok() { Pieces::Periods } else { Pieces::Intervals };
    let (frequency_hz, periods, samples_per_period) = match pieces {
        Pieces::Periods => forced(options)?,
        Pieces::Intervals => free(options, model)?,
    };
    let layout = SimulationLayout {
        transient_periods: options.transient_periods,
        periods,
        frequency_hz,
        samples_per_period,
        section_phase: options.section_phase,
        dof: model.system.dof(),
        elements: model.system.elements().iter().map(|element| element.name.clone()).collect(),
    };
    Ok((layout, pieces))
}

fn bad(message: String) -> Failure {
    Failure::BadInput(message)
}

/// Frequency, periods, and samples in each.
fn forced(options: &SimulateOptions) -> Result<(f64, u64, u32), Failure> {
    if options.sampling.is_some() {
        let message = "--sampling is for a study without [excitation]; allowed here: --samples-per-period";
        return Err(bad(message.to_owned()));
    }
    let Some(frequency_hz) = options.frequency else {
        return Err(bad("--frequency is missing: the study has an [excitation]".to_owned()));
    };
    let periods = match options.duration {
        None => options.periods.unwrap_or(USUAL_PERIODS),
        Some(duration) => whole(duration * frequency_hz, (MOST_PERIODS, "periods"))?,
    };
    Ok((frequency_hz, periods, options.samples_per_period.unwrap_or(USUAL_SAMPLES)))
}

/// Intervals in a second, their number, and samples in each.
fn free(options: &SimulateOptions, model: &Model) -> Result<(f64, u64, u32), Failure> {
    let refused = [
        ("--frequency", options.frequency.is_some()),
        ("--periods", options.periods.is_some()),
        ("--transient-periods", options.transient_periods > 0),
        ("--samples-per-period", options.samples_per_period.is_some()),
        ("--section-phase", options.section_phase > 0.0),
    ];
    if let Some((flag, _)) = refused.iter().find(|(_, given)| *given) {
        let message = "the study has no [excitation], so no period; allowed: --duration S and --sampling HZ";
        return Err(bad(format!("{flag}: {message}")));
    }
    let Some(duration) = options.duration else {
        let message = "--duration is missing: the study has no [excitation], so no period to count";
        return Err(bad(message.to_owned()));
    };
    let frequencies = &model.system.model().natural_frequencies;
    let lowest = frequencies.iter().copied().filter(|w| *w > 0.0).fold(f64::INFINITY, f64::min) / TAU;
    let usual = match lowest {
        f64::INFINITY => OF_UNRESTRAINED / duration,
        lowest => f64::from(USUAL_SAMPLES) * lowest,
    };
    let sampling_hz = options.sampling.unwrap_or(usual);
    let samples = whole(duration * sampling_hz, (MOST_SAMPLES, "samples"))?;
    let per_interval = samples_per_interval(samples, (sampling_hz / lowest) as u64);
    let per_second = sampling_hz / f64::from(per_interval);
    Ok((per_second, samples.div_ceil(u64::from(per_interval)), per_interval))
}

/// Rounds a product of two numbers up, but not where it exceeds a whole number by its rounding alone.
fn whole(number: f64, (most, things): (f64, &str)) -> Result<u64, Failure> {
    if number > most {
        return Err(bad(format!("--duration holds {number:e} {things}, must be {most:e} at most")));
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
