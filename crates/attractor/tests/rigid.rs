//! Exponents beside rigid stops and contacts that lose energy: their sums, and what sticking takes.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{beam_with, element, model, oscillator};
use hammerbeam_attractor::{LyapunovSettings, SectionMap, Spectrum, SystemMap, Tangents, lyapunov};
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, System,
    exact::ExactSettings,
    law::{HertzStop, HuntCrossleyStop, LinearStop, RestitutionModel, RestitutionStop, RigidStop},
};

fn rigid(restitution: f64, gap: f64) -> Law {
    Law::Rigid(RigidStop::with_gap(restitution, gap).unwrap())
}

fn settled(system: System, frequency_hz: f64, periods: u64) -> (SystemMap, Vec<f64>) {
    let mut map = SystemMap::new(system, frequency_hz, 1, ExactSettings::default()).unwrap();
    let mut state = vec![0.0; map.dimension()];
    for period in 0..periods {
        state = map.advance(period, &state).unwrap();
    }
    (map, state)
}

fn spectrum(system: System, frequency_hz: f64, averaged: u64) -> (Spectrum, f64) {
    let (mut map, state) = settled(system, frequency_hz, 200);
    let settings = LyapunovSettings { aligning: 20, averaged };
    (lyapunov(&mut map, &state, settings).unwrap(), map.divergence())
}

/// Impact oscillators with stops at the rest position and beyond, whatever their motion: the sum is `-c + 2
/// ln e` times the impacts per time, which are counted by a trace of the same motion.
#[test]
fn every_impact_takes_two_logarithms_of_its_restitution() {
    for (e, gap, frequency) in [(0.8, 0.0, 2.76), (0.8, 1.0, 0.79), (0.5, 0.0, 3.3)] {
        let damping = 0.02;
        let system = oscillator(1.0, damping, 1.0, vec![element(&[1.0], 0.0, rigid(e, gap))]);
        let periods = 200;
        let frequency_hz = frequency / TAU;
        let (found, divergence) = spectrum(system.clone(), frequency_hz, periods);
        // The same motion once more, impact by impact.
        let (mut map, mut state) = settled(system, frequency_hz, 220);
        let mut impacts = 0;
        for period in 0..periods {
            let stretch = hammerbeam_motion::Stretch { frequency_hz, start: 0.0, end: 1.0 };
            impacts += map.integrator().trace(&stretch, &state, &[]).unwrap().contacts.len();
            state = map.advance(period, &state).unwrap();
        }
        assert!((divergence + damping).abs() < 1e-15);
        let expected = -damping + 2.0 * e.ln() * impacts as f64 / found.time;
        assert!(impacts > 20);
        assert!((found.sum / expected - 1.0).abs() < 1e-6, "{e}: {} against {expected}", found.sum);
        assert!((found.expected_sum.unwrap() / expected - 1.0).abs() < 1e-12);
    }
}

/// The beam in contact with laws that lose energy: `-tr(M^-1 C)` plus the mean divergence of the contact,
/// including its dependence on the impact speed.
#[test]
fn sums_agree_with_the_divergence_for_laws_that_lose_energy() {
    let hertz = HertzStop::with_gap(4.5e9, 0.0).unwrap();
    let mut laws = vec![
        ("hunt-crossley".to_owned(), Law::HuntCrossley(HuntCrossleyStop::new(hertz, 0.3).unwrap())),
        (
            "damped".to_owned(),
            Law::Linear(LinearStop::with_gap(1e5, 0.0).unwrap().with_damping(8.0).unwrap()),
        ),
    ];
    for model in RestitutionModel::ALL {
        laws.push((format!("{model:?}"), Law::Restitution(RestitutionStop::new(hertz, model, 0.7).unwrap())));
    }
    for (name, law) in laws {
        let (found, divergence) = spectrum(beam_with(0.015, law), 53.0, 60);
        let expected = found.expected_sum.unwrap();
        assert!(expected < 1.001 * divergence, "{name}: the contact takes nothing");
        let error = (found.sum / expected - 1.0).abs();
        assert!(error < 1e-6, "{name}: {} against {expected}, {error:e}", found.sum);
    }
}

/// Chaos of the beam against a rigid stop, from rest at neighbouring frequencies, whose motions have parted
/// long before: whatever the speeds of its impacts, volumes change in every period by what the dampers and
/// the impacts take, and vanish where the beam sticks.
#[test]
fn volumes_beside_a_rigid_stop_change_by_what_dampers_and_impacts_take() {
    let (mut impacts, mut sticks) = (0, 0);
    for neighbour in 0..10 {
        let system = beam_with(0.015, rigid(0.8, 1e-4));
        let (mut map, state) = settled(system, 53.0 * (1.0 + 1e-9 * f64::from(neighbour)), 100);
        let mut tangents = Tangents::new(&map, 0, &state).unwrap();
        for period in 0..60 {
            tangents.step(&mut map).unwrap();
            let found: f64 = tangents.growth().iter().sum();
            let expected = tangents.growth_of_volume().unwrap();
            if expected == f64::NEG_INFINITY {
                sticks += 1;
                assert_eq!(found, expected, "period {period}");
                assert_eq!(tangents.growth().iter().filter(|growth| growth.is_infinite()).count(), 2);
                continue;
            }
            impacts += usize::from(expected < 0.999 * map.divergence() * map.duration());
            assert!(
                (found / expected - 1.0).abs() < 1e-6,
                "{neighbour}, {period}: {found} against {expected}"
            );
        }
    }
    assert!(impacts > 500 && sticks > 0, "{impacts} periods with impacts, {sticks} with sticking");
}

