//! The exact integrator against the general one: kinds of elements, loads and modes, and several elements at
//! once.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{assert_agreement, diagonal, element, force, formula, hertz, model, settled};
use faer::Mat;
use hammerbeam_motion::{
    Harmonic, Law, Load, LocalElement, Stretch, System,
    general::{GeneralSettings, advance},
    law::{HertzStop, LinearStop, PowerSpring, TwoSidedStop},
    start_reach,
};
use hammerbeam_structure::{ReducedModel, SupportInput};

const BOUND: f64 = 1e-9;
const FREQUENCIES: [f64; 4] = [TAU * 7.0, TAU * 31.0, TAU * 90.0, TAU * 260.0];
const TIP: [f64; 4] = [2.0, -1.6, 1.3, -0.9];
const MIDDLE: [f64; 4] = [0.7, 1.1, -0.4, -1.2];

/// Four modes, lightly damped unless said otherwise, on a support that can move.
fn structure(damping: Mat<f64>) -> ReducedModel {
    let support = SupportInput { inertia: vec![0.4, 0.2, -0.1, 0.05], damping: vec![0.3, -0.2, 0.4, 0.1] };
    ReducedModel { supports: vec![support], ..model(&FREQUENCIES, damping) }
}

fn light() -> Mat<f64> {
    crate::common::modal_damping(&FREQUENCIES, 0.02)
}

fn coupled() -> Mat<f64> {
    let damper = [0.8, -0.9, 1.1, 0.7];
    Mat::from_fn(4, 4, |i, j| 9.0 * damper[i] * damper[j] + if i == j { 0.02 * FREQUENCIES[i] } else { 0.0 })
}

/// Several orders and phases of support motion and forces, with gravity.
fn rich_load() -> Load {
    Load {
        support: vec![
            Harmonic { order: 1, amplitude: 1.2e-3, phase: 0.4 }.into(),
            Harmonic { order: 3, amplitude: 1e-4, phase: -1.0 }.into(),
        ],
        forces: vec![
            force(&[0.5, 0.3, 0.2, 0.1], 0, -1.5, 0.0),
            force(&MIDDLE, 2, 1.5, 2.0),
            force(&TIP, 1, 2.0, -0.7),
        ],
    }
}

fn negative(shape: [f64; 4]) -> [f64; 4] {
    shape.map(|phi| -phi)
}

fn check(model: ReducedModel, load: &Load, elements: Vec<LocalElement>, what: &str) -> u32 {
    let system = System::new(model, load, elements).unwrap();
    let frequency_hz = 11.0;
    let state = settled(&system, frequency_hz, 12, 0.15);
    let stretch = Stretch { frequency_hz, start: 0.15, end: 1.15 };
    assert_agreement(&system, &stretch, &state, BOUND, what)
}

/// Every law, with stops on either side, riding on the support, fixed in space, or taking part of its motion.
#[test]
fn every_law_agrees_on_either_side_and_any_support() {
    let laws = [
        hertz(1e8, 0.0),
        hertz(1e7, 5e-4),
        Law::Hertz(HertzStop::with_preload(1e7, 2.0).unwrap()),
        Law::Linear(LinearStop::with_gap(1e5, 3e-4).unwrap()),
        Law::Linear(LinearStop::with_preload(3e4, 5.0).unwrap()),
        Law::TwoSided(TwoSidedStop::new(1e5, 1e-3, 2e-3).unwrap()),
        Law::Power(PowerSpring::cubic(1e9).unwrap()),
        Law::Power(PowerSpring::cubic(-1e5).unwrap()),
        formula("40*v*(1e6*x^2 - 1) + 1e5*sin(x)"),
        formula("2e4*x*exp(30*x) + 5*tanh(20*v)"),
    ];
    for law in laws {
        for (shape, support_ratio) in [(TIP, 0.0), (negative(TIP), 0.0), (TIP, 1.0), (negative(TIP), -0.6)] {
            for damping in [light(), coupled()] {
                let what = format!("{law:?} {shape:?} {support_ratio}");
                let elements = vec![element(&shape, support_ratio, law.clone())];
                let contacts = check(structure(damping), &rich_load(), elements, &what);
                assert!(contacts > 0 || law.contacts().is_empty(), "{what}: no contact");
            }
        }
    }
}

