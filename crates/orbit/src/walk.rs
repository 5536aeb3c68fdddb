//! Walking along a branch of periodic orbits, one row at a time.

mod between;
mod chatter;
mod density;
mod effort;
mod end;
mod growth;
mod half_orbit;
mod halves;
mod last_motion;
mod last_rows;
mod lost_start;
mod orbit_path;
mod refine;
mod reopening;
mod resegment;
mod row;
mod settings;
mod shorter_period;
mod start_phase;
mod stepping;
mod symmetric;
mod together;

use hammerbeam_motion::{System, exact::MotionError};
use hammerbeam_path::{Follower, ParameterRange, StartDirection};

use crate::{
    BranchRow, OrbitError, OrbitSettings, PeriodicSolution, Response, Side,
    continuation_parameter::ContinuationParameter,
    shooting::ShootingProblem,
    size::{Cut, orbit_scale},
    solve::{evaluate, integrator, nodes_of},
};
pub(crate) use effort::{Effort, counted_operations};
pub(crate) use growth::Growth;
pub(crate) use last_rows::{LastRows, RowPlace};
pub(crate) use orbit_path::{OrbitPath, Origin};
pub(crate) use row::RowRecord;
use settings::segment_count;
pub(crate) use settings::{length_per_norm, path_settings};

/// One side of a branch, followed from its start.
///
/// Drive it with [`BranchWalk::step`] until it gives a [`StopReason`]. Between two steps it can be stored
/// with [`BranchWalk::checkpoint`] and taken up again with [`BranchWalk::resume`]: what follows has the same
/// bits.
#[derive(Debug)]
pub struct BranchWalk {
    pub(crate) path: OrbitPath,
    pub(crate) record: RowRecord,
    /// Of the amplitude, while the parameter stands still.
    pub(crate) growth: Growth,
    pub(crate) effort: Effort,
    /// The present point is still to be given as a row: the walk has left a crossing.
    pub(crate) starts_with_present: bool,
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
    /// Begins at `start` and walks to `side` within `range`.
    ///
    /// # Errors
    /// [`OrbitError::Path`] if the start is outside the range or does not converge.
    pub fn new(
        system: &System,
        response: &Response,
        start: &PeriodicSolution,
        side: Side,
        range: (f64, f64),
        settings: &OrbitSettings,
    ) -> Result<Self, OrbitError> {
        let varied = ContinuationParameter::Frequency;
        Self::varying(system, response, start, (varied, side, range), settings)
    }

    /// Begins at `start`, an orbit of `system` as it is, and walks in another parameter than the frequency
    /// within its range.
    ///
    /// * `(varied, side, range)`: what varies, whether it increases or decreases at first, and its range, in
    ///   its own unit.
    ///
    /// # Errors
    /// [`OrbitError::Path`] if the start is outside the range or does not converge, [`OrbitError::Motion`] if
    /// the system has no such parameter.
    pub fn varying(
        system: &System,
        response: &Response,
        start: &PeriodicSolution,
        (varied, side, range): (ContinuationParameter, Side, (f64, f64)),
        settings: &OrbitSettings,
    ) -> Result<Self, OrbitError> {
        let mut integrator = integrator(system, response, settings)?;
        let scale = orbit_scale(&mut integrator, start)?;
        let (frequency, multiple) = (start.frequency_hz, start.period_multiple);
        let segments = segment_count(system, start, settings);
        let nodes = nodes_of(&mut integrator, &Cut::of(start), segments)?;
        let length = length_per_norm(range);
        let mut problem =
            ShootingProblem::new(integrator, (multiple, segments), scale, length).starting_at(start.phase);
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
            Side::Up => StartDirection::Increasing,
            Side::Down => StartDirection::Decreasing,
        };
        let within = ParameterRange::new(range.0, range.1)?;
        let path = path_settings(settings, system, length);
        let started = Follower::start(&mut problem, &point, direction, within, path);
        let follower = started.map_err(|error| problem.failure_or(error))?;
        problem.note_symmetry(&follower.current().point);
        let path = OrbitPath::new(problem, follower, (settings, range));
        Ok(Self::of(path, start.maxima.displacement, response))
    }

    /// A walk at its start, whose maximum displacement is given.
    pub(crate) fn of(path: OrbitPath, displacement: f64, response: &Response) -> Self {
        let record = RowRecord::at_start(&path, displacement, &response.shape);
        let (growth, effort) = (Growth::default(), Effort::default());
        Self { path, record, growth, effort, starts_with_present: false }
    }

    /// The row of the start, to be taken before the first step.
    ///
    /// # Errors
    /// See [`OrbitError`].
    pub fn start_row(&mut self) -> Result<BranchRow, OrbitError> {
        evaluate(&mut self.path.problem, &self.path.follower.current().point)?;
        let mut row = self.record.row(&mut self.path)?;
        row.events.start = true;
        Ok(row)
    }

    /// Excitation periods of an orbit.
    pub(crate) fn period_multiple(&self) -> u32 {
        self.path.problem.period_multiple()
    }

    /// Why the motion could not be computed at the last evaluation, if so.
    pub(crate) fn motion_failure(&self) -> Option<OrbitError> {
        self.path.motion_failure()
    }

    /// Operations since the start of the walk (`effort.rs`).
    pub(crate) fn operations(&self) -> u64 {
        self.effort.operations(counted_operations(&self.path, self.evaluations()))
    }

    /// Shooting evaluations since the start of the walk.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.path.follower.counters().evaluations + self.record.evaluations_between
    }
}
