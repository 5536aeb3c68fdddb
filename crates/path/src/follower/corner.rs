//! A turn sharper than the shortest step: the path has a corner.
//!
//! Where `R` is continuous and piecewise smooth, `[R_x R_λ]` jumps by a matrix of rank one across the surface
//! on which its pieces meet, and tangents oriented by the determinant cross that surface in the same sense on
//! both sides. So the determinant gives the direction behind a corner whatever the angle; but the plane
//! normal to the old tangent may not meet the path there. The probe is therefore put behind the corner on the
//! old tangent, linearised, moved onto the new piece and along its tangent, and corrected in the plane normal
//! to the new tangent. The corner is where both straight lines meet.

use super::{Arrival, Follower};
use crate::{
    corrector::{CorrectorError, Limits},
    error::Doubt,
    point::Events,
    predictor::Node,
    problem::PathProblem,
    product::{add_scaled, product, progress, weigh},
};

/// Distances of the probe ahead of the last point, in steps: the first that works is taken. The longer ones
/// are for turns that rounding hides from the shortest steps.
const REACHES: [f64; 5] = [2.0, 8.0, 32.0, 128.0, 512.0];
/// Ways along the new tangent, in distances of the probe. The longer ones are for new pieces so steep that
/// they gain little distance from the corner.
const ADVANCES: [f64; 3] = [2.0, 64.0, 2048.0];

impl Follower {
    /// Turns the corner that must lie within about the step ahead; the trial becomes the corner itself. Also
    /// returns the length over which it was turned.
    ///
    /// # Errors
    /// There is no corner that leads on.
    pub(super) fn turn_corner(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        step: f64,
    ) -> Result<(Arrival, f64), Doubt> {
        for advance in ADVANCES {
            for length in REACHES.map(|reach| reach * step) {
                if advance * length > self.settings.sheet_distance
                    || self.step_behind_corner(problem, length, advance * length).is_err()
                {
                    continue;
                }
                if let Ok(arrival) = self.arrive_at_corner(problem, advance * length) {
                    return Ok((arrival, length));
                }
            }
        }
        Err(Doubt::NotLocated)
    }

    /// Leaves in the trial a point on the new piece: linearised `length` ahead, corrected `advance` behind
    /// the corner.
    fn step_behind_corner(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        length: f64,
        advance: f64,
    ) -> Result<(), Doubt> {
        self.probe_ahead(problem, length)?;
        let direction = self.trial.node.tangent.clone();
        weigh(&self.weights, &direction, &mut self.row);
        self.trial.refactorise(problem, &self.weights, &self.row).map_err(Doubt::Corrector)?;
        self.trial.apply_correction();
        add_scaled(&mut self.trial.point, advance, &direction);
        self.correct_behind_corner(problem, &direction, self.corner_limits(advance))
    }

    /// Linearises on the old tangent, this far ahead.
    fn probe_ahead(&mut self, problem: &mut (impl PathProblem + ?Sized), length: f64) -> Result<(), Doubt> {
        let base = self.state.history.base();
        weigh(&self.weights, &base.tangent, &mut self.row);
        self.trial.point.copy_from_slice(&base.point);
        add_scaled(&mut self.trial.point, length, &base.tangent);
        self.linearise_trial(problem)
    }

    /// Corrects the trial with the present border; its tangent must be about that of the probe.
    pub(super) fn correct_behind_corner(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        direction: &[f64],
        limits: Limits,
    ) -> Result<(), Doubt> {
        self.trial
            .correct(problem, &self.weights, &self.row, limits, &mut self.state.counters)
            .map_err(Doubt::Corrector)?;
        self.trial.orient(self.state.orientation);
        let agrees = product(&self.weights, &self.trial.node.tangent, direction) > 0.9;
        if agrees { Ok(()) } else { Err(Doubt::NotLocated) }
    }

