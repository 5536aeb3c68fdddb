//! Why nothing is laid over.

use hammerbeam_results::StoreError;
use hammerbeam_signal::SignalError;

use crate::comparison::history::NoneSampled;

/// Why nothing is laid over.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum OverlayError {
    /// The store refuses.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// No orbit can be gone over.
    #[error(transparent)]
    NoneSampled(#[from] NoneSampled),
    /// Nothing of the motion is left to compare.
    #[error(
        "the low-pass filter of {cut_off_hz} Hz leaves {left:.1e} of the computed motion, less than one \
        step of 24 bits: there is nothing to compare with; is the cut-off that of the measurement?"
    )]
    FilteredAway { cut_off_hz: f64, left: f64 },
    /// The waveform refuses.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// A sensor that no orbit has.
    #[error("an orbit shows displacement, velocity and acceleration of a point, no {quantity}")]
    NoSuchSensor { quantity: &'static str },
    /// Stopped from outside.
    #[error("interrupted")]
    Interrupted,
}
