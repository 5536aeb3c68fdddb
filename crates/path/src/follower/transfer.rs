//! Going on with other unknowns for the same path.
//!
//! A problem may change its unknowns on the way, as when a boundary value problem is cut into more pieces.
//! What a follower knows is carried over: the start, against which a closed path is recognised; the arc
//! length, the counters, the sense of the parameter and of the determinant; and the memory, which holds only
//! the part of the unknowns that stays ([`Judge::memory_weights`](crate::Judge::memory_weights)).
//!
//! Where nothing of the unknowns stays, the memory begins anew ([`Follower::transfer_afresh`]): what was
//! walked before is then not recognised again. The start may have no unknowns of the new kind; it is out of
//! reach then, and no path closes, until a later transfer brings it back.

use super::{
    Follower,
    direction::StartDirection,
    start::{check_length, first_border, start_limits},
};
use crate::{
    checkpoint::Checkpoint,
    corrector::Candidate,
    error::PathError,
    point::{ContinuationPoint, Counters},
    predictor::{History, Node},
    problem::PathProblem,
};

impl Follower {
    /// Goes on from the present point in the unknowns that the problem has now; the problem was then
    /// evaluated last there.
    ///
    /// The sign of `det [R_x R_λ; (W t)ᵀ]` and the memory weights must be the same as before. The predictor
    /// begins anew.
    ///
    /// * `current`, `start`: the present point and the start in the new unknowns, with the directions of
    ///   travel there (any length). Both are corrected in the plane normal to the direction. Without a start
    ///   no path closes, until a later transfer brings it back.
    ///
    /// # Errors
    /// [`PathError::Start`] if one of them is not near the path, [`PathError::OtherOrientation`],
    /// [`PathError::WrongLength`]; the follower is then as it was.
    pub fn transfer(
        &mut self,
        problem: &mut dyn PathProblem,
        current: &Node,
        start: Option<&Node>,
    ) -> Result<(), PathError> {
        let memory = self.memory.clone();
        let old = self.state.start.clone();
        self.transfer_afresh(problem, current, start.map(|start| (start, &old)))?;
        self.memory = memory;
        Ok(())
    }

    /// [`transfer`](Self::transfer) to unknowns none of which is the same: the memory begins anew, with the
    /// present point.
    ///
    /// * `start`: in the new unknowns, and the point that it is in the old ones or was in earlier ones (whose
    ///   orientation and events stay); `None` where it has none of the new kind.
    ///
    /// # Errors
    /// Those of [`transfer`](Self::transfer).
    pub fn transfer_afresh(
        &mut self,
        problem: &mut dyn PathProblem,
        current: &Node,
        start: Option<(&Node, &ContinuationPoint)>,
    ) -> Result<(), PathError> {
        let mut counters = self.counters;
        let start = match start {
            Some((start, old)) => self.in_new_unknowns(problem, start, old, &mut counters)?.0,
            None => out_of_reach(problem.weights().len()),
        };
        let (current, node) = self.in_new_unknowns(problem, current, &self.state.current, &mut counters)?;
        let mut state = self.state.clone();
        state.history = History::new(current.point.len());
        state.history.push(&node);
        state.step_length = state.step_length.min(self.frame.settings.initial_step);
        state.stop = None;
        (state.start, state.current) = (start, current);
        let checkpoint = Checkpoint { state, tests: self.tests.clone(), counters };
        *self = Self::resume(problem, checkpoint, self.frame.range, self.frame.settings.clone());
        self.memory.remember(&self.state.current, &self.state.units);
        Ok(())
    }

    /// Forgets all points so far, as [`transfer_afresh`](Self::transfer_afresh) did; for
    /// [`remember`](Self::remember).
    pub fn forget(&mut self) {
        self.memory.clear();
    }

    /// The old point in the new unknowns, and the node of the predictor there.
    fn in_new_unknowns(
        &self,
        problem: &mut dyn PathProblem,
        guess: &Node,
        old: &ContinuationPoint,
        counters: &mut Counters,
    ) -> Result<(ContinuationPoint, Node), PathError> {
        let weights = problem.weights().to_vec();
        check_length(guess.point.len(), weights.len())?;
        let row = first_border(StartDirection::Along(&guess.tangent), &weights)?;
        let mut trial = Candidate::new(weights.len());
        trial.point.copy_from_slice(&guess.point);
        let parameter = trial.parameter();
        trial
            .correct(problem, &weights, &row, start_limits(&self.frame.settings), counters)
            .map_err(|cause| PathError::Start { parameter, cause })?;
        if trial.sign * old.orientation < 0.0 {
            return Err(PathError::OtherOrientation { parameter });
        }
        let point = ContinuationPoint {
            point: trial.point,
            tangent: trial.node.tangent.clone(),
            signature: trial.signature,
            log_determinant: trial.log_determinant,
            correction_norm: trial.correction_norm,
            residual_norm: trial.residual_norm,
            ..old.clone()
        };
        Ok((point, trial.node))
    }
}

/// A point that no path comes to.
fn out_of_reach(length: usize) -> ContinuationPoint {
    let mut point = ContinuationPoint::empty(length);
    point.point[length - 1] = f64::INFINITY;
    point
}
