//! `run --from`: branches begin at the attractors that basins and sweeps have met.

use serde_json::Value;

use super::document;
use crate::common::{COMPUTE, Workshop, assert_bad_input, assert_success};

/// `x'' + 0.02 x' + x + x^3 = 0.5 cos 2 pi f t`: at 0.6 Hz two harmonic attractors and one of three periods.
const STUDY: &str = r#"
    [structure]
    kind = "lumped"
    mass = [{ name = "m", mass_kg = 1.0 }]
    spring = [{ between = ["m", "ground"], stiffness_n_m = 1.0 }]
    damper = [{ between = ["m", "ground"], damping_n_s_m = 0.02 }]

    [excitation]
    kind = "force"
    at = "m"
    amplitude_n = 0.5
    frequency_hz = [0.55, 0.65]

    [[stop]]
    at = "m"
    law = "cubic"
    stiffness_n_m3 = 1.0

    [search]
    frequencies = 0

    [continuation]
    max_step_hz = 0.0005
"#;

fn basins(workshop: &Workshop) -> Vec<Value> {
    let cells = ["basins", "study.toml", "--frequency", "0.6", "--grid", "12", "--longest-period", "6"];
    let states = ["--x", "displacement=-5..5", "--y", "velocity=-8..8"];
    let kept = ["--out", "met", "--results", "results", "--json"];
    let document = document(workshop, &[&cells[..], &states, &kept].concat());
    document["attractors"].as_array().unwrap().clone()
}

fn on_no_branch(attractors: &[Value]) -> Vec<&Value> {
    attractors.iter().filter(|attractor| attractor["branch"].is_null()).collect()
}

#[test]
fn attractors_that_basins_have_met_are_followed_on_request() {
    let workshop = Workshop::with(STUDY);
    let run = |more: &[&str]| {
        let words = [&COMPUTE[..], &["--json"], more].concat();
        document(&workshop, &words)["branches"].as_array().unwrap().len()
    };
    assert_eq!(run(&[]), 1, "nothing is looked for but one harmonic branch");
    let before = basins(&workshop);
    assert_eq!(before.len(), 3);
    assert_eq!(on_no_branch(&before).len(), 2, "{before:?}");
    assert_eq!(run(&["--from", "met"]), 3);
    let after = basins(&workshop);
    assert!(on_no_branch(&after).is_empty(), "{after:?}");
    let bytes = workshop.csv("results");
    assert_eq!(run(&["--from", "met", "--from", "met"]), 3, "what is followed is not followed again");
    assert_eq!(run(&[]), 3);
    assert_eq!(workshop.csv("results"), bytes);
}

#[test]
fn attractors_that_a_sweep_has_met_are_followed_on_request() {
    let workshop = Workshop::with(STUDY);
    let at = ["--from", "0.56", "--to", "0.64", "--step", "0.04", "--starts", "40"];
    let words = [&["sweep", "study.toml", "--longest-period", "6", "--out", "met"], &at[..]].concat();
    assert_success(&workshop.hammerbeam(&words));
    assert_success(&workshop.compute(&["--from", "met"]));
    let words = [&words[..], &["--results", "results", "--json"]].concat();
    let motions = document(&workshop, &words)["motions"].as_array().unwrap().clone();
    let periodic = motions.iter().filter(|motion| motion["class"] == "periodic");
    let lost = periodic.filter(|motion| motion["branch"].is_null()).count();
    assert_eq!(lost, 0, "{motions:?}");
}

#[test]
fn a_folder_without_results_is_refused() {
    let workshop = Workshop::with(STUDY);
    assert_bad_input(&workshop.compute(&["--from", "nowhere"]), &["nowhere"]);
}
