//! Rigid stops: bounces in closed form, energy, chatter to its end, and exact sensitivities through all of
//! it.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{
    assert_agreement, beam_with, diagonal, differences::assert_sensitivities, element, integrator, model,
    rigid, settled,
};
use hammerbeam_motion::{
    DampingPart, Harmonic, HarmonicForce, LawError, Load, LocalElement, Parameter, ParameterError, Stretch,
    System,
    exact::{ContactPiece, ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance, observe},
    law::RigidStop,
};

/// A free unit mass, pressed on by a constant force g towards a rigid stop at q = gap.
fn falling_ball(restitution: f64, gap: f64, g: f64) -> System {
    let weight = Harmonic { order: 0, amplitude: g, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic: weight }] };
    let model = model(&[0.0], diagonal(&[0.0]));
    System::new(model, &load, vec![element(&[1.0], 0.0, rigid(restitution, gap))]).unwrap()
}

/// From the height h under the load g: impacts at `t_0 (1 + 2 e + 2 e^2 + ...)`, `t_0 = sqrt(2 h/g)`, heights
/// `e^2` of the one before.
#[test]
fn a_ball_bounces_as_the_closed_form_says() {
    let (e, h, g) = (0.7, 0.5, 9.81_f64);
    let system = falling_ball(e, h, g);
    let mut exact = integrator(&system);
    let first = (2.0 * h / g).sqrt();
    let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 0.99 * first * (1.0 + e) / (1.0 - e) };
    let trace = exact.trace(&stretch, &[0.0, 0.0], &[]).unwrap();
    assert!(trace.contacts.len() > 10);
    let mut speed = g * first;
    let mut time = first;
    for (k, contact) in trace.contacts.iter().enumerate() {
        let begin = contact.begin.as_ref().unwrap();
        // Times are sums of times, each good to the rounding of the clearance, about 5e-15 m, over the speed.
        let rounding = 2e-14 / speed;
        assert!((begin.time - time).abs() < rounding, "{k}: {} {time}", begin.time);
        assert!((begin.velocity - speed).abs() < g * rounding, "{k}: {} {speed}", begin.velocity);
        let relative = 2.0 * g * rounding / speed;
        assert!((contact.impulse / ((1.0 + e) * speed) - 1.0).abs() < relative, "{k}");
        assert!((contact.energy_lost / (0.5 * (1.0 - e * e) * speed * speed) - 1.0).abs() < relative, "{k}");
        assert_eq!(contact.end, Some(begin.time));
        let jump = contact.jump.as_ref().unwrap();
        assert_eq!(jump.impulse, contact.impulse);
        assert!((jump.state[0] - h).abs() < 1e-14 && (begin.state[1] - speed).abs() < g * rounding, "{k}");
        assert!((jump.state[1] + e * speed).abs() < g * rounding, "{k}: {:?}", jump.state);
        speed *= e;
        time += 2.0 * speed / g;
    }
}

/// The independent integrator, from as far beyond the stop as orbits that touch it are known, slowly away
/// from it: the motion is that of the free oscillator, and no crowd of steps within rounding of the stop.
#[test]
fn a_mass_a_little_beyond_its_stop_that_leaves_it_slowly_is_free() {
    let (w, gap, away) = (20.0_f64, 0.015, 6e-8);
    let free = model(&[w], diagonal(&[0.0]));
    let system = System::new(free, &Load::default(), vec![element(&[1.0], 0.0, rigid(1.0, gap))]).unwrap();
    let stretch = Stretch { frequency_hz: 3.5, start: 0.0, end: 0.5 };
    let settings = GeneralSettings::with_tolerance(1e-11).state_only();
    let angle = w * 0.5 / 3.5;
    for beyond in [0.0, 1e-12, 1e-11, 2e-11] {
        let state = [gap + beyond, -away];
        let found = advance(&system, &stretch, &state, &settings).unwrap();
        let expected = state[0] * angle.cos() + state[1] / w * angle.sin();
        assert!((found.flow.state[0] - expected).abs() < 1e-10, "{beyond}");
        assert!(found.counts.steps < 500, "{beyond}: {} steps", found.counts.steps);
    }
}

