//! Orbits at a frequency by Newton's method from few states: for looking at many frequencies.
//!
//! A closed branch without a stable part is on no motion's way. But its orbits have a basin of Newton's
//! method, and a trial costs some ten periods of motion with sensitivities, where a motion that is to settle
//! takes hundreds.
//!
//! Closed branches of longer periods may be narrow, and stable over a small part of their frequencies. A
//! trial for such an orbit costs as many times more as its period is longer. So they have fewer trials, each
//! of which ends early where it is far from an orbit, and from other states at each frequency: a branch that
//! passes several of them is met by one or the other.

use hammerbeam_motion::{Stretch, System};

use crate::{
    FoundOrbits, Interruption, OrbitError, OrbitSettings, PeriodicSolution, Response,
    catalogue::Catalogue,
    sampling::{Passed, Patience, Sought, sample},
    start::{STARTS, starting_states},
};

/// Excitation periods of each motion whose states are tried.
const PASSED: usize = 16;
/// Of them, those that say little of where the motion goes.
const PASSING: usize = 1;
/// Further trials for each orbit that is known.
const FOR_EACH: usize = 2;
/// Trials for one excitation period on one for each longer period.
const ON_ONE_LONGER: usize = 4;

/// How many trials, and which.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TrialEffort {
    /// Trials without a new orbit of one excitation period after which no more are made; for each longer
    /// period a quarter as many.
    pub trials: usize,
    /// Of the random numbers of the trials for longer periods.
    pub seed: u64,
}

/// Finds orbits at a frequency whose minimal periods are among `multiples`, in the order in which they were
/// met. A start from which no motion can be computed makes the search incomplete.
///
/// * `interrupted`: asked before each trial.
///
/// # Errors
/// [`OrbitError::Motion`] if the motion cannot be computed from any start, [`OrbitError::Interrupted`].
pub fn newton_trials(
    system: &System,
    response: &Response,
    (frequency_hz, multiples): (f64, &[u32]),
    effort: TrialEffort,
    settings: &OrbitSettings,
    interrupted: Interruption<'_>,
) -> Result<FoundOrbits, OrbitError> {
    let mut catalogue = Catalogue::new(system, response, settings, frequency_hz)?;
    let mut passed = Passed::default();
    let mut failure = None;
    for start in starting_states(system, response, frequency_hz, STARTS, settings)? {
        match motion(&mut catalogue, start) {
            Ok(states) => passed.motions.push(states),
            Err(error) => failure = Some(error),
        }
    }
    match failure {
        Some(error) if passed.motions.is_empty() => return Err(error),
        _ => {}
    }
    for (sought, patience) in effort.of(multiples) {
        sample(&mut catalogue, &passed, sought, patience, &mut *interrupted)?;
    }
    let is_wanted = |orbit: &PeriodicSolution| multiples.contains(&orbit.period_multiple);
    Ok(catalogue.into_found(is_wanted, failure))
}

impl TrialEffort {
    /// What is looked for, the shortest period first, which others are recognised by, and for how long.
    fn of(self, multiples: &[u32]) -> Vec<(Sought, Patience)> {
        let of = |period_multiple: u32| {
            let (sought, trials, for_each) = match period_multiple {
                1 => (Sought::all(1), self.trials, FOR_EACH),
                longer => (Sought::nearby(longer, self.seed), self.trials.div_ceil(ON_ONE_LONGER), 0),
            };
            (sought, Patience { trials, for_each, asks_for_two_arrivals: false, most: 8 * trials })
        };
        let mut ascending = multiples.to_vec();
        ascending.sort_unstable();
        ascending.into_iter().map(of).collect()
    }
}

/// States at the excitation periods of a motion.
fn motion(catalogue: &mut Catalogue<'_>, start: Vec<f64>) -> Result<Vec<Vec<f64>>, OrbitError> {
    let stretch = Stretch { frequency_hz: catalogue.frequency_hz, start: 0.0, end: 1.0 };
    let mut states = vec![start];
    for period in 0..PASSED {
        let next = catalogue.integrator().advance(&stretch, &states[period])?;
        states.push(next);
    }
    states.drain(..PASSING);
    Ok(states)
}
