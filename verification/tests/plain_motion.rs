//! The integrator that shares nothing with the library is right itself: closed forms, and the library over a
//! few periods of every system of the surveys.
#![allow(clippy::unwrap_used, reason = "a test ends where its study is wrong")]

use std::f64::consts::TAU;

use hammerbeam_study::{Model, StudyFile};
use hammerbeam_verification::{
    attractors::{Random, Simulator, distance},
    plain::{Equations, PlainMotion},
};

const MASS: &str = r#"
    [structure]
    kind = "lumped"
    mass = [{ name = "mass", mass_kg = 2.0 }]
    spring = [{ between = ["mass", "ground"], stiffness_n_m = 50.0 }]
    [excitation]
    kind = "force"
    at = "mass"
    amplitude_n = 3.0
    frequency_hz = [0.5, 1.0]
"#;

fn equations(text: &str) -> Equations {
    equations_and_model(text).0
}

fn equations_and_model(text: &str) -> (Equations, Model) {
    let file = StudyFile::parse("study.toml", text.to_owned()).unwrap();
    let model = Model::build(&file).unwrap();
    (Equations::read(&text.parse().unwrap(), &model).unwrap(), model)
}

#[test]
fn a_mass_on_a_spring_moves_as_its_closed_form() {
    let (equations, frequency_hz) = (equations(MASS), 0.7);
    let (omega, shaken) = (5.0, TAU * frequency_hz);
    let forced = 3.0 / (50.0 - 2.0 * shaken * shaken);
    let state = PlainMotion::new(&equations, frequency_hz).period(&[0.1 + forced, 0.0]);
    let free = 0.1 * (omega / frequency_hz).cos();
    assert!((state[0] - free - forced).abs() < 1e-11, "{state:?}");
    assert!((state[1] + 0.1 * omega * (omega / frequency_hz).sin()).abs() < 1e-10, "{state:?}");
}

/// Between impacts at its rest position a mass takes half a period; each leaves 0.8 of its speed.
#[test]
fn a_rigid_stop_turns_the_speed_round() {
    let stop = "[[stop]]\nat = \"mass\"\nlaw = \"rigid\"\nrestitution = 0.8\nside = \"above\"\n";
    let text = MASS.replace("amplitude_n = 3.0", "amplitude_n = 1e-15") + stop;
    // Two and a half half-periods of the free vibration after the first impact.
    let frequency_hz = 1.0 / (2.5 * TAU / 10.0 + TAU / 20.0);
    let state = PlainMotion::new(&equations(&text), frequency_hz).period(&[-0.1, 0.0]);
    // After a quarter of a period the first impact, then two and a half times half a period: three impacts.
    assert!((state[0] + 0.1 * 0.8_f64.powi(3)).abs() < 1e-9, "{state:?}");
    assert!(state[1].abs() < 1e-8, "{state:?}");
}

#[test]
fn it_follows_the_systems_of_the_surveys_as_the_library_does() {
    for (name, text) in SYSTEMS {
        let file = StudyFile::parse(name, (*text).to_owned()).unwrap();
        let (equations, model) = equations_and_model(text);
        let [low, high] = file.study.excitation.range_hz();
        let frequency_hz = low + 0.37 * (high - low);
        let mut plain = Simulator::plain(&equations, &model, frequency_hz);
        let mut exact = Simulator::exact(&model.system, frequency_hz).unwrap();
        let (mut random, mut compared) = (Random::new(7), 0);
        while compared < 3 {
            let mut state: Vec<f64> =
                (0..2 * model.system.dof()).map(|_| 1e-4 * (random.part() - 0.5)).collect();
            if !plain.may_begin(&state) {
                continue;
            }
            compared += 1;
            // Far from impacts that one of them may miss: what settles is compared, not what is sensitive.
            for _ in 0..4 {
                let (ours, other) = (exact.period(&state).unwrap(), plain.period(&state).unwrap());
                let off = distance(&model.system, &ours, &other);
                assert!(off < 1e-5, "{name}: {off:e}");
                state = ours;
            }
        }
    }
}

macro_rules! systems {
    ($($name:literal)*) => {
        &[$(($name, include_str!(concat!("../studies/", $name, ".toml")))),*]
    };
}

const SYSTEMS: &[(&str, &str)] = systems! {
    "bouncing-mass" "gear-pair-with-backlash" "impact-pair" "mass-chain" "preloaded-joint" "snubber-with-loss"
    "switch" "symmetric-stops" "tube-in-a-hole" "five-attractors" "weakly-damped-beam"
};
