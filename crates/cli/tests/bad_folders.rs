//! Folders that a command cannot use: results of another study, version or program; places that are taken.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::{TWO_MASSES, Workshop, assert_bad_input, assert_success, short_run, stderr};

#[test]
fn results_folder_of_another_study() {
    let workshop = short_run();
    let study = std::fs::read_to_string(workshop.path("study.toml")).unwrap();
    std::fs::write(workshop.path("study.toml"), study.replace("mass_kg = 0.5", "mass_kg = 0.6")).unwrap();
    let before = workshop.listing();
    let output = workshop.hammerbeam(&["run", "study.toml", "--out", "results"]);
    assert_bad_input(
        &output,
        &["results holds the results of another study", "mass_kg: 0.5 there, 0.6 here"],
    );
    assert_eq!(workshop.listing(), before);
}

#[test]
fn results_folder_stays_valid_with_another_title_and_budget() {
    let workshop = short_run();
    let rows = workshop.csv("results");
    let study = std::fs::read_to_string(workshop.path("study.toml")).unwrap();
    let study = study
        .replace("title = \"Two", "title = \"2")
        .replace("[continuation]", "[continuation]\nbudget_solutions = 100000");
    assert!(study.contains("\"2") && study.contains("budget_solutions"));
    std::fs::write(workshop.path("study.toml"), study).unwrap();
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
    assert_eq!(workshop.csv("results"), rows);
}

#[test]
fn results_folder_that_someone_else_wrote() {
    let workshop = Workshop::with(TWO_MASSES);
    std::fs::create_dir(workshop.path("results")).unwrap();
    std::fs::write(workshop.path("results/results.db"), "not a database").unwrap();
    let before = workshop.listing();
    for arguments in
        [&["run", "study.toml", "--out", "results"][..], &["export", "results", "--format", "csv"]]
    {
        assert_bad_input(&workshop.hammerbeam(arguments), &["was not written by hammerbeam"]);
    }
    assert_eq!(workshop.listing(), before);
}

#[test]
fn export_of_a_folder_without_results() {
    let workshop = Workshop::with(TWO_MASSES);
    let before = workshop.listing();
    let output = workshop.hammerbeam(&["export", "results", "--format", "csv"]);
    assert_bad_input(&output, &["there are no results in results"]);
    assert_eq!(workshop.listing(), before);
}

#[test]
fn export_into_a_place_that_is_a_file_says_why_once() {
    let workshop = short_run();
    let output = workshop.hammerbeam(&["export", "results", "--format", "csv", "--out", "study.toml"]);
    assert_bad_input(&output, &["cannot write study.toml"]);
    let message = stderr(&output);
    assert_eq!(message.matches("os error").count(), 1, "{message}");
}

#[test]
fn new_does_not_overwrite_a_study() {
    let workshop = Workshop::with("mine");
    let before = workshop.listing();
    assert_bad_input(&workshop.hammerbeam(&["new", "."]), &["already there and is not overwritten"]);
    assert_eq!(workshop.listing(), before);
}

#[test]
fn folders_that_cannot_be_made_are_bad_input() {
    let workshop = Workshop::with(TWO_MASSES);
    // A file where a folder should be: nobody, not even root, can write below it.
    let below = "study.toml/below";
    for arguments in [&["new", below][..], &["run", "study.toml", "--out", below]] {
        assert_bad_input(&workshop.hammerbeam(arguments), &["below"]);
    }
}

#[test]
fn results_folder_of_another_version() {
    let workshop = short_run();
    let connection = crate::common::database(workshop.path("results/results.db"));
    connection.execute("UPDATE about SET value = '0' WHERE key = 'data_version'", []).unwrap();
    connection.close().unwrap();
    let before = workshop.listing();
    for arguments in [
        &["run", "study.toml", "--out", "results"][..],
        &["export", "results", "--format", "csv"],
        &["verify", "results"],
    ] {
        assert_bad_input(&workshop.hammerbeam(arguments), &["data version 0"]);
    }
    assert_eq!(workshop.listing(), before, "something was written");
}
