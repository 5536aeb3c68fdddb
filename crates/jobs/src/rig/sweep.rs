//! Stepped sweeps of a rig: a record at each frequency, and the point that it is reduced to.

use std::sync::atomic::{AtomicBool, Ordering};

use hammerbeam_attractor::{AttractorError, Simulation, distance, state_scales};
use hammerbeam_motion::exact::{ExactSettings, MotionError};
use hammerbeam_signal::{
    Channel, MeasuredQuantity, Record, SignalError,
    chain::{MeasuringChain, RecordCoverage},
    classify::{Classification, ClassifySettings, MotionClass, classify},
    filter::{Band, butterworth},
    points::{MeasuredKind, MeasuredMaxima, MeasuredPoint},
};
use hammerbeam_study::{Model, file::Rig};

use super::{MotionExponents, RigError, chaos::exponents};
use crate::{
    Observer, PooledOrder,
    comparison::history::{MotionHistory, follow, largest},
};

/// Rate at which a motion is gone over before the chain, over the sampling rate: at 10 kHz twelve
/// microseconds, where a contact lasts fifty or more.
pub(super) const FINER: f64 = 8.0;
/// Excitation periods that go before a record, in which the causal filter settles.
pub(super) const LEAD_IN: u32 = 4;
/// Distance of states, relative to their size, up to which a motion has come back.
const SAME: f64 = 1e-3;
/// States at and near rest from which a motion is started anew.
const TRIALS: u32 = 7;
/// Longest period that is looked for in the states.
const LONGEST: usize = 8;

/// Direction of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SweepDirection {
    /// Rising frequencies.
    Up,
    /// Falling frequencies.
    Down,
}

impl SweepDirection {
    /// The word for it.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Up => "up",
            Self::Down => "down",
        }
    }
}

/// What was measured at a frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct RigPoint {
    /// The sweep.
    pub direction: SweepDirection,
    /// As a measured point: filtered acceleration, displacement, amplitude of the table.
    pub point: MeasuredPoint,
    /// What the filtered acceleration was taken for.
    pub classification: Classification,
    /// Excitation periods after which the states come back, without noise; `None` if they do not within
    /// eight.
    pub period_of_states: Option<u32>,
    /// Largest Lyapunov exponents, if the record was taken for aperiodic.
    pub exponents: Option<MotionExponents>,
    /// Largest acceleration before the filter [m/s²].
    pub unfiltered: f64,
    /// Whether the motion was started anew at or near rest, since the contact was closed when the frequency
    /// was changed, or the motion from there could not be computed.
    pub begun_anew: bool,
    /// State at phase 0 at the end.
    pub state: Vec<f64>,
}

/// Sweeps up and down.
///
/// # Returns
/// The points of the sweep up, then those of the sweep down, each in its order.
/// # Errors
/// [`RigError`].
pub fn sweep(
    rig: &Rig,
    model: &Model,
    threads: usize,
    observer: &mut dyn Observer,
) -> Result<Vec<RigPoint>, RigError> {
    let directions = [SweepDirection::Up, SweepDirection::Down];
    let work =
        |(): &mut (), direction: &SweepDirection, stop: &AtomicBool| one_way(rig, model, *direction, stop);
    let swept = PooledOrder::new(threads, observer).each(&directions, &|| (), &work, |_, _| {});
    let mut points = Vec::new();
    for sweep in swept.ok_or(RigError::Interrupted)? {
        points.extend(sweep?);
    }
    Ok(points)
}

fn one_way(
    rig: &Rig,
    model: &Model,
    direction: SweepDirection,
    stop: &AtomicBool,
) -> Result<Vec<RigPoint>, RigError> {
    let [low, high] = rig.sweep_hz;
    let (from, to) = if direction == SweepDirection::Up { (low, high) } else { (high, low) };
    let mut state = vec![0.0; 2 * model.system.dof()];
    let mut points = Vec::new();
    for (index, frequency_hz) in
        hammerbeam_attractor::frequencies(from, to, rig.step_hz)?.into_iter().enumerate()
    {
        if stop.load(Ordering::Relaxed) {
            return Err(RigError::Interrupted);
        }
        let seed = 2 * (1_000_003 * u64::from(rig.seed) + index as u64)
            + u64::from(direction == SweepDirection::Down);
        let point = at_or_anew(rig, model, (direction, frequency_hz, seed), &state)?;
        state.clone_from(&point.state);
        points.push(point);
    }
    Ok(points)
}

