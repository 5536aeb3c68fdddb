//! Motions that a study settles to, by simulation.

use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_study::{Model, StudyFile};

/// Displacement of a point at 32 phases of the motion that it settles to in so many periods.
pub fn settled(file: &StudyFile, point: &str, frequency_hz: f64, periods: usize) -> Vec<f64> {
    let model = Model::build(file).unwrap();
    let settings = ExactSettings { tolerance: 1e-11 };
    let mut integrator = ExactIntegrator::new(model.system.clone(), settings).unwrap();
    let mut state = vec![0.0; 2 * model.system.dof()];
    for _ in 0..periods {
        let period = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        state = integrator.flow(&period, &state).unwrap().state;
    }
    let point = model.system.model().point(point).unwrap();
    let mut displacements = Vec::new();
    for step in 0..32 {
        let ends = [step, step + 1].map(|k| f64::from(k) / 32.0);
        let support = model.system.support_motions(frequency_hz, ends[0])[0][0];
        let of_modes: f64 = point.shape.iter().zip(&state).map(|(shape, q)| shape * q).sum();
        displacements.push(of_modes + point.support_ratios[0] * support);
        let stretch = Stretch { frequency_hz, start: ends[0], end: ends[1] };
        state = integrator.flow(&stretch, &state).unwrap().state;
    }
    displacements
}

/// Largest difference of two motions over the largest displacement.
pub fn difference(one: &[f64], other: &[f64]) -> f64 {
    let largest = one.iter().fold(0.0_f64, |largest, y| largest.max(y.abs()));
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest
}
