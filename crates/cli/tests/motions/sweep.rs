//! `sweep`: hysteresis, and diagrams from many starts.

use serde_json::Value;

use crate::{
    DUFFING,
    common::{Workshop, assert_success},
    document, table,
};

/// The hardening spring between its folds: two motions, each of which is found on its branch.
#[test]
fn sweep_shows_hysteresis_and_names_the_branch() {
    let workshop = Workshop::with(DUFFING);
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
    let range = ["sweep", "study.toml", "--from", "0.15", "--to", "0.35", "--step", "0.02"];
    let more = ["--down", "--results", "results", "--out", "out", "--json"];
    let document = document(&workshop, &[&range[..], &more].concat());
    let motions = document["motions"].as_array().unwrap();
    assert_eq!(motions.len(), 22);
    let at = |from: &str| {
        let found = motions.iter().find(|motion| {
            motion["from"] == from && (motion["frequency_hz"].as_f64().unwrap() - 0.25).abs() < 1e-9
        });
        found.unwrap()["max_abs_displacement_m"].as_f64().unwrap()
    };
    assert!(at("up") > 2.0 * at("down"), "{} {}", at("up"), at("down"));
    assert!(motions.iter().all(|motion| motion["class"] == "periodic" && motion["branch"] == 1));
    assert_eq!(table(&workshop, "out/sweep.csv").len(), 23);
    assert_eq!(table(&workshop, "out/sweep_samples.csv").len(), 23);
}

#[test]
fn diagram_from_many_starts_finds_both_motions_whatever_the_threads() {
    let workshop = Workshop::with(DUFFING);
    let range = [
        "sweep",
        "study.toml",
        "--from",
        "0.25",
        "--to",
        "0.26",
        "--step",
        "0.01",
        "--starts",
        "8",
        "--json",
    ];
    let of = |jobs| document(&workshop, &[&range[..], &["--jobs", jobs]].concat());
    let (one, three) = (of("1"), of("3"));
    assert_eq!(one, three);
    let motions = one["motions"].as_array().unwrap();
    assert_eq!(motions.len(), 16);
    let displacement = |motion: &Value| motion["max_abs_displacement_m"].as_f64().unwrap();
    let largest = motions.iter().map(displacement).fold(0.0, f64::max);
    let smallest = motions.iter().map(displacement).fold(f64::INFINITY, f64::min);
    assert!(largest > 2.0 * smallest);
}