/// Measures at a frequency; if the motion from a state cannot be computed (steps of a contact may become too
/// short to go on), that from rest, or near rest: it is as good a measurement.
fn at_or_anew(
    rig: &Rig,
    model: &Model,
    begin: (SweepDirection, f64, u64),
    state: &[f64],
) -> Result<RigPoint, RigError> {
    let mut found = at(rig, model, begin, state);
    let scales = state_scales(&model.system, begin.1);
    let first = scales.len() / 2;
    for trial in 0..TRIALS {
        match found {
            Err(error) if error.is_of_the_motion() => {
                let mut near_rest = vec![0.0; scales.len()];
                // The first mode moves off, one way and the other.
                let share = f64::from(trial) * if trial % 2 == 0 { 0.01 } else { -0.01 };
                near_rest[first] = share * scales[first];
                found = at(rig, model, begin, &near_rest).map(|p| RigPoint { begun_anew: true, ..p });
            }
            found => return found,
        }
    }
    found
}

/// A motion that has settled, from a state at phase 0.
pub(super) fn settled(
    rig: &Rig,
    model: &Model,
    frequency_hz: f64,
    state: &[f64],
) -> Result<(Simulation, bool), RigError> {
    let settle = |state: &[f64]| -> Result<Simulation, AttractorError> {
        let settings = ExactSettings::default();
        let mut simulation = Simulation::new(model.system.clone(), frequency_hz, state, settings)?;
        (0..rig.settling_periods).try_for_each(|_| simulation.skip_period())?;
        Ok(simulation)
    };
    match settle(state) {
        Err(AttractorError::Motion(MotionError::StartsInContact { .. })) => {
            Ok((settle(&vec![0.0; state.len()])?, true))
        }
        found => Ok((found?, false)),
    }
}

fn at(
    rig: &Rig,
    model: &Model,
    (direction, frequency_hz, seed): (SweepDirection, f64, u64),
    state: &[f64],
) -> Result<RigPoint, RigError> {
    let (mut simulation, begun_anew) = settled(rig, model, frequency_hz, state)?;
    let samples = (FINER * rig.sampling_hz / frequency_hz).ceil() as usize;
    let mut states = Vec::new();
    let mut history = MotionHistory::default();
    for _ in 0..LEAD_IN + rig.recorded_periods {
        states.push(simulation.state().to_vec());
        append(&mut history, follow(model, &mut simulation, frequency_hz, 1, samples)?);
    }
    let lead = LEAD_IN as usize * samples;
    let fine_hz = samples as f64 * frequency_hz;
    let acceleration = measured(rig, MeasuredQuantity::Acceleration, &history.acceleration, (fine_hz, seed))?;
    let displacement =
        measured(rig, MeasuredQuantity::Displacement, &history.displacement, (fine_hz, seed ^ 0x5555))?;
    let table: Vec<f64> = second_derivative(model, &history, samples, frequency_hz);
    let table = measured(rig, MeasuredQuantity::Acceleration, &table, (fine_hz, seed ^ 0xaaaa))?;
    let settings = ClassifySettings::default();
    let classification = classify(&acceleration, rig.sampling_hz, frequency_hz, &settings)?;
    let kind = match classification.motion {
        MotionClass::Periodic { period_multiple } => {
            MeasuredKind::Periodic { period_multiple: Some(period_multiple as u32) }
        }
        MotionClass::Aperiodic => MeasuredKind::Aperiodic,
        MotionClass::Doubtful { .. } => MeasuredKind::Doubtful,
    };
    let mut maxima = MeasuredMaxima::default();
    maxima.set(MeasuredQuantity::Acceleration, largest(&acceleration));
    maxima.set(MeasuredQuantity::Displacement, largest(&displacement));
    let amplitude = lock_in(&table, frequency_hz / rig.sampling_hz);
    let point = MeasuredPoint {
        origin: format!("{} {frequency_hz} Hz", direction.word()),
        frequency_hz,
        maxima,
        kind,
        excitation: Some((MeasuredQuantity::Acceleration, amplitude))
            .filter(|(_, amplitude)| *amplitude > 0.0),
    };
    let exponents = (kind == MeasuredKind::Aperiodic)
        .then(|| exponents(model, frequency_hz, (&acceleration, rig.sampling_hz), simulation.state()));
    Ok(RigPoint {
        direction,
        point,
        classification,
        exponents,
        period_of_states: period_of(&state_scales(&model.system, frequency_hz), &states),
        unfiltered: largest(&history.acceleration[lead..]),
        begun_anew,
        state: simulation.state().to_vec(),
    })
}

fn append(history: &mut MotionHistory, more: MotionHistory) {
    history.duration_s += more.duration_s;
    history.displacement.extend(more.displacement);
    history.velocity.extend(more.velocity);
    history.acceleration.extend(more.acceleration);
    history.supports.resize(more.supports.len(), Vec::new());
    history.supports.iter_mut().zip(more.supports).for_each(|(all, more)| all.extend(more));
}

