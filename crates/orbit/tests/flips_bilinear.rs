//! Flips of a bilinear oscillator, against its closed form.
//!
//! `x'' + c x' + k x = F cos W t` for `x < 0`, with `K > k` instead of `k` for `x > 0`. An orbit with one
//! contact a period enters it at the time `t_1` with the velocity `v`, leaves it `s` later and comes back
//! after the period. In either region the motion is a steady part `Re X exp(i W t)` and a decaying part that
//! `E(t)`, the exponential of the region, carries on. The four unknowns `t_1, v, s, W` obey
//!
//! `x(t_1 + s) = 0`, `x(t_1 + T) = 0`, `x'(t_1 + T) = v`, `det(M + 1) = 1 + tr M + det M = 0`, `M = E_k(T -
//! s) E_K(s)`:
//!
//! the force has no jump, so the fundamental matrix is the product of the exponentials. Newton's method with
//! differences solves them.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::TAU;

use crate::common::{
    events::{
        Subject, alternation, assert_same, exponent, general_multipliers, growth, leaving, oscillator,
        settled_period, side, sorted, step_of, whole, with,
    },
    with_segments,
};
use hammerbeam_motion::{Law, law::LinearStop};
use hammerbeam_orbit::{
    BranchRow, EventStatus, OrbitSettings, PeriodicSolution, Side, StopReason, find_start,
};

const DAMPER: f64 = 0.1;
const FORCE: f64 = 1.0;
const SOFT: f64 = 1.0;
const STIFF: f64 = 20.0;
/// Between the resonance and the superharmonic one, and beyond the resonance.
const RANGE: (f64, f64) = (0.12, 0.5);

fn subject() -> Subject {
    oscillator(SOFT, DAMPER, FORCE, Law::Linear(LinearStop::with_gap(STIFF - SOFT, 0.0).unwrap()))
}

fn flips(start_hz: f64, settings: &OrbitSettings) -> Vec<BranchRow> {
    let subject = subject();
    let start = find_start(&subject.0, &subject.1, start_hz, 1, settings).unwrap();
    let rows = whole(&subject, &start, RANGE, settings);
    with(&rows, |events| events.flip).into_iter().cloned().collect()
}

/// Steady part `[x, x']` of a region of stiffness `k` at a time.
fn steady(stiffness: f64, omega: f64, time: f64) -> [f64; 2] {
    let (re, im) = (stiffness - omega * omega, DAMPER * omega);
    let size = FORCE / (re * re + im * im);
    let (cosine, sine) = ((omega * time).cos(), (omega * time).sin());
    [size * (re * cosine + im * sine), size * omega * (im * cosine - re * sine)]
}

/// `E(t)` of `x'' + c x' + k x = 0`, underdamped, by rows.
fn exponential(stiffness: f64, time: f64) -> [[f64; 2]; 2] {
    let half = 0.5 * DAMPER;
    let w = (stiffness - half * half).sqrt();
    let (decay, cosine, sine) = ((-half * time).exp(), (w * time).cos(), (w * time).sin() / w);
    [
        [decay * (cosine + half * sine), decay * sine],
        [-decay * stiffness * sine, decay * (cosine - half * sine)],
    ]
}

fn times(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let entry = |i: usize, j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}

/// State a time after a state at `begin` in a region.
fn moved(stiffness: f64, omega: f64, begin: f64, time: f64, state: [f64; 2]) -> [f64; 2] {
    let (before, after) = (steady(stiffness, omega, begin), steady(stiffness, omega, begin + time));
    let e = exponential(stiffness, time);
    let free = [state[0] - before[0], state[1] - before[1]];
    [0, 1].map(|i| after[i] + e[i][0] * free[0] + e[i][1] * free[1])
}

/// The four equations for `[t_1, v, s, W]`.
fn equations([enters, speed, duration, omega]: [f64; 4]) -> [f64; 4] {
    let flight = TAU / omega - duration;
    let leaves = moved(STIFF, omega, enters, duration, [0.0, speed]);
    let back = moved(SOFT, omega, enters + duration, flight, leaves);
    let m = times(exponential(SOFT, flight), exponential(STIFF, duration));
    let determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    [leaves[0], back[0], back[1] - speed, 1.0 + m[0][0] + m[1][1] + determinant]
}

