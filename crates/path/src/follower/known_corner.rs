//! A corner that the judge can compute, behind which `R` changes like a square root.
//!
//! Towards such a corner points are known less and less well, since the root of what they are known to is a
//! part of them; short steps there walk through noise. So the corner is asked for
//! as soon as a step fails that is short enough for it to lie near ([`Judge::root_corner`]), and is
//! turned if it lies ahead on the smooth arc, within the step that failed, or farther ahead but straight on.
//! What lies behind it may be a simpler path: the judge says how this one goes on. The next point
//! lies behind it, where the judge says, and the direction there is that towards a farther one.

use super::{
    arrival::Arrival,
    attempt::{Attempt, Frame},
    root_corner::arrive_behind_root_corner,
};
use crate::{
    corrector::Limits,
    error::StepDoubt,
    judge::RootCorner,
    predictor::Node,
    product::{add_scaled, distance, norm, product, scale},
    state::PathState,
};

/// Steps that fail and are no longer than so many distances of sheets: then the corner is looked for first.
const FIRST_LOOK: f64 = 100.0;
/// And again at steps shorter by this.
const NEXT_LOOK: f64 = 1e-2;
/// The corner lies within so many failed steps,
const WITHIN: f64 = 2.0;
/// and off the tangent by no more than this share of the way to it.
const OFF_TANGENT: f64 = 0.1;
/// Straight ahead: off the tangent by no more than this share.
const OFF_STRAIGHT: f64 = 1e-4;
/// Least cosine between the direction behind the corner and the tangent there.
const ALIGNED: f64 = 0.5;
/// Residual of a point behind the corner that is known well, over the tolerance.
const WELL_KNOWN: f64 = 1e-2;
/// Farthest from the corner that a point behind it is taken, in distances of sheets: 3 % of the start. Nearer
/// ones are taken if they are known well, which behind several impacts at once they may not be.
const FARTHEST: f64 = 3000.0;

/// A corner that was passed and that the judge computed.
#[derive(Debug, Clone, PartialEq)]
pub struct PassedCorner {
    /// See [`RootCorner::beside`].
    pub beside: Vec<f64>,
    /// See [`RootCorner::uncertainty`].
    pub uncertainty: f64,
    /// Whether that point is the one that was accepted; else it lies between that and the one before.
    pub is_accepted: bool,
}

/// When a step that fails is a reason to look for a corner.
#[derive(Debug, Clone, Copy)]
pub(super) struct Looks {
    /// Length below which the next look is due.
    below: f64,
}

impl Looks {
    /// None just behind a corner, unless steps have become too short.
    pub fn at(frame: &Frame, state: &PathState) -> Self {
        let is_corner = state.current.events.corner;
        Self { below: if is_corner { 0.0 } else { FIRST_LOOK * frame.settings.sheet_distance } }
    }

    /// Whether a look is due when the next step is this short; the one after it is due at shorter ones.
    pub fn is_due(&mut self, step: f64) -> bool {
        let is_due = step < self.below;
        if is_due {
            self.below *= NEXT_LOOK;
        }
        is_due
    }
}

/// A corner that was turned: the trial is a point behind it.
pub(super) struct Turned {
    pub arrival: Arrival,
    /// How far behind it.
    pub length: f64,
    pub corner: PassedCorner,
}

/// Turns the corner ahead: within about the step that failed, or straight ahead, as far away as the first
/// look for one reaches. Rounding may be what holds up short steps long before it, where speeds vanish.
///
/// # Errors
/// The judge knows of none.
pub(super) fn turn_known_corner(attempt: &mut Attempt<'_>) -> Result<Turned, StepDoubt> {
    let known = 10.0 * attempt.settings().correction_tolerance;
    let (near, far) = (WITHIN * attempt.step, FIRST_LOOK * attempt.settings().sheet_distance);
    let turned = turn_corner_within(attempt, Cone { within: near, known, off: OFF_TANGENT });
    match turned {
        Err(_) if far > near => {
            turn_corner_within(attempt, Cone { within: far, known: 0.0, off: OFF_STRAIGHT })
        }
        turned => turned,
    }
}

