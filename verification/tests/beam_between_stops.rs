//! The shaken beam of van de Vorst et al. between two equal stops, one on either side: symmetry, and the
//! limit of one stop.
//!
//! With equal stops the equations are unchanged by half an excitation period and a change of sign, so there
//! are symmetric orbits: their second half is the first turned over. Everything here follows from that; no
//! number is printed anywhere.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use crate::common::{ObservedSystem, paper_beam_with};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use hammerbeam_motion::{
    Law, Stretch,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, sample},
    law::{LinearStop, TwoSidedStop},
};
use hammerbeam_orbit::{OrbitSettings, PeriodicSolution, find_start};

const STIFFNESS: f64 = 2e4;
const GAP: f64 = 1e-3;

fn spring(gap: f64) -> Law {
    Law::Linear(LinearStop::with_gap(STIFFNESS, gap).unwrap())
}

fn between(gap_above: f64, gap_below: f64) -> ObservedSystem {
    paper_beam_with(0.015, &[(1.0, spring(gap_above)), (-1.0, spring(gap_below))])
}

fn orbit(rig: &ObservedSystem, frequency_hz: f64) -> PeriodicSolution {
    find_start(&rig.system, &rig.response, frequency_hz, 1, &OrbitSettings::default()).unwrap()
}

/// Frequencies at which the symmetric orbit is found from rest, and is stable.
const SYMMETRIC_HZ: [f64; 4] = [16.0, 18.0, 20.0, 26.0];

/// Largest displacement of the contact point relative to the support, and impulse of the stop, to one side.
///
/// The trapezoidal rule over a force that sets in linearly, some hundred points a contact.
fn to_one_side(rig: &ObservedSystem, orbit: &PeriodicSolution, sign: f64) -> (f64, f64) {
    const POINTS: u32 = 20_000;
    let phases: Vec<f64> = (0..POINTS).map(|k| f64::from(k) / f64::from(POINTS)).collect();
    let stretch = Stretch { frequency_hz: orbit.frequency_hz, start: 0.0, end: 1.0 };
    let settings = GeneralSettings::with_tolerance(1e-11);
    let states = sample(&rig.system, &stretch, &orbit.nodes[0], &phases, &settings).unwrap();
    let relative = states.iter().map(|state| -> f64 {
        sign * rig.response.shape.iter().zip(state).map(|(phi, q)| phi * q).sum::<f64>()
    });
    let dt = 1.0 / (orbit.frequency_hz * f64::from(POINTS));
    relative.fold((0.0_f64, 0.0), |(largest, impulse), r| {
        (largest.max(r), impulse + STIFFNESS * (r - GAP).max(0.0) * dt)
    })
}

#[test]
fn second_half_of_the_orbit_is_the_first_turned_over() {
    let rig = between(GAP, GAP);
    for frequency_hz in SYMMETRIC_HZ {
        let orbit = orbit(&rig, frequency_hz);
        assert!(orbit.stable() && orbit.maxima.contacts >= 2, "{frequency_hz} Hz: {:?}", orbit.maxima);
        assert_eq!(orbit.maxima.contacts % 2, 0);
        let mut exact = ExactIntegrator::new(rig.system.clone(), ExactSettings::default()).unwrap();
        let half = Stretch { frequency_hz, start: 0.0, end: 0.5 };
        let turned = exact.advance(&half, &orbit.nodes[0]).unwrap();
        let scale = |i: usize| if i < 6 { rig.system.model().natural_frequencies[i] } else { 1.0 };
        let norm =
            |value: &dyn Fn(usize) -> f64| (0..12).map(|i| (value(i) * scale(i)).powi(2)).sum::<f64>().sqrt();
        let (asymmetry, size) = (norm(&|i| turned[i] + orbit.nodes[0][i]), norm(&|i| turned[i]));
        // The orbit is known to 1e-10 of its norm.
        assert!(asymmetry < 1e-8 * size, "{frequency_hz} Hz: {:.1e}", asymmetry / size);
    }
}

#[test]
fn both_stops_are_hit_equally_hard_and_equally_deep() {
    let rig = between(GAP, GAP);
    for frequency_hz in SYMMETRIC_HZ {
        let orbit = orbit(&rig, frequency_hz);
        let (above, below) = (to_one_side(&rig, &orbit, 1.0), to_one_side(&rig, &orbit, -1.0));
        // Both read off at the same half-period grid.
        assert_relative_eq!(above.0, below.0, max_relative = 1e-6);
        assert_relative_eq!(above.1, below.1, max_relative = 1e-6);
        // The trapezoidal rule.
        assert_relative_eq!(orbit.maxima.impulse, above.1 + below.1, max_relative = 1e-4);
        assert_relative_eq!(orbit.maxima.contact_force, STIFFNESS * (above.0 - GAP), max_relative = 1e-4);
    }
}

/// One element with two contacts is the same as two elements with one each.
#[test]
fn a_clearance_is_two_stops() {
    let law = Law::TwoSided(TwoSidedStop::new(STIFFNESS, GAP, GAP).unwrap());
    let (clearance, stops) = (paper_beam_with(0.015, &[(1.0, law)]), between(GAP, GAP));
    for frequency_hz in SYMMETRIC_HZ {
        let (one, two) = (orbit(&clearance, frequency_hz), orbit(&stops, frequency_hz));
        assert_eq!(one.maxima.contacts, two.maxima.contacts);
        assert_relative_eq!(one.maxima.displacement, two.maxima.displacement, max_relative = 1e-8);
        assert_relative_eq!(one.maxima.contact_force, two.maxima.contact_force, max_relative = 1e-7);
        assert_relative_eq!(one.maxima.impulse, two.maxima.impulse, max_relative = 1e-7);
        let (a, b) = (one.floquet_multipliers[0], two.floquet_multipliers[0]);
        assert_abs_diff_eq!(a[0], b[0], epsilon = 1e-8);
        assert_abs_diff_eq!(a[1], b[1], epsilon = 1e-8);
    }
}

/// As the upper stop is moved away its contacts cease, and from there on the orbit is that of the lower stop
/// alone.
#[test]
fn beam_with_a_far_stop_is_the_beam_with_one_stop() {
    let frequency_hz = 20.0;
    let single = paper_beam_with(0.015, &[(-1.0, spring(GAP))]);
    let alone = orbit(&single, frequency_hz);
    let (reach, _) = to_one_side(&single, &alone, 1.0);
    let mut gaps_that_matter = 0;
    for gap_above in [GAP, 0.9 * reach, 1.1 * reach, 10.0 * reach] {
        let with_both = orbit(&between(gap_above, GAP), frequency_hz);
        let difference = (with_both.maxima.displacement / alone.maxima.displacement - 1.0).abs();
        if gap_above < reach {
            assert!(difference > 1e-3, "{gap_above} m: {difference:.1e}");
            gaps_that_matter += 1;
        } else {
            assert!(difference < 1e-8, "{gap_above} m: {difference:.1e}");
            assert_eq!(with_both.maxima.contacts, alone.maxima.contacts);
        }
    }
    assert!(gaps_that_matter >= 1);
}
