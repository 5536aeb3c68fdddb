//! A measured course laid over computed orbits.
//!
//! The measurement is a waveform over `n` excitation periods ([`hammerbeam_signal::waveform`]). Of the stable
//! orbits of that period in a range of frequencies each goes through the same sensor and filter (line by line
//! of its spectrum, so that there is no transient), is cut to the lines that the record holds, is delayed
//! until it is most alike, and the most alike of all is taken: the one that leaves least of the record
//! (`alike.rs`), with the factor on measured values if that is given. The paper does the same by eye (figures
//! 7 to 14).
//!
//! An orbit whose motion cannot be gone over again is left out and counted; it is an error only if none is
//! left.
//!
//! | file | what |
//! |---|---|
//! | `candidates.rs` | the orbits that are tried |
//! | `laid.rs` | one of them laid under the measurement |
//! | `notes.rs` | what has to be known of it |
//! | `alike.rs` | the most alike one, and those that are as alike |

mod alike;
mod candidates;
mod laid;
mod notes;

use hammerbeam_attractor::InOrder;
use hammerbeam_results::StoreError;
use hammerbeam_signal::{
    MeasuredQuantity, SignalError,
    waveform::{Alignment, Shifts, Waveform},
};
use hammerbeam_study::Model;

use super::{
    Filter,
    course::{NoneSampled, Sampled, sampled},
};
use crate::{Observer, PooledOrder, StoredBranches};
pub use alike::Alike;
use candidates::Candidate;
pub use notes::{LaidWaveform, OverlayAdvice, OverlayNote, nothing_alike};

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

/// How a course is laid over orbits.
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

/// The orbit that is most alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Overlay {
    /// Its frequency [Hz].
    pub frequency_hz: f64,
    /// Number of its branch,
    pub branch: u32,
    /// and its row there, from 1 on; `None` if it was corrected at a frequency.
    pub row: Option<usize>,
    /// How it lies over the measurement; over its mirror image, if the factor is given and negative.
    pub alignment: Alignment,
    /// Largest correlation that an orbit among those tried has with the measurement turned around.
    pub turned_correlation: f64,
    /// Factor on measured values: given, or the best one.
    pub factor: f64,
    /// Root mean square of what is left over that of the computed course: with the factor 1, or -1 where
    /// [`Overlay::factor`] is negative,
    pub residual_before: f64,
    /// and with that factor.
    pub residual_after: f64,
    /// The measured quantity behind the filter and with the lines that the record holds, as it is delayed, at
    /// the samples of the waveform,
    pub filtered: Vec<f64>,
    /// and without filter, with all its lines.
    pub unfiltered: Vec<f64>,
    /// Displacement of the point [m], and of each moving support [m], so delayed.
    pub displacement: Vec<f64>,
    /// See above.
    pub supports: Vec<Vec<f64>>,
    /// Largest value of the quantity before and behind the filter, of all samples of the orbit.
    pub largest: (f64, f64),
    /// Others that are as alike, as far as the record can tell: of other branches, or farther away than
    /// neighbours on a branch.
    pub alike: Option<Alike>,
    /// Orbits that were tried,
    pub tried: usize,
    /// and others that could not be gone over.
    pub skipped: usize,
}

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
        "the low-pass filter of {cut_off_hz} Hz leaves {left:.1e} of the computed motion, less than one step of 24 bits: there is nothing to compare with; is the cut-off that of the measurement?"
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

/// Lays a measured waveform over the orbits of stored branches.
///
/// * `model`: that of the study; its response point is where the sensor is.
/// * `period_multiple`: of the waveform and the orbits.
///
/// # Returns
/// `None` if no stable orbit of the period is among those that are sought.
/// # Errors
/// [`OverlayError`].
pub fn overlay(
    (model, branches): (&Model, &StoredBranches),
    (measured, period_multiple): (&Waveform, u32),
    settings: &OverlaySettings,
    (threads, observer): (usize, &mut dyn Observer),
) -> Result<Option<Overlay>, OverlayError> {
    let orbits = candidates::sought(model, branches, period_multiple, settings)?;
    let look = |(): &mut (), candidate: &Candidate| laid::laid(model, candidate, measured, settings);
    let tried = PooledOrder::new(threads, observer).in_order(&orbits, &|| (), &look);
    let tried = tried.ok_or(OverlayError::Interrupted)?;
    let (laid, skipped) = sampled(tried)?;
    let laid: Vec<Overlay> = laid.into_iter().flatten().collect();
    let tried = laid.len();
    let turned_correlation = laid.iter().map(|one| one.turned_correlation).fold(f64::NEG_INFINITY, f64::max);
    let best = alike::most_alike(&laid, settings.factor);
    let alike = best.and_then(|best| alike::alike(&laid, &laid[best], measured, settings.factor));
    let best = best.and_then(|best| laid.into_iter().nth(best));
    Ok(best.map(|best| Overlay { tried, skipped, turned_correlation, alike, ..best }))
}

/// What came of an orbit.
type Tried = Sampled<Overlay, OverlayError>;
