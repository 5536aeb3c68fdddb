//! Walking along a curve of bifurcations, one row at a time.
//!
//! A curve has met a grazing in three cases: its rows are at one as far as can be resolved;
//! [`SHORT_AT_GRAZING`] of them were short beside one (it goes on along the grazing, and matrices like the
//! root of the distance leave nothing of the tangent); no step leads on from a row beside one. Differences
//! are made only as short as they must be, so they may know of no grazing at such a row: a step across a
//! change of contacts shows it.

use hammerbeam_motion::{System, exact::MotionError};
use hammerbeam_path::{
    Follower, Judge, ParameterRange, PathEvents, PathProblem, StartDirection, StepOutcome,
};

use super::{
    bordered::Bordered,
    clear::cut_clear,
    closing::{Closing, half_of},
    condition::Condition,
    marks::OPPOSITE_BIT,
    meeting::{Approach, DegenerateFlip},
    opposite::opposite_name,
    passing::Passing,
    problem::CurveProblem,
    reopening::{ReopeningWatch, may_reopen, reopens_here},
    row::{CurveEnd, CurveKind, CurveRow, CurveSettings},
    shooting::{CurveOrbit, Shooting},
    start::{first_condition, path_settings},
    touched::Touch,
};
use crate::{
    OrbitError, OrbitSettings, PeriodicSolution, Response, Side, size::orbit_scale, solve::integrator,
};

/// Rows at a grazing after which the curve has met it.
const ROWS_AT_GRAZING: u32 = 10;
/// A curve that no step leads on from this near to a grazing has met it.
const AT_GRAZING: f64 = 1e-6;
/// Shares of that at which contacts are looked at ahead.
const AHEAD: [f64; 4] = [0.03, 0.1, 0.3, 1.0];
/// Short rows that longer ones have not made up for, the last of them so near to a grazing, after which the
/// curve has met it: one that only passes it has steps that grow again.
const SHORT_AT_GRAZING: u64 = 50;
/// So many rows that have got no further than [`LEAST_WAY`] make no progress: two hundred go over a whole
/// range else.
const MANY_ROWS: u32 = 2000;
/// A way of next to nothing, in hundredths of the ranges.
const LEAST_WAY: f64 = 0.5;
/// Rows in which a curve of flips over half a period comes to a degenerate one, if it leads there.
const ROWS_OF_HALF: usize = 12;
/// Largest residual of an orbit that was found as its own image.
const SOLVES: f64 = 1e-7;

/// One side of a curve.
#[derive(Debug)]
pub struct CurveWalk {
    pub(super) problem: CurveProblem,
    pub(super) follower: Follower,
    pub(super) settings: CurveSettings,
    pub(super) kind: CurveKind,
    /// How far the last orbit is from grazing a contact.
    pub(super) grazing_distance: f64,
    /// Rows one after the other whose orbits graze one, to rounding.
    rows_at_grazing: u32,
    /// Rows since the walk was last asked whether it gets on, and the arc length then.
    since: (u32, f64),
    /// On a curve of folds.
    approach: Option<Approach>,
    /// The row of the end that the last row has led to.
    last_row: Option<CurveRow>,
    /// Whether the last row lies behind it.
    is_behind: bool,
    reopening: ReopeningWatch,
    pub(super) end: Option<CurveEnd>,
}

