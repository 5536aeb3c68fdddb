//! Grazing of a linear oscillator against its stop, in closed form.
//!
//! Without contact `x'' + c x' + k x = F cos W t` has the amplitude `F / sqrt((k - W^2)^2 + (c W)^2)`, which
//! is the gap `g` where `W^4 + (c^2 - 2 k) W^2 + k^2 - (F/g)^2 = 0`: contact sets in below the resonance at
//! the smaller root and ceases above it at the larger one, unless the orbit that touches has turned back
//! before.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::TAU;

use crate::common::events::{Subject, assert_same, oscillator, side, step_of, whole, with};
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, System,
    law::{HertzStop, LinearStop, TwoSidedStop},
};
use hammerbeam_orbit::{BranchRow, ContactChange, EventStatus, Side, find_start};

const DAMPER: f64 = 0.1;
const FORCE: f64 = 0.2;
const GAP: f64 = 0.5;
const RANGE: (f64, f64) = (0.05, 0.4);

/// Frequencies at which the linear amplitude is the gap, the lower one first [Hz].
fn closed_form() -> [f64; 2] {
    let (b, c) = (DAMPER * DAMPER - 2.0, 1.0 - (FORCE / GAP).powi(2));
    let root = (0.25 * b * b - c).sqrt();
    [-1.0, 1.0].map(|sign| (-0.5 * b + sign * root).sqrt() / TAU)
}

fn linear() -> Law {
    Law::Linear(LinearStop::with_gap(5.0, GAP).unwrap())
}

/// Grazing rows from one end of the range to the other.
fn grazings(subject: &Subject, start_hz: f64, range: (f64, f64)) -> Vec<BranchRow> {
    let start = find_start(&subject.0, &subject.1, start_hz, 1, &step_of(0.001)).unwrap();
    let rows = whole(subject, &start, range, &step_of(0.001));
    with(&rows, |events| events.grazing).into_iter().cloned().collect()
}

#[test]
fn contact_sets_in_and_ceases_where_the_linear_amplitude_is_the_gap() {
    for law in [linear(), Law::Hertz(HertzStop::with_gap(5.0, GAP).unwrap())] {
        let rows = grazings(&oscillator(1.0, DAMPER, FORCE, law), 0.06, RANGE);
        let found: Vec<f64> = rows.iter().map(|row| row.solution.frequency_hz).collect();
        assert_same(&found, &closed_form(), 1e-8, "grazing");
        for (row, appears) in rows.iter().zip([true, false]) {
            let event = row.located.as_ref().unwrap();
            assert_eq!(event.contacts, [ContactChange { contact: 0, appears }]);
            assert_eq!(event.status, EventStatus::Located);
            let nearest = closed_form().map(|f| (row.solution.frequency_hz - f).abs());
            let error = nearest[0].min(nearest[1]);
            assert!(error <= event.uncertainty, "{error:e}, within {:e}", event.uncertainty);
            assert_eq!(event.multiplier, None, "nothing else happens at mere grazing");
        }
    }
}

/// Walked the other way, what appeared vanishes.
#[test]
fn a_contact_that_appears_upwards_vanishes_downwards() {
    let subject = oscillator(1.0, DAMPER, FORCE, linear());
    let start = find_start(&subject.0, &subject.1, 0.39, 1, &step_of(0.001)).unwrap();
    let (rows, _) = side(&subject, &start, Side::Down, RANGE, &step_of(0.001));
    let rows = with(&rows, |events| events.grazing);
    let [low, high] = closed_form();
    let found: Vec<f64> = rows.iter().map(|row| row.solution.frequency_hz).collect();
    assert_same(&found, &[high, low], 1e-8, "grazing downwards");
    let appears: Vec<bool> = rows
        .iter()
        .flat_map(|row| row.located.clone().unwrap().contacts)
        .map(|change| change.appears)
        .collect();
    assert_eq!(appears, [true, false]);
}

/// Two elements, of which only the second is within reach; and a two-sided stop, whose lower contact is
/// nearer.
#[test]
fn the_contact_is_the_one_that_grazes() {
    let (near, far) = (linear(), Law::Linear(LinearStop::with_gap(5.0, 100.0).unwrap()));
    let subject = oscillator(1.0, DAMPER, FORCE, near.clone());
    let harmonic = Harmonic { order: 1, amplitude: FORCE, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let element =
        |law| LocalElement { name: "stop".into(), shape: vec![1.0], support_ratios: vec![0.0], law };
    let two = System::new(subject.0.model().clone(), &load, vec![element(far), element(near)]).unwrap();
    let lower = Law::TwoSided(TwoSidedStop::new(5.0, 100.0, GAP).unwrap());
    for subject in [(two, subject.1.clone()), oscillator(1.0, DAMPER, FORCE, lower)] {
        let rows = grazings(&subject, 0.06, RANGE);
        let found: Vec<f64> = rows.iter().map(|row| row.solution.frequency_hz).collect();
        assert_same(&found, &closed_form(), 1e-8, "grazing");
        let contacts: Vec<ContactChange> =
            rows.iter().flat_map(|row| row.located.clone().unwrap().contacts).collect();
        let expected = [true, false].map(|appears| ContactChange { contact: 1, appears });
        assert_eq!(contacts, expected);
    }
}
