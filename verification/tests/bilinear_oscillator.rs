//! The bilinear oscillator: a mass on a spring, and on a stiffer one beyond its rest position.
//!
//! Free, it spends `pi/w1` on one side and `pi/w2` on the other, so its frequency is `w0 = 2 w1 w2/(w1 + w2)`
//! at every amplitude (Shaw and Holmes, J. Sound Vib. 90 (1983), 129-155, section 2; Thompson and Stewart,
//! *Nonlinear Dynamics and Chaos* (1986), chapter 15).
//!
//! The equation `m x'' + c x' + k(x) x = F cos W t` is homogeneous: the response is proportional to F, and
//! the place of the resonance depends on the damping alone.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::{PI, SQRT_2, TAU};

use crate::common::{ObservedSystem, element_at, force_at, response_of, single_mass};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use hammerbeam_motion::{
    Law, Load, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    law::LinearStop,
};
use hammerbeam_orbit::{BranchWalk, OrbitSettings, PeriodicSolution, Side, find_start, free_orbit};

/// Unit mass on `soft` N/m, `stiff` N/m where x > 0, with the damper and the force `amplitude cos W t`.
fn oscillator(soft: f64, stiff: f64, damper: f64, amplitude: f64) -> ObservedSystem {
    let model = single_mass(1.0, soft, damper, false);
    let forces = if amplitude == 0.0 { vec![] } else { vec![force_at(&model, "mass", 1, amplitude)] };
    let stop = element_at(&model, "mass", Law::Linear(LinearStop::with_gap(stiff - soft, 0.0).unwrap()));
    let response = response_of(&model, "mass");
    ObservedSystem {
        system: System::new(model, &Load { support: vec![], forces }, vec![stop]).unwrap(),
        response,
    }
}

fn bilinear_frequency(soft: f64, stiff: f64) -> f64 {
    2.0 * (soft * stiff).sqrt() / (soft.sqrt() + stiff.sqrt())
}

/// Circular frequency of the free motion of an amplitude.
fn free_frequency(soft: f64, stiff: f64, amplitude: f64) -> f64 {
    let rig = oscillator(soft, stiff, 0.0, 0.0);
    TAU * free_orbit(&rig.system, &rig.response, amplitude, &OrbitSettings::default()).unwrap().frequency_hz
}

/// Unit mass on 1 N/m one way and 2 N/m the other: T = pi + pi/sqrt 2 s, so w = 2 sqrt 2/(1 + sqrt 2) =
/// 1.1716 rad/s.
#[test]
fn bilinear_oscillator_frequency_is_1_1716_at_stiffness_ratio_2() {
    let found = free_frequency(1.0, 2.0, 1e-2);
    assert_abs_diff_eq!(found, 1.1716, epsilon = 0.00005); // Digits printed.
    // Tolerance of the integrator.
    assert_relative_eq!(found, 2.0 * SQRT_2 / (1.0 + SQRT_2), max_relative = 1e-8);
}

#[test]
fn free_frequency_is_2_w1_w2_over_w1_plus_w2_at_any_ratio_and_amplitude() {
    for stiff in [1.01, 4.0, 100.0, 1e4] {
        for amplitude in [1e-6, 1e-2, -3.0] {
            let found = free_frequency(1.0, stiff, amplitude);
            assert_relative_eq!(found, bilinear_frequency(1.0, stiff), max_relative = 1e-8);
        }
    }
}

#[test]
fn each_side_takes_half_a_period_of_its_own_frequency() {
    let rig = oscillator(1.0, 9.0, 0.0, 0.0);
    let mut exact = ExactIntegrator::new(rig.system, ExactSettings::default()).unwrap();
    for (speed, duration) in [(1.0, PI / 3.0), (-1.0, PI)] {
        let stretch = Stretch { frequency_hz: 1.0 / duration, start: 0.0, end: 1.0 };
        let end = exact.advance(&stretch, &[0.0, speed]).unwrap();
        assert_abs_diff_eq!(end[0], 0.0, epsilon = 1e-10);
        assert_abs_diff_eq!(end[1], -speed, epsilon = 1e-10);
    }
}

/// The orbit at another frequency, close to a known one.
fn moved(rig: &ObservedSystem, near: &PeriodicSolution, frequency_hz: f64) -> PeriodicSolution {
    let guess = PeriodicSolution { frequency_hz, ..near.clone() };
    let range = (0.5 * frequency_hz, 2.0 * frequency_hz);
    let settings = OrbitSettings::default();
    let mut walk = BranchWalk::new(&rig.system, &rig.response, &guess, Side::Up, range, &settings).unwrap();
    walk.start_row().unwrap().solution
}

/// Circular frequency of the largest displacement, by parabolas through three orbits, closer and closer.
fn resonance(ratio: f64) -> f64 {
    let rig = oscillator(1.0, 2.0, 2.0 * ratio, 1.0);
    let mut top = bilinear_frequency(1.0, 2.0) / TAU;
    let mut orbit = find_start(&rig.system, &rig.response, top, 1, &OrbitSettings::default()).unwrap();
    for spacing in [0.2, 0.1, 0.02, 0.005, 0.005] {
        let step = spacing * ratio * top;
        let height = |hz: f64| moved(&rig, &orbit, hz).maxima.displacement;
        let (before, at, after) = (height(top - step), height(top), height(top + step));
        top += (0.5 * step * (after - before) / (2.0 * at - before - after)).clamp(-2.0 * step, 2.0 * step);
        orbit = moved(&rig, &orbit, top);
        assert!(orbit.stable() && orbit.maxima.contacts == 1);
    }
    TAU * top
}

/// The forced resonance lies at `w0 (1 + O(z^2))`, as that of a linear oscillator does at `w sqrt(1 - 2
/// z^2)`.
#[test]
fn forced_resonance_tends_to_the_free_frequency_with_the_square_of_the_damping() {
    let ratios = [0.02, 0.01, 0.005, 0.0025];
    let deviation = |ratio: f64| resonance(ratio) / bilinear_frequency(1.0, 2.0) - 1.0;
    let deviations = ratios.map(deviation);
    for pair in deviations.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert_abs_diff_eq!(order, 2.0, epsilon = 0.05);
    }
    let coefficient = deviations[3] / ratios[3].powi(2);
    assert!(coefficient.abs() < 3.0, "{coefficient}");
}