/// Newton's method with central differences.
fn solved(mut unknowns: [f64; 4]) -> [f64; 4] {
    for _ in 0..20 {
        let value = equations(unknowns);
        let mut matrix = [[0.0; 5]; 4];
        for j in 0..4 {
            let h = 1e-6;
            let at = |sign: f64| {
                let mut other = unknowns;
                other[j] += sign * h;
                equations(other)
            };
            let (plus, minus) = (at(1.0), at(-1.0));
            (0..4).for_each(|i| matrix[i][j] = (plus[i] - minus[i]) / (2.0 * h));
        }
        (0..4).for_each(|i| matrix[i][4] = -value[i]);
        let update = eliminate(matrix);
        (0..4).for_each(|i| unknowns[i] += update[i]);
    }
    assert!(equations(unknowns).iter().all(|value| value.abs() < 1e-12), "{:?}", equations(unknowns));
    unknowns
}

fn eliminate(mut m: [[f64; 5]; 4]) -> [f64; 4] {
    for k in 0..4 {
        let best = (k..4).max_by(|&a, &b| m[a][k].abs().total_cmp(&m[b][k].abs())).unwrap();
        m.swap(k, best);
        for i in (0..4).filter(|&i| i != k) {
            let (factor, pivot) = (m[i][k] / m[k][k], m[k]);
            (0..5).for_each(|j| m[i][j] -= factor * pivot[j]);
        }
    }
    [0, 1, 2, 3].map(|i| m[i][4] / m[i][i])
}

/// Entry and duration of the only contact of an orbit, roughly, by steps of the closed form from a state in
/// flight.
fn contact_of(row: &BranchRow) -> [f64; 4] {
    let omega = TAU * row.solution.frequency_hz;
    let (steps, mut state) = (20_000, [row.solution.nodes[0][0], row.solution.nodes[0][1]]);
    let (mut enters, mut leaves, mut speed) = (0.0, 0.0, 0.0);
    let h = TAU / omega / f64::from(steps);
    for k in 0..2 * steps {
        let time = f64::from(k) * h;
        let stiffness = if state[0] > 0.0 { STIFF } else { SOFT };
        let next = moved(stiffness, omega, time, h, state);
        if state[0] <= 0.0 && next[0] > 0.0 && enters == 0.0 {
            (enters, speed) = (time, next[1]);
        } else if state[0] > 0.0 && next[0] <= 0.0 && enters != 0.0 && leaves == 0.0 {
            leaves = time;
        }
        state = next;
    }
    [enters, speed, leaves - enters, omega]
}

#[test]
fn flips_are_those_of_the_closed_form() {
    let flips = flips(0.3, &step_of(0.002));
    assert_eq!(flips.len(), 3);
    let mut compared = 0;
    for flip in flips.iter().filter(|flip| flip.solution.maxima.contacts == 1) {
        let omega = solved(contact_of(flip))[3];
        assert_same(&[flip.solution.frequency_hz], &[omega / TAU], 1e-8, "closed form");
        compared += 1;
    }
    assert!(compared >= 1);
}

#[test]
fn a_multiplier_is_minus_one_by_the_variational_equations_too() {
    let (system, _) = subject();
    for flip in flips(0.3, &step_of(0.002)) {
        let event = flip.located.as_ref().unwrap();
        assert_eq!(event.status, EventStatus::Located);
        let multipliers = general_multipliers(&system, &flip.solution);
        let nearest = multipliers.iter().map(|[re, im]| (re + 1.0).hypot(*im)).fold(f64::INFINITY, f64::min);
        // Both integrators to 1e-10 or so over the period.
        assert!(nearest < 1e-8, "{nearest:.1e} at {} Hz", flip.solution.frequency_hz);
    }
}

#[test]
fn flips_do_not_depend_on_step_start_or_segments() {
    let frequencies = |start_hz: f64, settings: &OrbitSettings| {
        let flips = flips(start_hz, settings);
        sorted(&flips.iter().collect::<Vec<_>>())
    };
    let expected = frequencies(0.3, &step_of(0.002));
    assert_same(&frequencies(0.3, &step_of(0.0004)), &expected, 1e-8, "shorter steps");
    assert_same(&frequencies(0.3, &step_of(0.01)), &expected, 1e-8, "longer steps");
    assert_same(&frequencies(0.47, &step_of(0.002)), &expected, 1e-8, "another start");
    for segments in [1, 3, 8] {
        let settings = OrbitSettings { max_step_hz: 0.002, ..with_segments(segments) };
        assert_same(&frequencies(0.3, &settings), &expected, 1e-8, "segments");
    }
}

