//! Two reductions of one structure agree in its periodic solutions as the cut-off grows.
#![allow(clippy::unwrap_used, reason = "a test ends where its study is wrong")]

use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_study::{Model, StudyFile};

/// A cantilever on a moving root whose tip meets a spring.
const BEAM: &str = r#"
    [structure]
    kind = "beam"
    length_m = 0.5
    elements = 60
    section = { width_m = 0.02, height_m = 0.003 }
    youngs_modulus_pa = 2.1e11
    density_kg_m3 = 7800.0
    left = "clamped"
    right = "free"
    [[structure.point]]
    name = "stop"
    at_m = 0.4
    [damping]
    rayleigh = { mass_per_s = 6.0, stiffness_s = 2e-5 }
    [excitation]
    kind = "support-motion"
    at = "left"
    amplitude_m = 0.4e-3
    frequency_hz = [5.0, 25.0]
    [[stop]]
    at = "stop"
    law = "linear"
    stiffness_n_m = 4.0e3
    side = "above"
    gap_m = 0.3e-3
    [response]
    point = "stop"
"#;
const FREQUENCY: f64 = 14.0;

/// Displacement of the stop's point at 32 phases of the motion that it settles to.
fn settled(method: &str, cut_off_hz: f64) -> Vec<f64> {
    let text = format!("{BEAM}[reduction]\nmethod = \"{method}\"\ncut_off_hz = {cut_off_hz}\n");
    let model = Model::build(&StudyFile::parse("beam.toml", text).unwrap()).unwrap();
    let settings = ExactSettings { tolerance: 1e-11 };
    let mut integrator = ExactIntegrator::new(model.system.clone(), settings).unwrap();
    let mut state = vec![0.0; 2 * model.system.dof()];
    // Damping takes exp(-3 t) off: 120 periods leave 1e-11.
    for _ in 0..120 {
        let period = Stretch { frequency_hz: FREQUENCY, start: 0.0, end: 1.0 };
        state = integrator.flow(&period, &state).unwrap().state;
    }
    let point = model.system.model().point("stop").unwrap();
    let mut displacements = Vec::new();
    for step in 0..32 {
        let ends = [step, step + 1].map(|k| f64::from(k) / 32.0);
        let support = model.system.support_motions(FREQUENCY, ends[0])[0][0];
        let of_modes: f64 = point.shape.iter().zip(&state).map(|(shape, q)| shape * q).sum();
        displacements.push(of_modes + point.support_ratios[0] * support);
        let stretch = Stretch { frequency_hz: FREQUENCY, start: ends[0], end: ends[1] };
        state = integrator.flow(&stretch, &state).unwrap().state;
    }
    displacements
}

/// Largest difference of two motions over the largest displacement.
fn difference(one: &[f64], other: &[f64]) -> f64 {
    let largest = one.iter().fold(0.0_f64, |largest, y| largest.max(y.abs()));
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest
}

/// Fixed interfaces and free ones keep other modes, and the same static answers. What they differ in is the
/// inertia beyond the cut-off, which the force of the stop meets with less and less the higher it is.
#[test]
fn fixed_and_free_interfaces_agree_in_periodic_motions_as_the_cut_off_grows() {
    let cut_offs = [200.0_f64, 400.0, 800.0, 1600.0, 3200.0];
    let differences = cut_offs
        .map(|cut_off_hz| difference(&settled("craig-bampton", cut_off_hz), &settled("rubin", cut_off_hz)));
    // Slope of the regression of the logarithms.
    let (x, y) = (cut_offs.map(f64::ln), differences.map(f64::ln));
    let mean = |values: &[f64; 5]| values.iter().sum::<f64>() / 5.0;
    let (mean_x, mean_y) = (mean(&x), mean(&y));
    let covariance: f64 = x.iter().zip(&y).map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let slope = covariance / x.iter().map(|x| (x - mean_x).powi(2)).sum::<f64>();
    // Of a mode beyond the cut-off the inertia is missed, a part `(W/w)^2` of its answer: the square
    // at least. It comes out at -2.5.
    assert!(slope < -2.0, "{differences:?}, slope {slope}");
    assert!(differences.windows(2).all(|pair| pair[1] < 0.3 * pair[0]), "{differences:?}");
    assert!(differences[4] < 1e-5, "{differences:?}");
}
