//! An orbit where no motion settles on one: from an orbit elsewhere, along its branch.

use hammerbeam_motion::System;

use crate::{
    BranchWalk, Interruption, OrbitError, OrbitSettings, PeriodicSolution, Response, Side, find_start_unless,
    free_vibration::resonance, start::attempt_nodes, walk::Walked,
};

/// Frequencies from which another one is reached, relative to it.
const ELSEWHERE: [f64; 8] = [0.75, 0.5, 0.35, 0.25, 0.18, 1.3, 1.7, 2.5];
/// Most solutions on the way.
const MOST_ON_A_SIDE: usize = 5000;

/// Finds an orbit at a frequency where no motion settles on one: from an orbit at another frequency, along
/// its branch.
///
/// # Errors
/// [`OrbitError::NoOrbit`] if no branch that was tried leads there, or [`OrbitError::Resonance`] if that is
/// why; [`OrbitError::Motion`] if none does and some motion could not be computed,
/// [`OrbitError::Interrupted`].
pub fn reach_orbit(
    system: &System,
    response: &Response,
    (frequency_hz, period_multiple): (f64, u32),
    settings: &OrbitSettings,
    interrupted: Interruption<'_>,
) -> Result<PeriodicSolution, OrbitError> {
    let mut failure = OrbitError::NoOrbit { frequency_hz, period_multiple, starts: ELSEWHERE.len() };
    for factor in ELSEWHERE {
        let from = factor * frequency_hz;
        let start =
            match find_start_unless(system, response, (from, period_multiple), settings, &mut *interrupted) {
                Ok(start) => start,
                Err(OrbitError::NoOrbit { .. }) => continue,
                Err(error @ OrbitError::Motion(_)) => {
                    failure = error;
                    continue;
                }
                Err(error) => return Err(error),
            };
        let (range, side) =
            if factor < 1.0 { ((from, frequency_hz), Side::Up) } else { ((frequency_hz, from), Side::Down) };
        let coarse = OrbitSettings {
            max_step: (range.1 - range.0) / 1000.0,
            max_solutions: MOST_ON_A_SIDE,
            locates_stability_changes: false,
            ..*settings
        };
        let mut walk = match BranchWalk::new(system, response, &start, side, range, &coarse) {
            Ok(walk) => walk,
            Err(OrbitError::Path(_)) => continue,
            Err(error) => return Err(error),
        };
        let mut reached = Vec::new();
        while walk.step_without_maxima(&mut reached)?.is_none() {
            if interrupted() {
                return Err(OrbitError::Interrupted);
            }
            reached.drain(..reached.len() - 1);
        }
        if let Some(Walked { frequency_hz: reached_hz, phase, nodes }) = reached.pop()
            && reached_hz == frequency_hz
            && let Some(solution) =
                attempt_nodes(system, response, (phase, &nodes), (frequency_hz, period_multiple), settings)?
        {
            return Ok(solution);
        }
    }
    Err(match failure {
        OrbitError::NoOrbit { .. } => resonance(system, frequency_hz).unwrap_or(failure),
        failure => failure,
    })
}