/// Let go behind the stop, where a search may begin, towards deeper: the impact takes the speed, and the
/// load, which pulls away, leads out. `q = q_0 - g t^2/2`.
#[test]
fn a_ball_behind_a_plastic_stop_is_struck_once_and_leaves() {
    let (g, behind) = (9.81, 0.01);
    let mut exact = integrator(&falling_ball(0.0, 0.0, -g));
    let end = 0.5;
    let state = exact.advance(&Stretch { frequency_hz: 1.0, start: 0.0, end }, &[behind, 0.1]).unwrap();
    assert_eq!(exact.touches(), [1]);
    assert!((state[0] - (behind - 0.5 * g * end * end)).abs() < 1e-12, "{state:?}");
    assert!((state[1] + g * end).abs() < 1e-12, "{state:?}");
}

/// Under `0.3 + cos t + 2 cos 3 t` a ball that gives nothing back sticks where it is pressed on and leaves at
/// once where it is not; either is one touch. Small steps of equal length find four that stick and two that
/// do not.
#[test]
fn every_impact_on_a_plastic_stop_is_a_touch() {
    let force = |order, amplitude| {
        let harmonic = Harmonic { order, amplitude, phase: 0.0 };
        HarmonicForce { shape: vec![1.0], harmonic }
    };
    let load = Load { support: vec![], forces: vec![force(0, 0.3), force(1, 1.0), force(3, 2.0)] };
    let model = model(&[0.0], diagonal(&[0.0]));
    let system = System::new(model, &load, vec![element(&[1.0], 0.0, rigid(0.0, 0.0))]).unwrap();
    let mut exact = integrator(&system);
    let stretch = Stretch { frequency_hz: 1.0 / std::f64::consts::TAU, start: 0.0, end: 6.0 };
    let trace = exact.trace(&stretch, &[-0.3, 0.5], &[]).unwrap();
    let leaves = |contact: &&ContactPiece| contact.end == contact.begin.as_ref().map(|begin| begin.time);
    let leaving = trace.contacts.iter().filter(leaves).count();
    assert_eq!([trace.contacts.len(), leaving], [6, 2], "{:?}", trace.contacts);
    exact.advance(&stretch, &[-0.3, 0.5]).unwrap();
    assert_eq!(exact.touches(), [6]);
}

/// The bounces end at `t_0 (1 + e)/(1 - e)`. From then on the ball lies on the stop, which carries its
/// weight, and all its energy is lost.
#[test]
fn chatter_ends_and_the_ball_rests() {
    for e in [0.0, 0.3, 0.8] {
        let (h, g) = (0.5, 9.81_f64);
        let system = falling_ball(e, h, g);
        let mut exact = integrator(&system);
        let end = (2.0 * h / g).sqrt() * (1.0 + e) / (1.0 - e);
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: end + 1.0 };
        let trace = exact.trace(&stretch, &[0.0, 0.0], &[end + 0.5]).unwrap();
        assert!((trace.state[0] - h).abs() < 1e-15 && trace.state[1].abs() < 1e-13, "{:?}", trace.state);
        assert!((trace.forces[0][0] + g).abs() < 1e-13);
        let stuck = trace.contacts.last().unwrap();
        assert_eq!(stuck.end, None);
        assert!((stuck.peak_force - g).abs() < 1e-12);
        // The last bounces, below 1e3 rounding margins, are left out: with them a time of 2 e v/(g (1 - e)).
        let begin = stuck.begin.as_ref().unwrap();
        let rest = 2.0 * e * begin.velocity / (g * (1.0 - e));
        assert!((begin.time + rest - end).abs() < 1e-8, "{e}: {} {rest} {end}", begin.time);
        // At the touch it takes what is left of the speed, and no more.
        let jump = stuck.jump.as_ref().unwrap();
        assert!((jump.impulse - begin.velocity).abs() < 1e-12 && jump.state[1].abs() < 1e-12, "{jump:?}");
        let lost: f64 = trace.contacts.iter().map(|contact| contact.energy_lost).sum();
        assert!((lost / (g * h) - 1.0).abs() < 1e-12, "{lost}");
        // All momentum that the weight gave was taken.
        let impulse: f64 = trace.contacts.iter().map(|contact| contact.impulse).sum();
        assert!((impulse / (g * stretch.end) - 1.0).abs() < 1e-12, "{impulse}");
        let flow = exact.flow(&stretch, &[0.0, 0.0]).unwrap();
        assert!((0..2).all(|i| (0..2).all(|j| flow.by_state[(i, j)] == 0.0)), "{:?}", flow.by_state);
        assert_eq!(exact.contraction(), f64::NEG_INFINITY);
    }
}

