//! Exponents of published systems, each by the general integrator.
//!
//! Sprott, *Chaos and Time-Series Analysis*, Oxford University Press 2003, appendix A, tabulates for the
//! parameters below
//!
//! | system | exponents | dimension after Kaplan and Yorke |
//! |---|---|---|
//! | Lorenz | 0.9056, 0, -14.5723 | 2.06215 |
//! | Roessler | 0.0714, 0, -5.3943 | 2.0132 |
//! | Ueda | 0.1034, 0, -0.1534 | 2.6741 |
//!
//! (the zero of Ueda's oscillator belongs to the phase, which is no part of its state here). Tolerances: half
//! a unit of the last digit and twice the half width of the average, which itself is bounded: by 5e-3, and
//! with `HAMMERBEAM_EXTENSIVE`, which averages 400 times as long, by 1.5e-4.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use hammerbeam_attractor::{FieldMap, LyapunovSettings, SectionMap, Spectrum, lyapunov};
use hammerbeam_motion::general::{GeneralSettings, Point, VectorField};

/// A field of a state of length N, with its derivative, `[i][j]`.
struct Field<const N: usize> {
    rate: fn(f64, &[f64]) -> [f64; N],
    derivative: fn(&[f64]) -> [[f64; N]; N],
}

impl<const N: usize> VectorField for Field<N> {
    fn dimension(&self) -> usize {
        N
    }

    fn evaluate(&mut self, at: Point<'_>, derivative: &mut [f64]) {
        derivative.copy_from_slice(&(self.rate)(at.time, at.state));
    }

    fn tangents(&mut self, at: Point<'_>, columns: &[f64], derivatives: &mut [f64]) {
        let matrix = (self.derivative)(at.state);
        for (column, derivative) in columns.chunks_exact(N).zip(derivatives.chunks_exact_mut(N)) {
            for (entry, row) in derivative.iter_mut().zip(&matrix) {
                *entry = row.iter().zip(column).map(|(a, y)| a * y).sum();
            }
        }
    }
}

const LORENZ: Field<3> = Field {
    rate: |_, z| [10.0 * (z[1] - z[0]), z[0] * (28.0 - z[2]) - z[1], z[0] * z[1] - 8.0 / 3.0 * z[2]],
    derivative: |z| [[-10.0, 10.0, 0.0], [28.0 - z[2], -1.0, -z[0]], [z[1], z[0], -8.0 / 3.0]],
};

const ROESSLER: Field<3> = Field {
    rate: |_, z| [-z[1] - z[2], z[0] + 0.2 * z[1], 0.2 + z[2] * (z[0] - 5.7)],
    derivative: |z| [[0.0, -1.0, -1.0], [1.0, 0.2, 0.0], [z[2], 0.0, z[0] - 5.7]],
};

const UEDA: Field<2> = Field {
    rate: |t, z| [z[1], -0.05 * z[1] - z[0].powi(3) + 7.5 * t.cos()],
    derivative: |z| [[0.0, 1.0], [-3.0 * z[0] * z[0], -0.05]],
};

fn longer() -> u64 {
    if crate::common::extensive() { 400 } else { 1 }
}

fn spectrum<const N: usize>(field: Field<N>, duration: f64, parts: u64, averaged: u64) -> Spectrum {
    let settings = GeneralSettings::with_tolerance(1e-9);
    let mut map = FieldMap::new(field, duration, parts, settings).unwrap();
    let mut state = vec![0.5; N];
    for section in 0..200 * parts {
        state = map.advance(section, &state).unwrap();
    }
    lyapunov(&mut map, &state, LyapunovSettings { aligning: 200, averaged: averaged * longer() }).unwrap()
}

/// Each exponent is the printed one, within its digits and the interval of the average.
#[track_caller]
fn assert_published(found: &Spectrum, published: &[f64]) {
    let accuracy = if longer() > 1 { 1.5e-4 } else { 5e-3 };
    for (exponent, published) in found.exponents.iter().zip(published) {
        // The interval of 95 per cent fails once in twenty times; twice its width once in three thousand.
        let bound = 0.5e-4 + 2.0 * exponent.half_width;
        assert!((exponent.value - published).abs() <= bound, "{exponent:?}, published {published}");
        assert!(exponent.half_width <= accuracy, "{exponent:?}");
    }
}

#[test]
fn lorenz_exponents_are_0_9056_0_and_minus_14_5723() {
    let found = spectrum(LORENZ, 0.5, 1, 48_000);
    assert_published(&found, &[0.9056, 0.0, -14.5723]);
    assert!((found.kaplan_yorke_dimension - 2.06215).abs() < 1e-3, "{}", found.kaplan_yorke_dimension);
    // The divergence is constant: -10 - 1 - 8/3.
    assert!((found.sum + 41.0 / 3.0).abs() < 1e-6, "{}", found.sum);
}

#[test]
fn roessler_exponents_are_0_0714_0_and_minus_5_3943() {
    let found = spectrum(ROESSLER, 1.0, 1, 60_000);
    assert_published(&found, &[0.0714, 0.0, -5.3943]);
    assert!((found.kaplan_yorke_dimension - 2.0132).abs() < 1e-3, "{}", found.kaplan_yorke_dimension);
}

#[test]
fn ueda_exponents_are_0_1034_and_minus_0_1534() {
    let found = spectrum(UEDA, TAU / 4.0, 4, 48_000);
    assert_published(&found, &[0.1034, -0.1534]);
    // With the exponent zero of the phase the dimension is one more.
    assert!((found.kaplan_yorke_dimension + 1.0 - 2.6741).abs() < 0.03, "{}", found.kaplan_yorke_dimension);
    assert!((found.sum + 0.05).abs() < 1e-6, "{}", found.sum);
}
