//! The general integrator against that of another library (order eight too, but its own code and norms).
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use std::f64::consts::TAU;

use crate::general_common::{column_error, diagonal, harmonic_force, model, supported};
use differential_equations::prelude::*;
use hammerbeam_motion::{
    Harmonic, Law, Load, LocalElement, Stretch, System,
    general::{GeneralSettings, advance},
    law::{HertzStop, LinearStop, PowerSpring},
};

const WAVES: [f64; 2] = [TAU * 3.0, TAU * 14.0];
const DAMPING: [f64; 2] = [0.8, 4.0];
const SHAPE: [f64; 2] = [1.2, -0.9];
const INERTIA: [f64; 2] = [0.7, 0.3];
const AMPLITUDE: f64 = 2e-3;
const FORCE: [f64; 2] = [0.4, 0.1];

/// The same equations, written down by hand in time.
struct ByHand {
    frequency: f64,
    law: Law,
}

impl ODE<f64, [f64; 4]> for ByHand {
    fn diff(&self, time: f64, state: &[f64; 4], derivative: &mut [f64; 4]) {
        let w = TAU * self.frequency;
        let shaking = w * w * AMPLITUDE * (w * time).cos();
        let load = (2.0 * w * time + 0.5).cos();
        let local = self.law.force(SHAPE[0] * state[0] + SHAPE[1] * state[1], 0.0).value;
        for i in 0..2 {
            derivative[i] = state[2 + i];
            derivative[2 + i] = INERTIA[i] * shaking + FORCE[i] * load + SHAPE[i] * local
                - DAMPING[i] * state[2 + i]
                - WAVES[i] * WAVES[i] * state[i];
        }
    }
}

fn system(law: Law) -> System {
    let model = supported(model(&WAVES, diagonal(&DAMPING)), &INERTIA, &[0.0, 0.0]);
    let support = vec![Harmonic { order: 1, amplitude: AMPLITUDE, phase: 0.0 }.into()];
    let element = LocalElement { name: "stop".into(), shape: SHAPE.to_vec(), support_ratios: vec![0.0], law };
    let load = Load { support, forces: vec![harmonic_force(&FORCE, 2, 1.0, 0.5)] };
    System::new(model, &load, vec![element]).expect("lengths agree")
}

#[test]
fn states_agree_with_another_integrator() {
    for law in [
        Law::Power(PowerSpring::cubic(1e6).unwrap()),
        Law::Linear(LinearStop::with_gap(2e3, 1e-3).unwrap()),
        Law::Hertz(HertzStop::with_gap(1e5, 1e-3).unwrap()),
    ] {
        let (frequency, state) = (3.3, [1e-3, -5e-4, 0.1, 0.02]);
        let by_hand = ByHand { frequency, law: law.clone() };
        let method = ExplicitRungeKutta::dop853().rtol(1e-12).atol(1e-14).max_steps(1_000_000);
        let theirs = IVP::ode(&by_hand, 0.0, 2.0 / frequency, state).method(method).solve().unwrap();
        let (_, theirs) = theirs.iter().next_back().unwrap();
        let stretch = Stretch { frequency_hz: frequency, start: 0.0, end: 2.0 };
        let ours =
            advance(&system(law.clone()), &stretch, &state, &GeneralSettings::with_tolerance(1e-12)).unwrap();
        let error = column_error(&ours.flow.state, theirs);
        assert!(error < 1e-9, "{law:?}: {error:e}, {:?}", ours.counts);
    }
}