const PARAMETERS: [Parameter; 5] = [
    Parameter::ExcitationScale,
    Parameter::ADDED_DAMPING_RATIO,
    Parameter::AddedDamping { part: 1 },
    Parameter::gap(0),
    Parameter::restitution(0),
];

/// The system with a damper between two points as a further parameter; the support moves with one of them.
fn with_damper(system: System) -> System {
    let n = system.dof();
    let row: Vec<f64> = (0..n).map(|i| if i % 2 == 0 { 5.0 } else { -5.0 } / (1 + i) as f64).collect();
    let matrix = faer::Mat::from_fn(n, n, |i, j| row[i] * row[j]);
    let support: Vec<f64> = row.iter().map(|entry| 0.8 * entry).collect();
    let supports = vec![support; system.model().supports.len()];
    system.with_damping_part(DampingPart { matrix, supports }).unwrap()
}

#[test]
fn sensitivities_through_impacts_are_those_of_differences() {
    let system = with_damper(beam_with(0.015, rigid(0.6, 1e-4)));
    for frequency_hz in [22.0, 30.0, 36.0, 47.0] {
        let state = settled(&system, frequency_hz, 20, 0.1);
        let stretch = Stretch { frequency_hz, start: 0.1, end: 1.1 };
        assert!(
            integrator(&system).trace(&stretch, &state, &[]).unwrap().contacts.len()
                == if frequency_hz < 30.0 { 2 } else { 1 }
        );
        assert_sensitivities(&system, &stretch, &state, &PARAMETERS, 1e-6);
    }
}

/// Three modes, pressed on their rigid stop by a constant load and shaken so that it leaves the stop and
/// comes back in every period: bounces, chatter to its end, sticking, lift-off.
fn pressed(restitution: f64, damping: faer::Mat<f64>, support_ratio: f64) -> System {
    let shape = vec![1.0, 0.6, -0.4];
    let mut model = model(&[20.0, 55.0, 130.0], damping);
    model.supports = vec![hammerbeam_structure::SupportInput {
        inertia: vec![0.5, 0.3, -0.1],
        damping: vec![0.02, 0.01, 0.03],
    }];
    let force = |order, amplitude, phase| HarmonicForce {
        shape: shape.clone(),
        harmonic: Harmonic { order, amplitude, phase },
    };
    let support = vec![Harmonic { order: 1, amplitude: 2e-3, phase: 0.4 }.into()];
    let load = Load { support, forces: vec![force(0, 2.0, 0.0), force(1, 3.0, 0.3)] };
    with_damper(
        System::new(model, &load, vec![element(&shape, support_ratio, rigid(restitution, 1e-3))]).unwrap(),
    )
}

#[test]
fn sensitivities_through_chatter_sticking_and_lift_off_are_those_of_differences() {
    let coupled = faer::Mat::from_fn(3, 3, |i, j| if i == j { 1.0 + i as f64 } else { 0.4 });
    for (restitution, damping) in [(0.5, diagonal(&[0.8, 1.5, 3.0])), (0.0, coupled.clone()), (0.7, coupled)]
    {
        for support_ratio in [0.0, 1.0] {
            let system = pressed(restitution, damping.clone(), support_ratio);
            let frequency_hz = 1.7;
            for end in [0.95, 1.4] {
                let start = 0.4;
                let state = settled(&system, frequency_hz, 12, start);
                let stretch = Stretch { frequency_hz, start, end };
                let trace = integrator(&system).trace(&stretch, &state, &[]).unwrap();
                let stuck = trace.contacts.last().unwrap();
                assert!(stuck.peak_force > 1.0 && stuck.end.is_some() == (end > 1.0), "{stuck:?}");
                let parameters = if restitution > 0.0 { &PARAMETERS[..] } else { &PARAMETERS[..4] };
                assert_sensitivities(&system, &stretch, &state, parameters, 1e-6);
            }
        }
    }
}

