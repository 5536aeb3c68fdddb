//! One periodic orbit: Newton's method at a fixed frequency, and what is stored of a converged orbit.

use hammerbeam_motion::{
    Stretch, System,
    exact::{ExactIntegrator, ExactSettings, MotionError},
};
use hammerbeam_path::{PathProblem, SingularJacobian, norm};

use crate::{
    OrbitError, OrbitMaxima, OrbitSettings, PeriodicSolution, Response,
    shooting::ShootingProblem,
    size::Cut,
    spectrum::{Spectrum, largest_modulus},
    state_scale::StateScale,
};

const MAX_ITERATIONS: u32 = 25;
/// Scale of an orbit over the scale of its guess, below which the guess is too coarse a measure of the error.
const COARSE: f64 = 0.5;
/// So often the scale is fitted to where Newton's method has come, at most. From deep within a hard contact
/// it begins at a million times the size of the orbit; what shrinks on and on has none.
const MOST_SCALES: u32 = 16;
/// After so many iterations,
const MANY: u32 = 12;
/// a correction that is still larger than this, relative to the orbit, means that there is no progress from
/// the guess.
const STILL_FAR: f64 = 0.3;
/// The same number of iterations where only an orbit near the guess is wanted.
const FEW: u32 = 6;
/// Where two corrections after one another are as small as this, relative to the orbit,
const NEAR: f64 = 0.03;
/// and a multiplier at both places is as large as this, the orbit is taken for an unstable one. Nothing
/// proves it: beside a stiff stop one more contact may make such a multiplier. What is lost so is one of many
/// guesses.
const FAR_OUTSIDE: f64 = 2.0;

/// A segment that takes so many times as many force steps as the whole guess,
const ASTRAY: u64 = 20;
/// and at least so many, is not on the way to an orbit: what goes on far away, in a force that grows with a
/// power, may take all that a motion may take.
const LEAST_ASTRAY: u64 = 4000;

/// Which orbits Newton's method is to find.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wanted {
    /// Whichever it comes to.
    Any,
    /// Whichever is near the guess: it ends early where it is still far from one.
    Nearby,
    /// Stable ones near the guess: it ends early where it comes to none.
    StableNearby,
}

impl Wanted {
    /// Whether Newton's method, whose problem was evaluated last at the point before this correction, need
    /// not go on.
    ///
    /// * `unstable`: how often in a row the points before were near an unstable orbit.
    fn is_out_of_reach(
        self,
        problem: &mut ShootingProblem,
        (iterations, correction): (u32, f64),
        unstable: &mut u32,
    ) -> bool {
        let patience = if self == Self::Any { MANY } else { FEW };
        if iterations >= patience && correction > STILL_FAR {
            return true;
        }
        let is_unstable = self == Self::StableNearby
            && correction <= NEAR
            && problem.multipliers().is_ok_and(|multipliers| largest_modulus(multipliers) >= FAR_OUTSIDE);
        *unstable = if is_unstable { *unstable + 1 } else { 0 };
        *unstable >= 2
    }
}

/// An integrator of the system that observes the response.
pub(crate) fn integrator(
    system: &System,
    response: &Response,
    settings: &OrbitSettings,
) -> Result<ExactIntegrator, OrbitError> {
    let motion = ExactSettings { tolerance: settings.motion_tolerance };
    let watched = Some((response.shape.as_slice(), response.support_ratios.as_slice()));
    Ok(ExactIntegrator::watching(system.clone(), motion, watched)?)
}

/// Newton's method at a fixed frequency from `point`, which ends at the orbit; returns the correction that is
/// still due.
pub(crate) fn correct(
    problem: &mut ShootingProblem,
    point: &mut [f64],
    settings: &OrbitSettings,
) -> Result<f64, OrbitError> {
    correct_wanted(problem, point, (Wanted::Any, settings))
}

fn correct_wanted(
    problem: &mut ShootingProblem,
    point: &mut [f64],
    (wanted, settings): (Wanted, &OrbitSettings),
) -> Result<f64, OrbitError> {
    let last = point.len() - 1;
    let mut row = vec![0.0; point.len()];
    row[last] = 1.0;
    correct_wanted_in_plane(problem, point, (&row, wanted), settings)
}

