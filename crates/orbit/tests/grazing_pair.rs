//! Two grazings within one step, with the same contacts on both sides.
//!
//! `x'' + c x' + x = cos(2 pi f t)` has its largest amplitude `1/(c sqrt(1 - c^2/4))`. A stop a little before it is touched between the two frequencies at which the amplitude is the gap,
//! `w^2 = 1 - c^2/2 -+ sqrt((1 - c^2/2)^2 - 1 + 1/g^2)`. The other way round, a stop that reaches into the motion all but for a short stretch cannot be had with one harmonic.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

mod common;

use std::f64::consts::TAU;

use common::walk;
use faer::Mat;
use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, LocalElement, System, law::LinearStop};
use hammerbeam_orbit::{OrbitSettings, Response, Side, find_start};
use hammerbeam_structure::{PointOutput, ReducedModel};

const DAMPING: f64 = 0.1;

/// With a stop that lies before the largest amplitude by this share of it, and its gap.
fn oscillator(share: f64) -> (System, f64) {
    let gap = (1.0 - share) / (DAMPING * (1.0 - 0.25 * DAMPING * DAMPING).sqrt());
    let model = ReducedModel {
        natural_frequencies: vec![1.0],
        damping: Mat::from_fn(1, 1, |_, _| DAMPING),
        points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratio: 0.0 }],
        support: None,
        uniform_acceleration: vec![1.0],
    };
    let harmonic = Harmonic { order: 1, amplitude: 1.0, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let law = Law::Linear(LinearStop::with_gap(10.0, gap).unwrap());
    let stop = LocalElement { name: "stop".into(), shape: vec![1.0], support_ratio: 0.0, law };
    (System::new(model, &load, vec![stop]).unwrap(), gap)
}

fn grazings(system: &System, max_step_hz: f64) -> Vec<f64> {
    let response = Response { shape: vec![1.0], support_ratio: 0.0 };
    let settings = OrbitSettings { max_step_hz, ..OrbitSettings::default() };
    let (from_hz, to_hz) = (0.15, 0.17);
    let start = find_start(system, &response, from_hz, 1, &settings).unwrap();
    let (rows, _) = walk(system, &response, &start, Side::Up, (from_hz, to_hz), &settings);
    rows.iter().filter(|row| row.events.grazing).map(|row| row.solution.frequency_hz).collect()
}

#[test]
fn a_touch_that_appears_and_vanishes_within_a_step_is_found() {
    for share in [1e-3, 1e-5, 1e-7] {
        let (system, gap) = oscillator(share);
        let middle = 1.0 - 0.5 * DAMPING * DAMPING;
        let root = (middle * middle - 1.0 + 1.0 / (gap * gap)).sqrt();
        let expected = [-root, root].map(|root| (middle + root).sqrt() / TAU);
        for max_step_hz in [1e-3, 1e-4] {
            let found = grazings(&system, max_step_hz);
            assert_eq!(found.len(), 2, "{share:e}, {max_step_hz} Hz: {found:?}, expected {expected:?}");
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-8, "{share:e}: {found} instead of {expected}");
            }
        }
    }
}
