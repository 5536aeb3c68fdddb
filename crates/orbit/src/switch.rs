//! Leaving a branch where another one crosses it: at a flip onto the branch of doubled period, at a
//! branch point onto the crossing one. Equation (P9) of the book, `docs/theory`.
//!
//! At a flip with multiplier -1 and direction `v` the orbit of doubled period is `z + a v + O(a^2)`; at a
//! branch point the crossing branch leaves along its tangent `v`. The first orbit is sought in the plane `<v,
//! z - z_0> = a`, normal to `v` at a small amplitude `a`: the present branch does not lie in that plane, so
//! Newton's method cannot fall back to it. `v` is carried along the orbit by the flow, so that it serves any
//! number of segments; over the second half of a doubled orbit it comes with the other sign by itself. From
//! `z_0 + a v` the orbit found differs by `O(a^2)` in its states and in its frequency; if either differs by
//! more than `a`, relatively, another amplitude is tried. So it is where a contact more or less shows that a
//! grazing lies between the crossing and the orbit found; if it does at all amplitudes, the smallest counts.

use hammerbeam_motion::{Stretch, System, exact::ExactIntegrator};
use hammerbeam_path::{Follower, Judge, ParameterRange, PathProblem, StartDirection, norm};

use crate::{
    BranchWalk, OrbitError, OrbitSettings, PeriodicSolution, Response, Side,
    shooting::ShootingProblem,
    size::orbit_scale,
    solve::{evaluate, integrator, solution},
    walk::{OrbitPath, length_per_norm, path_settings},
};

/// Amplitudes of the first orbit relative to the orbit, tried one after the other.
const AMPLITUDES: [f64; 6] = [1e-3, 1e-4, 1e-2, 1e-5, 1e-6, 1e-7];

/// Those at which a contact more or less may show: beyond, it was another branch, and nearer, rounding.
const BESIDE_GRAZING: std::ops::RangeInclusive<f64> = 1e-5..=1e-3;

/// An orbit of doubled period is at least so many amplitudes from one of the period that was doubled.
const OWN: f64 = 0.1;

/// Where a branch leaves another one.
#[derive(Debug, Clone, PartialEq)]
pub struct Crossing {
    /// The orbit at the event, with the number of excitation periods that it has on the present branch.
    pub orbit: PeriodicSolution,
    /// [`crate::LocatedEvent::direction`].
    pub direction: Vec<f64>,
    /// Periods of the new branch over the periods of the present one: 2 at a flip, 1 at a branch point.
    pub factor: u32,
}

impl BranchWalk {
    /// Begins on the branch that leaves a crossing, and walks away from it: along the direction
    /// ([`Side::Up`]) or against it.
    ///
    /// # Errors
    /// [`OrbitError::NoCrossing`] if no orbit of another branch is found beside the crossing.
    pub fn from_crossing(
        system: &System,
        response: &Response,
        crossing: &Crossing,
        side: Side,
        range: (f64, f64),
        settings: &OrbitSettings,
    ) -> Result<Self, OrbitError> {
        let frequency_hz = crossing.orbit.frequency_hz;
        let none = OrbitError::NoCrossing { frequency_hz };
        if crossing.direction.len() != crossing.orbit.nodes[0].len() + 1 {
            return Err(none);
        }
        let mut other: Option<(f64, Self)> = None;
        for amplitude in AMPLITUDES {
            let signed = if side == Side::Up { amplitude } else { -amplitude };
            match leave(system, response, crossing, signed, range, settings)? {
                Some((walk, true)) => return Ok(walk),
                // The nearer it is, the less else was stepped over.
                Some((walk, false))
                    if BESIDE_GRAZING.contains(&amplitude)
                        && other.as_ref().is_none_or(|(farther, _)| amplitude < *farther) =>
                {
                    other = Some((amplitude, walk));
                }
                _ => {}
            }
        }
        other.map(|(_, walk)| walk).ok_or(none)
    }

    /// The solution at the present point.
    ///
    /// # Errors
    /// See [`OrbitError`].
    pub fn present(&mut self) -> Result<PeriodicSolution, OrbitError> {
        evaluate(&mut self.path.problem, &self.path.follower.current().point)?;
        Ok(self.record.row(&mut self.path)?.solution)
    }

    /// The flip at the present point, at which the problem was evaluated last, as a place to leave from;
    /// `None` where there is none.
    pub(crate) fn flip_here(&mut self) -> Result<Option<Crossing>, OrbitError> {
        if self.path.current().events.zeros & 1 == 0 {
            return Ok(None);
        }
        let row = self.record.row(&mut self.path)?;
        let Some(located) = row.located.filter(|located| !located.direction.is_empty()) else {
            return Ok(None);
        };
        Ok(Some(Crossing { orbit: row.solution, direction: located.direction, factor: 2 }))
    }
}