/// Newton's method at a fixed frequency from a guess, whose scale the problem has; the point of the orbit and
/// the correction that is still due, relative to the orbit.
pub(crate) fn approach(
    problem: &mut ShootingProblem,
    nodes: &[Vec<f64>],
    frequency_hz: f64,
    (wanted, settings): (Wanted, &OrbitSettings),
) -> Result<(Vec<f64>, f64), OrbitError> {
    let mut point = problem.point(nodes, frequency_hz);
    let mut correction = f64::INFINITY;
    for _ in 0..MOST_SCALES {
        correction = correct_wanted(problem, &mut point, (wanted, settings))?;
        // The whole motion is not much smaller than its nodes.
        if problem.size(&point) > COARSE {
            return Ok((point, correction));
        }
        let reached = problem.nodes(&point);
        let (phase, period_multiple) = (problem.phase(), problem.period_multiple());
        let orbit = Cut { phase, nodes: &reached, frequency_hz, period_multiple };
        let scale = problem.scale().clone();
        let factor = orbit.size(problem.integrator(), &scale)?;
        if factor > COARSE || factor == 0.0 {
            return Ok((point, correction));
        }
        // A guess far larger than the orbit has measured the error too coarsely.
        problem.rescale(&vec![factor; problem.node_size()]);
        point = problem.point(&reached, frequency_hz);
    }
    Err(OrbitError::NotConverged { frequency_hz, correction, iterations: MOST_SCALES * MAX_ITERATIONS })
}

/// Newton's method in the plane with this border through `point`, which ends at the orbit; returns the
/// correction that is still due.
pub(crate) fn correct_in_plane(
    problem: &mut ShootingProblem,
    point: &mut [f64],
    row: &[f64],
    settings: &OrbitSettings,
) -> Result<f64, OrbitError> {
    correct_wanted_in_plane(problem, point, (row, Wanted::Any), settings)
}

fn correct_wanted_in_plane(
    problem: &mut ShootingProblem,
    point: &mut [f64],
    (row, wanted): (&[f64], Wanted),
    settings: &OrbitSettings,
) -> Result<f64, OrbitError> {
    let found = iterate(problem, point, (row, wanted), settings);
    problem.integrator().limit_steps(None);
    found
}

/// Newton's method; from the second iteration on the integrator has a limit of its steps.
fn iterate(
    problem: &mut ShootingProblem,
    point: &mut [f64],
    (row, wanted): (&[f64], Wanted),
    settings: &OrbitSettings,
) -> Result<f64, OrbitError> {
    let mut unstable = 0;
    let steps_before = problem.counts().steps;
    let mut limit = u64::MAX;
    let frequency_hz = problem.frequency(point);
    let mut correction = f64::INFINITY;
    for iterations in 1..=MAX_ITERATIONS {
        let failed = OrbitError::NotConverged { frequency_hz, correction, iterations };
        let made = newton_update(problem, point, row);
        if iterations == 1 {
            limit = LEAST_ASTRAY.max(ASTRAY * (problem.counts().steps - steps_before));
            problem.integrator().limit_steps(Some(limit));
        }
        if is_astray(&made, limit) {
            return Err(failed);
        }
        let update;
        (update, correction) = made?;
        if !correction.is_finite() || wanted.is_out_of_reach(problem, (iterations, correction), &mut unstable)
        {
            return Err(failed);
        }
        if correction <= settings.tolerance {
            return Ok(correction);
        }
        // A guess that is far off is approached in steps as large as the motion itself.
        let factor = (1.0 / correction).min(1.0);
        point.iter_mut().zip(&update).for_each(|(x, u)| *x += factor * u);
    }
    Err(OrbitError::NotConverged { frequency_hz, correction, iterations: MAX_ITERATIONS })
}

/// Whether a motion was given up at this number of steps.
fn is_astray<T>(made: &Result<T, OrbitError>, limit: u64) -> bool {
    matches!(made, Err(OrbitError::Motion(MotionError::TooManySteps { steps, .. })) if *steps == limit)
}

