//! The first orbit of a branch: from the linear response and from simulation.

use hammerbeam_motion::{Stretch, System, exact::ExactIntegrator, start_reach};

use crate::{
    OrbitError, OrbitSettings, PeriodicSolution, Response, Segments,
    cut::search_cut,
    noise::Noise,
    permitted_start::in_front,
    size::scale_from,
    solve::{has_minimal_period, integrator, nodes_from, orbit_near},
    state_scale::state_scale,
};

/// Excitation periods simulated between two attempts of Newton's method.
const PERIODS: usize = 64;
/// Attempts per start.
const ATTEMPTS: usize = 12;
/// Starts besides the linear response.
pub(crate) const STARTS: usize = 6;

/// Distance over an orbit period, relative to the motion, below which it has settled: what Newton's method
/// does not find there, it will not find later.
pub(crate) const SETTLED: f64 = 1e-8;
/// Longest period that is looked for, in excitation periods.
const MOST_PERIODS: u32 = 64;

/// How much motion a search for a start may spend.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Effort {
    /// States from which the motion begins, the linear response among them.
    pub starts: usize,
    /// Attempts of Newton's method along each motion.
    pub attempts: usize,
}

impl Effort {
    /// What [`find_start`] spends.
    pub const FULL: Self = Self { starts: STARTS + 1, attempts: ATTEMPTS };
}

/// Asked now and then: true if the caller wants the search to end.
pub type Interruption<'a> = &'a mut dyn FnMut() -> bool;

/// Finds one orbit whose minimal period is `period_multiple` excitation periods.
///
/// The motion is simulated from the linear response and from several states about it; now and then Newton's
/// method is tried.
///
/// # Errors
/// [`OrbitError::NoOrbit`] if no start leads to such an orbit; [`OrbitError::Motion`] if none does and some
/// motion could not be computed; [`OrbitError::PeriodMultiple`] unless the multiple is from 1 to 64.
pub fn find_start(
    system: &System,
    response: &Response,
    frequency_hz: f64,
    period_multiple: u32,
    settings: &OrbitSettings,
) -> Result<PeriodicSolution, OrbitError> {
    find_start_unless(system, response, (frequency_hz, period_multiple), settings, &mut || false)
}

/// [`find_start`], unless it is interrupted.
///
/// # Errors
/// Those of [`find_start`], and [`OrbitError::Interrupted`].
pub fn find_start_unless(
    system: &System,
    response: &Response,
    (frequency_hz, period_multiple): (f64, u32),
    settings: &OrbitSettings,
    interrupted: Interruption<'_>,
) -> Result<PeriodicSolution, OrbitError> {
    search_start(system, response, (frequency_hz, period_multiple), Effort::FULL, settings, interrupted)
}

/// [`find_start_unless`] with a given effort.
pub(crate) fn search_start(
    system: &System,
    response: &Response,
    (frequency_hz, period_multiple): (f64, u32),
    effort: Effort,
    settings: &OrbitSettings,
    interrupted: Interruption<'_>,
) -> Result<PeriodicSolution, OrbitError> {
    check_multiple(period_multiple)?;
    let mut failure = OrbitError::NoOrbit { frequency_hz, period_multiple, starts: effort.starts };
    for start in starting_states(system, response, frequency_hz, effort.starts - 1, settings)? {
        let orbit = (frequency_hz, period_multiple);
        match settle(system, response, (&start, effort.attempts), orbit, settings, &mut *interrupted) {
            Ok(Some(solution)) => return Ok(solution),
            Ok(None) => {}
            Err(error @ (OrbitError::Motion(_) | OrbitError::NeverOpens { .. })) => failure = error,
            Err(error) => return Err(error),
        }
    }
    Err(failure)
}

/// # Errors
/// [`OrbitError::PeriodMultiple`].
pub(crate) fn check_multiple(found: u32) -> Result<(), OrbitError> {
    let most = MOST_PERIODS;
    if (1..=most).contains(&found) { Ok(()) } else { Err(OrbitError::PeriodMultiple { found, most }) }
}

/// The linear response, and states in its neighbourhood and well beyond it and the gaps, always the same
/// ones. A state within a contact in which no motion may start is moved in front of it.
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
    let mut noise = Noise::new(0);
    let n = system.dof();
    let speed = scale.values()[n];
    let mut states = vec![linear.clone()];
    for start in 0..starts {
        let reach = start_reach(system, frequency_hz, speed, start) / speed;
        // Low modes move most: their share falls with the order of the mode.
        let add = |i: usize, noise: f64| scale.values()[i] * reach * noise / (1 + i % n) as f64;
        states.push((0..2 * n).map(|i| linear[i] + add(i, noise.signed())).collect());
    }
    if system.remembers_impacts() {
        for state in &mut states {
            *state = in_front(system, frequency_hz, state);
        }
    }
    Ok(states)
}

