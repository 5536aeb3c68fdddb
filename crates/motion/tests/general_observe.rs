//! Maxima and contacts by the general integrator: closed forms, and the maxima of the exact one.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{element, paper_beam, rigid, settled};
use crate::general_common::{assert_near, diagonal, harmonic_force, model, supported};
use hammerbeam_motion::{
    Harmonic, Law, Load, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, Observed, observe},
    law::{HertzStop, LinearStop, PowerSpring, TwoSidedStop},
};

fn watch(system: &System, stretch: &Stretch, state: &[f64], response: (&[f64], &[f64])) -> Observed {
    observe(system, stretch, state, response, &GeneralSettings::with_tolerance(1e-12)).unwrap()
}

/// 1 kg at 0.05 m/s: `p = v / sqrt(k)` and `(5/4 v^2 / k)^(2/5)`, the impulse is `2 v`, and it flies on for
/// the rest of the time.
#[test]
fn a_bounce_has_the_force_and_impulse_of_its_speed() {
    let (speed, gap, stiffness) = (0.05, 1e-2, 1e6);
    let linear = Law::Linear(LinearStop::with_gap(stiffness, gap).unwrap());
    let hertz = Law::Hertz(HertzStop::with_gap(stiffness, gap).unwrap());
    let depths = [speed / f64::sqrt(stiffness), (1.25 * speed * speed / stiffness).powf(0.4)];
    for (law, depth, exponent) in [(linear, depths[0], 1.0), (hertz, depths[1], 1.5)] {
        let rigid = model(&[0.0], diagonal(&[0.0]));
        let system = System::new(rigid, &Load::default(), vec![element(&[1.0], 0.0, law)]).unwrap();
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 0.3 };
        let found = watch(&system, &stretch, &[0.0, speed], (&[1.0], &[0.0]));
        let force = stiffness * depth.powf(exponent);
        assert_near(found.contact_force, force, 1e-9 * force, "force");
        assert_near(found.acceleration, force, 1e-9 * force, "acceleration");
        assert_near(found.displacement, gap + depth, 1e-12, "displacement");
        assert_near(found.impulse, 2.0 * speed, 1e-9, "impulse");
        assert_near(found.impact_velocity, speed, 1e-12, "speed");
        assert_eq!((found.touches.len(), found.closed_throughout), (1, 0));
        assert_eq!((found.extrema.len(), found.kinks.len()), (1, 0));
        assert_near(found.extrema[0], depth, 1e-9 * depth, "penetration");
    }
}

/// A mass that nothing drives on a moving support: its point moves with the support, `u = A cos`, and a stop
/// in space that stays open.
#[test]
fn a_response_takes_its_part_of_the_support() {
    let resting = supported(model(&[TAU], diagonal(&[0.0])), &[0.0], &[0.0]);
    let support = vec![Harmonic { order: 2, amplitude: 3e-3, phase: 0.3 }.into()];
    let stop = element(&[1.0], 1.0, Law::Linear(LinearStop::with_gap(1e3, 5e-3).unwrap()));
    let system = System::new(resting, &Load { support, ..Load::default() }, vec![stop]).unwrap();
    let stretch = Stretch { frequency_hz: 2.0, start: 0.0, end: 1.0 };
    let found = watch(&system, &stretch, &[0.0, 0.0], (&[1.0], &[0.5]));
    assert_near(found.displacement, 1.5e-3, 1e-12, "displacement");
    assert_near(found.acceleration, 1.5e-3 * (4.0 * TAU).powi(2), 1e-9, "acceleration");
    assert_eq!((found.touches.len(), found.contact_force, found.impulse), (0, 0.0, 0.0));
    // Twice in a period nearest to the stop, twice farthest from it.
    let nearest = found.extrema.iter().filter(|extremum| (*extremum + 2e-3).abs() < 1e-12).count();
    let farthest = found.extrema.iter().filter(|extremum| (*extremum + 8e-3).abs() < 1e-12).count();
    assert_eq!((nearest, farthest), (2, 2), "{:?}", found.extrema);
}

