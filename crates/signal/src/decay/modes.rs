//! The modes of a free decay.

use std::f64::consts::PI;

use hammerbeam_fit::distribution::student_quantile;

use super::{
    fit::{DecayFit, fit},
    model::Oscillation,
    search::strongest,
};
use crate::{
    error::{SignalError, ensure, ensure_series},
    fourier,
};

/// Minimum number of samples of a decay.
const MIN_SAMPLES: usize = 32;

/// Settings of the search for modes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DecaySettings {
    /// Number of modes; `None` for all above the noise, up to `max_modes`.
    pub modes: Option<usize>,
    /// Largest number of modes that are searched for.
    pub max_modes: usize,
    /// Lower and upper limit of the frequencies [Hz].
    pub band_hz: (f64, f64),
}

impl Default for DecaySettings {
    fn default() -> Self {
        Self { modes: None, max_modes: 6, band_hz: (0.0, f64::INFINITY) }
    }
}

/// A value with its interval of 95 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DecayEstimate {
    /// The value.
    pub value: f64,
    /// Half of the interval.
    pub half_width: f64,
}

impl DecayEstimate {
    /// Whether a value lies in the interval.
    #[must_use]
    pub fn contains(&self, value: f64) -> bool {
        (self.value - value).abs() <= self.half_width
    }
}

/// One mode of a decay.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DecayMode {
    /// Eigenfrequency, without damping [Hz].
    pub frequency_hz: DecayEstimate,
    /// Damping ratio.
    pub damping_ratio: DecayEstimate,
    /// Logarithmic decrement.
    pub decrement: DecayEstimate,
    /// Amplitude at the first sample, in the unit of the series.
    pub amplitude: f64,
    /// Phase at the first sample, of a cosine [rad].
    pub phase: f64,
}

/// A free decay.
#[derive(Debug, Clone, PartialEq)]
pub struct Decay {
    /// Modes, the lowest frequency first.
    pub modes: Vec<DecayMode>,
    /// Value at which the decay ends.
    pub offset: f64,
    /// Root mean square of the residual.
    pub residual: f64,
    /// Correlation of neighbouring residuals; above 3 / sqrt(N) they are not white, which intervals take into
    /// account.
    pub residual_correlation: f64,
    /// Whether residuals count as white.
    pub white: bool,
    pub(super) oscillations: Vec<Oscillation>,
}

/// Finds modes of a free decay and fits them.
///
/// Modes are added one by one, each where it reduces the residual most, and all are fitted again.
///
/// # Errors
/// [`SignalError::NoDecay`] if nothing exceeds the noise; [`SignalError::FitNotConverged`] if a number
/// of modes is given and cannot be fitted; [`SignalError::TooShort`], [`SignalError::NotFinite`],
/// [`SignalError::Constant`], [`SignalError::Input`].
pub fn free_decay(
    series: &[f64],
    sampling_rate_hz: f64,
    settings: &DecaySettings,
) -> Result<Decay, SignalError> {
    ensure_series("a decay", series, MIN_SAMPLES)?;
    let (low, high) = settings.band_hz;
    ensure("the upper end of the band", high, format!("more than its lower end, {low} Hz"), high > low)?;
    if series.iter().all(|value| *value == series[0]) {
        return Err(SignalError::Constant);
    }
    let step = 1.0 / sampling_rate_hz;
    let band = (2.0 * PI * low, 2.0 * PI * high);
    let mut fitted: Option<DecayFit> = None;
    for _ in 0..settings.modes.unwrap_or(settings.max_modes) {
        let (residual, mut start) = match &fitted {
            Some(fit) => (fit.residual.clone(), fit.oscillations.clone()),
            None => {
                let mean = series.iter().sum::<f64>() / series.len() as f64;
                (series.iter().map(|value| value - mean).collect(), Vec::new())
            }
        };
        let Some(next) = strongest(&residual, step, band, settings.modes.is_none()) else { break };
        start.push(next);
        match fit(series, step, &start) {
            Ok(better) if settings.modes.is_some() || is_sound(&better, step, series.len()) => {
                fitted = Some(better);
            }
            Err(error) if settings.modes.is_some() => return Err(error),
            // The data do not support another mode.
            _ => break,
        }
    }
    let fit = fitted.ok_or(SignalError::NoDecay)?;
    Ok(describe(&fit, sampling_rate_hz))
}

