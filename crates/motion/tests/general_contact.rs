//! The general integrator through contacts: sensitivities against differences, closed forms, and invariants.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use std::f64::consts::{PI, TAU};

use crate::general_common::{
    assert_columns_close, assert_near, diagonal, difference, flow_error, harmonic_force, model, supported,
};
use hammerbeam_motion::{
    Flow, Harmonic, Law, Load, LocalElement, Stretch, System,
    general::{GeneralFlow, GeneralSettings, advance, sample},
    law::{Formula, HertzStop, LinearStop, PowerSpring, TwoSidedStop},
};

const STRETCH: Stretch = Stretch { frequency_hz: 4.0, start: 0.1, end: 1.85 };
const STATE: [f64; 4] = [-2e-3, 1e-3, 0.15, 0.02];

fn element(shape: &[f64], support_ratio: f64, law: Law) -> LocalElement {
    LocalElement { name: "stop".into(), shape: shape.to_vec(), support_ratios: vec![support_ratio], law }
}

/// Two modes of 3.5 and 19 Hz on a shaken support, under gravity, with one local element.
fn two_modes(support_ratio: f64, law: Law) -> System {
    let damping = faer::Mat::from_fn(2, 2, |i, j| [[0.8, 0.3], [0.3, 2.5]][i][j]);
    let model = supported(model(&[TAU * 3.5, TAU * 19.0], damping), &[0.9, -0.4], &[0.7, 0.2]);
    let support = vec![
        Harmonic { order: 1, amplitude: 1.5e-3, phase: 0.4 }.into(),
        Harmonic { order: 2, amplitude: 2e-4, phase: -1.0 }.into(),
    ];
    let forces = vec![harmonic_force(&[0.2, 0.1], 0, -1.0, 0.0), harmonic_force(&[0.3, -0.5], 3, 0.5, 2.0)];
    System::new(model, &Load { support, forces }, vec![element(&[1.4, -1.1], support_ratio, law)]).unwrap()
}

fn laws() -> [Law; 7] {
    [
        Law::Hertz(HertzStop::with_gap(5e6, 0.0).unwrap()),
        Law::Hertz(HertzStop::with_preload(5e6, 3.0).unwrap()),
        Law::Linear(LinearStop::with_gap(3e5, 1e-3).unwrap()),
        Law::Linear(LinearStop::with_preload(2e4, 8.0).unwrap()),
        Law::TwoSided(TwoSidedStop::new(8e4, 1e-3, 2e-3).unwrap()),
        Law::Power(PowerSpring::cubic(1e8).unwrap()),
        Law::Formula(Formula::new("1e4*x + 60*sin(400*x) + 1e5*x^2", &[]).unwrap()),
    ]
}

fn run(system: &System, stretch: &Stretch, state: &[f64], tolerance: f64) -> GeneralFlow {
    advance(system, stretch, state, &GeneralSettings::with_tolerance(tolerance)).unwrap()
}

fn end_state(system: &System, stretch: &Stretch, state: &[f64]) -> Vec<f64> {
    let settings = GeneralSettings::with_tolerance(1e-13).state_only();
    advance(system, stretch, state, &settings).unwrap().flow.state
}

fn assert_sensitivities(system: &System, flow: &Flow, bound: f64) {
    for j in 0..4 {
        let column: Vec<f64> = (0..4).map(|i| flow.by_state[(i, j)]).collect();
        let differences = difference(if j < 2 { 3e-7 } else { 1e-5 }, |step| {
            let mut state = STATE;
            state[j] += step;
            end_state(system, &STRETCH, &state)
        });
        assert_columns_close(&column, &differences, bound);
    }
    let differences = difference(1e-4, |step| {
        let frequency_hz = STRETCH.frequency_hz + step;
        end_state(system, &Stretch { frequency_hz, ..STRETCH }, &STATE)
    });
    assert_columns_close(&flow.by_frequency, &differences, bound);
}

#[test]
fn sensitivities_agree_with_differences_for_every_law() {
    for law in laws() {
        for support_ratio in [0.0, 1.0, -0.6] {
            let system = two_modes(support_ratio, law.clone());
            let GeneralFlow { flow, counts, .. } = run(&system, &STRETCH, &STATE, 1e-12);
            let stops = !law.contacts().is_empty();
            assert!(!stops || counts.crossings >= 2, "{law:?} {support_ratio}: {counts:?}");
            assert_sensitivities(&system, &flow, 2e-6);
        }
    }
}

/// `det(by_state) = exp(-T tr C)`: elastic stops leave volumes alone.
#[test]
fn contacts_leave_volumes_alone() {
    for law in laws() {
        let flow = run(&two_modes(1.0, law), &STRETCH, &STATE, 1e-12).flow;
        let expected = (-3.3 * STRETCH.duration()).exp();
        assert_near(flow.by_state.determinant() / expected, 1.0, 1e-9, "determinant");
    }
}

