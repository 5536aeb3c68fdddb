//! `hammerbeam update`: what it gives, what it writes, and how it ends where there is nothing to give.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

use crate::common::{TWO_MASSES, Workshop, assert_bad_input, assert_success, stderr, stdout};
use serde_json::Value;

/// The eigenfrequencies of the two masses as they are, and the two springs, which start elsewhere.
const SPRINGS: &str = "\
title = \"springs\"
[[parameter]]
key = \"structure.spring.1.stiffness_n_m\"
start = 900.0
[[parameter]]
key = \"structure.spring.2.stiffness_n_m\"
start = 600.0
";

/// A workshop with the data of the two masses, from its own eigenfrequencies.
fn workshop() -> Workshop {
    let workshop = Workshop::with(TWO_MASSES);
    let modes = workshop.hammerbeam(&["modes", "study.toml", "--json"]);
    let modes: Value = serde_json::from_str(&stdout(&modes)).unwrap();
    let data = format!(
        "{SPRINGS}[[eigenfrequency]]\nmode = [1, 2]\nhz = [{}, {}]\ndeviation_relative = 0.001\n",
        modes["clamped_hz"][0], modes["clamped_hz"][1]
    );
    fs::write(workshop.path("data.toml"), data).unwrap();
    workshop
}

#[test]
fn springs_are_found_and_the_study_is_written_with_them() {
    let workshop = workshop();
    let output = workshop.hammerbeam(&["update", "study.toml", "data.toml", "--out", "updated", "--json"]);
    assert_success(&output);
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    for parameter in document["parameters"].as_array().unwrap() {
        let (value, truth) = (parameter["value"].as_f64().unwrap(), parameter["in_study"].as_f64().unwrap());
        // Standard errors are about 2e-3.
        assert!((value / truth - 1.0).abs() < 1e-6, "{parameter}");
        assert_eq!(parameter["interval"].as_array().unwrap().len(), 2);
    }
    assert_eq!(document["degrees_of_freedom"], 0);
    assert!(document["chi_squared_probability"].is_null());
    // Each mass stands on its own spring, so which frequency is whose is open: 4000 and 500 N/m, for 1 and
    // 0.5 kg, give the same two.
    assert!(
        stderr(&output)
            .contains("other values fit about as well: structure.spring.1.stiffness_n_m = 4.000000e3"),
        "{}",
        stderr(&output)
    );
    assert!(stderr(&output).contains("warning: there are as many parameters as data"), "{}", stderr(&output));
    let written = fs::read_to_string(workshop.path("updated/updated.toml")).unwrap();
    assert_eq!(written.lines().count(), TWO_MASSES.lines().count());
    assert_success(&workshop.hammerbeam(&["check", "updated/updated.toml"]));
    let kept: Value =
        serde_json::from_str(&fs::read_to_string(workshop.path("updated/update.json")).unwrap()).unwrap();
    assert_eq!(kept, document);
    let text = workshop.hammerbeam(&["update", "study.toml", "data.toml", "--profile", "--confidence", "90"]);
    assert_success(&text);
    for part in ["springs: 2 parameters, 2 data", "90 % interval", "; profile ", "correlation", "clamped 2"] {
        assert!(stdout(&text).contains(part), "{part} is missing in\n{}", stdout(&text));
    }
}

#[test]
fn an_input_is_not_overwritten() {
    let workshop = workshop();
    fs::copy(workshop.path("study.toml"), workshop.path("updated.toml")).unwrap();
    let before = workshop.listing();
    let output = workshop.hammerbeam(&["update", "updated.toml", "data.toml", "--out", "."]);
    assert_bad_input(&output, &["is an input of this update and is not overwritten"]);
    assert_eq!(workshop.listing(), before, "something was written");
}

#[test]
fn bad_data_files_are_bad_input_and_nothing_is_written() {
    let workshop = workshop();
    let good = fs::read_to_string(workshop.path("data.toml")).unwrap();
    for (old, new, parts) in [
        ("start = 900.0", "begin = 900.0", ["data.toml:4:1", "unknown key `begin`"]),
        ("mode = [1, 2]", "mode = [1, 3]", ["data.toml:9:8", "mode 3 was measured"]),
        ("spring.1", "spring.3", ["data.toml:3:7", "is not a number in the text of the study"]),
        ("deviation_relative = 0.001", "", ["data.toml:8:1", "the standard deviation is missing"]),
    ] {
        assert!(good.contains(old), "{old}");
        fs::write(workshop.path("data.toml"), good.replacen(old, new, 1)).unwrap();
        let before = workshop.listing();
        assert_bad_input(
            &workshop.hammerbeam(&["update", "study.toml", "data.toml", "--out", "updated"]),
            &parts,
        );
        assert_eq!(workshop.listing(), before, "something was written");
    }
    assert_bad_input(
        &workshop.hammerbeam(&["update", "study.toml", "nowhere.toml"]),
        &["cannot read the data nowhere.toml"],
    );
    assert_bad_input(
        &workshop.hammerbeam(&["update", "study.toml", "data.toml", "--confidence", "100"]),
        &["percent"],
    );
}

/// The stop is measured at a frequency and a period at which nothing responds.
#[test]
fn a_response_that_is_not_there_is_no_result() {
    let workshop = workshop();
    let data = "[[parameter]]\nkey = \"stop.1.gap_m\"\n[[periodic_response]]\nfrequency_hz = \
    3.0\nperiod_multiple = 7\nmax_abs_displacement_m = 0.001\ndeviation_relative = 0.1\n";
    fs::write(workshop.path("data.toml"), data).unwrap();
    let output = workshop.hammerbeam(&["update", "study.toml", "data.toml", "--json", "--out", "updated"]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert!(
        document["error"]["message"].as_str().unwrap().contains("no stable periodic response"),
        "{document}"
    );
    assert!(!workshop.path("updated").exists());
}
