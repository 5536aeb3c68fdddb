//! Orbits with impact-speed-dependent laws, on whose branches a contact comes to lie over phase 0.
//!
//! The oracle is the same motion counted from another phase of the load: where the force is `cos(2 pi x +
//! phi)`, every orbit is the orbit of `phi = 0` started `phi / 2 pi` cycles later. With `phi = PLAIN` no
//! contact comes near phase 0, so nothing moves.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::PI;

use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Stretch, System,
    exact::{ExactIntegrator, ExactSettings, MotionError},
    law::{HertzStop, RestitutionModel, RestitutionStop},
};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, OrbitError, OrbitSettings, PeriodicSolution, Response, Side, StopReason,
    SurveyEffort, find_orbits, find_start, recompute, states_at_phase, survey,
};
use hammerbeam_testkit::structures::unit_mass;

const RANGE: (f64, f64) = (0.1, 0.4);
const PLAIN: f64 = -2.2;

/// Unit mass on a spring, `w = 1`, damping ratio 0.02, with a stop after Lankarani and Nikravesh at a gap,
/// driven by a force with a phase.
fn oscillator(phase: f64) -> (System, Response) {
    pressed(phase, 0.0)
}

/// The same under a constant force besides.
fn pressed(phase: f64, constant: f64) -> (System, Response) {
    let model = unit_mass(1.0, 0.04);
    let force = |order, amplitude, phase| HarmonicForce {
        shape: vec![1.0],
        harmonic: Harmonic { order, amplitude, phase },
    };
    let mut forces = vec![force(1, 0.2, phase)];
    if constant != 0.0 {
        forces.push(force(0, constant, 0.0));
    }
    let load = Load { support: vec![], forces };
    let elastic = HertzStop::with_gap(20.0, 0.5).unwrap();
    let law = RestitutionStop::new(elastic, RestitutionModel::LankaraniNikravesh, 0.7).unwrap();
    let law = Law::Restitution(law);
    let stop = LocalElement { name: "stop".into(), shape: vec![1.0], support_ratios: vec![0.0], law };
    (System::new(model, &load, vec![stop]).unwrap(), Response { shape: vec![1.0], support_ratios: vec![0.0] })
}

#[track_caller]
fn assert_near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found}, expected {expected}");
}

fn settings() -> OrbitSettings {
    OrbitSettings::for_range((0.0, 1.5))
}

/// The branch from 0.12 Hz up, stored and taken up again after every `pieces` steps.
fn walk((system, response): &(System, Response), pieces: usize) -> (Vec<BranchRow>, StopReason) {
    let settings = settings();
    let start = find_start(system, response, 0.12, 1, &settings).unwrap();
    let mut walk = BranchWalk::new(system, response, &start, Side::Up, RANGE, &settings).unwrap();
    let (mut rows, mut journal) = (vec![walk.start_row().unwrap()], Vec::new());
    for step in 1.. {
        if let Some(reason) = walk.step(&mut rows).unwrap() {
            return (rows, reason);
        }
        if step % pieces == 0 {
            journal.extend(walk.take_journal());
            let checkpoint = walk.checkpoint();
            walk = BranchWalk::resume(system, response, (&checkpoint, &journal), RANGE, &settings).unwrap();
        }
    }
    unreachable!("a walk ends");
}

fn phases(rows: &[BranchRow]) -> Vec<f64> {
    let mut phases: Vec<f64> = rows.iter().map(|row| row.solution.phase).collect();
    phases.dedup();
    phases
}

/// Frequency, largest displacement and number of contacts of the rows with an event.
fn events(rows: &[BranchRow]) -> Vec<(String, f64, f64)> {
    let rows = rows.iter().filter(|row| !row.events.start && !row.events.label().is_empty());
    rows.map(|row| (row.events.label(), row.solution.frequency_hz, row.solution.maxima.displacement))
        .collect()
}

/// Events of a branch do not depend on the phase from which its motion is counted, nor does the walk stop
/// where a contact comes to lie over phase 0.
#[test]
fn a_branch_is_the_same_whatever_the_phase_of_the_load() {
    let (plain, reason) = walk(&oscillator(PLAIN), usize::MAX);
    assert_eq!(reason, StopReason::RangeEnd { place: RANGE.1 });
    assert_eq!(phases(&plain), [0.0], "nothing comes near phase 0");
    let expected = events(&plain);
    assert!(expected.iter().filter(|event| event.0.contains("fold")).count() >= 2, "{expected:?}");
    for load in [0.0, 0.5 * PI, PI, -0.5 * PI, 0.3] {
        let (rows, reason) = walk(&oscillator(load), usize::MAX);
        assert_eq!(reason, StopReason::RangeEnd { place: RANGE.1 }, "{load}");
        println!("{load}: phases {:?}, {} rows, {} plain", phases(&rows), rows.len(), plain.len());
        let found = events(&rows);
        assert_eq!(found.len(), expected.len(), "{load}: {found:?}, {expected:?}");
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(found.0, expected.0);
            // A fold is located to 1e-8 in frequency; grazing, whose place follows from the corner of the
            // branch, less well.
            assert_near(found.1, expected.1, 1e-7);
            assert_near(found.2, expected.2, 1e-6);
        }
    }
    let moved = [0.0, 0.5 * PI].map(|load| phases(&walk(&oscillator(load), usize::MAX).0).len());
    assert!(moved.iter().all(|count| *count > 1), "a contact passes phase 0: {moved:?}");
}

