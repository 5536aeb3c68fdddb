//! A branch with a rigid stop on whose way the impact passes phase 0, where the state of the orbit jumps from
//! v to `-e v`.
//!
//! `x'' + x = cos(w t + phi)`, `x <= s`. Orbits with one impact of the speed V in a period `T = 2 pi/w` have,
//! with `g = 1/(1 - w^2)` and `C = cot(T/2)`,
//!
//! `(s + V C (1 + e)/2)^2 + (V (1 - e)/(2 w))^2 = g^2`,
//!
//! and multipliers of the product `e^2` (Shaw and Holmes, J. Sound Vib. 90 (1983), 129-155). The impact comes
//! at the phase `w t + phi` that has `g cos` and `-g w sin` of the free motion; with `phi` of the impact at
//! [`MIDDLE`] it comes at phase 0 there.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::TAU;

use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, LocalElement, System, law::RigidStop};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, OrbitSettings, Response, Side, StopReason, find_orbits, find_start,
};
use hammerbeam_testkit::structures::unit_mass;

const GAP: f64 = 0.1;
const RESTITUTION: f64 = 0.6;
const LOW: f64 = 1.7;
const MIDDLE: f64 = 1.8;
const HIGH: f64 = 1.9;

/// Speed of the impact, and the phase of the load at which it comes [rad].
fn closed_form(w: f64) -> (f64, f64) {
    let (s, e, g) = (GAP, RESTITUTION, 1.0 / (1.0 - w * w));
    let cot = (TAU / w / 2.0).tan().recip();
    let square = ((1.0 + e) / 2.0 * cot).powi(2) + ((1.0 - e) / (2.0 * w)).powi(2);
    let half = s * (1.0 + e) / 2.0 * cot;
    let speed = (-half + (half * half - square * (s * s - g * g)).sqrt()) / square;
    let phase = (-speed * (1.0 - e) / (2.0 * g * w)).atan2((s + speed * (1.0 + e) / 2.0 * cot) / g);
    (speed, phase)
}

fn oscillator(phase: f64) -> (System, Response) {
    oscillator_at(RESTITUTION, GAP, phase)
}

fn oscillator_at(restitution: f64, gap: f64, phase: f64) -> (System, Response) {
    let harmonic = Harmonic { order: 1, amplitude: 1.0, phase };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let law = Law::Rigid(RigidStop::with_gap(restitution, gap).unwrap());
    let stop = LocalElement { name: "stop".into(), shape: vec![1.0], support_ratios: vec![0.0], law };
    (
        System::new(unit_mass(1.0, 0.0), &load, vec![stop]).unwrap(),
        Response { shape: vec![1.0], support_ratios: vec![0.0] },
    )
}

/// The branch from [`LOW`] or [`HIGH`] to the other end.
fn walk(phase: f64, side: Side) -> (Vec<BranchRow>, StopReason) {
    let (system, response) = oscillator(phase);
    let settings = OrbitSettings::for_range((0.0, 1.0));
    let range = (LOW / TAU, HIGH / TAU);
    let start_hz = if matches!(side, Side::Up) { range.0 } else { range.1 };
    let start = find_start(&system, &response, start_hz, 1, &settings).unwrap();
    let mut walk = BranchWalk::new(&system, &response, &start, side, range, &settings).unwrap();
    let mut rows = vec![walk.start_row().unwrap()];
    loop {
        if let Some(reason) = walk.step(&mut rows).unwrap() {
            return (rows, reason);
        }
    }
}

#[test]
fn a_branch_goes_on_where_its_impact_passes_phase_0() {
    // The impact comes later or earlier in the cycle over the range, so it does pass.
    let phases = [LOW, MIDDLE, HIGH].map(|w| closed_form(w).1);
    assert!((phases[0] - phases[1]) * (phases[2] - phases[1]) < 0.0, "{phases:?}");
    for side in [Side::Up, Side::Down] {
        let (rows, reason) = walk(phases[1], side);
        let end = if matches!(side, Side::Up) { HIGH } else { LOW };
        assert_eq!(reason, StopReason::RangeEnd { place: end / TAU }, "{side:?}");
        assert!(rows.len() > 20, "{}", rows.len());
        for row in &rows {
            let orbit = &row.solution;
            let (speed, _) = closed_form(TAU * orbit.frequency_hz);
            // Orbits are good to 1e-10.
            assert!((orbit.maxima.impact_velocity / speed - 1.0).abs() < 1e-8, "{} Hz", orbit.frequency_hz);
            let [[a, b], [c, d]] = [orbit.floquet_multipliers[0], orbit.floquet_multipliers[1]];
            assert!((a * c - b * d - RESTITUTION * RESTITUTION).abs() < 1e-8, "{} Hz", orbit.frequency_hz);
        }
    }
}

/// Without losses the motion goes backwards in time alike, and the impact comes at phase 0 at every
/// frequency: rounding says on which side of it the state there lies. With `e = 1` one orbit has one impact,
/// of the speed `V = (g - s)/C`.
#[test]
fn an_orbit_with_its_impact_at_phase_0_is_found_once_and_followed() {
    let (gap, settings) = (0.5, OrbitSettings { max_step: 1e-4, ..OrbitSettings::default() });
    let (system, response) = oscillator_at(1.0, gap, 0.0);
    let range = (1.4 / TAU, 1.7 / TAU);
    for w in [1.47, 1.5, 1.55, 1.6] {
        let expected = (1.0 / (1.0 - w * w) - gap) * (TAU / w / 2.0).tan();
        let found = find_orbits(&system, &response, (w / TAU, 1), range, &settings, &mut || false).unwrap();
        let has_one = |speed: f64| (speed / expected - 1.0).abs() < 1e-6;
        let with_one: Vec<_> =
            found.orbits.iter().filter(|orbit| has_one(orbit.maxima.impact_velocity)).collect();
        assert_eq!(with_one.len(), 1, "{w} rad/s");
        let mut walk = BranchWalk::new(&system, &response, with_one[0], Side::Up, range, &settings).unwrap();
        let mut rows = Vec::new();
        for _ in 0..20 {
            assert_eq!(walk.step(&mut rows).unwrap(), None);
        }
        for orbit in rows.iter().map(|row| &row.solution) {
            let w = TAU * orbit.frequency_hz;
            let expected = (1.0 / (1.0 - w * w) - gap) * (TAU / w / 2.0).tan();
            assert!((orbit.maxima.impact_velocity / expected - 1.0).abs() < 1e-9, "{w} rad/s");
        }
    }
}
