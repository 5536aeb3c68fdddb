//! The command that draws: everything that a folder holds, always the same bytes, and clear refusals.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use std::fs;

use common::{Workshop, assert_bad_input, assert_success, stderr, stdout};
use serde_json::Value;

const DUFFING: &str = include_str!("../../../studies/duffing.toml");

/// A folder with two sweeps, exponents and basins, without branches.
fn motions() -> Workshop {
    let workshop = Workshop::with(DUFFING);
    let sweep = ["--from", "0.2", "--to", "0.3", "--step", "0.02", "--down"];
    let basins = ["--frequency", "0.25", "--x", "q1=-4..4", "--y", "v1=-5..5", "--grid", "6"];
    let commands: [&[&str]; 3] = [
        &[&["sweep"][..], &sweep].concat(),
        &["lyapunov", "--frequency", "0.24", "--to", "0.26", "--step", "0.01", "--periods", "60"],
        &[&["basins"][..], &basins].concat(),
    ];
    for command in commands {
        let arguments = [&command[..1], &["study.toml"], &command[1..], &["--out", "results"]].concat();
        assert_success(&workshop.hammerbeam(&arguments));
    }
    workshop
}

fn files(workshop: &Workshop, arguments: &[&str]) -> Vec<String> {
    let output = workshop.hammerbeam(&[&["figure", "results", "--json"][..], arguments].concat());
    assert_success(&output);
    let document: Value = serde_json::from_str(&stdout(&output)).expect("one JSON document");
    assert_eq!(document["not_drawn"].as_array().unwrap().len(), 0, "{}", stderr(&output));
    document["files"].as_array().unwrap().iter().map(|name| name.as_str().unwrap().to_owned()).collect()
}

#[test]
fn everything_in_a_folder_is_drawn_and_twice_the_same() {
    let workshop = motions();
    let first = files(&workshop, &["--out", "first"]);
    for name in ["sweep-1.svg", "exponents-2.png", "convergence-2-1.svg", "section-2-3.png", "basins-3.svg"] {
        assert!(first.iter().any(|file| file == name), "{name} is not among {first:?}");
    }
    assert!(!first.iter().any(|file| file.starts_with("response") || file.starts_with("multipliers")));
    assert_eq!(files(&workshop, &["--out", "second"]), first);
    for name in &first {
        let read = |folder: &str| fs::read(workshop.path(folder).join(name)).unwrap();
        assert!(read("first") == read("second"), "{name} differs");
    }
    let map = fs::read_to_string(workshop.path("first/basins-3.svg")).unwrap();
    assert!(map.contains("1: period 1, ") && map.contains("2: period 1, "), "both motions of the oscillator");
    assert_eq!(files(&workshop, &["--kind", "basins", "--out", "third"]), ["basins-3.svg", "basins-3.png"]);
}

#[test]
fn what_is_not_there_is_refused_with_a_sentence() {
    let workshop = motions();
    let output = workshop.hammerbeam(&["figure", "results", "--kind", "multipliers"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("results holds nothing of what was asked for to draw"),
        "{}",
        stderr(&output)
    );
    assert_bad_input(&workshop.hammerbeam(&["figure", "nowhere"]), &["there are no results in nowhere"]);
}

#[test]
fn the_error_of_the_reduction_is_drawn_and_that_of_no_reduction_refused() {
    let beam = Workshop::with(common::BEAM);
    assert_success(&beam.hammerbeam(&["modes", "study.toml", "--out", "drawn"]));
    let svg = fs::read_to_string(beam.path("drawn/reduction.svg")).unwrap();
    assert!(svg.contains("up to the cut-off") && svg.contains("above the cut-off"));
    let lumped = Workshop::with(DUFFING);
    let output = lumped.hammerbeam(&["modes", "study.toml", "--out", "drawn"]);
    assert_success(&output);
    assert!(stderr(&output).contains("reduction: nothing to draw: no finite error"), "{}", stderr(&output));
}

#[test]
fn an_orbit_is_drawn_with_the_force_of_its_stop() {
    let workshop = Workshop::with(common::BEAM);
    let output =
        workshop.hammerbeam(&["orbit", "study.toml", "--frequency", "30", "--out", "drawn", "--json"]);
    assert_success(&output);
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(document["figures"].as_array().unwrap().len() % 6, 0);
    let history = fs::read_to_string(workshop.path("drawn/orbit-1-history.svg")).unwrap();
    for label in
        ["Displ. (mm)", "Accel. (m/s²)", "Local force (N)", "Support (mm)", "30 Hz, period 1, stable"]
    {
        assert!(history.contains(label), "{label}");
    }
    assert!(workshop.path("drawn/orbit-1-spectrum.png").is_file());
}
