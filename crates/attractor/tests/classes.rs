//! Kinds of attractors, each on motions whose kind is known.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{element, oscillator, paper_beam};
use hammerbeam_attractor::{
    Class, Classified, Effort, MotionDoubt, Patience, SectionMap, StepMap, SystemMap, classify,
};
use hammerbeam_motion::{Law, exact::ExactSettings, law::PowerSpring};

fn short() -> Effort {
    Effort { patience: Patience { skipped: 50, periods: 400, longest: 16 }, aligning: 50, averaged: 1000 }
}

fn kind(map: &mut impl SectionMap, state: &[f64]) -> Classified {
    classify(map, 1, state, &short()).unwrap()
}

/// Henon's map with the area ratio 0.3.
fn henon(a: f64) -> impl SectionMap {
    StepMap::new(2, move |z: &[f64]| {
        (vec![1.0 - a * z[0] * z[0] + z[1], 0.3 * z[0]], faer::mat![[-2.0 * a * z[0], 1.0], [0.3, 0.0]])
    })
}

/// Henon's map is chaotic at 1.4; its fixed point loses stability at `a = 3 (1 - 0.3)^2/4 = 0.3675`, the
/// orbit of period 2 at 0.9125.
#[test]
fn henon_map_is_periodic_or_chaotic_as_is_known() {
    assert_eq!(kind(&mut henon(0.3), &[0.1, 0.1]).class, Class::Periodic { period: 1 });
    assert_eq!(kind(&mut henon(0.6), &[0.1, 0.1]).class, Class::Periodic { period: 2 });
    assert_eq!(kind(&mut henon(0.95), &[0.1, 0.1]).class, Class::Periodic { period: 4 });
    let chaos = kind(&mut henon(1.4), &[0.1, 0.1]);
    assert_eq!(chaos.class, Class::Chaotic, "{:?} {:?}", chaos.largest_exponent, chaos.zero_one);
}

/// A map of the plane with an attracting circle, turned by `2 pi rotation` at each step: quasi-periodic if
/// the rotation is irrational.
fn circle(rotation: f64) -> impl SectionMap {
    StepMap::new(2, move |z: &[f64]| {
        let (sin, cos) = (TAU * rotation).sin_cos();
        let square = z[0] * z[0] + z[1] * z[1];
        let turned = [cos * z[0] - sin * z[1], sin * z[0] + cos * z[1]];
        // r' = r (1.3 - 0.3 r^2): r = 1 attracts with the factor 1.3 - 0.9 = 0.4.
        let factor = 1.3 - 0.3 * square;
        let derivative = faer::Mat::from_fn(2, 2, |i, j| {
            let rotation = [[cos, -sin], [sin, cos]][i][j];
            factor * rotation - 0.6 * turned[i] * z[j]
        });
        (vec![factor * turned[0], factor * turned[1]], derivative)
    })
}

/// The logistic map `x' = r x (1 - x)` just beyond the end of its period doublings, r = 3.5699457, beside a
/// direction that contracts: weak chaos in many narrow bands, and periodic windows. No map of an interval,
/// and no map that shrinks every area, has an invariant circle, so none of its motions is quasi-periodic.
#[test]
fn weak_chaos_in_bands_is_not_called_quasi_periodic() {
    let mut restless = 0;
    for k in 0..40 {
        let r = 3.57 + 2.5e-4 * f64::from(k);
        let mut map = StepMap::new(2, move |z: &[f64]| {
            (vec![r * z[0] * (1.0 - z[0]), 0.5 * z[1]], faer::mat![[r * (1.0 - 2.0 * z[0]), 0.0], [0.0, 0.5]])
        });
        let found = kind(&mut map, &[0.3, 0.1]);
        assert_ne!(
            found.class,
            Class::QuasiPeriodic,
            "{r}: {:?} {:?}",
            found.largest_exponent,
            found.zero_one
        );
        restless += u32::from(found.class.period().is_none());
    }
    assert!(restless > 20, "{restless}");
}

#[test]
fn motion_on_an_invariant_circle_is_quasi_periodic_or_periodic() {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let torus = kind(&mut circle(golden), &[0.3, 0.1]);
    assert_eq!(torus.class, Class::QuasiPeriodic, "{:?} {:?}", torus.largest_exponent, torus.zero_one);
    assert_eq!(kind(&mut circle(0.2), &[0.3, 0.1]).class, Class::Periodic { period: 5 });
}

/// Without damping the free vibration stays: two frequencies, whose ratio is irrational.
#[test]
fn undamped_oscillator_under_an_incommensurate_force_is_quasi_periodic() {
    let frequency_hz = 2f64.sqrt() / TAU;
    let mut map =
        SystemMap::new(oscillator(1.0, 0.0, 0.5, vec![]), frequency_hz, 1, ExactSettings::default()).unwrap();
    let found = kind(&mut map, &[0.7, 0.2]);
    assert_eq!(found.class, Class::QuasiPeriodic, "{:?} {:?}", found.largest_exponent, found.zero_one);
}

