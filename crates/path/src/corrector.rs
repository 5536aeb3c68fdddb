//! The corrector: Newton's method on the bordered system. Equations (O2) to (O6) of the book, `docs/theory`.
//!
//! `[R_x R_λ; r] d = −[R; 0]` keeps the point in the plane `r · z = const` through the prediction. The same
//! factorisation gives `w` with `[R_x R_λ; r] w = e_last`, the direction of the path, and the determinant.
//! With `r = (W t₀)ᵀ`: `sign det [R_x R_λ; (W w)ᵀ] = sign det [R_x R_λ; r]`, and for the unit vector `|det
//! [R_x R_λ; (W w)ᵀ/‖w‖]| = |det [R_x R_λ; r]| · ‖w‖`, which does not depend on `r`.
//!
//! Source: Keller, in Rabinowitz (ed.), *Applications of Bifurcation Theory*, 1977, pp. 359-384; the
//! determinant as orientation: Allgower and Georg, *Introduction to Numerical Continuation Methods*, 2003,
//! chapter 2.

use crate::{
    point::Counters,
    predictor::Node,
    problem::{EvaluationError, PathProblem, TestValue},
    product::{add_scaled, norm, scale},
};

/// Why no point of the path was found near the prediction.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum CorrectorError {
    /// The corrections do not shrink fast enough.
    #[error(
        "no convergence in {iterations} iterations, correction {correction_norm:.2e}, \
        residual {residual_norm:.2e}"
    )]
    NotConverged { iterations: u32, correction_norm: f64, residual_norm: f64 },
    /// The corrector moves the prediction further than a step of this length allows.
    #[error("the corrector would move the prediction by {displacement:.2e}, allowed are {allowed:.2e}")]
    Displaced { displacement: f64, allowed: f64 },
    /// The direction of the path at the prediction is too different from the plane's normal.
    #[error("the path turns by {angle:.2} rad")]
    Turned { angle: f64 },
    /// The corrections vanish, or stop shrinking, but the residual does not.
    #[error("residual {residual_norm:.2e} at a converged point")]
    Residual { residual_norm: f64 },
    /// Branches cross here, or the plane contains the tangent.
    #[error("the bordered Jacobian is singular")]
    SingularJacobian,
    /// The problem could not be evaluated.
    #[error(transparent)]
    Evaluation(#[from] EvaluationError),
}

/// What a correction must keep to.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    /// Norm of the correction that may stay unapplied.
    pub tolerance: f64,
    /// The same when corrections stop shrinking: rounding.
    pub loose_tolerance: f64,
    /// The same when besides the residual is down to [`Self::residual_floor`]: beside a branch point, where
    /// the matrix is nearly singular, rounding of the residual leaves large corrections.
    pub singular_tolerance: f64,
    pub residual_floor: f64,
    pub residual_tolerance: f64,
    /// Residual above which corrections go on as long as they shrink.
    pub residual_wanted: f64,
    /// The same where the correction changes the parameter by more than this part of it, if above this, too.
    pub parameter_tolerance: f64,
    pub max_iterations: u32,
    /// Bound of the total displacement of the prediction.
    pub max_displacement: f64,
    /// Bound of the angle to the unit vector whose row is the border; `None` if the border is another one.
    pub max_angle: Option<f64>,
}

/// A point that was evaluated and found to lie on the path.
#[derive(Debug, Clone, Default)]
pub(crate) struct Candidate {
    /// The evaluated point.
    pub point: Vec<f64>,
    /// The point with the last correction applied, and the unit direction `w / ‖w‖` (not yet oriented).
    pub node: Node,
    /// Norm of the last correction, which is not applied to `point`.
    pub correction_norm: f64,
    /// Norms of all corrections, summed.
    pub displacement: f64,
    pub residual_norm: f64,
    pub iterations: u32,
    /// Evaluations until the correction was small: those that follow take the residual away, and are no fewer
    /// where steps are shorter.
    pub effort: u32,
    /// Sign of `det [R_x R_λ; r]`.
    pub sign: f64,
    /// `ln |det [R_x R_λ; (W w)ᵀ/‖w‖]|`.
    pub log_determinant: f64,
    pub signature: u64,
    /// Test functions, where they were asked for.
    pub tests: Vec<TestValue>,
    /// What the judge noted there, see [`Judge::note`](crate::Judge::note).
    pub noted: Vec<f64>,
    /// `1 / ‖w‖`: the cosine between the direction and `t₀` if `r = (W t₀)ᵀ`, since then `⟨t₀, w⟩ = 1`.
    pub cosine: f64,
    correction: Vec<f64>,
}

impl Candidate {
    pub fn new(length: usize) -> Self {
        Self {
            point: vec![0.0; length],
            node: Node::zeros(length),
            correction: vec![0.0; length],
            ..Self::default()
        }
    }

    pub fn parameter(&self) -> f64 {
        self.point[self.point.len() - 1]
    }

    pub fn tangent_parameter(&self) -> f64 {
        self.node.tangent[self.point.len() - 1]
    }

    /// Turns the direction into the tangent of an arc with this orientation.
    pub fn orient(&mut self, orientation: f64) {
        if self.sign * orientation < 0.0 {
            scale(&mut self.node.tangent, -1.0);
        }
    }

