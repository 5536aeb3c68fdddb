//! A corner that the judge can compute, behind which `R` changes like a square root.
//!
//! Towards such a corner points are known less and less well, since the root of what they are known to is a
//! part of them; short steps there walk through noise. So the corner is asked for
//! as soon as a step fails that is short enough for it to lie near ([`Judge::root_corner`]), and is
//! turned if it lies ahead on the smooth arc, within the step that failed. The next point
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
/// Residuals of points behind the corner, over the tolerance: the nearest one that is known well is taken, or
/// the nearest one.
const SHARES: [f64; 2] = [1e-2, 1.0];
/// Farthest from the corner that a point behind it is taken, in distances of sheets.
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
    /// None just behind a corner.
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

/// Turns the corner ahead: within about the step that failed, or straight ahead, as far away as the first look
/// for one reaches. Rounding may be what holds up short steps long before it, where speeds vanish.
///
/// # Errors
/// The judge knows of none.
pub(super) fn turn_known_corner(attempt: &mut Attempt<'_>) -> Result<Turned, StepDoubt> {
    let known = 10.0 * attempt.settings().correction_tolerance;
    let within = FIRST_LOOK * attempt.settings().sheet_distance;
    turn_corner_within(attempt, Cone { within: WITHIN * attempt.step, known, off: OFF_TANGENT })
        .or_else(|_| turn_corner_within(attempt, Cone { within, known: 0.0, off: OFF_STRAIGHT }))
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
    for (behind, share) in
        SHARES.iter().flat_map(|share| corner.behind.iter().map(move |behind| (behind, share)))
    {
        if let Ok((arrival, length)) = arrive_behind(attempt, &corner, behind, *share) {
            let is_accepted = behind[0] == corner.beside;
            let RootCorner { beside, uncertainty, .. } = corner;
            let corner = PassedCorner { beside, uncertainty, is_accepted };
            return Ok(Turned { arrival, length, corner });
        }
    }
    Err(StepDoubt::NotLocated)
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
    share: f64,
) -> Result<(Arrival, f64), StepDoubt> {
    let weights = &attempt.frame.weights;
    let length = distance(weights, behind, &corner.corner);
    if length > FARTHEST * attempt.settings().sheet_distance {
        return Err(StepDoubt::NotLocated);
    }
    let mut direction = farther.clone();
    add_scaled(&mut direction, -1.0, &corner.corner);
    let scaled = 1.0 / norm(weights, &direction);
    scale(&mut direction, scaled);
    attempt.evaluate(behind)?;
    let signature = attempt.problem.judge().signature();
    attempt.border_across(&direction);
    attempt.trial.point.copy_from_slice(behind);
    let limits = Limits { max_displacement: 0.5 * length, max_angle: None, ..attempt.limits(length) };
    let residual_tolerance = share * limits.residual_tolerance;
    attempt.correct(Limits { residual_tolerance, ..limits })?;
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
