//! Flows against difference quotients.

use faer::Mat;
use hammerbeam_motion::{LawConstant, Parameter, Stretch, System};

use super::integrator;

/// Differences of fourth order of a motion.
fn differences(advance: &mut dyn FnMut(f64) -> Vec<f64>, step: f64) -> Vec<f64> {
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k: f64| advance(k * step));
    (0..a.len()).map(|i| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * step)).collect()
}

/// Steps of differences, in the units of what is moved.
const STEP: f64 = 1e-6;

/// Largest difference of columns, displacements scaled by the eigenfrequencies, relative to the largest
/// entry; `rounding` is what rounding of the states leaves of the differences.
fn distance(system: &System, found: &[f64], expected: &[f64], rounding: f64) -> f64 {
    let n = system.dof();
    let scale = |i: usize| if i < n { system.model().natural_frequencies[i].max(10.0) } else { 1.0 };
    let size = (0..2 * n).map(|i| (expected[i] * scale(i)).abs()).fold(f64::MIN_POSITIVE, f64::max);
    let largest = (0..2 * n).map(|i| ((found[i] - expected[i]) * scale(i)).abs()).fold(0.0, f64::max);
    (largest - rounding).max(0.0) / size
}

/// What a few roundings of a state leave of differences with a step.
fn rounding(system: &System, state: &[f64], step: f64) -> f64 {
    let n = system.dof();
    let scale = |i: usize| if i < n { system.model().natural_frequencies[i].max(10.0) } else { 1.0 };
    let size = (0..2 * n).map(|i| (state[i] * scale(i)).abs()).fold(0.0, f64::max);
    16.0 * f64::EPSILON * size / step
}

/// Every column of the flow against differences.
pub fn assert_sensitivities(
    system: &System,
    stretch: &Stretch,
    state: &[f64],
    parameters: &[Parameter],
    bound: f64,
) {
    let mut exact = integrator(system);
    let flow = exact.flow(stretch, state).unwrap();
    assert_by_state(
        system,
        state,
        &flow.by_state,
        &mut |moved| exact.advance(stretch, moved).unwrap(),
        bound,
    );
    let mut moved = |step: f64| {
        let stretch = Stretch { frequency_hz: stretch.frequency_hz * (1.0 + step), ..*stretch };
        exact.advance(&stretch, state).unwrap()
    };
    let expected: Vec<f64> = differences(&mut moved, STEP).iter().map(|d| d / stretch.frequency_hz).collect();
    let left = rounding(system, &flow.state, STEP * stretch.frequency_hz);
    let error = distance(system, &flow.by_frequency, &expected, left);
    assert!(error < bound, "frequency: {error}\n{:?}\n{expected:?}", flow.by_frequency);
    assert_by_parameters(system, stretch, state, parameters, bound);
}

/// The column of each parameter against differences.
pub fn assert_by_parameters(
    system: &System,
    stretch: &Stretch,
    state: &[f64],
    parameters: &[Parameter],
    bound: f64,
) {
    let mut exact = integrator(system);
    for &parameter in parameters {
        exact.differentiate_by(Some(parameter)).unwrap();
        let flow = exact.flow(stretch, state).unwrap();
        exact.differentiate_by(None).unwrap();
        let value = system.parameter(parameter).unwrap();
        let scale = match parameter {
            Parameter::OfLaw { constant: LawConstant::Gap, .. } => 1e-3,
            Parameter::OfLaw { constant: LawConstant::Restitution, .. } => 10.0,
            // Of a weak spring a millionth moves the motion by hardly more than its steps round.
            Parameter::OfLaw { .. } => 10.0 * value,
            // In 1/s, where a ratio is one.
            Parameter::AddedDamping { part: 1.. } => 10.0,
            _ => 0.1,
        };
        let mut moved = |step: f64| {
            exact.set_parameter(parameter, value + step * scale).unwrap();
            exact.advance(stretch, state).unwrap()
        };
        let expected: Vec<f64> = differences(&mut moved, STEP).iter().map(|d| d / scale).collect();
        exact.set_parameter(parameter, value).unwrap();
        if is_without_effect(&flow.by_parameter, &expected) {
            continue;
        }
        let left = rounding(system, &flow.state, STEP * scale.abs());
        let error = distance(system, &flow.by_parameter, &expected, left);
        assert!(error < bound, "{parameter:?}: {error}\n{:?}\n{expected:?}", flow.by_parameter);
    }
}

/// The columns by state of a flow against differences of the motion.
pub fn assert_by_state(
    system: &System,
    state: &[f64],
    by_state: &Mat<f64>,
    advance: &mut dyn FnMut(&[f64]) -> Vec<f64>,
    bound: f64,
) {
    let (n, end) = (system.dof(), advance(state));
    for j in 0..2 * n {
        let scale = if j < n { 1.0 / system.model().natural_frequencies[j].max(10.0) } else { 1.0 };
        let mut moved = |step: f64| {
            let mut state = state.to_vec();
            state[j] += step * scale;
            advance(&state)
        };
        let expected: Vec<f64> = differences(&mut moved, STEP).iter().map(|d| d / scale).collect();
        let found: Vec<f64> = (0..2 * n).map(|i| by_state[(i, j)]).collect();
        if is_without_effect(&found, &expected) {
            continue;
        }
        let error = distance(system, &found, &expected, rounding(system, &end, STEP * scale));
        assert!(error < bound, "column {j}: {error}\n{found:?}\n{expected:?}");
    }
}

/// Of a state that is forgotten, or a parameter that has no part in the motion, differences leave nothing but
/// what rounds.
fn is_without_effect(found: &[f64], expected: &[f64]) -> bool {
    found.iter().all(|entry| *entry == 0.0) && expected.iter().all(|entry| entry.abs() < 1e-6)
}
