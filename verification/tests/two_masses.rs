//! Two masses on springs and dampers, a one-sided spring between them that acts when they come closer than a
//! gap.
//!
//! | quantity | first | second |
//! |---|---|---|
//! | mass | 1.0 kg | 0.6 kg |
//! | spring to the ground | 400 N/m | 900 N/m |
//! | damper to the ground | 1.6 N s/m | 1.2 N s/m |
//! | force | 5 cos(2 pi f t) N | none |
//!
//! The spring of `k` N/m pushes with `k (x1 - x2 - gap)` where that is positive. There is no closed form; the
//! comparisons are an own shooting with the classical Runge-Kutta method in physical coordinates, the energy
//! balance of a period, and the linear response as `k` tends to zero.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::TAU;

use crate::common::{ObservedSystem, force_at, masses, response_of};
use approx::assert_abs_diff_eq;
use hammerbeam_motion::{
    Law, Load, LocalElement, Stretch, System,
    general::{GeneralSettings, sample},
    law::LinearStop,
};
use hammerbeam_orbit::{OrbitSettings, PeriodicSolution, find_start};
use hammerbeam_structure::GROUND;

const MASSES: [f64; 2] = [1.0, 0.6];
const SPRINGS: [f64; 2] = [400.0, 900.0];
const DAMPERS: [f64; 2] = [1.6, 1.2];
const FORCE: f64 = 5.0;
const GAP: f64 = 2e-3;

/// Displacements and velocities `[x1, x2, v1, v2]`.
type State = [f64; 4];

fn rig(stiffness: f64) -> ObservedSystem {
    let model = masses(
        &[("first", MASSES[0]), ("second", MASSES[1])],
        &[("first", GROUND, SPRINGS[0]), ("second", GROUND, SPRINGS[1])],
        &[("first", GROUND, DAMPERS[0]), ("second", GROUND, DAMPERS[1])],
        false,
    );
    let (first, second) = (model.point("first").unwrap(), model.point("second").unwrap());
    let between = LocalElement {
        name: "between".into(),
        shape: first.shape.iter().zip(&second.shape).map(|(a, b)| a - b).collect(),
        support_ratios: vec![0.0],
        law: Law::Linear(LinearStop::with_gap(stiffness, GAP).unwrap()),
    };
    let load = Load { support: vec![], forces: vec![force_at(&model, "first", 1, FORCE)] };
    let response = response_of(&model, "first");
    ObservedSystem { system: System::new(model, &load, vec![between]).unwrap(), response }
}

fn orbit(rig: &ObservedSystem, frequency_hz: f64) -> PeriodicSolution {
    find_start(&rig.system, &rig.response, frequency_hz, 1, &OrbitSettings::default()).unwrap()
}

/// Physical state of a modal one.
fn physical(rig: &ObservedSystem, state: &[f64]) -> State {
    let read = |name: &str, part: &[f64]| -> f64 {
        rig.system.model().point(name).unwrap().shape.iter().zip(part).map(|(phi, q)| phi * q).sum()
    };
    let (q, v) = state.split_at(2);
    [read("first", q), read("second", q), read("first", v), read("second", v)]
}

/// The equations of motion, written down once more.
fn rate(stiffness: f64, phase: f64, [x1, x2, v1, v2]: State) -> State {
    let push = stiffness * (x1 - x2 - GAP).max(0.0);
    let load = FORCE * (TAU * phase).cos();
    let first = (load - SPRINGS[0] * x1 - DAMPERS[0] * v1 - push) / MASSES[0];
    let second = (push - SPRINGS[1] * x2 - DAMPERS[1] * v2) / MASSES[1];
    [v1, v2, first, second]
}

