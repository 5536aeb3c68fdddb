//! Two grazings within one step, with the same contacts on both sides.
//!
//! `x'' + c x' + K x = cos(2 pi f t)` has its largest amplitude `1/(c sqrt(K - c^2/4))`, and the amplitude g
//! at `w^2 = K - c^2/2 -+ sqrt((K - c^2/2)^2 - K^2 + 1/g^2)`. A stop at a distance g a little below the
//! largest amplitude is touched between these two frequencies, with `K = 1`. The other way round, a spring of
//! stiffness k that presses with the force p on the undeformed oscillator is pressed in by `g = p/(k K)` at
//! rest, `K = 1 + k`; between the frequencies it opens for an instant in every period.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::TAU;

use crate::common::walk;
use faer::Mat;
use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, LocalElement, System, law::LinearStop};
use hammerbeam_orbit::{OrbitSettings, Response, Side, find_start};
use hammerbeam_structure::{PointOutput, ReducedModel};

const DAMPING: f64 = 0.1;

/// Stiffness of the spring.
const STIFFNESS: f64 = 10.0;

/// With a spring that is touched, or left, where the amplitude exceeds its largest one less this share of it;
/// and the two frequencies at which it does [Hz].
fn oscillator(share: f64, is_pressed_at_rest: bool) -> (System, [f64; 2]) {
    let stiffness = if is_pressed_at_rest { 1.0 + STIFFNESS } else { 1.0 };
    let least = (1.0 - share) / (DAMPING * (stiffness - 0.25 * DAMPING * DAMPING).sqrt());
    let stop = if is_pressed_at_rest {
        LinearStop::with_preload(STIFFNESS, least * STIFFNESS * stiffness)
    } else {
        LinearStop::with_gap(STIFFNESS, least)
    };
    let model = ReducedModel {
        natural_frequencies: vec![1.0],
        damping: Mat::from_fn(1, 1, |_, _| DAMPING),
        points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratios: vec![0.0] }],
        supports: vec![],
        uniform_acceleration: vec![1.0],
    };
    let harmonic = Harmonic { order: 1, amplitude: 1.0, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let law = Law::Linear(stop.unwrap());
    let stop = LocalElement { name: "stop".into(), shape: vec![1.0], support_ratios: vec![0.0], law };
    let middle = stiffness - 0.5 * DAMPING * DAMPING;
    let root = (middle * middle - stiffness * stiffness + 1.0 / (least * least)).sqrt();
    let frequencies = [-root, root].map(|root| (middle + root).sqrt() / TAU);
    (System::new(model, &load, vec![stop]).unwrap(), frequencies)
}

fn grazings(system: &System, (from_hz, to_hz): (f64, f64), max_step: f64) -> Vec<f64> {
    let response = Response { shape: vec![1.0], support_ratios: vec![0.0] };
    let settings = OrbitSettings { max_step, ..OrbitSettings::default() };
    let start = find_start(system, &response, from_hz, 1, &settings).unwrap();
    let (rows, _) = walk(system, &response, &start, Side::Up, (from_hz, to_hz), &settings);
    rows.iter().filter(|row| row.events.grazing).map(|row| row.solution.frequency_hz).collect()
}

/// Two grazings are found in the range, at the frequencies of the closed form, however wide the steps.
fn assert_pair_is_found(is_pressed_at_rest: bool, range_hz: (f64, f64)) {
    for share in [1e-3, 1e-5, 1e-7] {
        let (system, expected) = oscillator(share, is_pressed_at_rest);
        for max_step in [1e-3, 1e-4] {
            let found = grazings(&system, range_hz, max_step);
            assert_eq!(found.len(), 2, "{share:e}, {max_step} Hz: {found:?}, expected {expected:?}");
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-8, "{share:e}: {found} instead of {expected}");
            }
        }
    }
}

#[test]
fn a_touch_that_appears_and_vanishes_within_a_step_is_found() {
    assert_pair_is_found(false, (0.15, 0.17));
}

#[test]
fn a_contact_that_opens_for_an_instant_within_a_step_is_found() {
    assert_pair_is_found(true, (0.51, 0.545));
}
