//! Walking along a curve of bifurcations, one row at a time.

use hammerbeam_motion::{Stretch, System, exact::MotionError};
use hammerbeam_path::{Direction, Follower, ParameterRange, PathProblem, StepOutcome};

use super::{
    grazing::Touch,
    passing::Passing,
    problem::CurveProblem,
    recut::cut_clear,
    row::{CurveEnd, CurveEvents, CurveKind, CurveRow, CurveSettings},
    shooting::{Place, Shooting},
    start::{first_condition, path_settings},
};
use crate::{
    OrbitError, OrbitSettings, PeriodicSolution, Response, Side, eigenvalues::eigenvalues, size::orbit_scale,
    solve::integrator,
};

/// Rows at a grazing after which the curve has met it.
const ROWS_AT_GRAZING: u32 = 10;
/// A curve that no step leads on from this near to a grazing has met it.
const AT_GRAZING: f64 = 1e-6;
/// So many rows that have got no further than [`CRAWLING`] crawl: two hundred go over a whole range else.
const MANY_ROWS: u32 = 2000;
/// A way of next to nothing, in hundredths of the ranges.
const CRAWLING: f64 = 0.5;

/// One side of a curve.
#[derive(Debug)]
pub struct CurveWalk {
    pub(super) problem: CurveProblem,
    pub(super) follower: Follower,
    settings: CurveSettings,
    kind: CurveKind,
    /// How far the last orbit is from grazing a contact.
    grazing_distance: f64,
    /// Rows one after the other whose orbits graze one, to rounding.
    rows_at_grazing: u32,
    /// Rows since the walk was last asked whether it crawls, and the arc length then.
    since: (u32, f64),
    /// Arc length at which the walk was last asked whether it comes to a splitting (`splits.rs`).
    pub(super) asked_at: f64,
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
        (mut kind, side): (CurveKind, Side),
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
            grazing_distance: f64::INFINITY,
            passing: None,
        };
        let none = OrbitError::NoEvent { frequency_hz: start.frequency_hz };
        let mut touch = None;
        if let CurveKind::Grazing { contact } = kind {
            let orbit = (start.phase, &start.nodes[..]);
            let (found, turn) =
                Touch::choose(&mut shooting, contact, orbit, start.frequency_hz)?.ok_or(none.clone())?;
            kind = CurveKind::Grazing { contact: Some(found.number(&shooting)) };
            if !found.from_inside {
                let opposite = found.opposite(&mut shooting, orbit, start.frequency_hz, &turn)?;
                let range = (start, settings.range);
                shooting.passing = Passing::new(&shooting, (found, opposite), response, range, orbits)?;
            }
            touch = Some((found, turn));
        }
        let (condition, place) = first_condition(&mut shooting, start, (kind, value), touch)?.ok_or(none)?;
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
        let grazing_distance = problem.shooting.grazing_distance;
        Ok(Self {
            problem,
            follower,
            settings: *settings,
            kind,
            grazing_distance,
            rows_at_grazing: 0,
            since: (0, 0.0),
            asked_at: 0.0,
            end: None,
        })
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
        if let Some(end) = &self.end {
            return Ok(Err(end.clone()));
        }
        let before = self.may_split();
        self.keep_phase_clear();
        let reason = match self.follower.step(&mut self.problem) {
            StepOutcome::Accepted => {
                self.end = before.and_then(|before| self.comes_to_splitting(&before));
                return match &self.end {
                    Some(end) => Ok(Err(end.clone())),
                    None => self.accepted().map(Ok),
                };
            }
            StepOutcome::Stopped(reason) => reason,
        };
        Ok(Err(self.end_of(reason)))
    }

    /// Why the curve has ended, in terms of orbits.
    fn end_of(&mut self, reason: hammerbeam_path::StopReason) -> CurveEnd {
        use hammerbeam_path::StopReason;
        match reason {
            StopReason::RangeEnd => CurveEnd::RangeEnd,
            StopReason::Closed => CurveEnd::Closed,
            StopReason::Budget => CurveEnd::Budget,
            other => {
                let parameter = self.follower.current().parameter();
                let message = match self.problem.failure() {
                    Some(failure) => format!("{other}: {failure}"),
                    None => other.to_string(),
                };
                let no_step = matches!(other, StopReason::StepTooShort { .. });
                if let Some(splits) = self.splits_here() {
                    return splits;
                }
                if no_step && self.grazing_distance < AT_GRAZING {
                    CurveEnd::Grazing { parameter, cause: Some(message) }
                } else {
                    CurveEnd::Stopped { parameter, message }
                }
            }
        }
    }

    fn accepted(&mut self) -> Result<CurveRow, OrbitError> {
        let row = self.row()?;
        let (low, high) = self.settings.range_hz;
        let parameter = row.parameter;
        self.rows_at_grazing = if self.grazing_distance == 0.0 { self.rows_at_grazing + 1 } else { 0 };
        let crawls = self.crawls();
        self.end = if !(low..=high).contains(&row.solution.frequency_hz) {
            Some(CurveEnd::FrequencyRangeEnd)
        } else if self.kind == CurveKind::NeimarkSacker && row.events.resonance.is_some_and(|n| n <= 2) {
            Some(CurveEnd::Resonance)
        } else if self.follower.stop_reason().is_some() {
            // The next step tells it.
            None
        } else if self.rows_at_grazing >= ROWS_AT_GRAZING {
            Some(CurveEnd::Grazing { parameter, cause: None })
        } else if crawls {
            Some(CurveEnd::Crawls { parameter, rows: MANY_ROWS })
        } else {
            None
        };
        Ok(row)
    }

    /// Whether the last rows led nowhere, asked once in [`MANY_ROWS`].
    fn crawls(&mut self) -> bool {
        self.since.0 += 1;
        if self.since.0 < MANY_ROWS {
            return false;
        }
        let arc_length = self.follower.current().arc_length;
        let way = arc_length - self.since.1;
        self.since = (0, arc_length);
        way < CRAWLING
    }

    /// Whether the contacts that are counted hold those that graze: then a change of their number says nothing of another one.
    fn counts_its_own_touch(&self) -> bool {
        matches!(self.kind, CurveKind::Grazing { .. }) && self.problem.shooting.passing.is_none()
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
        self.grazing_distance = self.problem.shooting.grazing_distance;
        let residual = self.problem.residual().iter().fold(0.0_f64, |largest, r| largest.max(r.abs()));
        let mut events = CurveEvents::of(self.kind, current.events, &self.problem.other_multipliers());
        if self.counts_its_own_touch() && events.double_grazing {
            (events.double_grazing, events.grazing) = (false, true);
        }
        let shooting = &mut self.problem.shooting;
        let floquet_multipliers = eigenvalues(shooting.size(), shooting.monodromy())?;
        self.problem.renew(current.events.zeros);
        let shooting = &mut self.problem.shooting;
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
        let nodes = if has_phase { self.nodes_from_begin(&place, &nodes)? } else { nodes };
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

    /// Nodes at equal phases, from that of the start on, of the orbit that is cut elsewhere: each from the node before it.
    fn nodes_from_begin(&mut self, place: &Place, nodes: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, OrbitError> {
        let begin = self.problem.begin;
        let shooting = &mut self.problem.shooting;
        let cycles = f64::from(shooting.period_multiple);
        let length = cycles / nodes.len() as f64;
        let node = |k: usize| {
            let behind = (begin + k as f64 * length - place.phase).rem_euclid(cycles);
            let from = ((behind / length) as usize).min(nodes.len() - 1);
            let [start, end] = [from as f64 * length, behind].map(|offset| place.phase + offset);
            let stretch = Stretch { frequency_hz: place.frequency_hz, start, end };
            Ok(shooting.advance(stretch, place.phase, &nodes[from])?)
        };
        (0..nodes.len()).map(node).collect()
    }
}