/// The orbit of that minimal period on which a motion moves that has settled, given by its state at phase 0;
/// `None` if Newton's method does not converge, or does to an orbit of a shorter period.
///
/// # Errors
/// [`OrbitError::Motion`] if the motion cannot be computed; [`OrbitError::PeriodMultiple`] unless the
/// multiple is from 1 to 64.
pub fn settled_orbit(
    system: &System,
    response: &Response,
    state: &[f64],
    orbit: (f64, u32),
    settings: &OrbitSettings,
) -> Result<Option<PeriodicSolution>, OrbitError> {
    check_multiple(orbit.1)?;
    let mut motion = integrator(system, response, settings)?;
    let (start, _) = search_cut(&mut motion, state, orbit)?;
    attempt(system, response, start.at(), orbit, settings)
}

/// Simulates from `state` and tries Newton's method now and then, until an orbit is found or the motion has
/// settled on one of another period.
fn settle(
    system: &System,
    response: &Response,
    (state, attempts): (&[f64], usize),
    orbit: (f64, u32),
    settings: &OrbitSettings,
    interrupted: Interruption<'_>,
) -> Result<Option<PeriodicSolution>, OrbitError> {
    let (frequency_hz, lag) = (orbit.0, orbit.1 as usize);
    let mut simulation = integrator(system, response, settings)?;
    let mut state = state.to_vec();
    for _ in 0..attempts {
        if interrupted() {
            return Err(OrbitError::Interrupted);
        }
        let settling = (frequency_hz, PERIODS.saturating_sub(lag));
        simulate(&mut simulation, &mut state, settling, &mut *interrupted)?;
        let before = state.clone();
        simulate(&mut simulation, &mut state, (frequency_hz, lag.min(PERIODS)), &mut *interrupted)?;
        // With an impact-speed-dependent law the orbit may start at another phase, and the motion goes on
        // behind it.
        let (start, end) = search_cut(&mut simulation, &state, orbit)?;
        let found = attempt(system, response, start.at(), orbit, settings)?;
        if found.is_some() {
            return Ok(found);
        }
        let (scale, _) = scale_from(&mut simulation, &state, frequency_hz)?;
        if scale.distance(&before, &state) < SETTLED {
            return Ok(None);
        }
        state = end.unwrap_or(state);
    }
    Ok(None)
}

/// Advances a state by whole excitation periods, at each of which the caller may interrupt.
pub(crate) fn simulate(
    integrator: &mut ExactIntegrator,
    state: &mut Vec<f64>,
    (frequency_hz, periods): (f64, usize),
    interrupted: Interruption<'_>,
) -> Result<(), OrbitError> {
    let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
    for _ in 0..periods {
        if interrupted() {
            return Err(OrbitError::Interrupted);
        }
        *state = integrator.advance(&stretch, state)?;
    }
    Ok(())
}

/// Newton's method from a state at a phase; `None` if it does not converge, or does to an orbit of a shorter
/// period.
pub(crate) fn attempt(
    system: &System,
    response: &Response,
    start: (f64, &[f64]),
    (frequency_hz, period_multiple): (f64, u32),
    settings: &OrbitSettings,
) -> Result<Option<PeriodicSolution>, OrbitError> {
    let segments = match settings.segments {
        Segments::Automatic => 1,
        Segments::Fixed(count) => count.max(1),
    };
    let mut motion = integrator(system, response, settings)?;
    let nodes = nodes_from(&mut motion, start, frequency_hz, period_multiple, segments)?;
    attempt_nodes(system, response, (start.0, &nodes), (frequency_hz, period_multiple), settings)
}

/// Newton's method from nodes, one per segment, the first at that phase; `None` as in [`attempt`].
///
/// Far from an orbit Newton's iterates may go where no motion can be computed: that is no more than a guess
/// that was not good enough.
pub(crate) fn attempt_nodes(
    system: &System,
    response: &Response,
    nodes: (f64, &[Vec<f64>]),
    orbit: (f64, u32),
    settings: &OrbitSettings,
) -> Result<Option<PeriodicSolution>, OrbitError> {
    let integrator = integrator(system, response, settings)?;
    let (solution, mut problem) = match orbit_near(integrator, nodes, orbit, settings) {
        Ok(found) => found,
        Err(OrbitError::NotConverged { .. } | OrbitError::Motion(_) | OrbitError::Eigenvalues(_)) => {
            return Ok(None);
        }
        Err(error) => return Err(error),
    };
    let scale = problem.scale().clone();
    Ok(has_minimal_period(problem.integrator(), &scale, &solution)?.then_some(solution))
}
