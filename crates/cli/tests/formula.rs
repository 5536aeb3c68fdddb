//! A force given as a formula: from the study file to verified branches, on any number of threads; and what
//! is no formula.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

use crate::common::{COMPUTE, Workshop, assert_bad_input, assert_success, extensive, stderr, stdout};
use serde_json::Value;

const VAN_DER_POL: &str = include_str!("../../../studies/van-der-pol.toml");
/// The example without searches, with a short one if whole sets are asked for: what it finds is one branch
/// either way.
fn quick() -> String {
    let search = "frequencies = 4\nstarts = 4\ntrials = 20";
    assert!(VAN_DER_POL.contains(search));
    let shorter = if extensive() { "frequencies = 2\nstarts = 2\ntrials = 1" } else { "frequencies = 0" };
    VAN_DER_POL.replace(search, shorter)
}

const FORMULA: &str = "\"mu*(x^2 - 1)*v\"";

/// The study with another formula and other constants.
fn with(formula: &str, constants: &str) -> Workshop {
    let changed = quick().replace(FORMULA, formula);
    Workshop::with(&changed.replace("constants = { mu = 0.3 }", constants))
}

fn document(workshop: &Workshop, arguments: &[&str]) -> Value {
    let output = workshop.hammerbeam(arguments);
    assert_success(&output);
    serde_json::from_str(&stdout(&output)).unwrap()
}

/// The locked oscillator over its range and over its constant: one branch that is its own mirror image; the
/// same bytes from one and two threads (over the constant if whole sets are asked for), and no solution on
/// which the general integrator disagrees.
#[test]
fn the_example_is_followed_and_verified() {
    let vary = "[[vary]]\nparameter = \"stop.damper.constants.mu\"\nrange = [0.25, 0.35]\n\
        frequency_hz = 0.16\nsteps = 50\n";
    let whole = format!("{}\n{vary}", quick());
    let run = |study: &str, jobs: &str| {
        let workshop = Workshop::with(study);
        let run = document(&workshop, &[&COMPUTE[..], &["--jobs", jobs, "--json"]].concat());
        let branches = run["branches"].as_array().unwrap();
        assert_eq!(branches.len(), 1, "{run}");
        assert_eq!(branches[0]["mirror_image"], branches[0]["branch"], "{run}");
        assert_eq!(run["undamped_modes"].as_array().map(Vec::len), Some(0), "{run}");
        workshop
    };
    let (one, two) = (run(&whole, "1"), run(&if extensive() { whole.clone() } else { quick() }, "2"));
    let verify = document(&one, &["verify", "results", "--all", "--json"]);
    assert_eq!(verify["agree"], true, "{verify}");
    let tables = [&one, &two].map(|workshop| {
        let branches = workshop.csv("results");
        (branches, fs::read_to_string(workshop.path("exported/parameter_branches.csv")).ok())
    });
    assert!(tables[0].0 == tables[1].0);
    let varied = tables[0].1.as_ref().unwrap();
    assert!(!extensive() || tables[1].1.as_ref() == Some(varied));
    assert!([&tables[0].0, varied].iter().all(|table| table.lines().count() > 20), "{tables:?}");
}

#[test]
fn another_formula_or_constant_is_another_study() {
    let workshop = with(FORMULA, "constants = { mu = 0.3 }");
    assert_success(&workshop.compute(&["--jobs", "1"]));
    for (old, new) in [("mu = 0.3 }", "mu = 0.4 }"), ("x^2 - 1)*v", "x^2 - 1)*v^3")] {
        let other = quick().replace(old, new);
        assert_ne!(other, quick());
        fs::write(workshop.path("other.toml"), other).unwrap();
        let output = workshop.hammerbeam(&["run", "other.toml", "--out", "results", "--no-figures"]);
        assert!(!output.status.success() && stderr(&output).contains("stop"), "{}", stderr(&output));
    }
}

#[test]
fn check_shows_the_formula_and_what_it_acts_against() {
    let output = with(FORMULA, "constants = { mu = 0.3 }").hammerbeam(&["check", "study.toml"]);
    assert_success(&output);
    assert!(stdout(&output).contains("force mu*(x^2 - 1)*v N against x"), "{}", stdout(&output));
    assert!(!stdout(&output).contains("has no damping"), "{}", stdout(&output));
}

#[test]
fn what_is_no_formula_is_refused_with_its_place_and_help() {
    let deep = format!("\"{}x{}\"", "(".repeat(400), ")".repeat(400));
    let cases: [(&str, &str, &[&str]); 14] = [
        ("\"mu*(x^2 - 1)*w\"", "constants = { mu = 0.3 }", &["`w` at character 14", "allowed: x, v, pi, mu"]),
        ("\"mu*x*sinn(v)\"", "constants = { mu = 0.3 }", &["`sinn` at character 6", "did you mean `sin`?"]),
        ("\"(x\"", "", &["`(` at character 1 is not closed"]),
        ("\"\"", "", &["the formula is empty"]),
        ("\"µ*x\"", "", &["`µ` at character 1"]),
        ("\"3*pi\"", "", &["neither `x` nor `v`", "load of order 0"]),
        ("\"ln(x)\"", "", &["is inf at rest"]),
        ("\"x*mu\"", "constants = { mu = 0.3, nu = 1.0 }", &["the constant `nu` is not in the formula"]),
        (
            "\"x*v\"",
            "constants = { v = 0.3 }",
            &["`v` cannot be the name of a constant", "taken: x, v, pi, sin"],
        ),
        ("\"x*mu\"", "constants = { mu = \"0.3\" }", &["`mu` must be a number"]),
        ("\"x*mu\"", "constants = 3", &["`constants` must be a table"]),
        ("3.0", "", &["`formula` must be a string"]),
        ("\"x\"", "stiffness_n_m = 3.0", &["unknown key `stiffness_n_m`", "formula, constants"]),
        (&deep, "", &["more than 50 parentheses within one another at character 51"]),
    ];
    for (formula, constants, parts) in cases {
        let workshop = with(formula, constants);
        let before = workshop.listing();
        for arguments in [&["check", "study.toml"][..], &COMPUTE] {
            assert_bad_input(&workshop.hammerbeam(arguments), &[&["stop[0]"], parts].concat());
        }
        assert_eq!(workshop.listing(), before);
    }
    let long = with(&format!("\"x{}\"", "+x".repeat(9000)), "").hammerbeam(&["check", "study.toml"]);
    assert_bad_input(&long, &["`formula` is 18001 bytes long"]);
    let hidden = with("\"x\"", "constants = { \"\\u001b[31m\" = 1.0 }").hammerbeam(&["check", "study.toml"]);
    assert_bad_input(&hidden, &["cannot be the name of a constant"]);
    assert!(!stderr(&hidden).contains('\u{1b}'), "{:?}", stderr(&hidden));
}

/// A motion that comes to where the force has no value ends there, with the time and exit code 1.
#[test]
fn a_motion_ends_where_the_force_has_no_value() {
    let workshop = with("\"0.1*v + ln(x + 1.5)\"", "");
    let output = workshop.hammerbeam(&["simulate", "study.toml", "--frequency", "0.16", "--periods", "50"]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(stderr(&output).contains("s after the start of the stretch"), "{}", stderr(&output));
}
