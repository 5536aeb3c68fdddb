//! The rows of a walk.

use hammerbeam_path::{ContinuationPoint, Judge, PathProblem, weighed};

use super::{
    last_rows::{LastRows, RowPlace},
    orbit_path::OrbitPath,
};
use crate::{
    BranchRow, Events, OrbitError, located,
    solve::{evaluate, solution, update_here},
    stability,
};

/// What the next row is compared with, and what was spent on rows that are no points of the path.
#[derive(Debug, Clone, Default)]
pub(crate) struct RowRecord {
    /// Touches of each contact at the row before.
    pub touches: Vec<u32>,
    /// Least and most number of multipliers outside the unit circle at the row before, once there is one.
    pub outside: Option<(u32, u32)>,
    /// For the density of rows.
    pub last_rows: LastRows,
    /// That of the response, whose maximum displacement rows show.
    pub shape: Vec<f64>,
    /// Shooting evaluations spent on rows between points of the path.
    pub evaluations_between: u64,
}

impl RowRecord {
    /// At the start of a walk, whose maximum displacement of the response with this shape is given.
    pub fn at_start(path: &OrbitPath, displacement: f64, shape: &[f64]) -> Self {
        let last_rows = LastRows(vec![RowPlace::new(path.current(), displacement)]);
        let (touches, shape) = (path.problem.touches().to_vec(), shape.to_vec());
        Self { touches, last_rows, shape, ..Self::default() }
    }

    /// The row of the point at which the problem was evaluated last.
    pub fn row(&mut self, path: &mut OrbitPath) -> Result<BranchRow, OrbitError> {
        let mut current = path.current().clone();
        if current.events.zeros & 2 != 0 && pair_becomes_real(path, &current)? {
            current.events.zeros &= !2;
        }
        let settings = path.follower.settings();
        // Beside a rigid stop speeds that the tolerance leaves are no longer distinguished from none.
        let at_corners =
            if path.problem.has_root_corners() { settings.correction_tolerance } else { settings.min_step };
        let approach = located::Approach::of(&path.follower, &path.problem, &current);
        let place = located::EventLocation {
            at_corners,
            contacts: self.contact_changes(path),
            computed: path.follower.passed_corner().map(|corner| corner.uncertainty),
            ..located::EventLocation::reached(&current, approach)
        };
        let located = located::describe(&mut path.problem, place);
        Ok(BranchRow { located, ..row_at(path, &current)? })
    }

    /// What changed of the contacts since this was asked for the last time.
    fn contact_changes(&mut self, path: &OrbitPath) -> Vec<located::ContactChange> {
        let changes = located::contact_changes(&self.touches, path.problem.touches());
        self.note_touches(path);
        changes
    }

    /// Notes the touches of the orbit at which the problem was evaluated last.
    pub fn note_touches(&mut self, path: &OrbitPath) {
        self.touches.clear();
        self.touches.extend_from_slice(path.problem.touches());
    }

    /// The row of the present point, at which the problem was evaluated last, and before it the row of a
    /// corner that was computed and lies between it and the point before: what happened did so there.
    pub fn rows_here(&mut self, path: &mut OrbitPath) -> Result<(Option<BranchRow>, BranchRow), OrbitError> {
        let passed = path.follower.passed_corner().filter(|corner| !corner.is_accepted).cloned();
        let Some(corner) = passed else { return Ok((None, self.row(path)?)) };
        let current = path.current().clone();
        let contacts = self.contact_changes(path);
        evaluate(&mut path.problem, &corner.beside)?;
        let correction_norm = correction_due(path, &current.tangent);
        let at_corner = ContinuationPoint { point: corner.beside, correction_norm, ..current.clone() };
        let place = located::EventLocation {
            contacts,
            ..located::EventLocation::alone(&at_corner, Some(corner.uncertainty))
        };
        let located = located::describe(&mut path.problem, place);
        let first = BranchRow { located, ..row_at(path, &at_corner)? };
        evaluate(&mut path.problem, &current.point)?;
        let without_events = ContinuationPoint { events: hammerbeam_path::PathEvents::default(), ..current };
        Ok((Some(first), row_at(path, &without_events)?))
    }
}

/// The row of a point of the path at which the problem was evaluated last.
pub(super) fn row_at(path: &mut OrbitPath, point: &ContinuationPoint) -> Result<BranchRow, OrbitError> {
    // The path measures in arc length, the solution relative to the orbit.
    let error_estimate = point.correction_norm / path.length_per_norm();
    let solution = solution(&mut path.problem, &point.point, error_estimate)?;
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
    let parameter = path.problem.varied().parameter().map(|_| point.parameter());
    Ok(BranchRow { solution, parameter, events, located: None })
}

/// Norm of the correction normal to a direction that is due where the problem was evaluated last.
fn correction_due(path: &mut OrbitPath, direction: &[f64]) -> f64 {
    let problem = &mut path.problem;
    let border = weighed(problem.weights(), direction);
    update_here(problem, &border).map_or(f64::INFINITY, |(_, size)| size)
}

/// Whether the pair that seems to cross the circle at a point becomes real there instead.
fn pair_becomes_real(path: &mut OrbitPath, point: &ContinuationPoint) -> Result<bool, OrbitError> {
    // At a corner multipliers jump, also from inside the circle to far outside.
    let is_smooth = !point.events.corner && !point.events.signature_change;
    // Pairs that stay on the circle, as some do without damping, do not cross it.
    let left_out = path.follower.tests().before.get(1).map_or(0, |test| test.left_out);
    let multipliers = stability::without_pairs(path.problem.spectrum()?, left_out);
    Ok(is_smooth && stability::pair_turns_real(&multipliers)
        || point.events.branch_point && stability::pair_is_nearest_to_one(&multipliers))
}

/// Largest magnitude of the multipliers of the present orbit; infinite where they cannot be had.
pub(super) fn largest_multiplier(path: &mut OrbitPath) -> f64 {
    let point = path.current().clone();
    let row = evaluate(&mut path.problem, &point.point).and_then(|()| row_at(path, &point));
    row.map_or(f64::INFINITY, |row| row.solution.largest_multiplier())
}
