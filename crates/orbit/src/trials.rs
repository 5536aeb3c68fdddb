//! Orbits of one excitation period at a frequency, by Newton's method from few states: for looking at many
//! frequencies.
//!
//! A closed branch without a stable part is on no motion's way. But its orbits have a basin of Newton's
//! method, and a trial costs some ten periods of motion with sensitivities, where a motion that is to settle
//! takes hundreds.

use hammerbeam_motion::{Stretch, System};

use crate::{
    FoundOrbits, Interruption, OrbitError, OrbitSettings, Response,
    catalogue::Catalogue,
    sampling::{Passed, Patience, sample},
    start::{STARTS, starting_states},
};

/// Excitation periods of each motion whose states are tried.
const PASSED: usize = 16;
/// Of them, those that say little of where the motion goes.
const PASSING: usize = 1;
/// Further trials for each orbit that is known.
const FOR_EACH: usize = 2;

/// Finds orbits of one excitation period at a frequency, in the order in which they were met. A start from
/// which no motion can be computed makes the search incomplete.
///
/// * `trials`: trials of Newton's method without a new orbit after which it ends.
/// * `interrupted`: asked before each trial.
///
/// # Errors
/// [`OrbitError::Motion`] if the motion cannot be computed from any start, [`OrbitError::Interrupted`].
pub fn harmonic_trials(
    system: &System,
    response: &Response,
    frequency_hz: f64,
    trials: usize,
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
    let patience = Patience { trials, for_each: FOR_EACH, asks_for_two_arrivals: false, most: 8 * trials };
    sample(&mut catalogue, &passed, 1, patience, interrupted)?;
    let orbits = catalogue.known.into_iter().map(|known| known.solution).collect();
    Ok(FoundOrbits { orbits, incomplete: failure })
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
