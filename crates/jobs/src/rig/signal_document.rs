//! A measured signal and its orbit, as a document.

use hammerbeam_signal::classify::MotionClass;
use serde_json::{Value, json};

use super::{SignalPair, figure_name};
use crate::comparison::{LaidWaveform, Overlay, nothing_alike};

impl SignalPair {
    /// The orbit under the signal.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub fn laid(&self) -> Result<&Overlay, String> {
        let none = || "no stable orbit of this period is near".to_owned();
        let overlay = self.computed.as_ref().ok_or_else(none)?;
        nothing_alike(overlay).map_or(Ok(overlay), Err)
    }

    /// What has to be known of the signal and its orbit, in words.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        match self.laid() {
            Ok(overlay) => {
                let laid = LaidWaveform {
                    overlay,
                    measured: &self.measured,
                    classification: &self.classification,
                    period_multiple: self.period_multiple,
                };
                laid.notes().into_iter().map(|note| note.text).collect()
            }
            Err(reason) => vec![reason],
        }
    }

    /// What the signal was taken for, in a word.
    #[must_use]
    pub fn measured_as(&self) -> String {
        match self.classification.motion {
            MotionClass::Periodic { period_multiple } => format!("periodic, {period_multiple}"),
            MotionClass::Aperiodic => "aperiodic".to_owned(),
            MotionClass::Doubtful { .. } => "doubtful".to_owned(),
        }
    }
}

/// A signal and its orbit; null without one.
///
/// * `index`: its place among the signals of the rig.
#[must_use]
pub fn signal_document((index, signal): (usize, &SignalPair)) -> Value {
    let computed = signal.laid().ok().map(|orbit| {
        json!({
            "frequency_hz": orbit.frequency_hz,
            "over_measured": orbit.frequency_hz / signal.measured_hz,
            "branch": orbit.branch,
            "row": orbit.row,
            "tried": orbit.tried,
            "skipped": orbit.skipped,
            "correlation": orbit.alignment.correlation,
            "lag_cycles": SignalPair::lag(orbit),
            "amplitude_factor": orbit.factor,
            "residual_before": orbit.residual_before,
            "residual_after": orbit.residual_after,
            "max_acceleration_m_s2": orbit.largest.0,
            "max_filtered_acceleration_m_s2": orbit.largest.1,
        })
    });
    json!({
        "table": figure_name(index),
        "measured_hz": signal.measured_hz,
        "period_multiple": signal.period_multiple,
        "measured_as": signal.measured_as(),
        "max_measured_acceleration_m_s2": signal.largest_measured,
        "computed": computed,
        "notes": signal.notes(),
    })
}
