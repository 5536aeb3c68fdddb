//! Flips and Neimark-Sacker points that change their criticality, found again by what branches off there and
//! by the motion beside the orbit, which know nothing of normal forms.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::PI;

use crate::common::{
    biased::{RANGE_HZ, biased, flips},
    events::{alternation, leaving, side, with},
    independent::{
        Case, curve, events, marked, oscillator, stop, together, two_modes, with as with_parameter,
    },
};
use faer::{Mat, c64};
use hammerbeam_motion::{
    Parameter, Stretch, System,
    general::{GeneralSettings, advance},
};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, Crossing, CurveKind, CurveRow, OrbitSettings, PeriodicSolution, Side, reach_orbit,
};

const FORCE: Parameter = Parameter::ExcitationScale;
const DAMPING: Parameter = Parameter::ADDED_DAMPING_RATIO;

/// Where the polynomial of y over x through these points has its zero, by the polynomial of x over y.
fn zero(x: &[f64], y: &[f64]) -> f64 {
    let weight =
        |i: usize| -> f64 { (0..y.len()).filter(|j| *j != i).map(|j| -y[j] / (y[i] - y[j])).product() };
    (0..x.len()).map(|i| weight(i) * x[i]).sum()
}

/// By how much the frequency of doubled orbits grows from the upper flip on, over the square of how far their
/// periods differ: `f = k a^2 + l a^4` through two of them. And whether these orbits are stable.
fn bend(case: &Case) -> (f64, bool) {
    let settings = OrbitSettings::for_range(RANGE_HZ);
    let flip = &flips(case)[1];
    let (rows, _) = leaving(case, flip, Side::Up, (RANGE_HZ.0, 0.35), &settings);
    let points = rows.iter().map(|row| {
        let grown = row.solution.frequency_hz - flip.solution.frequency_hz;
        (alternation(&case.0, &row.solution).powi(2), grown, row.solution.floquet_multipliers[0][0])
    });
    let points: Vec<(f64, f64, f64)> = points.take_while(|(square, ..)| *square < 0.05 * 0.05).collect();
    let (&(a, f, _), &(b, g, largest)) = (&points[points.len() - 2], &points[points.len() - 1]);
    ((f * b / a - g * a / b) / (b - a), largest < 1.0)
}

/// On one side of the point doubled orbits branch off to one side of the flip and are stable, on the other
/// side they do neither; how their frequency bends is zero there.
#[test]
fn degenerate_flips_are_where_doubled_orbits_change_the_side_of_the_flip() {
    let case = biased();
    let flips = flips(&case);
    assert_eq!(flips.len(), 2);
    let found = [0, 1].map(|k| {
        let (rows, _) = curve(&case, &flips[k], CurveKind::Flip, (DAMPING, (-0.04, 0.1), RANGE_HZ));
        let found = marked(&rows, "degenerate-flip");
        assert_eq!(found.len(), 1);
        found[0].parameter
    });
    // One curve, followed from two starts in both directions: derivatives are known to about 1e-8.
    assert!((found[0] - found[1]).abs() < 1e-9, "{found:?}");
    let ratios = [-2e-4, -1e-4, 1e-4, 2e-4].map(|beside| found[0] + beside);
    let bends = ratios.map(|ratio| bend(&with_parameter(&case, DAMPING, ratio)));
    assert_eq!(bends.map(|(_, stable)| stable), [true, true, false, false]);
    let place = zero(&ratios, &bends.map(|(bend, _)| bend));
    assert!((place - found[0]).abs() < 2e-7, "{place} and {found:?}");
}

/// The branch of doubled orbits at a row of a flip curve, along the eigenvector of the general integrator:
/// how its frequency bends over the square of how far its periods differ, `f = k a^2 + l a^4 + m a^6`.
fn bend_at(case: &Case, row: &CurveRow, range_hz: (f64, f64)) -> f64 {
    let (system, response) = with_parameter(case, FORCE, row.parameter);
    let orbit = row.solution.clone();
    let monodromy = monodromy(&system, &orbit);
    let mut direction: Vec<f64> =
        vector(&monodromy, |value| (value + 1.0).norm()).1.iter().map(|z| z.re).collect();
    direction.push(0.0);
    let crossing = Crossing { orbit, direction, factor: 2 };
    let settings = OrbitSettings::for_range(range_hz);
    let mut walk =
        BranchWalk::from_crossing(&system, &response, &crossing, Side::Up, range_hz, &settings).unwrap();
    let (mut rows, mut points) = (Vec::new(), Vec::new());
    while walk.step(&mut rows).unwrap().is_none() {
        let doubled = &rows[rows.len() - 1].solution;
        let half = doubled.nodes.len() / 2;
        let apart = |(a, b): (&f64, &f64)| (a - b).powi(2);
        let square: f64 = doubled.nodes[0].iter().zip(&doubled.nodes[half]).map(apart).sum();
        if square > 1e-6 {
            break;
        }
        points.push((square, doubled.frequency_hz - row.solution.frequency_hz));
    }
    let last = &points[points.len() - 3..];
    // The value where `a^2` is zero.
    zero(&[0, 1, 2].map(|k| last[k].1 / last[k].0), &[0, 1, 2].map(|k| last[k].0))
}

