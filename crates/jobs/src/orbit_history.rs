//! The history of an orbit from phase 0 on: states at equal steps and impacts. If asked for, states stand as
//! densely within contacts as these need. The page and waveforms are made of it.

use hammerbeam_motion::{
    Stretch,
    exact::{ContactPiece, ExactIntegrator, Inside, MotionError},
};
use hammerbeam_orbit::PeriodicSolution;

/// A state of an orbit.
#[derive(Debug, Clone, PartialEq)]
pub struct OrbitInstant {
    /// Excitation periods since phase 0 in the first period of the orbit, less than those of the orbit.
    pub cycles: f64,
    /// Number of the step at which it stands, if it is a regular one.
    pub place: Option<usize>,
    /// `[q; q']`.
    pub state: Vec<f64>,
    /// Forces of the local elements [N].
    pub forces: Vec<f64>,
}

/// An impact on a rigid stop.
#[derive(Debug, Clone, PartialEq)]
pub struct OrbitImpact {
    /// Number of the local element.
    pub element: usize,
    /// When it is, as of an instant.
    pub cycles: f64,
    /// Impulse along the relative displacement of the element [N s].
    pub impulse_n_s: f64,
    /// `[q; q']` before.
    pub before: Vec<f64>,
    /// `[q; q']` after.
    pub after: Vec<f64>,
}

/// An orbit from phase 0 on.
#[derive(Debug, Clone, PartialEq)]
pub struct OrbitHistory {
    /// States at every step and within contacts, in their order in time.
    pub instants: Vec<OrbitInstant>,
    /// Impacts on rigid stops, in their order in time.
    pub impulses: Vec<OrbitImpact>,
}

/// Goes over an orbit.
///
/// Each node of the orbit gives those up to the next one, so that also an orbit that is left fast is
/// followed.
///
/// * `steps`: in an excitation period.
/// * `in_a_step`: samples in each of the steps of the integrator, some three, in which a contact is computed,
///   unless as many regular ones lie in it.
///
/// # Errors
/// [`MotionError`]: the motion cannot be computed again.
pub fn orbit_history(
    integrator: &mut ExactIntegrator,
    solution: &PeriodicSolution,
    (steps, in_a_step): (usize, usize),
) -> Result<OrbitHistory, MotionError> {
    let (begin, periods) = (solution.phase, f64::from(solution.period_multiple));
    let count = steps * solution.period_multiple as usize;
    let first = (begin * steps as f64).ceil() as usize;
    let phase = |k: usize| k as f64 / steps as f64;
    let segments = solution.nodes.len();
    let at = |segment: usize| begin + periods * segment as f64 / segments as f64;
    let mut instants = Vec::with_capacity(count + 32 * in_a_step);
    let mut impulses = Vec::new();
    let mut next = first;
    for (segment, node) in solution.nodes.iter().enumerate() {
        let stretch =
            Stretch { frequency_hz: solution.frequency_hz, start: at(segment), end: at(segment + 1) };
        let is_last = segment + 1 == segments;
        let regular: Vec<usize> =
            (next..first + count).take_while(|&k| is_last || phase(k) < stretch.end).collect();
        next += regular.len();
        let within = |k: &usize| phase(*k).clamp(stretch.start, stretch.end);
        let phases: Vec<f64> = regular.iter().map(within).collect();
        let trace = integrator.trace_closely(&stretch, node, &phases, in_a_step)?;
        for ((k, state), forces) in regular.into_iter().zip(trace.samples).zip(trace.forces) {
            // What stands at a regular place keeps its number, whatever rounding does to its phase.
            let place = k % count;
            let cycles = place as f64 / steps as f64;
            instants.push(OrbitInstant { cycles, place: Some(place), state, forces });
        }
        for Inside { time, state, forces } in trace.inside {
            let cycles = (stretch.start + stretch.frequency_hz * time).rem_euclid(periods);
            instants.push(OrbitInstant { cycles, place: None, state, forces });
        }
        impulses.extend(trace.contacts.into_iter().filter_map(|contact| impulse(&stretch, contact, periods)));
    }
    instants.sort_by(|a, b| a.cycles.total_cmp(&b.cycles));
    impulses.sort_by(|a: &OrbitImpact, b| a.cycles.total_cmp(&b.cycles));
    Ok(OrbitHistory { instants, impulses })
}

/// The impact with which a contact begins, if it does.
///
/// * `periods`: excitation periods of the orbit.
fn impulse(stretch: &Stretch, contact: ContactPiece, periods: f64) -> Option<OrbitImpact> {
    let (touch, jump) = (contact.begin?, contact.jump?);
    Some(OrbitImpact {
        element: contact.element,
        cycles: (stretch.start + stretch.frequency_hz * touch.time).rem_euclid(periods),
        impulse_n_s: -jump.impulse,
        before: touch.state,
        after: jump.state,
    })
}
