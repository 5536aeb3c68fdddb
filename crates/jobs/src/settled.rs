//! Periodic motions that sweeps and basins of a results folder have come to: where a run can begin branches
//! that its own searches miss.

use hammerbeam_results::store::{RequestKind, Store, StoreError};

/// A motion that repeats.
#[derive(Debug, Clone, PartialEq)]
pub struct SettledState {
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Excitation periods after which it repeats.
    pub period_multiple: u32,
    /// A state of it at phase 0, `[q; q']` over the modes.
    pub state: Vec<f64>,
}

/// All periodic motions that the sweeps, the motions from several states and the basins of a folder have come
/// to, in the order of their requests.
///
/// # Errors
/// The store refuses.
pub fn settled_states(store: &Store) -> Result<Vec<SettledState>, StoreError> {
    let mut found = Vec::new();
    for request in store.requests()? {
        match request.kind {
            RequestKind::Sweep | RequestKind::Starts => {
                for motion in store.settled(request.id)? {
                    let point = motion.point;
                    let period = point.class.period();
                    found.extend(settled(point.frequency_hz, period, point.state));
                }
            }
            RequestKind::Basins => {
                let frequency_hz = request.word("frequency_hz").and_then(|word| word.parse().ok());
                let Some(frequency_hz) = frequency_hz else { continue };
                for attractor in store.basins(request.id)?.1 {
                    let state = attractor.states.first().cloned().unwrap_or_default();
                    found.extend(settled(frequency_hz, attractor.class.period(), state));
                }
            }
            RequestKind::Simulation | RequestKind::Exponents => {}
        }
    }
    Ok(found)
}

fn settled(frequency_hz: f64, period: Option<usize>, state: Vec<f64>) -> Option<SettledState> {
    let period_multiple = u32::try_from(period?).ok()?;
    Some(SettledState { frequency_hz, period_multiple, state })
}
