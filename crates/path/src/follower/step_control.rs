//! Step lengths: from the angle between tangents, the corrector's displacement and its effort.
//!
//! With a predictor of error order `p` a step `f h` has `f^p` times the displacement and about `f` times the
//! angle. Aimed at is half the largest angle and a quarter of the allowed displacement.

use super::attempt::Frame;
use crate::{
    corrector::{Candidate, CorrectorError},
    error::{PathStop, StepDoubt},
    predictor::order,
    product::distance,
    state::PathState,
};

/// Steps grow at most by this factor, so that after an event they stay in proportion to the distance from it.
const MOST_GROWTH: f64 = 2.0;
/// So many last corrections of the displacement are put down to rounding: steps do not shrink on account of
/// it.
const NOISE: f64 = 4.0;
/// Evaluations until corrections are small, up to which steps may grow.
const MOST_EFFORT: u32 = 3;

/// So many halvings of a step that meets an old stretch are enough to know that the jump was made earlier.
const MOST_RETRACED: u32 = 8;

/// The attempts at one step so far, and how the next one is made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Attempts {
    /// How many were given up.
    pub rejected: u32,
    retraced: u32,
    /// Most earlier points for the predictor.
    pub most_earlier: usize,
    /// Length of the step.
    pub step: f64,
}

impl Attempts {
    /// None yet, with the length of the first.
    pub fn at(frame: &Frame, state: &PathState) -> Self {
        let step = first_step(frame, state);
        Self { rejected: 0, retraced: 0, most_earlier: state.most_earlier, step }
    }

    /// Length of the next attempt after one that was rejected.
    ///
    /// The second rejection falls back to the next simpler predictor, the third to the tangent.
    pub fn reject(&mut self, doubt: StepDoubt, max_angle: f64) -> f64 {
        self.rejected += 1;
        if doubt == StepDoubt::Signature {
            return 0.5 * self.step;
        }
        if self.rejected > 1 {
            self.most_earlier = self.most_earlier.saturating_sub(1);
        }
        self.step
            * match doubt {
                StepDoubt::Corrector(CorrectorError::Displaced { displacement, allowed }) => {
                    (0.25 * allowed / displacement).powf(1.0 / order(self.most_earlier)).clamp(0.1, 0.5)
                }
                StepDoubt::Corrector(CorrectorError::Turned { angle }) | StepDoubt::Angle { angle } => {
                    (0.5 * max_angle / angle).clamp(0.25, 0.5)
                }
                StepDoubt::Corrector(_) => 0.25,
                StepDoubt::Retraced { .. } => {
                    self.retraced += 1;
                    0.5
                }
                _ => 0.5,
            }
    }

    /// Why the branch ends, if shorter and shorter steps go on along a stretch that was walked before.
    ///
    /// * `shorter`: length of the next attempt.
    pub fn retraces(
        &self,
        frame: &Frame,
        state: &PathState,
        doubt: StepDoubt,
        shorter: f64,
    ) -> Option<PathStop> {
        let StepDoubt::Retraced { arc_length: met_arc_length } = doubt else { return None };
        let parameter = state.current.parameter();
        (shorter < frame.settings.min_step || self.retraced > MOST_RETRACED)
            .then_some(PathStop::RunsBack { parameter, met_arc_length })
    }
}

/// Length of the first attempt at a step.
fn first_step(frame: &Frame, state: &PathState) -> f64 {
    let settings = &frame.settings;
    let mut step = state.step_length.min(longest_step(frame, state));
    if state.change_ahead > 0.0 {
        step = step.min((0.5 * state.change_ahead).max(settings.signature_step));
    }
    step.max(settings.min_step)
}

/// `h ≤ max_step_length` and `h (|t_λ| + |t_λ'| h) ≤ max_parameter_step`, with `t_λ'` from the last step.
fn longest_step(frame: &Frame, state: &PathState) -> f64 {
    let (history, settings) = (&state.history, &frame.settings);
    let base = history.base();
    let last = base.point.len() - 1;
    let slope = base.tangent[last].abs();
    let most = settings.max_parameter_step;
    if history.used < 2 || !most.is_finite() {
        return settings.longest_step(slope);
    }
    let before = &history.nodes[1];
    let length = distance(&frame.weights, &base.point, &before.point);
    let bend = (base.tangent[last] - before.tangent[last]).abs() / length;
    let root = (slope * slope + 4.0 * bend * most).sqrt();
    settings.max_step_length.min(2.0 * most / (slope + root).max(f64::MIN_POSITIVE))
}

/// An accepted step, for the length of the next one.
pub(super) struct Accepted<'a> {
    pub trial: &'a Candidate,
    pub step: f64,
    /// Angle between the tangents.
    pub angle: f64,
    /// Earlier nodes that the predictor used.
    pub earlier: usize,
    /// Attempts that were given up before.
    pub rejected: u32,
}

/// Length of the next step after an accepted one, which led to the present point of `state`.
pub(super) fn next_step(frame: &Frame, state: &PathState, accepted: &Accepted<'_>) -> f64 {
    let &Accepted { trial, step, angle, earlier, rejected } = accepted;
    let by_angle = 0.5 * frame.settings.max_angle / angle.max(1e-12);
    let target = 0.25 * frame.allowed_displacement(&state.current, step);
    let displacement = trial.displacement - NOISE * trial.correction_norm;
    let by_displacement = (target / displacement.max(1e-300)).powf(1.0 / order(earlier));
    let effort = if trial.effort > MOST_EFFORT { 0.7 } else { MOST_GROWTH };
    let hold = if rejected > 0 { 1.0 } else { MOST_GROWTH };
    let factor = by_angle.min(by_displacement).min(effort).min(hold).max(0.3);
    (step * factor).max(frame.settings.min_step)
}