/// One period by the classical Runge-Kutta method.
///
/// A step across the onset or the release, where the slope of the force jumps by `k`, errs by less than `k v
/// h^2 / m`: 1e-10 m/s here.
fn period(stiffness: f64, frequency_hz: f64, mut state: State) -> State {
    const STEPS: u32 = 400_000;
    let h = 1.0 / (frequency_hz * f64::from(STEPS));
    let along = |state: State, factor: f64, slope: State| -> State {
        std::array::from_fn(|i| state[i] + factor * slope[i])
    };
    for step in 0..STEPS {
        let phase = |part: f64| (f64::from(step) + part) / f64::from(STEPS);
        let a = rate(stiffness, phase(0.0), state);
        let b = rate(stiffness, phase(0.5), along(state, 0.5 * h, a));
        let c = rate(stiffness, phase(0.5), along(state, 0.5 * h, b));
        let d = rate(stiffness, phase(1.0), along(state, h, c));
        state = std::array::from_fn(|i| state[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
    }
    state
}

/// Gaussian elimination with row exchanges.
fn solve(mut matrix: [[f64; 5]; 4]) -> State {
    for column in 0..4 {
        let pivot =
            (column..4).max_by(|&i, &j| matrix[i][column].abs().total_cmp(&matrix[j][column].abs())).unwrap();
        matrix.swap(column, pivot);
        for row in 0..4 {
            if row != column {
                let factor = matrix[row][column] / matrix[column][column];
                let source = matrix[column];
                matrix[row].iter_mut().zip(source).for_each(|(target, value)| *target -= factor * value);
            }
        }
    }
    std::array::from_fn(|i| matrix[i][4] / matrix[i][i])
}

/// Newton's method on the period map, with differences, from a guess.
fn own_orbit(stiffness: f64, frequency_hz: f64, guess: State) -> State {
    const DIFFERENCE: f64 = 1e-6;
    let mut state = guess;
    for _ in 0..4 {
        let end = period(stiffness, frequency_hz, state);
        let mut matrix = [[0.0; 5]; 4];
        for column in 0..4 {
            let mut beside = state;
            beside[column] += DIFFERENCE;
            let moved = period(stiffness, frequency_hz, beside);
            for row in 0..4 {
                let identity = f64::from(u8::from(row == column));
                matrix[row][column] = (moved[row] - end[row]) / DIFFERENCE - identity;
            }
        }
        (0..4).for_each(|row| matrix[row][4] = state[row] - end[row]);
        let update = solve(matrix);
        state = std::array::from_fn(|i| state[i] + update[i]);
    }
    state
}

/// The guess is 1 % off, so that it is not the comparison.
#[test]
fn orbit_is_that_of_an_own_shooting() {
    for (stiffness, frequency_hz) in [(2e3, 3.3), (2e4, 4.0), (2e4, 2.2)] {
        let rig = rig(stiffness);
        let orbit = orbit(&rig, frequency_hz);
        assert!(orbit.maxima.contacts >= 1);
        let found = physical(&rig, &orbit.nodes[0]);
        let own = own_orbit(stiffness, frequency_hz, found.map(|value| 1.01 * value));
        let largest = own[..2].iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        for i in 0..4 {
            let scale = if i < 2 { largest } else { TAU * frequency_hz * largest };
            assert_abs_diff_eq!(found[i], own[i], epsilon = 1e-7 * scale);
        }
    }
}

/// The force's work per period, `int F v1 dt`, is what the dampers take, `int c1 v1^2 + c2 v2^2 dt`; the
/// spring between gives back what it takes.
///
/// The integrands are periodic with kinks in their second derivatives: the trapezoidal rule with 20 000
/// points is good to 1e-8.
#[test]
fn work_of_the_force_over_a_period_is_what_the_dampers_dissipate() {
    const POINTS: u32 = 20_000;
    for (stiffness, frequency_hz) in [(2e3, 3.3), (2e4, 4.0), (2e4, 2.2)] {
        let rig = rig(stiffness);
        let orbit = orbit(&rig, frequency_hz);
        let phases: Vec<f64> = (0..POINTS).map(|k| f64::from(k) / f64::from(POINTS)).collect();
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        let settings = GeneralSettings::with_tolerance(1e-12);
        let states = sample(&rig.system, &stretch, &orbit.nodes[0], &phases, &settings).unwrap();
        let (mut work, mut dissipated) = (0.0, 0.0);
        for (phase, state) in phases.iter().zip(&states) {
            let [_, _, v1, v2] = physical(&rig, state);
            work += FORCE * (TAU * phase).cos() * v1;
            dissipated += DAMPERS[0] * v1 * v1 + DAMPERS[1] * v2 * v2;
        }
        assert_abs_diff_eq!(work, dissipated, epsilon = 1e-7 * dissipated);
        assert!(work > 0.0);
    }
}

/// Without the spring each mass answers alone; with a weak one the response differs in proportion to its
/// stiffness.
#[test]
fn response_tends_to_the_linear_one_in_proportion_to_the_stiffness_between() {
    let frequency_hz = 2.0;
    let omega = TAU * frequency_hz;
    let linear = FORCE / f64::hypot(SPRINGS[0] - MASSES[0] * omega * omega, DAMPERS[0] * omega);
    assert!(linear > 2.0 * GAP, "they touch");
    let deviation = |stiffness: f64| orbit(&rig(stiffness), frequency_hz).maxima.displacement / linear - 1.0;
    let deviations = [8e-2, 4e-2, 2e-2, 1e-2].map(deviation);
    for pair in deviations.windows(2) {
        assert_abs_diff_eq!((pair[0] / pair[1]).log2(), 1.0, epsilon = 0.01);
    }
}

/// Out of reach, the gap makes no difference at all.
#[test]
fn masses_that_do_not_meet_move_alone() {
    let (low_hz, rig) = (0.05, rig(2e4));
    let omega = TAU * low_hz;
    let amplitude =
        |force: f64| force / f64::hypot(SPRINGS[0] - MASSES[0] * omega * omega, DAMPERS[0] * omega);
    assert!(amplitude(FORCE) > GAP);
    assert!(orbit(&rig, low_hz).maxima.contacts >= 1);
    let mut model_force = rig.clone();
    let model = rig.system.model().clone();
    let weak = 0.5 * FORCE * GAP / amplitude(FORCE);
    let load = Load { support: vec![], forces: vec![force_at(&model, "first", 1, weak)] };
    model_force.system = System::new(model, &load, rig.system.elements().to_vec()).unwrap();
    let apart = orbit(&model_force, low_hz);
    assert_eq!(apart.maxima.contacts, 0);
    assert_abs_diff_eq!(apart.maxima.displacement, amplitude(weak), epsilon = 1e-9 * amplitude(weak));
}
