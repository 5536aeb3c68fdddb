//! Curves of bifurcations in two parameters: the frequency `f` and a parameter `p` of the system.
//!
//! # Mathematics
//! To the shooting equations `R(z, f, p) = 0` comes a condition, and the path crate follows the solutions `[z; f]` over `p`:
//!
//! | curve | condition |
//! |---|---|
//! | fold, flip | `g = 0` from `[A - mu I, b; c^T, 0] [v; g] = [0; 1]`, `mu = +1` or `-1`, `A` the monodromy matrix |
//! | Neimark-Sacker | `ln d = 0`, `d` the determinant of `A` on the invariant plane of the pair |
//! | grazing | the orbit is cut at the phase `x` of the touch, a further unknown: `r = level`, `r' = 0` of the element there |
//!
//! `g` and `ln d` have gradients `-w^T (dA) v` and `tr(A_c^-1 L^T (dA) R)`, with left and right vectors. Second derivatives of the flow are symmetric, so
//! `w^T (dA/dz_j) v` for all `j` at once is the derivative of `w^T A` along `v`: a central difference of exact fundamental matrices, two evaluations for each
//! vector, whatever the number of unknowns. Beside a grazing at the distance `D` the matrices go like `sqrt(D)`, so steps of the differences are shortened where the second difference says that they are not
//! small against `D` (`differences.rs`). The residual is exact; only the convergence depends on the difference, of relative accuracy 1e-6 or so, less within 1e-9 of a grazing.
//!
//! The grazing orbit is cut at its touch, so no force acts at its ends, and both conditions are linear in the unknowns. Beside its ends the touched element is left out, so that its equations are smooth (`passing.rs`): it is the end of the
//! orbits that pass the contact, and its multipliers are theirs.
//!
//! # Points of codimension two
//! They are zeros of test functions, located by the path: on a fold curve the *cusp* (`w^T D^2 Z (v, v) = 0`), the *1:1 resonance* (`w^T v = 0`: a second multiplier
//! at +1) and the *fold-flip* (`prod (1 + mu_i)`); on a flip curve the *1:2 resonance* (`w^T v = 0`) and the *fold-flip* (`prod (1 - mu_i)`); on a Neimark-Sacker
//! curve, with `k = tr A_c / 2 = cos(angle)`, the resonances 1:1 (`k = 1`), 1:2 (`-1`), 1:3 (`-1/2`) and 1:4 (`0`), at the first two of which the curve ends; on a grazing curve
//! the multipliers at +1 and -1 and the touch without curvature (`r'' = 0`).
//!
//! # Sources
//! Govaerts, *Numerical Methods for Bifurcations of Dynamical Equilibria* (2000), chapters 3 and 4; Kuznetsov, *Elements of Applied Bifurcation Theory* (2004),
//! chapter 10.
//!
//! # Limits
//! All matrices are dense and the orbit keeps its segments and its units. Grazing of a stop without a single gap (preloaded, or two-sided with two gaps, or a rigid one that holds the structure at rest) is followed with the contact, so that the start may not be corrected. In the damping, each point builds its integrator
//! anew. A closed curve whose start could not be carried to another phase goes round until its budget is used up. Cusps of flip curves (a flip that changes its criticality) are not marked. A curve ends where contacts change its monodromy matrix too sharply. Where a fold, flip or Neimark-Sacker point has met a grazing and lies within rounding of it, the curve ends some rows later, and says so; the place itself is not located.

mod bordered;
mod condition;
mod deflated;
mod differences;
mod grazing;
mod marks;
mod null;
mod pair;
mod passing;
mod problem;
mod recut;
mod row;
mod shooting;
mod start;
mod walk;

#[cfg(test)]
mod tests;

pub use row::{CurveEnd, CurveEvents, CurveKind, CurveRow, CurveSettings};
pub use walk::CurveWalk;
