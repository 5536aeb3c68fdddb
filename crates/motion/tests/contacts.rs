//! Contacts of all kinds against closed forms and invariants: bounces, chatter, permanent and simultaneous
//! contacts, stiff and soft stops.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::{PI, TAU};

use crate::common::{assert_agreement, diagonal, element, hertz, integrator, model};
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    law::{HertzStop, LinearStop},
};

/// A mass of 1 kg on a spring, with a constant force.
fn oscillator(frequency: f64, damping: f64, force: f64, elements: Vec<LocalElement>) -> System {
    let constant =
        HarmonicForce { shape: vec![1.0], harmonic: Harmonic { order: 0, amplitude: force, phase: 0.0 } };
    let load = Load { support: vec![], forces: vec![constant] };
    System::new(model(&[frequency], diagonal(&[damping])), &load, elements).unwrap()
}

fn linear(stiffness: f64, gap: f64) -> LocalElement {
    element(&[1.0], 0.0, Law::Linear(LinearStop::with_gap(stiffness, gap).unwrap()))
}

fn assert_close(found: &[f64], expected: &[f64], bound: f64, what: &str) {
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= bound, "{what}: {found:e} against {expected:e}");
    }
}

/// Unit mass on 1 N/m one way and 2 N/m the other: `T = pi + pi / sqrt(2)`; the flow over a period is the
/// identity.
#[test]
fn the_bilinear_oscillator_returns_after_its_period() {
    let system = oscillator(1.0, 0.0, 0.0, vec![linear(1.0, 0.0)]);
    let stretch = Stretch { frequency_hz: 1.0 / (PI + PI / 2.0_f64.sqrt()), start: 0.0, end: 1.0 };
    for start in [[-0.3, 0.4], [0.3, 0.4], [0.2, -0.7]] {
        let mut exact = integrator(&system);
        let flow = exact.flow(&stretch, &start).unwrap();
        assert_close(&flow.state, &start, 1e-13, "state");
        for i in 0..2 {
            for j in 0..2 {
                assert_close(&[flow.by_state[(i, j)]], &[f64::from(u8::from(i == j))], 1e-12, "monodromy");
            }
        }
    }
}

/// A mass falls on a linear stop: `q = h - g t^2/2`, then `-x'' = g - k x/m` with `x = -q`, and up again.
///
/// With `w = sqrt(k)`, the depth swings about the static one `g/k` with amplitude `sqrt((g/k)^2 + (v/w)^2)`;
/// contact lasts `(2 pi - 2 atan(v w / g)) / w`.
#[test]
fn a_mass_bounces_under_gravity_as_in_closed_form() {
    let (gravity, height, stiffness) = (9.81, 0.05_f64, 1e5_f64);
    let system = oscillator(0.0, 0.0, gravity, vec![linear(stiffness, height)]);
    let (fall, speed, w) =
        ((2.0 * height / gravity).sqrt(), (2.0 * gravity * height).sqrt(), stiffness.sqrt());
    let contact = (TAU - 2.0 * (speed * w / gravity).atan()) / w;
    let period = 2.0 * fall + contact;
    for bounces in [1, 2, 7] {
        let stretch = Stretch { frequency_hz: 1.0 / period, start: 0.0, end: f64::from(bounces) };
        let mut exact = integrator(&system);
        let flow = exact.flow(&stretch, &[0.0, 0.0]).unwrap();
        assert_close(&flow.state, &[0.0, 0.0], 1e-11, "state");
        assert_eq!(exact.touches(), &[bounces as u32]);
    }
    let half = Stretch { frequency_hz: 1.0 / period, start: 0.0, end: 0.5 };
    let deepest = integrator(&system).advance(&half, &[0.0, 0.0]).unwrap();
    let expected = height + gravity / stiffness + (gravity / stiffness).hypot(speed / w);
    assert_close(&deepest, &[expected, 0.0], 1e-11, "deepest point");
}

