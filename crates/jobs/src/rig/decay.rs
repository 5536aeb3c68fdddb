//! A free decay of the rig's structure without its stops, as an accelerometer at the response point records
//! it.
//!
//! The response point is pulled aside by a force and let go: `q_i(0) = phi_i F/w_i^2`, `q_i'(0) = 0`, and
//! with `d = z w`, `p = w sqrt(1 - z^2)` `q = q(0) exp(-d t)(cos p t + (d/p) sin p t)`, so `q'' = -w^2 q - 2
//! d q'`, `q' = -q(0) exp(-d t) (w^2/p) sin p t`. Every mode begins with the same acceleration per `phi_i^2`:
//! high ones show.

use std::f64::consts::TAU;

use hammerbeam_signal::{
    Channel, MeasuredQuantity, Record, SignalError,
    chain::{MeasuringChain, RecordCoverage},
    decay::{DecaySettings, free_decay},
    filter::{Band, butterworth},
};
use hammerbeam_study::{Model, file::Rig};

use super::RigError;

/// Displacement of the response point from which it is let go [m].
const PULLED: f64 = 5e-3;
/// Length of the record in periods of the lowest mode, and what goes before it, in which the filter settles,
/// in periods of its cut-off.
const PERIODS: f64 = 70.0;
const LEAD_IN: f64 = 15.0;
/// Rate of the motion before the chain, as a multiple of the sampling rate.
const FINER: usize = 4;

/// Highest frequency that is looked at, as a part of the filter's cut-off.
const LOOKED_AT: f64 = 0.6;

/// A measured eigenfrequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredMode {
    /// Eigenfrequency and half of its interval of 95 % [Hz].
    pub frequency_hz: (f64, f64),
    /// Damping ratio and half of its interval.
    pub damping_ratio: (f64, f64),
}

/// Highest frequency at which a decay is looked at for modes [Hz].
pub(super) fn highest_hz(rig: &Rig) -> f64 {
    LOOKED_AT * rig.low_pass_hz
}

/// Eigenfrequencies and damping as a decay shows them, below 0.6 of the filter's cut-off.
///
/// # Returns
/// Nothing where dampers couple the modes, the structure has a rigid mode, or noise hides the decay.
/// # Errors
/// [`RigError::Signal`].
pub(super) fn measured_modes(rig: &Rig, model: &Model) -> Result<Vec<MeasuredMode>, RigError> {
    let lead_in_s = LEAD_IN / rig.low_pass_hz;
    let Some(acceleration) = decay(model, rig.sampling_hz * FINER as f64, lead_in_s) else {
        return Ok(Vec::new());
    };
    let fine_hz = rig.sampling_hz * FINER as f64;
    let band = Band::LowPass { cut_off_hz: rig.low_pass_hz };
    let chain = MeasuringChain {
        sensor: MeasuredQuantity::Acceleration,
        filter: Some((butterworth(rig.low_pass_order as usize, band, fine_hz)?, false)),
        sampling_rate_hz: Some(rig.sampling_hz),
        noise: rig.noise_m_s2,
        seed: u64::from(rig.seed),
        converter: None,
    };
    let quantity = MeasuredQuantity::Acceleration;
    let channel = Channel { name: "decay".to_owned(), unit: None, quantity, samples: acceleration };
    let record =
        Record { sampling_rate_hz: fine_hz, start_s: 0.0, channels: vec![channel], findings: Vec::new() };
    let measured = chain.measure(&record, RecordCoverage::Excerpt)?.part(lead_in_s, f64::INFINITY)?;
    let settings =
        DecaySettings { band_hz: (0.0, highest_hz(rig)), max_modes: 4, ..DecaySettings::default() };
    let found = match free_decay(&measured.channels[0].samples, rig.sampling_hz, &settings) {
        // A structure whose decay is hidden by noise shows nothing; that is no fault.
        Err(SignalError::NoDecay) => return Ok(Vec::new()),
        found => found?,
    };
    let mode = |mode: &hammerbeam_signal::decay::DecayMode| MeasuredMode {
        frequency_hz: (mode.frequency_hz.value, mode.frequency_hz.half_width),
        damping_ratio: (mode.damping_ratio.value, mode.damping_ratio.half_width),
    };
    Ok(found.modes.iter().map(mode).collect())
}

fn decay(model: &Model, rate_hz: f64, lead_in_s: f64) -> Option<Vec<f64>> {
    let (reduced, shape) = (model.system.model(), &model.response.shape);
    let n = model.system.dof();
    let coupled = (0..n).any(|i| (0..n).any(|j| i != j && reduced.damping[(i, j)] != 0.0));
    if coupled || reduced.natural_frequencies.contains(&0.0) {
        return None;
    }
    let rates = &reduced.natural_frequencies;
    let flexibility: f64 = shape.iter().zip(rates).map(|(phi, w)| (phi / w).powi(2)).sum();
    let force = PULLED / flexibility;
    let slowest = rates.iter().copied().fold(f64::INFINITY, f64::min);
    let count = ((lead_in_s + PERIODS * TAU / slowest) * rate_hz) as usize;
    let mut acceleration = vec![0.0; count];
    for i in 0..n {
        let (w, d) = (rates[i], 0.5 * reduced.damping[(i, i)]);
        let p = (w * w - d * d).sqrt();
        // What folds down would not be there behind a real filter.
        if p.is_nan() || w > 0.45 * TAU * rate_hz {
            continue;
        }
        let begin = shape[i] * force / (w * w);
        for (k, sum) in acceleration.iter_mut().enumerate() {
            let t = k as f64 / rate_hz;
            let (sin, cos) = (p * t).sin_cos();
            let fades = begin * (-d * t).exp();
            let (q, v) = (fades * (cos + d / p * sin), -fades * w * w / p * sin);
            *sum -= shape[i] * (w * w * q + 2.0 * d * v);
        }
    }
    Some(acceleration)
}
