//! The rows of a walk.

use hammerbeam_path::{ContinuationPoint, PathProblem};

use super::{BranchWalk, settings::hertz_per_norm};
use crate::{
    BranchRow, Crossing, Events, OrbitError, located,
    solve::{evaluate, solution},
    stability,
};

impl BranchWalk {
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

    /// The flip at the present point, at which the problem was evaluated last, as a place to leave from;
    /// `None` where there is none.
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

    /// The row of the point at which the problem was evaluated last.
    pub(crate) fn row(&mut self) -> Result<BranchRow, OrbitError> {
        let mut current = self.follower.current().clone();
        if current.events.zeros & 2 != 0 && self.pair_becomes_real(&current)? {
            current.events.zeros &= !2;
        }
        let settings = self.follower.settings();
        // Beside a rigid stop speeds that the tolerance leaves are no longer told from none.
        let at_corners =
            if self.problem.has_root_corners() { settings.correction_tolerance } else { settings.min_step };
        let place = located::Place {
            point: &current,
            bend: self.frequency_bend(),
            at_corners,
            contacts: self.contact_changes(),
            computed: self.follower.passed_corner().map(|corner| corner.uncertainty),
            before: self.near_change(&current),
        };
        let located = located::describe(&mut self.problem, place);
        Ok(BranchRow { located, ..self.row_at(&current)? })
    }

    /// What changed of the contacts since this was asked for the last time.
    fn contact_changes(&mut self) -> Vec<located::ContactChange> {
        let changes = located::contact_changes(&self.touches, self.problem.touches());
        self.touches.clear();
        self.touches.extend_from_slice(self.problem.touches());
        changes
    }

    /// The row of the present point, at which the problem was evaluated last, and before it that of a corner
    /// that was computed and lies between it and the point before: what happened did so there.
    pub(crate) fn rows_here(&mut self) -> Result<(Option<BranchRow>, BranchRow), OrbitError> {
        let passed = self.follower.passed_corner().filter(|corner| !corner.is_accepted).cloned();
        let Some(corner) = passed else { return Ok((None, self.row()?)) };
        let current = self.follower.current().clone();
        let contacts = self.contact_changes();
        evaluate(&mut self.problem, &corner.beside)?;
        let correction_norm = self.correction_due(&current.tangent);
        let at_corner = ContinuationPoint { point: corner.beside, correction_norm, ..current.clone() };
        let place = located::Place {
            point: &at_corner,
            bend: 0.0,
            at_corners: 0.0,
            contacts,
            computed: Some(corner.uncertainty),
            before: None,
        };
        let located = located::describe(&mut self.problem, place);
        let first = BranchRow { located, ..self.row_at(&at_corner)? };
        evaluate(&mut self.problem, &current.point)?;
        let without_events = ContinuationPoint { events: hammerbeam_path::Events::default(), ..current };
        Ok((Some(first), self.row_at(&without_events)?))
    }

    /// Norm of the correction normal to a direction that is due where the problem was evaluated last.
    fn correction_due(&mut self, direction: &[f64]) -> f64 {
        let weights = self.problem.weights().to_vec();
        let border: Vec<f64> = direction.iter().zip(&weights).map(|(t, w)| t * w).collect();
        if self.problem.factorise(&border).is_err() {
            return f64::INFINITY;
        }
        let mut correction: Vec<f64> = self.problem.residual().iter().copied().chain([0.0]).collect();
        self.problem.solve(&mut correction);
        correction.iter().zip(&weights).map(|(c, w)| w * c * c).sum::<f64>().sqrt()
    }

    /// Whether the pair that seems to cross the circle at a point becomes real there instead.
    fn pair_becomes_real(&mut self, point: &ContinuationPoint) -> Result<bool, OrbitError> {
        // At a corner multipliers jump, also from inside the circle to far outside.
        let is_smooth = !point.events.corner && !point.events.signature_change;
        let multipliers = self.problem.multipliers()?;
        Ok(is_smooth && stability::pair_turns_real(multipliers)
            || point.events.branch_point && stability::pair_is_nearest_to_one(multipliers))
    }

    /// The row of a point of the path at which the problem was evaluated last.
    pub(crate) fn row_at(&mut self, point: &ContinuationPoint) -> Result<BranchRow, OrbitError> {
        // The path measures in hertz, the solution relative to the orbit.
        let error_estimate = point.correction_norm / hertz_per_norm(self.range_hz);
        let solution = solution(&mut self.problem, &point.point, error_estimate)?;
        let events = Events {
            // Where the frequency turns at a branch point it does so on an arm of a pitchfork, which is no
            // fold of cycles.
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
        (base.tangent[last] - before.tangent[last]).abs() / self.last_chord().max(f64::MIN_POSITIVE)
    }

    /// Length of the last step.
    fn last_chord(&self) -> f64 {
        let history = &self.follower.checkpoint().history;
        let [base, before, ..] = history.nodes.as_slice() else { return 0.0 };
        let squares = base.point.iter().zip(&before.point).zip(self.problem.weights());
        squares.map(|((a, b), w)| w * (a - b) * (a - b)).sum::<f64>().sqrt()
    }

    /// How near contacts came to a change at the point before the present one.
    fn near_change(&self, current: &ContinuationPoint) -> Option<located::NearChange> {
        // Two of the multipliers, then as many of each kind of near miss.
        let near = self.follower.checkpoint().tests_before.get(2..)?;
        let of_kind = near.len().is_multiple_of(3).then_some(near.len() / 3).filter(|count| *count > 0)?;
        let least = |kind: usize| near[kind * of_kind].value;
        let unit = hertz_per_norm(self.range_hz);
        Some(located::NearChange {
            clearance: least(0).min(least(2)),
            squared_speed: least(1),
            chord: self.last_chord(),
            errors: [self.settings.motion_tolerance, current.correction_norm / unit],
            unit,
        })
    }
}
