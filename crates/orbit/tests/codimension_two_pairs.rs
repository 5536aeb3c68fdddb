//! Points of codimension two at which a further complex pair of multipliers comes to the unit circle, or one
//! multiplier beside a complex pair that is there, found again by what each oscillator of a system does by
//! itself.
//!
//! Oscillators that do not touch each other have the multipliers of all of them. One that rests has its pair
//! on the unit circle at a damping in closed form; a Duffing oscillator has its folds, a bilinear one its
//! flip and two coupled modes their Neimark-Sacker points on branches of their own, which are followed
//! without the others.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{
    events::general_multipliers,
    independent::{
        Case, Part, cubic, curve, events, events_up_to, marked, nearest, oscillator, resting_pair, stop,
        together, two_modes, with,
    },
};
use hammerbeam_motion::Parameter;
use hammerbeam_orbit::{CurveEnd, CurveKind, CurveRow, Events};
use hammerbeam_testkit::extensive;

const DAMPING: Parameter = Parameter::ADDED_DAMPING_RATIO;
const FORCE: Parameter = Parameter::ExcitationScale;
/// Frequency and damper of the pair that rests, and the ratio at which it has none.
const RESTS: [f64; 2] = [1.3, 0.01];
const UNDAMPED: f64 = -RESTS[1] / (2.0 * RESTS[0]);

/// With folds, which move with the force.
fn duffing(slower: f64) -> Part {
    oscillator(slower, 0.1 * slower, 0.3 * slower * slower, cubic(slower * slower))
}

/// Without gap: its flip does not depend on the force (`flips_bilinear.rs`, slower by the factor).
fn bilinear(slower: f64) -> Part {
    oscillator(slower, 0.1 * slower, 0.3, stop(19.0 * slower * slower, 0.0))
}

/// Linear up to its stop.
fn grazer(gap: f64) -> Part {
    oscillator(1.0, 0.2, 1.0, stop(3.0, gap))
}

/// By the general integrator.
fn multipliers(case: &Case, parameter: Parameter, row: &CurveRow) -> Vec<[f64; 2]> {
    general_multipliers(&with(case, parameter, row.parameter).0, &row.solution)
}

fn off(multipliers: &[[f64; 2]], from: f64) -> f64 {
    multipliers.iter().map(|[re, im]| (re - from).hypot(*im)).fold(f64::INFINITY, f64::min)
}