/// Beside a mode that sticks in every period, one with little damping and one of which 1e-27 is left after a
/// period: what is damped is not what is lost.
#[test]
fn strongly_damped_directions_are_not_lost_where_another_one_sticks() {
    let damping = faer::mat![[0.05, 0.0, 0.0], [0.0, 0.04, 0.0], [0.0, 0.0, 10.0]];
    let model = model(&[1.0, 2.0, 10.0], damping);
    let force = HarmonicForce {
        shape: vec![1.0, 0.3, 0.3],
        harmonic: Harmonic { order: 1, amplitude: 1.0, phase: 0.0 },
    };
    let load = Load { support: vec![], forces: vec![force] };
    let system = System::new(model, &load, vec![element(&[1.0, 0.0, 0.0], 0.0, rigid(0.3, 0.0))]).unwrap();
    let (found, _) = spectrum(system, 0.5 / TAU, 40);
    let values: Vec<f64> = found.exponents.iter().map(|exponent| exponent.value).collect();
    for (value, expected) in values.iter().zip([-0.02, -0.02, -5.0, -5.0]) {
        // Real ones of a pair that turns are known up to one over the time.
        assert!((value - expected).abs() < 1e-3, "{values:?}");
    }
    assert_eq!(values[4..], [f64::NEG_INFINITY; 2]);
}

/// Pressed on, the mass sticks once in every period: both directions are forgotten, and so is any
/// neighbouring state.
#[test]
fn exponents_are_minus_infinity_where_a_stop_sticks() {
    let system = oscillator(1.0, 0.05, 1.0, vec![element(&[1.0], 0.0, rigid(0.3, 0.0))]);
    let (found, _) = spectrum(system, 0.5 / TAU, 20);
    assert_eq!(found.sum, f64::NEG_INFINITY);
    assert_eq!(found.expected_sum, Some(f64::NEG_INFINITY));
    assert!(
        found.exponents.iter().all(|exponent| exponent.value == f64::NEG_INFINITY),
        "{:?}",
        found.exponents
    );
    assert_eq!(found.kaplan_yorke_dimension, 0.0);
}

/// A mass without damping comes to rest in an impact without restitution, at an instant t at which the load
/// pulls it away; nothing but t is left of how it came there. With the load `F cos(W t)` it flies from rest
/// at t until it comes back after the time T with the speed v, where a neighbour that left dt later is `-F
/// cos(W t) sin(w T)/w dt` away and so comes `F cos(W t) sin(w T)/(w v) dt` later: the mean logarithm of that
/// over time is the exponent that is left.
#[test]
fn an_impact_without_restitution_that_does_not_stick_loses_one_direction() {
    for frequency in [2.2, 2.4, 2.8, 4.4] {
        let frequency_hz = frequency / TAU;
        let system = oscillator(1.0, 0.0, 1.0, vec![element(&[1.0], 0.0, rigid(0.0, 0.0))]);
        let (mut map, state) = settled(system, frequency_hz, 200);
        let stretch = hammerbeam_motion::Stretch { frequency_hz, start: 0.0, end: 40.5 };
        let contacts = map.integrator().trace(&stretch, &state, &[]).unwrap().contacts;
        let touches: Vec<_> = contacts.into_iter().filter_map(|contact| contact.begin).collect();
        // Whole cycles: of two flights at 2.8 1/s.
        let last = (touches.len() - 1) / 2 * 2;
        let growth = |pair: &[hammerbeam_motion::exact::Touchdown]| {
            let (from, to) = (&pair[0], &pair[1]);
            let pulled = (frequency * from.time).cos();
            assert!(pulled < 0.0);
            (pulled * (to.time - from.time).sin() / to.velocity).abs().ln()
        };
        let sum: f64 = touches[..=last].windows(2).map(growth).sum();
        let expected = sum / (touches[last].time - touches[0].time);
        let settings = LyapunovSettings { aligning: 20, averaged: 40 };
        let found = lyapunov(&mut map, &state, settings).unwrap();
        let value = found.exponents[0].value;
        assert!((value / expected - 1.0).abs() < 1e-6, "{frequency}: {value} against {expected}");
        assert_eq!(found.exponents[1].value, f64::NEG_INFINITY);
        assert_eq!([Some(found.sum), found.expected_sum], [Some(f64::NEG_INFINITY); 2]);
    }
}