/// `v^2/2 + w^2 q^2/2 + 2/5 k p^2.5` through many bounces on Hertz stops from very soft to very stiff.
#[test]
fn energy_is_kept_through_bounces_on_stiff_and_soft_hertz_stops() {
    for stiffness in [1e1, 1e4, 1e7, 1e10, 1e13] {
        let system = oscillator(10.0, 0.0, 0.0, vec![element(&[1.0], 0.0, hertz(stiffness, 1e-3))]);
        let energy = |state: &[f64]| {
            let penetration = (state[0] - 1e-3).max(0.0);
            0.5 * state[1].powi(2) + 50.0 * state[0].powi(2) + 0.4 * stiffness * penetration.powf(2.5)
        };
        let mut exact = integrator(&system);
        let mut state = vec![0.0, 0.5];
        for piece in 0..200 {
            let phase = |piece: i32| f64::from(piece) * 0.0137;
            let stretch = Stretch { frequency_hz: 1.0, start: phase(piece), end: phase(piece + 1) };
            state = exact.advance(&stretch, &state).unwrap();
            assert_close(
                &[energy(&state) / 0.125],
                &[1.0],
                1e-10,
                &format!("stiffness {stiffness:e}, energy after piece {piece}, {:?}", exact.counts()),
            );
        }
    }
}

/// A stop that never opens is a spring: `w^2 + k`, about the static displacement.
#[test]
fn a_contact_that_stays_closed_is_a_spring() {
    let (frequency, stiffness, gravity) = (15.0_f64, 400.0, 9.81);
    let system = oscillator(frequency, 1.0, gravity, vec![linear(stiffness, 0.0)]);
    let stiffened = oscillator((frequency * frequency + stiffness).sqrt(), 1.0, gravity, vec![]);
    let stretch = Stretch { frequency_hz: 2.0, start: 0.0, end: 3.0 };
    let start = [gravity / 625.0 + 5e-3, 0.05];
    let (mut exact, mut spring) = (integrator(&system), integrator(&stiffened));
    let (found, expected) = (exact.flow(&stretch, &start).unwrap(), spring.flow(&stretch, &start).unwrap());
    assert_close(&found.state, &expected.state, 1e-13, "state");
    for i in 0..2 {
        for j in 0..2 {
            assert_close(&[found.by_state[(i, j)]], &[expected.by_state[(i, j)]], 1e-12, "sensitivities");
        }
    }
    assert_eq!(exact.touches(), &[0]);
}

/// A shaken beam that is pressed on its stop never leaves it; the contact outlasts the period of the
/// excitation.
#[test]
fn permanent_contact_under_preload_agrees_with_the_general_integrator() {
    for preload in [20.0, 200.0] {
        let law = Law::Hertz(HertzStop::with_preload(1e8, preload).unwrap());
        let system = crate::common::beam_with(0.015, law);
        let state = crate::common::settled(&system, 60.0, 40, 0.0);
        let stretch = Stretch { frequency_hz: 60.0, start: 0.0, end: 1.5 };
        assert_agreement(&system, &stretch, &state, 1e-9, &format!("preload {preload}"));
    }
}

/// A soft stop and a strong constant force: the mass comes to rest on the stop through ever smaller bounces.
#[test]
fn a_damped_mass_comes_to_rest_on_a_stop() {
    for law in [hertz(1e6, 1e-3), Law::Linear(LinearStop::with_gap(1e5, 1e-3).unwrap())] {
        let system = oscillator(0.0, 3.0, 9.81, vec![element(&[1.0], 0.0, law.clone())]);
        let mut exact = integrator(&system);
        let mut state = vec![0.0, 0.0];
        for second in 0..60 {
            let second = f64::from(second);
            state = exact
                .advance(&Stretch { frequency_hz: 1.0, start: second, end: second + 1.0 }, &state)
                .unwrap();
        }
        // The load alone would drive the mass at some metres per second: that is the scale of the errors.
        assert!(
            (law.force(state[0], state[1]).value + 9.81).abs() < 1e-6 && state[1].abs() < 1e-8,
            "{law:?}: {state:?}"
        );
        assert!(exact.counts().steps < 30_000, "{:?}", exact.counts());
    }
}

/// Two modes that move two stops alike: both close and open at the same instants, up to rounding.
#[test]
fn symmetric_contacts_on_two_stops_keep_the_symmetry() {
    let structure = model(&[30.0, 200.0], diagonal(&[0.5, 2.0]));
    let push =
        HarmonicForce { shape: vec![1.0, 0.0], harmonic: Harmonic { order: 1, amplitude: 2.0, phase: 0.0 } };
    let load = Load { support: vec![], forces: vec![push] };
    // The second mode rocks: a symmetric motion does not excite it.
    let stops =
        vec![element(&[1.0, 0.7], 0.0, hertz(1e7, 1e-4)), element(&[1.0, -0.7], 0.0, hertz(1e7, 1e-4))];
    let system = System::new(structure, &load, stops).unwrap();
    let mut exact = integrator(&system);
    let mut state = vec![0.0, 0.0, 0.1, 0.0];
    let mut touches = [0, 0];
    for cycle in 0..20 {
        let cycle = f64::from(cycle);
        let stretch = Stretch { frequency_hz: 4.0, start: cycle, end: cycle + 1.0 };
        state = exact.advance(&stretch, &state).unwrap();
        (0..2).for_each(|e| touches[e] += exact.touches()[e]);
        assert!(state[1].abs() < 1e-12 && state[3].abs() < 1e-9, "{state:?}");
    }
    assert!(touches[0] > 10 && touches[0] == touches[1], "{touches:?}");
}