/// Ueda (1979): of `x'' + 0.05 x' + x^3 = 7.5 cos t` all motions are chaotic. With `0.2` and `5.5` there are
/// periodic ones.
#[test]
fn ueda_oscillator_is_chaotic() {
    let cubic = || vec![element(&[1.0], 0.0, Law::Power(PowerSpring::cubic(1.0).unwrap()))];
    let system = oscillator(0.0, 0.05, 7.5, cubic());
    let mut map = SystemMap::new(system, 1.0 / TAU, 1, ExactSettings::default()).unwrap();
    let found = kind(&mut map, &[0.0, 0.0]);
    assert_eq!(found.class, Class::Chaotic, "{:?} {:?}", found.largest_exponent, found.zero_one);
}

/// The beam at 34.2 Hz comes to an orbit of 36 periods, more than are looked for, and at 76.07 Hz creeps from
/// an orbit of two periods to one of four just behind the flip: neither is a torus.
#[test]
fn orbits_of_long_periods_and_slow_flips_are_no_tori() {
    for (frequency_hz, skipped, longest) in [(34.2, 10_000, 32), (34.2, 20_000, 64), (76.07, 50, 32)] {
        let mut map = SystemMap::new(paper_beam(), frequency_hz, 1, ExactSettings::default()).unwrap();
        let patience = Patience { skipped, longest, ..Patience::default() };
        let effort = Effort { patience, ..Effort::default() };
        let found = classify(&mut map, 1, &[0.0; 12], &effort).unwrap();
        let expected = match (longest, frequency_hz) {
            (32, 34.2) => Class::Doubtful(MotionDoubt::NotSettled),
            (_, 34.2) => Class::Periodic { period: 36 },
            _ => Class::Periodic { period: 4 },
        };
        assert_eq!(found.class, expected, "{frequency_hz} {longest}: {:?}", found.largest_exponent);
    }
}

/// The paper's beam: harmonic at 36 Hz beside its peak, chaos at 53 Hz.
#[test]
fn beam_is_periodic_at_36_and_chaotic_at_53_hz() {
    for (frequency_hz, expected) in [(36.0, Class::Periodic { period: 1 }), (53.0, Class::Chaotic)] {
        let mut map = SystemMap::new(paper_beam(), frequency_hz, 1, ExactSettings::default()).unwrap();
        let found = kind(&mut map, &[0.0; 12]);
        assert_eq!(found.class, expected, "{:?} {:?}", found.largest_exponent, found.zero_one);
    }
}

/// With no time to settle a periodic motion is not called anything else: here it shrinks by 0.7 per cent in a
/// period.
#[test]
fn motion_that_still_settles_is_doubtful() {
    let mut map =
        SystemMap::new(oscillator(1.0, 4e-3, 0.5, vec![]), 0.3, 1, ExactSettings::default()).unwrap();
    let impatient =
        Effort { patience: Patience { skipped: 1, periods: 5, longest: 4 }, aligning: 1, averaged: 1000 };
    let found = classify(&mut map, 1, &[3.0, 0.0], &impatient).unwrap();
    assert_eq!(found.class, Class::Doubtful(MotionDoubt::NotSettled), "{:?}", found.largest_exponent);
}

/// A motion that settles ever so slowly, on either side of its fixed point in turn or turning about it, looks
/// regular to both indicators: its exponents are within rounding of zero and its series has two frequencies
/// at most. That its returns come closer distinguishes it from a torus.
#[test]
fn motion_that_settles_too_slowly_for_the_exponents_is_doubtful() {
    let impatient =
        Effort { patience: Patience { skipped: 1, periods: 5, longest: 8 }, aligning: 1, averaged: 1000 };
    for turn in [0.5, 0.125, 0.382] {
        let mut map = StepMap::new(2, move |z: &[f64]| {
            let (sin, cos) = (TAU * turn).sin_cos();
            let matrix = 0.999 * faer::mat![[cos, -sin], [sin, cos]];
            let [x, y] = [z[0] - 1.0, z[1] - 1.0];
            let next = vec![
                1.0 + matrix[(0, 0)] * x + matrix[(0, 1)] * y,
                1.0 + matrix[(1, 0)] * x + matrix[(1, 1)] * y,
            ];
            (next, matrix)
        });
        let found = classify(&mut map, 1, &[1.3, 1.1], &impatient).unwrap();
        let largest = found.largest_exponent.unwrap();
        assert!((largest.value - 0.999_f64.ln()).abs() < 1e-9, "above -2/1000: {largest:?}");
        assert_eq!(found.class, Class::Doubtful(MotionDoubt::NotSettled), "{turn}: {:?}", found.zero_one);
    }
}
