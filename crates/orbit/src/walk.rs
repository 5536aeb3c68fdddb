//! Walking along a branch of periodic orbits, one row at a time.

mod row;
mod settings;
mod shorter_period;

use hammerbeam_motion::{
    System,
    exact::{ExactIntegrator, MotionError},
};
use hammerbeam_path::{ContinuationPoint, Direction, Follower, ParameterRange, StepOutcome};

use crate::{
    BranchRow, OrbitError, OrbitSettings, PeriodicSolution, Response, Segments, Side, StopReason,
    continuation_parameter::ContinuationParameter,
    density::{LastRows, Place},
    recut::Origin,
    shooting::ShootingProblem,
    size::{Cut, orbit_scale},
    solve::{evaluate, integrator, nodes_from},
    state_scale::StateScale,
    stop::{Place as Passed, Work},
};
use settings::segment_count;
pub(crate) use settings::{hertz_per_norm, path_settings};

/// An orbit that has become so many times as large or small as the units in which it is measured gets new units.
const OUTGROWN: f64 = 4.0;
/// At every so many accepted points the motion is gone through for its size.
const LOOK: u64 = 8;

/// Growth over a segment, as far as the largest multiplier tells, from which on the orbit is cut into more segments. A segment of 3e6 makes steps
/// of a millionth of a hertz.
const MOST_GROWTH: f64 = 1e4;

/// So often a step that fails is tried again with orbits that begin at another phase.
const MOST_FLIGHTS: u32 = 3;

