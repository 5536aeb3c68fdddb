//! Attractors at one frequency by few motions, for looking at many frequencies.
//!
//! Motions start from the linear response, from states about it and from states of large amplitude that a
//! backbone suggests, and are followed as in [`MotionSearch`]. Where there is little damping they have not
//! repeated at last: then Newton's method starts where they have come back most closely after each of the
//! multiples. What that finds is kept if it may be stable. A motion that will not settle, a chaotic one,
//! comes back near unstable orbits: there Newton's method ends as soon as that is seen, which is before it
//! has converged.

use hammerbeam_motion::System;

use crate::{
    FoundOrbits, Interruption, OrbitError, OrbitSettings, PeriodicSolution, Response, SurveyEffort,
    backbone::backbone_states,
    motion_search::{Extent, MotionSearch},
    solve::Wanted,
    start::starting_states,
};

/// Least number of states that are kept, at successive excitation periods.
const KEPT: usize = 48;
/// Near-returns from which Newton's method begins, of each multiple.
const NEAR_RETURNS: usize = 2;

/// How many motions start where, and what is known before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProbeStarts<'a> {
    /// From the linear response and states about it.
    pub about_linear: usize,
    /// On backbones.
    pub on_backbones: usize,
    /// Orbits at this frequency; motions that come to a stable one of them end.
    pub known: &'a [PeriodicSolution],
    /// States at this frequency where others wander that do not settle; motions that come there end.
    pub unsettled: &'a [Vec<f64>],
}

/// Finds further orbits at a frequency, those that may be stable, whose minimal periods are among
/// `multiples`. A start from which no motion can be computed makes the search incomplete.
///
/// * `effort`: a motion has its settling periods, and as many as are kept behind them; no more of it is used.
///
/// # Errors
/// [`OrbitError::Motion`] if the motion cannot be computed from any start, [`OrbitError::Interrupted`].
pub fn probe(
    system: &System,
    response: &Response,
    (frequency_hz, multiples): (f64, &[u32]),
    (starts, effort): (ProbeStarts<'_>, &SurveyEffort),
    settings: &OrbitSettings,
    interrupted: Interruption<'_>,
) -> Result<FoundOrbits, OrbitError> {
    let about_linear = starts.about_linear.saturating_sub(1);
    let mut states = starting_states(system, response, frequency_hz, about_linear, settings)?;
    states.extend(backbone_states(system, frequency_hz, multiples, &states[0], starts.on_backbones));
    if starts.about_linear == 0 {
        states.remove(0);
    }
    let largest = multiples.iter().copied().max().unwrap_or(1) as usize;
    let kept = KEPT.max(3 * largest);
    let most = effort.settling + kept;
    let extent =
        Extent { most, kept, near_returns: NEAR_RETURNS, fruitless: 0, wanted: Wanted::StableNearby };
    let mut search = MotionSearch::new((system, response), (frequency_hz, multiples), extent, settings)?;
    search.end_at(starts.known)?;
    search.wandered.extend_from_slice(starts.unsettled);
    let incomplete = search.follow_all(states, interrupted)?;
    Ok(search.found(incomplete))
}
