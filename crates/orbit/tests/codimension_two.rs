//! Points of codimension two on curves of bifurcations, found again by other means: fold-flips and a
//! resonance 1:2.
//!
//! Two oscillators that do not touch each other, driven by the same force: a hardening Duffing oscillator,
//! whose folds move with the force, and a bilinear one without gap, whose flips do not (its motion is
//! proportional to the force; `flips_bilinear.rs` has their closed form). Together they are one system of two
//! modes, of which the curves know no better. Its multipliers are the multipliers of both, so a fold-flip is
//! where a fold of the one has the frequency of a flip of the other.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::events::{general_multipliers, oscillator};
use faer::Mat;
use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, LocalElement, Parameter, System, law};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, CurveEnd, CurveKind, CurveRow, CurveSettings, CurveWalk, EventStatus, Events,
    OrbitSettings, Response, Side, find_start,
};
use hammerbeam_structure::{PointOutput, ReducedModel};

type Case = (System, Response);

const RANGE_HZ: (f64, f64) = (0.15, 0.4);
const START_HZ: f64 = 0.16;
const SCALES: (f64, f64) = (0.3, 2.5);
/// Frequency, damping and added stiffness of the bilinear oscillator, and its force: as in
/// `flips_bilinear.rs`, slower by this factor.
const SLOWER: f64 = 0.6;

fn cubic() -> Law {
    Law::Power(law::PowerSpring::cubic(1.0).unwrap())
}

fn stop() -> Law {
    Law::Linear(law::LinearStop::with_gap(19.0 * SLOWER * SLOWER, 0.0).unwrap())
}

/// Both oscillators as one system.
fn both() -> Case {
    let model = ReducedModel {
        natural_frequencies: vec![1.0, SLOWER],
        damping: Mat::from_fn(2, 2, |i, j| if i == j { [0.1, 0.1 * SLOWER][i] } else { 0.0 }),
        points: vec![PointOutput { name: "first".into(), shape: vec![1.0, 0.0], support_ratios: vec![0.0] }],
        supports: vec![],
        uniform_acceleration: vec![1.0, 0.0],
    };
    let harmonic = Harmonic { order: 1, amplitude: 0.3, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0, 1.0], harmonic }] };
    let element = |shape: [f64; 2], law| LocalElement {
        name: "local".into(),
        shape: shape.to_vec(),
        support_ratios: vec![0.0],
        law,
    };
    let elements = vec![element([1.0, 0.0], cubic()), element([0.0, 1.0], stop())];
    (
        System::new(model, &load, elements).unwrap(),
        Response { shape: vec![1.0, 0.0], support_ratios: vec![0.0] },
    )
}

/// Rows of the branch through the harmonic orbit with an event, sharply located.
fn events(case: &Case, wanted: fn(&Events) -> bool) -> Vec<BranchRow> {
    let settings = OrbitSettings::for_range(RANGE_HZ);
    let start = find_start(&case.0, &case.1, START_HZ, 1, &settings).unwrap();
    let mut rows = Vec::new();
    for side in [Side::Down, Side::Up] {
        let mut walk = BranchWalk::new(&case.0, &case.1, &start, side, RANGE_HZ, &settings).unwrap();
        while walk.step(&mut rows).unwrap().is_none() {}
    }
    let sharp = |row: &BranchRow| row.located.as_ref().is_some_and(|l| l.status == EventStatus::Located);
    rows.into_iter().filter(|row| wanted(&row.events) && sharp(row)).collect()
}

fn curve((system, response): &Case, start: &BranchRow, kind: CurveKind) -> Vec<CurveRow> {
    let parameter = Parameter::ExcitationScale;
    let settings =
        CurveSettings { parameter, range: SCALES, range_hz: RANGE_HZ, max_step: 0.5, max_rows: 5000 };
    let mut rows = Vec::new();
    for side in [Side::Down, Side::Up] {
        let orbits = OrbitSettings::default();
        let mut walk =
            CurveWalk::new(system, response, &start.solution, (kind, side), &settings, &orbits).unwrap();
        let end = loop {
            match walk.step().unwrap() {
                Ok(row) => rows.push(row),
                Err(end) => break end,
            }
        };
        assert!(matches!(end, CurveEnd::RangeEnd | CurveEnd::FrequencyRangeEnd), "{end:?}");
    }
    rows
}

fn alone(frequency: f64, damping: f64, law: Law) -> Case {
    oscillator(frequency * frequency, damping, 0.3, law)
}

fn frequencies(rows: &[BranchRow]) -> Vec<f64> {
    rows.iter().map(|row| row.solution.frequency_hz).collect()
}

fn nearest(list: &[f64], to: f64) -> f64 {
    list.iter().map(|value| (value / to - 1.0).abs()).fold(f64::INFINITY, f64::min)
}

