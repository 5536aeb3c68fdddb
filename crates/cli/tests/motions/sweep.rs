//! `sweep`: hysteresis, and diagrams from many starts.

use serde_json::Value;

use super::{DUFFING, document, table};
use crate::common::{Workshop, assert_success};

/// The hardening spring between its folds: two motions, each of which is found on its branch.
#[test]
fn sweep_shows_hysteresis_and_names_the_branch() {
    let workshop = Workshop::with(DUFFING);
    assert_success(&workshop.compute(&[]));
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

/// An orbit of two periods that is in contact at phase 0 of one of them, with an impact-speed-dependent
/// law: whichever of the two its motion comes to, its branch is named.
#[test]
fn sweep_names_the_branch_of_a_subharmonic_motion_within_a_contact() {
    let workshop = Workshop::driven_mass(
        r#"
        frequency_hz = [0.136, 0.144]
        [[stop]]
        at = "m"
        side = "above"
        gap_m = 0.6
        law = "lee-wang"
        stiffness_n_m15 = 40.0
        restitution = 0.6
        [response]
        period_multiples = [2]
        [search]
        frequencies = 2
        [continuation]
        budget_solutions = 1500
        "#,
    );
    assert_success(&workshop.compute(&[]));
    let sweep = ["sweep", "study.toml", "--from", "0.14", "--to", "0.14", "--results", "results", "--json"];
    let of = |initial: &str| {
        let found = document(&workshop, &[&sweep[..], &["--initial", initial]].concat());
        let motion = found["motions"][0].clone();
        assert_eq!(motion["period"], 2, "{motion}");
        assert!(motion["branch"].is_u64(), "{initial}: {motion}");
        motion["sampled_displacements_m"][0].as_f64().unwrap()
    };
    // One ends in the contact, the other in front of it, one period later: both cases are there.
    let ends = [of("0,0"), of("0.1,0.1")];
    assert!(ends[0].max(ends[1]) > 0.6 && ends[0].min(ends[1]) < 0.6, "{ends:?}");
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
