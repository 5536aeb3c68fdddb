//! What is followed: `R(x, λ) = 0` with `n` equations for `n + 1` unknowns, seen through its linearisation.

use crate::point::Events;

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

/// A test function at the last evaluated point. Its zeros along the path become points of their own.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TestValue {
    /// The value: continuous where it is zero, and with the sign of `(−1)^count`. A function that is never
    /// negative has no zeros as events, but says where the signature may change twice within a step: where it
    /// comes near zero between two points.
    pub value: f64,
    /// How often the function has gone through zero since some common reference: two zeros within one step
    /// show here.
    pub count: u32,
    /// How many of the things that the function is made of are at zero as well as they are known: its sign is
    /// theirs by rounding.
    pub undecided: u32,
    /// So many of those nearest to zero it leaves out, see [`PathProblem::tests_without`].
    pub left_out: u32,
}

impl TestValue {
    /// A function all of which is known.
    #[must_use]
    pub fn new(value: f64, count: u32) -> Self {
        Self { value, count, ..Self::default() }
    }
}

/// How many multipliers of the solution at the last evaluated point lie outside the unit circle: of a
/// solution that is a fixed point of a map, say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outside {
    /// Those that certainly do.
    pub least: u32,
    /// With those that may, since they are critical at the events or on the circle to rounding.
    pub most: u32,
    /// How many are critical at the events: one at a fold, the pair at a Neimark-Sacker point.
    pub critical: u32,
}

/// A corner behind which `R` changes like a square root, or before which it did, as the problem knows it.
#[derive(Debug, Clone, PartialEq)]
pub struct RootCorner {
    /// The corner itself.
    pub corner: Vec<f64>,
    /// A point beside it on the side without the root, or without any: it stands for the corner, which cannot
    /// be evaluated.
    pub beside: Vec<f64>,
    /// Within which the parameter of that point is that of the corner.
    pub uncertainty: f64,
    /// Points of the path behind it, in the order in which they should be tried, each with another one
    /// farther behind it that tells the direction.
    pub behind: Vec<[Vec<f64>; 2]>,
    /// Whether more than one square root sets in at once: then the determinant may change its sign.
    pub is_multiple: bool,
    /// Work that it took, in evaluations.
    pub evaluations: u64,
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

    /// Weights of that part of a point by which a stretch that was walked before is known: the first
    /// unknowns, and the parameter last.
    ///
    /// By default all of it. A problem that changes its unknowns on the way (see
    /// [`Follower::transfer`](crate::Follower::transfer)) names a part that stays, enough to tell solutions
    /// apart, with weights that stay.
    fn memory_weights(&self) -> Vec<f64> {
        self.weights().to_vec()
    }

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

    /// Test functions at the last evaluated point, always the same number of them; asked for at points that
    /// are to be accepted. A function may jump: where its sign changes without a zero, nothing is recorded.
    fn tests(&mut self, values: &mut Vec<TestValue>) {
        values.clear();
    }

    /// The same, each without so many of the things that it is made of, those nearest to zero first: of a
    /// function that is the least of several, the least of the others.
    ///
    /// Asked for where things stay at zero along the path, as well as they are known (an undamped mode has a
    /// pair of multipliers on the unit circle): the zeros of the others are looked for without them.
    fn tests_without(&mut self, left_out: &[u32], values: &mut Vec<TestValue>) {
        let _ = left_out;
        self.tests(values);
    }

    /// Numbers at the last evaluated point, asked for with the test functions, by which
    /// [`hides_zeros`](Self::hides_zeros) compares it with the next.
    fn note(&mut self, numbers: &mut Vec<f64>) {
        numbers.clear();
    }

    /// Whether zeros of the test functions that undo each other lie between two neighbouring points of one
    /// smooth arc, as their numbers tell.
    ///
    /// A test function that is made of several things may vanish for one of them and for another in between,
    /// and be the same on both sides.
    fn hides_zeros(&self, before: &[f64], behind: &[f64]) -> bool {
        let _ = (before, behind);
        false
    }

    /// Multipliers outside the unit circle at the last evaluated point, at which these events were found;
    /// `None` if nothing is known.
    ///
    /// They cross the circle at folds, branch points and zeros of test functions only. What crosses it and
    /// turns real within one step escapes the test functions; here it shows.
    fn outside(&mut self, events: Events) -> Option<Outside> {
        let _ = events;
        None
    }

    /// Distance of a point from the nearest solution that this path can meet at branch points only, in the
    /// norm of the weights; infinite if there is none, or if nothing is known.
    ///
    /// An orbit of N periods solves the same equations as one of a divisor of N that is gone through several
    /// times, a solution without a symmetry the same as one with it. Such a path is tangent to nothing: a
    /// point that comes that close is a jump. Answered without an evaluation.
    fn distance_to_simpler(&self, point: &[f64]) -> f64 {
        let _ = point;
        f64::INFINITY
    }

    /// What kind of solution the last evaluated point is: equal along one smooth arc, different where `R` may
    /// lose derivatives (for an impact problem: a hash of the sequence of contacts, which changes at
    /// grazing).
    fn signature(&self) -> u64 {
        0
    }

    /// How many images a solution has: itself, and the same one seen otherwise, as an orbit that begins some
    /// excitation periods later. A path that comes back to an image of its start has closed.
    fn images(&self) -> usize {
        1
    }

    /// A point or a tangent as its image `k`, from 1 to below [`images`](Self::images); a change of the
    /// unknowns that keeps the inner product and the parameter.
    fn image(&self, k: usize, vector: &[f64]) -> Vec<f64> {
        let _ = k;
        vector.to_vec()
    }

    /// Whether `R` may change like a square root behind a change of signature, so that its derivatives grow
    /// without bound there (impacts on rigid stops, at grazing).
    fn has_root_corners(&self) -> bool {
        false
    }

    /// The corner that lies ahead of a point of the path, if the problem can compute it: where `R` begins or
    /// ceases to change like a square root.
    ///
    /// It is looked for from the point, whatever was evaluated last; then another point may be evaluated.
    ///
    /// * `reach`: about how far ahead it lies at most.
    /// * `lies_ahead`: whether a corner that was found is one ahead.
    fn root_corner(
        &mut self,
        point: &[f64],
        reach: f64,
        lies_ahead: &dyn Fn(&[f64]) -> bool,
    ) -> Option<RootCorner> {
        let _ = (point, reach, lies_ahead);
        None
    }

    /// Estimated length along the unit tangent from the last evaluated point to the next change of signature
    /// ahead; infinite if none is in sight or nothing is known.
    ///
    /// With it the steps shrink before the change is met, and two changes within one step are not overlooked.
    fn distance_to_change(&self, tangent: &[f64]) -> f64 {
        let _ = tangent;
        f64::INFINITY
    }
}
