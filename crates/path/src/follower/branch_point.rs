//! Locating a branch point: the zero of `D = det [R_x R_λ; (W t)ᵀ]` on the way to the trial.
//!
//! A jump to a sheet that runs the other way also changes the sign of `D`, but there `D` has no zero between:
//! the bracket shrinks and `|D|` does not. This distinguishes the two.

use super::{arrival::Arrival, attempt::Attempt, beside, bracket::Bracket, locator::Locator};
use crate::{
    corrector::CorrectorError,
    error::StepDoubt,
    point::PathEvents,
    product::{norm, scale},
};

const MOST_PROBES: u32 = 40;
/// `|D|` relative to the ends of the step at which the search ends.
const SHARP: f64 = 1e-8;
/// `|D|` relative to the ends of the step that is needed for a branch point.
const VANISHING: f64 = 1e-3;
/// If `|D|` did not fall below `JUMP_SIZE` of the ends when the bracket has this share of the step, it jumps.
const JUMP_WIDTH: f64 = 1e-2;
const JUMP_SIZE: f64 = 0.1;
/// A branch point at which a simpler path is met is known to within so many distances of sheets from it,
const MET: f64 = 100.0;
/// and is nearer to it than the farther end of the step, by this factor.
const FALLEN: f64 = 0.1;
/// Share of `t_λ` of the ends below which the branch point is also a fold (as on the arms of a pitchfork).
const STATIONARY: f64 = 0.02;

/// Ends the step at the branch point before the trial, keeps the direction, and anchors the orientation anew.
pub(super) fn arrive_at_branch_point(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
) -> Result<Arrival, StepDoubt> {
    let (share, smallness) = search(attempt, locator)?;
    if smallness > VANISHING || jumps(attempt, locator, smallness) {
        return Err(StepDoubt::Reversed);
    }
    let parameter_sign = turn_at_branch_point(attempt, locator, share)?;
    let uncertainty = beside::sharpen(attempt, locator, share);
    interpolate_tangent(attempt, locator, share);
    locator.arrive(attempt);
    let events = PathEvents { branch_point: true, fold: parameter_sign.is_some(), ..PathEvents::default() };
    Ok(Arrival { events, parameter_sign, anchors_anew: true, uncertainty, ..Arrival::default() })
}

/// Leaves the point with the smallest `|D|` found in the probe, evaluated last; returns its share of the step
/// and its `|D|` relative to the larger of those at both ends.
fn search(attempt: &mut Attempt<'_>, locator: &mut Locator) -> Result<(f64, f64), StepDoubt> {
    let state = attempt.state;
    let scale = attempt.trial.log_determinant.max(state.current.log_determinant);
    let length = attempt.progress();
    let low = (state.current.log_determinant - scale).exp().max(SHARP);
    let mut bracket = Bracket::new((0.0, low), (length, -(attempt.trial.log_determinant - scale).exp()));
    let mut smallest = (0.0, f64::INFINITY);
    for _ in 0..MOST_PROBES {
        let sigma = bracket.next();
        // The best probe so far sharpens the prediction: near the branch point the direction of the path is
        // known only as far as the prediction is close.
        locator.predict_through(attempt, sigma, smallest.0 > 0.0);
        match locator.correct(attempt, attempt.locating_limits(attempt.step)) {
            Err(CorrectorError::SingularJacobian) => {
                return exactly_singular(attempt, locator, sigma / length);
            }
            Err(error) if smallest.1 > VANISHING => return Err(StepDoubt::Corrector(error)),
            Err(_) => break,
            Ok(()) => {}
        }
        let size = (locator.probe.log_determinant - scale).exp();
        bracket.narrow(sigma, size * locator.probe.sign * state.orientation);
        if size < smallest.1 {
            smallest = (sigma / length, size);
            std::mem::swap(&mut locator.probe, &mut locator.best);
        }
        if bracket.width() < JUMP_WIDTH * length && smallest.1 > JUMP_SIZE {
            return Err(StepDoubt::Reversed);
        }
        if size <= SHARP || bracket.width() <= attempt.settings().correction_floor {
            break;
        }
    }
    locator.return_to_best(attempt)?;
    Ok(smallest)
}

/// Whether `D` at the best probe is no smaller than at the end of its own sign, however small that is beside
/// the other end: then it jumps, as where the path comes to the grazing of a rigid stop on the side on which
/// it has no bound.
fn jumps(attempt: &Attempt<'_>, locator: &Locator, smallness: f64) -> bool {
    let (before, behind) = (attempt.state.current.log_determinant, attempt.trial.log_determinant);
    let own = if locator.probe.sign * attempt.state.orientation > 0.0 { before } else { behind };
    smallness > SHARP.max(JUMP_SIZE * (own - before.max(behind)).exp())
}

/// The matrix could not even be factorised: the probe lies on the branch point as far as the numbers show.
fn exactly_singular(
    attempt: &Attempt<'_>,
    locator: &mut Locator,
    share: f64,
) -> Result<(f64, f64), StepDoubt> {
    let probe = &mut locator.probe;
    if probe.residual_norm > attempt.settings().correction_tolerance {
        return Err(StepDoubt::NotLocated);
    }
    probe.node.point.copy_from_slice(&probe.point);
    probe.signature = attempt.state.current.signature;
    probe.correction_norm = 0.0;
    probe.log_determinant = f64::NEG_INFINITY;
    Ok((share, 0.0))
}

/// New sign of `t_λ` if the parameter turns at the branch point itself.
fn turn_at_branch_point(
    attempt: &mut Attempt<'_>,
    locator: &Locator,
    share: f64,
) -> Result<Option<f64>, StepDoubt> {
    let (before, after) = (attempt.state.parameter_sign, attempt.trial.tangent_parameter());
    let judge = attempt.problem.judge();
    let ends = [&attempt.state.current.point, &attempt.trial.point].map(|end| judge.distance_to_simpler(end));
    let near = (FALLEN * ends[0].max(ends[1])).min(MET * attempt.frame.settings.sheet_distance);
    if meets_simpler(attempt, &locator.probe.node.point, near) {
        return Ok(Some(-before));
    }
    if before * after >= 0.0 {
        return Ok(None);
    }
    let first = attempt.state.current.tangent_parameter();
    let here = (1.0 - share) * first + share * after;
    if here.abs() <= STATIONARY * first.abs().max(after.abs()) {
        return Ok(Some(-before));
    }
    if here * before > 0.0 { Ok(None) } else { Err(StepDoubt::HiddenFolds) }
}

/// Whether a branch point here, or nearer to a simpler path, is the one at which that is met.
///
/// There the parameter turns: the path goes on as an image of what it has come along, and `λ - λ₀` is even in
/// the distance from the simpler path. Slopes beside it may be rounding, and are not asked.
pub(super) fn meets_simpler(attempt: &mut Attempt<'_>, point: &[f64], near: f64) -> bool {
    attempt.problem.judge().distance_to_simpler(point) < near
}

/// At a branch point the direction from the factorisation belongs to no branch; both ends of the step have
/// one.
fn interpolate_tangent(attempt: &Attempt<'_>, locator: &mut Locator, share: f64) {
    let (base, node) = (attempt.state.base(), &attempt.trial.node);
    let tangent = &mut locator.probe.node.tangent;
    for (i, t) in tangent.iter_mut().enumerate() {
        *t = (1.0 - share) * base.tangent[i] + share * node.tangent[i];
    }
    let length = norm(&attempt.frame.weights, tangent);
    scale(tangent, 1.0 / length);
}
