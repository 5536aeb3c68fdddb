//! Beyond a place where no short step is beyond doubt: a longer one.
//!
//! Beside a branch point the bordered matrix is nearly singular, and rounding of the residual moves corrected
//! points by more than a short step allows; so it is wherever the problem is known less well than elsewhere.
//! A longer step, straight on, may be beyond doubt where no short one is. If the sign of the determinant is
//! another one there, a branch point was passed, which is known to lie within the step.

use super::{Arrival, Follower};
use crate::{
    error::Doubt,
    point::Events,
    problem::PathProblem,
    product::{add_scaled, weigh},
};

/// Lengths that are tried, in shortest steps.
const REACHES: [f64; 5] = [1e2, 1e3, 1e4, 1e5, 1e6];

impl Follower {
    /// Passes a place at which short steps fail, in a longer one.
    ///
    /// # Errors
    /// No such step goes straight on along the same arc.
    pub(super) fn leap(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
    ) -> Result<(Arrival, f64), Doubt> {
        for reach in REACHES {
            let length = reach * self.settings.min_step;
            if 0.1 * length > self.settings.sheet_distance {
                break;
            }
            let arrival = self.leap_over(problem, length);
            if let Ok(arrival) = arrival.and_then(|arrival| self.heed_simpler(problem, arrival)) {
                return Ok((arrival, length));
            }
        }
        Err(Doubt::NotLocated)
    }

    fn leap_over(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        length: f64,
    ) -> Result<Arrival, Doubt> {
        let base = self.state.history.base();
        weigh(&self.weights, &base.tangent, &mut self.row);
        self.trial.point.copy_from_slice(&base.point);
        add_scaled(&mut self.trial.point, length, &base.tangent);
        let limits = self.limits(length);
        self.trial
            .correct(problem, &self.weights, &self.row, limits, &mut self.state.counters)
            .map_err(Doubt::Corrector)?;
        if self.trial.signature != self.state.current.signature {
            return Err(Doubt::Signature);
        }
        if !self.range.contains(self.trial.parameter()) {
            return Err(Doubt::NotLocated);
        }
        // Without orienting it, the tangent goes on in the direction of the last one.
        self.check_defect(length)?;
        let branch_point = self.trial.sign * self.state.orientation < 0.0;
        let slope = self.trial.tangent_parameter();
        let fold = self.turned(problem, slope);
        Ok(Arrival {
            events: Events { branch_point, fold, ..Events::default() },
            parameter_sign: fold.then(|| slope.signum()),
            anchors_anew: branch_point,
            uncertainty: length,
            ..Arrival::default()
        })
    }
}