/// Newton's correction at a point in the plane with this border, and its norm; the problem was then evaluated
/// last there.
pub(crate) fn newton_update(
    problem: &mut ShootingProblem,
    point: &[f64],
    row: &[f64],
) -> Result<(Vec<f64>, f64), OrbitError> {
    evaluate(problem, point)?;
    let frequency_hz = problem.frequency(point);
    let failed = OrbitError::NotConverged { frequency_hz, correction: f64::INFINITY, iterations: 0 };
    update_here(problem, row).map_err(|_| failed)
}

/// The same at the point at which the problem was evaluated last.
pub(crate) fn update_here(
    problem: &mut ShootingProblem,
    row: &[f64],
) -> Result<(Vec<f64>, f64), SingularJacobian> {
    problem.factorise(row)?;
    let mut update: Vec<f64> = problem.residual().iter().map(|r| -r).chain([0.0]).collect();
    problem.solve(&mut update);
    let size = norm(problem.weights(), &update);
    Ok((update, size))
}

/// Evaluates the problem and keeps the reason of a failure.
pub(crate) fn evaluate(problem: &mut ShootingProblem, point: &[f64]) -> Result<(), OrbitError> {
    if problem.evaluate(point).is_ok() {
        return Ok(());
    }
    let frequency_hz = problem.frequency(point);
    let unknown = OrbitError::NotConverged { frequency_hz, correction: f64::INFINITY, iterations: 0 };
    Err(problem.failure().map_or(unknown, |failure| OrbitError::Motion(failure.clone())))
}

/// The solution at the point where the problem was evaluated last.
pub(crate) fn solution(
    problem: &mut ShootingProblem,
    point: &[f64],
    error_estimate: f64,
) -> Result<PeriodicSolution, OrbitError> {
    let frequency_hz = problem.frequency(point);
    problem.move_to(point)?;
    let Spectrum { multipliers, on_circle, .. } = problem.spectrum()?.clone();
    let residual = problem.residual().iter().fold(0.0_f64, |largest, r| largest.max(r.abs()));
    let phase = problem.phase().fract();
    let nodes = problem.nodes(point);
    let stretches: Vec<Stretch> = (0..nodes.len()).map(|k| problem.stretch(k, frequency_hz)).collect();
    let mut maxima = observe(problem.integrator(), &stretches, &nodes)?;
    maxima.contacts = maxima.contacts.saturating_add_signed(problem.touches_lacking().iter().sum());
    Ok(PeriodicSolution {
        frequency_hz,
        period_multiple: problem.period_multiple(),
        phase,
        nodes,
        floquet_multipliers: multipliers,
        on_circle,
        residual,
        error_estimate,
        maxima,
    })
}

/// Maxima of an orbit over its segments.
pub(crate) fn observe(
    integrator: &mut ExactIntegrator,
    stretches: &[Stretch],
    nodes: &[Vec<f64>],
) -> Result<OrbitMaxima, OrbitError> {
    let motion: Vec<(Stretch, &[f64])> =
        stretches.iter().copied().zip(nodes.iter().map(Vec::as_slice)).collect();
    Ok(integrator.observe(&motion)?.into())
}

/// Nodes at equal phases of the motion from `state` at the phase `start`.
pub(crate) fn nodes_from(
    integrator: &mut ExactIntegrator,
    (phase, state): (f64, &[f64]),
    frequency_hz: f64,
    period_multiple: u32,
    segments: usize,
) -> Result<Vec<Vec<f64>>, OrbitError> {
    let nodes = &[state.to_vec()];
    nodes_of(integrator, &Cut { phase, nodes, frequency_hz, period_multiple }, segments)
}

