//! The search of the general integrator for places where a field switches: every zero of a switching function
//! is found, however close together they lie.
//!
//! The state is the value of a polynomial of time, which steps and dense output follow exactly, so steps are
//! as long as they can be and nothing but the search decides.
#![allow(clippy::unwrap_used, reason = "tests")]

use hammerbeam_motion::general::{Counts, GeneralSettings, Point, VectorField, integrate};

/// `z' = ds/dt` with the switching function z, for `s = factor (t - root_1) (t - root_2) ...`.
struct Polynomial {
    factor: f64,
    roots: Vec<f64>,
}

impl Polynomial {
    fn value(&self, time: f64) -> f64 {
        self.factor * self.roots.iter().map(|root| time - root).product::<f64>()
    }

    fn slope(&self, time: f64) -> f64 {
        let without = |k: usize| -> f64 {
            self.roots.iter().enumerate().filter(|(i, _)| *i != k).map(|(_, root)| time - root).product()
        };
        self.factor * (0..self.roots.len()).map(without).sum::<f64>()
    }
}

impl VectorField for Polynomial {
    fn dimension(&self) -> usize {
        1
    }

    fn evaluate(&mut self, at: Point<'_>, derivative: &mut [f64]) {
        derivative[0] = self.slope(at.time);
    }

    fn tangents(&mut self, _: Point<'_>, _: &[f64], derivatives: &mut [f64]) {
        derivatives.fill(0.0);
    }

    fn switches(&self) -> usize {
        1
    }

    fn switching(&self, _: f64, state: &[f64], values: &mut [f64]) {
        values[0] = state[0];
    }
}

/// From 0 to 1.
fn counts(factor: f64, roots: &[f64]) -> Counts {
    let mut field = Polynomial { factor, roots: roots.to_vec() };
    let start = field.value(0.0);
    integrate(&mut field, 0.0, 1.0, &[start], &GeneralSettings::with_tolerance(1e-11)).unwrap().counts
}

/// The function leaves zero behind for a moment only, wherever in a step that lies.
#[test]
fn two_zeros_are_found_wherever_they_lie_in_a_step() {
    for factor in [1.0, -1.0] {
        for apart in [1e-2, 1e-3, 1e-4, 1.6e-5] {
            for place in 1..200 {
                let first = 0.01 + 0.0049 * f64::from(place);
                let counts = counts(factor, &[first, first + apart]);
                assert_eq!(counts.crossings, 2, "{apart} apart at {first}: {counts:?}");
            }
        }
    }
}

/// A contact, a flight and a contact within less than the distance of two samples of a step.
#[test]
fn three_zeros_are_found_wherever_they_lie_in_a_step() {
    for factor in [1.0, -1.0] {
        for apart in [1e-2, 1e-3, 1e-4] {
            for place in 1..200 {
                let first = 0.0049 * f64::from(place);
                let counts = counts(factor, &[first, first + apart, first + 1.6 * apart]);
                assert_eq!(counts.crossings, 3, "{apart} apart at {first}: {counts:?}");
            }
        }
    }
}
