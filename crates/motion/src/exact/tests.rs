//! Order of convergence of the force steps, with steps of fixed length; what looks go by.

use faer::Mat;
use hammerbeam_structure::ReducedModel;

use std::sync::Arc;

use super::{
    ExactIntegrator, ExactSettings,
    collocation::Grading,
    flight::{Boundary, Touch},
};
use crate::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Stretch, System,
    law::{HertzStop, LinearStop, PowerSpring},
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

/// A rigid mode under a constant force, a weakly damped one, a fast and an over-critical one, the last two
/// with small amplitudes; for the distances that fall to zero in flight.
#[test]
fn what_is_left_without_fast_blocks_stays_below() {
    let damping = [0.0, 1.2, 68.0, 2.5e5];
    let model = ReducedModel {
        damping: Mat::from_fn(4, 4, |i, j| if i == j { damping[i] } else { 0.0 }),
        natural_frequencies: vec![0.0, 30.0, 1700.0, 5e4],
        points: vec![],
        supports: vec![],
        uniform_acceleration: vec![0.0; 4],
    };
    let force = |order, amplitude| HarmonicForce {
        shape: vec![0.3, 1.0, 0.6, 0.2],
        harmonic: Harmonic { order, amplitude, phase: 0.4 },
    };
    let load = Load { support: vec![], forces: vec![force(0, 0.02), force(1, 0.5), force(3, 0.1)] };
    let law = Law::Linear(LinearStop::with_gap(1e3, 1e-3).unwrap());
    let element =
        LocalElement { name: "stop".into(), shape: vec![0.3, 1.0, 0.6, 0.2], support_ratios: vec![], law };
    let system = System::new(model, &load, vec![element]).unwrap();
    let mut integrator = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
    let stretch = Stretch { frequency_hz: 4.0, start: 0.0, end: 1.0 };
    let end = stretch.duration();
    let mut used = 0;
    for case in 0..200_u32 {
        let part = |k: u32| f64::from((case * 7919 + k * 104_729) % 2003) / 1001.0 - 1.0;
        let sizes = [1e-3, 1e-3, 2e-5, 2e-6, 1e-2, 3e-2, 3e-2, 3e-2];
        let state: Vec<f64> = (0..8).map(|k| sizes[k as usize] * part(k)).collect();
        let run = integrator.begin(&stretch, &state, false).unwrap();
        let third = integrator.bounds(&run.state, 0, end).third;
        for boundary in [Boundary::Closes, Boundary::Leaves, Boundary::Lifts] {
            let touch = Touch { element: 0, contact: 0, boundary };
            let mut later = run.state.clone();
            let mut distance = |time: f64| {
                integrator.blocks.fly(&run.state, time, &mut later);
                integrator.distance(integrator.element_jet(&later, 0, time), touch).value
            };
            let known = (distance(0.0), third);
            let below = integrator.below_without_fast_blocks(&run.state, (0, touch), known, (0.0, end));
            let Some((below, bounds)) = below else { continue };
            used += 1;
            for t in (0..=2000).map(|i| end * (f64::from(i) / 2000.0).powi(3)) {
                let quadratic = below.value + t * (below.slope - 0.5 * t * bounds.second);
                let cubic = 0.5 * below.curvature - t * bounds.third / 6.0;
                let cubic = below.value + t * (below.slope + t * cubic);
                let most = quadratic.max(cubic);
                assert!(distance(t) >= most - 1e-15, "{case} {boundary:?} {t}: {} {most}", distance(t));
            }
        }
    }
    assert!(used > 100, "{used} of 600");
}