/// Nodes of a motion at so many equal phases, at least one, each from the given one at or before it: they lie
/// on an orbit also where it is left fast.
pub(crate) fn nodes_of(
    integrator: &mut ExactIntegrator,
    cut: &Cut<'_>,
    segments: usize,
) -> Result<Vec<Vec<f64>>, OrbitError> {
    let (count, periods) = (cut.nodes.len(), f64::from(cut.period_multiple));
    // In parts of a period of which both the given nodes and the new ones are whole numbers.
    let phase = |part: usize| cut.phase + periods * part as f64 / (count * segments) as f64;
    let mut nodes: Vec<Vec<f64>> = Vec::with_capacity(segments);
    for k in 0..segments {
        let (given, at) = (k * count / segments, k * count);
        let (from, state) = match nodes.last() {
            Some(last) if (k - 1) * count > given * segments => ((k - 1) * count, last),
            _ => (given * segments, &cut.nodes[given]),
        };
        let stretch = Stretch { frequency_hz: cut.frequency_hz, start: phase(from), end: phase(at) };
        nodes.push(if from == at { state.clone() } else { integrator.advance(&stretch, state)? });
    }
    Ok(nodes)
}

/// Whether the orbit closes only after all its excitation periods.
pub(crate) fn has_minimal_period(
    integrator: &mut ExactIntegrator,
    scale: &StateScale,
    solution: &PeriodicSolution,
) -> Result<bool, OrbitError> {
    // What is wrong with the start grows with the multiplier.
    let largest = solution.largest_multiplier();
    let distance = Cut::of(solution).distance_to_shorter_period(integrator, scale)?;
    Ok(distance >= 1e-6 * (1e-3 * largest).max(1.0))
}

/// Corrects an orbit near these nodes, one per segment, the first at that phase, at a fixed frequency.
///
/// # Errors
/// [`OrbitError::NotConverged`] if Newton's method fails, [`OrbitError::Motion`] if the motion does.
pub(crate) fn orbit_near(
    mut integrator: ExactIntegrator,
    (phase, nodes): (f64, &[Vec<f64>]),
    (frequency_hz, period_multiple): (f64, u32),
    settings: &OrbitSettings,
) -> Result<(PeriodicSolution, ShootingProblem), OrbitError> {
    let guess = Cut { phase, nodes, frequency_hz, period_multiple };
    let scale = guess.scale(&mut integrator)?;
    let mut problem =
        ShootingProblem::new(integrator, (period_multiple, nodes.len()), scale, 1.0).starting_at(phase);
    let (point, correction) = approach(&mut problem, nodes, frequency_hz, (Wanted::Any, settings))?;
    let solution = solution(&mut problem, &point, correction)?;
    Ok((solution, problem))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

    use hammerbeam_motion::{Law, law::PowerSpring};

    use super::*;
    use crate::test_oscillator::oscillator;

    /// On the hill of `x'' + 0.1 x' + x - x^3/10 = 1e-3 cos(0.2 pi t)` at `x = sqrt(10)` the larger
    /// multiplier is `exp(10 l)` with `l^2 + 0.1 l - 2 = 0`, 8e5.
    #[test]
    fn nodes_of_an_orbit_that_is_left_fast_lie_on_it() {
        let (system, response) = oscillator(0.1, 1e-3, Law::Power(PowerSpring::cubic(-0.1).unwrap()));
        let settings = OrbitSettings::default();
        let found = |count: usize| {
            let guess = vec![vec![10.0_f64.sqrt(), 0.0]; count];
            let motion = integrator(&system, &response, &settings).unwrap();
            orbit_near(motion, (0.0, &guess), (0.1, 1), &settings).unwrap().0
        };
        let (orbit, other) = (found(12), found(5));
        assert!(orbit.largest_multiplier() > 1e5);
        let mut motion = integrator(&system, &response, &settings).unwrap();
        let apart = |nodes: &[Vec<f64>]| {
            let pairs = nodes.iter().flatten().zip(other.nodes.iter().flatten());
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let nodes = nodes_of(&mut motion, &Cut::of(&orbit), 5).unwrap();
        assert!(nodes.len() == 5 && apart(&nodes) < 1e-9, "{:e}", apart(&nodes));
        let from_first = nodes_from(&mut motion, (0.0, &orbit.nodes[0]), 0.1, 1, 5).unwrap();
        assert!(apart(&from_first) > 1e2 * apart(&nodes), "{:e}", apart(&from_first));
        assert_eq!(nodes_of(&mut motion, &Cut::of(&orbit), 12).unwrap(), orbit.nodes);
    }
}