#[test]
fn several_elements_at_once_agree() {
    let cubic = Law::Power(PowerSpring::cubic(3e8).unwrap());
    let between: Vec<f64> = TIP.iter().zip(&MIDDLE).map(|(a, b)| a - b).collect();
    let cases = [
        (
            "two sides of one point",
            vec![element(&TIP, 0.0, hertz(1e8, 5e-4)), element(&negative(TIP), 0.0, hertz(1e7, 1e-3))],
        ),
        ("two points", vec![element(&TIP, 0.0, hertz(1e8, 2e-4)), element(&MIDDLE, 1.0, hertz(1e8, 1e-4))]),
        (
            "a cubic spring and a Hertz stop",
            vec![element(&TIP, 0.0, cubic.clone()), element(&TIP, 0.0, hertz(1e8, 2e-4))],
        ),
        ("between two points", vec![element(&between, 0.0, hertz(1e8, 2e-4))]),
        (
            "four laws",
            vec![
                element(&TIP, 0.0, hertz(1e7, 5e-4)),
                element(&MIDDLE, 0.0, Law::Linear(LinearStop::with_gap(1e5, 2e-4).unwrap())),
                element(&between, 0.0, cubic),
                element(&MIDDLE, 1.0, Law::TwoSided(TwoSidedStop::new(2e4, 5e-4, 5e-4).unwrap())),
            ],
        ),
    ];
    for (what, elements) in cases {
        for damping in [light(), coupled()] {
            assert!(
                check(structure(damping), &rich_load(), elements.clone(), what) > 0,
                "{what}: no contact"
            );
        }
    }
}

/// Both close and open at the same instants.
#[test]
fn two_equal_stops_act_as_one_of_twice_the_stiffness() {
    let frequency_hz = 11.0;
    for damping in [light(), coupled()] {
        let with = |elements| System::new(structure(damping.clone()), &rich_load(), elements).unwrap();
        let one = with(vec![element(&TIP, 0.0, hertz(2e8, 2e-4))]);
        let two = with(vec![element(&TIP, 0.0, hertz(1e8, 2e-4)), element(&TIP, 0.0, hertz(1e8, 2e-4))]);
        let state = settled(&one, frequency_hz, 12, 0.15);
        let stretch = Stretch { frequency_hz, start: 0.15, end: 1.15 };
        let (mut one, mut two) = (crate::common::integrator(&one), crate::common::integrator(&two));
        let expected = one.flow(&stretch, &state).unwrap();
        let found = two.flow(&stretch, &state).unwrap();
        let error = crate::common::difference(two.system(), &stretch, &found, &expected);
        assert!(error.largest() < BOUND, "{error:?}");
        assert!(one.touches()[0] > 0 && two.touches() == [one.touches()[0]; 2], "{:?}", two.touches());
    }
}

fn bouncing(frequencies: [f64; 4], damping: [f64; 4]) -> System {
    let structure = ReducedModel {
        natural_frequencies: frequencies.to_vec(),
        damping: diagonal(&damping),
        ..structure(light())
    };
    System::new(structure, &rich_load(), vec![element(&negative(TIP), 0.0, hertz(1e7, 1e-4))]).unwrap()
}

const START: [f64; 8] = [1e-3, -1e-4, 1e-5, 0.0, 0.02, 0.01, 0.0, 0.0];
const BOUNCES: Stretch = Stretch { frequency_hz: 11.0, start: 0.1, end: 1.4 };

#[test]
fn every_kind_of_damping_agrees() {
    let [a, b, c, d] = FREQUENCIES;
    let cases = [
        ("undamped", [0.0; 4]),
        ("critically damped", [2.0 * a, 2.0 * b, 0.1 * c, 2.0 * d]),
        ("nearly critical", [2.0 * a * (1.0 + 1e-9), 2.0 * b * (1.0 - 1e-9), 0.1 * c, 0.1 * d]),
        ("overdamped", [3.0 * a, 4.0 * b, 50.0 * c, 0.1 * d]),
    ];
    for (what, damping) in cases {
        let contacts = assert_agreement(&bouncing(FREQUENCIES, damping), &BOUNCES, &START, BOUND, what);
        assert!(contacts > 0, "{what}: no contact");
    }
}

