//! The same path in other equations: the determinant jumps to the other sign, the tangent does not turn.
//!
//! So it is when a problem is cut into other segments, and at grazing of laws whose force jumps. Sheets that
//! run opposite ways beside each other would look the same within one step; they must therefore be excluded
//! by a look ahead.

use super::{Arrival, Follower};
use crate::{
    corrector::Limits,
    error::Doubt,
    problem::PathProblem,
    product::{add_scaled, weigh},
};

/// How far ahead the path must go on straight, in steps.
const LOOK_AHEAD: f64 = 1e3;

impl Follower {
    /// Passes a change of signature at which the determinant changes its sign without a branch point, in a
    /// step of the shortest length, and anchors the orientation anew.
    ///
    /// # Errors
    /// The path does not go on straight: the branch stops.
    pub(super) fn pass_recut(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
    ) -> Result<(Arrival, f64), Doubt> {
        weigh(&self.weights, &self.state.history.base().tangent, &mut self.row);
        self.correct_ahead(problem, LOOK_AHEAD * step, step)?;
        let ahead = (self.trial.sign, self.trial.signature);
        self.correct_ahead(problem, step, step)?;
        let recut = ahead == (self.trial.sign, self.trial.signature)
            && self.trial.sign * self.state.orientation < 0.0
            && self.trial.signature != self.state.current.signature;
        if !recut {
            return Err(Doubt::Reversed);
        }
        self.check_defect(step)?;
        Ok((Arrival { anchors_anew: true, ..Arrival::default() }, step))
    }

    /// Corrects the trial in the plane this far ahead, with the displacement allowed for the step.
    fn correct_ahead(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        distance: f64,
        step: f64,
    ) -> Result<(), Doubt> {
        let base = self.state.history.base();
        self.trial.point.copy_from_slice(&base.point);
        add_scaled(&mut self.trial.point, distance, &base.tangent);
        let bend = distance * distance;
        let limits = Limits {
            max_displacement: self.settings.allowed_displacement(step) + bend,
            ..self.limits(distance)
        };
        self.trial
            .correct(problem, &self.weights, &self.row, limits, &mut self.state.counters)
            .map_err(Doubt::Corrector)
    }
}
