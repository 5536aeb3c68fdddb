//! Systems shared by the tests.
#![allow(dead_code, reason = "each test file uses some of them")]

use faer::Mat;
use hammerbeam_motion::{Harmonic, Law, Load, LocalElement, System, law::HertzStop};
use hammerbeam_structure::{PointOutput, ReducedModel, SupportInput};

/// The six-dof beam of the reference table "In modal coordinates of the reduced clamped beam".
pub fn beam_model(damping_ratio: f64) -> ReducedModel {
    let frequencies = [17.49546, 137.27615, 414.31135, 843.22742, 1538.84987, 3945.26664];
    let shape = vec![3.719882, 1.767674, 1.071971, 0.656816, 0.374580, 1.326146];
    let inertia = vec![0.326581, -0.160943, 0.092436, -0.064797, 0.065038, -0.029896];
    let natural_frequencies: Vec<f64> = frequencies.iter().map(|f| std::f64::consts::TAU * f).collect();
    ReducedModel {
        damping: Mat::from_fn(6, 6, |i, j| if i == j { 2.0 * damping_ratio * natural_frequencies[i] } else { 0.0 }),
        natural_frequencies,
        points: vec![PointOutput { name: "contact".into(), shape, support_ratio: 1.0 }],
        support: Some(SupportInput { inertia, damping: vec![0.0; 6] }),
        uniform_acceleration: vec![0.0; 6],
    }
}

/// The beam with a stop below the contact point that rides on the support.
pub fn beam_with(damping_ratio: f64, law: Law) -> System {
    let model = beam_model(damping_ratio);
    let shape = model.points[0].shape.iter().map(|phi| -phi).collect();
    let load = Load {
        support: vec![Harmonic { order: 1, amplitude: 0.5015e-3, phase: 0.0 }],
        ..Load::default()
    };
    let element = LocalElement { name: "stop".into(), shape, support_ratio: 0.0, law };
    System::new(model, &load, vec![element]).unwrap()
}

/// The beam of the paper.
pub fn paper_beam() -> System {
    beam_with(0.015, Law::Hertz(HertzStop::with_gap(4.5e9, 0.0).unwrap()))
}
