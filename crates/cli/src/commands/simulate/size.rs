//! What a motion may take of memory and of the disk.

use super::{time::Pieces, told::Told};
use crate::failure::Failure;

/// Numbers of one period that are held in memory at most, 0.8 GB: a period is computed and stored as a whole.
const MOST_OF_A_PERIOD: u64 = 100_000_000;
/// Numbers that the store keeps at most, 40 GB, and some 150 GB of text.
const MOST_KEPT: u64 = 5_000_000_000;
/// Numbers that a sample takes in memory besides those that it holds: time, phase, and where the others are.
const OF_A_SAMPLE: u64 = 8;

/// Refuses what is too large.
///
/// * `kept`: whether the motion goes into a store.
pub fn check(told: &Told<'_>, kept: bool) -> Result<(), Failure> {
    let layout = told.layout;
    let (dof, elements) = (layout.dof, layout.elements.len());
    // State and forces, and what is written down of them.
    let of_sample = (2 * dof + elements + layout.numbers_of_sample()) as u64 + OF_A_SAMPLE;
    let samples = u64::from(layout.samples_per_period);
    let (periods, of_period) = (layout.periods, layout.numbers_of_period());
    if kept && told.pieces == Pieces::Intervals && periods * of_period > MOST_KEPT {
        return Err(Failure::BadInput(format!(
            "the motion is {} numbers, must be {MOST_KEPT} at most with --out; allowed: a shorter --duration, or a \
             lower --sampling than {} Hz",
            periods * of_period,
            layout.frequency_hz * f64::from(layout.samples_per_period)
        )));
    }
    if samples * of_sample > MOST_OF_A_PERIOD {
        return Err(Failure::BadInput(format!(
            "--samples-per-period {samples} of {dof} degrees of freedom and {elements} local elements is {} numbers in a period, must be {MOST_OF_A_PERIOD} at most; allowed: 1 to {} samples",
            samples * of_sample,
            MOST_OF_A_PERIOD / of_sample
        )));
    }
    if kept && periods * of_period > MOST_KEPT {
        return Err(Failure::BadInput(format!(
            "--periods {periods} of {of_period} numbers each is {} numbers, must be {MOST_KEPT} at most with --out; allowed: 1 to {} periods with --samples-per-period {samples}",
            periods * of_period,
            MOST_KEPT / of_period
        )));
    }
    Ok(())
}
