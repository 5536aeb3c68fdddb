//! Following the solutions of `R(x, λ) = 0`: `n` equations, `n` unknowns `x`, one parameter `λ`.
//! Equation (O1) of the book, `docs/theory`.
//!
//! # Mathematics
//! A point is `z = [x; λ]`. Where `[R_x R_λ]` has rank `n` the solutions form a smooth curve with a unit
//! tangent `t`, `[R_x R_λ] t = 0`. Lengths and angles follow from a weighted inner product `⟨a, b⟩ = Σ w_i
//! a_i b_i = aᵀ W b`.
//!
//! **Pseudo-arclength** (Keller 1977). From `z₀` with tangent `t₀` the next point is sought in the plane
//! `⟨t₀, z − z₀⟩ = h`, which also meets the curve at folds. Newton's method solves `[R_x R_λ; (W t₀)ᵀ] d =
//! −[R; 0]`, and the same factorisation gives `w` with `[R_x R_λ; (W t₀)ᵀ] w = e_last`, which has the
//! direction of the curve. The prediction is the tangent, or the cubic or quintic Hermite polynomial through
//! the last points of the same smooth arc, whichever would have served the last step best. So at short steps
//! the first evaluation already is on the curve. A point is accepted where it was evaluated, with a
//! correction still due that is below the tolerance; the correction is its error estimate and goes into the
//! predictor.
//!
//! **Orientation** (Allgower and Georg 2003). Along a regular arc `D = det [R_x R_λ; (W t)ᵀ]` has no zero, so
//! its sign is constant if `t` points in the direction of travel; and `sign det [R_x R_λ; (W w)ᵀ] = sign det
//! [R_x R_λ; (W t₀)ᵀ]`. Hence `t = ± w/‖w‖` with the sign that keeps the sign of `D`, whatever the angle to
//! `t₀`. The angle rule of the textbooks runs back at a fold sharper than the step. The same holds across a
//! corner: where continuous smooth pieces meet, tangents oriented by `D` cross the border between the pieces
//! in the same sense.
//!
//! **Doubt.** The orientation is necessary, not sufficient: the corrector may land on another sheet. A step
//! is in doubt if
//! - the corrector moves the prediction by more than `min(sheet_distance, h/10)`, does not contract, or
//!   fails,
//! - the tangent turns by more than `max_angle`,
//! - `D` changes its sign and there is no branch point between,
//! - `‖z₁ − z₀ − h (t₀ + t₁)/2‖ > sheet_distance + h θ/10`: chord and tangents do not belong to one arc,
//! - the signature of the solution changes and `h > signature_step`,
//! - the Hermite polynomial of `λ` turns twice,
//! - the point lies on a simpler path, which the judge knows and which is met at branch points only,
//! - the point lies on a stretch that was already walked.
//!
//! The second look at a step in doubt is the step to about its middle, and from there on: what short steps
//! find is kept. A doubt that remains at the shortest step is a corner, or ends the branch with its
//! [`PathStop`].
//!
//! **Events** are points of their own. A *fold* is a zero of `t_λ`, located by regula falsi between accepted
//! points. A *branch point* is a zero of `D` through which the tangent goes straight; a jump to a sheet that
//! runs the other way changes the sign of `D` as well, but without a zero. The direction is kept and the sign
//! anchored anew. At a *change of signature* the steps shrink to `signature_step` on both sides, in
//! proportion to the distance from the change, so that pairs of folds beside it are found whatever the
//! longest step; the change itself is bracketed by bisection. A *zero of a test function* of the problem (for
//! orbits: a multiplier on the unit circle) is located by regula falsi. A step is in doubt where the count of
//! its zeros rises by two, or a parabola through its last values comes close to zero. So is a step over which
//! another number of multipliers crosses the unit circle than the events say.
//!
//! # Example
//! The unit circle has two folds and closes.
//! ```
//! use hammerbeam_path::{DenseProblem, StartDirection, ParameterRange, Settings, PathStop, follow};
//!
//! let mut circle = DenseProblem::new(1, |z: &[f64], residual: &mut [f64], jacobian: &mut [f64]| {
//!     residual[0] = z[0] * z[0] + z[1] * z[1] - 1.0;
//!     jacobian.copy_from_slice(&[2.0 * z[0], 2.0 * z[1]]);
//!     0
//! });
//! let range = ParameterRange::new(-2.0, 2.0)?;
//! let branch = follow(&mut circle, &[1.0, 0.0], StartDirection::Increasing, range, Settings::default())?;
//! assert_eq!(branch.stop, PathStop::Closed);
//! assert_eq!(branch.folds().count(), 2);
//! # Ok::<(), hammerbeam_path::PathError>(())
//! ```
//!
//! # Limits
//! - Branch points of even multiplicity, at which `D` does not change its sign, are walked through unnoticed.
//! - Sheets closer than `sheet_distance` with the same direction, or folds closer than the steps that nothing
//!   else makes short, can be missed.
//! - Corners behind which `R` changes like a square root end the branch, unless the judge says that there are
//!   such ([`Judge::has_root_corners`]); then they are passed, and known to lie within the step over them, or
//!   exactly if the judge computes them ([`Judge::root_corner`]).

mod between;
mod checkpoint;
mod corrector;
mod dense_lu;
mod dense_problem;
mod error;
mod follower;
mod judge;
mod memory;
mod point;
mod predictor;
mod problem;
mod product;
mod settings;
mod state;
mod test_record;

pub use between::solve_between;
pub use checkpoint::Checkpoint;
pub use corrector::CorrectorError;
pub use dense_lu::DenseLu;
pub use dense_problem::DenseProblem;
pub use error::{PathError, PathStop, StepDoubt};
pub use follower::{
    Branch, Follower, MOST_SHORT_STEPS, PassedCorner, StartDirection, StepOutcome, TwoSidedBranch, follow,
    follow_both,
};
pub use judge::{Image, Judge, Outside, RootCorner};
pub use point::{ContinuationPoint, Counters, PathEvents};
pub use predictor::{History, Node};
pub use problem::{Determinant, EvaluationError, PathProblem, SingularJacobian, TestKind, TestValue};
pub use product::{distance, norm, weighed};
pub use settings::{ParameterRange, Settings};
pub use state::PathState;
pub use test_record::TestRecord;
