//! The criterion for periodic motions.

use super::fold::{FoldedRecord, WaveformScatter};
use crate::{
    error::{SignalError, ensure, ensure_series},
    spectrum::{WelchSettings, welch},
};

/// Minimum number of pieces over which a waveform is averaged.
const MIN_PIECES: usize = 5;
/// Number of bands of which the lowest determines the white noise.
const BANDS: usize = 16;
/// Fraction of half the sampling rate that is evaluated: interpolation attenuates higher frequencies.
const BAND_END: f64 = 0.8;
/// Least power of the lines of a subharmonic over the power of the scatter in as many lines.
const SIGNIFICANT: f64 = 4.0;
/// Change of the mean square from one half of the record to the other above which it is not settled: a fifth
/// of the amplitude.
const UNSETTLED: f64 = 1.44;

/// Limits of the criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClassifySettings {
    /// Largest multiple of the excitation period that is tried.
    pub max_period_multiple: usize,
    /// Deviation up to which a motion is periodic.
    pub periodic_below: f64,
    /// Deviation from which a motion is aperiodic.
    pub aperiodic_above: f64,
    /// Amplitude fraction from which a subharmonic counts.
    pub weakest_subharmonic: f64,
}

impl Default for ClassifySettings {
    fn default() -> Self {
        Self { max_period_multiple: 8, periodic_below: 0.05, aperiodic_above: 0.2, weakest_subharmonic: 0.02 }
    }
}

/// Class of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MotionClass {
    /// It repeats after a number of excitation periods.
    Periodic {
        /// Orbit period over excitation period.
        period_multiple: usize,
    },
    /// It does not repeat after any of the multiples that were tried.
    Aperiodic,
    /// The record does not decide it.
    Doubtful {
        /// The reason.
        reason: ClassificationDoubt,
    },
}

/// Why a record does not decide whether a motion repeats.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum ClassificationDoubt {
    /// The deviation is too large for periodic and too small for aperiodic.
    #[error(
        "the smallest deviation, {deviation:.3} at period multiple {period_multiple}, is between the limits"
    )]
    BetweenLimits { deviation: f64, period_multiple: usize },
    /// There is a subharmonic, but a weak one.
    #[error(
        "a subharmonic of period multiple {period_multiple} holds {part:.4} of the amplitude, too much \
         for none and too little to count"
    )]
    WeakSubharmonic { period_multiple: usize, part: f64 },
    /// The amplitude of the motion changes.
    #[error(
        "the motion is not settled: its root mean square changes by the factor {factor:.2} from one half \
         of the record to the other"
    )]
    NotSettled { factor: f64 },
    /// Noise hides the motion.
    #[error("white noise may be {part:.2} of the root mean square: it hides whether the motion repeats")]
    Noise { part: f64 },
}

/// How well a record repeats after a number of periods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repetition {
    /// Number of excitation periods.
    pub period_multiple: usize,
    /// Deviation `d_n`, without white noise.
    pub deviation: f64,
    /// Root of the scatter over the total variance, noise included.
    pub scatter: f64,
}

/// The class of a motion, and how well the motion repeats.
#[derive(Debug, Clone, PartialEq)]
pub struct Classification {
    /// The class.
    pub motion: MotionClass,
    /// For each multiple that was tried.
    pub repetitions: Vec<Repetition>,
    /// Excitation frequency, corrected [Hz].
    pub frequency_hz: f64,
    /// Correction of the given frequency [Hz].
    pub correction_hz: f64,
    /// Excitation periods in the record.
    pub periods: usize,
    /// Root mean square about the mean.
    pub root_mean_square: f64,
    /// Upper limit of the root mean square of white noise in it.
    pub noise: f64,
}

/// Classifies a motion.
///
/// * `excitation_hz`: excitation frequency [Hz].
///
/// # Errors
/// [`SignalError::Input`] for a frequency above an eighth of the sampling rate; [`SignalError::TooShort`] for
/// fewer than five periods; [`SignalError::Constant`], [`SignalError::NotFinite`].
pub fn classify(
    series: &[f64],
    sampling_rate_hz: f64,
    excitation_hz: f64,
    settings: &ClassifySettings,
) -> Result<Classification, SignalError> {
    let allowed =
        format!("more than 0 and at most an eighth of the sampling rate, {} Hz", sampling_rate_hz / 8.0);
    let holds = excitation_hz > 0.0 && excitation_hz <= sampling_rate_hz / 8.0;
    ensure("the excitation frequency", excitation_hz, allowed, holds)?;
    ensure(
        "the largest period multiple",
        settings.max_period_multiple as f64,
        "at least 1",
        settings.max_period_multiple >= 1,
    )?;
    let given = excitation_hz / sampling_rate_hz;
    let needed = ((MIN_PIECES as f64 / given).ceil() as usize).saturating_add(1);
    ensure_series("deciding whether a motion repeats", series, needed)?;
    if series.iter().all(|value| *value == series[0]) {
        return Err(SignalError::Constant);
    }
    let (folded, frequency) = fold_at(series, given);
    let most = settings.max_period_multiple.min(folded.periods() / MIN_PIECES).max(1);
    let scatters: Vec<WaveformScatter> = (1..=most).map(|n| folded.scatter(n)).collect();
    let variance = |n: usize| scatters[n - 1].variance();
    let best = (1..=most).min_by(|&a, &b| variance(a).total_cmp(&variance(b))).unwrap_or(1);
    let noise = white_noise(&folded.residual(best), folded.period)?.min(variance(best));
    let repetition = |n: usize| Repetition {
        period_multiple: n,
        deviation: ((variance(n) - noise).max(0.0) / (folded.variance - noise).max(f64::MIN_POSITIVE)).sqrt(),
        scatter: (variance(n) / folded.variance).sqrt(),
    };
    let repetitions: Vec<Repetition> = (1..=most).map(repetition).collect();
    let part = (noise / folded.variance).sqrt();
    let motion = class(&folded, &repetitions, part, settings);
    Ok(Classification {
        motion,
        repetitions,
        frequency_hz: frequency * sampling_rate_hz,
        correction_hz: (frequency - given) * sampling_rate_hz,
        periods: folded.periods(),
        root_mean_square: folded.variance.sqrt(),
        noise: noise.sqrt(),
    })
}