/// Both integrators, over impacts, chatter, sticking and lift-off, and from states that are stuck.
#[test]
fn flows_agree_with_the_general_integrator() {
    let coupled = faer::Mat::from_fn(3, 3, |i, j| if i == j { 1.0 + i as f64 } else { 0.4 });
    for (restitution, damping) in [(0.5, diagonal(&[0.8, 1.5, 3.0])), (0.0, coupled.clone()), (0.7, coupled)]
    {
        for support_ratio in [0.0, 1.0] {
            let system = pressed(restitution, damping.clone(), support_ratio);
            for (start, end) in [(0.4, 0.7), (0.4, 0.95), (0.4, 1.4), (0.0, 0.1), (0.0, 0.5), (0.0, 1.3)] {
                let state = settled(&system, 1.7, 12, start);
                let stretch = Stretch { frequency_hz: 1.7, start, end };
                assert_agreement(
                    &system,
                    &stretch,
                    &state,
                    1e-9,
                    &format!("{restitution} {support_ratio} {start} {end}"),
                );
            }
        }
    }
    let beam = beam_with(0.015, rigid(0.6, 1e-4));
    for frequency_hz in [22.0, 30.0, 36.0, 47.0] {
        let state = settled(&beam, frequency_hz, 20, 0.1);
        let stretch = Stretch { frequency_hz, start: 0.1, end: 1.1 };
        assert_agreement(&beam, &stretch, &state, 1e-9, &format!("beam, {frequency_hz} Hz"));
    }
}

/// Maxima, impulses and numbers of contacts of both integrators. Chatter is one contact; a stop that gives
/// nothing back is struck twice, and sticks once.
#[test]
fn observed_motions_agree_with_the_general_integrator() {
    for (restitution, touches) in [(0.5, 1), (0.0, 2)] {
        let system = pressed(restitution, diagonal(&[0.8, 1.5, 3.0]), 1.0);
        let response = [0.2, 1.0, 0.7];
        let state = settled(&system, 1.7, 12, 0.4);
        let stretch = Stretch { frequency_hz: 1.7, start: 0.4, end: 1.4 };
        let mut exact =
            ExactIntegrator::watching(system.clone(), ExactSettings::default(), Some((&response, &[1.0])))
                .unwrap();
        let found = exact.observe(&[(stretch, &state)]).unwrap();
        let settings = GeneralSettings::with_tolerance(1e-12);
        let expected = observe(&system, &stretch, &state, (&response, &[1.0]), &settings).unwrap();
        assert_eq!(found.contacts(), expected.contacts());
        assert_eq!(found.touches, touches);
        for (name, found, expected) in [
            ("displacement", found.displacement, expected.displacement),
            ("acceleration", found.acceleration, expected.acceleration),
            ("force", found.contact_force, expected.contact_force),
            ("speed", found.impact_velocity, expected.impact_velocity),
            ("impulse", found.impulse, expected.impulse),
        ] {
            assert!((found / expected - 1.0).abs() < 1e-9, "{restitution} {name}: {found} {expected}");
        }
        let trace = exact.trace(&stretch, &state, &[]).unwrap();
        let impulse: f64 = trace.contacts.iter().map(|contact| contact.impulse).sum();
        assert!((impulse / found.impulse - 1.0).abs() < 1e-12);
        let lost: f64 = trace.contacts.iter().map(|contact| contact.energy_lost).sum();
        assert!((lost / found.energy_lost - 1.0).abs() < 1e-12);
    }
}

/// Two stops that act on the same structure at different places: impacts while the other is held, both held
/// at once, one let go by an impact on the other.
fn two_stops(restitution: f64, damping: faer::Mat<f64>, second: [f64; 3]) -> System {
    let mut model = model(&[20.0, 55.0, 130.0], damping);
    model.supports = vec![hammerbeam_structure::SupportInput {
        inertia: vec![0.5, 0.3, -0.1],
        damping: vec![0.02, 0.01, 0.03],
    }];
    let force = |shape: [f64; 3], order, amplitude, phase| HarmonicForce {
        shape: shape.to_vec(),
        harmonic: Harmonic { order, amplitude, phase },
    };
    let first = [1.0, 0.6, -0.4];
    let support = vec![Harmonic { order: 1, amplitude: 1e-3, phase: 0.4 }.into()];
    let forces = vec![
        force(first, 0, 2.0, 0.0),
        force(first, 1, 3.0, 0.3),
        force(second, 0, 2.5, 0.0),
        force(second, 2, 3.5, 1.1),
    ];
    let elements = vec![
        element(&first, 1.0, rigid(restitution, 1e-3)),
        LocalElement { name: "second".into(), ..element(&second, 0.0, rigid(restitution, 5e-4)) },
    ];
    with_damper(System::new(model, &Load { support, forces }, elements).unwrap())
}

