//! Sweeps and diagrams: hysteresis, and every periodic motion against orbits found by shooting.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{element, oscillator, paper_beam};
use hammerbeam_attractor::{
    Class, Effort, Observable, Patience, SweepPoint, SweepSettings, Sweeper, frequencies,
};
use hammerbeam_motion::{Law, System, exact::ExactSettings, law::PowerSpring};
use hammerbeam_orbit::{OrbitSettings, Response, find_orbits};

fn sweeper(system: &System, shape: &[f64], support_ratio: f64) -> Sweeper {
    let settings = SweepSettings {
        effort: Effort { patience: Patience { skipped: 50, periods: 600, longest: 16 }, ..Effort::default() },
        sampled: 32,
        motion: ExactSettings::default(),
    };
    Sweeper::new(system, &Observable { shape: shape.to_vec(), support_ratios: vec![support_ratio] }, settings)
        .unwrap()
}

fn duffing() -> System {
    let cubic = element(&[1.0], 0.0, Law::Power(PowerSpring::cubic(1.0).unwrap()));
    oscillator(1.0, 0.1, 0.3, vec![cubic])
}

fn swept(sweeper: &mut Sweeper, frequencies: &[f64], mut state: Vec<f64>) -> Vec<SweepPoint> {
    let mut points: Vec<SweepPoint> = Vec::new();
    for &frequency_hz in frequencies {
        let point = sweeper.at(frequency_hz, &state).unwrap();
        state.clone_from(&point.state);
        points.push(point);
    }
    points
}

/// Largest displacements of the stable orbits that shooting finds.
fn orbits(
    system: &System,
    shape: &[f64],
    support_ratio: f64,
    orbit: (f64, u32),
    range: (f64, f64),
) -> Vec<f64> {
    let response = Response { shape: shape.to_vec(), support_ratios: vec![support_ratio] };
    let settings = OrbitSettings::default();
    let found = find_orbits(system, &response, orbit, range, &settings, &mut || false).unwrap();
    found.orbits.iter().filter(|orbit| orbit.stable()).map(|orbit| orbit.maxima.displacement).collect()
}

/// A hardening spring: the sweep up stays on the resonant motion where the sweep down does not, and both are
/// orbits that shooting finds.
#[test]
fn sweeps_up_and_down_follow_the_two_branches_of_a_duffing_oscillator() {
    let system = duffing();
    let mut sweeper = sweeper(&system, &[1.0], 0.0);
    let upward = frequencies(0.15, 0.4, 0.01).unwrap();
    let up = swept(&mut sweeper, &upward, vec![0.0; 2]);
    let mut downward = upward.clone();
    downward.reverse();
    let mut down = swept(&mut sweeper, &downward, up[up.len() - 1].state.clone());
    down.reverse();
    let mut apart = 0;
    for (up, down) in up.iter().zip(&down) {
        assert_eq!((up.class, down.class), (Class::Periodic { period: 1 }, Class::Periodic { period: 1 }));
        let ratio = up.max_abs_displacement / down.max_abs_displacement;
        assert!(ratio > 1.0 - 1e-6, "{} Hz: {ratio}", up.frequency_hz);
        apart += usize::from(ratio > 1.1);
    }
    assert!((3..up.len() - 3).contains(&apart), "{apart} frequencies with two motions");
    let at = 10;
    let stable = orbits(&system, &[1.0], 0.0, (up[at].frequency_hz, 1), (0.08, 0.5));
    assert_eq!(stable.len(), 2, "at {} Hz two stable motions coexist", up[at].frequency_hz);
    for point in [&up[at], &down[at]] {
        let near = stable.iter().map(|orbit| (orbit / point.max_abs_displacement - 1.0).abs());
        // The motion has repeated to 1e-8.
        assert!(near.fold(f64::INFINITY, f64::min) < 1e-6);
    }
}

/// Of the beam from several states at two frequencies: each periodic motion is an orbit of that period that
/// shooting finds.
#[test]
fn periodic_motions_of_the_beam_are_orbits() {
    let system = paper_beam();
    let point = system.model().points[0].clone();
    let mut sweeper = sweeper(&system, &point.shape, point.support_ratios[0]);
    for frequency_hz in [30.0, 60.0] {
        let mut periodic = 0;
        for start in sweeper.starts(frequency_hz, 3).unwrap() {
            let found = sweeper.at(frequency_hz, &start).unwrap();
            let Class::Periodic { period } = found.class else { continue };
            periodic += 1;
            assert_eq!(found.samples.len(), period);
            let orbit = (frequency_hz, period as u32);
            let stable = orbits(
                &system,
                &point.shape,
                point.support_ratios[0],
                orbit,
                (frequency_hz - 1.0, frequency_hz + 1.0),
            );
            let near = stable.iter().map(|orbit| (orbit / found.max_abs_displacement - 1.0).abs());
            assert!(
                near.fold(f64::INFINITY, f64::min) < 1e-6,
                "{frequency_hz} Hz, {:?}, {stable:?}",
                found.class
            );
        }
        assert!(periodic > 0, "{frequency_hz} Hz");
    }
}

#[test]
fn starts_are_the_same_every_time_and_the_first_is_rest() {
    let mut sweeper = sweeper(&paper_beam(), &paper_beam().model().points[0].shape, 1.0);
    let (first, again) = (sweeper.starts(40.0, 9).unwrap(), sweeper.starts(40.0, 9).unwrap());
    assert!(first == again && first.len() == 9);
    assert!(first[0].iter().all(|entry| *entry == 0.0));
    assert_eq!(sweeper.starts(40.0, 1).unwrap().len(), 1);
}
