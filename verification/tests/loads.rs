//! Loads that depend on the frequency, act on several points or against one another: closed forms, and the
//! integrator that shares nothing with the library.
#![allow(clippy::unwrap_used, reason = "a test ends where its study is wrong")]

use std::f64::consts::TAU;

use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_study::{Model, StudyFile};
use hammerbeam_verification::{
    attractors::{Simulator, distance},
    plain::Equations,
};

/// A mass of 2 kg on 50 N/m, and its frequency [Hz] below.
const MASS: &str = r#"
    [structure]
    kind = "lumped"
    mass = [{ name = "mass", mass_kg = 2.0 }]
    spring = [{ between = ["mass", "ground"], stiffness_n_m = 50.0 }]
    [excitation]
    frequency_hz = [0.5, 1.0]
"#;
const FREQUENCY: f64 = 0.7;

/// Two masses with a stop between them and the ground, shaken in many ways.
const PAIR: &str = r#"
    [structure]
    kind = "lumped"
    mass = [{ name = "a", mass_kg = 2.0 }, { name = "b", mass_kg = 0.7 }]
    spring = [
        { between = ["a", "ground"], stiffness_n_m = 80.0 },
        { between = ["a", "b"], stiffness_n_m = 60.0 },
    ]
    damper = [
        { between = ["a", "ground"], damping_n_s_m = 0.4 },
        { between = ["a", "b"], damping_n_s_m = 0.3 },
    ]
    [[stop]]
    at = "b"
    fixed_to = "space"
    law = "linear"
    side = "above"
    stiffness_n_m = 900.0
    gap_m = 0.02
    [excitation]
    frequency_hz = [0.5, 2.0]
"#;

const FORCES: &str = r#"
    kind = "force"
    [[excitation.force]]
    at = "a"
    amplitude_n = 2.0
    phase_rad = 0.4
    [[excitation.force]]
    between = ["b", "a"]
    amplitude_n = [[0.4, 0.5], [2.5, 1.5]]
    phase_rad = -1.1
    [[excitation.force]]
    at = "b"
    unbalance_mass_kg = 0.05
    eccentricity_m = 0.1
    [[load]]
    kind = "force"
    between = ["a", "b"]
    unbalance_mass_kg = 0.02
    eccentricity_m = 0.05
    order = 2
    phase_rad = 0.9
"#;

const SHAKEN: &str = r#"
    kind = "support-motion"
    at = "ground"
    amplitude_m_s2 = 1.5
    phase_rad = 0.3
    [[load]]
    kind = "force"
    at = "b"
    amplitude_n = [[0.4, 0.5], [2.5, 0.2]]
    order = 3
"#;

fn model(text: &str) -> Model {
    Model::build(&StudyFile::parse("study.toml", text.to_owned()).unwrap()).unwrap()
}

/// State of the mode of the mass after a period from `x` at rest, as a displacement of the mass against its
/// ground, and its velocity.
fn after_a_period(excitation: &str, x: f64) -> [f64; 2] {
    let model = model(&format!("{MASS}{excitation}"));
    let root = 2.0_f64.sqrt();
    let state = Simulator::exact(&model.system, FREQUENCY).unwrap().period(&[x * root, 0.0]).unwrap();
    [state[0] / root, state[1] / root]
}

/// `x = m e W^2/(k - M W^2)`.
#[test]
fn unbalance_moves_a_mass_as_its_closed_form() {
    let w = TAU * FREQUENCY;
    let x = 0.1 * 0.05 * w * w / (50.0 - 2.0 * w * w);
    let unbalance = "kind = \"force\"\nat = \"mass\"\nunbalance_mass_kg = 0.1\neccentricity_m = 0.05\n";
    let [after, velocity] = after_a_period(unbalance, x);
    assert!((after - x).abs() < 1e-13 && velocity.abs() < 1e-12, "{after} {x} {velocity}");
}

/// With the ground accelerated as `a cos W t` the mass moves against it as under `-M a cos W t`:
/// `x = -M a/(k - M W^2)`.
#[test]
fn accelerated_ground_pulls_a_mass_by_its_inertia() {
    let w = TAU * FREQUENCY;
    let x = -2.0 * 3.0 / (50.0 - 2.0 * w * w);
    let shaken = "kind = \"support-motion\"\nat = \"ground\"\namplitude_m_s2 = 3.0\n";
    let [after, velocity] = after_a_period(shaken, x);
    assert!((after - x).abs() < 1e-11 && velocity.abs() < 1e-10, "{after} {x} {velocity}");
    // A displacement of the same size is -a/W^2.
    let displaced = format!(
        "kind = \"support-motion\"\nat = \"ground\"\namplitude_m = {}\nphase_rad = {}\n",
        3.0 / (w * w),
        std::f64::consts::PI
    );
    let [other, _] = after_a_period(&displaced, x);
    assert!((after - other).abs() < 1e-12);
}

#[test]
fn the_plain_integrator_follows_all_of_them() {
    for excitation in [FORCES, SHAKEN] {
        let text = format!("{PAIR}{excitation}");
        let model = model(&text);
        let equations = Equations::read(&text.parse().unwrap(), &model).unwrap();
        for frequency_hz in [0.73, 1.6] {
            let mut plain = Simulator::plain(&equations, &model, frequency_hz);
            let mut exact = Simulator::exact(&model.system, frequency_hz).unwrap();
            let mut state = vec![0.01, -0.005, 0.02, 0.03];
            for _ in 0..4 {
                let (ours, other) = (exact.period(&state).unwrap(), plain.period(&state).unwrap());
                let off = distance(&model.system, &ours, &other);
                assert!(off < 1e-6, "{frequency_hz} Hz: {off:e}");
                state = ours;
            }
        }
    }
}

/// The column of the flow by the frequency against differences of the plain integrator, contacts included.
#[test]
fn sensitivity_to_the_frequency_is_that_of_the_plain_integrator() {
    for excitation in [FORCES, SHAKEN] {
        let text = format!("{PAIR}{excitation}");
        let model = model(&text);
        let equations = Equations::read(&text.parse().unwrap(), &model).unwrap();
        let state = [0.01, -0.005, 0.02, 0.03];
        for frequency_hz in [0.73, 1.6] {
            let settings = ExactSettings { tolerance: 1e-12 };
            let mut integrator = ExactIntegrator::new(model.system.clone(), settings).unwrap();
            let column = integrator
                .flow(&Stretch { frequency_hz, start: 0.0, end: 1.0 }, &state)
                .unwrap()
                .by_frequency;
            let step = 2e-4;
            let at = |frequency_hz: f64| {
                Simulator::plain(&equations, &model, frequency_hz).period(&state).unwrap()
            };
            let (low, high) = (at(frequency_hz - step), at(frequency_hz + step));
            let largest = column.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
            for i in 0..4 {
                let difference = (high[i] - low[i]) / (2.0 * step);
                // The plain one places touches to some 1e-8, and the step adds its square.
                assert!(
                    (column[i] - difference).abs() < 1e-3 * largest,
                    "{frequency_hz} Hz, entry {i}: {} {difference}",
                    column[i]
                );
            }
        }
    }
}