#[test]
fn several_stops_agree_with_the_general_integrator_and_differences() {
    let coupled = faer::Mat::from_fn(3, 3, |i, j| if i == j { 1.0 + i as f64 } else { 0.4 });
    let mut seen = [0; 4];
    // The second stop is pushed towards the first, and away from it.
    for (restitution, damping, second) in [
        (0.5, diagonal(&[0.8, 1.5, 3.0]), [0.7, -0.9, 0.5]),
        (0.3, coupled.clone(), [0.9, 0.4, 0.8]),
        (0.0, coupled, [-0.5, 0.9, 0.6]),
    ] {
        let system = two_stops(restitution, damping, second);
        for (start, end) in [(0.0, 0.3), (0.2, 0.7), (0.5, 1.1), (0.75, 1.75)] {
            let state = settled(&system, 1.7, 12, start);
            let stretch = Stretch { frequency_hz: 1.7, start, end };
            let what = format!("{restitution} {second:?} {start}");
            let trace = integrator(&system).trace(&stretch, &state, &[]).unwrap();
            // Stops that throw one another off chatter in cycles of chatter; each cycle leaves its end out,
            // which the sensitivities feel to about 2e-7.
            assert_agreement(&system, &stretch, &state, 1e-6, &what);
            if trace.contacts.iter().all(|contact| contact.begin.is_some()) {
                let parameters = if restitution > 0.0 { &PARAMETERS[..] } else { &PARAMETERS[..4] };
                // Where chatter is cut a motion repeats to about 1e-13, over steps of 1e-7 in the damping.
                assert_sensitivities(&system, &stretch, &state, parameters, 1e-5);
                seen[3] += 1;
            }
            let stuck: Vec<_> = trace.contacts.iter().filter(|contact| contact.peak_force > 0.0).collect();
            let time = |contact: &ContactPiece| {
                let begin = contact.begin.as_ref().map_or(0.0, |begin| begin.time);
                (begin, contact.end.unwrap_or(stretch.duration()))
            };
            for a in &stuck {
                let others = trace.contacts.iter().filter(|other| other.element != a.element);
                for other in others {
                    let ((begin, end), (touch, left)) = (time(a), time(other));
                    let inside = begin < touch && touch < end;
                    seen[0] += u32::from(inside && other.peak_force == 0.0);
                    seen[1] += u32::from(inside && other.peak_force > 0.0);
                    seen[2] += u32::from((end - touch).abs() < 1e-12 && left == touch);
                }
            }
        }
    }
    assert!(
        seen.iter().all(|count| *count > 1),
        "impacts beside a held stop, both held, thrown off, from free states: {seen:?}"
    );
}

/// Stops at the same place, and what laws and parameters refuse.
#[test]
fn what_is_not_followed_is_refused() {
    let twin = |law| LocalElement { name: "twin".into(), ..element(&[1.0], 0.0, law) };
    let weight = Harmonic { order: 0, amplitude: 1.0, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic: weight }] };
    let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 20.0 };
    let system = System::new(
        model(&[0.0], diagonal(&[0.0])),
        &load,
        vec![element(&[1.0], 0.0, rigid(0.5, 0.5)), twin(rigid(0.5, 0.5))],
    )
    .unwrap();
    let found = integrator(&system).advance(&stretch, &[0.0, 0.0]);
    // Both are at the same place: one carries the load, and the other one touches.
    assert_eq!(found.unwrap(), [0.5, 0.0]);
    assert!(
        matches!(RigidStop::with_gap(1.01, 0.0), Err(LawError::RigidRestitution { found }) if found == 1.01)
    );
    assert!(matches!(RigidStop::with_gap(-0.1, 0.0), Err(LawError::RigidRestitution { .. })));
    assert!(matches!(RigidStop::with_gap(f64::NAN, 0.0), Err(LawError::RigidRestitution { .. })));
    assert!(matches!(RigidStop::with_gap(0.5, -1e-3), Err(LawError::Gap { .. })));
    let stiffness = Parameter::stiffness(0);
    assert!(matches!(system.parameter(stiffness), Err(ParameterError::NoStiffness { .. })));
    let other = falling_ball(0.5, 1.0, 1.0).with_parameter(Parameter::restitution(0), 2.0);
    assert!(matches!(other, Err(ParameterError::Law { .. })));
    let beam = beam_with(0.015, crate::common::hertz(1e9, 0.0));
    let error = beam.parameter(Parameter::restitution(0));
    assert!(matches!(error, Err(ParameterError::NoRestitution { .. })));
}
