//! A curve of orbits that graze a stop once, and come to graze it a second time in the period.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::TAU;

use hammerbeam_motion::{
    Law, Parameter, System,
    law::{HertzStop, RigidStop},
};
use hammerbeam_orbit::{
    CurveEnd, CurveKind, CurveRow, CurveSettings, CurveWalk, OrbitMaxima, OrbitSettings, PeriodicSolution,
    Response, Side,
};
use hammerbeam_testkit::{
    structures::unit_mass,
    systems::{element, force, forced},
};

const DAMPING: f64 = 0.1;
/// Second harmonic of the force, of which the first one is 1 [N], and its phase.
const SECOND: (f64, f64) = (0.5, 0.7);
const RANGE_HZ: (f64, f64) = (0.03, 0.12);

/// Unit mass on a unit spring, with a stop below.
fn oscillator(law: Law) -> (System, Response) {
    let load = forced(vec![force(&[1.0], 1, 1.0, 0.0), force(&[1.0], 2, SECOND.0, SECOND.1)]);
    let system = System::new(unit_mass(1.0, DAMPING), &load, vec![element(&[-1.0], 0.0, law)]).unwrap();
    (system, Response { shape: vec![1.0], support_ratios: vec![0.0] })
}

/// The motion without contact at a phase, and its velocity [m/cycle] and acceleration [m/cycle^2]: of a force
/// `F cos (k w t + a)` it is the real part of `F exp i(k w t + a)/(1 - (k w)^2 + i c k w)`.
fn linear_motion(frequency_hz: f64, phase: f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (order, amplitude, ahead) in [(1.0, 1.0, 0.0), (2.0, SECOND.0, SECOND.1)] {
        let w: f64 = order * TAU * frequency_hz;
        let (re, im) = (1.0 - w * w, DAMPING * w);
        let (size, behind) = (amplitude / re.hypot(im), im.atan2(re));
        let (sine, cosine) = (order * TAU * phase + ahead - behind).sin_cos();
        let turn = order * TAU;
        sum[0] += size * cosine;
        sum[1] -= size * turn * sine;
        sum[2] -= size * turn * turn * cosine;
    }
    sum
}

/// The minima of the displacement over a period, in the order of the phase [m].
fn minima(frequency_hz: f64) -> Vec<f64> {
    const LOOKS: usize = 400;
    let at = |k: usize| k as f64 / LOOKS as f64;
    let turns = (0..LOOKS).filter(|&k| {
        linear_motion(frequency_hz, at(k))[1] < 0.0 && linear_motion(frequency_hz, at(k + 1))[1] >= 0.0
    });
    let lowest = turns.map(|k| {
        let mut phase = at(k);
        for _ in 0..30 {
            let [_, slope, bend] = linear_motion(frequency_hz, phase);
            phase -= slope / bend;
        }
        linear_motion(frequency_hz, phase)[0]
    });
    lowest.collect()
}

/// Frequency between two at which both minima are equal.
fn hz_of_both((mut low, mut high): (f64, f64)) -> f64 {
    let apart = |hz: f64| {
        let minima = minima(hz);
        assert_eq!(minima.len(), 2, "{hz}");
        minima[0] - minima[1]
    };
    let at_low = apart(low);
    assert!(at_low * apart(high) < 0.0, "the deeper one is the same at both ends");
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if apart(middle) * at_low > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// From 0.07 Hz on, with larger gaps.
fn walk(law: Law, gap: f64) -> (Vec<CurveRow>, CurveEnd) {
    let (system, response) = oscillator(law);
    let orbits = OrbitSettings::for_range(RANGE_HZ);
    let [displacement, slope, _] = linear_motion(0.07, 0.0);
    let start = PeriodicSolution {
        frequency_hz: 0.07,
        period_multiple: 1,
        phase: 0.0,
        nodes: vec![vec![displacement, slope * 0.07]],
        floquet_multipliers: vec![],
        on_circle: Vec::new(),
        residual: 0.0,
        error_estimate: 0.0,
        maxima: OrbitMaxima::default(),
    };
    let settings = CurveSettings {
        parameter: Parameter::gap(0),
        range: (0.5 * gap, 2.0 * gap),
        range_hz: RANGE_HZ,
        max_step: 0.5,
        max_rows: 1000,
    };
    let kind = (CurveKind::Grazing { contact: None }, Side::Up);
    let mut walk = CurveWalk::new(&system, &response, &start, kind, &settings, &orbits).unwrap();
    let mut rows = Vec::new();
    loop {
        match walk.step().unwrap() {
            Ok(row) => rows.push(row),
            Err(end) => return (rows, end),
        }
    }
}

/// The gap with which the motion without contact grazes at 0.07 Hz.
fn gap_of_start() -> f64 {
    minima(0.07).into_iter().fold(0.0, f64::min).abs()
}

#[test]
fn it_ends_there_at_a_rigid_stop() {
    let gap = gap_of_start();
    let (rows, end) = walk(Law::Rigid(RigidStop::with_gap(0.7, gap).unwrap()), gap);
    let both = hz_of_both((0.075, 0.07725));
    let expected = minima(both)[0].abs();
    let CurveEnd::Grazing { parameter, .. } = end else { panic!("{end:?}") };
    assert!((parameter / expected - 1.0).abs() < 1e-6, "{parameter}, not {expected}");
    assert!(rows.len() > 20, "{}", rows.len());
    for row in rows {
        let lowest = minima(row.solution.frequency_hz).into_iter().fold(0.0, f64::min);
        assert!((row.parameter + lowest).abs() < 1e-8, "{} at {}", row.parameter, row.solution.frequency_hz);
    }
}

#[test]
fn it_goes_on_with_a_contact_more_at_an_elastic_one() {
    let gap = gap_of_start();
    let (rows, end) = walk(Law::Hertz(HertzStop::with_gap(0.5, gap).unwrap()), gap);
    let both = hz_of_both((0.075, 0.07725));
    assert_eq!(end, CurveEnd::RangeEnd);
    let marked: Vec<&CurveRow> = rows.iter().filter(|row| row.events.double_grazing).collect();
    assert_eq!(marked.len(), 1, "{:?}", marked.iter().map(|row| row.parameter).collect::<Vec<_>>());
    let expected = minima(both)[0].abs();
    assert!((marked[0].parameter / expected - 1.0).abs() < 1e-5, "{}, not {expected}", marked[0].parameter);
    assert!((marked[0].solution.frequency_hz / both - 1.0).abs() < 1e-5);
    let contacts = |row: &CurveRow| row.solution.maxima.contacts;
    let ahead = rows.iter().filter(|row| row.solution.frequency_hz < both * (1.0 - 1e-4));
    assert!(ahead.clone().count() > 20 && ahead.map(contacts).all(|contacts| contacts == 0));
    assert!(contacts(&rows[rows.len() - 1]) == 1);
}
