//! The oscillator of the unit tests.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use faer::Mat;
use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, LocalElement, System};
use hammerbeam_structure::{PointOutput, ReducedModel};

use crate::Response;

/// `x'' + c x' + x + F = a cos(2 pi f t)` with the force F of the element.
pub(crate) fn oscillator(damping: f64, amplitude: f64, law: Law) -> (System, Response) {
    let model = ReducedModel {
        natural_frequencies: vec![1.0],
        damping: Mat::from_fn(1, 1, |_, _| damping),
        points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratios: vec![0.0] }],
        supports: vec![],
        uniform_acceleration: vec![1.0],
    };
    let harmonic = Harmonic { order: 1, amplitude, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let element = LocalElement { name: "element".into(), shape: vec![1.0], support_ratios: vec![0.0], law };
    let system = System::new(model, &load, vec![element]).unwrap();
    (system, Response { shape: vec![1.0], support_ratios: vec![0.0] })
}
