//! Models, loads and comparisons shared by the tests of the general integrator.
#![allow(dead_code, reason = "every test file uses its part")]

use faer::Mat;
use hammerbeam_motion::{Flow, Harmonic, HarmonicForce};
use hammerbeam_structure::{ReducedModel, SupportInput};

/// A model of these eigenfrequencies [rad/s] and modal damping matrix [1/s], without support motion.
pub fn model(natural_frequencies: &[f64], damping: Mat<f64>) -> ReducedModel {
    ReducedModel {
        natural_frequencies: natural_frequencies.to_vec(),
        damping,
        points: vec![],
        supports: vec![],
        uniform_acceleration: vec![0.0; natural_frequencies.len()],
    }
}

/// The same with a moving support.
pub fn supported(model: ReducedModel, inertia: &[f64], damping: &[f64]) -> ReducedModel {
    ReducedModel {
        supports: vec![SupportInput { inertia: inertia.to_vec(), damping: damping.to_vec() }],
        ..model
    }
}

pub fn diagonal(values: &[f64]) -> Mat<f64> {
    Mat::from_fn(values.len(), values.len(), |i, j| if i == j { values[i] } else { 0.0 })
}

pub fn harmonic_force(shape: &[f64], order: u32, amplitude: f64, phase: f64) -> HarmonicForce {
    HarmonicForce { shape: shape.to_vec(), harmonic: Harmonic { order, amplitude, phase } }
}

pub fn assert_near(found: f64, expected: f64, bound: f64, what: &str) {
    assert!(
        (found - expected).abs() <= bound,
        "{what}: {found:e} against {expected:e}, off by {:e}",
        found - expected
    );
}

/// Compares displacements with displacements and velocities with velocities, relative to the largest.
pub fn column_error(found: &[f64], expected: &[f64]) -> f64 {
    let part = found.len() / 2;
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let parts = found.chunks_exact(part).zip(expected.chunks_exact(part));
    parts
        .map(|(a, b)| {
            let difference: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
            largest(&difference) / largest(b).max(1e-300)
        })
        .fold(0.0, f64::max)
}

pub fn assert_columns_close(found: &[f64], expected: &[f64], bound: f64) {
    let error = column_error(found, expected);
    assert!(error <= bound, "{found:?} against {expected:?}: {error:e}");
}

/// Largest error of any column of a flow.
pub fn flow_error(found: &Flow, expected: &Flow) -> f64 {
    let column = |m: &Mat<f64>, j: usize| (0..m.nrows()).map(|i| m[(i, j)]).collect::<Vec<_>>();
    let columns = (0..found.state.len())
        .map(|j| column_error(&column(&found.by_state, j), &column(&expected.by_state, j)))
        .fold(0.0, f64::max);
    columns
        .max(column_error(&found.state, &expected.state))
        .max(column_error(&found.by_frequency, &expected.by_frequency))
}

/// Derivative of a vector function by differences of fourth order.
pub fn difference(step: f64, function: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    let [far_below, below, above, far_above] = [-2.0, -1.0, 1.0, 2.0].map(|k| function(k * step));
    (0..below.len())
        .map(|i| (8.0 * (above[i] - below[i]) - (far_above[i] - far_below[i])) / (12.0 * step))
        .collect()
}
