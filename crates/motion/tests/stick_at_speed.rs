//! Impacts without restitution on a rigid stop that holds the structure from then on, at a speed at which
//! other forces jump: a contact with losses ends or begins to press, a stop that is held is thrown off.
//!
//! The flows of both integrators against differences of their own motions.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{
    damped,
    differences::{assert_by_state, assert_sensitivities},
    element, force, hunt_crossley, integrator, model, remembering, rigid,
};
use hammerbeam_motion::{
    Law, Load, LocalElement, Parameter, Stretch, System,
    general::{GeneralSettings, advance},
    law::RestitutionModel,
};

/// Level of the rigid stop [m].
const LEVEL: f64 = 0.01;

/// Three modes that a load presses on a rigid stop without restitution along the first of them, with further
/// elements.
fn pressed(further: Vec<LocalElement>, along_second: f64) -> System {
    let load = Load {
        support: vec![],
        forces: vec![
            force(&[1.0, 0.0, 0.0], 0, 3.0, 0.0),
            force(&[0.0, 1.0, 0.0], 0, along_second, 0.0),
            force(&[0.3, 1.0, -0.7], 1, 0.5, 0.2),
        ],
    };
    let damping = faer::Mat::from_fn(3, 3, |i, j| if i == j { 1.0 + i as f64 } else { 0.4 });
    let mut elements = vec![element(&[1.0, 0.0, 0.0], 0.0, rigid(0.0, LEVEL))];
    elements.extend(further);
    System::new(model(&[5.0, 12.0, 33.0], damping), &load, elements).unwrap()
}

/// A contact with losses whose relative velocity the impact turns round.
fn beside(sign: f64, law: Law) -> LocalElement {
    LocalElement { name: "beside".into(), ..element(&[sign, 0.3, 0.2], 0.0, law) }
}

const STRETCH: Stretch = Stretch { frequency_hz: 2.0, start: 0.0, end: 0.02 };

/// Both integrators over a motion in which the first stop is hit once, and holds the structure from then on.
fn assert_differences(system: &System, state: &[f64], what: &str) {
    let mut exact = integrator(system);
    let contacts = exact.trace(&STRETCH, state, &[]).unwrap().contacts;
    let hits: Vec<_> = contacts.iter().filter(|contact| contact.element == 0).collect();
    assert!(hits.len() == 1 && hits[0].jump.is_some() && hits[0].end.is_none(), "{what}: {hits:?}");
    let parameters = [Parameter::ExcitationScale, Parameter::gap(0), Parameter::stiffness(1)];
    let count = if system.parameter(parameters[2]).is_ok() { 3 } else { 2 };
    assert_sensitivities(system, &STRETCH, state, &parameters[..count], 2e-6);
    let settings = GeneralSettings::with_tolerance(1e-12);
    let flow = advance(system, &STRETCH, state, &settings).unwrap().flow;
    let alone = settings.state_only();
    let mut moved = |state: &[f64]| advance(system, &STRETCH, state, &alone).unwrap().flow.state;
    assert_by_state(system, state, &flow.by_state, &mut moved, 2e-6);
}

/// The second rigid stop is held until the first is hit.
fn assert_let_go(system: &System, state: &[f64]) {
    let contacts = integrator(system).trace(&STRETCH, state, &[]).unwrap().contacts;
    let of = |element: usize| contacts.iter().find(|contact| contact.element == element).unwrap();
    let hit = of(0).begin.as_ref().unwrap().time;
    assert!(of(1).peak_force > 0.0 && of(1).end == Some(hit), "{contacts:?}");
}

/// The relative velocity of the contact is that of the stop before, and of the other modes after.
#[test]
fn a_contact_that_the_impact_takes_the_pressure_off() {
    for (name, law) in [
        ("linear", damped(100.0, 20.0, 0.004)),
        ("hunt-crossley", hunt_crossley(1e4, 8.0, 0.004)),
        ("memory", remembering(1e4, RestitutionModel::Flores, 0.2, 0.0088)),
    ] {
        for second in [-0.6, -1.0] {
            let system = pressed(vec![beside(1.0, law.clone())], 0.0);
            assert_differences(&system, &[0.0085, 0.0, 0.0, 0.4, second, 0.1], name);
        }
    }
}

#[test]
fn a_contact_that_the_impact_lets_press_again() {
    for (name, law) in [("linear", damped(100.0, 20.0, 0.0)), ("hunt-crossley", hunt_crossley(1e4, 8.0, 0.0))]
    {
        for second in [0.6, 1.0] {
            let system = pressed(vec![beside(-1.0, law.clone())], 0.0);
            assert_differences(&system, &[0.0085, 0.05, 0.0, 0.4, second, 0.1], name);
        }
    }
}

/// Where the pressure neither begins nor ends the forces are linear in the velocity.
#[test]
fn a_contact_that_presses_before_and_after() {
    for (name, law) in [
        ("linear", damped(100.0, 4.0, 0.004)),
        ("hunt-crossley", hunt_crossley(1e4, 0.5, 0.008)),
        ("memory", remembering(1e4, RestitutionModel::Flores, 0.6, 0.0088)),
    ] {
        let system = pressed(vec![beside(1.0, law)], 0.0);
        assert_differences(&system, &[0.0085, 0.0, 0.0, 0.4, 0.3, 0.1], name);
    }
}

/// A second rigid stop is held as the first is hit, and the impact would pull at it.
#[test]
fn a_held_stop_that_the_impact_pulls_at() {
    let second = |along: f64| LocalElement {
        name: "second".into(),
        ..element(&[along, 1.0, 0.0], 0.0, rigid(0.0, 0.0))
    };
    for along in [0.4, 0.8] {
        let system = pressed(vec![second(along)], 4.0);
        // It touches at once, and is held before the first is hit.
        let state = [0.0085, -along * 0.0085 - 1e-4, 0.0, 0.4, 0.3 - along * 0.4, 0.1];
        assert_let_go(&system, &state);
        assert_differences(&system, &state, "pulled");
    }
}

/// A second rigid stop is held as the first is hit, and pressed by a damper alone whose force ends with that.
#[test]
fn a_held_stop_that_a_jump_of_force_lets_go() {
    let second = LocalElement { name: "second".into(), ..element(&[0.0, 1.0, 0.0], 0.0, rigid(0.0, 0.0)) };
    let damper =
        LocalElement { name: "damper".into(), ..element(&[0.3, -1.0, 0.0], 0.0, damped(20.0, 60.0, 0.002)) };
    let system = pressed(vec![second, damper], -1.5);
    let state = [0.0085, -1e-4, 0.0, 0.4, 0.3, 0.1];
    assert_let_go(&system, &state);
    assert_differences(&system, &state, "let go");
}
