//! Contacts of the level of a rigid stop: what a held stop keeps at penetration zero neither closes nor opens
//! by rounding, and has no force.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{diagonal, difference, element, force, model, rigid};
use hammerbeam_motion::{
    Flow, Law, Load, LocalElement, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance},
    law::{HertzStop, HuntCrossleyStop, LinearStop, RestitutionModel, RestitutionStop},
};
use hammerbeam_testkit::stride;

/// Natural circular frequency of the first mode [rad/s].
const W: f64 = TAU * 10.0;
/// Displacement of the first mode under its load at rest [kg^1/2 m].
const STATIC: f64 = 1e-3;
/// Shape of the rigid stop.
const SHAPE: [f64; 2] = [1.0, 0.6];
const START: [f64; 4] = [-0.7 * STATIC, 0.0, 0.0, 0.0];

fn two_modes(stops: Vec<LocalElement>) -> System {
    let load = vec![force(&[1.0, 0.3], 1, 2.0 * STATIC * W * W, 0.3)];
    let damping = diagonal(&[0.1 * W, 0.3 * W]);
    System::new(model(&[W, 3.1 * W], damping), &Load { support: vec![], forces: load }, stops).unwrap()
}

fn laws() -> Vec<Law> {
    let spring = LinearStop::with_gap(300.0 * W * W, 0.0).unwrap();
    let elastic = HertzStop::with_gap(300.0 * W * W / STATIC.sqrt(), 0.0).unwrap();
    let remembers = [RestitutionModel::LankaraniNikravesh, RestitutionModel::Flores, RestitutionModel::HuGuo];
    let remembers = remembers.map(|model| RestitutionStop::new(elastic, model, 0.1).unwrap());
    let mut laws = vec![
        Law::Linear(spring),
        Law::Linear(spring.with_damping(5.0 * W).unwrap()),
        Law::Hertz(elastic),
        Law::HuntCrossley(HuntCrossleyStop::new(elastic, 20.0).unwrap()),
        rigid(0.3, 0.0),
    ];
    laws.extend(remembers.map(Law::Restitution));
    laws
}

fn flow(system: &System, frequency_hz: f64) -> Flow {
    let stretch = Stretch { frequency_hz, start: 0.0, end: 3.0 };
    advance(system, &stretch, &START, &GeneralSettings::with_tolerance(1e-12)).unwrap().flow
}

/// A rigid stop is not passed, so that another contact of its place is never penetrated: the motion is that
/// with the rigid stop alone, whatever law the other has. The mass rests on the stop for a part of each
/// cycle, at the end of a chatter or at once, and leaves it. By default at half of four frequencies.
#[test]
fn a_contact_at_the_place_of_a_rigid_stop_does_nothing() {
    for restitution in [0.0, 0.3] {
        let stop = || element(&SHAPE, 0.0, rigid(restitution, 0.0));
        let alone = two_modes(vec![stop()]);
        let all = [2.3, 3.1, 4.7, 6.2];
        let frequencies: Vec<f64> = all.into_iter().step_by(stride(2)).collect();
        let expected: Vec<_> = frequencies.iter().map(|frequency_hz| flow(&alone, *frequency_hz)).collect();
        let harder = |law: &Law| law.rigid().is_some_and(|law| law.restitution() > restitution);
        for law in laws().into_iter().filter(|law| !harder(law)) {
            let other = || element(&SHAPE.map(|entry| 0.7 * entry), 0.0, law.clone());
            for stops in [vec![other(), stop()], vec![stop(), other()]] {
                let system = two_modes(stops);
                for (&frequency_hz, expected) in frequencies.iter().zip(&expected) {
                    let stretch = Stretch { frequency_hz, start: 0.0, end: 3.0 };
                    let error = difference(&system, &stretch, &flow(&system, frequency_hz), expected);
                    assert!(error.largest() < 1e-9, "{law:?}, {restitution}, {frequency_hz} Hz: {error:?}");
                }
            }
        }
    }
}

