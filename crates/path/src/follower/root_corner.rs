//! A corner behind which `R` changes like a square root: grazing of a rigid stop.
//!
//! Let `R = R⁰ + b ν`, with `R⁰` smooth, `ν = 0` where `g · (z − z_c) ≤ 0`, and `ν² = 2 g · (z − z_c)` beyond
//! (to first order): the speed of an impact. There `[R_x R_λ] = J⁰ + b gᵀ/ν` grows without bound towards the
//! surface, and the plane of a short step behind it meets nothing. But with ν for a coordinate all is smooth:
//! `J⁰ w + b = 0`, `g · w = 0` give the direction `w = dz/dν` in which the path leaves the corner, and a
//! point on it lies behind the surface by `g · (z − z_c) = ν²/2`.
//!
//! **Onto the root.** The old tangent `t` (`J⁰ t = 0`, `g · t > 0`) leads through the surface. At the
//! distance s behind it `R` is b, in units of ν in which `ν = 1` there, so `g · t = 1/(2 s)`. A second place,
//! four times as far, shows where exactly the surface is. With x so that `J⁰ x = b`, normal to t, and `g · x`
//! from what a displacement along x does to ν, `w = −x + 2 s (g · x) t`. A guess at the distance h along w is
//! moved along t until R has no component along b any more, that is, until ν fits; from there Newton's method
//! converges, since what it has to change of ν is of the order `h²`.
//!
//! **Off the root.** The path comes to the surface tangentially, so its tangent leads to neither side for
//! sure. A small step sideways does, one way or the other. From there it is an ordinary corner: tangents
//! oriented by the determinant cross the surface in the same sense, since `g · (cofactors of J) = det [J;
//! gᵀ]` does not see `b gᵀ/ν`.
//!
//! A speed ν is known to the root of what a point is known to, so the corner is not looked at closely: its
//! neighbours on either side are points of the path.

use super::{
    arrival::Arrival,
    attempt::Attempt,
    corner::{arrive_behind_corner, correct_behind_corner, linearise},
    locator::Locator,
};
use crate::{
    corrector::Limits,
    error::StepDoubt,
    product::{add_scaled, distance, norm, scale},
};

/// Distance behind the surface at which `b` is taken, in failed steps: the corner lies within one or two.
const PROBE: f64 = 64.0;
/// The second such distance, over the first.
const FARTHER: f64 = 4.0;
/// First displacement that is tried for the change of ν, over the distance behind the surface.
const LEAST_RISE: f64 = 1e-3;
/// Change of `ν²` that is seen well enough.
const SEEN: f64 = 0.1;
/// Distances of the first point on the root, in sheet distances.
const ONTO: [f64; 4] = [1.0, 10.0, 100.0, 1000.0];
/// Share of ν to which a guess fits.
const FITS: f64 = 0.1;
const MOST_FITS: u32 = 60;
/// Growth of displacements that are looked for.
const STRIDE: f64 = 4.0;
/// Ways sideways, in failed steps: the path comes tangentially, so a place within a step of the surface is
/// nearer to it sideways. What lies farther aside is no surface that the path comes to,
const SIDEWAYS: [f64; 2] = [0.1, 1.0];
/// unless points are known no better: ways in tolerances of a point, where they are longer.
const UNKNOWN: [f64; 2] = [10.0, 100.0];
/// Ways behind the corner, in failed steps.
const OFF: [f64; 3] = [8.0, 64.0, 512.0];

/// What is known of the root behind the corner ahead.
struct Root {
    /// Where the old tangent meets the surface.
    corner: Vec<f64>,
    /// `b` in units of ν.
    jump: Vec<f64>,
    /// Unit vector along w, and ν per length.
    direction: Vec<f64>,
    rate: f64,
    /// Distance s along the old tangent at which `ν = 1`.
    reach: f64,
}

/// Turns the corner ahead, onto the root or off it; the trial becomes a point behind it. Also returns how far
/// behind.
///
/// # Errors
/// There is no such corner within about the step ahead.
pub(super) fn turn_root_corner(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
) -> Result<(Arrival, f64), StepDoubt> {
    if !attempt.problem.judge().has_root_corners() {
        return Err(StepDoubt::NotLocated);
    }
    go_onto_root(attempt, locator).or_else(|_| go_off_root(attempt))
}

fn go_onto_root(attempt: &mut Attempt<'_>, locator: &mut Locator) -> Result<(Arrival, f64), StepDoubt> {
    let root = root_ahead(attempt, locator, PROBE * attempt.step)?;
    for length in ONTO.map(|distance| distance * attempt.settings().sheet_distance) {
        if guess_on_root(attempt, &root, length).is_err() {
            continue;
        }
        attempt.border_across(&root.direction);
        let limits = Limits { max_displacement: length, ..attempt.limits(length) };
        let corrected = correct_behind_corner(attempt, &root.direction, limits);
        if let Ok(arrival) = corrected.and_then(|()| arrive_behind_root_corner(attempt, length)) {
            return Ok((arrival, length));
        }
    }
    Err(StepDoubt::NotLocated)
}

