//! `--set` and `--vary-set`: the same as if the file said so.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

use serde_json::Value;

use crate::common::{BEAM, Workshop, assert_bad_input, assert_success, short_study, stderr, stdout};

/// A mass that is driven below its resonance: one branch, at once.
const QUICK: &str = "frequency_hz = [0.05, 0.1]\n[search]\nfrequencies = 2\nstarts = 1\ntrials = 1\n\
                     unstable_starts = false\n[[stop]]\nat = \"m\"\nname = \"wall\"\nlaw = \"linear\"\n\
                     stiffness_n_m = 5.0\nside = \"above\"\ngap_m = 0.3\n";

#[test]
fn a_setting_is_read_as_if_the_file_said_so() {
    let changed = Workshop::changed(BEAM, "youngs_modulus_pa = 2.1e11", "youngs_modulus_pa = 2.0e11");
    let given = Workshop::with(BEAM);
    for command in [&["modes", "study.toml", "--json"][..], &["check", "study.toml", "--json"]] {
        let expected = changed.hammerbeam(command);
        assert_success(&expected);
        for setting in ["structure.youngs_modulus_pa=2.0e11", "structure.youngs_modulus=200 GPa"] {
            let found = given.hammerbeam(&[command, &["--set", setting]].concat());
            assert_success(&found);
            assert_eq!(stdout(&found), stdout(&expected), "{setting}");
        }
    }
}

#[test]
fn faults_of_a_setting_are_those_of_the_file_at_its_line() {
    let workshop = Workshop::with(BEAM);
    let line = BEAM[..BEAM.find("elements = ").unwrap()].matches('\n').count() + 1;
    let place = format!("study.toml:{line}:");
    let before = workshop.listing();
    let with = |setting: &str| workshop.hammerbeam(&["run", "study.toml", "--out", "r", "--set", setting]);
    assert_bad_input(&with("structure.elements=0"), &[&place, "`elements` is 0", "elements = 0"]);
    assert_bad_input(&with("structure.elemnts=9"), &["unknown key `elemnts`", "did you mean `elements`?"]);
    assert_bad_input(&with("structure.length=2 kg"), &["fits m"]);
    assert_bad_input(&with("structure.point.tip.at_m=0.1"), &["structure.point has no element \"tip\""]);
    assert_bad_input(&with("elements"), &["\"elements\" is no setting", "KEY=VALUE"]);
    assert_eq!(workshop.listing(), before, "something was written");
}

/// Each folder holds its study as it was run: the run goes on, and others are refused.
#[test]
fn a_family_is_run_into_a_folder_each() {
    let workshop = Workshop::driven_mass(QUICK);
    let family =
        ["run", "study.toml", "--out", "all", "--vary-set", "stop.wall.gap_m=0.2,30 cm", "--jobs", "1"];
    let whole = workshop.hammerbeam(&[&family[..], &["--json"]].concat());
    assert_success(&whole);
    let document: Value = serde_json::from_str(&stdout(&whole)).unwrap();
    let runs = document["runs"].as_array().unwrap();
    assert_eq!((runs.len(), &runs[0]["set"]["stop.wall.gap_m"]), (2, &Value::from("0.2")));
    let folders = ["all/stop.wall.gap_m=0.2", "all/stop.wall.gap_m=30_cm"];
    let tables: Vec<String> = folders.iter().map(|folder| workshop.csv(folder)).collect();
    assert_ne!(tables[0], tables[1]);
    // The second has the gap of the file, and its results.
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "plain", "--jobs", "1"]));
    assert_eq!(workshop.csv("plain"), tables[1]);
    let first = ["run", "study.toml", "--out", folders[0], "--jobs", "1"];
    assert_bad_input(&workshop.hammerbeam(&first), &["gap"]);
    assert_success(&workshop.hammerbeam(&[&first[..], &["--set", "stop.wall.gap=0.2 m"]].concat()));
    assert_eq!(workshop.csv(folders[0]), tables[0]);
}

#[test]
fn a_family_with_a_fault_runs_none() {
    let workshop = Workshop::driven_mass(QUICK);
    let before = workshop.listing();
    let refused =
        workshop.hammerbeam(&["run", "study.toml", "--out", "all", "--vary-set", "stop.1.gap_m=0.1,-1"]);
    assert_bad_input(&refused, &["`gap_m` is -1 m"]);
    let twice = workshop.hammerbeam(&["run", "study.toml", "--out", "all", "--vary-set", "stop.1.gap_m=1,1"]);
    assert_bad_input(&twice, &["two studies of the family"]);
    assert_eq!(workshop.listing(), before, "something was written");
}

#[test]
fn every_command_that_takes_a_study_takes_settings() {
    let workshop = Workshop::with(&short_study());
    for command in
        ["check", "modes", "run", "orbit", "simulate", "sweep", "lyapunov", "basins", "update", "rig"]
    {
        let help = workshop.hammerbeam(&[command, "--help"]);
        assert!(stdout(&help).contains("--set <KEY=VALUE>"), "{command}: {}", stderr(&help));
    }
    let without = workshop.hammerbeam(&["import", "K.mtx", "--out", "b", "--set", "structure.length_m=1"]);
    assert_bad_input(&without, &["no study is given"]);
    assert_success(&workshop.hammerbeam(&["import", "study.toml", "--out", "b", "--set", "title=other"]));
    assert!(fs::read_to_string(workshop.path("b/study.toml")).unwrap().contains("[structure]"));
}