/// One side of a branch, followed from its start.
///
/// Drive it with [`BranchWalk::step`] until it gives a [`StopReason`]. Between two steps it can be stored with
/// [`BranchWalk::checkpoint`] and taken up again with [`BranchWalk::resume`]: what follows has the same bits.
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
    /// The present point is still to be given as a row: the walk has left a crossing.
    pub(crate) begins_with_present: bool,
    /// For the density of rows.
    pub(crate) last_rows: LastRows,
    /// Shooting evaluations spent on rows between points of the path.
    pub(crate) evaluations_between: u64,
    /// The start as it was begun, once the phase at which orbits begin has moved.
    pub(crate) origin: Option<Origin>,
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

    /// Begins at `start`, an orbit of `system` as it is, and walks in another parameter than the frequency within its range.
    ///
    /// * `(varied, side, range)`: what varies, whether it increases or decreases at first, and its range, in its own unit. Where settings, stop reasons
    ///   and events speak of hertz, they mean that unit.
    ///
    /// # Errors
    /// [`OrbitError::Path`] if the start is outside the range or does not converge, [`OrbitError::Motion`] if the system has no such parameter.
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
            begins_with_present: false,
            last_rows,
            evaluations_between: 0,
            origin: None,
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

    /// Goes to the next solution and appends its row, after those that belong between it and the row before; or says why the walk has ended.
    ///
    /// Rows are dense enough that linear interpolation of the maximum displacement over the frequency is good to 1e-3.
    ///
    /// # Errors
    /// See [`OrbitError`]; failures to go on are not errors but stop reasons.
    pub fn step(&mut self, rows: &mut Vec<BranchRow>) -> Result<Option<StopReason>, OrbitError> {
        if std::mem::take(&mut self.begins_with_present) {
            evaluate(&mut self.problem, &self.follower.current().point)?;
            rows.push(self.row()?);
            return Ok(None);
        }
        if let Some(end) = self.ends_here() {
            return Ok(Some(end));
        }
        let before = self.may_split();
        self.keep_to_scale();
        self.keep_phase_clear();
        let mut from = self.follower.current().clone();
        let work = self.work();
        let mut stopped = self.advance(&mut from)?;
        while stopped.is_none() && self.is_cut_at_touch() {
            stopped = self.leave_touch(&mut from)?;
        }
        if stopped.is_none()
            && let Some(before) = &before
            && let Some(splits) = self.comes_to_splitting(before, work)?
        {
            return Ok(Some(splits));
        }
        match stopped {
            None => match self.row() {
                Ok(row) => {
                    let largest = row.solution.largest_multiplier();
                    if let Some(before) = &before
                        && let Some(splits) = self.is_lost_at_splitting(before, largest)?
                    {
                        return Ok(Some(splits));
                    }
                    self.journal.push(self.follower.in_first_units(self.follower.current()));
                    self.append_densely(&from, row, rows)?;
                    self.keep_segments_short(largest)?;
                    Ok(None)
                }
                Err(error @ (OrbitError::Motion(_) | OrbitError::Eigenvalues(_))) => {
                    let frequency_hz = self.follower.current().parameter();
                    Ok(Some(StopReason::Motion { frequency_hz, message: error.to_string() }))
                }
                Err(error) => Err(error),
            },
            // Where the flip is too sharp to be passed, it is the end all the same.
            Some(hammerbeam_path::StopReason::StepTooShort { parameter, .. })
                if self.is_near_shorter_period() =>
            {
                Ok(Some(StopReason::ShorterPeriod { frequency_hz: parameter, grazes: false }))
            }
            Some(reason) => Ok(Some(self.stop_reason(reason))),
        }
    }

    /// Whether the present orbit, at which nothing happens, is cut where it touches a contact, to rounding: where its force sets in with a jump the path of its first node has a corner
    /// there, at which the multipliers are those of a motion with a touch too many or too few. It is no row.
    fn is_cut_at_touch(&self) -> bool {
        let current = &self.follower.current().events;
        let happens = current.fold || current.branch_point || current.signature_change || current.zeros != 0;
        !happens && self.follower.stop_reason().is_none() && self.problem.is_cut_at_touch()
    }

    /// Goes on from an orbit that is no row; `from` stays the point before it, as long as the orbits are cut as they were.
    fn leave_touch(
        &mut self,
        from: &mut ContinuationPoint,
    ) -> Result<Option<hammerbeam_path::StopReason>, OrbitError> {
        self.journal.push(self.follower.in_first_units(self.follower.current()));
        let cut = (self.problem.phase(), self.problem.segments());
        let mut last = from.clone();
        let stopped = self.advance(&mut last)?;
        if cut != (self.problem.phase(), self.problem.segments()) {
            *from = last;
        }
        Ok(stopped)
    }

    /// Why the walk ends at the present point, if it does.
    fn ends_here(&mut self) -> Option<StopReason> {
        self.meets_shorter_period().or_else(|| self.crawls_to_splitting())
    }

    /// Measures in units that fit the present orbit, so that tolerances and steps stay relative to it.
    ///
    /// Nodes may stay where they are while the orbit grows, and be far smaller than it: the motion itself decides, at every [`LOOK`]th point, or where the nodes have outgrown
    /// the units, and then the orbit with them. Points are counted in the checkpoint.
    fn keep_to_scale(&mut self) {
        let due = self.follower.counters().accepted.is_multiple_of(LOOK);
        if !due && self.problem.size(&self.follower.current().point) <= OUTGROWN {
            return;
        }
        let size = self.of_present(|orbit, integrator, scale| orbit.size(integrator, scale));
        let Some(size) = size else { return };
        if (1.0 / OUTGROWN..=OUTGROWN).contains(&size) || !size.is_normal() {
            return;
        }
        // Powers of two change no digit.
        let factor = 2f64.powi(size.log2().round() as i32);
        self.problem.rescale(factor);
        self.follower.rescale(factor);
        self.last_rows.keep_newest();
    }

    /// Cuts the orbit anew where its largest multiplier has outgrown the segments, before steps become so short that the walk crawls.
    fn keep_segments_short(&mut self, largest: f64) -> Result<(), OrbitError> {
        let outgrown = largest.ln() > self.problem.segments() as f64 * MOST_GROWTH.ln();
        if self.settings.segments == Segments::Automatic && outgrown && self.follower.stop_reason().is_none()
        {
            match self.resegment() {
                Ok(_) | Err(OrbitError::Motion(_)) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    /// Goes to the next point of the path, with more segments or at another phase if it does not go on with the present ones; `from` becomes the point before it.
    fn advance(
        &mut self,
        from: &mut ContinuationPoint,
    ) -> Result<Option<hammerbeam_path::StopReason>, OrbitError> {
        use hammerbeam_path::StopReason::{EvaluationFailed, StepTooShort};
        let mut flights = 0;
        loop {
            from.clone_from(self.follower.current());
            match self.follower.step(&mut self.problem) {
                StepOutcome::Accepted => return Ok(None),
                StepOutcome::Stopped(StepTooShort { .. } | EvaluationFailed { .. })
                    if flights < MOST_FLIGHTS && self.flee_phase() =>
                {
                    flights += 1;
                }
                StepOutcome::Stopped(reason @ (StepTooShort { .. } | EvaluationFailed { .. }))
                    if self.settings.segments == Segments::Automatic =>
                {
                    match self.resegment() {
                        Ok(true) => {}
                        Ok(false) | Err(OrbitError::Motion(_)) => return Ok(Some(reason)),
                        Err(error) => return Err(error),
                    }
                }
                StepOutcome::Stopped(reason) => return Ok(Some(reason)),
            }
        }
    }

    /// Goes to the next solution but gives only its frequency, phase and nodes.
    pub(crate) fn step_without_maxima(
        &mut self,
        states: &mut Vec<Walked>,
    ) -> Result<Option<StopReason>, OrbitError> {
        if let Some(end) = self.ends_here() {
            return Ok(Some(end));
        }
        let before = self.may_split();
        self.keep_to_scale();
        self.keep_phase_clear();
        let mut from = self.follower.current().clone();
        let work = self.work();
        let stopped = self.advance(&mut from)?;
        if stopped.is_none() {
            if let Some(before) = &before
                && let Some(splits) = self.comes_to_splitting(before, work)?
            {
                return Ok(Some(splits));
            }
            self.touches.clear();
            self.touches.extend_from_slice(self.problem.touches());
        }
        match stopped {
            None => {
                let current = self.follower.current();
                let nodes = self.problem.nodes(&current.point);
                let phase = self.problem.phase().fract();
                states.push(Walked { frequency_hz: current.parameter(), phase, nodes });
                Ok(None)
            }
            Some(reason) => Ok(Some(self.stop_reason(reason))),
        }
    }

    /// Work done so far; differences of it depend on nothing but the path.
    pub(crate) fn work(&mut self) -> Work {
        let force_steps = self.problem.integrator().counts().steps;
        Work { force_steps, evaluations: self.follower.counters().evaluations }
    }

    /// If a step of the path has passed a splitting, or has become laborious beside one.
    ///
    /// * `earlier`: the work before the step.
    fn comes_to_splitting(
        &mut self,
        before: &Passed,
        earlier: Work,
    ) -> Result<Option<StopReason>, OrbitError> {
        let spent = self.work().since(earlier);
        if let Some(splits) = self.passes_splitting(before)? {
            return Ok(Some(splits));
        }
        self.labours_at_splitting(before, spent)
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
