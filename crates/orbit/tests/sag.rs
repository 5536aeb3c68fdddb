//! A weight moves the place of rest and nothing else: with stops set from there the branches are those without it.
//!
//! The bilinear oscillator of `flips_bilinear.rs` with a constant force that moves it by a thousand times its motion.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

mod common;

use common::events::{Subject, alternation, assert_same, leaving, oscillator, sorted, step_of, whole, with};
use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, System, law::LinearStop};
use hammerbeam_orbit::{Side, StopReason, find_start};

const RANGE: (f64, f64) = (0.12, 0.5);
/// The motion is of the size one.
const SAG: f64 = 1000.0;

/// `x'' + 0.1 x' + x = sag + cos W t`, with 19 N/m more beyond `x = sag`.
fn subject(sag: f64) -> Subject {
    let law = |gap: f64| Law::Linear(LinearStop::with_gap(19.0, gap).unwrap());
    let (light, response) = oscillator(1.0, 0.1, 1.0, law(sag));
    let force = |order: u32, amplitude: f64| HarmonicForce {
        shape: vec![1.0],
        harmonic: Harmonic { order, amplitude, phase: 0.0 },
    };
    let load = Load { support: vec![], forces: vec![force(0, sag), force(1, 1.0)] };
    (System::new(light.model().clone(), &load, light.elements().to_vec()).unwrap(), response)
}

/// Where the harmonic branch flips, and for each flip where the branch that leaves there ends.
fn flips_and_ends(subject: &Subject) -> (Vec<f64>, Vec<f64>) {
    let settings = step_of(0.001);
    let start = find_start(&subject.0, &subject.1, 0.3, 1, &settings).unwrap();
    let rows = whole(subject, &start, RANGE, &settings);
    let flips = with(&rows, |events| events.flip);
    let ends = flips.iter().map(|flip| {
        let (rows, reason) = leaving(subject, flip, Side::Up, RANGE, &settings);
        // On the way it is nowhere the harmonic branch run through twice, which alternates by less than 1e-9.
        for row in rows.iter().filter(|row| !row.events.branch_point) {
            assert!(alternation(&subject.0, &row.solution) > 1e-8, "{} Hz", row.solution.frequency_hz);
        }
        match reason {
            StopReason::ShorterPeriod { frequency_hz } | StopReason::RangeEnd { frequency_hz } => {
                frequency_hz
            }
            other => panic!("{other:?}"),
        }
    });
    (sorted(&flips), ends.collect())
}

#[test]
fn branches_about_a_sag_are_those_without_it() {
    let (flips, ends) = flips_and_ends(&subject(0.0));
    assert!(flips.len() >= 2 && ends.iter().any(|end| (RANGE.0 + 1e-6..RANGE.1 - 1e-6).contains(end)));
    let (sagging_flips, sagging_ends) = flips_and_ends(&subject(SAG));
    assert_same(&sagging_flips, &flips, 1e-8, "flips");
    assert_same(&sagging_ends, &ends, 1e-8, "ends of the doubled branches");
}