/// A stop that closes while another one is loaded is found, also where it closes and opens again between two
/// nodes of a step.
#[test]
fn a_second_stop_that_closes_during_a_contact_is_found() {
    let structure = || model(&[20.0, 900.0], diagonal(&[0.5, 5.0]));
    for gap in [1e-5, 3e-5, 1e-4, 2e-4] {
        for stiffness in [1e5, 1e7] {
            let soft = element(&[1.0, 0.3], 0.0, Law::Linear(LinearStop::with_gap(3e4, 0.0).unwrap()));
            let hard = element(&[0.8, -1.0], 0.0, hertz(stiffness, gap));
            let system = System::new(structure(), &Load::default(), vec![soft, hard]).unwrap();
            let stretch = Stretch { frequency_hz: 3.0, start: 0.0, end: 1.0 };
            let contacts = assert_agreement(
                &system,
                &stretch,
                &[-1e-3, 1e-4, 0.3, 0.05],
                1e-9,
                &format!("gap {gap:e}, stiffness {stiffness:e}"),
            );
            assert!(contacts >= 2, "gap {gap:e}: {contacts}");
        }
    }
}

/// `q_1 = -cos t` grazes its stop at 1 at the very time, pi, at which `-cos t/2` rises through the level of
/// the other stop.
#[test]
fn a_graze_of_one_stop_does_not_hide_a_touch_of_another() {
    let grazed = element(&[1.0, 0.0], 0.0, hertz(1e6, 1.0));
    let struck = element(&[0.0, 1.0], 0.0, Law::Linear(LinearStop::with_gap(12.0, 0.0).unwrap()));
    // A half-wave on the stiffened spring of sqrt(12.25) = 3.5 rad/s, and back.
    let after: f64 = 0.5 * (5.0 - PI - PI / 3.5);
    let expected = [-(5.0_f64.cos()), -after.sin(), 5.0_f64.sin(), -0.5 * after.cos()];
    for (stops, second) in [(vec![grazed.clone(), struck.clone()], 1), (vec![struck, grazed], 0)] {
        let system = System::new(model(&[1.0, 0.5], diagonal(&[0.0; 2])), &Load::default(), stops).unwrap();
        let mut exact = integrator(&system);
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 5.0 };
        let state = exact.advance(&stretch, &[-1.0, -1.0, 0.0, 0.0]).unwrap();
        assert_close(&state, &expected, 1e-12, "state");
        assert_eq!(exact.touches()[second], 1);
    }
}

/// A touch from inside or on the level, moving in or out, and with no speed at all.
#[test]
fn a_motion_may_begin_on_the_level() {
    let system = oscillator(1.0, 0.0, 0.0, vec![linear(15.0, 0.0)]);
    let over = |end: f64| Stretch { frequency_hz: 1.0, start: 0.0, end };
    let inwards = integrator(&system).advance(&over(PI / 4.0), &[0.0, 1.0]).unwrap();
    assert_close(&inwards, &[0.0, -1.0], 1e-13, "in and out");
    let outwards = integrator(&system).advance(&over(PI), &[0.0, -1.0]).unwrap();
    assert_close(&outwards, &[0.0, 1.0], 1e-13, "out and back");
    let rest = integrator(&system).advance(&over(3.0), &[0.0, 0.0]).unwrap();
    assert_eq!(rest, [0.0, 0.0]);
    // Pressed onto the stop from rest on the level: 1 - cos.
    let pressed = oscillator(0.0, 0.0, 2.0, vec![linear(16.0, 0.0)]);
    let quarter = integrator(&pressed).advance(&over(PI / 8.0), &[0.0, 0.0]).unwrap();
    assert_close(&quarter, &[2.0 / 16.0, 0.5], 1e-13, "pressed from rest");
}