/// Each of the contacts amplifies what went before: up to 120 tolerances at the end, at every tolerance.
#[test]
fn errors_follow_the_tolerance_through_contacts() {
    for law in laws() {
        let system = two_modes(0.0, law.clone());
        let exact = run(&system, &STRETCH, &STATE, 1e-14).flow;
        for tolerance in [1e-7, 1e-9, 1e-11] {
            let GeneralFlow { flow, counts, .. } = run(&system, &STRETCH, &STATE, tolerance);
            let error = flow_error(&flow, &exact);
            assert!(error < 300.0 * tolerance, "{law:?} at {tolerance:e}: {error:e}, {counts:?}");
        }
    }
}

/// Unit mass on 1 N/m one way and 2 N/m the other: `T = pi + pi / sqrt(2)`.
#[test]
fn the_bilinear_oscillator_returns_after_its_period() {
    let stop = element(&[1.0], 0.0, Law::Linear(LinearStop::with_gap(1.0, 0.0).unwrap()));
    let system = System::new(model(&[1.0], diagonal(&[0.0])), &Load::default(), vec![stop]).unwrap();
    let period = PI + PI / 2.0_f64.sqrt();
    let stretch = Stretch { frequency_hz: 1.0 / period, start: 0.0, end: 1.0 };
    let GeneralFlow { flow, counts, .. } = run(&system, &stretch, &[-0.3, 0.4], 1e-12);
    assert_columns_close(&flow.state, &[-0.3, 0.4], 1e-11);
    assert_eq!(counts.crossings, 2);
    for i in 0..2 {
        for j in 0..2 {
            assert_near(flow.by_state[(i, j)], f64::from(u8::from(i == j)), 1e-11, "monodromy");
        }
    }
}

/// `v^2 / 2 + w^2 q^2 / 2 + 2/5 k p^2.5` through ten bounces on a Hertz stop.
#[test]
fn energy_is_kept_through_bounces_on_a_hertz_stop() {
    let stiffness = 1e6;
    let stop = element(&[1.0], 0.0, Law::Hertz(HertzStop::with_gap(stiffness, 1e-3).unwrap()));
    let system = System::new(model(&[10.0], diagonal(&[0.0])), &Load::default(), vec![stop]).unwrap();
    let energy = |state: &[f64]| {
        let penetration = (state[0] - 1e-3).max(0.0);
        0.5 * state[1].powi(2) + 50.0 * state[0].powi(2) + 0.4 * stiffness * penetration.powf(2.5)
    };
    let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 3.5 };
    let phases: Vec<f64> = (0..=700).map(|k| 0.005 * f64::from(k)).collect();
    let settings = GeneralSettings::with_tolerance(1e-12);
    let states = sample(&system, &stretch, &[0.0, 0.5], &phases, &settings).unwrap();
    assert!(states.iter().filter(|state| state[0] > 1e-3).count() > 10);
    for state in &states {
        assert_near(energy(state), 0.125, 1e-9, "energy");
    }
}

/// A stop that never opens is a spring: `w^2 + k phi^2`, once its preload is balanced.
#[test]
fn a_stop_under_heavy_preload_is_a_linear_spring() {
    let stop = element(&[2.0], 0.0, Law::Linear(LinearStop::with_preload(100.0, 50.0).unwrap()));
    let load = Load { support: vec![], forces: vec![harmonic_force(&[2.0], 0, 50.0, 0.0)] };
    let preloaded = System::new(model(&[15.0], diagonal(&[1.0])), &load, vec![stop]).unwrap();
    let stiffened = System::new(model(&[25.0], diagonal(&[1.0])), &Load::default(), vec![]).unwrap();
    let stretch = Stretch { frequency_hz: 2.0, start: 0.0, end: 3.0 };
    let (a, b) =
        (run(&preloaded, &stretch, &[0.1, 1.0], 1e-12), run(&stiffened, &stretch, &[0.1, 1.0], 1e-12));
    assert_eq!(a.counts.crossings, 0);
    assert!(flow_error(&a.flow, &b.flow) < 1e-11, "{:e}", flow_error(&a.flow, &b.flow));
}

/// `q = sin(w t)` touches a level just below its amplitude for a moment only.
#[test]
fn short_touches_are_found() {
    for depth in [1e-3, 1e-6, 1e-9] {
        let stop = element(&[1.0], 0.0, Law::Linear(LinearStop::with_gap(10.0, 1.0 - depth).unwrap()));
        let system = System::new(model(&[TAU], diagonal(&[0.0])), &Load::default(), vec![stop]).unwrap();
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 0.9 };
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let counts = run(&system, &stretch, &[0.0, TAU], tolerance).counts;
            let resolved = depth > 1e3 * tolerance;
            assert!(!resolved || counts.crossings == 2, "depth {depth:e} at {tolerance:e}: {counts:?}");
            assert!(counts.crossings <= 6, "depth {depth:e} at {tolerance:e}: {counts:?}");
        }
    }
}

