//! `run --from RESULTS:POINT`: branches of a study with changed parameters begin at a special point of
//! another folder.

use serde_json::Value;

use crate::common::{Workshop, assert_bad_input, assert_success, stdout};

/// The impact oscillator where it has a closed branch, from 0.086 to 0.096 Hz, that no slow sweep reaches.
fn study() -> String {
    let study = include_str!("../../../studies/impact-oscillator.toml");
    study.replace("[0.08, 0.5]", "[0.085, 0.1]")
}

/// A search that does not find the closed branch.
const LITTLE: &str = "\n[search]\nfrequencies = 1\nstarts = 1\nsettling_periods = 8\ntrials = 0\n";

/// Number of the first flip among the special points: they are the rows of `events.csv`.
fn first_flip(workshop: &Workshop) -> usize {
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv", "--out", "tables"]));
    let table = std::fs::read_to_string(workshop.path("tables/events.csv")).unwrap();
    let event = |line: &str| line.split(',').nth(3).unwrap().to_owned();
    1 + table.lines().skip(1).position(|line| event(line).contains("flip")).unwrap()
}

fn branches(workshop: &Workshop, more: &[&str], out: &str) -> Vec<Value> {
    let output = workshop.hammerbeam(&[&["run", "changed.toml", "--json", "--out", out][..], more].concat());
    assert_success(&output);
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    document["branches"].as_array().unwrap().clone()
}

/// A ball that is a little softer at its impacts has the closed branch as well, a little elsewhere.
#[test]
fn a_run_with_a_changed_parameter_begins_at_a_special_point_of_another_run() {
    let workshop = Workshop::with(&study());
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
    let changed = study().replace("restitution = 0.8", "restitution = 0.795") + LITTLE;
    std::fs::write(workshop.path("changed.toml"), changed).unwrap();
    assert_eq!(branches(&workshop, &[], "without").len(), 1, "the search alone does not find it");
    let origin = format!("results:{}", first_flip(&workshop));
    let found = branches(&workshop, &["--from", &origin], "with");
    assert_eq!(found.len(), 2, "{found:?}");
    let missing = workshop.hammerbeam(&["run", "changed.toml", "--from", "results:1000", "--out", "other"]);
    assert_bad_input(&missing, &["results has no special point 1000", "numbered from 1"]);
}
