//! The general integrator where it is tried hardest: rigid modes, states that are zero, stops that act at one
//! instant, every damping.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{assert_agreement, element};
use crate::general_common::{assert_near, diagonal, flow_error, harmonic_force, model, supported};
use faer::Mat;
use hammerbeam_motion::{
    Harmonic, Law, Load, LocalElement, Stretch, System,
    general::{GeneralFlow, GeneralSettings, advance},
    law::{HertzStop, LinearStop, PowerSpring, TwoSidedStop},
};
use hammerbeam_testkit::stride;

const TOLERANCES: [f64; 4] = [1e-6, 1e-8, 1e-10, 1e-12];

#[track_caller]
fn run(system: &System, stretch: &Stretch, state: &[f64], tolerance: f64) -> GeneralFlow {
    advance(system, stretch, state, &GeneralSettings::with_tolerance(tolerance))
        .unwrap_or_else(|error| panic!("at {tolerance:e}: {error}"))
}

fn hertz(stiffness: f64, gap: f64) -> Law {
    Law::Hertz(HertzStop::with_gap(stiffness, gap).unwrap())
}

fn linear(stiffness: f64, gap: f64) -> Law {
    Law::Linear(LinearStop::with_gap(stiffness, gap).unwrap())
}

/// A free mass that flies, touches and flies back: its velocity does not depend on where it starts until it
/// touches. It comes back with its speed, and `det = 1`.
#[test]
fn rigid_modes_reach_their_first_contact() {
    for law in [hertz(1e6, 1e-2), linear(1e4, 1e-2)] {
        let rigid = model(&[0.0], diagonal(&[0.0]));
        let system = System::new(rigid, &Load::default(), vec![element(&[1.0], 0.0, law)]).unwrap();
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 1.0 };
        for tolerance in TOLERANCES {
            let flow = run(&system, &stretch, &[0.0, 0.05], tolerance).flow;
            assert_near(flow.state[1], -0.05, 10.0 * tolerance, "speed");
            assert_near(flow.by_state.determinant(), 1.0, 1e3 * tolerance, "determinant");
        }
    }
}

/// A stretch that ends a few roundings before or behind a touch: what is left behind it may be too short for
/// a step of its own.
#[test]
fn a_touch_may_lie_a_rounding_before_the_end() {
    let law = Law::Linear(LinearStop::with_gap(1e4, 1e-2).unwrap().with_damping(20.0).unwrap());
    let rigid = model(&[0.0], diagonal(&[0.0]));
    let system = System::new(rigid, &Load::default(), vec![element(&[1.0], 0.0, law)]).unwrap();
    for roundings in -60..=60 {
        // 1 cm at 5 cm/s.
        let end = 0.2 + f64::from(roundings) * 0.2 * f64::EPSILON;
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end };
        for tolerance in TOLERANCES {
            let state = run(&system, &stretch, &[0.0, 0.05], tolerance).flow.state;
            assert_near(state[0], 1e-2, 10.0 * tolerance, "place");
        }
    }
}

/// A mass at rest in space that a shaken wall hits: all of its state is zero until then, and so is what it
/// depends on.
#[test]
fn a_mass_at_rest_is_hit_by_a_wall() {
    for law in [hertz(1e6, 1e-3), linear(1e4, 1e-3)] {
        let rigid = supported(model(&[0.0], diagonal(&[0.0])), &[0.0], &[0.0]);
        let support = vec![Harmonic { order: 1, amplitude: 3e-3, phase: 1.5 }.into()];
        let load = Load { support, ..Load::default() };
        let system = System::new(rigid, &load, vec![element(&[1.0], -1.0, law)]).unwrap();
        let stretch = Stretch { frequency_hz: 2.0, start: 0.0, end: 1.0 };
        for tolerance in TOLERANCES {
            assert!(run(&system, &stretch, &[0.0, 0.0], tolerance).counts.crossings >= 2);
        }
        assert_agreement(&system, &stretch, &[0.0, 0.0], 1e-9, "wall");
    }
}

