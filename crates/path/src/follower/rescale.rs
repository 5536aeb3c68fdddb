//! Going on in larger or smaller units of the unknowns.
//!
//! Tolerances, steps and the distance of sheets are lengths, measured in units of the unknowns that fit the
//! start. Where the unknowns grow or shrink by orders of magnitude, a problem may change its units: `x' =
//! x/c`, `R' = R/c`, the parameter and the weights as they are. A unit tangent `t` then has the length `ρ =
//! ‖[t_x/c; t_λ]‖` and becomes `[t_x/c; t_λ]/ρ`; a step along it keeps its end if its length is multiplied by
//! `ρ`. The vector `N` of the minors of `[R_x R_λ]`, which is `D t`, changes like a point, so that `D' = ρ
//! D`: no sign changes. The memory stays in the first units.

use super::Follower;
use crate::{
    memory::in_units,
    point::ContinuationPoint,
    product::{norm, scale},
};

impl Follower {
    /// The problem has made the units of its unknowns `factor` times as large.
    pub fn rescale(&mut self, factor: f64) {
        let weights = &self.weights;
        let state = &mut self.state;
        state.unit *= factor;
        for node in &mut state.history.nodes {
            divide(&mut node.point, factor);
            renormalise(&mut node.tangent, weights, factor);
        }
        for point in [&mut state.current, &mut state.start] {
            divide(&mut point.point, factor);
            let length = renormalise(&mut point.tangent, weights, factor);
            point.log_determinant += length.ln();
        }
        // A step may be tried along the tangent of the present point.
        let mut tangent = state.current.tangent.clone();
        let grown = 1.0 / renormalise(&mut tangent, weights, 1.0 / factor);
        state.step_length = (state.step_length * grown).max(self.settings.min_step);
        state.change_ahead *= grown;
    }

    /// A point as it is in the units of the start.
    #[must_use]
    pub fn in_first_units(&self, point: &ContinuationPoint) -> ContinuationPoint {
        let unit = self.state.unit;
        let of = |values: &[f64]| in_units(values, unit);
        ContinuationPoint { point: of(&point.point), tangent: of(&point.tangent), ..point.clone() }
    }
}

fn divide(values: &mut [f64], factor: f64) {
    let last = values.len() - 1;
    scale(&mut values[..last], 1.0 / factor);
}

/// Length in the new units, which becomes one.
fn renormalise(tangent: &mut [f64], weights: &[f64], factor: f64) -> f64 {
    divide(tangent, factor);
    let length = norm(weights, tangent);
    if length > 0.0 {
        scale(tangent, 1.0 / length);
    }
    length
}
