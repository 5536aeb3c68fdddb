//! Contacts that lose energy: both integrators agree on flows, observations and where contacts part and end,
//! also in stretches that start or end within them.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::{PI, TAU};

use crate::common::{
    assert_agreement, beam_with, damped, diagonal, element, hunt_crossley, integrator, model, remembering,
    settled,
};
use hammerbeam_motion::{
    Law, Load, Stretch, System,
    exact::{ExactIntegrator, ExactSettings, MotionError},
    general::{GeneralError, GeneralSettings, advance, observe, sample},
    law::{HertzStop, HuntCrossleyStop, LinearStop, RestitutionModel},
};

/// The general integrator runs at 1e-13 a step; its sensitivities then have errors of about 1e-10 of the
/// largest entry.
const BOUND: f64 = 1e-9;

/// From next to no loss to contacts that are overdamped, with gaps and preloads. At the contact point the
/// beam weighs about 50 g: 140 N s/m are critical for the linear stop.
#[test]
fn flows_of_the_beam_agree() {
    let preloaded = LinearStop::with_preload(1e5, 3.0).unwrap().with_damping(15.0).unwrap();
    let hertz = HertzStop::with_preload(4.5e9, 2.0).unwrap();
    let laws = [
        (damped(1e5, 0.5, 0.0), 36.0),
        (damped(1e5, 20.0, 0.0), 36.0),
        (damped(1e5, 140.0, 1e-4), 50.0),
        (damped(1e5, 600.0, 0.0), 41.0),
        (damped(1e7, 300.0, 0.0), 22.0),
        (Law::Linear(preloaded), 30.0),
        (hunt_crossley(4.5e9, 0.02, 0.0), 36.0),
        (hunt_crossley(4.5e9, 0.6, 0.0), 22.0),
        (hunt_crossley(4.5e9, 0.6, 2e-4), 41.0),
        (hunt_crossley(4.5e9, 8.0, 0.0), 53.0),
        (hunt_crossley(1e7, 3.0, 0.0), 28.0),
        (Law::HuntCrossley(HuntCrossleyStop::new(hertz, 0.8).unwrap()), 30.0),
    ];
    for (law, frequency_hz) in laws {
        for damping_ratio in [0.015, 0.0] {
            let system = beam_with(damping_ratio, law.clone());
            let state = settled(&system, frequency_hz, if damping_ratio > 0.0 { 60 } else { 3 }, 0.3);
            let stretch = Stretch { frequency_hz, start: 0.3, end: 1.3 };
            let what = format!("{law:?}, damping {damping_ratio}");
            let contacts = assert_agreement(&system, &stretch, &state, BOUND, &what);
            assert!(contacts > 0, "{what}: no contact");
        }
    }
}

/// Stretches of a small part of a cycle: some start or end in a contact, some where it has parted.
#[test]
fn stretches_that_start_and_end_inside_contacts_agree() {
    for (law, parts) in [(damped(1e5, 60.0, 0.0), 200_u32), (hunt_crossley(1e6, 20.0, 0.0), 400)] {
        let system = beam_with(0.015, law.clone());
        let element = &system.elements()[0];
        let relative = |state: &[f64]| {
            let read = |part: &[f64]| part.iter().zip(&element.shape).map(|(q, phi)| q * phi).sum::<f64>();
            (read(&state[..6]), read(&state[6..]))
        };
        let (mut pressing, mut parted) = (0, 0);
        let mut exact = integrator(&system);
        let frequency_hz = 36.0;
        let mut state = settled(&system, frequency_hz, 100, 0.0);
        for part in 0..parts {
            let phase = |part: u32| f64::from(part) / f64::from(parts);
            let stretch = Stretch { frequency_hz, start: phase(part), end: phase(part + 1) };
            let end = exact.advance(&stretch, &state).unwrap();
            let (r, v) = relative(&end);
            if r > 0.0 {
                let force = law.force(r, v).value;
                if force < 0.0 {
                    pressing += 1;
                } else {
                    parted += 1;
                }
                assert_agreement(&system, &stretch, &state, BOUND, &format!("{law:?}, part {part}"));
            }
            state = end;
        }
        assert!(pressing > 5 && parted > 0, "{law:?}: {pressing} and {parted}");
    }
}

