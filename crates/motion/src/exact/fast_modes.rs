//! Looks in flight that bound fast modes by what they move and not by their derivatives.
//!
//! The third derivative of a clearance is mostly that of modes which hardly move it: a block of the rate `w`
//! and the amplitude `v` has `w^3 v` in the bound `B_3` of `clearance.rs`, but only v in the clearance. In
//! flight no block gains energy, so with a set S of blocks of nonzero stiffness, and with the factors
//! `g_i` of the output on their energy norms `|x_i|`,
//!
//! `d(t) >= d_S(t) - e`, `e = sum_{i in S} g_i |x_i|`,
//!
//! where `d_S` is the clearance without the parts of S. Its derivatives have bounds without S, so the safe
//! steps of `clearance.rs` from `d_S - e` are safe for d. S is made of the last blocks, mostly the fastest,
//! as long as e stays below [`SHARE`] of the clearance: near a contact it is empty.

use super::{
    ExactIntegrator,
    clearance::{ClearanceBounds, free_for},
    drive::Jet,
    flight::{Boundary, Touch},
};

/// Most of a clearance that fast modes may take.
const SHARE: f64 = 0.25;

impl ExactIntegrator {
    /// A time that is free of contact, counted from a look in flight, by the slow modes; 0 if no mode is
    /// fast.
    ///
    /// * `state`: homogeneous block state at the look; `touch`: whose clearance it is.
    /// * `clearance` and `bounds`: of the whole motion.
    pub(super) fn free_for_by_slow_modes(
        &self,
        (state, element, until): (&[f64], usize, f64),
        touch: Touch,
        clearance: Jet,
        bounds: ClearanceBounds,
    ) -> f64 {
        let towards = match touch.boundary {
            Boundary::Closes => -self.laws[touch.element].contacts()[touch.contact].sign,
            Boundary::Leaves => self.laws[touch.element].contacts()[touch.contact].sign,
            // Pressures and pressing forces, which fast modes move more.
            _ => return 0.0,
        };
        let (output, n) = (&self.outputs[element], self.blocks.count());
        let norm = |i: usize| self.energy_norm(state, i);
        let (mut slow, mut taken) = (clearance, bounds.margin);
        let mut first = n;
        while first > 0 && self.blocks.stiffness[first - 1] > 0.0 {
            let i = first - 1;
            let amplitude = output.value_bound[i] * norm(i);
            if taken + amplitude > SHARE * clearance.value {
                break;
            }
            taken += amplitude;
            let part = |row: &[f64]| towards * (row[i] * state[i] + row[n + i] * state[n + i]);
            slow.value -= part(&output.row);
            slow.slope -= part(&output.velocity_row);
            slow.curvature -= part(&output.acceleration_row);
            first = i;
        }
        if first == n {
            return 0.0;
        }
        let (mut second, mut third) = self.drive.bounds(element, output, until);
        for i in 0..first {
            let norm = norm(i);
            second += output.second_bound[i] * norm;
            third += output.third_bound[i] * norm;
        }
        slow.value -= taken;
        free_for(slow, ClearanceBounds { second, third, ..bounds })
    }
}
