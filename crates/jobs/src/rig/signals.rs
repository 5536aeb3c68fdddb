//! Measured and computed signals laid over one another: figures 7 to 14 of the paper.
//!
//! The rig is measured at a frequency, and its filtered acceleration folded onto as many excitation periods
//! as the figure has. It is laid over the stable orbits of that period whose frequency is near
//! (`comparison/overlay/`), with delays of whole excitation periods and a lag of at most a tenth of one.

use hammerbeam_signal::{
    MeasuredQuantity,
    classify::{Classification, ClassifySettings, classify},
    waveform::{Shifts, Waveform, folded},
};
use hammerbeam_study::{Model, file::Rig};

use super::{
    RigError, RigPoint,
    sweep::{FINER, LEAD_IN, record, settled},
};
use crate::{
    Observer, StoredBranches,
    comparison::{
        Filter, Overlay, OverlaySettings, Sought,
        history::{follow, largest},
        overlay,
    },
};

/// Samples of a waveform in an excitation period.
const SHOWN: usize = 512;
/// How far off orbits may be that are tried, as a part of the frequency.
const NEAR: f64 = 0.08;
/// Largest lag, in excitation periods.
const MOST_LAG: f64 = 0.1;

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
    pub computed: Option<Overlay>,
    /// Measured acceleration, the mean over the record [m/s²].
    pub measured: Waveform,
    /// Largest value in the whole record [m/s²].
    pub largest_measured: f64,
}

impl SignalPair {
    /// By how much the measured signal is behind the computed one [cycles], besides whole excitation periods.
    #[must_use]
    pub fn lag(computed: &Overlay) -> f64 {
        let cycles = computed.alignment.shift / SHOWN as f64;
        cycles - cycles.round()
    }
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
    (threads, observer): (usize, &mut dyn Observer),
) -> Result<SignalPair, RigError> {
    let (acceleration, start_s) = measure(rig, rig_model, points, (measured_hz, period_multiple))?;
    let classification = classify(&acceleration, rig.sampling_hz, measured_hz, &ClassifySettings::default())?;
    let periods = (period_multiple as usize, SHOWN);
    let measured = folded(&acceleration, (rig.sampling_hz, -start_s), measured_hz, periods)?;
    let filter = Filter { order: rig.low_pass_order as usize, cut_off_hz: rig.low_pass_hz };
    let settings = OverlaySettings {
        quantity: MeasuredQuantity::Acceleration,
        filter: Some((filter, false)),
        sought: Sought::Near { frequency_hz: factor * measured_hz, part: NEAR },
        branch: None,
        // The phase of the table is known; two structures of different damping do not answer with the same
        // one.
        shifts: Shifts::NearWhole { period: SHOWN, most: MOST_LAG * SHOWN as f64 },
        factor: None,
    };
    let computed = overlay((model, branches), (&measured, period_multiple), &settings, (threads, observer))?;
    let largest_measured = largest(&acceleration);
    Ok(SignalPair { measured_hz, period_multiple, classification, computed, measured, largest_measured })
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
    let history = follow(model, &mut simulation, frequency_hz, LEAD_IN + rig.recorded_periods, samples)?;
    let seed = u64::from(rig.seed) ^ frequency_hz.to_bits();
    let source = (samples as f64 * frequency_hz, seed);
    Ok(record(rig, MeasuredQuantity::Acceleration, &history.acceleration, source)?)
}
