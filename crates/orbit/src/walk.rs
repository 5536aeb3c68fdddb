//! Walking along a branch of periodic orbits, one row at a time.

use hammerbeam_motion::{
    System,
    exact::{ExactIntegrator, MotionError},
};
use hammerbeam_path::{
    ContinuationPoint, Direction, Follower, Node, ParameterRange, PathProblem, Settings, StepOutcome,
};

use crate::{
    BranchRow, Crossing, Events, OrbitError, OrbitSettings, PeriodicSolution, Response, Segments, Side,
    StopReason,
    continuation_parameter::ContinuationParameter,
    cut::begins_with_care,
    density::{LastRows, Place},
    located,
    recut::Origin,
    shooting::ShootingProblem,
    size::{Cut, orbit_scale},
    solve::{evaluate, integrator, nodes_from, solution},
    state_scale::StateScale,
};

/// Distance from an orbit of shorter period, relative to the orbit, below which a branch point is the flip of that orbit: it is located to
/// about the square of this in frequency.
const MERGED: f64 = 1e-3;

/// Distance from an orbit of shorter period, relative to the orbit, within which a branch that goes there in steps far shorter than that has arrived, if its frequency has nothing left to change: then it is
/// located as well as a flip has to be. What holds the steps up is the error of the motion, which changes with the choice of contact steps: it is more than what the frequency still has to change.
const CRAWLS_NEAR: f64 = 1e-4;
/// Nothing left: this part of the frequency, by the slope there times the distance.
const STILL: f64 = 2e-9;
/// Far shorter: this part of the distance.
const CRAWLS: f64 = 0.02;

/// An orbit that has become so many times as large or small as the units in which it is measured gets new units.
const OUTGROWN: f64 = 4.0;
/// At every so many accepted points the motion is gone through for its size.
const LOOK: u64 = 8;

