//! Folds beside a simpler path, at which the sign of the slope says nothing yet.
//!
//! There a slope that has changed its sign may be rounding (`turned` in `assessment.rs`), and where it no
//! longer can be, some points later, the fold is passed. So a step at whose end the sign is another one
//! but not beyond doubt is decided by what comes: the path is followed on, without its memory, until the
//! parameter has turned beyond doubt, and then the first change of the sign was the fold; or until the old
//! sign comes back, and then it was none. Nor was it one if the old sign was rounding, too.

use super::{
    Follower, StepOutcome,
    assessment::{BESIDE, ROUNDED},
};
use crate::{corrector::CorrectorError, error::StepDoubt, problem::PathProblem, settings::Settings};

/// Points after which a change of sign is still not beyond doubt that is none.
const FARTHEST: usize = 200;

impl Follower {
    /// Whether the slope of the trial, which says nothing yet, is that behind a fold. The problem is
    /// evaluated at the trial again.
    pub(super) fn turns_for_good(&mut self, problem: &mut dyn PathProblem) -> Result<bool, StepDoubt> {
        let sign = self.state.parameter_sign;
        let before = self.state.base().tangent.last().map_or(0.0, |slope| slope * sign);
        if self.looks_ahead || before < 0.0 || self.trial.tangent_parameter() * sign >= 0.0 {
            return Ok(false);
        }
        // How many points a branch may have does not decide where its folds are.
        let settings = Settings { max_points: u64::MAX, ..self.frame.settings.clone() };
        let mut ahead = Self::resume(problem, self.checkpoint(), self.frame.range, settings);
        ahead.looks_ahead = true;
        let turns = ahead.comes_to_turn(problem);
        self.counters.evaluations = ahead.counters.evaluations + 1;
        self.counters.factorisations = ahead.counters.factorisations;
        let evaluated = problem.evaluate(&self.trial.point);
        evaluated.map_err(|error| StepDoubt::Corrector(CorrectorError::Evaluation(error)))?;
        Ok(turns)
    }

    /// Whether the parameter has gone with its sign. On a path that has just left a branch point the sign
    /// with which it begins may be rounding: where the parameter has gone the other way from there on, there
    /// is no fold, and the sign is the other one.
    pub(super) fn has_gone_its_way(&self) -> bool {
        let (state, settings) = (&self.state, &self.frame.settings);
        let (here, start) = (&state.current, &state.start);
        if !state.has_start() || here.arc_length > BESIDE * settings.sheet_distance {
            return true;
        }
        let way = (here.parameter() - start.parameter()) * state.parameter_sign;
        way >= -ROUNDED * here.parameter().abs()
    }

    /// Whether the path turns beyond doubt before its slope has the old sign again.
    fn comes_to_turn(&mut self, problem: &mut dyn PathProblem) -> bool {
        for point in 0..FARTHEST {
            if self.step(problem) != StepOutcome::Accepted {
                return false;
            }
            let events = self.current().events;
            // Where the simpler path itself is met the slope is rounding all the way.
            if events.fold || events.branch_point {
                return events.fold && !events.branch_point;
            }
            if point > 0 && self.current().tangent_parameter() * self.state.parameter_sign > 0.0 {
                return false;
            }
        }
        false
    }
}