/// Undamped modes without load: what they lose is the work of the contact, by Simpson's rule on samples of
/// the general integrator.
#[test]
fn the_modes_lose_what_the_contact_takes() {
    let frequencies = [30.0, 170.0, 410.0];
    let state = [0.0, 0.0, 0.0, 1.0, 0.2, -0.1];
    for law in [damped(3e5, 40.0, 1e-3), hunt_crossley(1e8, 0.7, 1e-3)] {
        let system = System::new(
            model(&frequencies, diagonal(&[0.0; 3])),
            &Load::default(),
            vec![element(&[1.0, 0.6, -0.4], 0.0, law.clone())],
        )
        .unwrap();
        let stretch = Stretch { frequency_hz: 20.0, start: 0.0, end: 1.0 };
        let mut exact = integrator(&system);
        let end = exact.advance(&stretch, &state).unwrap();
        assert!(exact.touches()[0] > 0);
        let energy = |z: &[f64]| -> f64 {
            (0..3).map(|i| 0.5 * (z[3 + i].powi(2) + (frequencies[i] * z[i]).powi(2))).sum()
        };
        let lost = energy(&state) - energy(&end);
        let count = 200_000;
        let phases: Vec<f64> = (0..=count).map(|k| f64::from(k) / f64::from(count)).collect();
        let states =
            sample(&system, &stretch, &state, &phases, &GeneralSettings::with_tolerance(1e-12)).unwrap();
        let power = |z: &Vec<f64>| {
            let read = |part: &[f64]| part[0] + 0.6 * part[1] - 0.4 * part[2];
            let (r, v) = (read(&z[..3]), read(&z[3..]));
            -law.force(r, v).value * v
        };
        let simpson = |k: usize| if k == 0 || k == count as usize { 1.0 } else { [2.0, 4.0][k % 2] };
        let work: f64 = states.iter().enumerate().map(|(k, z)| simpson(k) * power(z)).sum();
        let work = work * stretch.duration() / (3.0 * f64::from(count));
        assert!(lost > 1e-3 * energy(&state), "{law:?}: hardly any loss");
        // The rule misses up to half a sample of 0.25 us where the force jumps.
        assert!((lost / work - 1.0).abs() < 1e-3, "{law:?}: {lost} against {work}");
    }
}

/// Without damping they are the elastic laws, to the last bit of the law.
#[test]
fn no_loss_is_the_elastic_law() {
    let linear = LinearStop::with_gap(1e5, 0.0).unwrap();
    assert_eq!(Law::Linear(linear.with_damping(0.0).unwrap()), Law::Linear(linear));
    let system = beam_with(0.015, hunt_crossley(4.5e9, 0.0, 0.0));
    let elastic = beam_with(0.015, crate::common::hertz(4.5e9, 0.0));
    let state = settled(&elastic, 36.0, 20, 0.0);
    let stretch = Stretch { frequency_hz: 36.0, start: 0.0, end: 1.0 };
    let [found, expected] = [&system, &elastic].map(|s| integrator(s).advance(&stretch, &state).unwrap());
    assert_eq!(found, expected);
}

/// Every model, from light to heavy loss; the stretch starts where the contact is open.
#[test]
fn flows_of_the_beam_agree_for_laws_that_remember_the_impact() {
    let mut contacts = 0;
    for (model, e, gap, frequency_hz) in [
        (RestitutionModel::HuntCrossley, 0.9, 0.0, 36.0),
        (RestitutionModel::HerbertMcWhannell, 0.7, 0.0, 28.0),
        (RestitutionModel::LeeWang, 0.5, 1e-4, 41.0),
        (RestitutionModel::LankaraniNikravesh, 0.95, 0.0, 36.0),
        (RestitutionModel::LankaraniNikravesh, 0.6, 0.0, 53.0),
        (RestitutionModel::Gonthier, 0.3, 0.0, 41.0),
        (RestitutionModel::Flores, 0.8, 2e-4, 50.0),
        (RestitutionModel::HuGuo, 0.4, 0.0, 22.0),
    ] {
        for stiffness in [4.5e9, 1e7] {
            let system = beam_with(0.015, remembering(stiffness, model, e, gap));
            let what = format!("{model:?} {e} {stiffness:e}");
            let mut exact = integrator(&system);
            let mut state = vec![0.0; 12];
            for _ in 0..60 {
                state = exact.advance(&Stretch { frequency_hz, start: 0.0, end: 1.0 }, &state).unwrap();
            }
            // The first of these phases at which the contact is open, with a little room.
            for k in 1..40 {
                let phase = 0.025 * f64::from(k);
                let stretch = Stretch { frequency_hz, start: 0.0, end: phase };
                let start = exact.advance(&stretch, &state).unwrap();
                let r: f64 = start.iter().zip(&system.elements()[0].shape).map(|(q, phi)| q * phi).sum();
                let stretch = Stretch { frequency_hz, start: phase, end: phase + 1.0 };
                if r < gap - 2e-5 {
                    contacts += assert_agreement(&system, &stretch, &start, BOUND, &what);
                    break;
                }
                // Not in memory after another stretch.
                state = exact.advance(&Stretch { frequency_hz, start: phase, end: 1.0 }, &start).unwrap();
            }
        }
    }
    assert!(contacts > 20, "{contacts}");
}