/// Shortest step with rigid stops, over that without. An impact of the speed v depends on the orbit like `1/v`, and v on the distance from grazing like its root: a point of the path, good to its
/// `correction_floor`, has a speed of its own only down to about 1e-5 of the orbit's. Below, the path would crawl through noise; so its turn there is taken as the corner that it is.
const SHORTEST_AT_IMPACTS: f64 = 100.0;

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
        let follower =
            Follower::start(&mut problem, &point, direction, range, path_settings(settings, system, length))?;
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

    /// The row of the start, to be taken before the first step.
    ///
    /// # Errors
    /// See [`OrbitError`].
    pub fn start_row(&mut self) -> Result<BranchRow, OrbitError> {
        evaluate(&mut self.problem, &self.follower.current().point)?;
        let mut row = self.row()?;
        row.events.start = true;
        Ok(row)
    }

    /// Whether the present point is where a branch of shorter period flips, or so near to it that its place is known while steps are held up by rounding.
    fn meets_shorter_period(&mut self) -> bool {
        self.follower.current().events.branch_point && self.is_near_shorter_period()
            || self.crawls_to_shorter_period()
    }

    /// Whether the last steps have led towards an orbit of shorter period, nearer than [`CRAWLS_NEAR`] of the orbit, in a small part of the way that is left each.
    fn crawls_to_shorter_period(&self) -> bool {
        let history = &self.follower.checkpoint().history;
        let nodes = &history.nodes[..history.used];
        let left = |node: &Node| self.problem.distance_to_simpler(&node.point);
        let near = CRAWLS_NEAR * hertz_per_norm(self.range_hz);
        let still = |node: &Node| {
            let slope = node.tangent[node.tangent.len() - 1].abs();
            slope * left(node) < STILL * self.problem.parameter_size(&node.point)
        };
        nodes.len() > 1
            && left(&nodes[0]) < near
            && nodes.iter().all(still)
            && nodes.windows(2).all(|pair| {
                let step = left(&pair[1]) - left(&pair[0]);
                (0.0..CRAWLS * left(&pair[0])).contains(&step)
            })
    }

    /// Whether the present orbit is, within [`MERGED`], one of shorter period.
    fn is_near_shorter_period(&mut self) -> bool {
        self.problem.period_multiple() > 1
            && self
                .of_present(|orbit, integrator, scale| orbit.distance_to_shorter_period(integrator, scale))
                .is_some_and(|distance| distance < MERGED)
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
        if self.meets_shorter_period() {
            return Ok(Some(StopReason::ShorterPeriod { frequency_hz: self.follower.current().parameter() }));
        }
        self.keep_to_scale();
        self.keep_phase_clear();
        let mut from = self.follower.current().clone();
        match self.advance(&mut from)? {
            None => match self.row() {
                Ok(row) => {
                    self.journal.push(self.follower.in_first_units(self.follower.current()));
                    let largest = row.solution.largest_multiplier();
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
                Ok(Some(StopReason::ShorterPeriod { frequency_hz: parameter }))
            }
            Some(reason) => Ok(Some(self.stop_reason(reason))),
        }
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
        if self.meets_shorter_period() {
            return Ok(Some(StopReason::ShorterPeriod { frequency_hz: self.follower.current().parameter() }));
        }
        self.keep_to_scale();
        self.keep_phase_clear();
        let mut from = self.follower.current().clone();
        match self.advance(&mut from)? {
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

    /// Excitation periods of an orbit.
    pub(crate) fn period_multiple(&self) -> u32 {
        self.problem.period_multiple()
    }

    /// The flip at the present point, at which the problem was evaluated last, as a place to leave from; `None` where there is none.
    pub(crate) fn flip_here(&mut self) -> Result<Option<Crossing>, OrbitError> {
        if self.follower.current().events.zeros & 1 == 0 {
            return Ok(None);
        }
        let row = self.row()?;
        let Some(located) = row.located.filter(|located| !located.direction.is_empty()) else {
            return Ok(None);
        };
        Ok(Some(Crossing { orbit: row.solution, direction: located.direction, factor: 2 }))
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

    /// The row of the point at which the problem was evaluated last.
    pub(crate) fn row(&mut self) -> Result<BranchRow, OrbitError> {
        let current = self.follower.current().clone();
        let place =
            located::Place { point: &current, bend: self.frequency_bend(), touches_before: &self.touches };
        let located = located::describe(&mut self.problem, &place);
        self.touches.clear();
        self.touches.extend_from_slice(self.problem.touches());
        Ok(BranchRow { located, ..self.row_at(&current)? })
    }

    /// The row of a point of the path at which the problem was evaluated last.
    pub(crate) fn row_at(&mut self, point: &ContinuationPoint) -> Result<BranchRow, OrbitError> {
        // The path measures in hertz, the solution relative to the orbit.
        let error_estimate = point.correction_norm / hertz_per_norm(self.range_hz);
        let solution = solution(&mut self.problem, &point.point, error_estimate)?;
        let events = Events {
            // Where the frequency turns at a branch point it does so on an arm of a pitchfork, which is no fold of cycles.
            fold: point.events.fold && !point.events.branch_point,
            branch_point: point.events.branch_point,
            grazing: point.events.signature_change,
            flip: point.events.zeros & 1 != 0,
            neimark_sacker: point.events.zeros & 2 != 0,
            ..Events::default()
        };
        let parameter = self.problem.varied().parameter().map(|_| point.parameter());
        Ok(BranchRow { solution, parameter, events, located: None })
    }

    /// Change of the tangent's frequency component per length over the last step.
    fn frequency_bend(&self) -> f64 {
        let history = &self.follower.checkpoint().history;
        let [base, before, ..] = history.nodes.as_slice() else { return 0.0 };
        let last = base.point.len() - 1;
        let squares = base.point.iter().zip(&before.point).zip(self.problem.weights());
        let length = squares.map(|((a, b), w)| w * (a - b) * (a - b)).sum::<f64>().sqrt();
        (base.tangent[last] - before.tangent[last]).abs() / length.max(f64::MIN_POSITIVE)
    }
}

/// Hertz of arc length that a change of the orbit by the size of the start counts: a hundredth of the range.
pub(crate) fn hertz_per_norm((low, high): (f64, f64)) -> f64 {
    (high - low) / 100.0
}

/// Settings of the path from those of the orbits; `length` is [`hertz_per_norm`].
pub(crate) fn path_settings(settings: &OrbitSettings, system: &System, length: f64) -> Settings {
    let default = Settings::default();
    let rigid = system.elements().iter().any(|element| element.law.rigid().is_some());
    let shortest = if rigid { SHORTEST_AT_IMPACTS } else { 1.0 };
    Settings {
        initial_step: 0.1 * settings.max_step_hz,
        max_parameter_step: settings.max_step_hz,
        max_step_length: 2.0 * settings.max_step_hz,
        min_step: shortest * default.min_step * length,
        crawl_step: default.crawl_step * length,
        correction_tolerance: settings.tolerance * length,
        correction_floor: default.correction_floor * length,
        // Rounding of the residual grows with the multipliers.
        residual_floor: 100.0 * default.residual_floor,
        sheet_distance: default.sheet_distance * length,
        signature_step: default.signature_step * length,
        max_points: settings.max_solutions as u64,
        ..default
    }
}

/// Segments of an orbit: more where the largest multiplier would carry a guess away within the period, and a whole number of them per excitation period, so
/// that an orbit of shorter period is known when it is met. Nodes must not lie in contacts whose laws remember how they began, nor on impacts: then there is one.
fn segment_count(system: &System, start: &PeriodicSolution, settings: &OrbitSettings) -> usize {
    match settings.segments {
        Segments::Fixed(count) => count.max(1),
        Segments::Automatic if begins_with_care(system) => 1,
        Segments::Automatic => {
            let largest = start.largest_multiplier();
            let by_growth = (largest.max(1.0).ln() / 1e3_f64.ln()).ceil().max(1.0) as usize;
            let by_contacts = start.maxima.contacts as usize / 12 + 1;
            by_growth.max(by_contacts).min(16).next_multiple_of(start.period_multiple as usize)
        }
    }
}
