//! The times of samples: order, repetitions, gaps, jitter; and the even grid that follows from them.
//!
//! The step is the median of the differences, refined by the whole length where there are no gaps. A
//! difference of more than 1.5 steps is a gap, unless differences are irregular everywhere (a tenth of them
//! are gaps, or half of them are off by 10 %). Without gaps, let `e` be the largest distance of a time from
//! its place on the even grid. Up to 1 % of a step, `e` is rounding; up to 10 % the times are accepted as
//! even with a finding; beyond that they are refused.

use super::options::RecordOptions;
use crate::{
    error::RecordError,
    finding::RecordFinding,
    limits::MAX_SAMPLES,
    raw::{RawChannel, TimeAxis},
};

/// Difference above which there is a gap, in steps.
const GAP: f64 = 1.5;
/// Largest time, and longest step; one over the shortest [s].
const FARTHEST: f64 = 1e60;
/// Deviation from the even grid, in steps, that is rounding, and that is accepted with a finding.
const ROUNDING: f64 = 0.01;
const JITTER: f64 = 0.1;
/// Longest step of a record with jitter, in median steps; a longer one is a gap.
const MAX_JITTER: f64 = 3.0;

/// Even times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TimeGrid {
    pub start_s: f64,
    pub step_s: f64,
}

/// The even grid of the samples, and the channels on it.
pub(super) fn to_even_grid(
    axis: TimeAxis,
    mut channels: Vec<RawChannel>,
    options: &RecordOptions,
    findings: &mut Vec<RecordFinding>,
) -> Result<(TimeGrid, Vec<RawChannel>), RecordError> {
    if let Some(rate) = options.sampling_rate_hz {
        return Ok((given(rate, &axis, findings)?, channels));
    }
    let mut times = match axis {
        TimeAxis::Unknown => return Err(RecordError::NoSamplingRate),
        TimeAxis::Even { step_s, start_s } => {
            ensure_step(step_s)?;
            return Ok((TimeGrid { start_s, step_s }, channels));
        }
        TimeAxis::Times(times) => times,
    };
    ensure_numbers(&times)?;
    // Of larger ones differences are no numbers.
    if let Some(&far) = times.iter().find(|time| time.abs() > FARTHEST) {
        return Err(RecordError::TooFar { time_s: far });
    }
    sort(&mut times, &mut channels, options, findings)?;
    drop_duplicates(&mut times, &mut channels, options, findings)?;
    if times.len() < 2 {
        return Err(RecordError::Empty);
    }
    let step = fill_gaps(&mut times, &mut channels, options, findings)?;
    ensure_step(step)?;
    on_grid(&times, step, channels, options, findings)
}

fn ensure_step(step_s: f64) -> Result<(), RecordError> {
    if step_s > 0.0 && (1.0 / FARTHEST..=FARTHEST).contains(&step_s) {
        Ok(())
    } else {
        Err(RecordError::Step { step_s })
    }
}

/// The sampling rate given by the user, with a finding if the file contradicts it.
fn given(rate: f64, axis: &TimeAxis, findings: &mut Vec<RecordFinding>) -> Result<TimeGrid, RecordError> {
    ensure_step(1.0 / rate)?;
    let (start_s, found) = match axis {
        TimeAxis::Unknown => (0.0, None),
        TimeAxis::Even { step_s, start_s } => (*start_s, Some(1.0 / step_s)),
        TimeAxis::Times(times) => match (times.first(), times.last()) {
            (Some(first), Some(last)) if last > first => {
                (*first, Some((times.len() - 1) as f64 / (last - first)))
            }
            (Some(first), _) if first.is_finite() => (*first, None),
            _ => (0.0, None),
        },
    };
    if let Some(found_hz) = found.filter(|found| (found / rate - 1.0).abs() > 1e-3) {
        findings.push(RecordFinding::RateDisagrees { given_hz: rate, found_hz });
    }
    Ok(TimeGrid { start_s, step_s: 1.0 / rate })
}

fn ensure_numbers(times: &[f64]) -> Result<(), RecordError> {
    let count = times.iter().filter(|time| !time.is_finite()).count();
    match times.iter().position(|time| !time.is_finite()) {
        Some(first) => Err(RecordError::TimeMissing { count, first }),
        None => Ok(()),
    }
}

fn sort(
    times: &mut Vec<f64>,
    channels: &mut [RawChannel],
    options: &RecordOptions,
    findings: &mut Vec<RecordFinding>,
) -> Result<(), RecordError> {
    let count = times.windows(2).filter(|pair| pair[1] < pair[0]).count();
    let Some(before) = times.windows(2).position(|pair| pair[1] < pair[0]) else { return Ok(()) };
    if !options.repairs.order {
        return Err(RecordError::TimeDecreases { count, first: before + 1, time_s: times[before + 1] });
    }
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by(|&a, &b| times[a].total_cmp(&times[b]));
    *times = order.iter().map(|&index| times[index]).collect();
    for channel in channels {
        channel.samples = order.iter().map(|&index| channel.samples[index]).collect();
    }
    findings.push(RecordFinding::Sorted { count });
    Ok(())
}

