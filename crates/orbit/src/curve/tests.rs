//! The gradient of every condition against differences of the residual.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use faer::Mat;
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Parameter, System,
    law::{CubicSpring, LinearStop},
};
use hammerbeam_path::PathProblem;
use hammerbeam_structure::{PointOutput, ReducedModel};

use super::{
    bordered::Bordered,
    condition::Condition,
    grazing::Touch,
    pair::Pair,
    problem::CurveProblem,
    shooting::{Place, Shooting},
};
use crate::{OrbitSettings, Response, solve::integrator, state_scale::StateScale};

/// Two modes with a cubic spring and a stop, under two harmonics of a force.
fn system() -> System {
    let model = ReducedModel {
        natural_frequencies: vec![1.0, 1.7],
        damping: Mat::from_fn(2, 2, |i, j| if i == j { 0.1 } else { 0.02 }),
        points: vec![PointOutput { name: "mass".into(), shape: vec![1.0, 1.0], support_ratio: 0.0 }],
        support: None,
        uniform_acceleration: vec![1.0, 0.0],
    };
    let harmonic = |order, amplitude| Harmonic { order, amplitude, phase: 0.0 };
    let force = |harmonic| HarmonicForce { shape: vec![1.0, 0.3], harmonic };
    let load = Load { support: vec![], forces: vec![force(harmonic(1, 1.0)), force(harmonic(2, 0.4))] };
    let element = |shape: [f64; 2], law| LocalElement {
        name: "element".into(),
        shape: shape.to_vec(),
        support_ratio: 0.0,
        law,
    };
    let spring = element([1.0, 1.0], Law::Cubic(CubicSpring::new(1.0).unwrap()));
    let stop = element([1.0, -1.0], Law::Linear(LinearStop::with_gap(2.0, 0.3).unwrap()));
    System::new(model, &load, vec![spring, stop]).unwrap()
}

fn shooting(parameter: Parameter) -> Shooting {
    let system = system();
    let response = Response { shape: vec![1.0, 1.0], support_ratio: 0.0 };
    let mut integrator = integrator(&system, &response, &OrbitSettings::default()).unwrap();
    integrator.differentiate_by(Some(parameter)).unwrap();
    Shooting {
        integrator,
        parameter,
        period_multiple: 1,
        scale: StateScale::new(&[1.0, 1.7], 1.0, 1.0),
        count: 2,
        segments: Vec::new(),
        products: Vec::new(),
        touches: vec![0; 1],
        grazing_distance: f64::INFINITY,
        passing: None,
    }
}

#[test]
fn jacobians_agree_with_differences_of_the_residual() {
    let parameters = [
        Parameter::ExcitationScale,
        Parameter::Stiffness { element: 0 },
        Parameter::Gap { element: 1 },
        Parameter::ADDED_DAMPING_RATIO,
    ];
    for parameter in parameters {
        let make: [fn(&Shooting) -> Condition; 4] = [
            |shooting| Condition::Multiplier(Bordered::new(1.0, shooting)),
            |shooting| Condition::Multiplier(Bordered::new(-1.0, shooting)),
            |shooting| Condition::Pair(Pair::new(shooting).unwrap()),
            |_| Condition::Touch(Touch { element: 1, contact: 0, from_inside: false }),
        ];
        for (kind, make) in make.into_iter().enumerate() {
            let mut shooting = shooting(parameter);
            let value = shooting.integrator.system().parameter(parameter).unwrap();
            let nodes = vec![0.9, -0.2, 0.4, 0.1, -0.6, 0.3, -0.5, 0.2];
            let place = Place { nodes, frequency_hz: 0.21, phase: 0.07, value };
            let place = if kind == 3 { place } else { Place { phase: 0.0, ..place } };
            shooting.evaluate(&place).unwrap();
            let condition = make(&shooting);
            let mut problem = CurveProblem::new(shooting, condition, place.phase, [1.0, 1.0]);
            let point = problem.point(&place);
            problem.evaluate(&point).unwrap();
            let (jacobian, width) = (problem.jacobian().to_vec(), point.len());
            for j in 0..width {
                let step = 1e-5;
                let mut at = |sign: f64| {
                    let mut moved = point.clone();
                    moved[j] += sign * step;
                    problem.evaluate(&moved).unwrap();
                    problem.residual().to_vec()
                };
                let (above, below) = (at(1.0), at(-1.0));
                for i in 0..width - 1 {
                    let difference = (above[i] - below[i]) / (2.0 * step);
                    let found = jacobian[i * width + j];
                    let error = (found - difference).abs();
                    // Gradients of conditions leave the square of their own step times third derivatives.
                    let bound = if i < 8 { 1e-6 } else { 5e-5 };
                    assert!(
                        error < bound * difference.abs().max(1.0),
                        "{parameter:?}, condition {kind}, row {i}, column {j}: {found} against {difference}"
                    );
                }
            }
        }
    }
}
