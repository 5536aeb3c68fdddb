//! `basins`: fractions against branches, several requests in one folder.

use std::fs;

use super::{DUFFING, document, table};
use crate::common::{Workshop, assert_bad_input, assert_success};

pub const BASINS: [&str; 11] = [
    "basins",
    "study.toml",
    "--frequency",
    "0.25",
    "--x",
    "q1=-2..2",
    "--y",
    "v1=-3..3",
    "--grid",
    "60",
    "--out",
];

#[test]
fn basins_match_the_branches_of_their_folder() {
    let workshop = Workshop::with(DUFFING);
    assert_success(&workshop.compute(&[]));
    let arguments: Vec<&str> = BASINS.iter().map(|word| if *word == "60" { "12" } else { word }).collect();
    let document = document(&workshop, &[&arguments[..], &["results", "--json"]].concat());
    let attractors = document["attractors"].as_array().unwrap();
    assert_eq!(attractors.len(), 2);
    let mut sum = 0.0;
    for attractor in attractors {
        assert_eq!((&attractor["class"], &attractor["branch"]), (&"periodic".into(), &1.into()));
        let fraction = attractor["fraction"].as_f64().unwrap();
        let error = (fraction * (1.0 - fraction) / 144.0).sqrt();
        assert!((attractor["standard_error"].as_f64().unwrap() - error).abs() < 1e-12);
        sum += fraction;
    }
    assert!((sum - 1.0).abs() < 1e-12);
    assert_eq!(table(&workshop, "results/basins.csv").len(), 145);
    // A folder of branches stays one.
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
}

#[test]
fn a_folder_keeps_several_requests_and_refuses_those_of_another_study() {
    let workshop = Workshop::with(DUFFING);
    let of_size = |cells: &str| -> Vec<String> {
        let words = BASINS.iter().map(|word| if *word == "60" { cells } else { word });
        words.chain(["out"]).map(str::to_owned).collect()
    };
    let basins = |cells: &str| {
        let words = of_size(cells);
        workshop.hammerbeam(&words.iter().map(String::as_str).collect::<Vec<_>>())
    };
    assert_success(&basins("3"));
    assert_success(&basins("4"));
    assert_success(&workshop.hammerbeam(&["sweep", "study.toml", "--step", "0.1", "--out", "out"]));
    assert_success(&workshop.hammerbeam(&["export", "out", "--format", "csv"]));
    assert_eq!(table(&workshop, "out/export/basins-1.csv").len(), 10);
    assert_eq!(table(&workshop, "out/export/basins-2.csv").len(), 17);
    let read = |name: &str| fs::read(workshop.path(name)).unwrap();
    assert!(read("out/export/basins-2.csv") == read("out/basins.csv"));
    assert!(read("out/export/sweep-3.csv") == read("out/sweep.csv"));
    let before = workshop.listing();
    let changed = DUFFING.replace("amplitude_n = 0.3", "amplitude_n = 0.4");
    fs::write(workshop.path("study.toml"), changed).unwrap();
    assert_bad_input(
        &basins("3"),
        &["out holds the results of another study", "amplitude_n: 0.3 there, 0.4 here"],
    );
    fs::write(workshop.path("study.toml"), DUFFING).unwrap();
    assert_eq!(workshop.listing(), before);
    fs::create_dir(workshop.path("mine")).unwrap();
    fs::write(workshop.path("mine/results.db"), "not a database").unwrap();
    let before = workshop.listing();
    let mine = [&BASINS[..], &["mine"]].concat();
    assert_bad_input(&workshop.hammerbeam(&mine), &["results.db was not written by hammerbeam"]);
    assert_eq!(workshop.listing(), before, "something was written");
}
