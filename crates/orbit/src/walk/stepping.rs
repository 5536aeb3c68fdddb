//! From one solution of a walk to the next.

use hammerbeam_path::{ContinuationPoint, PathStop, StepOutcome};

use super::{
    BranchWalk, Walked,
    end::{end_of_path, stop_reason},
    half_orbit::end_in_flip,
    lost_start::passed_lost_start,
    reopening::{Departure, comes_to_reopening, is_lost_at_reopening, may_reopen, tends_to_reopening, work},
    resegment::resegment,
    shorter_period::{grazes_shorter_period, meets_shorter_period},
    start_phase::{flee_phase, keep_phase_clear},
    symmetric::has_come_to_symmetric,
};
use crate::{BranchRow, OrbitError, Segments, StopReason, solve::evaluate};

/// An orbit that has become so many times as large or small as the units in which it is measured gets new
/// units.
const OUTGROWN: f64 = 4.0;
/// At every so many accepted points the motion is gone through for its size.
const LOOK: u64 = 16;

/// Growth over a segment, as far as the largest multiplier shows, from which on the orbit is cut into more
/// segments. A segment of 3e6 makes steps of a millionth of a hertz.
const MOST_GROWTH: f64 = 1e4;

/// So often a step that fails is tried again with orbits that start at another phase.
const MOST_FLIGHTS: u32 = 3;

impl BranchWalk {
    /// Goes to the next solution and appends its row, after those that belong between it and the row before;
    /// or says why the walk has ended, then with the rows that still belong to it; it is not to be called
    /// again then.
    ///
    /// Rows are dense enough that linear interpolation of the maximum displacement over the frequency is good
    /// to 1e-3 of it, or of a millionth of the motion if that is more (`density.rs`).
    ///
    /// # Errors
    /// See [`OrbitError`]; failures to go on are not errors but stop reasons.
    pub fn step(&mut self, rows: &mut Vec<BranchRow>) -> Result<Option<StopReason>, OrbitError> {
        if std::mem::take(&mut self.starts_with_present) {
            evaluate(&mut self.path.problem, &self.path.follower.current().point)?;
            rows.push(self.record.row(&mut self.path)?);
            return Ok(None);
        }
        let departure = match self.depart() {
            Ok(departure) => departure,
            Err(end) => return end_in_flip(&mut self.path, &mut self.record, end, rows).map(Some),
        };
        let mut from = self.path.current().clone();
        if let Some(reason) = self.advance(&mut from)? {
            let end = end_of_path(&mut self.path, reason);
            return end_in_flip(&mut self.path, &mut self.record, end, rows).map(Some);
        }
        let Self { path, record, .. } = self;
        if let Some((last, reopening)) = comes_to_reopening(path, record, &departure, &from)? {
            record.append_last(path, [&from, &last], rows)?;
            return Ok(Some(reopening));
        }
        if let Some(start) = passed_lost_start(path, &from)? {
            record.append_last(path, [&from, &start], rows)?;
            return Ok(Some(StopReason::Closed));
        }
        self.append_here((&departure, &from), rows)
    }

