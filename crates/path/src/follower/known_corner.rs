//! A corner that the problem can compute, behind which `R` changes like a square root.
//!
//! Towards such a corner points are known less and less well, since the root of what they are known to is a
//! part of them; short steps there walk through noise. So the corner is asked for
//! as soon as a step fails that is short enough for it to lie near ([`PathProblem::root_corner`]), and is
//! turned if it lies ahead on the smooth arc, within the step that failed. The next point
//! lies behind it, where the problem says, and the direction there is that towards a farther one.

use super::{Arrival, Follower};
use crate::{
    corrector::Limits,
    error::Doubt,
    problem::{PathProblem, RootCorner},
    product::{add_scaled, distance, norm, product, scale, weigh},
};

/// Steps that fail and are no longer than so many distances of sheets: then the corner is looked for first.
const FIRST_LOOK: f64 = 100.0;
/// And again at steps shorter by this.
const NEXT_LOOK: f64 = 1e-2;
/// The corner lies within so many failed steps,
const WITHIN: f64 = 2.0;
/// and off the tangent by no more than this share of the way to it.
const OFF_TANGENT: f64 = 0.1;
/// Least cosine between the direction behind the corner and the tangent there.
const ALIGNED: f64 = 0.5;
/// Farthest from the corner that a point behind it is taken, in distances of sheets.
const FARTHEST: f64 = 1000.0;

/// A corner that was passed and that the problem computed.
#[derive(Debug, Clone, PartialEq)]
pub struct PassedCorner {
    /// See [`RootCorner::beside`].
    pub beside: Vec<f64>,
    /// See [`RootCorner::uncertainty`].
    pub uncertainty: f64,
    /// Whether that point is the one that was accepted; else it lies between that and the one before.
    pub is_accepted: bool,
}

impl Follower {
    /// Length below which a step that fails is a reason to look for a corner for the first time; none just
    /// behind one, nor where there are no such corners.
    pub(super) fn first_look_for_corner(&self) -> f64 {
        if self.state.current.events.corner { 0.0 } else { FIRST_LOOK * self.settings.sheet_distance }
    }

    /// The same after a look in vain.
    pub(super) fn next_look_for_corner(&self, look: f64) -> f64 {
        NEXT_LOOK * look
    }

    /// Turns the corner ahead; the trial becomes a point behind it. Also returns how far behind.
    ///
    /// # Errors
    /// The problem knows of none within the step.
    pub(super) fn turn_known_corner(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
    ) -> Result<(Arrival, f64), Doubt> {
        if !problem.has_root_corners() {
            return Err(Doubt::NotLocated);
        }
        let current = self.state.history.base().point.clone();
        let lies_ahead = |corner: &[f64]| self.lies_ahead(corner, WITHIN * step);
        let corner = problem.root_corner(&current, step, &lies_ahead).ok_or(Doubt::NotLocated)?;
        self.state.counters.evaluations += corner.evaluations;
        for behind in &corner.behind {
            if let Ok(arrived) = self.arrive_behind(problem, &corner, behind) {
                let is_accepted = behind[0] == corner.beside;
                let RootCorner { beside, uncertainty, .. } = corner;
                self.passed = Some(PassedCorner { beside, uncertainty, is_accepted });
                return Ok(arrived);
            }
        }
        Err(Doubt::NotLocated)
    }

    /// Whether a corner lies ahead on the present arc, within this length.
    fn lies_ahead(&self, corner: &[f64], within: f64) -> bool {
        let base = self.state.history.base();
        let mut way = corner.to_vec();
        add_scaled(&mut way, -1.0, &base.point);
        let ahead = product(&self.weights, &base.tangent, &way);
        add_scaled(&mut way, -ahead, &base.tangent);
        let known = 10.0 * self.settings.correction_tolerance;
        let allowed = OFF_TANGENT * ahead.abs() + known;
        (-known..=within + known).contains(&ahead) && norm(&self.weights, &way) <= allowed
    }

    fn arrive_behind(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        corner: &RootCorner,
        [behind, farther]: &[Vec<f64>; 2],
    ) -> Result<(Arrival, f64), Doubt> {
        let length = distance(&self.weights, behind, &corner.corner);
        if length > FARTHEST * self.settings.sheet_distance {
            return Err(Doubt::NotLocated);
        }
        let mut direction = farther.clone();
        add_scaled(&mut direction, -1.0, &corner.corner);
        let scaled = 1.0 / norm(&self.weights, &direction);
        scale(&mut direction, scaled);
        weigh(&self.weights, &direction, &mut self.row);
        self.trial.point.copy_from_slice(behind);
        let limits = Limits { max_displacement: 0.5 * length, max_angle: None, ..self.limits(length) };
        self.trial
            .correct(problem, &self.weights, &self.row, limits, &mut self.state.counters)
            .map_err(Doubt::Corrector)?;
        self.trial.orient(self.state.orientation);
        let along = product(&self.weights, &self.trial.node.tangent, &direction);
        let turns_round = along < 0.0 && corner.is_multiple;
        if turns_round {
            scale(&mut self.trial.node.tangent, -1.0);
        }
        if along.abs() < ALIGNED || (along < 0.0 && !turns_round) {
            return Err(Doubt::Reversed);
        }
        let arrival = self.arrive_behind_root_corner(problem, length)?;
        Ok((Arrival { anchors_anew: turns_round, ..arrival }, length))
    }
}