/// Struck with almost no speed: the flow is that of a free flight up to the tiny force.
#[test]
fn slow_touches_and_releases_do_not_stall() {
    for speed in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        for law in [hertz(4.5e9, 0.0), Law::Linear(LinearStop::with_gap(1e6, 0.0).unwrap())] {
            let system = oscillator(50.0, 1.0, -0.5, vec![element(&[1.0], 0.0, law)]);
            let mut exact = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
            let stretch = Stretch { frequency_hz: 10.0, start: 0.0, end: 1.0 };
            let flow = exact.flow(&stretch, &[0.0, speed]).unwrap();
            assert!(flow.state.iter().all(|value| value.is_finite()));
            assert!(
                exact.counts().steps < 200 && exact.counts().looks < 2000,
                "{speed:e}: {:?}",
                exact.counts()
            );
        }
    }
}

/// A stretch may end at any instant of a contact: the motion to its end and on from there is that of the
/// whole, whichever instant it is.
#[test]
fn a_stretch_that_ends_within_a_contact_ends_there() {
    for (system, state) in
        [(crate::common::paper_beam(), vec![0.0; 12]), (crate::common::uniform_beam(8), vec![0.0; 16])]
    {
        let frequency_hz = 36.0;
        let stretch = |start: f64, end: f64| Stretch { frequency_hz, start, end };
        for tolerance in [1e-9, 1e-11, 1e-12] {
            let mut exact = ExactIntegrator::new(system.clone(), ExactSettings { tolerance }).unwrap();
            let start = exact.advance(&stretch(0.0, 3.0), &state).unwrap();
            let whole = exact.flow(&stretch(0.0, 1.0), &start).unwrap().state;
            assert!(exact.touches().iter().sum::<u32>() >= 1);
            let size = whole.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
            for k in 1..1000 {
                let end = f64::from(k) / 1000.0;
                let middle = exact.flow(&stretch(0.0, end), &start).unwrap().state;
                let found = exact.advance(&stretch(end, 1.0), &middle).unwrap();
                assert_close(&found, &whole, 1e-7 * size, &format!("cut at {end}"));
            }
        }
    }
}

/// A slow and a fast mode without damping, `r = a cos(w t + p) + b cos(v t + q)`, whose largest value is
/// above the level of a soft stop by a ten-millionth, or below it by as much.
#[test]
fn a_fast_mode_that_only_just_reaches_a_stop_is_not_passed_over() {
    let mut seed = 7_u64;
    let mut uniform = |from: f64, to: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut tried = 0;
    while tried < 200 {
        let (w, v) = (uniform(20.0, 60.0), uniform(300.0, 3000.0));
        let (a, b) = (1e-3, 1e-3 * 10_f64.powf(uniform(-5.0, -0.5)));
        let (p, q) = (uniform(0.0, TAU), uniform(0.0, TAU));
        let value = |t: f64| a * (w * t + p).cos() + b * (v * t + q).cos();
        let (slope, curvature) = (
            |t: f64| -a * w * (w * t + p).sin() - b * v * (v * t + q).sin(),
            |t: f64| -a * w * w * (w * t + p).cos() - b * v * v * (v * t + q).cos(),
        );
        let duration = TAU / w;
        let places = (0..40_000).map(|i| duration * f64::from(i) / 4e4);
        let mut top = places.fold(0.0, |best, t| if value(t) > value(best) { t } else { best });
        (0..6).for_each(|_| top -= slope(top) / curvature(top));
        if !(0.1..0.9).contains(&(top / duration)) {
            continue;
        }
        tried += 1;
        let start = [a * p.cos(), b * q.cos(), -a * w * p.sin(), -b * v * q.sin()];
        for (share, is_met) in [(-1e-7, true), (1e-7, false)] {
            let stop = Law::Linear(LinearStop::with_gap(1.0, value(top) * (1.0 + share)).unwrap());
            let elements = vec![element(&[1.0, 1.0], 0.0, stop)];
            let model = model(&[w, v], diagonal(&[0.0, 0.0]));
            let system = System::new(model, &Load::default(), elements).unwrap();
            let mut exact = integrator(&system);
            let stretch = Stretch { frequency_hz: 1.0 / duration, start: 0.0, end: 1.0 };
            exact.advance(&stretch, &start).unwrap();
            let found: u32 = exact.touches().iter().sum();
            assert_eq!(found > 0, is_met, "{w} {v} {b} {share}");
        }
    }
}
