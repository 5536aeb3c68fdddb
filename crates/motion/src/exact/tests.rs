//! Order of convergence of the force steps, with steps of fixed length.

use faer::Mat;
use hammerbeam_structure::ReducedModel;

use std::sync::Arc;

use super::{ExactIntegrator, ExactSettings, collocation::Grading};
use crate::{
    Law, Load, LocalElement, Stretch, System,
    law::{HertzStop, PowerSpring},
};

fn integrator(law: Law) -> ExactIntegrator {
    let frequencies = vec![30.0, 170.0];
    let model = ReducedModel {
        damping: Mat::from_fn(2, 2, |i, j| if i == j { 0.02 * frequencies[i] } else { 0.0 }),
        natural_frequencies: frequencies,
        points: vec![],
        supports: vec![],
        uniform_acceleration: vec![0.0; 2],
    };
    let element =
        LocalElement { name: "element".into(), shape: vec![1.0, 0.6], support_ratios: vec![0.0], law };
    let system = System::new(model, &Load::default(), vec![element]).unwrap();
    ExactIntegrator::new(system, ExactSettings::default()).unwrap()
}

/// State after `count` equal steps over `duration`, the first one with `grading`.
fn steps(law: Law, state: &[f64], duration: f64, count: usize, grading: Grading) -> Vec<f64> {
    let mut integrator = integrator(law);
    let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: duration };
    let mut run = integrator.begin(&stretch, state, false).unwrap();
    if grading == Grading::Touch {
        run.closed[0] = Some(0);
    }
    for step in 0..count {
        integrator.note_start(&mut run, duration);
        integrator.set_active(&run);
        let grading = if step == 0 { grading } else { Grading::Smooth };
        let length = duration / count as f64;
        integrator.attempt(&run, length, grading).unwrap();
        assert_eq!(integrator.step.length, length, "the lengths are those asked for");
        Arc::make_mut(&mut integrator.step.weights).set_propagators(&integrator.blocks, length);
        integrator.step.advance_state(&integrator.series, &mut run.state);
        run.time += length;
    }
    run.state
}

/// Order between two lengths, from the largest velocity error.
fn order(law: Law, state: &[f64], duration: f64, counts: [usize; 2], grading: Grading) -> f64 {
    let exact = steps(law.clone(), state, duration, 8 * counts[1], grading);
    let error = |count: usize| {
        let found = steps(law.clone(), state, duration, count, grading);
        found[2..].iter().zip(&exact[2..]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let errors = counts.map(error);
    assert!(errors[1] > 1e-13, "above rounding: {errors:?}");
    (errors[0] / errors[1]).ln() / (counts[1] as f64 / counts[0] as f64).ln()
}

/// Gauss nodes carry the state to twice the order of the force: 24 with twelve nodes.
#[test]
fn smooth_steps_converge_with_twice_the_number_of_nodes() {
    let law = Law::Power(PowerSpring::cubic(4e7).unwrap());
    let order = order(law, &[0.0, 0.0, 1.0, 0.2], 0.04, [1, 2], Grading::Smooth);
    assert!((19.0..30.0).contains(&order), "{order}");
}

/// The half-integer power at the touch does not lower it much: one step of half a contact, and halves of it.
#[test]
fn steps_graded_at_the_touch_converge_as_fast() {
    let law = Law::Hertz(HertzStop::with_gap(1e7, 0.0).unwrap());
    let state = [0.0, 0.0, 1.0, 0.2];
    let exact = steps(law.clone(), &state, 2e-3, 16, Grading::Touch);
    let one = steps(law.clone(), &state, 2e-3, 1, Grading::Touch);
    for i in 2..4 {
        assert!((one[i] - exact[i]).abs() < 1e-11, "{} {}", one[i], exact[i]);
    }
    let smooth = steps(law, &state, 2e-3, 1, Grading::Smooth);
    assert!((smooth[2] - exact[2]).abs() > 1e-9, "without grading one step is not enough");
}
