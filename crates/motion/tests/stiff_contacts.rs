//! Very stiff contacts: the sensitivities keep the energy as well as rounding of the displacement lets them.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::PI;

use crate::common::{diagonal, element, force, hertz, integrator, model};
use hammerbeam_motion::{Load, Stretch, System};

/// Natural circular frequency [rad/s], constant force [N], gap [m].
const W: f64 = 20.0;
const FORCE: f64 = 3.0;
const GAP: f64 = 5e-3;

/// Duration of an elastic Hertz contact of a unit mass: `2.9432 d/v` with the depth `d = (5 v^2/(4
/// k))^(2/5)`.
fn contact_time(stiffness: f64, speed: f64) -> f64 {
    2.943_275 * (1.25 * speed * speed / stiffness).powf(0.4) / speed
}

/// Without damping `E = v^2/2 + w^2 q^2/2 - F q` is the same before and after an elastic contact, and so are
/// its derivatives by the state at the start. What the impact leaves of them is of the order of one, what
/// passes within the contact is `w_c/w` times as large, and rounding of the displacement leaves `eps r w_c^2`
/// of it (`contact_phase.rs`).
#[test]
fn sensitivities_of_stiff_contacts_keep_the_energy_up_to_rounding_of_the_displacement() {
    for exponent in [9, 12, 15, 18, 21, 24] {
        let stiffness = 10_f64.powi(exponent);
        let load = Load { support: vec![], forces: vec![force(&[1.0], 0, FORCE, 0.0)] };
        let stop = element(&[1.0], 0.0, hertz(stiffness, GAP));
        let system = System::new(model(&[W], diagonal(&[0.0])), &load, vec![stop]).unwrap();
        let stretch = Stretch { frequency_hz: 10.0, start: 0.0, end: 0.3 };
        let by_energy = |state: &[f64]| [W * W * state[0] - FORCE, state[1]];
        let mut worst = 0.0_f64;
        for k in 0..20 {
            let start = [2e-3 + 1e-5 * f64::from(k), 0.25];
            let mut exact = integrator(&system);
            let flow = exact.flow(&stretch, &start).unwrap();
            assert!(exact.touches() == [1] && flow.state[0] < GAP);
            let (before, after) = (by_energy(&start), by_energy(&flow.state));
            for (j, before) in before.iter().enumerate() {
                let kept = after[0] * flow.by_state[(0, j)] + after[1] * flow.by_state[(1, j)];
                worst = worst.max((kept - before).abs() * if j == 1 { W } else { 1.0 });
            }
        }
        let rate = PI / contact_time(stiffness, 0.25);
        let rounding = f64::EPSILON * GAP * rate * rate;
        // A few roundings.
        assert!(worst < 4.0 * rounding, "{stiffness:e} N/m^1.5: {worst:e} against {rounding:e}");
    }
}
