//! What has nothing to do with a doubling changes nothing about it: a weight, which moves the place of rest,
//! or a far larger motion beside it.
//!
//! The bilinear oscillator of `flips_bilinear.rs` with a constant force that moves it by a thousand times its
//! motion, carried by its spring or by a stop; and beside a linear oscillator, not coupled with it, that
//! moves some thousand times as much. Its branches are those without either.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::events::{
    Subject, alternation, assert_same, leaving, oscillator, sorted, step_of, whole, with,
};
use faer::Mat;
use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, LocalElement, System, law::LinearStop};
use hammerbeam_orbit::{BranchRow, Response, Side, StopReason, find_start};
use hammerbeam_structure::ReducedModel;

const RANGE: (f64, f64) = (0.12, 0.5);
/// The motion is of the size one.
const SAG: f64 = 1000.0;

fn stop(stiffness: f64, gap: f64) -> Law {
    Law::Linear(LinearStop::with_gap(stiffness, gap).unwrap())
}

fn force(shape: &[f64], order: u32, amplitude: f64) -> HarmonicForce {
    HarmonicForce { shape: shape.to_vec(), harmonic: Harmonic { order, amplitude, phase: 0.0 } }
}

/// `x'' + 0.1 x' + x = sag + cos W t`, with 19 N/m more beyond `x = sag`; of the spring of 1 N/m this share
/// is a stop that never opens.
fn subject(sag: f64, by_stop: f64) -> Subject {
    let (light, response) = oscillator(1.0 - by_stop, 0.1, 1.0, stop(19.0, sag));
    let load = Load { support: vec![], forces: vec![force(&[1.0], 0, sag), force(&[1.0], 1, 1.0)] };
    let mut elements = light.elements().to_vec();
    if by_stop > 0.0 {
        elements.push(LocalElement {
            name: "support".into(),
            law: stop(by_stop, 0.0),
            ..elements[0].clone()
        });
    }
    (System::new(light.model().clone(), &load, elements).unwrap(), response)
}

/// The oscillator without a weight beside `y'' + 0.1 y' + 4 y = size cos W t`; of the orbit the doubling is a
/// `1/size`.
fn beside_a_large_motion(size: f64) -> Subject {
    let (alone, _) = oscillator(1.0, 0.1, 1.0, stop(19.0, 0.0));
    let model = ReducedModel {
        natural_frequencies: vec![1.0, 2.0],
        damping: Mat::from_fn(2, 2, |i, j| if i == j { 0.1 } else { 0.0 }),
        points: vec![],
        supports: vec![],
        uniform_acceleration: vec![0.0, 0.0],
    };
    let load =
        Load { support: vec![], forces: vec![force(&[1.0, 0.0], 1, 1.0), force(&[0.0, 1.0], 1, size)] };
    let element = LocalElement { shape: vec![1.0, 0.0], ..alone.elements()[0].clone() };
    let response = Response { shape: vec![1.0, 0.0], support_ratios: vec![0.0] };
    (System::new(model, &load, vec![element]).unwrap(), response)
}

/// Where the harmonic branch flips, and for each flip where the branch that leaves there ends; on the way it
/// is never the harmonic branch run through twice, which alternates by less than a tenth of `least`.
fn flips_and_ends(subject: &Subject, least: f64) -> (Vec<f64>, Vec<f64>) {
    let settings = step_of(0.001);
    let start = find_start(&subject.0, &subject.1, 0.3, 1, &settings).unwrap();
    let rows = whole(subject, &start, RANGE, &settings);
    let flips = with(&rows, |events| events.flip);
    let ends = flips.iter().map(|flip| {
        let (rows, reason) = leaving(subject, flip, Side::Up, RANGE, &settings);
        for row in rows.iter().filter(|row| !row.events.branch_point) {
            assert!(alternation(&subject.0, &row.solution) > least, "{} Hz", row.solution.frequency_hz);
        }
        match reason {
            StopReason::ShorterPeriod { place: frequency_hz, .. } => {
                assert_ends_in_flip(&rows[rows.len() - 1], frequency_hz, &flips);
                frequency_hz
            }
            StopReason::RangeEnd { place: frequency_hz } => frequency_hz,
            other => panic!("{other:?}"),
        }
    });
    (sorted(&flips), ends.collect())
}

/// However the walk came to its end, its last row is the flip of the harmonic branch there.
#[track_caller]
fn assert_ends_in_flip(last: &BranchRow, end: f64, flips: &[&BranchRow]) {
    assert!(last.events.branch_point && last.solution.frequency_hz == end, "{end} Hz: {:?}", last.events);
    let off = flips.iter().map(|flip| (flip.solution.frequency_hz - end).abs()).fold(f64::INFINITY, f64::min);
    assert!(off < 1e-10, "the end at {end} Hz is {off:e} Hz beside a flip");
}

/// The flips and ends of a subject agree with the oscillator alone, to a part of the units.
#[track_caller]
fn assert_as_alone(subject: &Subject, least: f64, tolerance: f64) {
    let (flips, ends) = flips_and_ends(&self::subject(0.0, 0.0), 1e-5);
    assert!(flips.len() >= 2 && ends.iter().any(|end| (RANGE.0 + 1e-6..RANGE.1 - 1e-6).contains(end)));
    let (found_flips, found_ends) = flips_and_ends(subject, least);
    assert_same(&found_flips, &flips, tolerance, "flips");
    assert_same(&found_ends, &ends, tolerance, "ends of the doubled branches");
}

#[test]
fn branches_about_a_sag_are_those_without_it() {
    assert_as_alone(&subject(SAG, 0.0), 1e-8, 1e-10);
}

/// The sag sets the units here; the motion is a five-thousandth of it.
#[test]
fn branches_about_a_sag_that_a_stop_carries_are_those_without_it() {
    assert_as_alone(&subject(5.0 * SAG, 0.9), 1e-9, 1e-10);
}

#[test]
fn branches_beside_a_far_larger_motion_are_those_without_it() {
    assert_as_alone(&beside_a_large_motion(4e3), 1e-9, 1e-10);
}