/// Near the flip the states an excitation period apart differ by the root of the distance: supercritical or
/// subcritical.
#[test]
fn orbit_of_doubled_period_grows_with_the_root_of_the_distance() {
    let subject = subject();
    for flip in flips(0.3, &step_of(0.002)) {
        let at = flip.solution.frequency_hz;
        let measure = |orbit: &PeriodicSolution| alternation(&subject.0, orbit);
        let mut points = growth(&subject, &flip, (RANGE, &step_of(1e-5)), 0.08, measure);
        points.retain(|(_, grown)| *grown > 0.005);
        assert!(points.len() > 3, "{} rows near {at} Hz", points.len());
        let found = exponent(&points);
        assert!((found - 0.5).abs() < 0.03, "exponent {found} at {at} Hz");
    }
}

/// Both ways along the same orbits: they are those of the other half of the doubled orbit.
#[test]
fn branch_of_doubled_period_is_met_again_from_its_other_side() {
    let subject = subject();
    let flips = flips(0.3, &step_of(0.002));
    let first = &flips.iter().find(|flip| flip.solution.frequency_hz < 0.16).unwrap();
    let (up, up_end) = leaving(&subject, first, Side::Up, RANGE, &step_of(0.002));
    let (down, down_end) = leaving(&subject, first, Side::Down, RANGE, &step_of(0.002));
    let events = |rows: &[BranchRow]| sorted(&with(rows, |events| events.flip || events.fold));
    assert_same(&events(&up), &events(&down), 1e-8, "both sides");
    for end in [up_end, down_end] {
        let StopReason::ShorterPeriod { frequency_hz, .. } = end else { panic!("{end:?}") };
        let other = flips.iter().map(|flip| (flip.solution.frequency_hz / frequency_hz - 1.0).abs());
        // Where the doubled orbit merges, the flip is met to the square of a thousandth of the orbit.
        assert!(other.fold(f64::INFINITY, f64::min) < 1e-6, "{frequency_hz} Hz");
    }
}

/// On one side of a supercritical flip motion settles to period 1, on the other to period 2, without any
/// shooting.
#[test]
fn simulation_on_both_sides_settles_to_period_one_and_two() {
    let subject = subject();
    let flips = flips(0.3, &step_of(0.002));
    let flip = &flips.iter().find(|flip| flip.solution.frequency_hz > 0.3).unwrap().solution;
    let start = find_start(&subject.0, &subject.1, 0.36, 1, &step_of(0.002)).unwrap();
    let (rows, _) = side(&subject, &start, Side::Up, RANGE, &step_of(0.002));
    let before = rows.iter().rfind(|row| row.solution.frequency_hz < 0.98 * flip.frequency_hz).unwrap();
    let state = [before.solution.nodes[0][0] + 0.01, before.solution.nodes[0][1]];
    let settle = |frequency_hz: f64| settled_period(&subject.0, frequency_hz, &state, (250, 4), 1e-6);
    assert_eq!(settle(0.98 * flip.frequency_hz), Some(1));
    assert_eq!(settle(1.01 * flip.frequency_hz), Some(2));
}

/// A doubled branch comes back to the harmonic one in another flip of it, as sharply with long steps as with
/// short ones, and without a crowd of rows before it.
#[test]
fn a_doubled_branch_ends_in_a_flip_however_long_its_steps_are() {
    let subject = subject();
    let found = flips(0.3, &step_of(0.001));
    let flips = sorted(&found.iter().collect::<Vec<_>>());
    let mut ends = 0;
    for step in (1..=12).chain([30, 46, 80, 93, 97]) {
        let settings = step_of(2e-4 * f64::from(step));
        for flip in &found {
            let (rows, reason) = leaving(&subject, flip, Side::Up, RANGE, &settings);
            let StopReason::ShorterPeriod { frequency_hz, .. } = reason else { continue };
            let off =
                flips.iter().map(|flip| (flip / frequency_hz - 1.0).abs()).fold(f64::INFINITY, f64::min);
            assert!(off < 1e-10, "steps of {} Hz: {off:.1e} off", settings.max_step_hz);
            let is_there = |row: &&BranchRow| (row.solution.frequency_hz / frequency_hz - 1.0).abs() < 2e-8;
            let there = rows.iter().filter(is_there).count();
            assert!(there <= 12, "steps of {} Hz: {there} rows beside the flip", settings.max_step_hz);
            ends += 1;
        }
    }
    assert!(ends >= 30, "{ends}");
}
