//! Where a contact opens for an instant and is pressed on again, a branch ends: not within a step of that
//! place but there, from both sides.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::TAU;

use crate::common::events::side;
use hammerbeam_motion::{System, law::RestitutionModel};
use hammerbeam_orbit::{OrbitSettings, Response, Side, StopReason, find_start};
use hammerbeam_testkit::{
    laws::remembering,
    structures::unit_mass,
    systems::{element, force, forced},
};

const DAMPING: f64 = 0.2;
/// Amplitudes of the first and second harmonic of the force, both downwards.
const FORCES: [f64; 2] = [1.0, 0.5];
const GAP: f64 = 0.45;

/// `q'' + 0.2 q' + q = - cos 2 pi f t - cos(4 pi f t)/2` in closed form.
fn displacement(frequency_hz: f64, cycles: f64) -> f64 {
    let of_order = |order: f64, force: f64| {
        let omega = TAU * order * frequency_hz;
        let (stiff, lossy) = (1.0 - omega * omega, DAMPING * omega);
        let phase = TAU * order * cycles;
        -force * (stiff * phase.cos() + lossy * phase.sin()) / (stiff * stiff + lossy * lossy)
    };
    of_order(1.0, FORCES[0]) + of_order(2.0, FORCES[1])
}

/// The minimum between the two maxima, which lies about the phase 1/2.
fn dip(frequency_hz: f64) -> f64 {
    let (mut from, mut to) = (0.4_f64, 0.6_f64);
    while to - from > 1e-9 {
        let third = (to - from) / 3.0;
        let rises = displacement(frequency_hz, from + third) < displacement(frequency_hz, to - third);
        if rises { to -= third } else { from += third }
    }
    displacement(frequency_hz, (from + to) / 2.0)
}

/// Frequency at which the dip comes to the gap; it falls with the frequency.
fn border() -> f64 {
    let (mut low, mut high) = (0.001, 0.05);
    assert!(dip(low) > GAP && dip(high) < GAP);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if dip(middle) > GAP { low = middle } else { high = middle }
    }
    low
}

/// A stop so soft that it does not move the mass by a digit.
fn subject() -> (System, Response) {
    let forces = (1..).zip(FORCES).map(|(order, amplitude)| force(&[1.0], order, -amplitude, 0.0));
    let law = remembering(1e-13, RestitutionModel::LankaraniNikravesh, 0.7, GAP);
    let (model, load) = (unit_mass(1.0, DAMPING), forced(forces.collect()));
    let system = System::new(model, &load, vec![element(&[1.0], 0.0, law)]).unwrap();
    (system, Response { shape: vec![1.0], support_ratios: vec![0.0] })
}

#[test]
fn a_branch_ends_where_its_contact_splits_and_not_a_step_before() {
    let (subject, border) = (subject(), border());
    let step = 2e-5;
    let settings = OrbitSettings { max_step: step, ..OrbitSettings::default() };
    for (way, start_hz, range) in [
        (Side::Up, border - 20.3 * step, (border - 40.0 * step, border + 40.0 * step)),
        (Side::Down, border + 20.3 * step, (border - 40.0 * step, border + 40.0 * step)),
    ] {
        let start = find_start(&subject.0, &subject.1, start_hz, 1, &settings).unwrap();
        let (rows, end) = side(&subject, &start, way, range, &settings);
        let StopReason::ContactReopens { place: frequency_hz, phase, .. } = end else { panic!("{end:?}") };
        assert!((phase - 0.5).abs() < 0.05, "{phase}");
        assert!((frequency_hz - border).abs() < 1e-9 * border, "{way:?}: {frequency_hz} is not {border}");
        let last = &rows[rows.len() - 1].solution;
        assert!((last.frequency_hz - frequency_hz).abs() < f64::EPSILON, "{}", last.frequency_hz);
        let contacts = [last, &rows[0].solution].map(|orbit| orbit.maxima.contacts);
        assert_eq!(contacts[0], contacts[1], "the last row is of the same orbits");
    }
}
