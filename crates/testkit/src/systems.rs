//! Loads, elements and responses of models.

use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, LocalElement, System};
use hammerbeam_orbit::Response;
use hammerbeam_structure::ReducedModel;

use crate::{
    laws::hertz,
    structures::{paper_modes, unit_mass},
};

/// A harmonic force in modal coordinates.
pub fn force(shape: &[f64], order: u32, amplitude: f64, phase: f64) -> HarmonicForce {
    HarmonicForce { shape: shape.to_vec(), harmonic: Harmonic { order, amplitude, phase } }
}

/// A force `amplitude cos(2 pi order f t)` at a point; order 0 is constant.
pub fn force_at(model: &ReducedModel, point: &str, order: u32, amplitude: f64) -> HarmonicForce {
    force(&model.point(point).unwrap().shape, order, amplitude, 0.0)
}

/// A load of these forces alone.
pub fn forced(forces: Vec<HarmonicForce>) -> Load {
    Load { support: vec![], forces }
}

/// `u = amplitude cos(2 pi f t)`.
pub fn shaken(amplitude: f64) -> Load {
    Load { support: vec![Harmonic { order: 1, amplitude, phase: 0.0 }.into()], forces: vec![] }
}

/// A local element along a shape; `support_ratio` is 0 if its surroundings ride on the support.
pub fn element(shape: &[f64], support_ratio: f64, law: Law) -> LocalElement {
    LocalElement { name: "stop".into(), shape: shape.to_vec(), support_ratios: vec![support_ratio], law }
}

/// A local element between a point and its surroundings, which ride on the support.
pub fn element_at(model: &ReducedModel, point: &str, law: Law) -> LocalElement {
    LocalElement { name: "element".into(), ..element(&model.point(point).unwrap().shape, 0.0, law) }
}

/// The displacement of a point.
pub fn response_of(model: &ReducedModel, point: &str) -> Response {
    let point = model.point(point).unwrap();
    Response { shape: point.shape.clone(), support_ratios: point.support_ratios.clone() }
}

/// The paper's beam by its printed modes, with a stop below the contact point that rides on the support.
pub fn modal_beam_with(damping_ratio: f64, law: Law) -> System {
    let model = paper_modes(damping_ratio);
    let shape: Vec<f64> = model.points[0].shape.iter().map(|phi| -phi).collect();
    System::new(model, &shaken(0.5015e-3), vec![element(&shape, 0.0, law)]).unwrap()
}

/// The paper's beam by its printed modes with its Hertz stop.
pub fn modal_beam() -> System {
    modal_beam_with(0.015, hertz(4.5e9, 0.0))
}

/// `x'' + c x' + k x = F cos(2 pi f t + phase) + f(x)` of unit mass, with the force `f` of a law.
pub fn oscillator(
    stiffness: f64,
    damper: f64,
    (amplitude, phase): (f64, f64),
    law: Law,
) -> (System, Response) {
    let load = forced(vec![force(&[1.0], 1, amplitude, phase)]);
    let elements = vec![element(&[1.0], 0.0, law)];
    let system = System::new(unit_mass(stiffness, damper), &load, elements).unwrap();
    (system, Response { shape: vec![1.0], support_ratios: vec![0.0] })
}
