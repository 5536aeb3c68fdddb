//! Walking along a curve of bifurcations, one row at a time.

use hammerbeam_motion::{Parameter, Stretch, System, exact::MotionError};
use hammerbeam_path::{Direction, Follower, ParameterRange, PathProblem, Settings, StepOutcome};

use super::{
    bordered::Bordered,
    condition::Condition,
    grazing::Touch,
    pair::Pair,
    passing::Passing,
    problem::CurveProblem,
    recut::cut_clear,
    shooting::{Place, Shooting},
};
use crate::{
    OrbitError, OrbitSettings, PeriodicSolution, Response, Side,
    eigenvalues::eigenvalues,
    size::orbit_scale,
    solve::{integrator, nodes_from},
};

/// What is followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveKind {
    /// A multiplier at +1.
    Fold,
    /// A multiplier at -1.
    Flip,
    /// A complex pair on the unit circle.
    NeimarkSacker,
    /// A contact that is touched with zero velocity.
    Grazing {
        /// Which one, in the order of the elements and their contacts.
        contact: usize,
    },
}

/// Where and how far a curve is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveSettings {
    /// The second parameter.
    pub parameter: Parameter,
    /// Its range, in its unit; the curve is cut exactly at the ends.
    pub range: (f64, f64),
    /// Range of the frequency [Hz]; the curve ends with the first row beyond it.
    pub range_hz: (f64, f64),
    /// Longest step, in hundredths of the ranges.
    pub max_step: f64,
    /// Most rows.
    pub max_rows: usize,
}

/// What happens at a row of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CurveEvents {
    /// First row.
    pub start: bool,
    /// The second parameter turns.
    pub turn: bool,
    /// Two folds meet.
    pub cusp: bool,
    /// A multiplier at +1 and one at -1.
    pub fold_flip: bool,
    /// Resonance 1:n.
    pub resonance: Option<u8>,
    /// A grazing orbit has a multiplier at +1.
    pub grazing_fold: bool,
    /// A grazing orbit has a multiplier at -1.
    pub grazing_flip: bool,
    /// A touch without curvature.
    pub degenerate_grazing: bool,
    /// The contacts change.
    pub grazing: bool,
}

impl CurveEvents {
    /// The names of the events joined by `+`, empty if there are none.
    #[must_use]
    pub fn label(self) -> String {
        let resonance = ["1:1", "1:2", "1:3", "1:4"];
        let resonance = self.resonance.map(|n| format!("resonance-{}", resonance[usize::from(n) - 1]));
        let named = [
            (self.start, "start"),
            (self.turn, "turn"),
            (self.cusp, "cusp"),
            (self.fold_flip, "fold-flip"),
            (self.grazing_fold, "grazing-fold"),
            (self.grazing_flip, "grazing-flip"),
            (self.degenerate_grazing, "degenerate-grazing"),
            (self.grazing, "grazing"),
        ];
        let mut names: Vec<String> =
            named.iter().filter(|(set, _)| *set).map(|(_, name)| (*name).to_owned()).collect();
        names.extend(resonance);
        names.join("+")
    }
}

/// One row of a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveRow {
    /// Value of the second parameter, in its unit.
    pub parameter: f64,
    /// The orbit, with the frequency.
    pub solution: PeriodicSolution,
    /// Phase at which the contact is touched [cycles], on a curve of grazing orbits.
    pub phase: Option<f64>,
    /// What happens there.
    pub events: CurveEvents,
}

/// Why a curve ended.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum CurveEnd {
    /// End of the range of the second parameter.
    RangeEnd,
    /// The frequency left its range.
    FrequencyRangeEnd,
    /// The curve came back to its start.
    Closed,
    /// A Neimark-Sacker curve ends at a resonance 1:1 or 1:2.
    Resonance,
    /// The budget of rows is used up.
    Budget,
    /// It could not be followed further.
    Stopped {
        /// Why.
        message: String,
    },
}

/// One side of a curve.
#[derive(Debug)]
pub struct CurveWalk {
    pub(super) problem: CurveProblem,
    pub(super) follower: Follower,
    settings: CurveSettings,
    kind: CurveKind,
    end: Option<CurveEnd>,
}

