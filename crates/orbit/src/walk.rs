//! Walking along a branch of periodic orbits, one row at a time.

mod between;
mod effort;
mod growth;
mod row;
mod settings;
mod shorter_period;
mod splits;
mod stepping;

use hammerbeam_motion::{
    System,
    exact::{ExactIntegrator, MotionError},
};
use hammerbeam_path::{ContinuationPoint, Direction, Follower, ParameterRange};

use crate::{
    OrbitError, OrbitSettings, PeriodicSolution, Response, Side,
    continuation_parameter::ContinuationParameter,
    density::{LastRows, Place},
    recut::Origin,
    shooting::ShootingProblem,
    size::{Cut, orbit_scale},
    solve::{integrator, nodes_from},
    state_scale::StateScale,
};
pub(crate) use between::{Between, outside, spectrum_of};
pub(crate) use effort::Effort;
pub(crate) use growth::Growth;
use settings::segment_count;
pub(crate) use settings::{hertz_per_norm, path_settings};

/// One side of a branch, followed from its start.
///
/// Drive it with [`BranchWalk::step`] until it gives a [`StopReason`]. Between two steps it can be stored
/// with [`BranchWalk::checkpoint`] and taken up again with [`BranchWalk::resume`]: what follows has the same
/// bits.
#[derive(Debug)]
pub struct BranchWalk {
    pub(crate) problem: ShootingProblem,
    pub(crate) follower: Follower,
    /// Accepted points since the last [`BranchWalk::take_journal`].
    pub(crate) journal: Vec<ContinuationPoint>,
    pub(crate) settings: OrbitSettings,
    pub(crate) range_hz: (f64, f64),
    /// Touches of each contact at the row before.
    pub(crate) touches: Vec<u32>,
    /// Least and most number of multipliers outside the unit circle at the row before, once there is one.
    pub(crate) outside: Option<(u32, u32)>,
    /// The present point is still to be given as a row: the walk has left a crossing.
    pub(crate) begins_with_present: bool,
    /// For the density of rows.
    pub(crate) last_rows: LastRows,
    /// Shooting evaluations spent on rows between points of the path.
    pub(crate) evaluations_between: u64,
    /// The start as it was begun, once the phase at which orbits begin has moved.
    pub(crate) origin: Option<Origin>,
    /// Of the amplitude, while the parameter stands still.
    pub(crate) growth: Growth,
    pub(crate) effort: Effort,
}

/// An orbit that a walk has come to, without its maxima.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Walked {
    pub frequency_hz: f64,
    /// Phase of the first node [cycles].
    pub phase: f64,
    pub nodes: Vec<Vec<f64>>,
}

impl Walked {
    /// That orbit.
    pub fn of(orbit: &PeriodicSolution) -> Self {
        Self { frequency_hz: orbit.frequency_hz, phase: orbit.phase, nodes: orbit.nodes.clone() }
    }
}

impl BranchWalk {
    /// Begins at `start` and walks to `side` within `range_hz`.
    ///
    /// # Errors
    /// [`OrbitError::Path`] if the start is outside the range or does not converge.
    pub fn new(
        system: &System,
        response: &Response,
        start: &PeriodicSolution,
        side: Side,
        range_hz: (f64, f64),
        settings: &OrbitSettings,
    ) -> Result<Self, OrbitError> {
        let varied = ContinuationParameter::Frequency;
        Self::varying(system, response, start, (varied, side, range_hz), settings)
    }

    /// Begins at `start`, an orbit of `system` as it is, and walks in another parameter than the frequency
    /// within its range.
    ///
    /// * `(varied, side, range)`: what varies, whether it increases or decreases at first, and its range, in
    ///   its own unit. Where settings, stop reasons and events speak of hertz, they mean that unit.
    ///
    /// # Errors
    /// [`OrbitError::Path`] if the start is outside the range or does not converge, [`OrbitError::Motion`] if
    /// the system has no such parameter.
    pub fn varying(
        system: &System,
        response: &Response,
        start: &PeriodicSolution,
        (varied, side, range_hz): (ContinuationParameter, Side, (f64, f64)),
        settings: &OrbitSettings,
    ) -> Result<Self, OrbitError> {
        let mut integrator = integrator(system, response, settings)?;
        let scale = orbit_scale(&mut integrator, start)?;
        let (frequency, multiple) = (start.frequency_hz, start.period_multiple);
        let segments = segment_count(system, start, settings);
        let begin = (start.phase, start.nodes[0].as_slice());
        let nodes = nodes_from(&mut integrator, begin, frequency, multiple, segments)?;
        let length = hertz_per_norm(range_hz);
        let mut problem =
            ShootingProblem::new(integrator, (multiple, segments), scale, length).beginning_at(start.phase);
        if settings.locates_stability_changes {
            problem.watch_stability();
        }
        problem.vary(varied)?;
        let value = match varied.parameter() {
            None => frequency,
            Some(parameter) => system.parameter(parameter).map_err(MotionError::from)?,
        };
        let point = problem.point(&nodes, value);
        let direction = match side {
            Side::Up => Direction::Increasing,
            Side::Down => Direction::Decreasing,
        };
        let range = ParameterRange::new(range_hz.0, range_hz.1)?;
        let path = path_settings(settings, system, length);
        let started = Follower::start(&mut problem, &point, direction, range, path);
        let follower = started.map_err(|error| problem.failure_or(error))?;
        Ok(Self::of(problem, follower, start.maxima.displacement, (settings, range_hz)))
    }

    /// A walk at its start, whose maximum displacement is given.
    pub(crate) fn of(
        problem: ShootingProblem,
        follower: Follower,
        displacement: f64,
        (settings, range_hz): (&OrbitSettings, (f64, f64)),
    ) -> Self {
        let journal = vec![follower.current().clone()];
        let touches = problem.touches().to_vec();
        let last_rows = LastRows(vec![Place::new(follower.current(), displacement)]);
        Self {
            problem,
            follower,
            journal,
            settings: *settings,
            range_hz,
            touches,
            outside: None,
            begins_with_present: false,
            last_rows,
            evaluations_between: 0,
            origin: None,
            growth: Growth::default(),
            effort: Effort::default(),
        }
    }

    /// Something about the present orbit in the units of the walk; `None` if its motion cannot be computed.
    fn of_present(
        &mut self,
        ask: impl FnOnce(Cut<'_>, &mut ExactIntegrator, &StateScale) -> Result<f64, MotionError>,
    ) -> Option<f64> {
        let point = &self.follower.current().point;
        self.problem.move_to(point).ok()?;
        let (frequency_hz, nodes) = (self.problem.frequency(point), self.problem.nodes(point));
        let (phase, period_multiple) = (self.problem.phase(), self.problem.period_multiple());
        let scale = self.problem.scale().clone();
        let orbit = Cut { phase, nodes: &nodes, frequency_hz, period_multiple };
        ask(orbit, self.problem.integrator(), &scale).ok()
    }

    /// Excitation periods of an orbit.
    pub(crate) fn period_multiple(&self) -> u32 {
        self.problem.period_multiple()
    }

    /// Why the motion could not be computed at the last evaluation, if so.
    pub(crate) fn motion_failure(&self) -> Option<OrbitError> {
        self.problem.failure().map(|failure| OrbitError::Motion(failure.clone()))
    }

    /// Shooting evaluations since the start of the walk.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.follower.counters().evaluations + self.evaluations_between
    }
}