/// Whether all oscillations are separate modes: none above half the sampling rate, none clearly growing, none
/// coinciding with another.
fn is_sound(fit: &DecayFit, step: f64, length: usize) -> bool {
    let duration = length as f64 * step;
    let inside = |o: &Oscillation| {
        o.frequency > 0.0 && o.frequency < PI / step && o.rate > -2.0 / duration && o.amplitude().is_finite()
    };
    let apart = |one: &Oscillation, other: &Oscillation| {
        (one.frequency - other.frequency).abs()
            > (PI / duration).min(0.2 * one.rate.abs().max(other.rate.abs()))
    };
    let all = &fit.oscillations;
    all.iter().enumerate().all(|(k, one)| inside(one) && all[..k].iter().all(|other| apart(one, other)))
}

/// Modes with their uncertainty, by ascending frequency.
fn describe(fit: &DecayFit, sampling_rate_hz: f64) -> Decay {
    let residual = &fit.residual;
    let count = residual.len();
    let free = (count - 1 - 4 * fit.oscillations.len()) as f64;
    let variance = residual.iter().map(|value| value * value).sum::<f64>() / free;
    let neighbours: f64 = residual.windows(2).map(|pair| pair[0] * pair[1]).sum();
    let residual_correlation = if variance > 0.0 { neighbours / (free * variance) } else { 0.0 };
    let white = residual_correlation.abs() < 3.0 / (count as f64).sqrt();
    let mut order: Vec<usize> = (0..fit.oscillations.len()).collect();
    order.sort_by(|&a, &b| fit.oscillations[a].frequency.total_cmp(&fit.oscillations[b].frequency));
    let mode = |&m: &usize| {
        let (local, degrees_of_freedom) =
            if white { (variance, free) } else { local_variance(fit, m, 1.0 / sampling_rate_hz) };
        describe_mode(fit, m, local, student_quantile(0.95, degrees_of_freedom))
    };
    Decay {
        modes: order.iter().map(mode).collect(),
        offset: fit.offset,
        residual: variance.sqrt(),
        residual_correlation,
        white,
        oscillations: order.iter().map(|&m| fit.oscillations[m]).collect(),
    }
}

/// Values of the spectrum on each side of the frequency of a mode over which the density is averaged.
const NEIGHBOURS: usize = 30;

/// Variance of white noise with the density of the residual about the frequency of a mode, and its degrees of
/// freedom.
///
/// The average is over [`NEIGHBOURS`] values on each side, or over all within the width of the line if these
/// are more. The four parameters of the fit use up two values.
fn local_variance(fit: &DecayFit, m: usize, step: f64) -> (f64, f64) {
    let length = fit.residual.len();
    let spectrum = fourier::forward(fit.residual.clone());
    let resolution = 2.0 * PI / (length as f64 * step);
    let centre = (fit.oscillations[m].frequency / resolution).round() as usize;
    let reach = NEIGHBOURS.max((fit.oscillations[m].rate.abs() / resolution) as usize);
    let low = centre.saturating_sub(reach).max(1);
    let high = (centre + reach).min(spectrum.len() - 1);
    let sum: f64 = spectrum[low.min(high)..=high].iter().map(|x| x.norm_sqr()).sum();
    let free = (high - low.min(high) + 1).saturating_sub(2).max(1) as f64;
    (sum / (free * length as f64), 2.0 * free)
}

/// A mode; the uncertainty of its properties follows from that of `s` and `w` by the derivatives.
fn describe_mode(fit: &DecayFit, m: usize, variance: f64, quantile: f64) -> DecayMode {
    let o = &fit.oscillations[m];
    let (s, w) = (o.rate, o.frequency);
    let covariance = |i: usize, j: usize| variance * fit.inverse[(1 + 4 * m + i, 1 + 4 * m + j)];
    let estimate = |value: f64, by_s: f64, by_w: f64| {
        let square = by_s * by_s * covariance(0, 0)
            + 2.0 * by_s * by_w * covariance(0, 1)
            + by_w * by_w * covariance(1, 1);
        DecayEstimate { value, half_width: quantile * square.max(0.0).sqrt() }
    };
    let natural = s.hypot(w);
    let cube = natural.powi(3);
    DecayMode {
        frequency_hz: estimate(natural / (2.0 * PI), s / natural / (2.0 * PI), w / natural / (2.0 * PI)),
        damping_ratio: estimate(s / natural, w * w / cube, -s * w / cube),
        decrement: estimate(2.0 * PI * s / w, 2.0 * PI / w, -2.0 * PI * s / (w * w)),
        amplitude: o.amplitude(),
        phase: (-o.sine).atan2(o.cosine),
    }
}