#[test]
fn degenerate_flips_beside_a_contact_are_where_doubled_orbits_change_the_side_of_the_flip() {
    let case = crate::common::beam();
    let range_hz = (54.5, 62.0);
    let start = reach_orbit(&case.0, &case.1, (57.0, 1), &OrbitSettings::default(), &mut || false).unwrap();
    let (rows, _) = side(&case, &start, Side::Down, range_hz, &OrbitSettings::for_range(range_hz));
    let flip = with(&rows, |events| events.flip)[0];
    let (rows, _) = curve(&case, flip, CurveKind::Flip, (FORCE, (0.4, 1.05), range_hz));
    let found = marked(&rows, "degenerate-flip");
    assert_eq!(found.len(), 1);
    let force = found[0].parameter;
    // Once more from there, with short steps.
    let at = with_parameter(&case, FORCE, force);
    let located = BranchRow { solution: found[0].solution.clone(), ..flip.clone() };
    let (rows, _) = curve(&at, &located, CurveKind::Flip, (FORCE, (0.99 * force, 1.01 * force), range_hz));
    let below: Vec<&CurveRow> = rows.iter().filter(|row| row.parameter < force).collect();
    let above: Vec<&CurveRow> = rows.iter().filter(|row| row.parameter > force).collect();
    // Each bend is known to a hundredth or two of itself, so that places from four rows differ by 1e-5.
    let places = [(3, 6), (4, 8), (5, 10), (6, 12), (7, 14), (8, 16), (10, 20)].map(|(near, far)| {
        let beside = [below[far], below[near], above[near], above[far]];
        let bends = beside.map(|row| bend_at(&at, row, range_hz));
        assert!(bends[1] > 0.0 && bends[2] < 0.0, "{bends:?}");
        zero(&beside.map(|row| row.parameter), &bends)
    });
    let place = places.iter().sum::<f64>() / places.len() as f64;
    assert!((place / force - 1.0).abs() < 1e-5, "{place} and {force}");
}

/// A linear oscillator at a linear stop knows its gap and its force by their ratio only: its flips change
/// their criticality at the same frequencies, at a gap and at the force that is one over it.
#[test]
fn degenerate_flips_over_the_gap_and_over_the_force_are_the_same() {
    let range_hz = (0.05, 0.4);
    let case = together(&[oscillator(1.0, 0.1, 1.0, stop(10.0, 1.0))]);
    let flips = events(&case, range_hz, |events| events.flip);
    let flip = flips.iter().find(|row| (row.solution.frequency_hz / 0.082927 - 1.0).abs() < 1e-5).unwrap();
    let [over_gap, over_force] =
        [(Parameter::gap(0), (0.2, 2.0)), (FORCE, (0.5, 5.0))].map(|(parameter, range)| {
            let (rows, _) = curve(&case, flip, CurveKind::Flip, (parameter, range, range_hz));
            let found = marked(&rows, "degenerate-flip");
            found.iter().map(|row| [row.parameter, row.solution.frequency_hz]).collect::<Vec<_>>()
        });
    assert!(!over_gap.is_empty() && over_gap.len() == over_force.len(), "{over_gap:?} and {over_force:?}");
    for [gap, hz] in &over_gap {
        let off = |[force, other]: &[f64; 2]| (force * gap - 1.0).abs() + (other / hz - 1.0).abs();
        let least = over_force.iter().map(off).fold(f64::INFINITY, f64::min);
        assert!(least < 1e-7, "{gap} m, {hz} Hz: {over_force:?}");
    }
}

fn monodromy(system: &System, orbit: &PeriodicSolution) -> Mat<f64> {
    let stretch = Stretch { frequency_hz: orbit.frequency_hz, start: orbit.phase, end: orbit.phase + 1.0 };
    advance(system, &stretch, &orbit.nodes[0], &GeneralSettings::with_tolerance(1e-12)).unwrap().flow.by_state
}

