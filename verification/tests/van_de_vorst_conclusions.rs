//! van de Vorst, Fey, de Kraker, van Campen: what the text concludes, in numbers.
//! docs/validation/conclusions.md has the tables.
//!
//! The peaks are those of an independent adaptive Runge-Kutta integration of the full equations, read off to
//! a tenth of a hertz and a hundredth of a millimetre; the tolerances are these digits and twice these
//! digits.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::TAU;

use crate::common::{ObservedSystem, hertz, paper_beam, paper_beam_model, paper_beam_with, shaken, walk};
use hammerbeam_motion::{
    LocalElement, Stretch, System,
    general::{GeneralSettings, sample},
};
use hammerbeam_orbit::{BranchRow, OrbitSettings, PeriodicSolution, Response, Side, find_start};

/// A branch in steps of 0.05 Hz, from the lower end of a range to the upper one.
fn branch(rig: &ObservedSystem, start_hz: f64, period_multiple: u32, range_hz: (f64, f64)) -> Vec<BranchRow> {
    branch_in_steps(0.05, rig, (start_hz, period_multiple), range_hz)
}

fn branch_in_steps(
    max_step: f64,
    rig: &ObservedSystem,
    (start_hz, period_multiple): (f64, u32),
    range_hz: (f64, f64),
) -> Vec<BranchRow> {
    let settings = OrbitSettings { max_step, ..OrbitSettings::default() };
    let start = find_start(&rig.system, &rig.response, start_hz, period_multiple, &settings).unwrap();
    let (mut rows, _, _) = walk(rig, &start, Side::Down, range_hz, &settings);
    rows.reverse();
    rows.extend(walk(rig, &start, Side::Up, range_hz, &settings).0.into_iter().skip(1));
    rows
}

/// The highest row of some frequencies.
fn peak(rows: &[BranchRow], low_hz: f64, high_hz: f64) -> &PeriodicSolution {
    let within = rows.iter().map(|row| &row.solution);
    let within = within.filter(|orbit| (low_hz..=high_hz).contains(&orbit.frequency_hz));
    within.max_by(|a, b| a.maxima.displacement.total_cmp(&b.maxima.displacement)).unwrap()
}

#[track_caller]
fn assert_peak(orbit: &PeriodicSolution, frequency_hz: f64, displacement_mm: f64) {
    let (at, height) = (orbit.frequency_hz, 1e3 * orbit.maxima.displacement);
    assert!((at - frequency_hz).abs() < 0.1, "{at} Hz, expected {frequency_hz}");
    assert!((height - displacement_mm).abs() < 0.02, "{height} mm, expected {displacement_mm}");
    assert!(orbit.stable());
}

#[test]
fn harmonic_peaks_are_4_97_mm_at_32_8_hz_and_5_90_mm_at_36_3_hz() {
    let rows = branch(&paper_beam(), 30.0, 1, (29.0, 38.0));
    assert_peak(peak(&rows, 30.0, 34.0), 32.8, 4.97);
    assert_peak(peak(&rows, 35.0, 37.5), 36.3, 5.90);
}

#[test]
fn half_subharmonic_peaks_are_7_39_mm_at_65_9_hz_and_9_28_mm_at_72_3_hz() {
    let rows = branch(&paper_beam(), 66.5, 2, (62.0, 75.0));
    assert_peak(peak(&rows, 63.0, 68.0), 65.9, 7.39);
    assert_peak(peak(&rows, 70.0, 75.0), 72.3, 9.28);
}

#[test]
fn third_subharmonic_peaks_are_11_24_mm_at_99_5_hz_and_16_26_mm_at_108_hz() {
    let rows = branch(&paper_beam(), 99.0, 3, (97.0, 110.0));
    assert_peak(peak(&rows, 97.5, 102.0), 99.5, 11.24);
    assert_peak(peak(&rows, 105.0, 109.9), 108.0, 16.26);
}

/// Amplitudes of the harmonics of an orbit of two periods, in the displacement relative to the support: order
/// k at k f/2.
fn harmonics(rig: &ObservedSystem, orbit: &PeriodicSolution) -> Vec<f64> {
    const SAMPLES: u32 = 4096;
    let phases: Vec<f64> = (0..SAMPLES).map(|k| 2.0 * f64::from(k) / f64::from(SAMPLES)).collect();
    let stretch = Stretch { frequency_hz: orbit.frequency_hz, start: 0.0, end: 2.0 };
    let settings = GeneralSettings::with_tolerance(1e-10);
    let states = sample(&rig.system, &stretch, &orbit.nodes[0], &phases, &settings).unwrap();
    let y: Vec<f64> = states
        .iter()
        .map(|state| rig.response.shape.iter().zip(state).map(|(phi, q)| phi * q).sum())
        .collect();
    let amplitude = |order: u32| {
        let part = |turn: fn(f64) -> f64| {
            let angles = (0..SAMPLES).map(|k| TAU * f64::from(order * k % SAMPLES) / f64::from(SAMPLES));
            y.iter().zip(angles).map(|(y, angle)| y * turn(angle)).sum::<f64>()
        };
        f64::hypot(part(f64::cos), part(f64::sin)) * 2.0 / f64::from(SAMPLES)
    };
    (0..=20).map(amplitude).collect()
}