/// Two points on rigid stops, and a contact between them: it rests as long as both are held, and where one
/// leaves, it closes with that or opens. Both integrators agree.
#[test]
fn a_contact_between_two_held_points_goes_with_the_first_that_leaves() {
    let (one, two) = (SHAPE, [0.8, -0.9]);
    let between = [one[0] - two[0], one[1] - two[1]];
    let elastic = laws().into_iter().filter(|law| law.rigid().is_none() && !law.remembers_impact());
    for law in elastic {
        let ends = [one, two].map(|shape| element(&shape, 0.0, rigid(0.0, 0.0)));
        let system = two_modes(ends.into_iter().chain([element(&between, 0.0, law.clone())]).collect());
        for frequency_hz in [1.3, 2.3, 3.1] {
            let stretch = Stretch { frequency_hz, start: 0.0, end: 2.0 };
            let mut exact = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: 1e-12 }).unwrap();
            let found = exact.advance(&stretch, &START).unwrap();
            let settings = GeneralSettings::with_tolerance(1e-12).state_only();
            let state = advance(&system, &stretch, &START, &settings).unwrap().flow.state;
            for (i, (found, expected)) in found.iter().zip(&state).enumerate() {
                let size = if i < 2 { STATIC } else { W * STATIC };
                assert!(
                    (found - expected).abs() < 1e-8 * size,
                    "{law:?}, {frequency_hz} Hz: {found:e}, {expected:e}"
                );
            }
        }
    }
}

/// Without penetration nothing presses: a mass that a constant load holds against both stops stays where it
/// is, and the rigid one carries all of the load. By default beside every other law.
#[test]
fn a_mass_at_rest_on_both_stops_stays() {
    for law in laws().into_iter().step_by(stride(2)) {
        let load = Load { support: vec![], forces: vec![force(&[1.0, 0.3], 0, STATIC * W * W, 0.0)] };
        let stops = vec![element(&[1.0, 0.0], 0.0, law.clone()), element(&[1.0, 0.0], 0.0, rigid(0.0, 0.0))];
        let system = System::new(model(&[W, 3.1 * W], diagonal(&[0.1 * W; 2])), &load, stops).unwrap();
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 20.0 };
        let settings = GeneralSettings::with_tolerance(1e-11);
        let state = advance(&system, &stretch, &START, &settings).unwrap().flow.state;
        let second = 0.3 * STATIC / 3.1_f64.powi(2);
        assert!(state[0].abs() < 1e-15 && state[2].abs() < 1e-13, "{law:?}: {state:?}");
        assert!((state[1] - second).abs() < 1e-9 * STATIC, "{law:?}: {state:?}");
    }
}

/// A slow mass meets both stops while the load still pulls at it a little, so that a stop without restitution
/// does not hold it yet: what it goes back is below rounding. By default at a quarter of the frequencies.
#[test]
fn a_mass_that_meets_both_stops_just_before_it_is_pressed_on_is_held() {
    let one_mode = |stops| {
        let load = Load { support: vec![], forces: vec![force(&[1.0], 1, STATIC * W * W, 0.0)] };
        System::new(model(&[W], diagonal(&[0.1 * W])), &load, stops).unwrap()
    };
    let stop = || element(&[1.0], 0.0, rigid(0.0, 0.0));
    for law in laws().into_iter().filter(|law| law.rigid().is_none()) {
        for k in (0..24).step_by(stride(4)) {
            let stretch = Stretch { frequency_hz: 2.0 + 0.1 * f64::from(k), start: 0.5, end: 3.4 };
            let state = |stops| {
                let settings = GeneralSettings::with_tolerance(1e-12).state_only();
                advance(&one_mode(stops), &stretch, &[-STATIC, 0.0], &settings).unwrap().flow.state
            };
            let (found, expected) =
                (state(vec![element(&[1.0], 0.0, law.clone()), stop()]), state(vec![stop()]));
            for (found, expected) in found.iter().zip(&expected) {
                assert!(
                    (found - expected).abs() < 1e-9 * W * STATIC,
                    "{law:?}, {stretch:?}: {found:e}, {expected:e}"
                );
            }
        }
    }
}