type PairCase = (CurveKind, fn(&Events) -> bool, &'static str);

/// Beside an oscillator that bifurcates a pair at rest crosses the circle at its own damping, whatever the
/// frequency, and the oscillator by itself bifurcates there at the same frequency. By default from the first
/// place at which it bifurcates.
fn meets_the_resting_pair(
    part: &Part,
    (kind, wanted, name): PairCase,
    range_hz: (f64, f64),
    real: Option<f64>,
) {
    let case = together(&[part.clone(), resting_pair(RESTS[0], RESTS[1])]);
    let starts = events(&case, range_hz, wanted);
    assert!(!starts.is_empty());
    let alone = with(&together(std::slice::from_ref(part)), DAMPING, UNDAMPED);
    let by_itself = events(&alone, range_hz, wanted);
    for start in starts.iter().take(if extensive() { 2 } else { 1 }) {
        let (rows, ends) = curve(&case, start, kind, (DAMPING, (-0.006, 0.006), range_hz));
        assert_eq!(ends, [CurveEnd::RangeEnd, CurveEnd::RangeEnd]);
        assert_eq!(rows.iter().filter(|row| row.events.label().contains("neimark-sacker")).count(), 1);
        let row = marked(&rows, name)[0];
        assert!((row.parameter - UNDAMPED).abs() < 1e-13, "{}", row.parameter);
        let error = nearest(&by_itself, row.solution.frequency_hz);
        assert!(error < 1e-12, "{error:e} of the frequency");
        let multipliers = multipliers(&case, DAMPING, row);
        // At a fold the orbit is known to the square root of rounding only, and its multiplier with it.
        assert!(real.is_none_or(|real| off(&multipliers, real) < 1e-5), "{multipliers:?}");
        let on_circle =
            multipliers.iter().filter(|[re, im]| *im > 0.0 && (re.hypot(*im) - 1.0).abs() < 1e-10);
        assert_eq!(on_circle.count(), if real.is_some() { 1 } else { 2 }, "{multipliers:?}");
    }
}

#[test]
fn fold_neimark_sacker_points_are_where_a_pair_at_rest_loses_its_damping() {
    let kind: PairCase = (CurveKind::Fold, |e| e.fold, "fold-neimark-sacker");
    meets_the_resting_pair(&duffing(1.0), kind, (0.15, 0.4), Some(1.0));
}

#[test]
fn flip_neimark_sacker_points_are_where_a_pair_at_rest_loses_its_damping() {
    let kind: PairCase = (CurveKind::Flip, |e| e.flip, "flip-neimark-sacker");
    meets_the_resting_pair(&bilinear(0.6), kind, (0.15, 0.4), Some(-1.0));
}

#[test]
fn double_neimark_sacker_points_are_where_a_pair_at_rest_loses_its_damping() {
    let kind: PairCase = (CurveKind::NeimarkSacker, |e| e.neimark_sacker, "double-neimark-sacker");
    meets_the_resting_pair(&two_modes(), kind, (0.1, 0.157), None);
}

/// A linear oscillator reaches its stop at `F = g |1 - w^2 + i c w|`, `c = 0.2 + 2 z`.
#[test]
fn grazing_neimark_sacker_points_are_where_a_pair_at_rest_loses_its_damping() {
    let case = together(&[grazer(2.0), resting_pair(RESTS[0], RESTS[1])]);
    let range_hz = (0.05, 0.4);
    let starts = events(&case, range_hz, |e| e.grazing);
    assert_eq!(starts.len(), 2);
    for start in &starts {
        let kind = CurveKind::Grazing { contact: Some(0) };
        let (rows, ends) = curve(&case, start, kind, (DAMPING, (-0.006, 0.006), range_hz));
        assert_eq!(ends, [CurveEnd::RangeEnd, CurveEnd::RangeEnd]);
        let found = marked(&rows, "grazing-neimark-sacker");
        assert_eq!(found.len(), 1);
        assert!((found[0].parameter - UNDAMPED).abs() < 1e-13, "{}", found[0].parameter);
        let error = 2.0 * impedance(found[0].solution.frequency_hz, 1.0, 0.2 + 2.0 * UNDAMPED) - 1.0;
        assert!(error.abs() < 1e-12, "{error:e} of the force");
    }
}

/// Of two linear oscillators of one force each reaches its stop where its amplitude equals its gap: both at
/// once where `g_1 |1 - w^2 + i c w| = g_2 |s^2 - w^2 + i c s w|`.
#[test]
fn double_grazings_are_where_two_linear_oscillators_reach_their_stops_at_one_force() {
    let (gaps, slower) = ([2.0, 2.5], 0.9);
    let other = oscillator(slower, 0.2 * slower, 1.0, stop(3.0, gaps[1]));
    let case = together(&[grazer(gaps[0]), other]);
    let range_hz = (0.05, 0.4);
    let starts = events(&case, range_hz, |e| e.grazing);
    assert_eq!(starts.len(), 4);
    for start in &starts {
        let contact = start.located.as_ref().unwrap().contacts[0].contact;
        let kind = CurveKind::Grazing { contact: Some(contact) };
        let (rows, _) = curve(&case, start, kind, (FORCE, (0.3, 3.0), range_hz));
        let found = marked(&rows, "double-grazing");
        assert_eq!(found.len(), 1);
        // A change of contacts is bracketed to 1e-7 hundredths of the ranges.
        let (force, hz) = (found[0].parameter, found[0].solution.frequency_hz);
        for reached in [gaps[0] * impedance(hz, 1.0, 0.2), gaps[1] * impedance(hz, slower, 0.2 * slower)] {
            assert!((reached / force - 1.0).abs() < 1e-8, "{reached} and {force}");
        }
    }
}

/// `|s^2 - w^2 + i c w|`.
fn impedance(hz: f64, frequency: f64, damping: f64) -> f64 {
    let w = TAU * hz;
    (frequency * frequency - w * w).hypot(damping * w)
}

/// Where two coupled modes have their Neimark-Sacker points and another oscillator bifurcates at one force:
/// found on both curves, and by each of the two by itself. By default with the first of the pairs.
fn meets_two_modes(part: &Part, (kind, wanted, name): PairCase, start_hz: f64, pairs_hz: &[f64]) {
    let (range, range_hz) = ((0.8, 1.6), (0.1, 0.157));
    let is_pair: fn(&Events) -> bool = |events| events.neimark_sacker;
    let case = together(&[two_modes(), part.clone()]);
    let starts = events_up_to(&case, range_hz, |e| e.neimark_sacker || e.fold || e.flip, start_hz);
    let other = starts.iter().find(|row| (row.solution.frequency_hz / start_hz - 1.0).abs() < 1e-5).unwrap();
    let (rows, _) = curve(&case, other, kind, (FORCE, range, range_hz));
    let forces: Vec<f64> = marked(&rows, name).iter().map(|row| row.parameter).collect();
    assert_eq!(forces.len(), 2, "{forces:?}");
    for hz in pairs_hz.iter().take(if extensive() { usize::MAX } else { 1 }) {
        let pair = starts.iter().find(|row| (row.solution.frequency_hz - hz).abs() < 1e-4).unwrap();
        let (rows, _) = curve(&case, pair, CurveKind::NeimarkSacker, (FORCE, range, range_hz));
        let found = marked(&rows, name);
        assert_eq!(found.len(), 1);
        let (force, hz) = (found[0].parameter, found[0].solution.frequency_hz);
        let again = forces.iter().map(|other| (other / force - 1.0).abs()).fold(f64::INFINITY, f64::min);
        assert!(again < 1e-11, "{force} and {forces:?}");
        for (part, wanted) in [(two_modes(), is_pair), (part.clone(), wanted)] {
            let by_itself = events_up_to(&with(&together(&[part]), FORCE, force), range_hz, wanted, hz);
            let error = nearest(&by_itself, hz);
            assert!(error < 1e-10, "{error:e} of {hz} Hz");
        }
    }
}

#[test]
fn flip_neimark_sacker_points_of_both_curves_are_where_each_oscillator_bifurcates_by_itself() {
    meets_two_modes(
        &bilinear(0.4),
        (CurveKind::Flip, |e| e.flip, "flip-neimark-sacker"),
        0.154173,
        &[0.14912, 0.15394],
    );
}

/// The curve of the pair turns where the other oscillator has its fold.
#[test]
fn fold_neimark_sacker_points_of_both_curves_are_where_each_oscillator_bifurcates_by_itself() {
    meets_two_modes(
        &duffing(0.55),
        (CurveKind::Fold, |e| e.fold, "fold-neimark-sacker"),
        0.155788,
        &[0.15394],
    );
}