/// Text: at 67.8 Hz the 1/2 orbit carries a strong 135.6 Hz, close to f2 = 137.3 Hz. In displacement it is
/// the strongest line above the excitation; with the square of its frequency, in acceleration, the strongest
/// of all up to 678 Hz.
#[test]
fn at_67_8_hz_the_half_subharmonic_orbit_carries_a_strong_line_at_135_6_hz() {
    let rig = paper_beam();
    let orbit = find_start(&rig.system, &rig.response, 67.8, 2, &OrbitSettings::default()).unwrap();
    assert!(orbit.stable());
    let lines = harmonics(&rig, &orbit);
    assert!((3..=20).all(|order| order == 4 || lines[order] < lines[4]), "{lines:?}");
    let acceleration = |order: usize| (order * order) as f64 * lines[order];
    assert!((1..=20).all(|order| order == 4 || acceleration(order) < acceleration(4)), "{lines:?}");
    let power: f64 = (1..=20).map(|order| acceleration(order).powi(2)).sum();
    assert!(acceleration(4).powi(2) > power / 3.0);
}

/// Text: near 53 Hz beam and stop touch at nearly equal speed.
#[test]
fn half_subharmonic_acceleration_near_53_hz_is_an_eighth_of_the_harmonic_one() {
    let rows = branch(&paper_beam(), 60.0, 2, (52.6, 61.0));
    let near =
        rows.iter().map(|row| &row.solution).filter(|orbit| (52.8..53.2).contains(&orbit.frequency_hz));
    let least = near.min_by(|a, b| a.maxima.acceleration.total_cmp(&b.maxima.acceleration)).unwrap();
    // Its end alone counts.
    let harmonic = branch_in_steps(1.0, &paper_beam(), (36.0, 1), (35.9, least.frequency_hz));
    let harmonic = &harmonic[harmonic.len() - 1].solution;
    assert!(least.maxima.acceleration < harmonic.maxima.acceleration / 7.0);
    assert!(least.maxima.displacement > 1.4 * harmonic.maxima.displacement, "though it moves further");
}

fn shaken_by(amplitude: f64) -> ObservedSystem {
    let model = paper_beam_model(0.015);
    let point = model.point("contact").unwrap().clone();
    let stop = LocalElement {
        name: "stop".into(),
        shape: point.shape.iter().map(|phi| -phi).collect(),
        support_ratios: vec![0.0],
        law: hertz(4.5e9, 0.0),
    };
    let system = System::new(model, &shaken(amplitude), vec![stop]).unwrap();
    ObservedSystem { system, response: Response { shape: point.shape, support_ratios: point.support_ratios } }
}

/// With no gap only the exponent 3/2 of the contact makes the response anything but proportional to the
/// amplitude.
#[test]
fn amplitude_of_the_table_moves_the_harmonic_peaks_by_less_than_half_a_percent() {
    let peaks = |amplitude: f64| {
        let rows = branch(&shaken_by(amplitude), 30.0, 1, (29.0, 38.0));
        [(30.0, 34.0), (35.0, 37.5)].map(|(low, high)| {
            let orbit = peak(&rows, low, high);
            (orbit.frequency_hz, orbit.maxima.displacement / amplitude)
        })
    };
    let reference = peaks(0.5015e-3);
    for amplitude in [0.4e-3, 0.6e-3] {
        for (found, expected) in peaks(amplitude).iter().zip(&reference) {
            assert!((found.0 / expected.0 - 1.0).abs() < 0.005, "{amplitude} m: {} Hz", found.0);
            assert!((found.1 / expected.1 - 1.0).abs() < 0.02, "{amplitude} m: {} times", found.1);
        }
    }
}

/// Away from the peaks a fifth of the damping changes the accelerations by some ten percent at most ("the
/// levels of xi = 0.015"); at a peak by a factor of 2.6.
#[test]
fn both_dampings_give_the_same_accelerations_away_from_the_peaks() {
    let laws = [(-1.0, hertz(4.5e9, 0.0))];
    let rows = |ratio: f64| branch(&paper_beam_with(ratio, &laws), 42.0, 1, (33.0, 60.0));
    let [high, low] = [0.015, 0.003].map(rows);
    let change = |at: f64| {
        let acceleration = |rows: &[BranchRow]| {
            let solutions = rows.iter().map(|row| &row.solution);
            let nearest =
                solutions.min_by(|a, b| (a.frequency_hz - at).abs().total_cmp(&(b.frequency_hz - at).abs()));
            nearest.unwrap().maxima.acceleration
        };
        acceleration(&low) / acceleration(&high) - 1.0
    };
    for at in [42.0, 44.0, 50.0, 55.0, 58.0, 59.0] {
        assert!(change(at).abs() < 0.12, "{at} Hz: {}", change(at));
    }
    assert!(change(33.5) > 1.5);
}