    /// Corrects `self.point` in the plane with the border `row`.
    ///
    /// On success the problem was evaluated last at `self.point`, all fields refer to it, and
    /// `self.node.tangent` has `row · tangent > 0`.
    pub fn correct(
        &mut self,
        problem: &mut dyn PathProblem,
        weights: &[f64],
        row: &[f64],
        limits: Limits,
        counters: &mut Counters,
    ) -> Result<(), CorrectorError> {
        self.displacement = 0.0;
        (self.iterations, self.effort) = (0, 1);
        let mut last = f64::INFINITY;
        loop {
            self.linearise(problem, weights, row, counters)?;
            self.check_turn(limits)?;
            let size = self.correction_norm;
            let stagnant = size > 0.5 * last;
            let at_floor = self.residual_norm <= limits.residual_floor;
            let loose = if at_floor { limits.singular_tolerance } else { limits.loose_tolerance };
            let has_converged = size <= limits.tolerance || (stagnant && size <= loose);
            self.effort += u32::from(!has_converged);
            // Where the matrix is large, a correction that might stay unapplied may still leave a residual
            // that it takes away.
            let wanted = limits.residual_wanted.min(limits.residual_tolerance);
            let corrects_residual = !stagnant
                && (self.residual_norm > wanted || self.moves_parameter(limits.parameter_tolerance));
            if has_converged && (!corrects_residual || self.iterations >= limits.max_iterations) {
                return self.finish(problem, limits);
            }
            self.displacement += size;
            self.check_progress(stagnant, limits)?;
            self.apply_correction();
            last = size;
        }
    }

    /// Whether the correction that is due changes the parameter by more than this part of it, and is more
    /// than rounding: the residual is above this, too.
    fn moves_parameter(&self, tolerance: f64) -> bool {
        let change = self.correction[self.correction.len() - 1].abs();
        self.residual_norm > tolerance && change > tolerance * self.parameter().abs()
    }

    /// One evaluation: correction, direction, determinant at `self.point`.
    pub fn linearise(
        &mut self,
        problem: &mut dyn PathProblem,
        weights: &[f64],
        row: &[f64],
        counters: &mut Counters,
    ) -> Result<(), CorrectorError> {
        self.iterations += 1;
        counters.evaluations += 1;
        problem.evaluate(&self.point)?;
        self.residual_norm = problem.residual().iter().fold(0.0, |m, r| r.abs().max(m));
        counters.factorisations += 1;
        self.refactorise(problem, weights, row)
    }

    /// Correction, direction, determinant with this border at the point evaluated last.
    pub fn refactorise(
        &mut self,
        problem: &mut dyn PathProblem,
        weights: &[f64],
        row: &[f64],
    ) -> Result<(), CorrectorError> {
        let determinant = problem.factorise(row).map_err(|_| CorrectorError::SingularJacobian)?;
        let n = self.point.len() - 1;
        for (c, r) in self.correction.iter_mut().zip(problem.residual()) {
            *c = -r;
        }
        self.correction[n] = 0.0;
        problem.solve(&mut self.correction);
        self.node.tangent.fill(0.0);
        self.node.tangent[n] = 1.0;
        problem.solve(&mut self.node.tangent);
        let length = norm(weights, &self.node.tangent);
        scale(&mut self.node.tangent, 1.0 / length);
        self.cosine = 1.0 / length;
        self.sign = determinant.sign;
        self.log_determinant = determinant.log_magnitude + length.ln();
        self.correction_norm = norm(weights, &self.correction);
        let finite = self.correction_norm.is_finite() && length.is_finite();
        if finite { Ok(()) } else { Err(CorrectorError::SingularJacobian) }
    }

    /// Moves the point by the correction that is due.
    pub fn apply_correction(&mut self) {
        add_scaled(&mut self.point, 1.0, &self.correction);
    }

    fn check_turn(&self, limits: Limits) -> Result<(), CorrectorError> {
        let Some(max_angle) = limits.max_angle else { return Ok(()) };
        let angle = self.cosine.clamp(-1.0, 1.0).acos();
        if angle > max_angle { Err(CorrectorError::Turned { angle }) } else { Ok(()) }
    }

    fn check_progress(&self, stagnant: bool, limits: Limits) -> Result<(), CorrectorError> {
        let allowed = limits.max_displacement;
        if self.displacement > allowed {
            return Err(CorrectorError::Displaced { displacement: self.displacement, allowed });
        }
        if stagnant || self.iterations >= limits.max_iterations {
            let (correction_norm, residual_norm) = (self.correction_norm, self.residual_norm);
            return Err(CorrectorError::NotConverged {
                iterations: self.iterations,
                correction_norm,
                residual_norm,
            });
        }
        Ok(())
    }

    fn finish(&mut self, problem: &mut dyn PathProblem, limits: Limits) -> Result<(), CorrectorError> {
        if self.residual_norm > limits.residual_tolerance {
            return Err(CorrectorError::Residual { residual_norm: self.residual_norm });
        }
        self.displacement += self.correction_norm;
        self.node.point.copy_from_slice(&self.point);
        add_scaled(&mut self.node.point, 1.0, &self.correction);
        self.signature = problem.judge().signature();
        Ok(())
    }
}