/// A stop that never opens counts as one contact, and its impulse is its mean force times the time: that of
/// the preload and the load.
#[test]
fn a_stop_under_heavy_preload_is_closed_throughout() {
    let stop = element(&[1.0], 0.0, Law::Linear(LinearStop::with_preload(300.0, 50.0).unwrap()));
    let load = Load { support: vec![], forces: vec![harmonic_force(&[1.0], 0, 50.0, 0.0)] };
    let system = System::new(model(&[10.0], diagonal(&[0.0])), &load, vec![stop]).unwrap();
    // `q = 0.02 cos 20 t` about the balance of preload and load.
    let stretch = Stretch { frequency_hz: 20.0 / TAU, start: 0.0, end: 3.0 };
    let found = watch(&system, &stretch, &[0.02, 0.0], (&[1.0], &[0.0]));
    assert_eq!((found.touches.len(), found.closed_throughout), (0, 1));
    assert_near(found.contact_force, 56.0, 1e-9, "force");
    assert_near(found.impulse, 50.0 * stretch.duration(), 1e-8, "impulse");
}

/// Backlash without a gap: one side opens in the instant in which the other one closes. Neither is closed
/// throughout, though the element always is: in two periods four sides close.
#[test]
fn an_element_that_goes_over_from_side_to_side_has_a_contact_for_each_closing() {
    let stop = element(&[1.0], 0.0, Law::TwoSided(TwoSidedStop::new(300.0, 0.0, 0.0).unwrap()));
    let system = System::new(model(&[10.0], diagonal(&[0.0])), &Load::default(), vec![stop]).unwrap();
    // `q'' + 400 q = 0`.
    let stretch = Stretch { frequency_hz: 20.0 / TAU, start: 0.0, end: 2.0 };
    let found = watch(&system, &stretch, &[0.02, 0.0], (&[1.0], &[0.0]));
    assert_eq!((found.touches.len(), found.closed_throughout, found.contacts()), (4, 0, 4));
    let settings = ExactSettings { tolerance: 1e-12 };
    let mut exact = ExactIntegrator::watching(system, settings, Some((&[1.0], &[0.0]))).unwrap();
    let maxima = exact.observe(&[(stretch, &[0.02, 0.0])]).unwrap();
    assert_eq!((maxima.touches, maxima.closed_throughout, maxima.contacts()), (4, 0, 4));
    assert_eq!(exact.closed_throughout(), 0);
}

/// `q'' + q + q^3 = 0` at the speed v through the middle: `q^2 = sqrt(1 + 2 v^2) - 1` at the top, and `q +
/// q^3` is its acceleration.
#[test]
fn the_top_of_a_cubic_spring_is_that_of_its_energy() {
    let spring = Law::Power(PowerSpring::cubic(1.0).unwrap());
    let stiffening = model(&[1.0], diagonal(&[0.0]));
    let system = System::new(stiffening, &Load::default(), vec![element(&[1.0], 0.0, spring)]).unwrap();
    for speed in [0.3_f64, 1.0, 3.0] {
        let stretch = Stretch { frequency_hz: 0.1, start: 0.0, end: 1.0 };
        let found = watch(&system, &stretch, &[0.0, speed], (&[1.0], &[0.0]));
        let top = ((1.0 + 2.0 * speed * speed).sqrt() - 1.0).sqrt();
        assert_near(found.displacement, top, 1e-11 * top, "displacement");
        assert_near(found.acceleration, top + top.powi(3), 1e-11 * (top + top.powi(3)), "acceleration");
        assert_eq!((found.touches.len(), found.contact_force, found.impulse), (0, 0.0, 0.0));
    }
}

/// Displacement, velocity and impulse to rounding of the tolerance; forces of the exact one are read off
/// polynomials.
#[test]
fn maxima_of_the_beam_are_those_of_the_exact_integrator() {
    let system = paper_beam();
    let shape = &system.model().points[0].shape.clone();
    let settings = ExactSettings { tolerance: 1e-12 };
    let mut exact = ExactIntegrator::watching(system.clone(), settings, Some((shape, &[1.0]))).unwrap();
    for frequency_hz in [22.0, 36.0, 53.0, 75.0] {
        let state = settled(&system, frequency_hz, 150, 0.0);
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        let found = watch(&system, &stretch, &state, (shape, &[1.0]));
        let expected = exact.observe(&[(stretch, &state)]).unwrap();
        let near = |found: f64, expected: f64, bound: f64, what: &str| {
            assert_near(found / expected, 1.0, bound, &format!("{what} at {frequency_hz} Hz"));
        };
        near(found.displacement, expected.displacement, 1e-9, "displacement");
        near(found.impact_velocity, expected.impact_velocity, 1e-9, "speed");
        near(found.impulse, expected.impulse, 1e-8, "impulse");
        near(found.acceleration, expected.acceleration, 1e-5, "acceleration");
        near(found.contact_force, expected.contact_force, 1e-5, "force");
        assert_eq!(found.touches.len(), expected.touches as usize);
    }
}

