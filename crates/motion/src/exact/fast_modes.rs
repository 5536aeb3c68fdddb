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

#[cfg(test)]
mod tests {
    use faer::Mat;
    use hammerbeam_structure::ReducedModel;

    use super::*;
    use crate::{
        Law, Load, LocalElement, Stretch, System,
        exact::{ExactSettings, flight::clearance_of},
        law::LinearStop,
    };

    /// A slow mode that carries the clearance, and two fast ones that hardly move it.
    fn integrator() -> ExactIntegrator {
        let natural_frequencies = vec![1.0, 40.0, 300.0];
        let model = ReducedModel {
            damping: Mat::from_fn(3, 3, |i, j| if i == j { 0.02 * natural_frequencies[i] } else { 0.0 }),
            natural_frequencies,
            points: vec![],
            supports: vec![],
            uniform_acceleration: vec![0.0; 3],
        };
        let law = Law::Linear(LinearStop::with_gap(1.0, 1.0).unwrap());
        let element =
            LocalElement { name: "stop".into(), shape: vec![1.0; 3], support_ratios: vec![0.0], law };
        let system = System::new(model, &Load::default(), vec![element]).unwrap();
        ExactIntegrator::new(system, ExactSettings::default()).unwrap()
    }

    /// Over the whole of the time that is said to be free the clearance of the motion is positive, on a grid
    /// that resolves the fastest mode; and near a contact no mode is fast.
    #[test]
    fn what_slow_modes_leave_free_is_free_and_longer() {
        let stretch = Stretch { frequency_hz: 0.1, start: 0.0, end: 1.0 };
        let touch = Touch { element: 0, contact: 0, boundary: Boundary::Closes };
        let (mut longer, mut integrator) = (0, integrator());
        for seed in 0..200 {
            let random = |k: i32| f64::from((seed * 7 + k) * 7919 % 1000) / 500.0 - 1.0;
            let state =
                [0.9 * random(1), 0.02 * random(2), 2e-4 * random(3), random(4), random(5), 0.1 * random(6)];
            integrator.begin(&stretch, &state, false).unwrap();
            let bounds = integrator.bounds(&state, 0, 10.0);
            let clearance = |state: &[f64]| clearance_of(integrator.output_jet(state, 0, 0.0), 1.0, 1.0);
            let at_start = clearance(&state);
            if at_start.value <= bounds.margin {
                continue;
            }
            let free = integrator.free_for_by_slow_modes((&state, 0, 10.0), touch, at_start, bounds);
            longer += usize::from(free > free_for(at_start, bounds));
            let mut then = state.to_vec();
            for part in 1..=400 {
                integrator.blocks.fly(&state, free * f64::from(part) / 400.0, &mut then);
                assert!(clearance(&then).value > 0.0, "{seed}: {part}/400 of {free}");
            }
        }
        assert!(longer > 50, "{longer}");
        let near = [1.0 - 1e-9, 0.0, 0.0, 1.0, 1.0, 1.0];
        let at = clearance_of(integrator.output_jet(&near, 0, 0.0), 1.0, 1.0);
        let bounds = integrator.bounds(&near, 0, 10.0);
        assert_eq!(integrator.free_for_by_slow_modes((&near, 0, 10.0), touch, at, bounds), 0.0);
    }
}
