//! What is followed: `R(x, λ) = 0` with `n` equations for `n + 1` unknowns, seen through its linearisation.

use crate::judge::Judge;

/// Why `R` could not be evaluated at a point. The step that asked for it is shortened.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EvaluationError {
    /// A number of the residual or of its derivatives is infinite or not a number.
    #[error("the residual or its derivatives are not finite")]
    NotFinite,
    /// The point lies where the problem is not defined.
    #[error("the point lies outside the domain of the problem")]
    OutsideDomain,
    /// The work of one evaluation exceeded what the problem allows itself.
    #[error("one evaluation took more work than allowed")]
    WorkLimit,
}

/// The bordered matrix has no inverse: a branch point, or a border that is orthogonal to the tangent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the bordered Jacobian is singular")]
pub struct SingularJacobian;

/// Determinant of a matrix as `sign · exp(log_magnitude)`, which cannot overflow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Determinant {
    /// +1 or −1.
    pub sign: f64,
    /// `ln |det|`.
    pub log_magnitude: f64,
}

/// What a test function looks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TestKind {
    /// Its zeros are events: a change of its sign within a step is located.
    #[default]
    SignChange,
    /// It is never negative, and near zero where the signature is about to jump. Where it comes near zero
    /// between two points, the signature may jump twice between them: the step is shortened, and a jump
    /// that shows is bracketed.
    NearJump,
}

/// A test function at the last evaluated point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TestValue {
    /// What is looked for.
    pub kind: TestKind,
    /// The value: continuous where it is zero, and with the sign of `(−1)^count`.
    pub value: f64,
    /// How often the function has gone through zero since some common reference: two zeros within one step
    /// show here.
    pub count: u32,
    /// How many of the things that the function is made of are at zero as well as they are known: its sign is
    /// theirs by rounding.
    pub undecided: u32,
    /// So many of those nearest to zero it leaves out, see [`PathProblem::tests`].
    pub left_out: u32,
}

impl TestValue {
    /// A function whose sign changes are located, all of which is known.
    #[must_use]
    pub fn sign_change(value: f64, count: u32) -> Self {
        Self { value, count, ..Self::default() }
    }

    /// A function that is never negative, and near zero where the signature is about to jump.
    #[must_use]
    pub fn near_jump(value: f64) -> Self {
        Self { kind: TestKind::NearJump, value, ..Self::default() }
    }
}

/// A system of `n` equations `R(x, λ) = 0` in `n` unknowns `x` and one parameter `λ`.
///
/// A *point* is `z = [x; λ]`, length `n + 1`. `evaluate` does the expensive work and keeps `R` and
/// `[R_x R_λ]`; all other methods refer to the last evaluated point. Equal points must give equal bits,
/// else a resumed run differs from an uninterrupted one.
pub trait PathProblem {
    /// `n`, the length of `x` and of `R`.
    fn unknowns(&self) -> usize;

    /// Weights `w_i > 0` of the inner product `⟨a, b⟩ = Σ w_i a_i b_i` of points, length `n + 1`.
    ///
    /// They scale the problem: every length in [`Settings`](crate::Settings) is measured with them.
    fn weights(&self) -> &[f64];

    /// Evaluates `R` and `[R_x R_λ]` at the point and keeps both.
    ///
    /// # Errors
    /// See [`EvaluationError`]; the step is then shortened.
    fn evaluate(&mut self, point: &[f64]) -> Result<(), EvaluationError>;

    /// `R` at the last evaluated point, scaled to order one, length `n`.
    fn residual(&self) -> &[f64];

    /// Factorises `[R_x R_λ; row]` at the last evaluated point.
    ///
    /// # Errors
    /// [`SingularJacobian`] when a pivot is zero or not finite.
    fn factorise(&mut self, row: &[f64]) -> Result<Determinant, SingularJacobian>;

    /// Solves with the last factorisation, in place, length `n + 1`.
    fn solve(&self, right_hand_side: &mut [f64]);

    /// Test functions at the last evaluated point, always the same ones in the same order; asked for at
    /// points that are to be accepted. A function may jump: where its sign changes without a zero, nothing is
    /// recorded.
    ///
    /// * `left_out`: how many of the things that a function is made of it leaves out, those nearest to zero
    ///   first (none where the list is shorter): of a function that is the least of several, the least of the
    ///   others. Asked for where things stay at zero along the path, as well as they are known (an undamped
    ///   mode has a pair of multipliers on the unit circle): the zeros of the others are looked for without
    ///   them.
    fn tests(&mut self, left_out: &[u32], values: &mut Vec<TestValue>) {
        let _ = left_out;
        values.clear();
    }

    /// Whom the follower asks what the equations do not say, see [`Judge`]. A problem that is nothing but its
    /// equations is a judge of its own that answers nothing: `impl Judge for Problem {}`.
    fn judge(&mut self) -> &mut dyn Judge;
}
