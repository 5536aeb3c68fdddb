//! Flat tops: does a channel stand at the end of its range because the instrument could not follow?
//!
//! With `q` the resolution at that level, the smallest difference of two values about as large, a smooth
//! maximum `y = -c k²/2` stays on one level for `n` samples while `c n²/8` is below `q`, and leaves it with a
//! step of about `c n/2 = 4 q/n`, at most `4/3 q` for three samples. So a run of three or more equal samples
//! at the largest or smallest value that is entered or left with a step of more than `2 q` is no smooth
//! maximum: it is counted as clipped. Standing at exactly zero does not count: a contact force does.
//!
//! Numbers with so many significant digits are the finer the smaller they are, in steps at the powers of ten,
//! or of two. So values down to the next such power below the level tell its resolution; where there are none
//! but the level itself, ten times what the values below that power tell.

use crate::{finding::Finding, raw::RawChannel};

/// Fewest equal samples that count.
const RUN: usize = 3;
/// Steps into a flat top, in units of the resolution, from which on it is no smooth maximum.
const STEEP: f64 = 2.0;

pub(super) fn look(channel: &RawChannel, findings: &mut Vec<Finding>) {
    let samples = &channel.samples;
    let (low, high) = samples
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &value| (low.min(value), high.max(value)));
    if low >= high {
        findings.push(Finding::Constant { channel: channel.name.clone() });
        return;
    }
    let tops =
        [high, low].into_iter().filter(|level| *level != 0.0).map(|level| (level, flat_tops(samples, level)));
    let tops: Vec<(f64, Vec<FlatTop>)> = tops.filter(|(_, tops)| !tops.is_empty()).collect();
    if tops.is_empty() {
        return;
    }
    for (level, tops) in tops {
        let limit = STEEP * resolution(samples, level);
        let steep: Vec<&FlatTop> = tops.iter().filter(|top| top.step > limit).collect();
        let Some(first) = steep.first() else { continue };
        findings.push(Finding::Clipped {
            channel: channel.name.clone(),
            samples: steep.iter().map(|top| top.length).sum(),
            places: steep.len(),
            level,
            first: first.start,
        });
    }
}

/// Equal samples at the end of the range.
struct FlatTop {
    start: usize,
    length: usize,
    /// The larger step of those in and out.
    step: f64,
}

/// Resolution at a level that is not zero; infinite where nothing tells it.
fn resolution(samples: &[f64], level: f64) -> f64 {
    let size = level.abs();
    let sizes: Vec<f64> = samples.iter().map(|value| value * level.signum()).collect();
    let power = 10f64.powf(size.log10().floor()).max(size.log2().floor().exp2());
    let here = smallest_difference(&sizes, (power, size));
    if here.is_finite() { here } else { 10.0 * smallest_difference(&sizes, (0.5 * power, power)) }
}

/// Smallest difference of two values within a range, whenever they were taken: successive samples of a fast
/// signal differ by more.
fn smallest_difference(values: &[f64], (low, high): (f64, f64)) -> f64 {
    let mut values: Vec<f64> = values.iter().copied().filter(|value| (low..=high).contains(value)).collect();
    values.sort_unstable_by(f64::total_cmp);
    let differences = values.windows(2).map(|pair| pair[1] - pair[0]);
    differences.filter(|difference| *difference > 0.0).fold(f64::INFINITY, f64::min)
}

/// Runs of equal samples at a level that are long enough.
fn flat_tops(samples: &[f64], level: f64) -> Vec<FlatTop> {
    let mut tops = Vec::new();
    let mut at = 0;
    while at < samples.len() {
        if samples[at] != level {
            at += 1;
            continue;
        }
        let length = samples[at..].iter().take_while(|value| **value == level).count();
        let step = |index: Option<usize>| {
            index.and_then(|index| samples.get(index)).map_or(0.0, |value| (value - level).abs())
        };
        if length >= RUN {
            let step = step(at.checked_sub(1)).max(step(Some(at + length)));
            tops.push(FlatTop { start: at, length, step });
        }
        at += length;
    }
    tops
}