/// Distance of the multiplier nearest to a real number, by the general integrator.
fn off(system: &System, row: &CurveRow, from: f64) -> f64 {
    let system = system.clone().with_parameter(Parameter::ExcitationScale, row.parameter).unwrap();
    let multipliers = general_multipliers(&system, &row.solution);
    multipliers.iter().map(|[re, im]| (re - from).hypot(*im)).fold(f64::INFINITY, f64::min)
}

/// The fold curves of both cross the frequency at which the bilinear oscillator flips by itself, once on the
/// upper and once on the lower fold. At the force that is found the Duffing oscillator by itself has its fold
/// at that frequency.
#[test]
fn fold_flips_of_independent_oscillators_are_where_each_bifurcates_by_itself() {
    let flips = frequencies(&events(&alone(SLOWER, 0.1 * SLOWER, stop()), |e| e.flip));
    assert_eq!(flips.len(), 1);
    let case = both();
    let folds = events(&case, |e| e.fold);
    assert_eq!(folds.len(), 2);
    let mut forces = Vec::new();
    for fold in &folds {
        let rows = curve(&case, fold, CurveKind::Fold);
        let marked: Vec<&CurveRow> = rows.iter().filter(|row| row.events.fold_flip).collect();
        assert_eq!(marked.len(), 1);
        let (row, hz) = (marked[0], marked[0].solution.frequency_hz);
        // Both are located to rounding; the slope of a multiplier over the frequency is of order ten.
        assert!((hz / flips[0] - 1.0).abs() < 1e-10, "{hz} Hz and {} Hz", flips[0]);
        let duffing = alone(1.0, 0.1, cubic());
        let scaled = duffing.0.with_parameter(Parameter::ExcitationScale, row.parameter).unwrap();
        let by_itself = frequencies(&events(&(scaled, duffing.1), |e| e.fold));
        assert!(nearest(&by_itself, hz) < 1e-8, "{by_itself:?} and {hz} Hz");
        // At a fold the orbit is known to the square root of rounding only, and its multiplier with it.
        assert!(off(&case.0, row, -1.0) < 1e-8 && off(&case.0, row, 1.0) < 1e-5);
        forces.push(row.parameter);
    }
    // The other way: along the flip the frequency stays (rows are accepted with a correction of up to 1e-10
    // still due), and both places are met again, where the curve turns.
    let flip = &events(&case, |e| e.flip)[0];
    let rows = curve(&case, flip, CurveKind::Flip);
    assert!(rows.len() > 100);
    // A bilinear oscillator without gap does not know how large the force is: its flip keeps its criticality.
    assert!(rows.iter().all(|row| !row.events.degenerate_flip && !row.events.flip_neimark_sacker));
    let worst = rows.iter().map(|row| (row.solution.frequency_hz / flips[0] - 1.0).abs()).fold(0.0, f64::max);
    assert!(worst < 2e-10, "{worst:e}");
    let mut again: Vec<f64> =
        rows.iter().filter(|row| row.events.fold_flip).map(|row| row.parameter).collect();
    again.sort_by(f64::total_cmp);
    forces.sort_by(f64::total_cmp);
    assert_eq!(again.len(), 2, "{again:?}");
    for (force, other) in forces.iter().zip(again) {
        assert!((force / other - 1.0).abs() < 1e-10, "{force} and {other}");
    }
}

const STIFF: f64 = 20.0;

/// Two equal modes, damped so that `v = (q_1 - q_2)/2^(1/2)` has the damper `0.1 + 2 z` (and the other
/// combination, which rests, 0.9 + 2 z): a bilinear oscillator of stiffness 1 and 20 in v, whose damper
/// passes zero at the added ratio -1/20 while the diagonal of the damping matrix stays positive.
fn undamped_within() -> Case {
    let half = 0.5_f64.sqrt();
    let model = ReducedModel {
        natural_frequencies: vec![1.0, 1.0],
        damping: Mat::from_fn(2, 2, |i, j| if i == j { 0.5 } else { 0.4 }),
        points: vec![PointOutput { name: "v".into(), shape: vec![half, -half], support_ratios: vec![0.0] }],
        supports: vec![],
        uniform_acceleration: vec![1.0, 0.0],
    };
    let shape = vec![half, -half];
    let harmonic = Harmonic { order: 1, amplitude: 1.0, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: shape.clone(), harmonic }] };
    let law = Law::Linear(law::LinearStop::with_gap(STIFF - 1.0, 0.0).unwrap());
    let stop = LocalElement { name: "stop".into(), shape: shape.clone(), support_ratios: vec![0.0], law };
    (System::new(model, &load, vec![stop]).unwrap(), Response { shape, support_ratios: vec![0.0] })
}

