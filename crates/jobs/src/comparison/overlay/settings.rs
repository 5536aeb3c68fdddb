//! Which orbits a history is laid over, and how.

use hammerbeam_signal::{MeasuredQuantity, waveform::Shifts};

use crate::comparison::history::Filter;

/// Which orbits are tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sought {
    /// Stored ones within a part of a frequency [Hz].
    Near {
        /// The frequency.
        frequency_hz: f64,
        /// The part.
        part: f64,
    },
    /// Those at a frequency [Hz], corrected there.
    At(f64),
}

/// How a history is laid over orbits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverlaySettings {
    /// What the sensor measures: displacement, velocity or acceleration of the response point of the model.
    pub quantity: MeasuredQuantity,
    /// The filter of the measurement, and whether it acts forwards and backwards.
    pub filter: Option<(Filter, bool)>,
    /// Which orbits are tried.
    pub sought: Sought,
    /// A branch, if it has to be that one.
    pub branch: Option<u32>,
    /// Which delays are allowed, in samples of the waveform.
    pub shifts: Shifts,
    /// The factor on measured values, where it is given; negative for a sensor that is turned around.
    pub factor: Option<f64>,
}