fn turn_corner_within(attempt: &mut Attempt<'_>, cone: Cone) -> Result<Turned, StepDoubt> {
    if !attempt.problem.judge().has_root_corners() {
        return Err(StepDoubt::NotLocated);
    }
    let (frame, state) = (attempt.frame, attempt.state);
    let ahead = |corner: &[f64]| cone.contains(&frame.weights, state.base(), corner);
    let reach = cone.within / WITHIN;
    let found = attempt.problem.judge().root_corner(&state.base().point, reach, &ahead);
    let corner = found.ok_or(StepDoubt::NotLocated)?;
    attempt.counters.evaluations += corner.evaluations;
    // The nearest point that is known well, or else the one that is known best.
    let known_well = WELL_KNOWN * attempt.settings().residual_tolerance;
    let mut best: Option<(f64, &[Vec<f64>; 2])> = None;
    for behind in &corner.behind {
        let Ok(arrived) = arrive_behind(attempt, &corner, behind) else { continue };
        let residual = attempt.trial.residual_norm;
        if residual <= known_well {
            return Ok(turned(&corner, behind, arrived));
        }
        if best.is_none_or(|(least, _)| residual < least) {
            best = Some((residual, behind));
        }
    }
    let (_, behind) = best.ok_or(StepDoubt::NotLocated)?;
    let arrived = arrive_behind(attempt, &corner, behind)?;
    Ok(turned(&corner, behind, arrived))
}

fn turned(corner: &RootCorner, behind: &[Vec<f64>; 2], (arrival, length): (Arrival, f64)) -> Turned {
    let passed = PassedCorner {
        beside: corner.beside.clone(),
        uncertainty: corner.uncertainty,
        is_accepted: behind[0] == corner.beside,
    };
    Turned { arrival, length, corner: passed }
}

/// Where a corner lies ahead on the arc.
struct Cone {
    /// Along the tangent.
    within: f64,
    /// What points are known to.
    known: f64,
    /// Off the tangent, as a share of the way.
    off: f64,
}

impl Cone {
    fn contains(&self, weights: &[f64], base: &Node, corner: &[f64]) -> bool {
        let mut way = corner.to_vec();
        add_scaled(&mut way, -1.0, &base.point);
        let ahead = product(weights, &base.tangent, &way);
        add_scaled(&mut way, -ahead, &base.tangent);
        let allowed = self.off * ahead.abs() + self.known;
        (-self.known..=self.within + self.known).contains(&ahead) && norm(weights, &way) <= allowed
    }
}

fn arrive_behind(
    attempt: &mut Attempt<'_>,
    corner: &RootCorner,
    [behind, farther]: &[Vec<f64>; 2],
) -> Result<(Arrival, f64), StepDoubt> {
    let weights = &attempt.frame.weights;
    let length = distance(weights, behind, &corner.corner);
    if length > FARTHEST * attempt.settings().sheet_distance {
        return Err(StepDoubt::NotLocated);
    }
    let mut direction = farther.clone();
    add_scaled(&mut direction, -1.0, behind);
    let way = norm(weights, &direction);
    if way == 0.0 {
        return Err(StepDoubt::NotLocated);
    }
    scale(&mut direction, 1.0 / way);
    attempt.evaluate(behind)?;
    let signature = attempt.problem.judge().signature();
    attempt.border_across(&direction);
    attempt.trial.point.copy_from_slice(behind);
    let limits = Limits { max_displacement: 0.5 * length, max_angle: None, ..attempt.limits(length) };
    attempt.correct(limits)?;
    // Another arc meets this one in the corner, and is closer than what the corrector takes away.
    if attempt.trial.signature != signature {
        return Err(StepDoubt::Signature);
    }
    attempt.trial.orient(attempt.state.orientation);
    let along = product(weights, &attempt.trial.node.tangent, &direction);
    let turns_round = along < 0.0 && corner.is_multiple;
    if turns_round {
        scale(&mut attempt.trial.node.tangent, -1.0);
    }
    if along.abs() < ALIGNED || (along < 0.0 && !turns_round) {
        return Err(StepDoubt::Reversed);
    }
    let arrival = arrive_behind_root_corner(attempt, length)?;
    Ok((Arrival { anchors_anew: turns_round, ..arrival }, length))
}
