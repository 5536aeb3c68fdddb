//! Where to look for attractors, and few motions that find them.

use std::f64::consts::TAU;

use crate::common::events::oscillator;
use hammerbeam_motion::{
    Law, Load, LocalElement, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    law::{LinearStop, PowerSpring, RigidStop, TwoSidedStop},
};
use hammerbeam_orbit::{
    OrbitSettings, PeriodicSolution, ProbeStarts, SurveyEffort, TrialEffort, linear_contact_ranges,
    mirror_image, newton_trials, probe,
};

fn rigid(gap: f64) -> Law {
    Law::Rigid(RigidStop::with_gap(0.8, gap).unwrap())
}

/// Of `x'' + c x' + x = F cos W t` the amplitude is `F/|1 - W^2 + i c W|`: it is the gap g where `s = W^2`
/// solves `s^2 - (2 - c^2) s + 1 - (F/g)^2 = 0`.
fn closed_form([c, force, gap]: [f64; 3]) -> [f64; 2] {
    let (half, constant) = (1.0 - 0.5 * c * c, 1.0 - (force / gap).powi(2));
    let root = (half * half - constant).sqrt();
    [half - root, half + root].map(|s| s.sqrt() / TAU)
}

/// The impact oscillator of the documentation, and one whose impacts span a thousandth of the range.
#[test]
fn linear_response_reaches_a_gap_where_the_closed_form_says() {
    for [c, force, gap] in [[0.04, 0.4, 1.0], [1e-3, 1e-3, 0.8], [0.3, 1.0, 2.0]] {
        let (system, response) = oscillator(1.0, c, force, rigid(gap));
        let settings = OrbitSettings::default();
        let ranges = linear_contact_ranges(&system, &response, (0.01, 1.0), &settings).unwrap();
        let expected = closed_form([c, force, gap]);
        assert_eq!(ranges.len(), 1, "{ranges:?}");
        for (found, expected) in ranges[0].iter().zip(expected) {
            // A parabola through samples of a sixteenth of a cycle is off by 2e-4 of the amplitude at most.
            assert!((found / expected - 1.0).abs() < 3e-4, "{found} Hz, {expected} Hz");
        }
    }
}

#[test]
fn a_gap_that_is_never_or_always_reached_gives_no_range() {
    for gap in [1e-9, 100.0] {
        let (system, response) = oscillator(1.0, 0.04, 0.4, rigid(gap));
        let settings = OrbitSettings::default();
        assert_eq!(linear_contact_ranges(&system, &response, (0.05, 0.5), &settings).unwrap(), [[0.0; 2]; 0]);
    }
}

fn about(about_linear: usize, on_backbones: usize) -> ProbeStarts<'static> {
    ProbeStarts { about_linear, on_backbones, unsettled: &[], known: &[] }
}

fn found(law: Law, [c, force, frequency_hz]: [f64; 3], starts: ProbeStarts<'_>) -> Vec<PeriodicSolution> {
    let (system, response) = oscillator(1.0, c, force, law);
    let effort = SurveyEffort { settling: 900, ..SurveyEffort::default() };
    let settings = OrbitSettings::default();
    let orbit = (frequency_hz, &[1, 3][..]);
    probe(&system, &response, orbit, (starts, &effort), &settings, &mut || false).unwrap().orbits
}

/// `x'' + 0.005 x' + x + x^3 = 0.3 cos 5 t` has a subharmonic solution of three periods near the amplitude
/// `sqrt(4/3 ((5/3)^2 - 1)) = 1.54`, 120 times the linear response (Nayfeh and Mook, *Nonlinear
/// Oscillations*, 1979, section 4.1.4).
#[test]
fn a_subharmonic_of_large_amplitude_is_found_from_the_backbone_and_not_from_the_linear_response() {
    let spring = || Law::Power(PowerSpring::cubic(1.0).unwrap());
    let near = found(spring(), [0.005, 0.3, 5.0 / TAU], about(7, 0));
    assert!(near.iter().all(|orbit| orbit.period_multiple == 1), "{near:?}");
    let far = found(spring(), [0.005, 0.3, 5.0 / TAU], about(0, 12));
    let subharmonic = far.iter().find(|orbit| orbit.period_multiple == 3).expect("it is found");
    let amplitude = (4.0_f64 / 3.0 * (25.0 / 9.0 - 1.0)).sqrt();
    assert!(
        (subharmonic.maxima.displacement / amplitude - 1.0).abs() < 0.1,
        "{}",
        subharmonic.maxima.displacement
    );
}

/// `x'' + 0.01 x' + 1.5 x + x^3 = 2 cos W t` has two solutions of three periods, mirror images of each other,
/// on closed branches from 0.3864 to 0.4146 Hz. Motions that start about the linear response seldom come to
/// them, and take hundreds of periods.
#[test]
fn few_trials_at_each_of_some_frequencies_meet_a_subharmonic_branch() {
    let (system, response) = oscillator(1.5, 0.01, 2.0, Law::Power(PowerSpring::cubic(1.0).unwrap()));
    let settings = OrbitSettings::default();
    let found_at = |k: u32| {
        let orbit = (0.388 + 0.003 * f64::from(k), &[3][..]);
        let trials = TrialEffort { trials: 12, seed: u64::from(k) };
        newton_trials(&system, &response, orbit, trials, &settings, &mut || false).unwrap().orbits
    };
    let found: Vec<_> = (0..8).flat_map(found_at).collect();
    assert!(found.iter().all(|orbit| orbit.period_multiple == 3), "{found:?}");
    assert!(found.iter().any(PeriodicSolution::stable), "{found:?}");
}

