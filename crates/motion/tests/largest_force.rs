//! Largest forces and accelerations where the law depends on the velocity, against the general integrator.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{diagonal, element, force, model, settled};
use hammerbeam_motion::{
    Law, Load, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, observe},
    law::{HertzStop, HuntCrossleyStop},
};

/// A mass that is pressed against a stop which takes almost all that an impact has: its force hangs on the
/// velocity more than on the depth, and the polynomials of the steps are least accurate there. Where the
/// steps lie depends on where the motion is begun.
#[test]
fn forces_that_hang_on_the_velocity_are_as_large_wherever_the_steps_lie() {
    let omega = 5564.1_f64.sqrt();
    let hertz = HertzStop::with_preload(3.9506e5, 3.7033).unwrap();
    let law = Law::HuntCrossley(HuntCrossleyStop::new(hertz, 54.22).unwrap());
    let load = Load { forces: vec![force(&[1.0], 1, 1.472, 0.0)], ..Load::default() };
    let structure = model(&[omega], diagonal(&[2.0 * 0.002 * omega]));
    let system = System::new(structure, &load, vec![element(&[1.0], 0.0, law)]).unwrap();
    let frequency_hz = 11.795_955_642_829_874;
    // From a cycle that is settled to rounding, which multipliers of 0.01 make of one of the usual accuracy.
    let closely = ExactSettings { tolerance: 1e-13 };
    let mut closely = ExactIntegrator::new(system.clone(), closely).unwrap();
    let mut begun = settled(&system, frequency_hz, 200, 0.0);
    let cycle = |start: f64| Stretch { frequency_hz, start, end: 1.0 + start };
    for _ in 0..8 {
        begun = closely.advance(&cycle(0.0), &begun).unwrap();
    }
    let general = GeneralSettings::with_tolerance(1e-13);
    let expected = observe(&system, &cycle(0.0), &begun, (&[1.0], &[0.0]), &general).unwrap();
    // As accurate as the steps of a run are.
    let settings = ExactSettings { tolerance: 5e-12 };
    let mut exact = ExactIntegrator::watching(system, settings, Some((&[1.0], &[0.0]))).unwrap();
    for start in [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9] {
        let state = closely.advance(&Stretch { frequency_hz, start: 0.0, end: start }, &begun).unwrap();
        let found = exact.observe(&[(cycle(start), &state)]).unwrap();
        let of_force = found.contact_force / expected.contact_force - 1.0;
        let of_acceleration = found.acceleration / expected.acceleration - 1.0;
        assert!(of_force.abs() < 1e-9, "force from {start}: {of_force:e}");
        assert!(of_acceleration.abs() < 1e-8, "acceleration from {start}: {of_acceleration:e}");
    }
}