/// What vanishes at a flip of the undamped bilinear oscillator for a circular frequency and a duration s of
/// its contact, about whose middle the motion is symmetric: `a cos(K^1/2 t) + G cos(W t)` in contact and `b
/// cos(k^1/2 (t - T/2)) + g cos(W t)` outside, zero at `t = s/2` and of one slope there; and `tr M + 2`.
fn undamped_flip([omega, duration]: [f64; 2]) -> [f64; 2] {
    let (root, flight) = (STIFF.sqrt(), TAU / omega - duration);
    let (inside, outside) = (1.0 / (STIFF - omega * omega), 1.0 / (1.0 - omega * omega));
    let (sin, cos) = (0.5 * omega * duration).sin_cos();
    let (beta, alpha) = (root * duration, flight);
    let in_contact = inside * (root * cos * (0.5 * beta).tan() - omega * sin);
    let in_flight = -outside * (cos * (0.5 * alpha).tan() + omega * sin);
    let trace = 2.0 * alpha.cos() * beta.cos() - (STIFF + 1.0) / root * alpha.sin() * beta.sin();
    [in_contact - in_flight, trace + 2.0]
}

/// Newton's method with central differences.
fn solved(mut unknowns: [f64; 2]) -> [f64; 2] {
    for _ in 0..30 {
        let value = undamped_flip(unknowns);
        let slope = |j: usize| {
            let at = |h: f64| {
                let mut other = unknowns;
                other[j] += h;
                undamped_flip(other)
            };
            let (above, below) = (at(1e-6), at(-1e-6));
            [0, 1].map(|i| (above[i] - below[i]) / 2e-6)
        };
        let (x, y) = (slope(0), slope(1));
        let determinant = x[0] * y[1] - x[1] * y[0];
        unknowns[0] -= (value[0] * y[1] - value[1] * y[0]) / determinant;
        unknowns[1] -= (x[0] * value[1] - x[1] * value[0]) / determinant;
    }
    unknowns
}

/// Where the damper passes zero the determinant of the monodromy matrix is one, so a second multiplier meets
/// the one at -1.
#[test]
fn a_flip_curve_has_its_1_2_resonance_where_the_damper_passes_zero() {
    let case = undamped_within();
    let range_hz = (0.3, 0.5);
    let settings = OrbitSettings::for_range(range_hz);
    let start = find_start(&case.0, &case.1, 0.31, 1, &settings).unwrap();
    let mut rows = Vec::new();
    let mut walk = BranchWalk::new(&case.0, &case.1, &start, Side::Up, range_hz, &settings).unwrap();
    while walk.step(&mut rows).unwrap().is_none() {}
    let flip = rows.iter().find(|row| row.events.flip).unwrap();
    let parameter = Parameter::ADDED_DAMPING_RATIO;
    let settings =
        CurveSettings { parameter, range: (-0.0505, 0.01), range_hz, max_step: 0.5, max_rows: 3000 };
    let mut walk = CurveWalk::new(
        &case.0,
        &case.1,
        &flip.solution,
        (CurveKind::Flip, Side::Down),
        &settings,
        &OrbitSettings::default(),
    )
    .unwrap();
    let mut rows = Vec::new();
    let end = loop {
        match walk.step().unwrap() {
            Ok(row) => rows.push(row),
            Err(end) => break end,
        }
    };
    let marked: Vec<&CurveRow> = rows.iter().filter(|row| row.events.resonance == Some(2)).collect();
    assert_eq!(marked.len(), 1, "{end:?}");
    // Two multipliers at -1 are no pair there.
    assert!(rows.iter().all(|row| !row.events.flip_neimark_sacker));
    let row = marked[0];
    assert!((row.parameter + 0.05).abs() < 1e-9, "{}", row.parameter);
    let system = case.0.clone().with_parameter(parameter, row.parameter).unwrap();
    let mut multipliers = general_multipliers(&system, &row.solution);
    multipliers.sort_by(|a, b| (a[0] + 1.0).hypot(a[1]).total_cmp(&(b[0] + 1.0).hypot(b[1])));
    // A double multiplier leaves -1 like the square root of an error; its sum and product do not.
    let [[a, b], [c, d]] = [multipliers[0], multipliers[1]];
    let (sum, product) = (a + c, a * c - b * d);
    assert!((sum + 2.0).abs() < 1e-8 && (product - 1.0).abs() < 1e-8, "{multipliers:?}");
    let omega = TAU * row.solution.frequency_hz;
    let places = (1..400).map(|k| solved([omega, TAU / omega * f64::from(k) / 400.0]));
    let errors = places.map(|[w, s]| {
        let holds = undamped_flip([w, s]).iter().all(|value| value.abs() < 1e-10) && s > 0.0 && s < TAU / w;
        if holds { (w / omega - 1.0).abs() } else { f64::INFINITY }
    });
    let error = errors.fold(f64::INFINITY, f64::min);
    assert!(error < 1e-11, "{error:e} off the closed form");
}
