//! A turn sharper than the shortest step: the path has a corner.
//! Equation (O7) of the book, `docs/theory`.
//!
//! Where `R` is continuous and piecewise smooth, `[R_x R_λ]` jumps by a matrix of rank one across the surface
//! on which its pieces meet, and tangents oriented by the determinant cross that surface in the same sense on
//! both sides. So the determinant gives the direction behind a corner whatever the angle; but the plane
//! normal to the old tangent may not meet the path there. The probe is therefore put behind the corner on the
//! old tangent, linearised, moved onto the new piece and along its tangent, and corrected in the plane normal
//! to the new tangent. The corner is where both straight lines meet, or where the probe comes to when it is
//! moved back towards there.

use super::{arrival::Arrival, assessment::turned, attempt::Attempt, locator::Locator};
use crate::{
    corrector::{CorrectorError, Limits},
    error::StepDoubt,
    point::PathEvents,
    predictor::Node,
    product::{add_scaled, product, progress},
    settings::Settings,
};

/// Distances of the probe ahead of the last point, in steps: the first that works is taken. The longer ones
/// are for turns that rounding hides from the shortest steps.
const REACHES: [f64; 5] = [2.0, 8.0, 32.0, 128.0, 512.0];
/// Ways along the new tangent, in distances of the probe. The longer ones are for new pieces so steep that
/// they gain little distance from the corner.
const ADVANCES: [f64; 3] = [2.0, 64.0, 2048.0];

/// Least cosine between the tangents of two points behind a corner.
const ALIGNED: f64 = 0.9;

/// Share of the way back to a corner that is left at most when half of it was gone.
const NEARER: f64 = 0.75;

/// Turns the corner that must lie within about the step ahead; the trial becomes the corner itself. Also
/// returns the length over which it was turned.
///
/// # Errors
/// There is no corner that leads on.
pub(super) fn turn_corner(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
) -> Result<(Arrival, f64), StepDoubt> {
    for advance in ADVANCES {
        for length in REACHES.map(|reach| reach * attempt.step) {
            if advance * length > attempt.settings().sheet_distance
                || step_behind_corner(attempt, length, advance * length).is_err()
            {
                continue;
            }
            if let Ok(arrival) = arrive_at_corner(attempt, locator, advance * length) {
                return Ok((arrival, length));
            }
        }
    }
    Err(StepDoubt::NotLocated)
}

/// Leaves in the trial a point on the new piece: linearised `length` ahead, corrected `advance` behind the
/// corner.
fn step_behind_corner(attempt: &mut Attempt<'_>, length: f64, advance: f64) -> Result<(), StepDoubt> {
    // Linearises on the old tangent, this far ahead.
    attempt.border_across(&attempt.state.base().tangent);
    attempt.put_ahead(length);
    linearise(attempt)?;
    let direction = attempt.trial.node.tangent.clone();
    attempt.border_across(&direction);
    attempt.refactorise().map_err(StepDoubt::Corrector)?;
    attempt.trial.apply_correction();
    add_scaled(&mut attempt.trial.point, advance, &direction);
    let limits = limits(attempt.settings(), advance);
    correct_behind_corner(attempt, &direction, limits)
}

/// Corrects the trial with the present border; its tangent must nearly agree with the tangent of the probe.
pub(super) fn correct_behind_corner(
    attempt: &mut Attempt<'_>,
    direction: &[f64],
    limits: Limits,
) -> Result<(), StepDoubt> {
    attempt.correct(limits)?;
    attempt.trial.orient(attempt.state.orientation);
    let agrees = product(&attempt.frame.weights, &attempt.trial.node.tangent, direction) > ALIGNED;
    if agrees { Ok(()) } else { Err(StepDoubt::NotLocated) }
}

/// Oriented direction at the trial. A turn by exactly a right angle needs another border than the old
/// tangent.
pub(super) fn linearise(attempt: &mut Attempt<'_>) -> Result<(), StepDoubt> {
    let first = attempt.linearise();
    if first == Err(CorrectorError::SingularJacobian) {
        attempt.refactorise_at_parameter().map_err(StepDoubt::Corrector)?;
    } else {
        first.map_err(StepDoubt::Corrector)?;
    }
    attempt.trial.orient(attempt.state.orientation);
    Ok(())
}

fn limits(settings: &Settings, length: f64) -> Limits {
    let loose = settings.correction_floor.max(0.01 * length);
    Limits {
        loose_tolerance: loose,
        singular_tolerance: loose,
        max_displacement: length,
        ..settings.limits(length)
    }
}

