//! All periodic motions that simulation leads to at one frequency, of several period multiples at once.
//!
//! From each of many starts the motion is simulated until it has had time to settle, and then observed over
//! more excitation periods. If it repeats after N periods it is an attractor of period N. If not, it is
//! chaotic or still settling, and the states that come back closest after N periods are near unstable orbits
//! of that period (Auerbach and others, Phys. Rev. Lett. 58 (1987), 2387), to which Newton's method takes
//! them.

use hammerbeam_motion::{Stretch, System};

use crate::{
    FoundOrbits, Interruption, OrbitError, OrbitSettings, PeriodicSolution, Response,
    arrival::StableOrbits,
    cut::search_cut,
    matching::{distance_in_phase, nearest_returns, states_at_phase},
    repetition::{nearly_repeats_after, repeats_after},
    size::{orbit_scale, scale_from},
    solve::integrator,
    start::{attempt, attempt_nodes, starting_states},
};

/// How much is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurveyEffort {
    /// Starts at each frequency.
    pub starts: usize,
    /// Excitation periods after which a motion is observed.
    pub settling: usize,
    /// Excitation periods observed, at least three times the largest multiple.
    pub observed: usize,
    /// Near-returns tried for each start and period multiple.
    pub near_returns: usize,
}

impl Default for SurveyEffort {
    fn default() -> Self {
        Self { starts: 7, settling: 128, observed: 96, near_returns: 2 }
    }
}

/// Two orbits this close, relative to the orbit, are the same.
const SAME: f64 = 1e-6;

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
    let survey = Survey { system, response, frequency_hz, multiples, effort, settings };
    let mut found: Vec<PeriodicSolution> = Vec::new();
    let (mut failure, mut computed, mut unsettled) = (None, false, Vec::new());
    let (mut motion, mut reached) = (integrator(system, response, settings)?, StableOrbits::default());
    for start in starting_states(system, response, frequency_hz, effort.starts, settings)? {
        match survey.from(&start, &reached, &mut *interrupted) {
            Err(error @ (OrbitError::Motion(_) | OrbitError::NeverOpens { .. })) => failure = Some(error),
            Err(error) => return Err(error),
            Ok(motion_led_to) => {
                computed = true;
                unsettled.extend(motion_led_to.unsettled);
                for orbit in motion_led_to.orbits {
                    if !survey.holds(&found, &orbit)? {
                        reached.add(&mut motion, &orbit)?;
                        found.push(orbit);
                    }
                }
            }
        }
    }
    match failure {
        Some(error) if !computed => Err(error),
        _ => {
            found.sort_by_key(|orbit| orbit.period_multiple);
            let found = FoundOrbits { orbits: found, incomplete: failure };
            Ok(SurveyedMotions { found, unsettled })
        }
    }
}

/// What the motion from one start led to.
#[derive(Default)]
struct LedTo {
    orbits: Vec<PeriodicSolution>,
    unsettled: Vec<Vec<f64>>,
}

struct Survey<'a> {
    system: &'a System,
    response: &'a Response,
    frequency_hz: f64,
    multiples: &'a [u32],
    effort: &'a SurveyEffort,
    settings: &'a OrbitSettings,
}

impl Survey<'_> {
    /// What the motion from one state leads to, nothing if it comes to a known orbit.
    fn from(
        &self,
        start: &[f64],
        known: &StableOrbits,
        interrupted: Interruption<'_>,
    ) -> Result<LedTo, OrbitError> {
        let largest = self.multiples.iter().copied().max().unwrap_or(1) as usize;
        let mut integrator = integrator(self.system, self.response, self.settings)?;
        let stretch = Stretch { frequency_hz: self.frequency_hz, start: 0.0, end: 1.0 };
        let observed = self.effort.observed.max(3 * largest);
        let mut states = vec![start.to_vec()];
        let mut approach = known.approached();
        for period in 0..self.effort.settling + observed {
            if interrupted() {
                return Err(OrbitError::Interrupted);
            }
            let next = integrator.advance(&stretch, &states[states.len() - 1])?;
            if approach.has_arrived(known, &next) {
                return Ok(LedTo::default());
            }
            if period < self.effort.settling {
                states[0] = next;
            } else {
                states.push(next);
            }
        }
        let scale = scale_from(&mut integrator, &states[0], self.frequency_hz)?;
        if let Some(period) = repeats_after(&states, &scale, largest) {
            let wanted = self.multiples.contains(&(period as u32));
            let last = &states[states.len() - 1];
            let orbit = if wanted {
                let (begin, _) = search_cut(&mut integrator, last, (self.frequency_hz, period as u32))?;
                self.orbit(begin.at(), period as u32)?
            } else {
                None
            };
            return Ok(LedTo { orbits: orbit.into_iter().collect(), unsettled: Vec::new() });
        }
        let mut orbits = Vec::new();
        for &multiple in self.multiples {
            for nodes in nearest_returns(&states, &scale, multiple as usize, self.effort.near_returns) {
                if interrupted() {
                    return Err(OrbitError::Interrupted);
                }
                // Newton's method from all states and from the first one alone go different ways; either may
                // arrive.
                let orbit = (self.frequency_hz, multiple);
                orbits.extend(attempt_nodes(self.system, self.response, (0.0, nodes), orbit, self.settings)?);
                if multiple > 1 {
                    orbits.extend(self.orbit((0.0, &nodes[0]), multiple)?);
                }
            }
        }
        let settles = nearly_repeats_after(&states, &scale, largest).is_some()
            || orbits.iter().any(PeriodicSolution::stable);
        Ok(LedTo { orbits, unsettled: if settles { Vec::new() } else { states } })
    }

    fn orbit(&self, begin: (f64, &[f64]), multiple: u32) -> Result<Option<PeriodicSolution>, OrbitError> {
        attempt(self.system, self.response, begin, (self.frequency_hz, multiple), self.settings)
    }

    fn holds(&self, found: &[PeriodicSolution], orbit: &PeriodicSolution) -> Result<bool, OrbitError> {
        let same_period = || found.iter().filter(|known| known.period_multiple == orbit.period_multiple);
        if same_period().next().is_none() {
            return Ok(false);
        }
        let mut integrator = integrator(self.system, self.response, self.settings)?;
        let scale = orbit_scale(&mut integrator, orbit)?;
        let mut phases = states_at_phase(&mut integrator, orbit, orbit.phase)?;
        let mut at = orbit.phase;
        for known in same_period() {
            if known.phase != at {
                at = known.phase;
                phases = states_at_phase(&mut integrator, orbit, at)?;
            }
            if distance_in_phase(&scale, &phases, &known.nodes[0]) < SAME {
                return Ok(true);
            }
        }
        Ok(false)
    }
}
