//! A record folded onto periods of its excitation.

use std::f64::consts::PI;

use realfft::num_complex::Complex;

use crate::resample::Interpolation;

/// Minimum number of samples of a period after interpolation.
const MIN_SAMPLES: f64 = 16.0;
/// Number of parts of the record in which the phase is evaluated.
const PARTS: usize = 16;

/// A record with a whole number of samples per period.
pub(super) struct FoldedRecord {
    /// Samples of whole periods, about their mean.
    pub samples: Vec<f64>,
    /// Samples of a period.
    pub period: usize,
    /// Mean square.
    pub variance: f64,
}

/// Scatter of pieces about their mean waveform.
#[derive(Clone, Copy)]
pub(super) struct WaveformScatter {
    /// Sum of squares.
    pub squares: f64,
    pub degrees_of_freedom: usize,
}

impl WaveformScatter {
    pub(super) fn variance(self) -> f64 {
        self.squares / self.degrees_of_freedom as f64
    }
}

impl FoldedRecord {
    /// Interpolates to periods of a frequency, given in periods per sample.
    pub(super) fn new(series: &[f64], frequency: f64) -> Self {
        let period = (1.0 / frequency).round().max(MIN_SAMPLES) as usize;
        let step = 1.0 / (frequency * period as f64);
        let periods = ((series.len() - 1) as f64 * frequency + 1e-9).floor() as usize;
        let count = periods * period;
        let on_samples = (step - 1.0).abs() * (count as f64) < 1e-3;
        let mut samples: Vec<f64> = if on_samples {
            series[..count].to_vec()
        } else {
            let interpolation = Interpolation::new();
            (0..count).map(|k| interpolation.at(series, k as f64 * step)).collect()
        };
        let mean = samples.iter().sum::<f64>() / count as f64;
        samples.iter_mut().for_each(|value| *value -= mean);
        let variance = samples.iter().map(|value| value * value).sum::<f64>() / count as f64;
        Self { samples, period, variance }
    }

    pub(super) fn periods(&self) -> usize {
        self.samples.len() / self.period
    }

    /// Mean waveform over `n` periods, and the number of pieces.
    pub(super) fn waveform(&self, n: usize) -> (Vec<f64>, usize) {
        let length = n * self.period;
        let mut mean = vec![0.0; length];
        let pieces = self.samples.chunks_exact(length);
        let count = pieces.len();
        for piece in pieces {
            mean.iter_mut().zip(piece).for_each(|(mean, value)| *mean += value);
        }
        mean.iter_mut().for_each(|value| *value /= count as f64);
        (mean, count)
    }

    /// The scatter of the pieces about the waveform over `n` periods.
    pub(super) fn scatter(&self, n: usize) -> WaveformScatter {
        let (mean, count) = self.waveform(n);
        let sum = self
            .samples
            .chunks_exact(mean.len())
            .map(|piece| piece.iter().zip(&mean).map(|(value, mean)| (value - mean).powi(2)).sum::<f64>())
            .sum();
        WaveformScatter { squares: sum, degrees_of_freedom: (count - 1) * mean.len() }
    }

    /// The record without its waveform over `n` periods.
    pub(super) fn residual(&self, n: usize) -> Vec<f64> {
        let (mean, _) = self.waveform(n);
        self.samples
            .chunks_exact(mean.len())
            .flat_map(|piece| piece.iter().zip(&mean).map(|(value, mean)| value - mean))
            .collect()
    }

    /// Relative error of the frequency, if the phase of the fundamental changes linearly over the record.
    ///
    /// # Returns
    /// The correction factor of the frequency minus one; `None` if the phase does not determine it.
    pub(super) fn drift(&self) -> Option<f64> {
        let periods = self.periods();
        let parts = PARTS.min(periods / 2);
        if parts < 4 {
            return None;
        }
        let turns: Vec<Complex<f64>> = (0..self.period)
            .map(|k| Complex::from_polar(1.0, -2.0 * PI * k as f64 / self.period as f64))
            .collect();
        // Subharmonics of order two, three, four and six have whole periods in a part of twelve, so that they
        // do not shift the phase.
        let part = periods / parts;
        let part = [12, 6, 2, 1].into_iter().map(|n| part / n * n).find(|part| *part > 0).unwrap_or(1);
        let length = part * self.period;
        let phasor = |part: &[f64]| -> Complex<f64> {
            part.chunks_exact(self.period)
                .flat_map(|piece| piece.iter().zip(&turns).map(|(value, turn)| turn * *value))
                .sum()
        };
        let phasors: Vec<Complex<f64>> = self.samples.chunks_exact(length).map(phasor).collect();
        let level = phasors.iter().map(|z| z.norm()).sum::<f64>() / phasors.len() as f64;
        // The fundamental must be at least a tenth of the motion: half of its squared amplitude over the
        // variance.
        let power = 2.0 * (level / length as f64).powi(2) / self.variance;
        if power < 0.01 || phasors.iter().any(|z| z.norm() < 0.5 * level) {
            return None;
        }
        linear_drift(&phasors).map(|cycles| cycles / part as f64)
    }
}

/// Slope of the phases [cycles per part] if they lie on a straight line to 0.02 cycles.
fn linear_drift(phasors: &[Complex<f64>]) -> Option<f64> {
    let mut phases = vec![0.0];
    for pair in phasors.windows(2) {
        let turn = (pair[1] / pair[0]).arg() / (2.0 * PI);
        phases.push(phases[phases.len() - 1] + turn);
    }
    let n = phases.len() as f64;
    let (x, y) = ((n - 1.0) / 2.0, phases.iter().sum::<f64>() / n);
    let at = || phases.iter().enumerate().map(|(k, phase)| (k as f64 - x, phase - y));
    let slope = at().map(|(k, phase)| k * phase).sum::<f64>() / at().map(|(k, _)| k * k).sum::<f64>();
    at().all(|(k, phase)| (phase - slope * k).abs() < 0.02).then_some(slope)
}