/// Makes the corner the trial, with the new tangent; where the tangents do not meet in a corner ahead, the
/// trial itself, behind the turn, is the next point.
///
/// Where both pieces bend so much that no point of the path is near the place where their tangents meet, the
/// trial is moved back towards the corner, by half of the way that is left each time; at last it is the next
/// point, and how far behind the corner it lies is the uncertainty of that. Where it comes no nearer there is
/// no corner.
fn arrive_at_corner(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
    mut length: f64,
) -> Result<Arrival, StepDoubt> {
    let (mut uncertainty, mut last) = (0.0, f64::INFINITY);
    while turns(attempt) {
        let base = attempt.state.base();
        let Some(back) = meeting(&attempt.frame.weights, base, &attempt.trial.node, length) else { break };
        if evaluate_corner(attempt, locator, back, length).is_ok() {
            uncertainty = 0.0;
            break;
        }
        uncertainty = back.abs();
        if uncertainty < attempt.settings().min_step {
            // The problem holds the point that is accepted.
            attempt.return_to_trial()?;
            break;
        }
        if !(0.0..NEARER * last).contains(&back) {
            return Err(StepDoubt::NotLocated);
        }
        (last, length) = (back, 0.5 * back);
        approach_corner(attempt, locator, length)?;
    }
    Ok(Arrival { uncertainty, ..arrive_behind_corner(attempt)? })
}

/// Moves the trial back towards the corner.
fn approach_corner(attempt: &mut Attempt<'_>, locator: &mut Locator, way: f64) -> Result<(), StepDoubt> {
    let direction = attempt.trial.node.tangent.clone();
    attempt.border_across(&direction);
    locator.probe.point.copy_from_slice(&attempt.trial.node.point);
    add_scaled(&mut locator.probe.point, -way, &direction);
    let limits = Limits { max_angle: None, max_displacement: way, ..attempt.settings().limits(way) };
    locator.correct(attempt, limits).map_err(StepDoubt::Corrector)?;
    locator.probe.orient(attempt.state.orientation);
    if product(&attempt.frame.weights, &locator.probe.node.tangent, &direction) < ALIGNED {
        return Err(StepDoubt::NotLocated);
    }
    locator.arrive(attempt);
    Ok(())
}

/// The trial, with the tangent behind the corner, is the next point, unless the path came through there.
pub(super) fn arrive_behind_corner(attempt: &mut Attempt<'_>) -> Result<Arrival, StepDoubt> {
    if !attempt.is_in_range() {
        return Err(StepDoubt::NotLocated);
    }
    if let Some(arc_length) = attempt.meets_earlier_stretch() {
        return Err(StepDoubt::Retraced { arc_length });
    }
    let after = attempt.trial.tangent_parameter();
    let fold = turned(attempt, after);
    let events = PathEvents { corner: turns(attempt), fold, ..PathEvents::default() };
    Ok(Arrival { events, parameter_sign: fold.then(|| after.signum()), ..Arrival::default() })
}

/// Whether the tangent of the trial is turned against the tangent of its base by more than a step may turn.
fn turns(attempt: &Attempt<'_>) -> bool {
    let (base, trial) = (attempt.state.base(), &attempt.trial.node);
    let cosine = product(&attempt.frame.weights, &base.tangent, &trial.tangent);
    cosine < attempt.settings().max_angle.cos()
}

/// Evaluates the corner, this far back from the trial, and makes it the trial.
fn evaluate_corner(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
    back: f64,
    length: f64,
) -> Result<(), StepDoubt> {
    locator.probe.point.copy_from_slice(&attempt.trial.node.point);
    add_scaled(&mut locator.probe.point, -back, &attempt.trial.node.tangent);
    border_both_sides(attempt);
    let limits = Limits { max_angle: None, max_displacement: length, ..attempt.settings().limits(length) };
    locator.correct(attempt, limits).map_err(StepDoubt::Corrector)?;
    locator.arrive(attempt);
    let behind = &locator.probe;
    attempt.trial.node.tangent.copy_from_slice(&behind.node.tangent);
    attempt.trial.signature = behind.signature;
    attempt.trial.log_determinant = behind.log_determinant;
    Ok(())
}

/// On the corner the matrix may belong to either side: a border for both is the sum of their tangents, unless
/// they are nearly opposite; then either serves.
fn border_both_sides(attempt: &mut Attempt<'_>) {
    let (weights, base) = (&attempt.frame.weights, attempt.state.base());
    if product(weights, &base.tangent, &attempt.trial.node.tangent) < -0.5 {
        return;
    }
    for (i, r) in attempt.row.iter_mut().enumerate() {
        *r = weights[i] * (base.tangent[i] + attempt.trial.node.tangent[i]);
    }
}

/// Distance back from `b` along its tangent to the place nearest to the tangent line of `a`, if that place
/// lies ahead of `a`, behind `b` (but for rounding), and within a few lengths of both.
///
/// Minimises `‖a + α t_a − b + β t_b‖`: with `c = ⟨t_a, t_b⟩` and `e = b − a` is `α (1 − c²) = ⟨t_a, e⟩ − c
/// ⟨t_b, e⟩` and `β (1 − c²) = ⟨t_b, e⟩ − c ⟨t_a, e⟩`.
fn meeting(weights: &[f64], a: &Node, b: &Node, length: f64) -> Option<f64> {
    let c = product(weights, &a.tangent, &b.tangent);
    let along_b = progress(weights, &b.tangent, &b.point, &a.point);
    let along_a = progress(weights, &a.tangent, &b.point, &a.point);
    let scale = 1.0 / (1.0 - c * c);
    let (ahead, back) = (scale * (along_a - c * along_b), scale * (along_b - c * along_a));
    let within = -0.5 * length..=4.0 * length;
    (within.contains(&ahead) && within.contains(&back)).then_some(back)
}
