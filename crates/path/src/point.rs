//! What a branch is made of.

/// Events at an accepted point; several may coincide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PathEvents {
    /// The parameter is stationary and turns: a fold.
    pub fold: bool,
    /// Branches cross here: `[R_x R_λ]` loses rank, the sign of the determinant changes, the tangent does
    /// not.
    pub branch_point: bool,
    /// The signature is another one than at the point before; the change lies within
    /// `Settings::signature_step`.
    pub signature_change: bool,
    /// The tangent turned here within `Settings::min_step`: a corner of the path.
    pub corner: bool,
    /// Bit `k` is set where test function `k` of the problem is zero.
    pub zeros: u32,
}

impl PathEvents {
    /// Whether anything happened here.
    #[must_use]
    pub fn any(&self) -> bool {
        *self != Self::default()
    }
}

/// One converged solution on the path.
#[derive(Debug, Clone, PartialEq)]
pub struct ContinuationPoint {
    /// `z = [x; λ]`.
    pub point: Vec<f64>,
    /// Unit tangent in the direction of travel, weighted norm.
    pub tangent: Vec<f64>,
    /// Arc length from the start, weighted norm.
    pub arc_length: f64,
    /// Signature of the solution.
    pub signature: u64,
    /// Sign of `det [R_x R_λ; (W t)ᵀ]` on this arc: constant but for branch points.
    pub orientation: f64,
    /// `ln |det [R_x R_λ; (W t)ᵀ]|`, the distance from a branch point; −∞ where it is singular.
    pub log_determinant: f64,
    /// Norm of the Newton correction that is still due: the error estimate of `point`.
    pub correction_norm: f64,
    /// `max |R_i|`.
    pub residual_norm: f64,
    /// What happened here.
    pub events: PathEvents,
    /// Arc length within which an event here was located; zero where nothing happened.
    pub uncertainty: f64,
    /// Evaluations spent since the point before.
    pub evaluations: u64,
}

impl ContinuationPoint {
    /// A point of zeros with that many entries.
    #[must_use]
    pub fn empty(length: usize) -> Self {
        Self {
            point: vec![0.0; length],
            tangent: vec![0.0; length],
            arc_length: 0.0,
            signature: 0,
            orientation: 1.0,
            log_determinant: 0.0,
            correction_norm: 0.0,
            residual_norm: 0.0,
            events: PathEvents::default(),
            uncertainty: 0.0,
            evaluations: 0,
        }
    }

    /// Parameter `λ` of the point.
    #[must_use]
    pub fn parameter(&self) -> f64 {
        self.point[self.point.len() - 1]
    }

    /// Component `t_λ` of the tangent: zero at a fold.
    #[must_use]
    pub fn tangent_parameter(&self) -> f64 {
        self.tangent[self.tangent.len() - 1]
    }
}

/// Work done since the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counters {
    /// Evaluations of the problem.
    pub evaluations: u64,
    /// Factorisations of the bordered matrix.
    pub factorisations: u64,
    /// Accepted points, the start not counted.
    pub accepted: u64,
    /// Attempted steps that were given up.
    pub rejected: u64,
    /// Accepted steps shorter than `Settings::short_step`, less those that longer ones have made up for: one
    /// for each whole `short_step` of their length beyond the first.
    pub short_steps: u64,
}
