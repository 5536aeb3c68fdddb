//! Curves of bifurcations in two parameters: the frequency `f` and a parameter `p` of the system.
//!
//! # Mathematics
//! To the shooting equations `R(z, f, p) = 0` comes a condition, and the path crate follows the solutions
//! `[z; f]` over `p`:
//!
//! - fold, flip: `g = 0` from `[A - mu I, b; c^T, 0] [v; g] = [0; 1]`, `mu = +1` or `-1`, `A` the
//!   monodromy matrix
//! - Neimark-Sacker: `ln d = 0`, `d` the determinant of `A` on the invariant plane of the pair
//! - grazing: the orbit is cut at the phase `x` of the touch, a further unknown: `r = level`, `r' = 0` of
//!   the element there
//!
//! `g` and `ln d` have gradients `-w^T (dA) v` and `tr(A_c^-1 L^T (dA) R)`, with left and right vectors.
//! Second derivatives of the flow are symmetric, so `w^T (dA/dz_j) v` for all `j` at once is the derivative
//! of `w^T A` along `v`: a central difference of exact fundamental matrices, two evaluations for each vector,
//! whatever the number of unknowns. Beside a grazing at the distance `D` the matrices go like `sqrt(D)`, so
//! steps of the differences are shortened where the second difference says that they are not small against
//! `D` (`differences.rs`). The residual is exact; only the convergence depends on the difference, of relative
//! accuracy 1e-6 or so, less within 1e-9 of a grazing.
//!
//! The grazing orbit is cut at its touch, so no force acts at its ends, and both conditions are linear in the
//! unknowns. Beside its ends the touched element is left out, so that its equations are smooth
//! (`passing.rs`): it is the end of the orbits that pass the contact, and its multipliers are theirs.
//!
//! # Points of codimension two
//! They are zeros of test functions, located by the path (`marks.rs`):
//!
//! - fold: *cusp* (`w^T D^2 Z (v, v) = 0`), *1:1 resonance* (`w^T v = 0`: a second multiplier at +1),
//!   *fold-flip*, *fold-Neimark-Sacker*
//! - flip: *1:2 resonance* (`w^T v = 0`), *fold-flip*, *flip-Neimark-Sacker*, *degenerate flip* (its
//!   criticality changes)
//! - Neimark-Sacker: with `k = tr A_c / 2 = cos(angle)` the resonances 1:1 (`k = 1`), 1:2 (`-1`), 1:3
//!   (`-1/2`) and 1:4 (`0`), at the first two of which the curve ends; *fold-*, *flip-* and *double
//!   Neimark-Sacker*; *degenerate Neimark-Sacker* (Chenciner)
//! - grazing: multipliers at +1 and -1, a pair on the circle, the touch without curvature (`r'' = 0`)
//!
//! The functions of `stability.rs` show what further multipliers do. They leave out the critical ones, which
//! are removed by reflections that turn their vectors into axes (`deflated.rs`). A zero is marked where a
//! multiplier is in its place: neutral saddles, pairs that become real and multipliers that jump over their
//! place are none. Criticality follows from normal forms (`normal_form.rs`, `lyapunov.rs`), whose tensors are
//! differences of fundamental matrices; where these cannot be computed, its test has no value
//! (`criticality.rs`).
//!
//! A curve of folds ends where its orbits become orbits of half their period (*degenerate flip*) or symmetric
//! (*degenerate branch point*): there lies the degenerate point of the flips of the map over half the period,
//! and behind it the curve is its own image (`image.rs`, `meeting.rs`).
//!
//! The curve is cut exactly at the ends of the frequency range (`frequency_end.rs`).
//!
//! A second contact that is grazed (*double grazing*) is a change of contacts on a grazing curve, since those
//! that are touched anyway are not among them; it is bracketed like every such change. On other curves such a
//! change is where the bifurcation meets a grazing.
//!
//! # Sources
//! Govaerts, *Numerical Methods for Bifurcations of Dynamical Equilibria* (2000), chapters 3 and 4;
//! Kuznetsov, *Elements of Applied Bifurcation Theory* (2004), chapters 9 and 10.
//!
//! # Limits
//! All matrices are dense and the orbit keeps its segments and its units. Grazing of a stop without a single
//! gap (preloaded, or two-sided with two gaps, or a rigid one that holds the structure at rest) is followed
//! with the contact, so that the start may not be corrected. In the damping, each point builds its integrator
//! anew. A closed curve whose start could not be carried to another phase goes round until its budget is used
//! up. Degenerate flips and Neimark-Sacker points are known to about 1e-8 of the ranges, beside contacts to
//! 1e-7, and so near to a grazing that derivatives of third order cannot be computed they are not marked;
//! neither is a second touch of the contact that a grazing curve follows. A curve ends where contacts change
//! its monodromy matrix too sharply. Where a contact reopens it ends (`reopening.rs`). Where a fold, flip or
//! Neimark-Sacker point has met a grazing and lies within rounding of it, the curve ends some rows later, and
//! says so; the place itself is not located. Where the orbits of a curve become images of themselves in more
//! than one way at once, as orbits of two periods that become symmetric ones of one, the end is not
//! recognised either.

mod along;
mod bordered;
mod clear;
mod closing;
mod condition;
mod criticality;
mod deflated;
mod differences;
mod frequency_end;
mod grazing;
mod image;
mod linear;
mod lyapunov;
mod marks;
mod meeting;
mod normal_form;
mod null;
mod opposite;
mod pair;
mod passing;
mod problem;
mod reopening;
mod row;
mod rows;
mod shooting;
mod start;
mod start_phase;
mod touched;
mod walk;

#[cfg(test)]
mod tests;

pub use row::{CurveEnd, CurveEvents, CurveKind, CurveRow, CurveSettings};
pub use walk::CurveWalk;