#[test]
fn motions_that_settle_on_one_orbit_give_it_once() {
    let orbits = found(rigid(1.0), [0.04, 0.4, 0.1], about(4, 0));
    let harmonic = orbits.iter().filter(|orbit| orbit.period_multiple == 1).count();
    assert!(harmonic >= 1 && orbits.len() <= 2, "{orbits:?}");
}

fn with(laws: &[(f64, Law)]) -> System {
    let (system, _) = oscillator(1.0, 0.1, 10.0, laws[0].1.clone());
    let load = |amplitude| hammerbeam_motion::HarmonicForce {
        shape: vec![1.0],
        harmonic: hammerbeam_motion::Harmonic { order: 1, amplitude, phase: 0.0 },
    };
    let element = |(sign, law): &(f64, Law)| LocalElement {
        name: "element".into(),
        shape: vec![*sign],
        support_ratios: vec![0.0],
        law: law.clone(),
    };
    let loads = Load { support: vec![], forces: vec![load(10.0)] };
    System::new(system.model().clone(), &loads, laws.iter().map(element).collect()).unwrap()
}

#[test]
fn orbits_that_are_known_are_not_found_again() {
    let spring = || Law::Power(PowerSpring::cubic(1.0).unwrap());
    let numbers = [0.05, 0.3, 1.4 / TAU];
    let both = found(spring(), numbers, about(7, 4));
    assert_eq!(both.len(), 2, "the upper and the lower of the two folds' branches");
    assert!(found(spring(), numbers, ProbeStarts { known: &both, ..about(7, 4) }).is_empty());
    let [upper, lower] = &both[..] else { return };
    for (known, other) in [(upper, lower), (lower, upper)] {
        let known = std::slice::from_ref(known);
        let found = found(spring(), numbers, ProbeStarts { known, ..about(7, 4) });
        assert_eq!(found.len(), 1);
        assert!((found[0].maxima.displacement / other.maxima.displacement - 1.0).abs() < 1e-6);
    }
}

#[test]
fn a_system_is_symmetric_if_forces_change_their_sign_with_the_displacement() {
    let stop = Law::Linear(LinearStop::with_gap(20.0, 0.5).unwrap());
    let cubic = Law::Power(PowerSpring::cubic(1.0).unwrap());
    let even = Law::TwoSided(TwoSidedStop::new(20.0, 0.5, 0.5).unwrap());
    let uneven = Law::TwoSided(TwoSidedStop::new(20.0, 0.5, 0.6).unwrap());
    assert!(with(&[(1.0, cubic)]).is_symmetric() && with(&[(1.0, even)]).is_symmetric());
    assert!(with(&[(1.0, stop.clone()), (-1.0, stop.clone())]).is_symmetric(), "opposite stops");
    assert!(!with(&[(1.0, stop.clone())]).is_symmetric() && !with(&[(1.0, uneven)]).is_symmetric());
    assert!(!with(&[(1.0, stop), (-1.0, rigid(0.5))]).is_symmetric());
}

/// Ueda's oscillator has asymmetric solutions: the image of each is one, and another one.
#[test]
fn the_mirror_image_of_an_asymmetric_orbit_is_another_orbit() {
    let spring = Law::Power(PowerSpring::cubic(1.0).unwrap());
    let (system, _) = oscillator(1e-6, 0.1, 10.0, spring.clone());
    let mut motion = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
    let mut asymmetric = 0;
    for frequency_hz in [0.13, 0.15, 0.17, 0.19, 0.21, 0.23, 0.25, 0.27] {
        let (system, response) = oscillator(1e-6, 0.1, 10.0, spring.clone());
        let (effort, settings) = (SurveyEffort::default(), OrbitSettings::default());
        let starts = about(4, 4);
        let orbit = (frequency_hz, &[1, 2][..]);
        let found = probe(&system, &response, orbit, (starts, &effort), &settings, &mut || false).unwrap();
        for image in found.orbits.iter().map(mirror_image) {
            let periods = f64::from(image.period_multiple);
            let stretch = Stretch { frequency_hz, start: image.phase, end: image.phase + periods };
            let later = motion.advance(&stretch, &image.nodes[0]).unwrap();
            let off = later.iter().zip(&image.nodes[0]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-7, "{off:.1e} at {frequency_hz} Hz");
            let half = Stretch { frequency_hz, start: image.phase, end: image.phase + 0.5 };
            let half = motion.advance(&half, &image.nodes[0]).unwrap();
            asymmetric += usize::from((half[0] + image.nodes[0][0]).abs() > 1e-3);
        }
    }
    assert!(asymmetric > 0);
}
