//! A measuring chain for computed signals: what an instrument would show.
//!
//! A computed motion becomes comparable with a measured one when it passes the same chain:
//!
//! 1. **Sensor**: displacement, velocity or acceleration of a point. If the record holds only another of the
//!    three, it is differentiated or integrated by the spectrum, `X_k (i w_k)^n`. This requires whole periods
//!    ([`RecordCoverage::WholePeriods`]); integration sets the mean to zero. Any other record has to hold the
//!    quantity itself.
//! 2. **Filter**: Butterworth, causal as in an instrument, or zero-phase as in post-processing. For whole
//!    periods the result is the settled response: the record is repeated until the filter has settled.
//! 3. **Sampling**: the filtered signal is interpolated at the new rate. There is no further filter: signals
//!    above half the new rate that pass the filter are aliased, as in a converter.
//! 4. **Noise**: normal, white, with a standard deviation and a seed.
//! 5. **Converter**: range and bits. Values beyond the range are clipped.
//!
//! Aliasing and clipping are reported in the findings of the record, clipping separately for each end of the
//! range.

use std::f64::consts::PI;

use realfft::num_complex::Complex;

use crate::{
    error::{SignalError, ensure, ensure_sample_count, ensure_series},
    filter::DigitalFilter,
    finding::RecordFinding,
    fourier::{backward, forward},
    random::RandomSource,
    record::{Channel, Record},
    resample::Interpolation,
    spectrum::Window,
    unit::MeasuredQuantity,
};

/// Whether a record is an excerpt of a motion or repeats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RecordCoverage {
    /// An excerpt of a motion.
    Excerpt,
    /// Whole periods: the first sample follows the last one.
    WholePeriods,
}

/// Range and resolution of a converter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Converter {
    /// Largest absolute value, in the SI unit of the sensor.
    pub range: f64,
    /// Bits; the step is `2 range / 2^bits`.
    pub bits: u32,
}

/// A measuring chain.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuringChain {
    /// Quantity that the sensor measures.
    pub sensor: MeasuredQuantity,
    /// The filter, designed for the sampling rate of the record, and whether it is applied with zero phase.
    pub filter: Option<(DigitalFilter, bool)>,
    /// Sampling rate of the result [Hz]; `None` for the rate of the record.
    pub sampling_rate_hz: Option<f64>,
    /// Standard deviation of the noise, in the SI unit of the sensor.
    pub noise: f64,
    /// Seed of the noise.
    pub seed: u64,
    /// The converter.
    pub converter: Option<Converter>,
}

impl MeasuringChain {
    /// The record that the chain gives of another one.
    ///
    /// # Returns
    /// A record with one channel.
    /// # Errors
    /// [`SignalError::NoSuchQuantity`] if the record holds neither the quantity nor, over whole periods, one
    /// from which it follows; [`SignalError::Input`], [`SignalError::TooShort`], [`SignalError::NotFinite`].
    pub fn measure(&self, record: &Record, coverage: RecordCoverage) -> Result<Record, SignalError> {
        ensure(
            "the noise",
            self.noise,
            "a finite number, at least 0",
            self.noise >= 0.0 && self.noise.is_finite(),
        )?;
        if let Some(Converter { range, bits }) = self.converter {
            ensure("the range of the converter", range, "more than 0", range > 0.0)?;
            ensure("the bits of the converter", f64::from(bits), "from 2 to 32", (2..=32).contains(&bits))?;
        }
        let (source, mut samples) = self.sense(record, coverage)?;
        ensure_series("a measuring chain", &samples, 2)?;
        if let Some((filter, zero_phase)) = &self.filter {
            samples = filtered(&samples, filter, *zero_phase, coverage)?;
        }
        let rate = self.sampling_rate_hz.unwrap_or(record.sampling_rate_hz);
        let mut findings = Vec::new();
        if rate < record.sampling_rate_hz {
            findings.extend(aliasing(&samples, record.sampling_rate_hz, rate / 2.0));
        }
        if rate != record.sampling_rate_hz {
            samples = resampled(&samples, record.sampling_rate_hz / rate, coverage)?;
        }
        let mut random = RandomSource::new(self.seed);
        if self.noise > 0.0 {
            samples.iter_mut().for_each(|value| *value += self.noise * random.normal());
        }
        if let Some(converter) = self.converter {
            findings.extend(converter.clipped(&source, &samples));
            samples.iter_mut().for_each(|value| *value = converter.convert(*value));
        }
        let channel = Channel { name: source, unit: None, quantity: self.sensor, samples };
        Ok(Record { sampling_rate_hz: rate, start_s: record.start_s, channels: vec![channel], findings })
    }

    /// Name of the channel that is measured, and the signal of the sensor.
    fn sense(&self, record: &Record, coverage: RecordCoverage) -> Result<(String, Vec<f64>), SignalError> {
        if let Some(channel) = record.channels.iter().find(|channel| channel.quantity == self.sensor) {
            return Ok((channel.name.clone(), channel.samples.clone()));
        }
        let order = |quantity| match quantity {
            MeasuredQuantity::Displacement => Some(0),
            MeasuredQuantity::Velocity => Some(1),
            MeasuredQuantity::Acceleration => Some(2),
            _ => None,
        };
        let other = record.channels.iter().find_map(|channel| Some((channel, order(channel.quantity)?)));
        match (order(self.sensor), other, coverage) {
            (Some(wanted), Some((channel, found)), RecordCoverage::WholePeriods) => {
                let rate = record.sampling_rate_hz;
                Ok((channel.name.clone(), differentiated(&channel.samples, rate, wanted - found)))
            }
            _ => Err(SignalError::NoSuchQuantity {
                wanted: self.sensor.word(),
                found: record.channels.iter().map(|c| c.quantity.word()).collect::<Vec<_>>().join(", "),
            }),
        }
    }
}

