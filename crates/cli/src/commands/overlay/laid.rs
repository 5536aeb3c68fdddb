//! A recorded motion and the orbit that is most alike.

use hammerbeam_jobs::comparison::{LaidWaveform, Overlay, OverlayAdvice, OverlayNote};
use hammerbeam_signal::{MeasuredQuantity, classify::Classification, waveform::Waveform};

use super::super::signal::Input;

/// What was laid over what.
pub struct Laid {
    pub input: Input,
    pub quantity: MeasuredQuantity,
    /// Name of the point where the sensor is.
    pub point: String,
    pub classification: Classification,
    pub period_multiple: u32,
    pub measured: Waveform,
    pub overlay: Overlay,
}

impl Laid {
    /// Time of a phase of the waveform within the first orbit period of the record, on its clock [s].
    pub fn time_s(&self, samples: f64) -> f64 {
        let cycles = samples / self.measured.per_period as f64;
        self.input.record.start_s + cycles / self.classification.frequency_hz
    }

    /// The first time in the record at which the orbit begins, with the excitation of the study at its phase
    /// 0, on the clock of the record [s].
    pub fn phase_zero_s(&self) -> f64 {
        self.time_s(self.overlay.alignment.shift)
    }

    /// Frequency of the highest line that is compared [Hz].
    pub fn highest_hz(&self) -> f64 {
        self.measured.lines as f64 / f64::from(self.period_multiple) * self.classification.frequency_hz
    }

    /// What the reader has to know, and can do.
    pub fn notes(&self) -> Vec<String> {
        let laid = LaidWaveform {
            overlay: &self.overlay,
            measured: &self.measured,
            classification: &self.classification,
            period_multiple: self.period_multiple,
        };
        let text = |note: OverlayNote| match note.advice {
            Some(OverlayAdvice::NegativeFactor) => {
                format!("{}; --amplitude-factor takes a negative factor", note.text)
            }
            Some(OverlayAdvice::GiveMore) => {
                format!("{}; give --at, --branch or --amplitude-factor", note.text)
            }
            None => note.text,
        };
        laid.notes().into_iter().map(text).collect()
    }
}
