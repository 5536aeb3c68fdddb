//! Exponents of systems by the exact integrator: invariants, closed forms, and Ueda's oscillator once more.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{beam_with, element, hertz, oscillator, paper_beam};
use hammerbeam_attractor::{LyapunovSettings, SectionMap, Spectrum, SystemMap, lyapunov};
use hammerbeam_motion::{
    Law, System,
    exact::ExactSettings,
    law::{Degree, Formula, LinearStop, PowerSpring, TwoSidedStop},
};

fn spectrum(
    system: System,
    frequency_hz: f64,
    parts: u64,
    (skipped, averaged): (u64, u64),
) -> (Spectrum, f64) {
    let mut map = SystemMap::new(system, frequency_hz, parts, ExactSettings::default()).unwrap();
    let mut state = vec![0.0; map.dimension()];
    for section in 0..skipped * parts {
        state = map.advance(section, &state).unwrap();
    }
    let settings = LyapunovSettings { aligning: 20 * parts, averaged: averaged * parts };
    (lyapunov(&mut map, &state, settings).unwrap(), map.divergence())
}

/// A linear oscillator has the exponents `Re(-c/2 +- sqrt(c^2/4 - k))`, whatever drives it.
#[test]
fn linear_oscillator_has_its_closed_form_exponents() {
    for (stiffness, damping) in [(4.0, 0.3), (1.0, 2.5)] {
        let found = spectrum(oscillator(stiffness, damping, 1.0, vec![]), 0.2, 2, (0, 200)).0;
        let root = (damping * damping / 4.0 - stiffness).max(0.0).sqrt();
        for (exponent, exact) in found.exponents.iter().zip([-damping / 2.0 + root, -damping / 2.0 - root]) {
            // Tangent vectors turn; the influence of their first and last directions falls with the time,
            // 1000 s.
            assert!((exponent.value - exact).abs() < 2e-3, "{exponent:?} {exact}");
        }
        assert!((found.sum + damping).abs() < 1e-9);
    }
}

/// The sum of the exponents is `-tr(M^-1 C)` in chaos, for every law without loss, to 1e-6 of it.
#[test]
fn exponents_add_up_to_the_divergence_for_every_loss_free_law() {
    let laws = [
        ("hertz", hertz(4.5e9, 0.0)),
        ("linear", Law::Linear(LinearStop::with_gap(5e5, 0.0).unwrap())),
        ("two-sided", Law::TwoSided(TwoSidedStop::new(5e5, 1e-4, 2e-4).unwrap())),
        ("cubic", Law::Power(PowerSpring::cubic(1e9).unwrap())),
    ];
    for (name, law) in laws {
        let (found, divergence) = spectrum(beam_with(0.015, law), 53.0, 4, (100, 100));
        let error = (found.sum / divergence - 1.0).abs();
        assert!(error < 1e-6, "{name}: {} against {divergence}, {error:e}", found.sum);
    }
}

/// Where a motion is periodic its exponents are `ln |multiplier| / T`; the leading one is asked for again by
/// a longer average.
#[test]
fn sections_of_any_length_give_the_same_exponents() {
    let of = |parts| spectrum(paper_beam(), 53.0, parts, (200, 400)).0;
    let (coarse, fine) = (of(2), of(8));
    // Both are the same motion as long as rounding has not parted them, then two samples of the same
    // attractor.
    let (a, b) = (coarse.exponents[0], fine.exponents[0]);
    assert!((a.value - b.value).abs() < a.half_width + b.half_width, "{a:?} {b:?}");
}

/// Chaos of the paper's beam at 53 Hz, where none of its branches is stable.
#[test]
fn largest_exponent_of_the_beam_at_53_hz_is_surely_positive() {
    let (found, _) = spectrum(paper_beam(), 53.0, 2, (200, 600));
    assert!(found.exponents[0].low() > 1.0, "{:?}", found.exponents[0]);
}

/// Ueda's oscillator as a system with a cubic spring: 0.1034 and -0.1534 (Sprott 2003), here from the exact
/// integrator.
#[test]
fn ueda_oscillator_as_a_system_has_the_published_exponents() {
    let cubic = element(&[1.0], 0.0, Law::Power(PowerSpring::cubic(1.0).unwrap()));
    let (found, divergence) = spectrum(oscillator(0.0, 0.05, 7.5, vec![cubic]), 1.0 / TAU, 4, (100, 3000));
    for (exponent, published) in found.exponents.iter().zip([0.1034, -0.1534]) {
        assert!((exponent.value - published).abs() < 0.5e-4 + 2.0 * exponent.half_width, "{exponent:?}");
        assert!(exponent.half_width < 2e-2);
    }
    assert!((found.sum - divergence).abs() < 1e-6);
}

/// A mass between two wells, `x'' + 0.25 x' - x + x^3 = 0.4 cos t`: 0.1572 and -0.4072 (Sprott 2003, appendix
/// A), with a linear element that pushes away from the middle.
#[test]
fn two_well_oscillator_has_the_published_exponents() {
    let springs = [(-1.0, Degree::Linear), (1.0, Degree::Cubic)];
    let elements =
        springs.map(|(k, degree)| element(&[1.0], 0.0, Law::Power(PowerSpring::new(k, degree).unwrap())));
    let (found, divergence) =
        spectrum(oscillator(0.0, 0.25, 0.4, elements.to_vec()), 1.0 / TAU, 4, (100, 3000));
    for (exponent, published) in found.exponents.iter().zip([0.1572, -0.4072]) {
        assert!((exponent.value - published).abs() < 0.5e-4 + 2.0 * exponent.half_width, "{exponent:?}");
        assert!(exponent.half_width < 2e-2);
    }
    assert!((found.sum - divergence).abs() < 1e-6);
}

/// The same by a formula, whose damper replaces the structure's: its change of volumes is all there is of the
/// sum.
#[test]
fn ueda_oscillator_by_a_formula_has_the_published_exponents() {
    let formula = element(&[1.0], 0.0, Law::Formula(Formula::new("x^3 + 0.05*v", &[]).unwrap()));
    let (found, _) = spectrum(oscillator(0.0, 0.0, 7.5, vec![formula]), 1.0 / TAU, 4, (100, 3000));
    for (exponent, published) in found.exponents.iter().zip([0.1034, -0.1534]) {
        assert!((exponent.value - published).abs() < 0.5e-4 + 2.0 * exponent.half_width, "{exponent:?}");
        assert!(exponent.half_width < 2e-2);
    }
    assert!((found.sum + 0.05).abs() < 1e-6);
}