impl Crossing {
    /// The orbit at the crossing as an orbit of the new branch, with its periods.
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if its motion cannot be computed.
    pub fn root(
        &self,
        system: &System,
        response: &Response,
        settings: &OrbitSettings,
    ) -> Result<PeriodicSolution, OrbitError> {
        let mut integrator = integrator(system, response, settings)?;
        let (frequency_hz, multiple) = (self.orbit.frequency_hz, self.orbit.period_multiple * self.factor);
        let (segments, phase) = (self.orbit.nodes.len() * self.factor as usize, self.orbit.phase);
        let nodes = vec![self.orbit.nodes.as_slice(); self.factor as usize].concat();
        let scale = orbit_scale(&mut integrator, &self.orbit)?;
        let mut problem =
            ShootingProblem::new(integrator, (multiple, segments), scale, 1.0).starting_at(phase);
        let point = problem.point(&nodes, frequency_hz);
        evaluate(&mut problem, &point)?;
        solution(&mut problem, &point, self.orbit.error_estimate)
    }
}

/// A walk from the orbit of this amplitude beside the crossing, and whether that orbit has the contacts of
/// the crossing, so that none was stepped over; `None` if Newton's method does not find it nearby.
fn leave(
    system: &System,
    response: &Response,
    crossing: &Crossing,
    amplitude: f64,
    range: (f64, f64),
    settings: &OrbitSettings,
) -> Result<Option<(BranchWalk, bool)>, OrbitError> {
    let orbit = &crossing.orbit;
    let (multiple, segments) =
        (orbit.period_multiple * crossing.factor, orbit.nodes.len() * crossing.factor as usize);
    let mut integrator = integrator(system, response, settings)?;
    let cut =
        Cut { frequency_hz: orbit.frequency_hz, phase: orbit.phase, period_multiple: multiple, segments };
    let Carried { nodes, slopes } = carry(&mut integrator, &orbit.nodes[0], &crossing.direction, &cut)?;
    let scale = orbit_scale(&mut integrator, orbit)?;
    let length = length_per_norm(range);
    let mut problem =
        ShootingProblem::new(integrator, (multiple, segments), scale, length).starting_at(orbit.phase);
    if settings.locates_stability_changes {
        problem.watch_stability();
    }
    let base = problem.point(&nodes, orbit.frequency_hz);
    if evaluate(&mut problem, &base).is_err() {
        return Ok(None);
    }
    let signature = problem.signature();
    let direction = problem.point(&slopes, crossing.direction[crossing.direction.len() - 1]);
    let reach = amplitude * length;
    let unit = 1.0 / norm(problem.weights(), &direction);
    let start: Vec<f64> = base.iter().zip(&direction).map(|(z, d)| z + reach * unit * d).collect();
    let away: Vec<f64> = direction.iter().map(|d| d * reach.signum()).collect();
    let within = ParameterRange::new(range.0, range.1)?;
    let along = StartDirection::Along(&away);
    let Ok(follower) =
        Follower::start(&mut problem, &start, along, within, path_settings(settings, system, length))
    else {
        return Ok(None);
    };
    // An orbit of doubled period is some two amplitudes from itself half of it later. Beside a grazing the
    // critical direction need not be one of a multiplier at -1, and then Newton's method may find the orbit
    // that flips, gone through twice.
    if crossing.factor > 1
        && problem.distance_to_shorter_period(&follower.current().point) < OWN * reach.abs()
    {
        return Ok(None);
    }
    let same_contacts = follower.current().signature == signature;
    let current = &follower.current().point;
    let last = current.len() - 1;
    let squares = (0..last).map(|i| (current[i] - start[i]).powi(2));
    let weight = problem.weights()[0];
    let away_in_states = (weight * squares.sum::<f64>()).sqrt();
    let away_in_frequency = (current[last] - start[last]).abs() / orbit.frequency_hz;
    if away_in_states > reach.abs() || away_in_frequency > amplitude.abs() {
        return Ok(None);
    }
    problem.note_symmetry(current);
    let path = OrbitPath::new(problem, follower, (settings, range));
    let mut walk = BranchWalk::of(path, orbit.maxima.displacement, response);
    walk.starts_with_present = true;
    Ok(Some((walk, same_contacts)))
}

/// How an orbit is cut.
struct Cut {
    frequency_hz: f64,
    phase: f64,
    period_multiple: u32,
    segments: usize,
}

/// States and their changes at the nodes of an orbit.
struct Carried {
    nodes: Vec<Vec<f64>>,
    slopes: Vec<Vec<f64>>,
}

/// The state and its change (with the change of the frequency as last entry) at the nodes of an orbit.
fn carry(
    integrator: &mut ExactIntegrator,
    state: &[f64],
    direction: &[f64],
    cut: &Cut,
) -> Result<Carried, OrbitError> {
    let size = state.len();
    let by_frequency = direction[size];
    let phase = |k: usize| cut.phase + f64::from(cut.period_multiple) * k as f64 / cut.segments as f64;
    let (mut nodes, mut slopes) = (vec![state.to_vec()], vec![direction[..size].to_vec()]);
    for k in 1..cut.segments {
        let stretch = Stretch { frequency_hz: cut.frequency_hz, start: phase(k - 1), end: phase(k) };
        let flow = integrator.flow(&stretch, &nodes[k - 1])?;
        let before = &slopes[k - 1];
        let carried = |i: usize| (0..size).map(|j| flow.by_state[(i, j)] * before[j]).sum::<f64>();
        slopes.push((0..size).map(|i| carried(i) + flow.by_frequency[i] * by_frequency).collect());
        nodes.push(flow.state);
    }
    Ok(Carried { nodes, slopes })
}