/// Two or three stops at one place are one stop, as stiff as all of them.
#[test]
fn stops_that_act_at_one_instant_are_one_stop() {
    let (stiffness, gap, shape) = (1e6, 1e-3, [1.2, -0.8]);
    let load = Load { support: vec![], forces: vec![harmonic_force(&[0.4, 0.3], 1, 3.0, 0.2)] };
    let stretch = Stretch { frequency_hz: 5.0, start: 0.0, end: 4.0 };
    for law in [hertz, linear] {
        let system = |shares: &[f64]| {
            let stops = shares.iter().map(|share| element(&shape, 0.0, law(share * stiffness, gap)));
            System::new(model(&[30.0, 80.0], diagonal(&[0.4, 0.7])), &load, stops.collect()).unwrap()
        };
        let expected = run(&system(&[1.0]), &stretch, &[0.0, 0.0, 0.3, 0.0], 1e-13);
        for shares in [&[0.5, 0.5][..], &[0.25, 0.5, 0.25]] {
            for tolerance in TOLERANCES {
                let found = run(&system(shares), &stretch, &[0.0, 0.0, 0.3, 0.0], tolerance);
                let error = flow_error(&found.flow, &expected.flow);
                // Each contact amplifies what went before.
                assert!(error < 1e4 * tolerance, "{shares:?} at {tolerance:e}: {error:e}");
                assert_eq!(found.counts.crossings, expected.counts.crossings);
            }
        }
    }
}

/// Mirror images meet their stops at one instant, at mirrored levels, and stay mirror images.
#[test]
fn mirror_images_touch_at_one_instant() {
    let load = Load { support: vec![], forces: vec![harmonic_force(&[1.0, -1.0], 1, 3.0, 0.2)] };
    let stretch = Stretch { frequency_hz: 5.0, start: 0.0, end: 4.0 };
    for law in [hertz, linear] {
        let stops: Vec<LocalElement> =
            vec![element(&[1.0, 0.0], 0.0, law(1e6, 1e-3)), element(&[0.0, -1.0], 0.0, law(1e6, 1e-3))];
        let system = System::new(model(&[30.0, 30.0], diagonal(&[0.4, 0.4])), &load, stops.clone()).unwrap();
        for tolerance in TOLERANCES {
            let GeneralFlow { flow, counts, .. } = run(&system, &stretch, &[0.0, 0.0, 0.1, -0.1], tolerance);
            assert_near(flow.state[0] + flow.state[1], 0.0, 1e-12, "mirrored displacements");
            assert!(counts.crossings >= 8, "{counts:?}");
        }
    }
}

