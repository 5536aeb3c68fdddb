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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

    use hammerbeam_motion::{Law, law::PowerSpring};

    use super::*;
    use crate::test_oscillator::oscillator;

    /// `x'' + 0.05 x' + x + x^3 = F cos(2 pi f t)`, with several attractors at small forces, and chaos at
    /// large ones.
    #[test]
    fn a_survey_for_stable_orbits_finds_those_that_one_for_all_finds() {
        let (mut stable, mut unstable) = (0, 0);
        for (force, frequency_hz) in
            [(3.0, 0.3), (3.0, 0.6), (3.0, 0.9), (7.5, 0.16), (12.0, 0.16), (25.0, 0.22), (40.0, 0.3)]
        {
            let (system, response) = oscillator(0.05, force, Law::Power(PowerSpring::cubic(1.0).unwrap()));
            let found = |wanted| {
                let effort = SurveyEffort { wanted, ..SurveyEffort::default() };
                let settings = OrbitSettings::default();
                survey(&system, &response, frequency_hz, &[1, 2, 3], &effort, &settings, &mut || false)
                    .unwrap()
                    .found
                    .orbits
            };
            let (all, chosen) = (found(Wanted::Any), found(Wanted::StableNearby));
            assert!(chosen.iter().all(|orbit| orbit.may_be_stable()), "{frequency_hz} Hz");
            let sizes = |orbits: &[crate::PeriodicSolution]| {
                let stable = orbits.iter().filter(|orbit| orbit.may_be_stable());
                let mut sizes: Vec<_> =
                    stable.map(|orbit| (orbit.period_multiple, orbit.maxima.displacement)).collect();
                sizes.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
                sizes
            };
            let (expected, sizes) = (sizes(&all), sizes(&chosen));
            assert_eq!(expected.len(), sizes.len(), "{frequency_hz} Hz: {expected:?} and {sizes:?}");
            for (a, b) in expected.iter().zip(&sizes) {
                assert!(a.0 == b.0 && (a.1 / b.1 - 1.0).abs() < 1e-8, "{frequency_hz} Hz: {a:?} and {b:?}");
            }
            stable += sizes.len();
            unstable += all.len() - sizes.len();
        }
        assert!(stable >= 6 && unstable >= 1, "{stable} {unstable}");
    }
}
