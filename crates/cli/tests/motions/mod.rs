//! The commands that follow motions: documents, tables, refusals, kills.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod basins;
mod closed;
mod coexisting;
mod ended;
mod exponents;
mod exported;
mod folders;
mod free;
mod initial;
mod kept;
mod met;
mod refused;
mod simulate;
mod sweep;

use std::fs;

use crate::common::{Workshop, assert_success, reported, stdout};
use serde_json::Value;

const DUFFING: &str = include_str!("../../../../studies/duffing.toml");

const IMPACT_OSCILLATOR: &str = include_str!("../../../../studies/impact-oscillator.toml");
/// The same with a stop of an impact-speed-dependent law and no gap.
fn remembering() -> String {
    let law = "law = \"flores\"\nstiffness_n_m15 = 1e3\nrestitution = 0.8\ngap_m = 0.0";
    IMPACT_OSCILLATOR.replace("law = \"rigid\"\nrestitution = 0.8\ngap_m = 1.0", law)
}

#[track_caller]
fn document(workshop: &Workshop, arguments: &[&str]) -> Value {
    let output = workshop.hammerbeam(arguments);
    assert_success(&output);
    assert_eq!(reported(&output), "", "nothing is reported without a terminal");
    serde_json::from_str(&stdout(&output)).expect("one JSON document")
}

fn table(workshop: &Workshop, path: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(workshop.path(path)).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn column(table: &[Vec<String>], name: &str) -> Vec<f64> {
    let index = table[0].iter().position(|column| column == name).unwrap();
    table[1..].iter().map(|row| row[index].parse().unwrap()).collect()
}