/// Acceleration of the support, from the model: the table has a sensor of its own.
fn second_derivative(model: &Model, history: &MotionHistory, samples: usize, frequency_hz: f64) -> Vec<f64> {
    // All supports of a rig move as its one table.
    let motions = |phase: f64| model.system.support_motions(frequency_hz, phase);
    let at =
        |k: usize| motions((k % samples) as f64 / samples as f64).first().map_or(0.0, |motion| motion[2]);
    (0..history.acceleration.len()).map(at).collect()
}

/// What the chain makes of a quantity: filtered if it is an acceleration, sampled, with noise, without the
/// lead-in.
fn measured(
    rig: &Rig,
    quantity: MeasuredQuantity,
    samples: &[f64],
    source: (f64, u64),
) -> Result<Vec<f64>, SignalError> {
    Ok(record(rig, quantity, samples, source)?.0)
}

/// The same, with the time of its first sample [s], counted from the start of the lead-in.
pub(super) fn record(
    rig: &Rig,
    quantity: MeasuredQuantity,
    samples: &[f64],
    (fine_hz, seed): (f64, u64),
) -> Result<(Vec<f64>, f64), SignalError> {
    let band = Band::LowPass { cut_off_hz: rig.low_pass_hz };
    let is_filtered = quantity == MeasuredQuantity::Acceleration;
    let filter = butterworth(rig.low_pass_order as usize, band, fine_hz)?;
    let chain = MeasuringChain {
        sensor: quantity,
        filter: is_filtered.then_some((filter, false)),
        sampling_rate_hz: Some(rig.sampling_hz),
        noise: if is_filtered { rig.noise_m_s2 } else { rig.noise_m },
        seed,
        converter: None,
    };
    let channel = Channel { name: "sensor".to_owned(), unit: None, quantity, samples: samples.to_vec() };
    let whole =
        Record { sampling_rate_hz: fine_hz, start_s: 0.0, channels: vec![channel], findings: Vec::new() };
    let measured = chain.measure(&whole, RecordCoverage::Excerpt)?;
    let lead_in = f64::from(LEAD_IN) / f64::from(LEAD_IN + rig.recorded_periods);
    let part = measured.part(lead_in * whole.duration_s(), f64::INFINITY)?;
    let samples = part.channels.into_iter().next().map_or_else(Vec::new, |channel| channel.samples);
    Ok((samples, part.start_s))
}

/// Amplitude of the line at a frequency [periods per sample], by least squares over cosine and sine.
fn lock_in(samples: &[f64], frequency: f64) -> f64 {
    let mut sums = [0.0; 5];
    for (k, value) in samples.iter().enumerate() {
        let (sin, cos) = (std::f64::consts::TAU * frequency * k as f64).sin_cos();
        let terms = [cos * cos, cos * sin, sin * sin, cos * value, sin * value];
        sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
    }
    let [cc, cs, ss, cv, sv] = sums;
    let determinant = cc * ss - cs * cs;
    if determinant <= 0.0 {
        return 0.0;
    }
    ((ss * cv - cs * sv) / determinant).hypot((cc * sv - cs * cv) / determinant)
}

/// The smallest period after which all states of the second half of the record come back.
fn period_of(scales: &[f64], states: &[Vec<f64>]) -> Option<u32> {
    let late = &states[states.len() / 2..];
    let comes_back =
        |n: &usize| late.len() > *n && late.windows(n + 1).all(|w| distance(scales, &w[0], &w[*n]) <= SAME);
    (1..=LONGEST).find(comes_back).map(|n| n as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lock_in_reads_the_amplitude_of_a_line() {
        let value = |k: usize| 3.0 * (0.31 * k as f64 + 0.4).cos() + 0.5 * (1.9 * k as f64).sin();
        let samples: Vec<f64> = (0..20_000).map(value).collect();
        // What another line leaves falls like one over the number of samples.
        assert!((lock_in(&samples, 0.31 / std::f64::consts::TAU) - 3.0).abs() < 1e-3);
    }

    #[test]
    fn the_shortest_period_of_states_is_found() {
        let states = |n: usize| -> Vec<Vec<f64>> { (0..40).map(|k| vec![(k % n) as f64, 1.0]).collect() };
        for n in [1, 2, 3, 8] {
            assert_eq!(period_of(&[1.0, 1.0], &states(n)), Some(n as u32));
        }
        assert_eq!(period_of(&[1.0, 1.0], &states(11)), None);
    }
}