/// The root behind the surface, as seen at two distances along the old tangent.
fn root_ahead(attempt: &mut Attempt<'_>, locator: &mut Locator, ahead: f64) -> Result<Root, StepDoubt> {
    let base = attempt.state.base();
    let along = |distance: f64| {
        let mut point = base.point.clone();
        add_scaled(&mut point, distance, &base.tangent);
        point
    };
    let farther = residual_behind(attempt, &along(FARTHER * ahead))?.ok_or(StepDoubt::NotLocated)?;
    let place = along(ahead);
    let jump = residual_behind(attempt, &place)?.ok_or(StepDoubt::NotLocated)?;
    // `ν²` grows from 1 by what belongs to the distance between the two places.
    let growth = (dot(&farther, &jump) / dot(&jump, &jump)).powi(2) - 1.0;
    let reach = (FARTHER - 1.0) * ahead / growth;
    if !(0.5 * ahead..2.0 * ahead).contains(&reach) {
        return Err(StepDoubt::NotLocated);
    }
    // The last point lies within rounding of the surface, on either side.
    let response = response_before(attempt, locator, &along(-ahead), &jump)?;
    let rise = rise_along(attempt, (&place, ahead), (&jump, &response))?;
    let mut direction = response;
    scale(&mut direction, -1.0);
    add_scaled(&mut direction, 2.0 * reach * rise, &base.tangent);
    let rate = 1.0 / norm(&attempt.frame.weights, &direction);
    scale(&mut direction, rate);
    if rate.is_normal() {
        Ok(Root { corner: along(ahead - reach), jump, direction, rate, reach })
    } else {
        Err(StepDoubt::NotLocated)
    }
}

/// Whether the problem was evaluated last behind the surface.
fn is_behind(attempt: &mut Attempt<'_>) -> bool {
    attempt.problem.judge().signature() != attempt.state.current.signature
}

/// The residual at a point; none where the signature is the present one.
fn residual_behind(attempt: &mut Attempt<'_>, point: &[f64]) -> Result<Option<Vec<f64>>, StepDoubt> {
    attempt.evaluate(point)?;
    Ok(is_behind(attempt).then(|| attempt.problem.residual().to_vec()))
}

/// `x` with `J⁰ x = b`, normal to the old tangent; `J⁰` at a point before the surface.
fn response_before(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
    point: &[f64],
    jump: &[f64],
) -> Result<Vec<f64>, StepDoubt> {
    attempt.border_across(&attempt.state.base().tangent);
    locator.probe.point.copy_from_slice(point);
    locator.linearise(attempt).map_err(StepDoubt::Corrector)?;
    if is_behind(attempt) {
        return Err(StepDoubt::Signature);
    }
    let mut response: Vec<f64> = jump.iter().copied().chain([0.0]).collect();
    attempt.problem.solve(&mut response);
    Ok(response)
}

/// `g · x`, from what a displacement along x does to ν where it is 1: there `R = b (ν + ε)`, `ν² = 1 + 2 ε
/// g · x`.
fn rise_along(
    attempt: &mut Attempt<'_>,
    (place, ahead): (&[f64], f64),
    (jump, response): (&[f64], &[f64]),
) -> Result<f64, StepDoubt> {
    let size = norm(&attempt.frame.weights, response);
    let mut share = LEAST_RISE * ahead / size;
    let mut rise = Err(StepDoubt::NotLocated);
    while share * size < attempt.settings().sheet_distance {
        let mut point = place.to_vec();
        add_scaled(&mut point, share, response);
        let Some(residual) = residual_behind(attempt, &point)? else { break };
        let nu = dot(&residual, jump) / dot(jump, jump) - share;
        let change = nu * nu - 1.0;
        rise = Ok(0.5 * change / share);
        if nu <= 0.0 || change.abs() > SEEN {
            break;
        }
        share *= STRIDE;
    }
    rise
}

