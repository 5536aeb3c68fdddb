//! All orbits at one frequency, against Newton's method from a thousand random states of a single-mass
//! system.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::cmp::Reverse;

use crate::common::duffing;
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    law::HertzStop,
};
use hammerbeam_orbit::{FoundOrbits, OrbitSettings, PeriodicSolution, Response, find_orbits};
use hammerbeam_structure::{Connection, Damping, GROUND, Lumped, LumpedMass, Reduction};

/// A ball of 0.1 kg that falls on a vibrating table: no spring, so the linear response says nothing of where
/// it moves.
fn bouncing_ball() -> (System, Response) {
    let damper = Connection { between: ["ball".into(), GROUND.into()], constant: 0.02 };
    let ball = LumpedMass { name: "ball".into(), mass: 0.1 };
    let lumped = Lumped { masses: vec![ball], springs: vec![], dampers: vec![damper] };
    let shaken = lumped.structure().unwrap().with_support_motion(&[GROUND]).unwrap();
    let model = shaken.reduce(&Reduction::None, &Damping::none(), &[]).unwrap().model;
    let point = model.point("ball").unwrap().clone();
    let weight = Harmonic { order: 0, amplitude: -9.81, phase: 0.0 };
    let load = Load {
        support: vec![Harmonic { order: 1, amplitude: 1e-3, phase: 0.0 }.into()],
        forces: vec![HarmonicForce { shape: model.uniform_acceleration.clone(), harmonic: weight }],
    };
    let table = LocalElement {
        name: "table".into(),
        shape: point.shape.iter().map(|phi| -phi).collect(),
        support_ratios: vec![1.0 - point.support_ratios[0]],
        law: Law::Hertz(HertzStop::with_gap(1e8, 0.0).unwrap()),
    };
    let system = System::new(model, &load, vec![table]).unwrap();
    (system, Response { shape: point.shape, support_ratios: point.support_ratios })
}

/// Uniform from -1 to 1.
fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// States of the orbits of minimal period `multiple`, one each: Newton's method for `Z(z) = z` of the flow
/// over all periods from random states in a box.
fn by_brute_force(
    system: &System,
    (frequency_hz, multiple): (f64, u32),
    half_widths: [f64; 2],
    starts: usize,
) -> Vec<[f64; 2]> {
    let mut integrator = ExactIntegrator::new(system.clone(), ExactSettings::default()).unwrap();
    let stretch = |end: u32| Stretch { frequency_hz, start: 0.0, end: f64::from(end) };
    let near = |a: [f64; 2], b: &[f64]| (0..2).all(|i| (a[i] - b[i]).abs() < 1e-6 * half_widths[i]);
    let mut seed = 7;
    let mut found: Vec<[f64; 2]> = Vec::new();
    'starts: for _ in 0..starts {
        let mut state = half_widths.map(|width| width * noise(&mut seed));
        let mut settled = false;
        for _ in 0..40 {
            let Ok(flow) = integrator.flow(&stretch(multiple), &state) else { continue 'starts };
            let a = &flow.by_state;
            let (p, q, r, s) = (a[(0, 0)] - 1.0, a[(0, 1)], a[(1, 0)], a[(1, 1)] - 1.0);
            let rest = [state[0] - flow.state[0], state[1] - flow.state[1]];
            let determinant = p * s - q * r;
            let update =
                [(s * rest[0] - q * rest[1]) / determinant, (p * rest[1] - r * rest[0]) / determinant];
            state = [state[0] + update[0], state[1] + update[1]];
            if !(0..2).all(|i| state[i].abs() < 10.0 * half_widths[i]) {
                continue 'starts;
            }
            settled = (0..2).all(|i| update[i].abs() < 1e-9 * half_widths[i]);
            if settled {
                break;
            }
        }
        if !settled {
            continue;
        }
        let mut phases = vec![state.to_vec()];
        for k in 1..multiple as usize {
            phases.push(integrator.advance(&stretch(1), &phases[k - 1]).unwrap());
        }
        let shorter =
            (1..multiple as usize).any(|k| multiple.is_multiple_of(k as u32) && near(state, &phases[k]));
        if !shorter && !found.iter().any(|known| phases.iter().any(|phase| near(*known, phase))) {
            found.push(state);
        }
    }
    found
}

/// Orbits of `found` that are not among the others.
fn missing(
    system: &System,
    found: &[PeriodicSolution],
    others: &[[f64; 2]],
    half_widths: [f64; 2],
) -> Vec<[f64; 2]> {
    let mut integrator = ExactIntegrator::new(system.clone(), ExactSettings::default()).unwrap();
    let mut phases = Vec::new();
    for orbit in found {
        let stretch = Stretch { frequency_hz: orbit.frequency_hz, start: 0.0, end: 1.0 };
        let mut state = orbit.nodes[0].clone();
        for _ in 0..orbit.period_multiple {
            phases.push(state.clone());
            state = integrator.advance(&stretch, &state).unwrap();
        }
    }
    let near = |a: &[f64; 2], b: &[f64]| (0..2).all(|i| (a[i] - b[i]).abs() < 1e-5 * half_widths[i]);
    others.iter().filter(|other| !phases.iter().any(|phase| near(other, phase))).copied().collect()
}

/// Every orbit that brute force finds in the box must have been found.
fn nothing_is_missed(
    (system, response): &(System, Response),
    orbit: (f64, u32),
    range_hz: (f64, f64),
    half_widths: [f64; 2],
) -> usize {
    let all = by_brute_force(system, orbit, half_widths, 1000);
    let settings = OrbitSettings::for_range(range_hz);
    let FoundOrbits { orbits: found, incomplete } =
        find_orbits(system, response, orbit, range_hz, &settings, &mut || false).unwrap();
    let missing = missing(system, &found, &all, half_widths);
    assert!(
        missing.is_empty(),
        "{} of {} missing: {missing:?}; incomplete: {incomplete:?}",
        missing.len(),
        all.len()
    );
    assert!(found.iter().all(|found| found.period_multiple == orbit.1));
    assert!(found.is_sorted_by_key(|found| (!found.stable(), Reverse(found.maxima.displacement.to_bits()))));
    all.len()
}

#[test]
fn ball_on_a_table_has_the_orbits_of_two_periods_that_brute_force_finds() {
    assert!(nothing_is_missed(&bouncing_ball(), (30.0, 2), (20.0, 40.0), [3e-3, 0.15]) >= 5);
}

#[test]
fn ball_on_a_table_has_the_orbits_of_one_period_that_brute_force_finds() {
    assert!(nothing_is_missed(&bouncing_ball(), (24.0, 1), (20.0, 40.0), [3e-3, 0.15]) >= 1);
}

#[test]
fn hardening_oscillator_has_its_three_orbits() {
    assert_eq!(nothing_is_missed(&duffing(), (0.25, 1), (0.05, 0.6), [3.0, 3.0]), 3);
}