    /// Appends the row of the present point, after those that belong between it and the row before; or says
    /// why the walk ends there.
    fn append_here(
        &mut self,
        (departure, from): (&Departure, &ContinuationPoint),
        rows: &mut Vec<BranchRow>,
    ) -> Result<Option<StopReason>, OrbitError> {
        let Self { path, record, .. } = self;
        let (at_corner, row) = match record.rows_here(path) {
            Ok(rows) => rows,
            Err(error @ (OrbitError::Motion(_) | OrbitError::Eigenvalues(_))) => {
                let place = path.parameter();
                return Ok(Some(StopReason::Motion { place, message: error.to_string() }));
            }
            Err(error) => return Err(error),
        };
        let largest = row.solution.largest_multiplier();
        if let Some(reopening) = is_lost_at_reopening(path, departure, largest)? {
            return Ok(Some(reopening));
        }
        if let Some(at_corner) = at_corner.as_ref().filter(|_| grazes_shorter_period(path)) {
            let place = at_corner.parameter.unwrap_or(at_corner.solution.frequency_hz);
            rows.push(at_corner.clone());
            return Ok(Some(StopReason::ShorterPeriod { place, grazes: true }));
        }
        path.note_in_journal();
        match at_corner {
            Some(at_corner) => record.append_behind_corner(path, at_corner, row, rows),
            None => {
                let to = path.current().clone();
                record.append_densely(path, [from, &to], row, rows)?;
            }
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
        let mut from = self.path.current().clone();
        if let Some(reason) = self.advance(&mut from)? {
            return Ok(Some(stop_reason(&mut self.path, reason)));
        }
        let Self { path, record, .. } = self;
        if let Some((_, reopening)) = comes_to_reopening(path, record, &departure, &from)? {
            return Ok(Some(reopening));
        }
        if passed_lost_start(path, &from)?.is_some() {
            return Ok(Some(StopReason::Closed));
        }
        record.note_touches(path);
        let nodes = path.problem.nodes(&path.current().point);
        let phase = path.problem.phase().fract();
        states.push(Walked { frequency_hz: path.parameter(), phase, nodes });
        Ok(None)
    }

    /// Makes ready to leave the present point; or why the walk ends there.
    fn depart(&mut self) -> Result<Departure, StopReason> {
        let path = &mut self.path;
        if let Some(end) = meets_shorter_period(path).or_else(|| tends_to_reopening(path)) {
            return Err(end);
        }
        let place = may_reopen(path);
        let evaluations = self.evaluations();
        let used_up = self.effort.end_of(&self.path, evaluations);
        if let Some(end) = used_up.or_else(|| self.keep_to_scale()) {
            return Err(end);
        }
        keep_phase_clear(&mut self.path);
        self.renew_record();
        Ok(Departure { place, work: work(&mut self.path) })
    }

    /// Goes to the next point of the path, with more segments or at another phase if it does not go on with
    /// the present ones; `from` becomes the point before it.
    fn advance(&mut self, from: &mut ContinuationPoint) -> Result<Option<PathStop>, OrbitError> {
        use PathStop::{EvaluationFailed, StepTooShort};
        let mut flights = 0;
        loop {
            let path = &mut self.path;
            from.clone_from(path.follower.current());
            match path.follower.step(&mut path.problem) {
                StepOutcome::Accepted => return Ok(None),
                // Cut anew it would go on along the symmetric orbits.
                StepOutcome::Stopped(reason) if has_come_to_symmetric(path) => return Ok(Some(reason)),
                StepOutcome::Stopped(StepTooShort { .. } | EvaluationFailed { .. })
                    if flights < MOST_FLIGHTS && flee_phase(path) =>
                {
                    flights += 1;
                    self.renew_record();
                }
                StepOutcome::Stopped(reason @ (StepTooShort { .. } | EvaluationFailed { .. }))
                    if path.settings.segments == Segments::Automatic =>
                {
                    let goes_on = resegment(path);
                    self.renew_record();
                    match goes_on {
                        Ok(true) => {}
                        Ok(false) | Err(OrbitError::Motion(_)) => return Ok(Some(reason)),
                        Err(error) => return Err(error),
                    }
                }
                StepOutcome::Stopped(reason) => return Ok(Some(reason)),
            }
        }
    }

    /// Measures in units that fit the present orbit, so that tolerances and steps stay relative to it.
    ///
    /// Nodes may stay where they are while the orbit grows, and be far smaller than it: the motion itself
    /// decides, at every [`LOOK`]th point, or where the nodes have outgrown the units, and then the orbit
    /// with them. Points are counted in the checkpoint. Displacements are measured beside velocities as the
    /// present frequency asks: with the units of a fast orbit a slow one would be known too coarsely.
    ///
    /// # Returns
    /// Why the walk ends, if its amplitude has no bound.
    fn keep_to_scale(&mut self) -> Option<StopReason> {
        let path = &mut self.path;
        let due = path.follower.counters().accepted.is_multiple_of(LOOK);
        if !due && path.problem.size(&path.follower.current().point) <= OUTGROWN {
            return None;
        }
        let (fitting, size) = path.of_present(|orbit, integrator, _| orbit.fitting_scale(integrator))?;
        if !size.is_normal() {
            return None;
        }
        let end = self.growth.end_of(path, size, &self.record.touches);
        let units = fitting.values().iter().zip(path.problem.scale().values());
        let outgrown: Vec<f64> = units.map(|(fitting, present)| fitting / present).collect();
        if end.is_some() || outgrown.iter().all(|factor| (1.0 / OUTGROWN..=OUTGROWN).contains(factor)) {
            return end;
        }
        // Powers of two change no digit.
        let factors: Vec<f64> =
            outgrown.iter().map(|factor| 2f64.powi(factor.log2().round() as i32)).collect();
        path.problem.rescale(&factors);
        path.follower.rescale(&factors);
        path.measures_anew = true;
        None
    }

    /// Cuts the orbit anew where its largest multiplier has outgrown the segments, before steps become so
    /// short that the walk does not get anywhere.
    fn keep_segments_short(&mut self, largest: f64) -> Result<(), OrbitError> {
        let path = &mut self.path;
        let outgrown = largest.ln() > path.problem.segments() as f64 * MOST_GROWTH.ln();
        if path.settings.segments != Segments::Automatic || !outgrown || path.follower.stop_reason().is_some()
        {
            return Ok(());
        }
        let cut = resegment(path);
        self.renew_record();
        match cut {
            Ok(_) | Err(OrbitError::Motion(_)) => Ok(()),
            Err(error) => Err(error),
        }
    }

    /// Rows before a change of how lengths are measured say nothing of the next ones.
    fn renew_record(&mut self) {
        if std::mem::take(&mut self.path.measures_anew) {
            self.record.last_rows.keep_newest();
        }
    }
}