/// Fraction of the root mean square above half the sampling rate from which aliasing is reported.
const REPORTED_ALIASING: f64 = 0.01;

/// A finding if a series has too much power above half of a sampling rate.
fn aliasing(samples: &[f64], sampling_rate_hz: f64, half_rate_hz: f64) -> Option<RecordFinding> {
    let length = samples.len();
    let mean = samples.iter().sum::<f64>() / length as f64;
    let weights = Window::Hann.values(length);
    let windowed = samples.iter().zip(&weights).map(|(value, weight)| (value - mean) * weight).collect();
    let power: Vec<f64> = forward(windowed).iter().map(|value| value.norm_sqr()).collect();
    let first = (half_rate_hz * length as f64 / sampling_rate_hz).ceil() as usize;
    let above: f64 = power.iter().skip(first).sum();
    let part = (above / power.iter().sum::<f64>()).sqrt();
    (part > REPORTED_ALIASING).then_some(RecordFinding::Folded { half_rate_hz, percent: 100.0 * part })
}

impl Converter {
    /// Size of a step.
    fn step(self) -> f64 {
        2.0 * self.range / 2.0_f64.powi(self.bits as i32)
    }

    /// Findings for values beyond either end of the range by more than half a step.
    fn clipped(self, channel: &str, samples: &[f64]) -> impl Iterator<Item = RecordFinding> {
        // One step less above zero than below, as with two's complement.
        let ends = [(1.0, self.range - self.step()), (-1.0, -self.range)];
        ends.into_iter().filter_map(move |(side, level)| {
            let beyond = |value: f64| side * (value - level) > 0.5 * self.step();
            let first = samples.iter().position(|value| beyond(*value))?;
            let starts = |pair: &&[f64]| !beyond(pair[0]) && beyond(pair[1]);
            Some(RecordFinding::Clipped {
                channel: channel.to_owned(),
                samples: samples.iter().filter(|value| beyond(**value)).count(),
                places: samples.windows(2).filter(starts).count() + usize::from(first == 0),
                level,
                first,
            })
        })
    }

    fn convert(self, value: f64) -> f64 {
        let step = self.step();
        ((value / step).round() * step).clamp(-self.range, self.range - step)
    }
}

/// Derivative of an order, or integral for a negative one, of a periodic series.
///
/// The value at half the sampling rate has no derivative of odd order and is then set to zero.
#[must_use]
pub fn differentiated(series: &[f64], sampling_rate_hz: f64, order: i32) -> Vec<f64> {
    let length = series.len();
    let mut spectrum = forward(series.to_vec());
    for (k, value) in spectrum.iter_mut().enumerate() {
        let w = 2.0 * PI * k as f64 * sampling_rate_hz / length as f64;
        let is_single = 2 * k == length && order % 2 != 0;
        let no_mean = k == 0 && order != 0;
        *value *=
            if is_single || no_mean { Complex::new(0.0, 0.0) } else { Complex::new(0.0, w).powi(order) };
    }
    backward(spectrum, length)
}

/// Minimum number of samples by which whole periods are repeated before and after a record: the transient of
/// a filter with poles of modulus `r` decays like `r^n`.
const SETTLING: usize = 20_000;

fn filtered(
    samples: &[f64],
    filter: &DigitalFilter,
    zero_phase: bool,
    coverage: RecordCoverage,
) -> Result<Vec<f64>, SignalError> {
    let run =
        |samples: &[f64]| if zero_phase { filter.zero_phase(samples) } else { Ok(filter.causal(samples)) };
    if coverage == RecordCoverage::Excerpt {
        return run(samples);
    }
    let copies = SETTLING.div_ceil(samples.len());
    let long = samples.repeat(2 * copies + 1);
    Ok(run(&long)?[copies * samples.len()..(copies + 1) * samples.len()].to_vec())
}

/// Values at multiples of `step` samples.
fn resampled(samples: &[f64], step: f64, coverage: RecordCoverage) -> Result<Vec<f64>, SignalError> {
    ensure(
        "the sampling rate of the chain",
        1.0 / step,
        "more than 0 times that of the record",
        step.is_finite() && step > 0.0,
    )?;
    let interpolation = Interpolation::new();
    let length = samples.len() as f64;
    ensure_sample_count(length / step)?;
    // The tolerance allows for rounding: a rate that divides the record evenly gives all its samples.
    if coverage == RecordCoverage::WholePeriods {
        let count = (length / step - 1e-6).ceil() as usize;
        let margin = 64_usize.div_ceil(samples.len());
        let long = samples.repeat(2 * margin + 1);
        let shift = (margin * samples.len()) as f64;
        return Ok((0..count).map(|k| interpolation.at(&long, shift + k as f64 * step)).collect());
    }
    let count = ((length - 1.0) / step + 1e-6).floor() as usize + 1;
    Ok((0..count).map(|k| interpolation.at(samples, (k as f64 * step).min(length - 1.0))).collect())
}

#[cfg(test)]
mod tests;