/// States only: the general integrator measures its errors by the sensitivities met so far, and the
/// velocities of a rigid-body displacement are exactly zero up to the first contact.
#[test]
fn rigid_body_modes_agree() {
    let [_, b, c, d] = FREQUENCIES;
    let cases = [
        ("rigid", [0.0, b, c, d], [0.0, 0.1 * b, 0.1 * c, 0.1 * d]),
        ("damped rigid", [0.0, b, c, d], [5.0, 0.1 * b, 0.1 * c, 0.1 * d]),
        ("two rigid", [0.0, 0.0, c, d], [0.0, 3.0, 0.1 * c, 0.1 * d]),
    ];
    for (what, frequencies, damping) in cases {
        let system = bouncing(frequencies, damping);
        let mut exact = crate::common::integrator(&system);
        let found = exact.advance(&BOUNCES, &START).unwrap();
        assert!(exact.touches()[0] > 0, "{what}: no contact");
        let settings = GeneralSettings::with_tolerance(1e-12).state_only();
        let expected = advance(&system, &BOUNCES, &START, &settings).unwrap().flow.state;
        for i in 0..8 {
            let bound = if i < 4 { 1e-12 } else { 1e-10 };
            assert!((found[i] - expected[i]).abs() < bound, "{what}: {} against {}", found[i], expected[i]);
        }
    }
}

/// Loads on, and very near, undamped eigenfrequencies.
#[test]
fn loads_on_eigenfrequencies_agree() {
    let frequency_hz = 11.0;
    for offset in [0.0, 1e-12, 1e-8, -3e-5, 1e-3] {
        for damping in [0.0, 1e-3, 1e-9] {
            let mut frequencies = FREQUENCIES;
            frequencies[1] = TAU * frequency_hz * 3.0 * (1.0 + offset);
            frequencies[0] = TAU * frequency_hz * (1.0 - offset);
            let structure = ReducedModel {
                natural_frequencies: frequencies.to_vec(),
                damping: diagonal(&[damping; 4]),
                ..structure(light())
            };
            let elements = vec![element(&TIP, 0.3, hertz(1e7, 1e-3))];
            let system = System::new(structure, &rich_load(), elements).unwrap();
            let state = [1e-4, -1e-4, 1e-5, 0.0, 0.02, 0.01, 0.0, 0.0];
            let stretch = Stretch { frequency_hz, start: 0.2, end: 2.4 };
            let contacts = assert_agreement(
                &system,
                &stretch,
                &state,
                BOUND,
                &format!("offset {offset:e}, damping {damping:e}"),
            );
            assert!(contacts > 0);
        }
    }
}

/// Of one mode the nearest open stop is at the velocity `gap max(w, 2 pi f)`. No periodic motion is faster
/// than the load over the damping, and stops that touch at rest need no reaching.
#[test]
fn every_second_start_reaches_for_a_gap_that_the_linear_motion_does_not_come_to() {
    let (w, frequency_hz, load, damping) = (TAU * 3.0, 5.0, 40.0, 2.0);
    let reaches = |gaps: &[f64], linear: f64, damping: f64| {
        let linear_stop = |gap: &f64| Law::Linear(LinearStop::with_gap(100.0, *gap).unwrap());
        let elements = gaps.iter().map(|gap| element(&[2.0], 0.0, linear_stop(gap))).collect();
        let load = Load { support: vec![], forces: vec![force(&[1.0], 1, load, 0.0)] };
        let system = System::new(model(&[w], diagonal(&[damping])), &load, elements).unwrap();
        [0, 1, 2, 3, 4, 5].map(|start| start_reach(&system, frequency_hz, linear, start))
    };
    let about = |linear: f64| [0.5, 1.0, 2.0, 4.0, 8.0, 16.0].map(|reach| reach * linear);
    let to_gap = 0.3 / 2.0 * TAU * frequency_hz;
    let small = to_gap / 17.0;
    let found = reaches(&[0.4, 0.3, 0.0], small, damping);
    for (k, (found, about)) in found.into_iter().zip(about(small)).enumerate() {
        let expected = if k % 2 == 0 { about } else { [0.5, 1.0, 2.0][k / 2] * to_gap };
        assert!((found / expected - 1.0).abs() < 1e-14, "{k}: {found} {expected}");
    }
    // Near enough; no open stop; too far for the load; without damping.
    assert_eq!(reaches(&[0.4, 0.3], to_gap / 15.0, damping), about(to_gap / 15.0));
    assert_eq!(reaches(&[0.0], small, damping), about(small));
    assert_eq!(reaches(&[0.3], small, load / to_gap * 1.01), about(small));
    assert_eq!(reaches(&[0.3], small, 0.0), about(small));
}
