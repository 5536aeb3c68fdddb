//! `--json`: one document on standard output with the keys that scripts rely on, and nothing else.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::{BEAM, TWO_MASSES, Workshop, assert_success, short_study, stdout};
use serde_json::Value;

#[track_caller]
fn document(workshop: &Workshop, arguments: &[&str]) -> Value {
    let output = workshop.hammerbeam(arguments);
    assert_success(&output);
    serde_json::from_str(&stdout(&output)).expect("one JSON document")
}

#[test]
fn modes_of_a_beam_have_three_tables_with_exact_zeros() {
    let document = document(&Workshop::with(BEAM), &["modes", "study.toml", "--json"]);
    let table = |key: &str| -> Vec<f64> {
        document[key].as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
    };
    assert_eq!(table("reduced_hz").len(), 6);
    assert_eq!(table("free_interface_hz")[0], 0.0);
    assert!((table("clamped_hz")[0] - 17.495).abs() < 1e-3);
}

#[test]
fn modes_of_lumped_masses_have_one_table() {
    let document = document(&Workshop::with(TWO_MASSES), &["modes", "study.toml", "--json"]);
    assert_eq!(document["clamped_hz"].as_array().unwrap().len(), 2);
    assert_eq!(document["free_interface_hz"].as_array().unwrap().len(), 0);
    assert_eq!(document["reduced_hz"].as_array().unwrap().len(), 0);
}

#[test]
fn orbit_has_all_its_keys_and_its_coexisting_ones() {
    let study = include_str!("../../../studies/duffing.toml");
    let workshop = Workshop::changed(study, "[0.08, 0.5]", "[0.2, 0.3]");
    let document = document(&workshop, &["orbit", "study.toml", "--frequency", "0.25", "--json"]);
    let others = document["others"].as_array().unwrap();
    assert_eq!(others.len(), 2, "between the folds three solutions coexist");
    let displacement = |value: &Value| value["max_abs_displacement_m"].as_f64().unwrap();
    for solution in std::iter::once(&document).chain(others) {
        for key in [
            "frequency_hz",
            "period_multiple",
            "max_abs_displacement_m",
            "max_abs_acceleration_m_s2",
            "max_contact_force_n",
            "max_impact_velocity_m_s",
            "contacts",
            "residual",
        ] {
            assert!(solution[key].is_number(), "{key} is {}", solution[key]);
        }
        assert_eq!(solution["floquet_multipliers"].as_array().unwrap().len(), 2);
        assert!(solution["stable"].is_boolean());
    }
    let stable = |value: &Value| value["stable"].as_bool().unwrap();
    assert!(stable(&document) && stable(&others[0]) && !stable(&others[1]));
    assert!(displacement(&document) > displacement(&others[0]));
}

#[test]
fn no_orbit_is_exit_code_1_with_the_reason() {
    let study = include_str!("../../../studies/bilinear-oscillator.toml");
    let workshop = Workshop::changed(study, "[0.05, 0.4]", "[0.05, 0.06]");
    let arguments = ["orbit", "study.toml", "--frequency", "0.05", "--period-multiple", "3", "--json"];
    let output = workshop.hammerbeam(&arguments);
    assert_eq!(output.status.code(), Some(1));
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(document["error"]["exit_code"], 1);
}

#[test]
fn faults_of_a_study_have_line_column_and_key() {
    let workshop = Workshop::changed(BEAM, "youngs_modulus_pa = 2.1e11", "youngs_modulus_pa = 210");
    let output = workshop.hammerbeam(&["check", "study.toml", "--json"]);
    assert_eq!(output.status.code(), Some(2));
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let problem = &document["error"]["problems"][0];
    assert_eq!((&problem["line"], &problem["column"]), (&15.into(), &21.into()));
    assert_eq!(problem["key"], "structure.youngs_modulus_pa");
}

#[test]
fn run_and_export_say_what_they_made() {
    let workshop = Workshop::with(&short_study());
    let run = document(&workshop, &["run", "study.toml", "--out", "results", "--json"]);
    let branch = &run["branches"][0];
    assert_eq!(branch["up"]["stop_reason"], "range-end");
    assert_eq!(branch["down"]["stop_frequency_hz"], 13.5);
    let export = document(&workshop, &["export", "results", "--format", "csv", "--json"]);
    assert_eq!(export["rows"], run["solutions"]);
    assert!(workshop.path("results/export/branches.csv").is_file());
}

#[test]
fn check_and_new_give_documents_too() {
    let workshop = Workshop::with(BEAM);
    let check = document(&workshop, &["check", "study.toml", "--json"]);
    assert_eq!(check["degrees_of_freedom"], 6);
    assert_eq!(check["stops"][0], "stop 1");
    assert_eq!(document(&workshop, &["new", "fresh", "--json"])["study"], "fresh/study.toml");
}