/// Maxima of both integrators from the same states, over motions with one, several and many contacts of all
/// kinds of laws. What the integrators' final states differ by, their maxima may differ by too.
#[test]
fn maxima_of_both_integrators_agree_to_1e_9_with_few_and_many_contacts() {
    let mut touches = Vec::new();
    for (amplitude, law) in [
        (5.0, Law::Linear(LinearStop::with_gap(2e3, 0.01).unwrap())),
        (50.0, Law::Linear(LinearStop::with_gap(2e5, 0.01).unwrap())),
        (50.0, Law::Hertz(HertzStop::with_gap(1e6, 0.01).unwrap())),
        (5.0, Law::Linear(LinearStop::with_preload(300.0, 3.0).unwrap())),
        (0.5, Law::Power(PowerSpring::cubic(1e5).unwrap())),
    ] {
        let load = Load { support: vec![], forces: vec![harmonic_force(&[1.0, 0.4], 1, amplitude, 0.0)] };
        let structure = model(&[10.0, 47.0], diagonal(&[0.4, 2.0]));
        let system = System::new(structure, &load, vec![element(&[1.0, 0.7], 0.0, law)]).unwrap();
        for periods in [1.0, 8.0] {
            let stretch = Stretch { frequency_hz: 1.3, start: 0.0, end: periods };
            let (state, response) = ([0.003, -0.001, 0.1, 0.02], ([1.0, -0.5].as_slice(), [0.0].as_slice()));
            let settings = ExactSettings { tolerance: 1e-12 };
            let mut exact = ExactIntegrator::watching(system.clone(), settings, Some(response)).unwrap();
            let found = exact.observe(&[(stretch, &state)]).unwrap();
            let end = exact.advance(&stretch, &state).unwrap();
            let general = watch(&system, &stretch, &state, response);
            assert_eq!(found.touches as usize, general.touches.len());
            touches.push(found.touches);
            let largest = |state: &[f64]| state.iter().fold(0.0_f64, |largest, z| largest.max(z.abs()));
            let apart: Vec<f64> = end.iter().zip(&general.flow.state).map(|(a, b)| a - b).collect();
            let drift = largest(&apart) / largest(&end);
            let near = |a: f64, b: f64, what: &str| assert_near(a, b, (1e-9 + 10.0 * drift) * b.abs(), what);
            near(found.displacement, general.displacement, "displacement");
            near(found.acceleration, general.acceleration, "acceleration");
            near(found.contact_force, general.contact_force, "force");
            near(found.impact_velocity, general.impact_velocity, "speed");
        }
    }
    assert!(
        touches.contains(&1)
            && touches.iter().any(|&t| (2..8).contains(&t))
            && touches.iter().any(|&t| t > 20),
        "{touches:?}"
    );
}

/// A mass of 1 kg flies at 2 m/s from 0 to a rigid stop at 1 m and back; a second one stands still at 0.3 m.
/// The stop between them closes beyond 0.75 m: it comes as near as `(1 - 0.3) - 0.75 = -0.05 m`, with a
/// velocity that jumps.
#[test]
fn an_impact_elsewhere_turns_a_contact_with_a_kink() {
    let free = model(&[0.0, 0.0], diagonal(&[0.0, 0.0]));
    let between = |gap: f64| element(&[1.0, -1.0], 0.0, Law::Linear(LinearStop::with_gap(1e3, gap).unwrap()));
    let stops = vec![element(&[1.0, 0.0], 0.0, rigid(1.0, 1.0)), between(0.75)];
    let system = System::new(free, &Load::default(), stops).unwrap();
    let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 0.8 };
    let found = watch(&system, &stretch, &[0.0, 0.3, 2.0, 0.0], (&[1.0, 0.0], &[]));
    assert_eq!((found.touches.len(), found.kinks.len()), (0, 1), "{:?}", found.kinks);
    assert_eq!(found.kinks[0].0, 1);
    assert_near(found.kinks[0].1, -0.05, 1e-12, "penetration");
}
