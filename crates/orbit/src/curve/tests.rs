//! The gradient of every condition against differences of the residual, and coefficients of normal forms
//! against differences of the flow.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use faer::{Mat, c64};
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Parameter, System,
    law::{LinearStop, PowerSpring},
};
use hammerbeam_path::PathProblem;
use hammerbeam_structure::{PointOutput, ReducedModel};

use super::{
    bordered::{Bordered, Vectors},
    closing::Closing,
    condition::Condition,
    lyapunov::{self, PairVectors},
    normal_form::{self, answer},
    pair::Pair,
    problem::CurveProblem,
    shooting::{CurveOrbit, Shooting},
    touched::Touch,
};
use crate::{OrbitSettings, Response, by_rows::dot, solve::integrator, state_scale::StateScale};

/// Two modes with a cubic spring and a stop, under two harmonics of a force.
fn system() -> System {
    let model = ReducedModel {
        natural_frequencies: vec![1.0, 1.7],
        damping: Mat::from_fn(2, 2, |i, j| if i == j { 0.1 } else { 0.02 }),
        points: vec![PointOutput { name: "mass".into(), shape: vec![1.0, 1.0], support_ratios: vec![0.0] }],
        supports: vec![],
        uniform_acceleration: vec![1.0, 0.0],
    };
    let harmonic = |order, amplitude| Harmonic { order, amplitude, phase: 0.0 };
    let force = |harmonic| HarmonicForce { shape: vec![1.0, 0.3], harmonic };
    let load = Load { support: vec![], forces: vec![force(harmonic(1, 1.0)), force(harmonic(2, 0.4))] };
    let element = |shape: [f64; 2], law| LocalElement {
        name: "element".into(),
        shape: shape.to_vec(),
        support_ratios: vec![0.0],
        law,
    };
    let spring = element([1.0, 1.0], Law::Power(PowerSpring::cubic(1.0).unwrap()));
    let stop = element([1.0, -1.0], Law::Linear(LinearStop::with_gap(2.0, 0.3).unwrap()));
    System::new(model, &load, vec![spring, stop]).unwrap()
}

fn shooting(parameter: Parameter) -> Shooting {
    let system = system();
    let response = Response { shape: vec![1.0, 1.0], support_ratios: vec![0.0] };
    let mut integrator = integrator(&system, &response, &OrbitSettings::default()).unwrap();
    integrator.differentiate_by(Some(parameter)).unwrap();
    Shooting {
        integrator,
        parameter,
        period_multiple: 1,
        closing: Closing::Periodic,
        scale: StateScale::new(&[1.0, 1.7], 1.0, 1.0),
        count: 2,
        segments: Vec::new(),
        products: Vec::new(),
        touches: vec![0; 1],
        grazing_distance: f64::INFINITY,
        passing: None,
    }
}

/// The place of the orbit from a state, cut into so many segments that lead from node to node; the last one
/// need not close.
fn cut(state: &[f64], count: usize) -> (Shooting, CurveOrbit) {
    let mut shooting = shooting(Parameter::ExcitationScale);
    shooting.count = count;
    let mut place = CurveOrbit { nodes: state.to_vec(), frequency_hz: 0.21, phase: 0.0, value: 1.0 };
    for k in 0..count - 1 {
        let end = shooting.flow(k, &place, &place.nodes[4 * k..]).unwrap().end;
        place.nodes.extend(end);
    }
    shooting.evaluate(&place).unwrap();
    (shooting, place)
}

/// Extrapolates what central differences with the step h and half of it give.
fn extrapolated(h: f64, mut with_step: impl FnMut(f64) -> f64) -> f64 {
    (4.0 * with_step(0.5 * h) - with_step(h)) / 3.0
}

/// `6 c w^T v` is the third derivative of `w^T Z(z + t v + t^2 s/2)` by t, `(I - A) s = D^2 Z (v, v)`:
/// differences of states, where the coefficient is made of differences of matrices, with one step.
#[test]
fn coefficients_do_not_depend_on_segments_and_are_third_derivatives_of_the_flow() {
    let state = [0.9, -0.2, 0.4, 0.1];
    let vectors = Vectors { value: 0.0, left: vec![0.5, -0.5, 0.1, 0.7], right: vec![0.1, 0.7, -0.1, 0.7] };
    let values = [1, 2, 5].map(|count| {
        let (mut shooting, place) = cut(&state, count);
        normal_form::of_flip(&mut shooting, &place, &vectors).unwrap().unwrap().value
    });
    let (mut shooting, place) = cut(&state, 1);
    let mut at = |t: f64, s: &[f64]| -> Vec<f64> {
        let moved: Vec<f64> = (0..4).map(|i| state[i] + t * vectors.right[i] + 0.5 * t * t * s[i]).collect();
        shooting.flow(0, &place, &moved).unwrap().end
    };
    let zero = [0.0; 4];
    let second: Vec<f64> = (0..4)
        .map(|i| {
            extrapolated(4e-3, |h| (at(h, &zero)[i] - 2.0 * at(0.0, &zero)[i] + at(-h, &zero)[i]) / (h * h))
        })
        .collect();
    let (s, _) = answer(&cut(&state, 1).0, 1.0, &second).unwrap();
    let third = extrapolated(8e-3, |h| {
        let ends = [2.0, 1.0, -1.0, -2.0].map(|k| dot(&vectors.left, &at(k * h, &s)));
        (ends[0] - 2.0 * ends[1] + 2.0 * ends[2] - ends[3]) / (2.0 * h * h * h)
    });
    for value in values {
        assert!((6.0 * value / third - 1.0).abs() < 1e-4, "{values:?} and {}", third / 6.0);
        assert!((value / values[0] - 1.0).abs() < 5e-5, "{values:?}");
    }
}

/// The vectors need not belong to the orbit for that.
#[test]
fn first_lyapunov_coefficients_do_not_depend_on_segments() {
    let pair = PairVectors {
        multiplier: c64::from_polar(1.0, 2.0),
        right: [vec![0.1, 0.7, -0.1, 0.7], vec![0.4, -0.2, 0.5, 0.1]],
        left: [vec![0.5, -0.5, 0.1, 0.7], vec![0.3, 0.1, -0.4, 0.2]],
    };
    let values = [1, 2, 5].map(|count| {
        let (mut shooting, place) = cut(&[0.9, -0.2, 0.4, 0.1], count);
        lyapunov::of_pair(&mut shooting, &place, &pair).unwrap().unwrap().value
    });
    assert!(values.iter().all(|value| (value / values[0] - 1.0).abs() < 5e-5), "{values:?}");
}

#[test]
fn jacobians_agree_with_differences_of_the_residual() {
    let parameters = [
        Parameter::ExcitationScale,
        Parameter::stiffness(0),
        Parameter::gap(1),
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
            let place = CurveOrbit { nodes, frequency_hz: 0.21, phase: 0.07, value };
            let place = if kind == 3 { place } else { CurveOrbit { phase: 0.0, ..place } };
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
