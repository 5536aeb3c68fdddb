//! What a motion may take of memory and of the disk.

use hammerbeam_results::store::SimulationLayout;

use super::MotionPieces;

/// Numbers of one period that are held in memory at most, 0.8 GB: a period is computed and stored as a whole.
const MOST_OF_A_PERIOD: u64 = 100_000_000;
/// Numbers that the store keeps at most, 40 GB, and some 150 GB of text.
const MOST_KEPT: u64 = 5_000_000_000;
/// Numbers that a sample takes in memory besides those that it holds: time, phase, and where the others are.
const OF_A_SAMPLE: u64 = 8;

/// A motion that takes too much of memory or of the disk.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum SimulationTooLarge {
    /// A free motion that is to be kept.
    #[error(
        "the motion is {numbers} numbers, must be {most} at most where it is kept; allowed: a shorter \
        duration, or less than {sampling_hz} samples in a second"
    )]
    Free { numbers: u64, most: u64, sampling_hz: f64 },
    /// A period has too many samples.
    #[error(
        "{samples} samples of {dof} degrees of freedom and {elements} local elements is {numbers} numbers \
        in a period, must be {most} at most; allowed: 1 to {most_samples} samples"
    )]
    Period { samples: u64, dof: usize, elements: usize, numbers: u64, most: u64, most_samples: u64 },
    /// A forced motion that is to be kept.
    #[error(
        "{periods} periods of {of_period} numbers each is {numbers} numbers, must be {most} at most where \
        it is kept; allowed: 1 to {most_periods} periods with {samples} samples in each"
    )]
    Periods { periods: u64, of_period: u64, numbers: u64, most: u64, most_periods: u64, samples: u64 },
}

/// Refuses what is too large.
///
/// * `kept`: whether the motion goes into a store.
pub(super) fn check(
    layout: &SimulationLayout,
    pieces: MotionPieces,
    kept: bool,
) -> Result<(), SimulationTooLarge> {
    let (dof, elements) = (layout.dof, layout.elements.len());
    // State and forces, and what is written down of them.
    let of_sample = (2 * dof + elements + layout.numbers_of_sample()) as u64 + OF_A_SAMPLE;
    let samples = u64::from(layout.samples_per_period);
    let (periods, of_period) = (layout.periods, layout.numbers_of_period());
    let is_too_much = kept && periods * of_period > MOST_KEPT;
    if is_too_much && pieces == MotionPieces::Intervals {
        let sampling_hz = layout.frequency_hz * f64::from(layout.samples_per_period);
        return Err(SimulationTooLarge::Free { numbers: periods * of_period, most: MOST_KEPT, sampling_hz });
    }
    if samples * of_sample > MOST_OF_A_PERIOD {
        return Err(SimulationTooLarge::Period {
            samples,
            dof,
            elements,
            numbers: samples * of_sample,
            most: MOST_OF_A_PERIOD,
            most_samples: MOST_OF_A_PERIOD / of_sample,
        });
    }
    if is_too_much {
        return Err(SimulationTooLarge::Periods {
            periods,
            of_period,
            numbers: periods * of_period,
            most: MOST_KEPT,
            most_periods: MOST_KEPT / of_period,
            samples,
        });
    }
    Ok(())
}