/// Puts the trial at this distance on the root, with the ν that belongs there.
fn guess_on_root(attempt: &mut Attempt<'_>, root: &Root, length: f64) -> Result<(), StepDoubt> {
    let wanted = root.rate * length;
    let by_square = |found: f64| root.reach * (wanted * wanted - found * found);
    let (mut shallow, mut deep) = (f64::NEG_INFINITY, f64::INFINITY);
    let (mut depth, mut stride) = (by_square(0.0), by_square(0.0));
    for _ in 0..MOST_FITS {
        let found = evaluate_on_root(attempt, root, (length, depth))?;
        if (found - wanted).abs() <= FITS * wanted {
            return Ok(());
        }
        if found < wanted {
            shallow = depth;
        } else {
            deep = depth;
        }
        let next = depth + by_square(found);
        depth = if shallow == f64::NEG_INFINITY || deep == f64::INFINITY {
            // The direction lies in the surface but for a share of it.
            stride *= STRIDE;
            depth + stride.copysign(by_square(found))
        } else if found > 0.0 && shallow < next && next < deep {
            next
        } else {
            0.5 * (shallow + deep)
        };
        if depth.abs() > length {
            break;
        }
    }
    Err(StepDoubt::NotLocated)
}

/// Evaluates at a place behind the corner, along the root and along the old tangent; returns ν there.
fn evaluate_on_root(
    attempt: &mut Attempt<'_>,
    root: &Root,
    (length, depth): (f64, f64),
) -> Result<f64, StepDoubt> {
    let base = attempt.state.base();
    attempt.trial.point.copy_from_slice(&root.corner);
    add_scaled(&mut attempt.trial.point, length, &root.direction);
    add_scaled(&mut attempt.trial.point, depth, &base.tangent);
    attempt.return_to_trial()?;
    if !is_behind(attempt) {
        return Ok(0.0);
    }
    // `R = −b rate length + b ν`.
    let along = dot(attempt.problem.residual(), &root.jump) / dot(&root.jump, &root.jump);
    Ok((along + root.rate * length).max(0.0))
}

fn go_off_root(attempt: &mut Attempt<'_>) -> Result<(Arrival, f64), StepDoubt> {
    let weights = &attempt.frame.weights;
    let mut aside: Vec<f64> = (1..=weights.len()).map(|k| ((k * k) as f64).cos()).collect();
    let unit = 1.0 / norm(weights, &aside);
    scale(&mut aside, unit);
    let step = attempt.step;
    let tolerance = attempt.settings().correction_tolerance;
    let unknown = UNKNOWN.map(|way| way * tolerance).into_iter().filter(|way| *way > step);
    for way in SIDEWAYS.map(|way| way * step).into_iter().chain(unknown) {
        for sideways in [way, -way] {
            if look_aside(attempt, &aside, sideways).is_err() {
                continue;
            }
            let direction = attempt.trial.node.tangent.clone();
            for length in OFF.map(|length| length * step.max(way)) {
                let corrected = correct_off_root(attempt, (&aside, sideways), &direction, length);
                if let Ok(arrival) = corrected {
                    return Ok((arrival, length));
                }
            }
        }
    }
    Err(StepDoubt::NotLocated)
}

/// Linearises beside the last point; an error if the signature there is the same.
fn look_aside(attempt: &mut Attempt<'_>, aside: &[f64], sideways: f64) -> Result<(), StepDoubt> {
    let base = attempt.state.base();
    attempt.border_across(&base.tangent);
    attempt.trial.point.copy_from_slice(&base.point);
    add_scaled(&mut attempt.trial.point, sideways, aside);
    linearise(attempt)?;
    if is_behind(attempt) { Ok(()) } else { Err(StepDoubt::Signature) }
}

/// Makes the point at this distance behind the corner the trial.
fn correct_off_root(
    attempt: &mut Attempt<'_>,
    (aside, sideways): (&[f64], f64),
    direction: &[f64],
    length: f64,
) -> Result<Arrival, StepDoubt> {
    attempt.trial.point.copy_from_slice(&attempt.state.base().point);
    add_scaled(&mut attempt.trial.point, sideways, aside);
    attempt.border_across(direction);
    attempt.linearise().map_err(StepDoubt::Corrector)?;
    attempt.trial.apply_correction();
    add_scaled(&mut attempt.trial.point, length, direction);
    let limits = Limits { max_displacement: length, ..attempt.limits(length) };
    correct_behind_corner(attempt, direction, limits)?;
    arrive_behind_root_corner(attempt, length)
}

/// The trial is the next point, unless it is on this side of the corner or was walked before.
pub(super) fn arrive_behind_root_corner(
    attempt: &mut Attempt<'_>,
    length: f64,
) -> Result<Arrival, StepDoubt> {
    if !attempt.changes_signature() {
        return Err(StepDoubt::Signature);
    }
    // The corner lies between the last point, which is before it, and this one.
    let (base, trial) = (attempt.state.base(), &attempt.trial.node);
    let chord = distance(&attempt.frame.weights, &base.point, &trial.point);
    Ok(Arrival { uncertainty: length.max(chord), ..arrive_behind_corner(attempt)? })
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