/// Numbers between -1 and 1 that look random.
fn numbers(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

fn any_law(kind: usize, next: &mut impl FnMut() -> f64) -> Law {
    let gap = 1e-3 * (1.05 + next());
    match kind {
        0 => hertz(10f64.powf(6.0 + 3.0 * next()), gap),
        1 => linear(10f64.powf(4.0 + 2.0 * next()), gap),
        2 => Law::TwoSided(TwoSidedStop::new(1e4, gap, 0.0).unwrap()),
        3 => Law::Power(PowerSpring::cubic(1e6 * (1.01 + next())).unwrap()),
        4 => Law::Hertz(HertzStop::with_preload(1e6, 3.0).unwrap()),
        _ => Law::Linear(LinearStop::with_preload(1e5, 2.0).unwrap()),
    }
}

/// One to four modes, every third time a rigid one; dampers from none to far beyond critical, coupling all
/// modes; one to three elements.
fn any_system(case: usize, next: &mut impl FnMut() -> f64) -> System {
    let n = 1 + case % 4;
    let rigid = |mode: usize| mode == 0 && case.is_multiple_of(3);
    let frequencies: Vec<f64> =
        (0..n).map(|i| if rigid(i) { 0.0 } else { 20.0 * (i as f64 + 1.0) * (1.5 + next()) }).collect();
    let mut row = |_: usize| -> Vec<f64> { (0..n).map(|_| next()).collect() };
    let (damper, inertia, push, weight) = (row(0), row(1), row(2), row(3));
    let shapes: Vec<Vec<f64>> = (0..1 + case % 3).map(&mut row).collect();
    let strength = [0.0, 1.0, 30.0, 1000.0][case / 4 % 4];
    let damping = Mat::from_fn(n, n, |i, j| {
        strength * damper[i] * damper[j] + if i == j { 0.04 * frequencies[i] } else { 0.0 }
    });
    let elements = shapes
        .iter()
        .enumerate()
        .map(|(e, shape)| {
            let ratio = next();
            element(shape, ratio, any_law((case / 7 + e) % 6, next))
        })
        .collect();
    let load = Load {
        support: vec![Harmonic { order: 1, amplitude: 2e-3, phase: next() }.into()],
        forces: vec![harmonic_force(&push, 1, 2.0, 0.0), harmonic_force(&weight, 0, 0.3, 0.0)],
    };
    System::new(supported(model(&frequencies, damping), &inertia, &vec![0.0; n]), &load, elements).unwrap()
}

/// Every kind of mode, damping, load and element at once, from rest: both integrators agree, at any tolerance
/// of the general one. By default a fifth of 200 systems.
#[test]
fn every_kind_of_system_is_integrated() {
    let mut next = numbers(1);
    let (mut contacts, mut compared) = (0, 0);
    // All are drawn, so that a sample holds the same systems as the whole set.
    let cases = (0..200).map(|case| {
        let system = any_system(case, &mut next);
        let state: Vec<f64> = (0..2 * system.dof()).map(|_| 1e-5 * next()).collect();
        (case, system, state)
    });
    let cases: Vec<_> = cases.step_by(stride(5)).collect();
    let count = cases.len() as u32;
    for (case, system, state) in cases {
        let stretch = Stretch { frequency_hz: 6.0, start: 0.0, end: 2.0 };
        for tolerance in TOLERANCES {
            let counts = run(&system, &stretch, &state, tolerance).counts;
            assert!(counts.steps < 1000 + 40 * counts.crossings, "case {case} at {tolerance:e}: {counts:?}");
        }
        let mut exact = crate::common::integrator(&system);
        // That one gives up now and then, where contacts begin within rounding of the start.
        if let Ok(expected) = exact.flow(&stretch, &state) {
            let found = run(&system, &stretch, &state, 1e-12).flow;
            let error = crate::common::difference(&system, &stretch, &found, &expected).largest();
            assert!(error < 1e-7, "case {case}: {error:e}");
            contacts += exact.touches().iter().sum::<u32>();
            compared += 1;
        }
    }
    let enough = compared * 10 > 9 * count && contacts > 5 * count;
    assert!(enough, "{compared} of {count} compared, {contacts} contacts");
}

/// Six periods of the paper's beam in one stretch are six stretches of one.
#[test]
fn a_long_stretch_is_the_product_of_its_parts() {
    let system = crate::common::paper_beam();
    let start = crate::common::settled(&system, 36.0, 50, 0.0);
    let whole = run(&system, &Stretch { frequency_hz: 36.0, start: 0.0, end: 6.0 }, &start, 1e-12).flow;
    let (mut state, mut product) = (start, Mat::<f64>::identity(12, 12));
    for cycle in 0..6 {
        let start = f64::from(cycle);
        let flow = run(&system, &Stretch { frequency_hz: 36.0, start, end: start + 1.0 }, &state, 1e-12).flow;
        (state, product) = (flow.state, &flow.by_state * &product);
    }
    let scale = product.norm_max();
    assert!((&whole.by_state - &product).norm_max() < 1e-8 * scale);
    assert!(crate::general_common::column_error(&whole.state, &state) < 1e-8);
}

/// `q = sin(w t)` just touches its level, at any place within a step, borders included. The touch lasts `2
/// acos(1 - depth) / w`.
#[test]
fn short_touches_are_found_wherever_they_fall() {
    let w = 3.0;
    let rate = std::f64::consts::TAU;
    for depth in [1e-6, 1e-8] {
        let stop = element(&[1.0], 0.0, linear(1e-3, 1.0 - depth));
        let system = System::new(model(&[w], diagonal(&[0.0])), &Load::default(), vec![stop]).unwrap();
        for place in 0..300 {
            let angle = 1e-2 * f64::from(place) - 2.0;
            let stretch =
                Stretch { frequency_hz: w / rate, start: 0.0, end: 0.6 + 1e-3 * f64::from(place % 7) };
            let found = run(&system, &stretch, &[angle.sin(), w * angle.cos()], 1e-12).counts;
            let end = angle + rate * stretch.end;
            // Tops at a quarter of a turn, and a whole one later; those within the touch of an end do not
            // count.
            let top = 0.25 * rate;
            let near = |at: f64| ((at - top) / rate - ((at - top) / rate).round()).abs() < 1e-3;
            if !near(angle) && !near(end) {
                let tops = ((end - top) / rate).floor() - ((angle - top) / rate).floor();
                assert_eq!(found.crossings, 2 * tops as usize, "depth {depth:e} from {angle}");
            }
        }
    }
}