/// A state within a contact does not tell how it began.
#[test]
fn a_stretch_that_starts_in_a_contact_with_memory_is_refused() {
    let system = beam_with(0.015, remembering(1e6, RestitutionModel::Flores, 0.6, 0.0));
    let frequency_hz = 36.0;
    let mut exact = integrator(&system);
    let mut state = vec![0.0; 12];
    let stretch = |part: u32| {
        let phase = |part: u32| f64::from(part) / 40.0;
        Stretch { frequency_hz, start: phase(part), end: phase(part + 1) }
    };
    let mut continued = 0;
    for part in 0..400 {
        let stretch = stretch(part % 40);
        let r: f64 = state.iter().zip(&system.elements()[0].shape).map(|(q, phi)| q * phi).sum();
        if r > 1e-9 {
            let refused = integrator(&system).flow(&stretch, &state).unwrap_err();
            assert!(matches!(refused, MotionError::StartsInContact { .. }), "{refused}");
            let refused = advance(&system, &stretch, &state, &GeneralSettings::default()).unwrap_err();
            assert!(matches!(refused, GeneralError::StartsInContact { .. }), "{refused}");
            continued += 1;
        }
        // The motion itself goes on over the cuts.
        state = exact.advance(&stretch, &state).unwrap();
    }
    assert!(continued > 10, "{continued}");
    // Ten cycles in pieces are ten cycles.
    let mut whole = vec![0.0; 12];
    for _ in 0..10 {
        whole = exact.advance(&Stretch { frequency_hz, start: 0.0, end: 1.0 }, &whole).unwrap();
    }
    let scale = whole[6..].iter().fold(0.0_f64, |scale, v| scale.max(v.abs()));
    for i in 6..12 {
        assert!((whole[i] - state[i]).abs() < 1e-6 * scale, "{} {}", whole[i], state[i]);
    }
}

/// Both integrators see the same maxima.
#[test]
fn observations_agree() {
    let laws = [
        damped(1e5, 20.0, 0.0),
        damped(1e5, 600.0, 0.0),
        hunt_crossley(4.5e9, 0.6, 0.0),
        remembering(4.5e9, RestitutionModel::LankaraniNikravesh, 0.7, 0.0),
    ];
    for law in laws {
        let system = beam_with(0.015, law.clone());
        let shape = &system.model().points[0].shape.clone();
        let state = settled(&system, 36.0, 80, 0.0);
        let stretch = Stretch { frequency_hz: 36.0, start: 0.0, end: 1.0 };
        let settings = ExactSettings { tolerance: 1e-13 };
        let mut exact = ExactIntegrator::watching(system.clone(), settings, Some((shape, &[1.0]))).unwrap();
        let found = exact.observe(&[(stretch, &state)]).unwrap();
        let expected =
            observe(&system, &stretch, &state, (shape, &[1.0]), &GeneralSettings::with_tolerance(1e-12))
                .unwrap();
        for (what, found, expected) in [
            ("displacement", found.displacement, expected.displacement),
            ("acceleration", found.acceleration, expected.acceleration),
            ("force", found.contact_force, expected.contact_force),
            ("impact", found.impact_velocity, expected.impact_velocity),
            ("impulse", found.impulse, expected.impulse),
        ] {
            // Maxima of forces and accelerations are located to some 1e-5 of a step, where they are flat.
            assert!((found / expected - 1.0).abs() < 1e-8, "{law:?}, {what}: {found} against {expected}");
        }
        assert_eq!(found.touches as usize, expected.touches.len());
    }
}

