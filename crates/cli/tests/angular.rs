//! `--angular`: texts and figures have rad/s, documents and tables hertz.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{f64::consts::TAU, fs};

use crate::common::{Workshop, assert_success, stdout};

const RANGE: &str = "frequency_hz = [\"0.9 rad/s\", \"1.1 rad/s\"]\n[search]\nfrequencies = 1\nstarts = 1\n\
    [continuation]\nmax_step_hz = 0.01\n";

/// The driven mass has the eigenfrequency 1 rad/s.
#[test]
fn texts_have_the_frequencies_that_were_given_in_rad_per_second() {
    let workshop = Workshop::driven_mass(&RANGE.replace("frequency_hz", "frequency"));
    let text = |arguments: &[&str]| {
        let output = workshop.hammerbeam(arguments);
        assert_success(&output);
        stdout(&output)
    };
    let orbit = ["orbit", "study.toml", "--frequency", "1.05 rad/s"];
    assert!(
        text(&[&orbit[..], &["--angular"]].concat()).contains("\n1.05 rad/s, period of 1 excitation period")
    );
    // To nine digits, as texts have all frequencies; the document has all of them.
    assert!(text(&orbit).contains("\n0.16711269 Hz, period of 1 excitation period"));
    let document: serde_json::Value =
        serde_json::from_str(&text(&[&orbit[..], &["--angular", "--json"]].concat())).unwrap();
    assert_eq!(document["frequency_hz"], 1.05 / TAU);
    let check = text(&["check", "study.toml", "--angular"]);
    for part in ["modes        1 rad/s", "0.9 rad/s to 1.1 rad/s, order 1"] {
        assert!(check.contains(part), "{part} is missing in\n{check}");
    }
    let modes = text(&["--angular", "modes", "study.toml"]);
    assert!(modes.contains("Eigenfrequencies in rad/s") && modes.contains(" 1.000000 "), "{modes}");
    let simulate = ["simulate", "study.toml", "--frequency", "1.05 rad/s", "--angular"];
    assert!(text(&simulate).starts_with("10 periods at 1.05 rad/s, "));
}

#[test]
fn figures_have_rad_per_second_and_tables_stay_the_same() {
    let workshop = Workshop::driven_mass(&RANGE.replace("frequency_hz", "frequency"));
    let run = |folder: &str, flag: &[&str]| {
        let run = ["run", "study.toml", "--out", folder, "--jobs", "1"];
        let output = workshop.hammerbeam(&[&run[..], flag].concat());
        assert_success(&output);
        (stdout(&output), workshop.csv(folder))
    };
    let ((hertz, table), (angular, same)) = (run("hertz", &[]), run("angular", &["--angular"]));
    assert_eq!(table, same);
    for part in ["0.900000 to 1.100000 rad/s", "peak at 0.9997 rad/s"] {
        assert!(angular.contains(part), "{part} is missing in\n{angular}");
    }
    assert!(hertz.contains(" Hz") && !hertz.contains("rad/s"), "{hertz}");
    let figure = |folder: &str, name: &str| fs::read_to_string(workshop.path(folder).join(name)).unwrap();
    // Fonts of the files are letters without blanks and brackets.
    let shows =
        |text: &str, unit: &str| [" ", "("].iter().any(|before| text.contains(&format!("{before}{unit}")));
    for name in ["response_displacement.svg", "excitation.svg", "structure.svg", "modes.svg"] {
        let (one, other) = (figure("hertz", name), figure("angular", name));
        assert!(shows(&one, "Hz") && !shows(&one, "rad/s"), "{name}");
        assert!(shows(&other, "rad/s") && !shows(&other, "Hz"), "{name}");
    }
}