fn drop_duplicates(
    times: &mut Vec<f64>,
    channels: &mut [RawChannel],
    options: &RecordOptions,
    findings: &mut Vec<RecordFinding>,
) -> Result<(), RecordError> {
    let keep: Vec<bool> = (0..times.len()).map(|k| k == 0 || times[k] > times[k - 1]).collect();
    let count = keep.iter().filter(|keep| !**keep).count();
    let Some(first) = keep.iter().position(|keep| !keep) else { return Ok(()) };
    if !options.repairs.duplicates {
        return Err(RecordError::DuplicateTimes { count, first, time_s: times[first] });
    }
    let kept =
        |values: &[f64]| values.iter().zip(&keep).filter(|(_, keep)| **keep).map(|(v, _)| *v).collect();
    *times = kept(times);
    for channel in channels {
        channel.samples = kept(&channel.samples);
    }
    findings.push(RecordFinding::DuplicatesDropped { count });
    Ok(())
}

/// Fills gaps with times and interpolated samples.
///
/// # Returns
/// The step [s].
fn fill_gaps(
    times: &mut Vec<f64>,
    channels: &mut [RawChannel],
    options: &RecordOptions,
    findings: &mut Vec<RecordFinding>,
) -> Result<f64, RecordError> {
    let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let middle = steps.len() / 2;
    let step = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
    let gaps: Vec<usize> = (1..times.len()).filter(|&k| times[k] - times[k - 1] > GAP * step).collect();
    if gaps.is_empty() {
        return Ok(step);
    }
    let longest_s = gaps.iter().map(|&k| times[k] - times[k - 1]).fold(0.0, f64::max);
    let time_s = times[gaps[0] - 1];
    // Steps that are irregular everywhere are not gaps in an even record.
    let mut jumps: Vec<f64> = steps.iter().map(|found| (found / step - 1.0).abs()).collect();
    let median_jump = *jumps.select_nth_unstable_by(middle, f64::total_cmp).1;
    if gaps.len() > times.len() / 10 || median_jump > JITTER && longest_s < MAX_JITTER * step {
        let percent = 100.0 * (longest_s / step - 1.0);
        return if options.repairs.uneven {
            Ok(step)
        } else {
            Err(RecordError::Uneven { percent, step_s: step })
        };
    }
    if !options.repairs.gaps {
        return Err(RecordError::Gaps { count: gaps.len(), time_s, longest_s, step_s: step });
    }
    let samples = channels.len() as f64 * (times[times.len() - 1] - times[0]) / step;
    if samples > MAX_SAMPLES as f64 {
        return Err(RecordError::TooLong { samples });
    }
    let old = std::mem::take(times);
    *times = filled(&old, &gaps, &old, step);
    for channel in channels {
        let samples = std::mem::take(&mut channel.samples);
        channel.samples = filled(&samples, &gaps, &old, step);
    }
    findings.push(RecordFinding::GapsFilled { count: gaps.len(), longest_s });
    Ok(step)
}

/// Values with linearly interpolated ones in the gaps.
///
/// * `gaps`: indices of the values after a gap.
fn filled(values: &[f64], gaps: &[usize], times: &[f64], step: f64) -> Vec<f64> {
    let mut all = Vec::with_capacity(values.len());
    let mut from = 0;
    for &gap in gaps {
        all.extend_from_slice(&values[from..gap]);
        let parts = ((times[gap] - times[gap - 1]) / step).round();
        let (before, after) = (values[gap - 1], values[gap]);
        all.extend((1..parts as usize).map(|k| before + (after - before) * (k as f64 / parts)));
        from = gap;
    }
    all.extend_from_slice(&values[from..]);
    all
}

/// Accepts times that are even, or interpolates to the even grid, if permitted.
///
/// * `rough`: the median step [s].
fn on_grid(
    times: &[f64],
    rough: f64,
    channels: Vec<RawChannel>,
    options: &RecordOptions,
    findings: &mut Vec<RecordFinding>,
) -> Result<(TimeGrid, Vec<RawChannel>), RecordError> {
    let (start, end) = (times[0], times[times.len() - 1]);
    let step = (end - start) / (times.len() - 1) as f64;
    let grid = TimeGrid { start_s: start, step_s: step };
    let distance = |(k, time): (usize, &f64)| (time - (start + k as f64 * step)).abs();
    let deviation = times.iter().enumerate().map(distance).fold(0.0, f64::max) / step;
    if deviation <= ROUNDING {
        return Ok((grid, channels));
    }
    if deviation <= JITTER && !options.repairs.uneven {
        findings.push(RecordFinding::Jitter { percent: 100.0 * deviation });
        return Ok((grid, channels));
    }
    if !options.repairs.uneven {
        return Err(RecordError::Uneven { percent: 100.0 * deviation, step_s: rough });
    }
    let even =
        |channel: RawChannel| RawChannel { samples: interpolated(times, &channel.samples, grid), ..channel };
    findings.push(RecordFinding::Evened { percent: 100.0 * deviation, rate_hz: 1.0 / step });
    Ok((grid, channels.into_iter().map(even).collect()))
}

/// Cubic interpolation (Lagrange, four neighbouring samples) to as many even samples.
fn interpolated(times: &[f64], samples: &[f64], grid: TimeGrid) -> Vec<f64> {
    let last = times.len() - 1;
    let mut at = 0;
    let value = |k: usize| {
        let time = (grid.start_s + k as f64 * grid.step_s).min(times[last]);
        while at + 1 < last && times[at + 1] <= time {
            at += 1;
        }
        let from = at.saturating_sub(1).min(last.saturating_sub(3));
        let to = (from + 3).min(last);
        let weight = |i: usize| {
            (from..=to)
                .filter(|&j| j != i)
                .map(|j| (time - times[j]) / (times[i] - times[j]))
                .product::<f64>()
        };
        (from..=to).map(|i| samples[i] * weight(i)).sum()
    };
    (0..times.len()).map(value).collect()
}