impl CurveWalk {
    /// Begins at an orbit of `system` as it is, near the event, and walks to `side` of the second parameter.
    ///
    /// # Errors
    /// [`OrbitError::Path`] if no point of the curve is found near the start, [`OrbitError::Motion`] if the
    /// system has no such parameter, [`OrbitError::NoEvent`] if the orbit has no such contact or pair of
    /// multipliers.
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
            closing: Closing::Periodic,
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
                shooting.passing = Passing::new(
                    (shooting.integrator.system(), settings.parameter),
                    (found, opposite),
                    response,
                    range,
                    orbits,
                )?;
            }
            touch = Some((found, turn));
        }
        let (condition, place) = first_condition(&mut shooting, start, (kind, value), touch)?.ok_or(none)?;
        let direction = match side {
            Side::Up => StartDirection::Increasing,
            Side::Down => StartDirection::Decreasing,
        };
        let mut walk =
            Self::from_start((shooting, condition), (place, start.phase), (kind, direction), settings)?;
        walk.approach = (kind == CurveKind::Fold).then(|| Approach::new(response, orbits));
        Ok(walk)
    }

    /// Begins on the curve of flips of the map over half a period (`image.rs`).
    fn of_half(
        mut shooting: Shooting,
        place: &CurveOrbit,
        direction: StartDirection<'_>,
        settings: &CurveSettings,
    ) -> Result<Self, OrbitError> {
        shooting.evaluate(place)?;
        let condition = Condition::Multiplier(Bordered::new(-1.0, &shooting));
        Self::from_start(
            (shooting, condition),
            (place.clone(), place.phase),
            (CurveKind::Flip, direction),
            settings,
        )
    }

    /// * `phase`: at which orbits are cut, unless it is an unknown.
    fn from_start(
        (shooting, condition): (Shooting, Condition),
        (place, phase): (CurveOrbit, f64),
        (kind, direction): (CurveKind, StartDirection<'_>),
        settings: &CurveSettings,
    ) -> Result<Self, OrbitError> {
        let width = |(low, high): (f64, f64)| (high - low) / 100.0;
        let units = [width(settings.range_hz), width(settings.range)];
        let mut problem = CurveProblem::new(shooting, condition, phase, units);
        let point = problem.point(&place);
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
            approach: None,
            last_row: None,
            is_behind: false,
            reopening: ReopeningWatch::default(),
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
        if let Some(row) = self.last_row.take() {
            return Ok(Ok(row));
        }
        if let Some(end) = &self.end {
            return Ok(Err(end.clone()));
        }
        let before = may_reopen(&self.problem, &self.follower);
        self.keep_phase_clear();
        let from = self.follower.current().point.clone();
        let reason = match self.follower.step(&mut self.problem) {
            StepOutcome::Accepted => {
                self.end = before.and_then(|before| {
                    self.reopening.comes_to_reopening(&mut self.problem, &self.follower, &before)
                });
                return match &self.end {
                    Some(end) => Ok(Err(end.clone())),
                    None if self.has_left_frequencies() => Ok(self.end_at_frequency(&from)),
                    None => self.accepted().map(Ok),
                };
            }
            StepOutcome::Stopped(reason) => reason,
        };
        Ok(Err(self.end_of(reason)))
    }

    /// Why the curve has ended, in terms of orbits.
    fn end_of(&mut self, reason: hammerbeam_path::PathStop) -> CurveEnd {
        use hammerbeam_path::PathStop;
        match reason {
            PathStop::RangeEnd => CurveEnd::RangeEnd,
            PathStop::Closed => CurveEnd::Closed,
            PathStop::Budget => CurveEnd::Budget,
            other => {
                let parameter = self.follower.current().parameter();
                let message = match self.problem.failure() {
                    Some(failure) => format!("{other}: {failure}"),
                    None => other.to_string(),
                };
                let no_step = matches!(other, PathStop::StepTooShort { .. });
                if let Some(reopening) = reopens_here(&mut self.problem, &self.follower) {
                    return reopening;
                }
                if no_step && (self.grazing_distance < AT_GRAZING || self.contacts_change_ahead()) {
                    CurveEnd::Grazing { parameter, cause: Some(message) }
                } else {
                    CurveEnd::Stopped { parameter, message }
                }
            }
        }
    }

    fn accepted(&mut self) -> Result<CurveRow, OrbitError> {
        let row = self.row()?;
        let parameter = row.parameter;
        let opposite = if self.strikes_opposite() { opposite_name(&self.problem.shooting) } else { None };
        self.rows_at_grazing = if self.grazing_distance == 0.0 { self.rows_at_grazing + 1 } else { 0 };
        let no_progress = self.makes_no_progress();
        self.end = if self.kind == CurveKind::NeimarkSacker && row.events.resonance.is_some_and(|n| n <= 2) {
            Some(CurveEnd::Resonance)
        } else if let Some(element) = opposite {
            Some(CurveEnd::GrazedAsWell { parameter, element })
        } else if self.follower.stop_reason().is_some() {
            // The next step shows it.
            None
        } else if self.rows_at_grazing >= ROWS_AT_GRAZING || self.is_short_at_grazing() {
            Some(
                reopens_here(&mut self.problem, &self.follower)
                    .unwrap_or(CurveEnd::Grazing { parameter, cause: None }),
            )
        } else if no_progress {
            Some(CurveEnd::NoProgress { parameter, rows: MANY_ROWS })
        } else {
            self.meets_image()?
        };
        // A row behind the end is no row of the curve.
        let is_behind = std::mem::take(&mut self.is_behind);
        Ok(if is_behind { self.last_row.take().unwrap_or(row) } else { row })
    }

    /// Whether the contacts of orbits are others right ahead of the present row.
    fn contacts_change_ahead(&mut self) -> bool {
        let current = self.follower.current().clone();
        AHEAD.map(|share| share * AT_GRAZING).into_iter().any(|distance| {
            let ahead = current.point.iter().zip(&current.tangent).map(|(z, t)| z + distance * t);
            let ahead: Vec<f64> = ahead.collect();
            let is_resolved = self.problem.evaluate(&ahead).is_ok();
            is_resolved && self.problem.signature() != current.signature
        })
    }

    /// Whether steps have shrunk to next to nothing at a grazing, as where the curve goes on along it.
    fn is_short_at_grazing(&self) -> bool {
        self.grazing_distance < AT_GRAZING && self.follower.counters().short_steps >= SHORT_AT_GRAZING
    }

    /// Whether the contact opposite to the one of a grazing curve would be struck behind the present row.
    fn strikes_opposite(&self) -> bool {
        let zeros = self.follower.current().events.zeros;
        matches!(self.kind, CurveKind::Grazing { .. }) && zeros >> OPPOSITE_BIT & 1 == 1
    }

    /// Whether the last rows made no progress, asked once in [`MANY_ROWS`].
    fn makes_no_progress(&mut self) -> bool {
        self.since.0 += 1;
        if self.since.0 < MANY_ROWS {
            return false;
        }
        let arc_length = self.follower.current().arc_length;
        let way = arc_length - self.since.1;
        self.since = (0, arc_length);
        way < LEAST_WAY
    }

    /// Whether the curve ends at an orbit that is its own image, as the present row shows; that orbit is the
    /// last row, instead of this one if it lies behind.
    fn meets_image(&mut self) -> Result<Option<CurveEnd>, OrbitError> {
        let Some(approach) = &mut self.approach else { return Ok(None) };
        let current = self.follower.current().clone();
        let place = self.problem.place(&current.point);
        let Some(met) = approach.meets(&mut self.problem, &place, &self.settings, degenerate_flip_of_half)
        else {
            return Ok(None);
        };
        let point = self.problem.point(&met.place);
        let (low, high) = self.settings.range_hz;
        let is_inside = (low..=high).contains(&met.place.frequency_hz);
        let row = if is_inside { self.row_at(&point, PathEvents::default(), met.off).ok() } else { None };
        let Some(mut row) = row.filter(|row| row.solution.residual <= SOLVES) else {
            // The path goes on from where it was evaluated.
            self.row()?;
            return Ok(None);
        };
        let (parameter, mirrored) =
            (row.parameter, half_of(row.solution.period_multiple).1 == Closing::Mirrored);
        if mirrored {
            row.events.degenerate_branch_point = true;
        } else {
            row.events.degenerate_flip = true;
        }
        self.last_row = Some(row);
        self.is_behind = met.is_behind;
        Ok(Some(CurveEnd::OwnImage { parameter, mirrored }))
    }
}

/// The first degenerate flip on the curve of flips of a map over half a period, for [`Approach`].
fn degenerate_flip_of_half(
    shooting: Shooting,
    place: &CurveOrbit,
    direction: StartDirection<'_>,
    settings: &CurveSettings,
) -> Result<Option<DegenerateFlip>, OrbitError> {
    let Ok(mut walk) = CurveWalk::of_half(shooting, place, direction, settings) else { return Ok(None) };
    walk.start_row()?;
    for _ in 0..ROWS_OF_HALF {
        let Ok(row) = walk.step()? else { break };
        if row.events.degenerate_flip {
            let place = walk.problem.place(&walk.follower.current().point);
            let (shooting, off) = (walk.problem.shooting, row.solution.error_estimate);
            return Ok(Some(DegenerateFlip { shooting, place, off }));
        }
    }
    Ok(None)
}