/// By how much the logarithm of the amplitude of the motion beside a Neimark-Sacker orbit grows in a period,
/// over the square of the amplitude: the general integrator for some hundred periods.
fn growth(case: &Case, row: &CurveRow, amplitude: f64) -> f64 {
    let (system, _) = with_parameter(case, FORCE, row.parameter);
    let orbit = &row.solution;
    let size = orbit.nodes[0].len();
    let stretch = Stretch { frequency_hz: orbit.frequency_hz, start: orbit.phase, end: orbit.phase + 1.0 };
    let monodromy = monodromy(&system, orbit);
    let (multiplier, right) = vector(&monodromy, off_circle);
    let (_, left) = vector(&monodromy.transpose().to_owned(), off_circle);
    let scale: c64 = (0..size).map(|i| left[i] * right[i]).sum();
    let mut state: Vec<f64> = (0..size).map(|i| orbit.nodes[0][i] + 2.0 * amplitude * right[i].re).collect();
    let settings = GeneralSettings::with_tolerance(1e-12).state_only();
    let amplitudes: Vec<f64> = (0..PERIODS)
        .map(|_| {
            state = advance(&system, &stretch, &state, &settings).unwrap().flow.state;
            let part: c64 = (0..size).map(|i| left[i] * (state[i] - orbit.nodes[0][i])).sum();
            (part / scale).norm()
        })
        .collect();
    // Means over many turns, behind what dies away, with weights that fade out at both ends.
    let mean = |from: usize| -> f64 {
        let weight = |k: usize| (PI * (k as f64 + 0.5) / WINDOW as f64).sin().powi(2) * 2.0 / WINDOW as f64;
        (0..WINDOW).map(|k| weight(k) * amplitudes[from + k].ln()).sum()
    };
    let (first, last) = (100, PERIODS - WINDOW);
    ((mean(last) - mean(first)) / (last - first) as f64 - multiplier.norm().ln()) / amplitude.powi(2)
}

const PERIODS: usize = 1000;
const WINDOW: usize = 300;

/// The eigenvalue that is nearest to its place, and its right eigenvector of length one.
fn vector(matrix: &Mat<f64>, off: impl Fn(c64) -> f64) -> (c64, Vec<c64>) {
    let eigen = matrix.eigen().unwrap();
    let values = eigen.S().column_vector();
    let k = (0..matrix.nrows()).min_by(|a, b| off(values[*a]).total_cmp(&off(values[*b]))).unwrap();
    let vector: Vec<c64> = (0..matrix.nrows()).map(|i| eigen.U()[(i, k)]).collect();
    let length = vector.iter().map(|z| z.norm_sqr()).sum::<f64>().sqrt();
    (values[k], vector.into_iter().map(|z| z / length).collect())
}

/// How far a complex eigenvalue with positive imaginary part is from the unit circle.
fn off_circle(value: c64) -> f64 {
    if value.im > 0.0 { (value.norm() - 1.0).abs() } else { f64::INFINITY }
}

/// On one side the motion beside the orbit at its Neimark-Sacker point dies away, on the other it grows, both
/// more and more slowly towards the point.
#[test]
fn degenerate_neimark_sacker_points_are_where_motion_beside_the_orbit_neither_grows_nor_dies_away() {
    let case = together(&[two_modes()]);
    let pairs = events(&case, (0.1, 0.157), |events| events.neimark_sacker);
    let (rows, _) = curve(&case, &pairs[1], CurveKind::NeimarkSacker, (FORCE, (0.9, 1.6), (0.1, 0.2)));
    let found = marked(&rows, "degenerate-neimark-sacker");
    assert_eq!(found.len(), 1);
    let index = rows.iter().position(|row| row == found[0]).unwrap();
    let beside = [index - 6, index - 3, index + 3, index + 6].map(|k| &rows[k]);
    let places = [0.02, 0.01].map(|amplitude| {
        let growths = beside.map(|row| growth(&case, row, amplitude));
        assert_eq!(growths.map(|growth| growth > 0.0), [false, false, true, true]);
        zero(&beside.map(|row| row.parameter), &growths)
    });
    // What is left goes like the square of the amplitude.
    let place = (4.0 * places[1] - places[0]) / 3.0;
    assert!((place - found[0].parameter).abs() < 1e-5, "{place} and {}", found[0].parameter);
}
