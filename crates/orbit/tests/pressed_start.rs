//! A constant load that presses the structure against a stop with an impact-speed-dependent law, and a force
//! that throws it off: the linear response and the place of rest lie within the contact, where no search can
//! start.
//!
//! The oracle is the same equation by the classical Runge-Kutta method with fixed steps, from a state far in
//! front of the stop.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::TAU;

use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, System,
    law::{HertzStop, RestitutionModel, RestitutionStop, RigidStop},
};
use hammerbeam_orbit::{
    OrbitError, OrbitSettings, Response, SurveyEffort, TrialEffort, find_orbits, find_start, newton_trials,
    survey,
};
use hammerbeam_testkit::structures::unit_mass;

const DAMPING: f64 = 0.4;
const WEIGHT: f64 = 30.0;
const FORCE: f64 = 42.0;
const STIFFNESS: f64 = 1e4;
const GAP: f64 = 1.0;
const RESTITUTION: f64 = 0.62;
const FREQUENCY: f64 = 1.0;

/// Unit mass on a unit spring under its weight and a harmonic force.
fn pressed(stops: &[(&str, Law)]) -> (System, Response) {
    let force = |order, amplitude| HarmonicForce {
        shape: vec![1.0],
        harmonic: Harmonic { order, amplitude, phase: 0.0 },
    };
    let load = Load { support: vec![], forces: vec![force(0, WEIGHT), force(1, FORCE)] };
    let stop = |(name, law): &(&str, Law)| LocalElement {
        name: (*name).into(),
        shape: vec![1.0],
        support_ratios: vec![0.0],
        law: law.clone(),
    };
    let system = System::new(unit_mass(1.0, DAMPING), &load, stops.iter().map(stop).collect()).unwrap();
    (system, Response { shape: vec![1.0], support_ratios: vec![0.0] })
}

fn impact_speed_dependent() -> Law {
    let elastic = HertzStop::with_gap(STIFFNESS, GAP).unwrap();
    Law::Restitution(
        RestitutionStop::new(elastic, RestitutionModel::LankaraniNikravesh, RESTITUTION).unwrap(),
    )
}

/// Largest absolute displacement of the settled motion, by 40 000 Runge-Kutta steps in a period.
fn largest_displacement() -> f64 {
    const STEPS: usize = 40_000;
    let (h, c) = (1.0 / (FREQUENCY * STEPS as f64), 0.75 * (1.0 - RESTITUTION * RESTITUTION));
    let acceleration = |t: f64, x: f64, v: f64, struck: f64| {
        let (depth, free) = (x - GAP, WEIGHT + FORCE * (TAU * FREQUENCY * t).cos() - x - DAMPING * v);
        let pressure = if depth > 0.0 { (1.0 + c * v / struck).max(0.0) } else { 0.0 };
        free - STIFFNESS * depth.max(0.0).powf(1.5) * pressure
    };
    let (mut x, mut v, mut struck, mut largest) = (-5.0_f64, 0.0_f64, 1.0, 0.0_f64);
    for step in 0..100 * STEPS {
        let t = (step % STEPS) as f64 * h;
        let a = |share: f64, x, v| acceleration(t + share * h, x, v, struck);
        let (v1, a1) = (v, a(0.0, x, v));
        let (v2, a2) = (v + 0.5 * h * a1, a(0.5, x + 0.5 * h * v1, v + 0.5 * h * a1));
        let (v3, a3) = (v + 0.5 * h * a2, a(0.5, x + 0.5 * h * v2, v + 0.5 * h * a2));
        let (v4, a4) = (v + h * a3, a(1.0, x + h * v3, v + h * a3));
        let before = (x, v);
        x += h * (v1 + 2.0 * v2 + 2.0 * v3 + v4) / 6.0;
        v += h * (a1 + 2.0 * a2 + 2.0 * a3 + a4) / 6.0;
        if before.0 <= GAP && x > GAP {
            struck = before.1 + (v - before.1) * (GAP - before.0) / (x - before.0);
        }
        if step >= 99 * STEPS {
            largest = largest.max(x.abs());
        }
    }
    largest
}

#[track_caller]
fn assert_near(found: f64, expected: f64) {
    // Steps that fall across the start of a contact leave some 1e-6.
    assert!((found - expected).abs() <= 1e-5 * expected.abs(), "{found}, expected {expected}");
}

#[test]
fn every_search_starts_in_front_of_a_contact_against_which_a_weight_presses() {
    let (system, response) = pressed(&[("stop", impact_speed_dependent())]);
    let settings = OrbitSettings::for_range((0.5, 1.5));
    let expected = largest_displacement();
    let started = find_start(&system, &response, FREQUENCY, 1, &settings).unwrap();
    assert!(started.stable() && started.maxima.contacts > 0);
    assert_near(started.maxima.displacement, expected);
    let effort = SurveyEffort { starts: 2, ..SurveyEffort::default() };
    let surveyed = survey(&system, &response, FREQUENCY, &[1], &effort, &settings, &mut || false).unwrap();
    let trials = TrialEffort { trials: 4, seed: 1 };
    let orbit = (FREQUENCY, &[1][..]);
    let tried = newton_trials(&system, &response, orbit, trials, &settings, &mut || false).unwrap();
    let found =
        find_orbits(&system, &response, (FREQUENCY, 1), (0.9, 1.1), &settings, &mut || false).unwrap();
    for found in [surveyed.found, tried, found] {
        assert!(!matches!(found.incomplete, Some(OrbitError::Motion(_))), "{:?}", found.incomplete);
        let stable = found.orbits.iter().find(|orbit| orbit.stable()).unwrap();
        assert_near(stable.maxima.displacement, expected);
    }
}

/// A rigid stop in front of the other one holds the mass back: no motion comes into the contact, but the
/// linear response does.
#[test]
fn searches_start_in_front_of_a_rigid_stop_that_lies_before_the_contact() {
    let rigid = Law::Rigid(RigidStop::with_gap(0.3, 0.0).unwrap());
    let (system, response) = pressed(&[("far", impact_speed_dependent()), ("near", rigid)]);
    let started =
        find_start(&system, &response, FREQUENCY, 1, &OrbitSettings::for_range((0.5, 1.5))).unwrap();
    assert!(started.stable());
    assert!(started.nodes.iter().all(|node| node[0] <= 1e-9));
}

/// The contact closes once and for all: the reason is reported.
#[test]
fn a_weight_that_presses_more_than_the_force_lifts_is_refused_with_a_reason() {
    let heavy = |order, amplitude| HarmonicForce {
        shape: vec![1.0],
        harmonic: Harmonic { order, amplitude, phase: 0.0 },
    };
    let load = Load { support: vec![], forces: vec![heavy(0, 10.0 * FORCE), heavy(1, 0.01 * FORCE)] };
    let stop = LocalElement {
        name: "stop".into(),
        shape: vec![1.0],
        support_ratios: vec![0.0],
        law: impact_speed_dependent(),
    };
    let system = System::new(unit_mass(1.0, DAMPING), &load, vec![stop]).unwrap();
    let response = Response { shape: vec![1.0], support_ratios: vec![0.0] };
    let settings = OrbitSettings::for_range((0.5, 1.5));
    let refused = find_start(&system, &response, FREQUENCY, 1, &settings).unwrap_err();
    assert!(matches!(refused, OrbitError::NeverOpens { .. }), "{refused}");
}
