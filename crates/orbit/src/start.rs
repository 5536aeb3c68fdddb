//! The first orbit of a branch: from the linear response and from simulation.

use hammerbeam_motion::{Stretch, System, exact::ExactIntegrator};

use crate::{
    OrbitError, OrbitSettings, PeriodicSolution, Response, Segments,
    solve::{has_minimal_period, integrator, orbit_near, state_scale},
};

/// Excitation periods simulated between two attempts of Newton's method.
const PERIODS: usize = 64;
/// Attempts per start.
const ATTEMPTS: usize = 12;
/// Starts besides the linear response.
pub(crate) const STARTS: usize = 6;

/// Finds one orbit whose minimal period is `period_multiple` excitation periods.
///
/// The motion is simulated from the linear response and from several states about it; now and then Newton's method is tried.
///
/// # Errors
/// [`OrbitError::NoOrbit`] if no start leads to such an orbit.
pub fn find_start(
    system: &System,
    response: &Response,
    frequency_hz: f64,
    period_multiple: u32,
    settings: &OrbitSettings,
) -> Result<PeriodicSolution, OrbitError> {
    for start in starting_states(system, response, frequency_hz, STARTS, settings)? {
        let found = settle(system, response, &start, (frequency_hz, period_multiple), settings)?;
        if let Some(solution) = found {
            return Ok(solution);
        }
    }
    Err(OrbitError::NoOrbit { frequency_hz, period_multiple, starts: STARTS + 1 })
}

/// The linear response, and states in its neighbourhood and well beyond it, always the same ones.
pub(crate) fn starting_states(
    system: &System,
    response: &Response,
    frequency_hz: f64,
    starts: usize,
    settings: &OrbitSettings,
) -> Result<Vec<Vec<f64>>, OrbitError> {
    let mut integrator = integrator(system, response, settings)?;
    let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
    let linear = integrator.steady_state(&stretch);
    let scale = state_scale(system, &linear, frequency_hz);
    let mut sequence = 0u64;
    let mut noise = move || {
        sequence = sequence.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (sequence ^ (sequence >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let n = system.dof();
    let mut states = vec![linear.clone()];
    for start in 0..starts {
        // Six reaches, from half the linear response to sixteen times as much, over and over.
        let reach = 0.5 * 2f64.powi((start % STARTS) as i32);
        // Low modes move most: their share falls with the order of the mode.
        let add = |i: usize, noise: f64| scale.values()[i] * reach * noise / (1 + i % n) as f64;
        states.push((0..2 * n).map(|i| linear[i] + add(i, noise())).collect());
    }
    Ok(states)
}

/// Simulates from `state` and tries Newton's method now and then.
fn settle(
    system: &System,
    response: &Response,
    state: &[f64],
    (frequency_hz, period_multiple): (f64, u32),
    settings: &OrbitSettings,
) -> Result<Option<PeriodicSolution>, OrbitError> {
    let mut simulation = integrator(system, response, settings)?;
    let mut state = state.to_vec();
    for _ in 0..ATTEMPTS {
        let rest = simulate(&mut simulation, &mut state, frequency_hz, PERIODS);
        if rest.is_err() {
            return Ok(None);
        }
        let found = attempt(system, response, &state, (frequency_hz, period_multiple), settings)?;
        if let Some(solution) = found {
            return Ok(Some(solution));
        }
    }
    Ok(None)
}

/// Advances a state by whole excitation periods.
pub(crate) fn simulate(
    integrator: &mut ExactIntegrator,
    state: &mut Vec<f64>,
    frequency_hz: f64,
    periods: usize,
) -> Result<(), OrbitError> {
    let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
    for _ in 0..periods {
        *state = integrator.advance(&stretch, state)?;
    }
    Ok(())
}

/// Newton's method from `state`; `None` if it leads nowhere or to an orbit of a shorter period.
pub(crate) fn attempt(
    system: &System,
    response: &Response,
    state: &[f64],
    (frequency_hz, period_multiple): (f64, u32),
    settings: &OrbitSettings,
) -> Result<Option<PeriodicSolution>, OrbitError> {
    let segments = match settings.segments {
        Segments::Automatic => 1,
        Segments::Fixed(count) => count.max(1),
    };
    let integrator = integrator(system, response, settings)?;
    let shape = (frequency_hz, period_multiple, segments);
    let Ok((solution, mut problem)) = orbit_near(integrator, state, shape, settings) else { return Ok(None) };
    let scale = problem.scale().clone();
    Ok(has_minimal_period(problem.integrator(), &scale, &solution)?.then_some(solution))
}
