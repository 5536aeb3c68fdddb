//! Measured and computed signals laid over one another: figures 7 to 14 of the paper.
//!
//! The rig is measured at a frequency, and its filtered acceleration folded onto as many excitation periods as the figure has. Of the stable orbits of that period whose frequency is near, that one
//! is taken whose acceleration, behind the same filter, looks most alike: the largest correlation of both waveforms about their means, over whole excitation periods and over a lag of
//! at most a tenth of one, since two structures of different damping do not answer with the same phase. The paper does the same by eye.

use std::sync::atomic::AtomicBool;

use hammerbeam_attractor::in_order;
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_signal::{
    Quantity,
    classify::{Classification, ClassifySettings, classify},
    filter::periodic_low_pass,
    resample::Interpolation,
};

use super::{
    RigError, RigPoint,
    sweep::{FINER, LEAD_IN, record, settled},
};
use crate::{
    Model, StoredBranches,
    comparison::{
        course::{Course, course, follow, largest},
        thinned,
    },
    file::Rig,
};

/// Samples in an excitation period: of the waveforms, and of an orbit before the filter.
const SHOWN: usize = 512;
const SAMPLES: usize = 4096;
/// Distance of orbits that are tried and how far off they may be, as parts of the frequency.
const SPACING: f64 = 1e-3;
const NEAR: f64 = 0.08;
/// Largest lag, in samples of a waveform, and its step.
const MOST_LAG: usize = SHOWN / 10;
const LAG_STEP: usize = 2;

/// A measured signal and the computed one that is most alike.
#[derive(Debug, Clone, PartialEq)]
pub struct SignalPair {
    /// Frequency of the measurement [Hz].
    pub measured_hz: f64,
    /// Period multiple of both.
    pub period_multiple: u32,
    /// What the measurement was taken for.
    pub classification: Classification,
    /// The orbit that is most alike; `None` if no stable one of the period is near.
    pub computed: Option<Computed>,
    /// Phase [cycles] over the periods.
    pub phases: Vec<f64>,
    /// Measured acceleration, the mean over the record [m/s²].
    pub measured: Vec<f64>,
    /// Largest value in the whole record [m/s²].
    pub largest_measured: f64,
}

/// The orbit that is most alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Computed {
    /// Its frequency [Hz].
    pub frequency_hz: f64,
    /// Number of its branch,
    pub branch: u32,
    /// and its row there, from 1 on.
    pub row: usize,
    /// Correlation of both waveforms.
    pub correlation: f64,
    /// By how much the measured one is behind it [cycles]; the tables show it as it is.
    pub lag: f64,
    /// Acceleration [m/s²] at the phases,
    pub acceleration: Vec<f64>,
    /// behind the filter,
    pub filtered: Vec<f64>,
    /// displacement [m],
    pub displacement: Vec<f64>,
    /// and that of the support [m].
    pub support: Vec<f64>,
    /// Largest acceleration, as stored [m/s²].
    pub largest: f64,
    /// Largest acceleration behind the filter [m/s²].
    pub largest_filtered: f64,
}

/// Measures the rig at a frequency and finds the orbit that is most alike.
///
/// * `points`: of the sweeps; the motion begins at the state of the nearest one of that period.
/// * `factor`: that of the frequencies of the model over those of the rig.
///
/// # Errors
/// [`RigError`].
pub fn compare_signal(
    rig: &Rig,
    (rig_model, points): (&Model, &[RigPoint]),
    (model, branches): (&Model, &StoredBranches),
    (measured_hz, period_multiple): (f64, u32),
    factor: f64,
    (threads, stop): (usize, &AtomicBool),
) -> Result<SignalPair, RigError> {
    let (acceleration, start_s) = measure(rig, rig_model, points, (measured_hz, period_multiple))?;
    let classification = classify(&acceleration, rig.sampling_hz, measured_hz, &ClassifySettings::default())?;
    let phases: Vec<f64> = (0..SHOWN * period_multiple as usize).map(|k| k as f64 / SHOWN as f64).collect();
    let measured = folded(&acceleration, (rig.sampling_hz, start_s), measured_hz, &phases);
    let orbits = candidates(branches, factor * measured_hz, period_multiple)?;
    let look = |(): &mut (), (branch, row, orbit): &(u32, usize, PeriodicSolution)| {
        computed(rig, model, orbit, (*branch, *row), &measured)
    };
    let tried = in_order(&orbits, threads, stop, || (), look).ok_or(RigError::Interrupted)?;
    let tried = tried.into_iter().collect::<Result<Vec<_>, _>>()?;
    // The first of equal ones, whatever the number of threads.
    let best =
        tried.into_iter().reduce(|best, one| if one.correlation > best.correlation { one } else { best });
    let largest_measured = largest(&acceleration);
    Ok(SignalPair {
        measured_hz,
        period_multiple,
        classification,
        computed: best,
        phases,
        measured,
        largest_measured,
    })
}

/// Acceleration as the chain shows it, and the time of its first sample.
fn measure(
    rig: &Rig,
    model: &Model,
    points: &[RigPoint],
    (frequency_hz, period): (f64, u32),
) -> Result<(Vec<f64>, f64), RigError> {
    let off = |point: &&RigPoint| {
        let other = point.point.kind.period_multiple() != Some(period);
        // A motion of another period counts as 2 Hz farther away.
        (point.point.frequency_hz - frequency_hz).abs() + if other { 2.0 } else { 0.0 }
    };
    let nearest = points.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    let rest = vec![0.0; 2 * model.system.dof()];
    let state = nearest.map_or(rest.as_slice(), |point| point.state.as_slice());
    let (mut simulation, _) = settled(rig, model, frequency_hz, state)?;
    let samples = (FINER * rig.sampling_hz / frequency_hz).ceil() as usize;
    let course = follow(model, &mut simulation, frequency_hz, LEAD_IN + rig.recorded_periods, samples)?;
    let seed = u64::from(rig.seed) ^ frequency_hz.to_bits();
    let source = (samples as f64 * frequency_hz, seed);
    Ok(record(rig, Quantity::Acceleration, &course.acceleration, source)?)
}

