//! All periodic motions that simulation leads to at one frequency, of several period multiples at once.
//!
//! From each of many starts the motion is followed until it repeats, or has had time to settle and was
//! observed over more excitation periods; see [`MotionSearch`]. Attractors are found so, and where motions
//! are chaotic or slow, unstable orbits near them, if they are wanted.

use hammerbeam_motion::System;

use crate::{
    FoundOrbits, Interruption, OrbitError, OrbitSettings, Response,
    motion_search::{Extent, MotionSearch},
    solve::Wanted,
    start::starting_states,
};

/// Motions in a row that wander and show nothing new, after which others that come there end: of any orbits,
/// and of stable ones, of which a motion that wanders shows fewer.
const FRUITLESS: [usize; 2] = [2, 4];

/// How much is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurveyEffort {
    /// Starts at each frequency.
    pub starts: usize,
    /// Excitation periods that a motion has to settle at most; one that repeats ends sooner.
    pub settling: usize,
    /// Excitation periods observed, at least three times the largest multiple.
    pub observed: usize,
    /// Near-returns tried for each start and period multiple.
    pub near_returns: usize,
    /// What is looked for there.
    pub wanted: Wanted,
}

impl Default for SurveyEffort {
    fn default() -> Self {
        Self { starts: 7, settling: 128, observed: 96, near_returns: 2, wanted: Wanted::Any }
    }
}

/// What a survey has found at one frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct SurveyedMotions {
    /// The orbits, by multiple, in the order in which they were met.
    pub found: FoundOrbits,
    /// States at phase 0 of motions that have not settled, nor come near a stable orbit: chaotic ones as a
    /// rule. Others that come there need not be followed, see [`ProbeStarts`](crate::ProbeStarts).
    pub unsettled: Vec<Vec<f64>>,
}

/// Finds periodic orbits at a frequency whose minimal periods are among `multiples`. A start from which no
/// motion can be computed makes the search incomplete.
///
/// * `interrupted`: asked at each excitation period of a motion.
///
/// # Errors
/// [`OrbitError::Motion`] if the motion cannot be computed from any start, [`OrbitError::Interrupted`].
pub fn survey(
    system: &System,
    response: &Response,
    frequency_hz: f64,
    multiples: &[u32],
    effort: &SurveyEffort,
    settings: &OrbitSettings,
    interrupted: Interruption<'_>,
) -> Result<SurveyedMotions, OrbitError> {
    let largest = multiples.iter().copied().max().unwrap_or(1) as usize;
    let observed = effort.observed.max(3 * largest);
    let extent = Extent {
        most: effort.settling + observed,
        kept: observed,
        near_returns: effort.near_returns,
        fruitless: FRUITLESS[usize::from(effort.wanted == Wanted::StableNearby)],
        wanted: effort.wanted,
    };
    let starts = starting_states(system, response, frequency_hz, effort.starts, settings)?;
    let mut search = MotionSearch::new((system, response), (frequency_hz, multiples), extent, settings)?;
    let incomplete = search.follow_all(starts, interrupted)?;
    let unsettled = std::mem::take(&mut search.wandered);
    let mut found = search.found(incomplete);
    found.orbits.sort_by_key(|orbit| orbit.period_multiple);
    Ok(SurveyedMotions { found, unsettled })
}
