//! Loads without a steady response - a constant one on a body that is free or has a damper, a harmonic one in
//! resonance without damping - through contacts: against the general integrator, and every column against
//! differences.

use std::f64::consts::TAU;

use faer::Mat;
use hammerbeam_motion::{
    DampingPart, Harmonic, HarmonicForce, Law, Load, LocalElement, Parameter, Stretch, System,
    law::LinearStop,
};

use crate::common::{
    assert_agreement, damped, diagonal, differences::assert_sensitivities, element, hertz, hunt_crossley,
    model,
};

fn linear(stiffness: f64, gap: f64) -> Law {
    Law::Linear(LinearStop::with_gap(stiffness, gap).unwrap())
}

const FREQUENCY: f64 = 1.7;

/// Three modes, with a damper between two points as a further parameter.
struct Structure {
    what: &'static str,
    frequencies: [f64; 3],
    damping: Mat<f64>,
    /// Orders and amplitudes of the forces.
    forces: [(u32, f64); 2],
}

const SHAPE: [f64; 3] = [1.0, 0.6, -0.4];
const ACROSS: [f64; 3] = [0.3, -0.9, 0.7];

impl Structure {
    fn system(&self, elements: Vec<LocalElement>) -> System {
        let force = |(order, amplitude): (u32, f64)| HarmonicForce {
            shape: SHAPE.to_vec(),
            harmonic: Harmonic { order, amplitude, phase: 0.3 * f64::from(order) },
        };
        let load = Load { support: vec![], forces: self.forces.map(force).to_vec() };
        let system = System::new(model(&self.frequencies, self.damping.clone()), &load, elements).unwrap();
        let row = [0.8, -0.5, 0.3];
        let matrix = Mat::from_fn(3, 3, |i, j| row[i] * row[j]);
        system.with_damping_part(DampingPart { matrix, supports: vec![] }).unwrap()
    }
}

fn structures() -> [Structure; 5] {
    let (w, coupled) = (TAU * FREQUENCY, |first: f64| {
        Mat::from_fn(3, 3, |i, j| if i == j { [first, 1.5, 3.0][i] } else { 0.4 })
    });
    let weight = [(0, 2.0), (1, 3.0)];
    let of =
        |what, first, damping, forces| Structure { what, frequencies: [first, 55.0, 130.0], damping, forces };
    [
        of("a free body under a weight", 0.0, diagonal(&[0.0, 1.5, 3.0]), weight),
        of("a free body with a damper", 0.0, diagonal(&[2.5, 1.5, 3.0]), weight),
        of("a free body with coupling dampers", 0.0, coupled(2.5), weight),
        of("resonance", w, diagonal(&[0.0, 1.5, 3.0]), [(1, 1.0), (3, 0.5)]),
        of("resonance of a higher order", 2.0 * w, diagonal(&[1e-4, 1.5, 3.0]), [(2, 2.0), (0, 0.7)]),
    ]
}

const STRETCH: Stretch = Stretch { frequency_hz: FREQUENCY, start: 0.4, end: 1.6 };
const STATE: [f64; 6] = [2e-4, 1e-4, -1e-4, 0.03, 0.02, -0.01];

#[test]
fn flows_agree_with_the_general_integrator() {
    let laws =
        [linear(400.0, 1e-3), damped(900.0, 2.0, 1e-3), hertz(2e4, 1e-3), hunt_crossley(2e4, 0.4, 1e-3)];
    for structure in structures() {
        for law in &laws {
            let what = format!("{}, {law:?}", structure.what);
            let system = structure.system(vec![element(&SHAPE, 0.0, law.clone())]);
            assert!(assert_agreement(&system, &STRETCH, &STATE, 1e-7, &what) > 0, "{what}: no contact");
        }
    }
}

#[test]
fn motions_in_round_holes_agree_with_the_general_integrator() {
    for structure in structures() {
        for law in [linear(400.0, 1e-3), hertz(2e4, 1e-3)] {
            let what = format!("{}, hole of {law:?}", structure.what);
            let directions = [SHAPE, ACROSS].map(|shape| (shape.to_vec(), vec![]));
            let hole = LocalElement::round_hole("hole", directions, law.in_round_hole().unwrap());
            let system = structure.system(hole.to_vec());
            assert!(assert_agreement(&system, &STRETCH, &STATE, 1e-7, &what) > 0, "{what}: no contact");
        }
    }
}

/// By the state, the frequency, the excitation, both kinds of damping, and the gap; also of forces that
/// depend on the velocity, which need the rates of each column. Differences by a damping need a little of
/// it, with which the load is in resonance still.
#[test]
fn sensitivities_are_those_of_differences() {
    let parameters = [
        Parameter::ExcitationScale,
        Parameter::ADDED_DAMPING_RATIO,
        Parameter::AddedDamping { part: 1 },
        Parameter::gap(0),
    ];
    for structure in structures() {
        let laws: [Law; 2] = [linear(400.0, 1e-3), damped(900.0, 2.0, 1e-3)];
        for law in laws {
            let system = structure.system(vec![element(&SHAPE, 0.0, law)]);
            let system = system.with_parameter(Parameter::ADDED_DAMPING_RATIO, 3e-5).unwrap();
            let system = system.with_parameter(Parameter::AddedDamping { part: 1 }, 2.2e-3).unwrap();
            assert_sensitivities(&system, &STRETCH, &STATE, &parameters, 2e-6);
        }
    }
}

/// The response of `q'' + q = cos(w t)` is largest at the start of each period, and there only it meets its
/// stop, less and less deep: what the load does shortly after the start is all that the column by the
/// frequency has there.
#[test]
fn a_shallow_contact_at_the_start_of_a_stretch_is_followed() {
    let forces =
        vec![HarmonicForce { shape: vec![1.0], harmonic: Harmonic { order: 1, amplitude: 1.0, phase: 0.0 } }];
    let elements = vec![element(&[1.0], 0.0, linear(5.0, 1e4))];
    let system =
        System::new(model(&[1.0], diagonal(&[0.0])), &Load { support: vec![], forces }, elements).unwrap();
    // `1/(1 - w^2) = 1e4`.
    let stretch = Stretch { frequency_hz: f64::sqrt(1.0 - 1e-4) / TAU, start: 0.0, end: 1.0 };
    for depth in [4.7e-6, 1e-4, 1e-2, 1.0] {
        let touches = assert_agreement(&system, &stretch, &[1e4 + depth, 0.0], 1e-7, &format!("{depth}"));
        assert_eq!(touches, 1, "{depth}");
    }
}
