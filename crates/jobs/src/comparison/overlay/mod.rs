//! A measured history laid over computed orbits.
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
mod error;
mod found;
mod laid;
mod notes;
mod settings;

use hammerbeam_attractor::InOrder;
use hammerbeam_signal::waveform::Waveform;
use hammerbeam_study::Model;

use super::history::sampled;
use crate::{Observer, PooledOrder, StoredBranches};
use candidates::Candidate;

pub use error::OverlayError;
pub use found::{Alike, Overlay};
pub use notes::{LaidWaveform, OverlayAdvice, OverlayNote, nothing_alike};
pub use settings::{OverlaySettings, Sought};

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