impl CurveWalk {
    /// Begins at an orbit of `system` as it is, near the event, and walks to `side` of the second parameter.
    ///
    /// # Errors
    /// [`OrbitError::Path`] if no point of the curve is found near the start, [`OrbitError::Motion`] if the system has no such parameter,
    /// [`OrbitError::NoEvent`] if the orbit has no such contact or pair of multipliers.
    pub fn new(
        system: &System,
        response: &Response,
        start: &PeriodicSolution,
        (kind, side): (CurveKind, Side),
        settings: &CurveSettings,
        orbits: &OrbitSettings,
    ) -> Result<Self, OrbitError> {
        let value = system.parameter(settings.parameter).map_err(MotionError::from)?;
        let mut integrator = integrator(system, response, orbits)?;
        integrator.differentiate_by(Some(settings.parameter))?;
        let contacts = integrator.touches().len();
        let start = &cut_clear(&mut integrator, start)?;
        let scale = orbit_scale(&mut integrator, start)?;
        let mut shooting = Shooting {
            integrator,
            parameter: settings.parameter,
            period_multiple: start.period_multiple,
            scale,
            count: start.nodes.len(),
            segments: Vec::new(),
            products: Vec::new(),
            touches: vec![0; contacts],
            passing: None,
        };
        let none = OrbitError::NoEvent { frequency_hz: start.frequency_hz };
        if let CurveKind::Grazing { contact } = kind {
            let touch = Touch::of_contact(&shooting, contact).ok_or(none.clone())?;
            shooting.passing = Passing::new((&shooting, touch.element), response, start, orbits)?;
        }
        let (condition, place) = first_condition(&mut shooting, start, (kind, value))?.ok_or(none)?;
        let width = |(low, high): (f64, f64)| (high - low) / 100.0;
        let units = [width(settings.range_hz), width(settings.range)];
        let mut problem = CurveProblem::new(shooting, condition, start.phase, units);
        let point = problem.point(&place);
        let direction = match side {
            Side::Up => Direction::Increasing,
            Side::Down => Direction::Decreasing,
        };
        let range = ParameterRange::new(settings.range.0, settings.range.1)?;
        let follower =
            Follower::start(&mut problem, &point, direction, range, path_settings(settings, units))?;
        Ok(Self { problem, follower, settings: *settings, kind, end: None })
    }

    /// The row of the start, to be taken before the first step.
    ///
    /// # Errors
    /// See [`OrbitError`].
    pub fn start_row(&mut self) -> Result<CurveRow, OrbitError> {
        let mut row = self.row()?;
        row.events.start = true;
        Ok(row)
    }

    /// Goes to the next row, or says why the curve has ended.
    ///
    /// # Errors
    /// See [`OrbitError`]; failures to go on are not errors but ends.
    pub fn step(&mut self) -> Result<Result<CurveRow, CurveEnd>, OrbitError> {
        use hammerbeam_path::StopReason;
        if let Some(end) = &self.end {
            return Ok(Err(end.clone()));
        }
        self.keep_phase_clear();
        let reason = match self.follower.step(&mut self.problem) {
            StepOutcome::Accepted => return self.accepted().map(Ok),
            StepOutcome::Stopped(reason) => reason,
        };
        Ok(Err(match reason {
            StopReason::RangeEnd => CurveEnd::RangeEnd,
            StopReason::Closed => CurveEnd::Closed,
            StopReason::Budget => CurveEnd::Budget,
            other => CurveEnd::Stopped {
                message: match self.problem.failure() {
                    Some(failure) => format!("{other}: {failure}"),
                    None => other.to_string(),
                },
            },
        }))
    }

    fn accepted(&mut self) -> Result<CurveRow, OrbitError> {
        let row = self.row()?;
        let (low, high) = self.settings.range_hz;
        if !(low..=high).contains(&row.solution.frequency_hz) {
            self.end = Some(CurveEnd::FrequencyRangeEnd);
        }
        if self.kind == CurveKind::NeimarkSacker && row.events.resonance.is_some_and(|n| n <= 2) {
            self.end = Some(CurveEnd::Resonance);
        }
        Ok(row)
    }

    /// The row of the present point; the condition is adapted to it.
    fn row(&mut self) -> Result<CurveRow, OrbitError> {
        let current = self.follower.current().clone();
        let place = self.problem.place(&current.point);
        if self.problem.evaluate(&current.point).is_err() {
            let failure = self.problem.failure().cloned();
            let none = OrbitError::NoEvent { frequency_hz: place.frequency_hz };
            return Err(failure.map_or(none, OrbitError::Motion));
        }
        let residual = self.problem.residual().iter().fold(0.0_f64, |largest, r| largest.max(r.abs()));
        let events = self.events(&current.events);
        let shooting = &mut self.problem.shooting;
        let floquet_multipliers = eigenvalues(shooting.size(), shooting.monodromy())?;
        self.problem.condition.renew(shooting);
        let scales = shooting.scale.values().to_vec();
        let nodes: Vec<Vec<f64>> = place
            .nodes
            .chunks_exact(scales.len())
            .map(|node| node.iter().zip(&scales).map(|(x, s)| x * s).collect())
            .collect();
        let stretches: Vec<Stretch> =
            (0..shooting.count).map(|k| shooting.stretch(k, place.frequency_hz, place.phase)).collect();
        let has_phase = self.problem.condition.has_phase();
        if has_phase {
            shooting.fit_passing(place.frequency_hz, place.phase, &nodes[0])?;
        }
        let maxima = shooting.observe(&stretches, &nodes)?;
        let nodes = if has_phase { self.nodes_from_begin(&place, &nodes[0])? } else { nodes };
        let solution = PeriodicSolution {
            frequency_hz: place.frequency_hz,
            period_multiple: self.problem.shooting.period_multiple,
            phase: self.problem.begin,
            nodes,
            floquet_multipliers,
            residual,
            error_estimate: current.correction_norm,
            maxima,
        };
        let phase = has_phase.then_some(place.phase);
        Ok(CurveRow { parameter: place.value, solution, phase, events })
    }

