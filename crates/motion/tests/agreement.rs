//! The exact integrator against the general one on the six-dof beam of the paper and its relatives.
//!
//! The general integrator runs at 1e-13 a step; its sensitivities then have errors of about 1e-10 of the
//! largest entry.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{assert_agreement, beam_with, hertz, paper_beam, settled, uniform_beam};
use hammerbeam_motion::{
    Law, Stretch,
    law::{LinearStop, PowerSpring, TwoSidedStop},
};

const BOUND: f64 = 1e-9;

/// From one to nine contacts a cycle. The motions are those that starts from rest settle to, or wander
/// through.
#[test]
fn flows_of_the_beam_agree_for_few_and_many_contacts() {
    let system = paper_beam();
    let mut contacts = Vec::new();
    for (frequency_hz, cycles) in
        [(36.0, 150), (53.0, 150), (22.0, 150), (28.0, 150), (41.0, 150), (19.7, 80), (75.0, 90), (100.0, 90)]
    {
        let state = settled(&system, frequency_hz, cycles, 0.0);
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        contacts.push(assert_agreement(&system, &stretch, &state, BOUND, &format!("{frequency_hz} Hz")));
    }
    assert!(contacts.contains(&1), "{contacts:?}");
    assert!(contacts.iter().any(|c| (2..=5).contains(c)), "{contacts:?}");
    assert!(contacts.iter().any(|&c| c >= 7), "{contacts:?}");
}

/// Stretches of a small part of a cycle all around: those that start or end inside a contact are compared.
#[test]
fn stretches_that_start_and_end_inside_contacts_agree() {
    let system = paper_beam();
    let shape = &system.elements()[0].shape;
    let closed = |state: &[f64]| state.iter().zip(shape).map(|(q, phi)| q * phi).sum::<f64>() > 0.0;
    let mut exact = crate::common::integrator(&system);
    let mut compared = 0;
    for (frequency_hz, parts) in [(36.0, 300), (53.0, 120), (53.0, 500)] {
        let mut state = settled(&system, frequency_hz, 100, 0.0);
        for part in 0..parts {
            let phase = |part: u32| f64::from(part) / f64::from(parts);
            let stretch = Stretch { frequency_hz, start: phase(part), end: phase(part + 1) };
            let end = exact.advance(&stretch, &state).unwrap();
            if closed(&state) || closed(&end) {
                compared += 1;
                assert_agreement(
                    &system,
                    &stretch,
                    &state,
                    BOUND,
                    &format!("{frequency_hz} Hz, part {part}"),
                );
            }
            state = end;
        }
    }
    assert!(compared > 60, "{compared}");
}

#[test]
fn flows_of_the_beam_agree_for_every_law() {
    let cubic = Law::Power(PowerSpring::cubic(1e9).unwrap());
    let laws = [
        (hertz(4.5e9, 2e-4), 40.0),
        (hertz(1e7, 0.0), 40.0),
        (Law::Hertz(hammerbeam_motion::law::HertzStop::with_preload(4.5e9, 2.0).unwrap()), 30.0),
        (Law::Linear(LinearStop::with_gap(1e5, 0.0).unwrap()), 36.0),
        (Law::Linear(LinearStop::with_gap(1e7, 1e-4).unwrap()), 50.0),
        (Law::Linear(LinearStop::with_preload(1e5, 3.0).unwrap()), 30.0),
        (Law::TwoSided(TwoSidedStop::new(1e6, 2e-4, 3e-4).unwrap()), 25.0),
        (Law::TwoSided(TwoSidedStop::new(1e5, 0.0, 0.0).unwrap()), 25.0),
        (cubic, 25.0),
    ];
    for (law, frequency_hz) in laws {
        for damping_ratio in [0.015, 0.0] {
            let system = beam_with(damping_ratio, law.clone());
            let state = settled(&system, frequency_hz, if damping_ratio > 0.0 { 60 } else { 3 }, 0.3);
            let stretch = Stretch { frequency_hz, start: 0.3, end: 1.3 };
            let what = format!("{law:?}, damping {damping_ratio}");
            let contacts = assert_agreement(&system, &stretch, &state, BOUND, &what);
            assert!(contacts > 0 || law.contacts().is_empty(), "{what}: no contact");
        }
    }
}

#[test]
fn flows_agree_from_one_to_twenty_four_modes() {
    for modes in [1, 2, 3, 8, 16, 24] {
        let system = uniform_beam(modes);
        let state = settled(&system, 31.0, 40, 0.0);
        let stretch = Stretch { frequency_hz: 31.0, start: 0.0, end: 2.0 };
        let contacts = assert_agreement(&system, &stretch, &state, BOUND, &format!("{modes} modes"));
        assert!(contacts > 0, "{modes} modes: no contact");
    }
}