/// Folds with the given frequency, and again as long as the phase shows an error of it.
fn fold_at(series: &[f64], given: f64) -> (FoldedRecord, f64) {
    let mut frequency = given;
    let mut folded = FoldedRecord::new(series, frequency);
    for _ in 0..3 {
        let Some(change) = folded.drift() else { break };
        // Less than 1e-3 cycles over the record is negligible.
        if (change * folded.periods() as f64).abs() < 1e-3 {
            break;
        }
        frequency *= 1.0 + change;
        folded = FoldedRecord::new(series, frequency);
    }
    (folded, frequency)
}

/// Upper limit of the variance of white noise in a series: the smallest density in any band, over all
/// frequencies.
///
/// An average over `a` segments of `w` neighbouring values has the relative standard error `sqrt(1.5 / (a
/// w))` (the window correlates neighbours). Three of them are added, since the smallest of many averages is
/// biased low.
fn white_noise(series: &[f64], period: usize) -> Result<f64, SignalError> {
    let segment = (8 * period).max(256).min(series.len());
    let density = welch(series, 1.0, &WelchSettings::with_segment(segment))?;
    let end = (BAND_END * density.values.len() as f64) as usize;
    let width = (end / BANDS).max(1);
    let mean = |band: &[f64]| band.iter().sum::<f64>() / band.len() as f64;
    let smallest = density.values[..end].chunks_exact(width).map(mean).fold(f64::INFINITY, f64::min);
    let segments = (2 * series.len() / segment).saturating_sub(1).max(1);
    let error = (1.5 / (segments * width) as f64).sqrt();
    Ok(0.5 * smallest * (1.0 + 3.0 * error))
}

/// The class of a motion by the criterion.
///
/// * `noise`: upper limit of white noise over the root mean square.
fn class(
    folded: &FoldedRecord,
    repetitions: &[Repetition],
    noise: f64,
    settings: &ClassifySettings,
) -> MotionClass {
    let doubt = |reason| MotionClass::Doubtful { reason };
    let (first, second) = folded.samples.split_at(folded.periods() / 2 * folded.period);
    let square = |part: &[f64]| part.iter().map(|value| value * value).sum::<f64>() / part.len() as f64;
    let change = square(second) / square(first);
    if !(1.0 / UNSETTLED..=UNSETTLED).contains(&change) {
        return doubt(ClassificationDoubt::NotSettled { factor: change.sqrt() });
    }
    if noise > 0.5 {
        return doubt(ClassificationDoubt::Noise { part: noise });
    }
    let periodic = repetitions.iter().find(|repetition| repetition.deviation <= settings.periodic_below);
    let Some(periodic) = periodic else {
        let smallest = repetitions.iter().min_by(|a, b| a.deviation.total_cmp(&b.deviation));
        return match smallest {
            Some(at) if at.deviation < settings.aperiodic_above => {
                doubt(ClassificationDoubt::BetweenLimits {
                    deviation: at.deviation,
                    period_multiple: at.period_multiple,
                })
            }
            _ => MotionClass::Aperiodic,
        };
    };
    let n = periodic.period_multiple;
    let mut weak = None;
    for m in (2 * n..=repetitions.len()).step_by(n) {
        let part = subharmonic(folded, n, m);
        if part >= settings.weakest_subharmonic {
            return MotionClass::Periodic { period_multiple: m };
        }
        if part >= 0.25 * settings.weakest_subharmonic && weak.is_none() {
            weak = Some(ClassificationDoubt::WeakSubharmonic { period_multiple: m, part });
        }
    }
    weak.map_or(MotionClass::Periodic { period_multiple: n }, doubt)
}

/// Amplitude fraction of the part that repeats after `m` but not after `n` periods; 0 if the scatter explains
/// it.
fn subharmonic(folded: &FoldedRecord, n: usize, m: usize) -> f64 {
    let (mean, count) = folded.waveform(m);
    let short = n * folded.period;
    let mut shorter = vec![0.0; short];
    for piece in mean.chunks_exact(short) {
        shorter
            .iter_mut()
            .zip(piece)
            .for_each(|(sum, value)| *sum += value * short as f64 / mean.len() as f64);
    }
    let between: f64 = mean.iter().enumerate().map(|(k, value)| (value - shorter[k % short]).powi(2)).sum();
    // Contribution of noise to the mean of `count` pieces, without the entries of the shorter waveform.
    let by_chance = folded.scatter(m).variance() * (mean.len() - short) as f64 / count as f64;
    if between < SIGNIFICANT * by_chance {
        return 0.0;
    }
    ((between - by_chance) / mean.len() as f64 / folded.variance).sqrt()
}