    fn events(&self, events: &hammerbeam_path::Events) -> CurveEvents {
        let zero = |bit: u32| events.zeros >> bit & 1 == 1;
        let found =
            CurveEvents { turn: events.fold, grazing: events.signature_change, ..CurveEvents::default() };
        match self.kind {
            CurveKind::Fold => {
                CurveEvents { cusp: zero(0), resonance: zero(1).then_some(1), fold_flip: zero(2), ..found }
            }
            CurveKind::Flip => CurveEvents { resonance: zero(0).then_some(2), fold_flip: zero(1), ..found },
            CurveKind::NeimarkSacker => {
                CurveEvents { resonance: (0..4).find(|bit| zero(*bit)).map(|bit| bit as u8 + 1), ..found }
            }
            CurveKind::Grazing { .. } => CurveEvents {
                grazing_fold: zero(0),
                grazing_flip: zero(1),
                degenerate_grazing: zero(2),
                ..found
            },
        }
    }

    /// Nodes at equal phases, from that of the start on, of the orbit that is cut elsewhere.
    fn nodes_from_begin(&mut self, place: &Place, state: &[f64]) -> Result<Vec<Vec<f64>>, OrbitError> {
        let begin = self.problem.begin;
        let shooting = &mut self.problem.shooting;
        let (f, multiple, count) = (place.frequency_hz, shooting.period_multiple, shooting.count);
        let periods = f64::from(multiple);
        let end = begin + ((place.phase - begin) / periods).ceil() * periods;
        let stretch = Stretch { frequency_hz: f, start: place.phase, end };
        let first = shooting.advance(stretch, place.phase, state)?;
        nodes_from(&mut shooting.integrator, (begin, &first), f, multiple, count)
    }
}

/// The condition at the start, and where that is; `None` if the orbit has nothing to follow.
fn first_condition(
    shooting: &mut Shooting,
    start: &PeriodicSolution,
    (kind, value): (CurveKind, f64),
) -> Result<Option<(Condition, Place)>, OrbitError> {
    let scaled = |nodes: &[Vec<f64>], scales: &[f64]| -> Vec<f64> {
        nodes.iter().flat_map(|node| node.iter().zip(scales).map(|(z, s)| z / s)).collect()
    };
    let frequency_hz = start.frequency_hz;
    let scales = shooting.scale.values().to_vec();
    let mut place = Place { nodes: scaled(&start.nodes, &scales), frequency_hz, phase: start.phase, value };
    if let CurveKind::Grazing { contact } = kind {
        let Some(touch) = Touch::of_contact(shooting, contact) else { return Ok(None) };
        let Some((phase, state)) = touch.find(shooting, (start.phase, &start.nodes[0]), frequency_hz)? else {
            return Ok(None);
        };
        let mut nodes = vec![state];
        shooting.fit_passing(frequency_hz, phase, &nodes[0])?;
        for k in 1..shooting.count {
            let stretch = shooting.stretch(k - 1, frequency_hz, phase);
            nodes.push(shooting.advance(stretch, phase, &nodes[k - 1])?);
        }
        place = Place { nodes: scaled(&nodes, &scales), phase, ..place };
        return Ok(Some((Condition::Touch(touch), place)));
    }
    shooting.evaluate(&place)?;
    let condition = match kind {
        CurveKind::Fold => Some(Condition::Multiplier(Bordered::new(1.0, shooting))),
        CurveKind::Flip => Some(Condition::Multiplier(Bordered::new(-1.0, shooting))),
        _ => Pair::new(shooting).map(Condition::Pair),
    };
    Ok(condition.map(|condition| (condition, place)))
}

/// Settings of the path. The condition is known less exactly than an orbit: rounding of the monodromy matrix is in it.
fn path_settings(settings: &CurveSettings, units: [f64; 2]) -> Settings {
    let default = Settings::default();
    Settings {
        initial_step: 0.1 * settings.max_step,
        max_parameter_step: settings.max_step * units[1],
        max_step_length: settings.max_step,
        min_step: 1e-8,
        correction_tolerance: 1e-8,
        correction_floor: 1e-10,
        residual_floor: 1e3 * default.residual_floor,
        sheet_distance: 1e-4,
        signature_step: 1e-4,
        max_points: settings.max_rows as u64,
        ..default
    }
}
