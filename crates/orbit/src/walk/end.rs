//! Why the path of a walk ended, in terms of orbits.

use hammerbeam_path::PathStop;

use super::{
    chatter::chatters,
    growth::{end_at_mode, free_mode, has_no_losses, is_far_beyond_gaps},
    last_motion::LastMotion,
    orbit_path::OrbitPath,
    reopening::reopens_here,
    row::largest_multiplier,
    shorter_period::is_near_shorter_period,
    symmetric::has_come_to_symmetric,
    together::struck_together,
};
use crate::StopReason;

/// Largest multiplier from which an orbit may part from its guess within a period, and be lost.
const HARDLY_FOLLOWED: f64 = 1e5;

/// Why the walk ends whose path does; where a flip is too sharp to be passed, it is the end all the same.
pub(super) fn end_of_path(path: &mut OrbitPath, reason: PathStop) -> StopReason {
    match reason {
        PathStop::StepTooShort { parameter, .. } if is_near_shorter_period(path) => {
            StopReason::ShorterPeriod { place: parameter, grazes: false }
        }
        PathStop::StepTooShort { parameter, .. } | PathStop::RunsBack { parameter, .. }
            if has_come_to_symmetric(path) =>
        {
            StopReason::Symmetric { place: parameter }
        }
        reason => {
            let reason = stop_reason(path, reason);
            in_words_of_mechanics(path, &reason).unwrap_or(reason)
        }
    }
}

/// What happens to the motion where a walk gets no further.
fn in_words_of_mechanics(path: &mut OrbitPath, reason: &StopReason) -> Option<StopReason> {
    let gets_no_further = matches!(reason, StopReason::StepTooShort { .. } | StopReason::RunsBack { .. });
    let place = reason.place().filter(|_| gets_no_further)?;
    if let Some(reason) = end_at_impacts(path, place) {
        return Some(reason);
    }
    let mode = free_mode(path);
    let has_no_bound = mode.is_some() || has_no_losses(path.problem.system()) && is_far_beyond_gaps(path);
    has_no_bound.then(|| end_at_mode(path, place, mode))
}

/// What the impacts of the last motion have to do with it.
fn end_at_impacts(path: &mut OrbitPath, place: f64) -> Option<StopReason> {
    if !path.problem.system().has_rigid_stops() {
        return None;
    }
    let motion = LastMotion::of(path)?;
    let system = path.problem.system();
    if let Some((elements, phase)) = struck_together(system, &motion) {
        return Some(StopReason::ImpactsTogether { place, elements, phase });
    }
    let (element, impacts) = chatters(system, &motion)?;
    Some(StopReason::Chatter { place, element, impacts })
}

/// The reason of a path, in terms of orbits.
pub(super) fn stop_reason(path: &mut OrbitPath, reason: PathStop) -> StopReason {
    let place = path.parameter();
    let has_no_losses = has_no_losses(path.problem.system());
    match reason {
        PathStop::RangeEnd => StopReason::RangeEnd { place },
        PathStop::Closed => StopReason::Closed,
        PathStop::StepTooShort { step, residual, doubt, .. } => {
            reopens_here(path, place).unwrap_or_else(|| {
                let doubt = doubt_in_unstable(path, doubt.to_string());
                StopReason::StepTooShort { place, step, residual, doubt, has_no_losses }
            })
        }
        PathStop::NoProgress { steps, .. } => {
            reopens_here(path, place).unwrap_or_else(|| StopReason::NoProgress {
                place,
                solutions: steps,
                largest_multiplier: largest_multiplier(path),
                has_no_losses,
            })
        }
        PathStop::RunsBack { parameter, met_arc_length } => {
            StopReason::RunsBack { place: parameter, met_arc_length, has_no_losses }
        }
        PathStop::EvaluationFailed { parameter, error, .. } => {
            let message = path.problem.failure().map_or_else(|| error.to_string(), ToString::to_string);
            reopens_here(path, place).unwrap_or(StopReason::Motion { place: parameter, message })
        }
        PathStop::Budget => StopReason::Budget { solutions: path.follower.counters().accepted as usize },
    }
}

/// What was wrong with the last step, and how unstable the orbit is if that is why: the limits of
/// `shooting.rs`.
fn doubt_in_unstable(path: &mut OrbitPath, doubt: String) -> String {
    let largest = largest_multiplier(path);
    if largest < HARDLY_FOLLOWED {
        return doubt;
    }
    format!("{doubt}; in a period of the motion a disturbance of it becomes {largest:.1e} times as large")
}