/// Touching the level at the start, moving in and moving out; the half wave in contact lasts `pi / sqrt(w^2 +
/// k)`.
#[test]
fn a_motion_may_begin_on_the_level() {
    let stop = element(&[1.0], 0.0, Law::Linear(LinearStop::with_gap(15.0, 0.0).unwrap()));
    let system = System::new(model(&[1.0], diagonal(&[0.0])), &Load::default(), vec![stop]).unwrap();
    let half = |end: f64| Stretch { frequency_hz: 1.0, start: 0.0, end };
    let inwards = run(&system, &half(PI / 4.0), &[0.0, 1.0], 1e-12);
    assert_columns_close(&[inwards.flow.state[0] + 1.0, inwards.flow.state[1]], &[1.0, -1.0], 1e-11);
    let outwards = run(&system, &half(PI), &[0.0, -1.0], 1e-12);
    assert_columns_close(&[outwards.flow.state[0] + 1.0, outwards.flow.state[1]], &[1.0, 1.0], 1e-11);
    assert!(inwards.counts.crossings <= 1 && outwards.counts.crossings <= 1);
}

#[test]
fn rest_on_the_level_stays_at_rest() {
    for law in [
        Law::Hertz(HertzStop::with_gap(1e6, 0.0).unwrap()),
        Law::Linear(LinearStop::with_gap(1e3, 0.0).unwrap()),
        Law::TwoSided(TwoSidedStop::new(1e3, 0.0, 0.0).unwrap()),
    ] {
        let system =
            System::new(model(&[5.0], diagonal(&[0.1])), &Load::default(), vec![element(&[1.0], 0.0, law)])
                .unwrap();
        let GeneralFlow { flow, counts, .. } =
            run(&system, &Stretch { frequency_hz: 1.0, start: 0.0, end: 2.0 }, &[0.0, 0.0], 1e-10);
        assert_eq!(flow.state, [0.0, 0.0]);
        assert!(counts.steps < 60, "{counts:?}");
    }
}

/// Without clearance a two-sided stop is a spring: `w^2 + k` throughout.
#[test]
fn a_two_sided_stop_without_clearance_is_a_linear_spring() {
    let stop = element(&[1.0], 0.0, Law::TwoSided(TwoSidedStop::new(75.0, 0.0, 0.0).unwrap()));
    let system = System::new(model(&[5.0], diagonal(&[0.1])), &Load::default(), vec![stop]).unwrap();
    let spring = System::new(model(&[10.0], diagonal(&[0.1])), &Load::default(), vec![]).unwrap();
    let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 2.0 };
    let (a, b) = (run(&system, &stretch, &[0.1, 1.0], 1e-12), run(&spring, &stretch, &[0.1, 1.0], 1e-12));
    assert!(flow_error(&a.flow, &b.flow) < 1e-11, "{:e}", flow_error(&a.flow, &b.flow));
}

/// Pushed from rest on the level: `q'' = F - w^2 q` one way, `q'' = F - (w^2 + k) q` the other.
#[test]
fn a_load_moves_a_structure_off_the_level_it_rests_on() {
    let stop = Law::Linear(LinearStop::with_gap(75.0, 0.0).unwrap());
    for (force, stiffness) in [(2.0, 100.0_f64), (-2.0, 25.0)] {
        let load = Load { support: vec![], forces: vec![harmonic_force(&[1.0], 0, force, 0.0)] };
        let system =
            System::new(model(&[5.0], diagonal(&[0.0])), &load, vec![element(&[1.0], 0.0, stop.clone())])
                .unwrap();
        let time = 0.2;
        let stretch = Stretch { frequency_hz: 2.0, start: 0.0, end: 2.0 * time };
        let flow = run(&system, &stretch, &[0.0, 0.0], 1e-12).flow;
        let w = stiffness.sqrt();
        let exact = [force / stiffness * (1.0 - (w * time).cos()), force / w * (w * time).sin()];
        assert_columns_close(&flow.state, &exact, 1e-11);
        assert_near(flow.by_state[(0, 0)], (w * time).cos(), 1e-6, "by state"); // one-sided at the level
    }
}

#[test]
fn the_next_step_spares_the_search_for_the_first() {
    let system = two_modes(0.0, laws()[5].clone());
    let first = run(&system, &STRETCH, &STATE, 1e-10);
    let next = Stretch { start: STRETCH.end, end: STRETCH.end + 0.5, ..STRETCH };
    let settings = GeneralSettings { first_step: Some(first.next_step), ..GeneralSettings::default() };
    let resumed = advance(&system, &next, &first.flow.state, &settings).unwrap();
    let fresh = advance(&system, &next, &first.flow.state, &GeneralSettings::default()).unwrap();
    assert!(resumed.counts.evaluations < fresh.counts.evaluations);
    assert!(flow_error(&resumed.flow, &fresh.flow) < 1e-8);
}

/// Work as it came out; more of it is a slow-down that no clock shows.
#[test]
fn work_through_eight_crossings_of_a_hertz_stop_does_not_grow() {
    let counts = run(&two_modes(0.0, laws()[0].clone()), &STRETCH, &STATE, 1e-9).counts;
    assert_eq!(counts.crossings, 8);
    assert!(counts.steps <= 345 && counts.rejected <= 120 && counts.evaluations <= 5800, "{counts:?}");
}