    /// Oriented direction at the trial. A turn by exactly a right angle needs another border than the old
    /// tangent.
    pub(super) fn linearise_trial(&mut self, problem: &mut (impl PathProblem + ?Sized)) -> Result<(), Doubt> {
        let first = self.trial.linearise(problem, &self.weights, &self.row, &mut self.state.counters);
        if first == Err(CorrectorError::SingularJacobian) {
            self.trial.refactorise(problem, &self.weights, &self.parameter_row).map_err(Doubt::Corrector)?;
        } else {
            first.map_err(Doubt::Corrector)?;
        }
        self.trial.orient(self.state.orientation);
        Ok(())
    }

    fn corner_limits(&self, length: f64) -> Limits {
        Limits {
            tolerance: self.settings.tolerance_at(length),
            loose_tolerance: self.settings.correction_floor.max(0.01 * length),
            singular_tolerance: self.settings.correction_floor.max(0.01 * length),
            residual_floor: self.settings.residual_floor,
            residual_tolerance: self.settings.residual_tolerance,
            residual_wanted: self.settings.residual_wanted,
            max_iterations: self.settings.max_iterations,
            max_displacement: length,
            max_angle: Some(self.settings.max_angle),
        }
    }

    /// Makes the corner the trial, with the new tangent; where the tangents do not meet in a corner ahead,
    /// the trial itself, behind the turn, is the next point.
    fn arrive_at_corner(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        length: f64,
    ) -> Result<Arrival, Doubt> {
        let base = self.state.history.base();
        if let Some(back) = meeting(&self.weights, base, &self.trial.node, length).filter(|_| self.turns()) {
            self.evaluate_corner(problem, back, length)?;
        }
        self.arrive_behind_corner(problem)
    }

    /// The trial, with the tangent behind the corner, is the next point.
    pub(super) fn arrive_behind_corner(
        &self,
        problem: &(impl PathProblem + ?Sized),
    ) -> Result<Arrival, Doubt> {
        if !self.range.contains(self.trial.parameter()) {
            return Err(Doubt::NotLocated);
        }
        let after = self.trial.tangent_parameter();
        let fold = self.turned(problem, after);
        let events = Events { corner: self.turns(), fold, ..Events::default() };
        Ok(Arrival { events, parameter_sign: fold.then(|| after.signum()), ..Arrival::default() })
    }

    /// Whether the tangent of the trial differs from that of its base by more than a step may turn.
    fn turns(&self) -> bool {
        let cosine = product(&self.weights, &self.state.history.base().tangent, &self.trial.node.tangent);
        cosine < self.settings.max_angle.cos()
    }

    /// Evaluates the corner, this far back from the trial, and makes it the trial.
    fn evaluate_corner(
        &mut self,
        problem: &mut (impl PathProblem + ?Sized),
        back: f64,
        length: f64,
    ) -> Result<(), Doubt> {
        self.probe.point.copy_from_slice(&self.trial.node.point);
        add_scaled(&mut self.probe.point, -back, &self.trial.node.tangent);
        self.border_both_sides();
        let limits = Limits { max_angle: None, ..self.corner_limits(length) };
        let counters = &mut self.state.counters;
        self.probe.correct(problem, &self.weights, &self.row, limits, counters).map_err(Doubt::Corrector)?;
        std::mem::swap(&mut self.trial, &mut self.probe);
        self.trial.node.tangent.copy_from_slice(&self.probe.node.tangent);
        self.trial.signature = self.probe.signature;
        self.trial.log_determinant = self.probe.log_determinant;
        Ok(())
    }

    /// On the corner the matrix may be that of either side: a border for both is the sum of their tangents,
    /// unless they are nearly opposite; then either serves.
    fn border_both_sides(&mut self) {
        let base = self.state.history.base();
        if product(&self.weights, &base.tangent, &self.trial.node.tangent) < -0.5 {
            return;
        }
        for (i, r) in self.row.iter_mut().enumerate() {
            *r = self.weights[i] * (base.tangent[i] + self.trial.node.tangent[i]);
        }
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