/// A mass on a spring that just reaches the stop, by a depth that goes down to nothing: contacts of any depth
/// end, and do next to nothing. With a damper the fundamental matrix jumps by `c` in the rate that the depth
/// has, as the saltation matrix says.
#[test]
fn grazing_contacts_of_any_depth_come_to_their_end() {
    let (omega, gap) = (100.0, 1e-3);
    let laws = [
        damped(1e5, 20.0, gap),
        damped(1e5, 2000.0, gap),
        hunt_crossley(1e8, 5.0, gap),
        remembering(1e8, RestitutionModel::Gonthier, 0.2, gap),
    ];
    for law in laws {
        let system = System::new(
            model(&[omega], diagonal(&[0.2])),
            &Load::default(),
            vec![element(&[1.0], 0.0, law.clone())],
        )
        .unwrap();
        let mut exact = integrator(&system);
        for exponent in 3..60 {
            for part in [1.0, 0.7, 0.3] {
                let depth = gap * part * 10f64.powf(-0.3 * f64::from(exponent));
                // Half a period before the largest displacement, without the little that the damping takes.
                let state = [-(gap + depth) * (0.1 * PI / omega).exp(), 0.0];
                let stretch = Stretch { frequency_hz: omega / TAU, start: 0.0, end: 1.0 };
                let what = format!("{law:?}, depth {depth:e}");
                let flow = exact.flow(&stretch, &state).unwrap_or_else(|error| panic!("{what}: {error}"));
                assert!(flow.state[0] < 0.0 && flow.state[0] > 1.0001 * state[0], "{what}: {:?}", flow.state);
                if depth < 1e-12 {
                    // `c` at the touch, turned round and damped over the half period that follows; the
                    // contact itself takes less than a microsecond.
                    let jump = law.onset_damping();
                    let decay = (-0.2 * PI / omega).exp();
                    let expected = if exact.touches()[0] > 0 { -decay * jump } else { 0.0 };
                    let found = flow.by_state[(1, 0)];
                    assert!(
                        (found - expected).abs() < 1e-2 * jump + 0.1,
                        "{what}: {found} against {expected}"
                    );
                }
            }
        }
    }
}

/// A contact whose force has vanished is clear where the general integrator has its penetration end, and not
/// before.
#[test]
fn a_trace_tells_when_the_penetration_of_a_parted_contact_ends() {
    let laws = [
        damped(1e5, 60.0, 0.0),
        hunt_crossley(1e6, 20.0, 0.0),
        remembering(1e6, RestitutionModel::Flores, 0.3, 0.0),
    ];
    for law in laws {
        let (system, frequency_hz) = (beam_with(0.015, law.clone()), 36.0);
        let state = settled(&system, frequency_hz, 60, 0.3);
        let trace =
            integrator(&system).trace(&Stretch { frequency_hz, start: 0.3, end: 2.3 }, &state, &[]).unwrap();
        let penetration = |time: f64| {
            let stretch = Stretch { frequency_hz, start: 0.3, end: 0.3 + time * frequency_hz };
            let settings = GeneralSettings::with_tolerance(1e-12).state_only();
            let state = advance(&system, &stretch, &state, &settings).unwrap().flow.state;
            state[..6].iter().zip(&system.elements()[0].shape).map(|(q, phi)| q * phi).sum::<f64>()
        };
        let ended = trace.contacts.iter().filter_map(|contact| Some((contact.end?, contact.clear?)));
        let parted: Vec<(f64, f64)> = ended.filter(|(end, clear)| clear - end > 1e-6).collect();
        assert!(!parted.is_empty(), "{law:?}: no contact parts before it ends");
        for (end, clear) in parted {
            assert!(penetration(clear).abs() < 1e-12, "{law:?}: {:e} m", penetration(clear));
            assert!(penetration(0.5 * (end + clear)) > 1e-9, "{law:?}: not parted yet");
        }
    }
}
