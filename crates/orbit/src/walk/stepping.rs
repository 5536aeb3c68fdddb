//! From one solution of a walk to the next.

use hammerbeam_path::{ContinuationPoint, StepOutcome, StopReason as PathStop};

use super::{BranchWalk, Walked, splits::Departure};
use crate::{BranchRow, OrbitError, Segments, StopReason, solve::evaluate};

/// An orbit that has become so many times as large or small as the units in which it is measured gets new
/// units.
const OUTGROWN: f64 = 4.0;
/// At every so many accepted points the motion is gone through for its size.
const LOOK: u64 = 8;

/// Growth over a segment, as far as the largest multiplier tells, from which on the orbit is cut into more
/// segments. A segment of 3e6 makes steps of a millionth of a hertz.
const MOST_GROWTH: f64 = 1e4;

/// So often a step that fails is tried again with orbits that begin at another phase.
const MOST_FLIGHTS: u32 = 3;

impl BranchWalk {
    /// Goes to the next solution and appends its row, after those that belong between it and the row before;
    /// or says why the walk has ended.
    ///
    /// Rows are dense enough that linear interpolation of the maximum displacement over the frequency is good
    /// to 1e-3.
    ///
    /// # Errors
    /// See [`OrbitError`]; failures to go on are not errors but stop reasons.
    pub fn step(&mut self, rows: &mut Vec<BranchRow>) -> Result<Option<StopReason>, OrbitError> {
        if std::mem::take(&mut self.begins_with_present) {
            evaluate(&mut self.problem, &self.follower.current().point)?;
            rows.push(self.row()?);
            return Ok(None);
        }
        let departure = match self.depart() {
            Ok(departure) => departure,
            Err(end) => return Ok(Some(end)),
        };
        let mut from = self.follower.current().clone();
        if let Some(reason) = self.advance(&mut from)? {
            return Ok(Some(self.end_of_path(reason)));
        }
        if let Some(splits) = self.comes_to_splitting(&departure)? {
            return Ok(Some(splits));
        }
        let (at_corner, row) = match self.rows_here() {
            Ok(rows) => rows,
            Err(error @ (OrbitError::Motion(_) | OrbitError::Eigenvalues(_))) => {
                let frequency_hz = self.follower.current().parameter();
                return Ok(Some(StopReason::Motion { frequency_hz, message: error.to_string() }));
            }
            Err(error) => return Err(error),
        };
        let largest = row.solution.largest_multiplier();
        if let Some(splits) = self.is_lost_at_splitting(&departure, largest)? {
            return Ok(Some(splits));
        }
        self.journal.push(self.follower.in_first_units(self.follower.current()));
        match at_corner {
            Some(at_corner) => self.append_behind_corner(at_corner, row, rows),
            None => self.append_densely(&from, row, rows)?,
        }
        self.keep_segments_short(largest)?;
        Ok(None)
    }

    /// Goes to the next solution but gives only its frequency, phase and nodes.
    pub(crate) fn step_without_maxima(
        &mut self,
        states: &mut Vec<Walked>,
    ) -> Result<Option<StopReason>, OrbitError> {
        let departure = match self.depart() {
            Ok(departure) => departure,
            Err(end) => return Ok(Some(end)),
        };
        let mut from = self.follower.current().clone();
        if let Some(reason) = self.advance(&mut from)? {
            return Ok(Some(self.stop_reason(reason)));
        }
        if let Some(splits) = self.comes_to_splitting(&departure)? {
            return Ok(Some(splits));
        }
        self.touches.clear();
        self.touches.extend_from_slice(self.problem.touches());
        let current = self.follower.current();
        let nodes = self.problem.nodes(&current.point);
        let phase = self.problem.phase().fract();
        states.push(Walked { frequency_hz: current.parameter(), phase, nodes });
        Ok(None)
    }

    /// Makes ready to leave the present point; or why the walk ends there.
    fn depart(&mut self) -> Result<Departure, StopReason> {
        if let Some(end) = self.meets_shorter_period().or_else(|| self.crawls_to_splitting()) {
            return Err(end);
        }
        let place = self.may_split();
        if let Some(end) = self.is_too_laborious().or_else(|| self.keep_to_scale()) {
            return Err(end);
        }
        self.keep_phase_clear();
        Ok(Departure { place, work: self.work() })
    }

    /// Goes to the next point of the path, with more segments or at another phase if it does not go on with
    /// the present ones; `from` becomes the point before it.
    fn advance(&mut self, from: &mut ContinuationPoint) -> Result<Option<PathStop>, OrbitError> {
        use PathStop::{EvaluationFailed, StepTooShort};
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

    /// Why the walk ends whose path does; where a flip is too sharp to be passed, it is the end all the same.
    fn end_of_path(&mut self, reason: PathStop) -> StopReason {
        match reason {
            PathStop::StepTooShort { parameter, .. } if self.is_near_shorter_period() => {
                StopReason::ShorterPeriod { frequency_hz: parameter, grazes: false }
            }
            reason => self.stop_reason(reason),
        }
    }

    /// Measures in units that fit the present orbit, so that tolerances and steps stay relative to it.
    ///
    /// Nodes may stay where they are while the orbit grows, and be far smaller than it: the motion itself
    /// decides, at every [`LOOK`]th point, or where the nodes have outgrown the units, and then the orbit
    /// with them. Points are counted in the checkpoint.
    ///
    /// # Returns
    /// Why the walk ends, if the orbit grows without bound.
    fn keep_to_scale(&mut self) -> Option<StopReason> {
        let due = self.follower.counters().accepted.is_multiple_of(LOOK);
        if !due && self.problem.size(&self.follower.current().point) <= OUTGROWN {
            return None;
        }
        let size = self.of_present(|orbit, integrator, scale| orbit.size(integrator, scale));
        let size = size.filter(|size| size.is_normal())?;
        let end = self.grows_without_bound(size);
        if end.is_some() || (1.0 / OUTGROWN..=OUTGROWN).contains(&size) {
            return end;
        }
        // Powers of two change no digit.
        let factor = 2f64.powi(size.log2().round() as i32);
        self.problem.rescale(factor);
        self.follower.rescale(factor);
        self.last_rows.keep_newest();
        None
    }

    /// Cuts the orbit anew where its largest multiplier has outgrown the segments, before steps become so
    /// short that the walk crawls.
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
}
