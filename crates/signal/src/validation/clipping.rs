//! Clipping: flat tops at the end of the range of an instrument.
//!
//! Let `q` be the resolution at a level, the smallest difference of two values of about that size. A smooth
//! maximum `y = -c k²/2` keeps one level for `n` samples while `c n²/8 < q`. It leaves the level with a step
//! of about `c n/2 = 4 q/n`, at most `4/3 q` for three samples. So a run of three or more equal samples at
//! the largest or smallest value, entered or left with a step above `2 q`, is not a smooth maximum but
//! clipped. A level of exactly zero does not count: an open contact has zero force.
//!
//! Numbers with a fixed count of significant digits have a resolution that changes at powers of ten or two.
//! So the resolution at a level is taken from the values between it and the next such power below. Where the
//! level itself is the only one, the resolution is ten times that of the values below that power.

use crate::{finding::RecordFinding, raw::RawChannel};

/// Minimum number of equal samples that count.
const RUN: usize = 3;
/// Step into a flat top, in units of the resolution, above which it is not a smooth maximum.
const STEEP: f64 = 2.0;

/// Adds findings for constant and clipped channels.
pub(super) fn detect(channel: &RawChannel, findings: &mut Vec<RecordFinding>) {
    let samples = &channel.samples;
    let (low, high) = samples
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &value| (low.min(value), high.max(value)));
    if low >= high {
        findings.push(RecordFinding::Constant { channel: channel.name.clone() });
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
        findings.push(RecordFinding::Clipped {
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
    /// The larger of the steps in and out.
    step: f64,
}

/// Resolution at a level that is not zero; infinite where no values determine it.
fn resolution(samples: &[f64], level: f64) -> f64 {
    let size = level.abs();
    let sizes: Vec<f64> = samples.iter().map(|value| value * level.signum()).collect();
    let power = 10f64.powf(size.log10().floor()).max(size.log2().floor().exp2());
    let here = smallest_difference(&sizes, (power, size));
    if here.is_finite() { here } else { 10.0 * smallest_difference(&sizes, (0.5 * power, power)) }
}

/// Smallest difference of any two values within a range, not only of successive ones: those of a fast signal
/// differ by more.
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