/// The same orbit started at several phases: frequency response, multipliers and maxima do not change, the
/// nodes lie on its motion.
#[test]
fn an_orbit_does_not_depend_on_where_it_starts() {
    let (system, response) = oscillator(0.5 * PI);
    let (rows, _) = walk(&(system.clone(), response.clone()), usize::MAX);
    let tight = OrbitSettings { tolerance: 1e-12, ..settings() };
    let mut compared = 0;
    for row in rows.iter().step_by(40).filter(|row| row.solution.maxima.contacts > 0) {
        let orbit = recompute(&system, &response, &row.solution, &tight).unwrap();
        let mut integrator = ExactIntegrator::new(system.clone(), ExactSettings::default()).unwrap();
        for shift in [0.125, 0.375, 0.625, 0.875] {
            let phase = (orbit.phase + shift).fract();
            let node = states_at_phase(&mut integrator, &orbit, phase).unwrap();
            let guess = PeriodicSolution { phase, nodes: node, ..orbit.clone() };
            let other = match recompute(&system, &response, &guess, &tight) {
                Err(OrbitError::Motion(MotionError::StartsInContact { .. })) => continue,
                other => other.unwrap(),
            };
            compared += 1;
            assert_eq!(other.phase, phase);
            let (a, b) = (&orbit.maxima, &other.maxima);
            // The plane in which an orbit is held is the plane at its own first node, so the frequency may
            // differ by what the first orbit was wrong.
            assert_near(orbit.frequency_hz, other.frequency_hz, 1e-9);
            for (a, b) in [
                (a.displacement, b.displacement),
                (a.acceleration, b.acceleration),
                (a.contact_force, b.contact_force),
                (a.impact_velocity, b.impact_velocity),
                (a.impulse, b.impulse),
            ] {
                assert_near(a, b, 1e-6);
            }
            assert_eq!(a.contacts, b.contacts);
            for (a, b) in
                orbit.floquet_multipliers.iter().flatten().zip(other.floquet_multipliers.iter().flatten())
            {
                assert!((a - b).abs() < 1e-5, "{a} {b}");
            }
        }
    }
    assert!(compared > 10, "{compared}");
}

/// The general integrator, which shares nothing with the exact one but the law, comes back to the first node.
#[test]
fn orbits_whose_phase_has_moved_close_by_the_general_integrator() {
    let subject = oscillator(0.5 * PI);
    let (rows, _) = walk(&subject, usize::MAX);
    let moved: Vec<_> = rows.iter().filter(|row| row.solution.phase != 0.0).step_by(25).collect();
    assert!(moved.len() > 3, "{}", moved.len());
    for row in moved {
        let orbit = &row.solution;
        let stretch =
            Stretch { frequency_hz: orbit.frequency_hz, start: orbit.phase, end: orbit.phase + 1.0 };
        let settings = hammerbeam_motion::general::GeneralSettings::with_tolerance(1e-12);
        let end =
            hammerbeam_motion::general::advance(&subject.0, &stretch, &orbit.nodes[0], &settings).unwrap();
        let largest = orbit.floquet_multipliers[0][0].hypot(orbit.floquet_multipliers[0][1]);
        for (a, b) in end.flow.state.iter().zip(&orbit.nodes[0]) {
            // The orbit is good to 1e-10, which grows with the multiplier.
            assert!((a - b).abs() < 1e-8 * largest.max(1.0), "{a} {b} at {} Hz", orbit.frequency_hz);
        }
    }
}

#[test]
fn a_walk_whose_phase_has_moved_goes_on_with_the_same_bits() {
    let subject = oscillator(0.5 * PI);
    let undisturbed = walk(&subject, usize::MAX);
    for pieces in [1, 7] {
        assert!(undisturbed == walk(&subject, pieces), "{pieces}");
    }
}

/// Searches find the orbit that they find with another phase of the load.
#[test]
fn searches_find_an_orbit_that_is_in_contact_at_phase_0() {
    let (plain, response) = oscillator(PLAIN);
    let expected = find_start(&plain, &response, 0.18, 1, &settings()).unwrap();
    assert!(expected.maxima.contacts > 0);
    // The load that puts the middle of the contact at phase 0.
    let mut integrator = ExactIntegrator::new(plain, ExactSettings::default()).unwrap();
    let stretch = Stretch { frequency_hz: 0.18, start: 0.0, end: 1.0 };
    let touch = &integrator.trace(&stretch, &expected.nodes[0], &[]).unwrap().contacts[0];
    let middle = 0.18 * 0.5 * (touch.begin.as_ref().unwrap().time + touch.end.unwrap());
    let (system, response) = oscillator(PLAIN + 2.0 * PI * middle);
    let effort = SurveyEffort { starts: 2, ..SurveyEffort::default() };
    let surveyed =
        survey(&system, &response, 0.18, &[1], &effort, &settings(), &mut || false).unwrap().found.orbits;
    let found = find_orbits(&system, &response, (0.18, 1), (0.17, 0.19), &settings(), &mut || false).unwrap();
    let started = find_start(&system, &response, 0.18, 1, &settings()).unwrap();
    for orbit in [&surveyed[0], &found.orbits[0], &started] {
        assert!(orbit.phase > 0.0);
        assert_near(orbit.maxima.displacement, expected.maxima.displacement, 1e-7);
    }
}

/// A weight that presses on the stop all the time: its contact never begins.
#[test]
fn a_contact_that_never_opens_is_refused_with_a_reason() {
    let (system, response) = pressed(0.0, 8.0);
    let refused = find_start(&system, &response, 0.05, 1, &settings()).unwrap_err();
    let is_refused = matches!(
        &refused,
        OrbitError::NeverOpens { .. } | OrbitError::Motion(MotionError::StartsInContact { .. })
    );
    assert!(is_refused, "{refused}");
}
