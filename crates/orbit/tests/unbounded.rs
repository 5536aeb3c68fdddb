//! Branches that go to infinity: undamped resonances, against the amplitude `F/|k - m w^2|` of a linear
//! oscillator.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::events;
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, System,
    law::{LinearStop, PowerSpring},
};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, OrbitError, OrbitSettings, ResonantMode, Response, Side, StopReason, find_orbits,
    find_start, settled_orbit,
};
use hammerbeam_structure::ReducedModel;

use hammerbeam_testkit::structures::unit_mass;

/// Range of the frequency around 1 rad/s [Hz].
const RANGE: (f64, f64) = (0.06, 0.3);
/// Eigenfrequency [Hz].
const NATURAL: f64 = 1.0 / TAU;

/// `x'' + damping x' + x = cos w t`, and a stop of stiffness 5 at the gap if there is one.
fn oscillator(damping: f64, gap: Option<f64>) -> (System, Response) {
    let model: ReducedModel = unit_mass(1.0, damping);
    let harmonic = Harmonic { order: 1, amplitude: 1.0, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let stop = |gap| LocalElement {
        name: "stop".into(),
        shape: vec![1.0],
        support_ratios: vec![0.0],
        law: Law::Linear(LinearStop::with_gap(5.0, gap).unwrap()),
    };
    let system = System::new(model, &load, gap.map(stop).into_iter().collect()).unwrap();
    (system, Response { shape: vec![1.0], support_ratios: vec![0.0] })
}

/// A whole side of the branch through the linear response, taken up from its checkpoint after so many steps
/// each time.
fn walk(
    (system, response): &(System, Response),
    (from_hz, side): (f64, Side),
    at_once: usize,
) -> (Vec<BranchRow>, StopReason) {
    let settings = OrbitSettings { max_step: 1e-3, ..OrbitSettings::default() };
    let start = find_start(system, response, from_hz, 1, &settings).unwrap();
    let mut walk = BranchWalk::new(system, response, &start, side, RANGE, &settings).unwrap();
    let (mut rows, mut journal) = (Vec::new(), Vec::new());
    for step in 1.. {
        if let Some(reason) = walk.step(&mut rows).unwrap() {
            return (rows, reason);
        }
        assert!(rows.len() < 20_000, "no end of it");
        if step % at_once == 0 {
            journal.extend(walk.take_journal());
            let stored = (walk.checkpoint(), journal.clone());
            walk = BranchWalk::resume(system, response, (&stored.0, &stored.1), RANGE, &settings).unwrap();
        }
    }
    unreachable!()
}

#[test]
fn both_sides_of_an_undamped_resonance_are_the_closed_form_and_end_at_it() {
    let system = oscillator(0.0, None);
    for (from_hz, side) in [(0.1, Side::Up), (0.29, Side::Down)] {
        let (rows, reason) = walk(&system, (from_hz, side), usize::MAX);
        for row in &rows {
            let solution = &row.solution;
            let w = TAU * solution.frequency_hz;
            // A point is within 1e-10 of a hundredth of the range from the path: 2.4e-13 Hz, twice that
            // relative to 0.159 Hz in w^2.
            let resolved = 3e-12 / (1.0 - w * w).abs() + 1e-8;
            let error = solution.maxima.displacement * (1.0 - w * w).abs() - 1.0;
            assert!(error.abs() < resolved, "{error:.1e} at {} Hz", solution.frequency_hz);
        }
        let StopReason::Unbounded { place: frequency_hz, mode } = reason else { panic!("{reason:?}") };
        assert!((frequency_hz / NATURAL - 1.0).abs() < 1e-7, "{frequency_hz}");
        let Some(ResonantMode { number, frequency_hz, damping_ratio }) = mode else { panic!("no mode") };
        assert_eq!((number, damping_ratio), (1, 0.0));
        assert!((frequency_hz / NATURAL - 1.0).abs() < 1e-14);
    }
}

#[test]
fn a_walk_that_was_stored_on_its_way_to_infinity_ends_with_the_same_bits() {
    let system = oscillator(0.0, None);
    let whole = walk(&system, (0.1, Side::Up), usize::MAX);
    assert_eq!(walk(&system, (0.1, Side::Up), 37), whole);
}

/// A motion thousands of times as large as that from rest, whose steps Newton's method bounds by the size of
/// the motion: the linear response is where it begins.
#[test]
fn the_orbit_beside_an_undamped_resonance_is_found_on_both_sides() {
    let (system, response) = oscillator(0.0, None);
    let settings = OrbitSettings::default();
    for part in [-1e-4, -1e-5, -2e-6, 2e-6, 1e-5, 1e-4] {
        let orbit = (NATURAL * (1.0 + part), 1);
        let found = find_orbits(&system, &response, orbit, RANGE, &settings, &mut || false).unwrap();
        let [orbit] = &found.orbits[..] else { panic!("{} orbits at {part}", found.orbits.len()) };
        let w = TAU * orbit.frequency_hz;
        let error = orbit.maxima.displacement * (1.0 - w * w).abs() - 1.0;
        assert!(error.abs() < 1e-9, "{error:.1e} at {part}");
    }
}

/// The peak of a damping ratio of 1e-5 is 5e4 times the static amplitude, and finite.
#[test]
fn a_weakly_damped_resonance_is_passed() {
    let (rows, reason) = walk(&oscillator(2e-5, None), (0.1, Side::Up), usize::MAX);
    assert_eq!(reason, StopReason::RangeEnd { place: RANGE.1 });
    let largest = rows.iter().map(|row| row.solution.maxima.displacement).fold(0.0, f64::max);
    assert!((largest / 5e4 - 1.0).abs() < 1e-2, "{largest}");
}

/// At half the eigenfrequency `x = cos(w t)/(1 - w^2)` has the period of any free vibration, which may be
/// added: orbits of two parameters at one frequency.
#[test]
fn a_walk_among_free_vibrations_at_half_the_eigenfrequency_ends() {
    let (system, response) = oscillator(0.0, Some(10.0));
    let settings = OrbitSettings { max_step: 1e-3, ..OrbitSettings::default() };
    for free in [0.2, 3.0] {
        let state = [4.0 / 3.0 + free, 0.0];
        let orbit = (0.5 * NATURAL, 1);
        let start = settled_orbit(&system, &response, &state, orbit, &settings).unwrap().unwrap();
        for side in [Side::Up, Side::Down] {
            let mut walk = BranchWalk::new(&system, &response, &start, side, RANGE, &settings).unwrap();
            let mut rows = Vec::new();
            let reason = (0..100).find_map(|_| walk.step(&mut rows).unwrap());
            let Some(StopReason::FreeVibration { place: frequency_hz, mode }) = reason else {
                panic!("{reason:?}")
            };
            assert!((frequency_hz / NATURAL - 0.5).abs() < 1e-15 && mode.number == 1);
        }
    }
}

/// Of such orbits a search keeps one, and says why; with little damping there is one, and nothing to say.
/// At twice the eigenfrequency they take two excitation periods.
#[test]
fn of_orbits_that_differ_in_a_free_vibration_a_search_keeps_one() {
    let settings = OrbitSettings { max_step: 1e-2, ..OrbitSettings::default() };
    let search = |damping: f64, gap: Option<f64>, orbit: (f64, u32)| {
        let (system, response) = oscillator(damping, gap);
        find_orbits(&system, &response, orbit, RANGE, &settings, &mut || false).unwrap()
    };
    let cases = [(None, 0.5 * NATURAL, 1), (Some(10.0), 0.5 * NATURAL, 1), (None, 2.0 * NATURAL, 2)];
    for (gap, frequency_hz, multiple) in cases {
        let found = search(0.0, gap, (frequency_hz, multiple));
        let untouching = found.orbits.iter().filter(|orbit| orbit.maxima.contacts == 0).count();
        assert_eq!(untouching, 1, "{gap:?}, {frequency_hz} Hz");
        let Some(OrbitError::FreeVibration { base_hz, mode }) = found.incomplete else {
            panic!("{gap:?}, {frequency_hz} Hz: {:?}", found.incomplete)
        };
        assert!(base_hz == frequency_hz / f64::from(multiple) && mode.number == 1);
    }
    let damped = search(0.02, None, (0.5 * NATURAL, 1));
    assert!(damped.orbits.len() == 1 && damped.incomplete.is_none(), "{:?}", damped.incomplete);
}

/// A branch of the range that begins at half the eigenfrequency ends there, and says why.
#[test]
fn a_walk_down_to_half_the_eigenfrequency_ends_at_its_free_vibrations() {
    let (system, response) = oscillator(0.0, None);
    let settings = OrbitSettings { max_step: 1e-3, ..OrbitSettings::default() };
    let start = find_start(&system, &response, 0.75 * NATURAL, 1, &settings).unwrap();
    let range_hz = (0.5 * NATURAL, 0.8 * NATURAL);
    let mut walk = BranchWalk::new(&system, &response, &start, Side::Down, range_hz, &settings).unwrap();
    let mut rows = Vec::new();
    let reason = (0..1000).find_map(|_| walk.step(&mut rows).unwrap());
    let is_end = match reason {
        Some(StopReason::RangeEnd { .. }) => true,
        Some(StopReason::FreeVibration { mode, .. }) => mode.number == 1,
        _ => false,
    };
    let last_hz = rows.last().unwrap().solution.frequency_hz;
    assert!(is_end && (last_hz / range_hz.0 - 1.0).abs() < 1e-6, "{reason:?} at {last_hz}");
}

/// The amplitude grows ten thousand times at the linear resonance until it meets the stop; then the frequency
/// grows.
#[test]
fn a_stop_that_is_still_ahead_turns_an_undamped_resonance() {
    let gap = 1e4;
    let (rows, _) = walk(&oscillator(0.0, Some(gap)), (0.1, Side::Up), usize::MAX);
    let beyond = rows.iter().filter(|row| row.solution.maxima.displacement > 1.5 * gap);
    let highest = beyond.map(|row| row.solution.frequency_hz).fold(0.0, f64::max);
    assert!(highest > 1.1 * NATURAL, "{highest}");
}

/// A superharmonic branch of an undamped hardening oscillator climbs until the forced motion and its
/// neighbours, which differ in a free vibration, are closer than rounding resolves: its end says so. The
/// range is wide, as rounding decides how far it comes: up to 0.3163 Hz it ended at 0.28 Hz, or not at all.
#[test]
fn a_branch_of_motions_without_losses_ends_with_that_word() {
    let law = Law::Power(PowerSpring::cubic(0.0353).unwrap());
    let subject = events::oscillator(1.0, 0.0, 1.0, law);
    let (settings, range) = (events::step_of(5e-4), (0.0759, 3.0));
    let found = find_orbits(&subject.0, &subject.1, (0.08, 1), range, &settings, &mut || false).unwrap();
    // The largest comes first.
    assert!(found.orbits[0].maxima.displacement > 5.0);
    let (rows, reason) = events::side(&subject, &found.orbits[0], Side::Up, range, &settings);
    assert!(rows.len() > 500, "{} rows", rows.len());
    assert!(matches!(reason, StopReason::StepTooShort { has_no_losses: true, .. }), "{reason}");
}
