//! Round holes: elements that come in pairs, whose force turns with the displacement.
//!
//! The law and its mathematics are in `law/round_hole.rs`. A hole has two outputs and two inputs, those of
//! the element that has its law and of the one behind it, which acts while the first is closed. All that is
//! linear does not know of holes. What does is here:
//!
//! * the *reading* R of a hole, with its derivatives from those of both outputs; it takes the place of the
//!   relative displacement wherever contacts are looked for, located or judged;
//! * bounds on its derivatives over a time ahead. Those of the outputs come from energy norms, and hold
//!   however long that is. Or they come from the present displacement and velocity with a bound A on the
//!   acceleration, `V = |r'| + A T` and `P = |r| + |r'| T + A T^2/2` over the time T. The lesser ones count;
//! * forces of elements by the displacements of all, with the derivatives by both displacements of a hole.
//!
//! **Force steps.** At the nodes `F_k = F(y_k, z_k)`, so Newton's matrix is `I - W f'` with the blocks
//! `[[f_yy, f_yz], [f_yz, f_zz]]` in the place of the slopes of both elements; and so are the sensitivities,
//! `dF = f' dr`. That a hole stays closed all through a step is shown by the polynomials of `enclosure.rs`,
//! with the remainder of a product; where they do not, the certified search of `touching.rs` decides, with
//! the bounds above.
//!
//! **Touches.** An elastic force is continuous where it begins, whatever its direction, so nothing jumps in
//! the state or in the sensitivities as a hole is touched or left.

use super::{clearance::ClearanceBounds, drive::Jet};
use crate::{
    Law,
    law::{Force, HoleForce, RoundHole},
};

/// Bounds on an output over a time ahead: its magnitude, and those of its derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct OutputBounds {
    pub value: f64,
    pub first: f64,
    pub second: f64,
    pub third: f64,
    /// Rounding margin [m].
    pub margin: f64,
}

/// The reading of a hole from the jets of its outputs.
pub(super) fn reading(hole: &RoundHole, y: Jet, z: Jet) -> Jet {
    let parts = |jet: Jet| [jet.value, jet.slope, jet.curvature];
    let [value, slope, curvature] = hole.reading(parts(y), parts(z));
    Jet { value, slope, curvature }
}

/// Bounds on the reading of a hole over a time ahead.
///
/// * `now`: its outputs now; `bounds`: on them over that time.
pub(super) fn reading_bounds(
    hole: &RoundHole,
    now: [Jet; 2],
    bounds: [OutputBounds; 2],
    ahead: f64,
) -> ClearanceBounds {
    let whole = |of: fn(&OutputBounds) -> f64| length(bounds.each_ref().map(of));
    let (acceleration, jerk) = (whole(|b| b.second), whole(|b| b.third));
    let fastest = whole(|b| b.first).min(length(now.map(|jet| jet.slope)) + acceleration * ahead);
    let farthest = farthest(now, bounds, ahead);
    let clearance = hole.clearance();
    let of_terms = 0.5 * clearance + 0.5 * farthest * farthest / clearance;
    ClearanceBounds {
        second: (fastest * fastest + farthest * acceleration) / clearance,
        third: (3.0 * fastest * acceleration + farthest * jerk) / clearance,
        margin: farthest / clearance * whole(|b| b.margin) + 8.0 * f64::EPSILON * of_terms,
    }
}

/// P: the largest distance from the axis of a hole over a time ahead.
pub(super) fn farthest(now: [Jet; 2], bounds: [OutputBounds; 2], ahead: f64) -> f64 {
    let acceleration = length(bounds.map(|b| b.second));
    let (distance, speed) = (length(now.map(|jet| jet.value)), length(now.map(|jet| jet.slope)));
    let moved = distance + ahead * (speed + 0.5 * acceleration * ahead);
    length(bounds.map(|b| b.value)).min(moved)
}

fn length([y, z]: [f64; 2]) -> f64 {
    y.hypot(z)
}

/// Whether an element is the second direction of a hole.
pub(super) fn is_across(laws: &[Law], element: usize) -> bool {
    matches!(laws[element], Law::AcrossHole(_))
}

/// The element that has the contact of an element: of the second direction of a hole the one before it.
pub(super) fn owner(laws: &[Law], element: usize) -> usize {
    if is_across(laws, element) { element - 1 } else { element }
}

/// Force of an element and its derivatives by its own displacement and velocity, from the outputs of
/// elements.
pub(super) fn force_of(laws: &[Law], element: usize, at: impl Fn(usize) -> Jet) -> Force {
    let of_hole = |first: usize, hole: &RoundHole, part: usize| {
        let HoleForce { value, slopes, .. } = hole.force_at([at(first).value, at(first + 1).value]);
        Force { value: value[part], slope: slopes[part], damping: 0.0 }
    };
    match (&laws[element], element.checked_sub(1).map(|before| &laws[before])) {
        (Law::RoundHole(hole), _) => of_hole(element, hole, 0),
        (Law::AcrossHole(_), Some(Law::RoundHole(hole))) => of_hole(element - 1, hole, 1),
        (law, _) => {
            let jet = at(element);
            law.pressing_force(jet.value, jet.slope)
        }
    }
}

/// Rate of the force of an element while its outputs move on.
pub(super) fn force_rate(laws: &[Law], element: usize, at: impl Fn(usize) -> Jet) -> f64 {
    let of_hole = |first: usize, hole: &RoundHole, part: usize| {
        let (y, z) = (at(first), at(first + 1));
        let HoleForce { slopes, cross, .. } = hole.force_at([y.value, z.value]);
        let own = [y.slope, z.slope];
        slopes[part] * own[part] + cross * own[1 - part]
    };
    match (&laws[element], element.checked_sub(1).map(|before| &laws[before])) {
        (Law::RoundHole(hole), _) => of_hole(element, hole, 0),
        (Law::AcrossHole(_), Some(Law::RoundHole(hole))) => of_hole(element - 1, hole, 1),
        (law, _) => {
            let jet = at(element);
            let force = law.pressing_force(jet.value, jet.slope);
            force.slope * jet.slope + force.damping * jet.curvature
        }
    }
}

/// Forces at the nodes of the active element at that place; of a hole their magnitudes.
///
/// * `forces`: of all active elements at the nodes.
pub(super) fn magnitudes<const N: usize>(law: &Law, forces: &[[f64; N]], place: usize) -> [f64; N] {
    match law.round_hole() {
        Some(_) => std::array::from_fn(|k| length([forces[place][k], forces[place + 1][k]])),
        None => forces[place],
    }
}