/// Mean of a record over all its pieces of so many periods, at phases.
fn folded(samples: &[f64], (rate_hz, start_s): (f64, f64), frequency_hz: f64, phases: &[f64]) -> Vec<f64> {
    let interpolation = Interpolation::new();
    let periods = (phases.len() / SHOWN) as f64;
    let begin = start_s * frequency_hz;
    let end = begin + (samples.len() - 1) as f64 / rate_hz * frequency_hz;
    let (first, last) = ((begin / periods).ceil() as usize, (end / periods).floor() as usize);
    let at = |cycles: f64| interpolation.at(samples, (cycles - begin) / frequency_hz * rate_hz);
    let mean = |phase: &f64| {
        let pieces = (first..last).map(|piece| at(piece as f64 * periods + phase));
        pieces.sum::<f64>() / (last.saturating_sub(first)).max(1) as f64
    };
    phases.iter().map(mean).collect()
}

fn candidates(
    branches: &StoredBranches,
    frequency_hz: f64,
    period_multiple: u32,
) -> Result<Vec<(u32, usize, PeriodicSolution)>, RigError> {
    let mut orbits = Vec::new();
    for branch in branches.branches().iter().filter(|b| b.record.period_multiple == period_multiple) {
        for (index, placed) in thinned(branch, SPACING * frequency_hz) {
            let near = (placed.row.frequency_hz - frequency_hz).abs() <= NEAR * frequency_hz;
            if near && placed.row.stable {
                orbits.push((branch.record.id, index + 1, branches.solution(branch, placed)?));
            }
        }
    }
    Ok(orbits)
}

fn computed(
    rig: &Rig,
    model: &Model,
    orbit: &PeriodicSolution,
    (branch, row): (u32, usize),
    measured: &[f64],
) -> Result<Computed, RigError> {
    let course: Course = course(model, orbit, SAMPLES)?;
    let filter = (rig.low_pass_order as usize, rig.low_pass_hz);
    let filtered = periodic_low_pass(&course.acceleration, course.duration_s, filter)?;
    let shown = |series: &[f64]| -> Vec<f64> { series.iter().step_by(SAMPLES / SHOWN).copied().collect() };
    let narrow = shown(&filtered);
    let shifts = 0..orbit.period_multiple as usize;
    let turned = |series: &[f64], shift: usize| -> Vec<f64> {
        let mut series = series.to_vec();
        series.rotate_left(shift * SHOWN);
        series
    };
    let lagged = |shift: usize| {
        let whole = turned(&narrow, shift);
        (0..=2 * MOST_LAG).step_by(LAG_STEP).map(move |lag| {
            let mut series = whole.clone();
            series.rotate_left(MOST_LAG);
            series.rotate_right(lag);
            (series, shift, lag as f64 - MOST_LAG as f64)
        })
    };
    let (correlation, shift, lag) = shifts
        .flat_map(lagged)
        .map(|(series, shift, lag)| (correlation(measured, &series), shift, lag))
        .fold((f64::NEG_INFINITY, 0, 0.0), |best, one| if one.0 > best.0 { one } else { best });
    Ok(Computed {
        frequency_hz: orbit.frequency_hz,
        branch,
        row,
        correlation,
        lag: lag / SHOWN as f64,
        acceleration: turned(&shown(&course.acceleration), shift),
        displacement: turned(&shown(&course.displacement), shift),
        support: turned(&shown(&course.support), shift),
        largest: orbit.maxima.acceleration,
        largest_filtered: largest(&filtered),
        filtered: turned(&narrow, shift),
    })
}

/// Correlation about the means.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    let (p, q) = (mean(a), mean(b));
    let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
    for (a, b) in a.iter().zip(b) {
        ab += (a - p) * (b - q);
        aa += (a - p).powi(2);
        bb += (b - q).powi(2);
    }
    if aa > 0.0 && bb > 0.0 { ab / (aa * bb).sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_is_folded_onto_the_phases_at_which_it_was_taken() {
        // 2 Hz, whose waveform repeats after two periods, from 1.3 s on at 1 kHz.
        let value = |t: f64| (TAU * 2.0 * t).cos() + 0.5 * (TAU * t + 0.3).sin();
        let samples: Vec<f64> = (0..9_000).map(|k| value(1.3 + f64::from(k) * 1e-3)).collect();
        let phases: Vec<f64> = (0..2 * SHOWN).map(|k| k as f64 / SHOWN as f64).collect();
        let found = folded(&samples, (1000.0, 1.3), 2.0, &phases);
        for (phase, found) in phases.iter().zip(&found) {
            // The interpolation's own error is 2e-5.
            assert!((found - value(phase / 2.0)).abs() < 1e-4, "{phase}: {found}");
        }
    }

    use std::f64::consts::TAU;

    #[test]
    fn correlation_is_one_for_what_differs_by_factor_and_offset() {
        let a: Vec<f64> = (0..64).map(|k| (0.3 * f64::from(k)).sin()).collect();
        let b: Vec<f64> = a.iter().map(|x| 7.0 * x - 3.0).collect();
        assert!((correlation(&a, &b) - 1.0).abs() < 1e-12);
        let c: Vec<f64> = a.iter().map(|x| -x).collect();
        assert!((correlation(&a, &c) + 1.0).abs() < 1e-12 && correlation(&a, &[1.0; 64]) == 0.0);
    }
}
