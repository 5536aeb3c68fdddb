//! Data files of model updating: what they say is understood, and everything wrong is refused where it
//! stands.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;

use hammerbeam_fit::Deviations;
use hammerbeam_jobs::update::{FrequencyTable, Maximum, MeasuredDatum, UpdateData, UpdateSettings, update};
use hammerbeam_study::StudyFile;

const STUDY: &str = include_str!("../../../studies/beam-with-stop.toml");
const PRINTED: &str = include_str!("../../../studies/measurements/printed-eigenfrequencies.toml");
const MEASURED: &str = include_str!("../../../studies/measurements/measured-eigenfrequencies.toml");
const GOOD: &str = r#"
title = "two parameters"

[[parameter]]
key = "structure.length_m"
start = 0.25
low = 0.2
high = 0.3

[[parameter]]
key = "stop.1.stiffness_n_m15"

[[eigenfrequency]]
table = "reduced"
mode = [1, 2]
hz = [17.2, 128.9]
deviation_hz = [0.1, 1.0]

[[damping_ratio]]
mode = 1
ratio = 0.003
deviation = 0.0003

[[periodic_response]]
frequency_hz = 36.0
period_multiple = 1
max_abs_displacement_m = 5.0e-3
displacement_deviation_m = 1.0e-4
max_contact_force_n = 100.0
deviation_relative = 0.1
"#;

fn study() -> StudyFile {
    StudyFile::parse("study.toml", STUDY.to_owned()).unwrap()
}

fn parse(text: &str) -> Result<UpdateData, String> {
    UpdateData::parse("data.toml", text.to_owned(), &study()).map_err(|error| error.to_string())
}

#[test]
fn everything_that_the_file_says_is_understood() {
    let text = GOOD.replace("displacement_deviation_m = 1.0e-4\n", "");
    let data = parse(&text).unwrap();
    assert_eq!(data.deviations, Deviations::Known);
    assert_eq!((data.parameters.len(), data.data.len(), data.orbits.len()), (2, 5, 1));
    assert_eq!((data.parameters[0].start, data.parameters[0].bounds.high), (0.25, 0.3));
    assert_eq!(data.parameters[1].start, 4.5e9);
    let MeasuredDatum::Eigenfrequency(second) = data.data[1].observation else {
        panic!("{:?}", data.data[1])
    };
    assert_eq!((second.table, second.mode), (FrequencyTable::Reduced, 1));
    assert_eq!((data.data[1].value, data.data[1].deviation), (128.9, 1.0));
    let MeasuredDatum::Response(force) = data.data[4].observation else { panic!("{:?}", data.data[4]) };
    assert_eq!((force.of, data.data[4].deviation), (Maximum::ContactForce, 10.0));
}

const PAGE: &str = include_str!("../../../docs/how-to/fit-to-measurements.md");

#[test]
fn every_key_is_documented_and_the_example_is_understood() {
    let tables = ["", "[[parameter]]", "[[eigenfrequency]]", "[[damping_ratio]]", "[[periodic_response]]"];
    for table in tables {
        let message = parse(&format!("{table}\nwrong_key = 1\n")).unwrap_err();
        let known: Vec<&str> = message
            .lines()
            .filter_map(|line| line.split_once("known keys: "))
            .map(|(_, keys)| keys)
            .collect();
        assert!(!known.is_empty(), "{message}");
        for key in known.iter().flat_map(|keys| keys.split(", ")) {
            assert!(PAGE.contains(&format!("`{key}`")), "`{key}` is not documented");
        }
    }
    let example = PAGE.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    assert_eq!(parse(example).unwrap().data.len(), 3);
}

#[test]
fn the_files_of_the_paper_are_understood() {
    assert_eq!(parse(PRINTED).unwrap().data.len(), 16);
    assert_eq!(parse(MEASURED).unwrap().data.len(), 3);
}

/// The good file with one piece of text replaced is refused at the line of the replacement.
#[track_caller]
fn assert_refused(old: &str, new: &str, parts: &[&str]) {
    assert!(GOOD.contains(old), "{old}");
    let good = GOOD.replace("displacement_deviation_m = 1.0e-4\n", "");
    let text = good.replacen(old, new, 1);
    let message = parse(&text).expect_err("it was accepted");
    for part in parts {
        assert!(message.contains(part), "\"{part}\" is missing in\n{message}");
    }
    assert!(message.contains("data.toml:"), "no line in\n{message}");
}

#[test]
fn unknown_keys_words_and_types_are_refused() {
    assert_refused(
        "start = 0.25",
        "begin = 0.25",
        &["unknown key `begin`", "known keys: key, start, low, high"],
    );
    assert_refused("title = ", "titles = ", &["unknown key `titles`", "did you mean `title`?"]);
    assert_refused(
        "table = \"reduced\"",
        "table = \"redused\"",
        &["did you mean \"reduced\"?", "data.toml:14:9"],
    );
    assert_refused("mode = [1, 2]", "mode = [1, 2.5]", &["must be a whole number"]);
    assert_refused("mode = [1, 2]", "mode = [0, 2]", &["is 0", "whole numbers from 1"]);
    assert_refused("hz = [17.2, 128.9]", "hz = [17.2, nan]", &["numbers must be finite"]);
    assert_refused("hz = [17.2, 128.9]", "hz = [17.2, -128.9]", &["is -128.9 Hz", "more than 0"]);
    assert_refused("title = ", "deviations = \"unknown\"\ntitle = ", &["allowed: known, up-to-a-factor"]);
    assert_refused("period_multiple = 1", "period_multiple = 65", &["whole numbers from 1 to 64"]);
    let message = parse("title = ").unwrap_err();
    assert!(message.contains("not TOML"), "{message}");
}

#[test]
fn parameters_that_cannot_be_fitted_are_refused() {
    let key = "key = \"structure.length_m\"\nstart = 0.25\nlow = 0.2\nhigh = 0.3";
    let with = |other: &str| format!("key = \"{other}\"");
    assert_refused(
        key,
        &with("structure.lenght_m"),
        &["did you mean \"structure.length_m\"?", "a default has to be written out"],
    );
    assert_refused(key, &with("structure.elements"), &["is not a number in the text of the study"]);
    assert_refused(key, &with("structure.point.contact.spring_n_m"), &["a default has to be written out"]);
    assert_refused(key, &with("stop.stop 1.stiffness_n_m15"), &["is not a number"]);
    assert_refused("key = \"structure.length_m\"", "", &["`key` is missing in [parameter[0]]"]);
    assert_refused("low = 0.2", "low = 0.3", &["`low` is 0.3, but `high` is 0.3"]);
    assert_refused("start = 0.25", "start = 0.35", &["`start` is 0.35", "allowed: 0.2 to 0.3"]);
    assert_refused("start = 0.25\nlow = 0.2", "low = 0.26", &["the value of the study is 0.2579822"]);
    assert_refused(key, "key = \"stop.1.stiffness_n_m15\"\nstart = 1e9", &["which is fitted already"]);
    assert_refused(key, "key = \"damping.modal_ratio\"\nstart = 1.5", &["starts at 1.5", "0 to 1"]);
    assert_refused(key, "key = \"stop.1.gap_m\"", &["starts at 0, so that its size is not known"]);
    assert_refused(
        key,
        "key = \"stop.1.gap_m\"\nstart = -1e-4",
        &["starts at -0.0001", "allowed by the study file"],
    );
}

#[test]
fn values_and_standard_deviations_have_to_go_together() {
    let deviation = "deviation_hz = [0.1, 1.0]";
    assert_refused(
        deviation,
        "",
        &["the standard deviation is missing", "one of `deviation_hz` and `deviation_relative`"],
    );
    assert_refused(
        deviation,
        "deviation_hz = 0.1\ndeviation_relative = 0.1",
        &["the standard deviation is given twice"],
    );
    assert_refused(deviation, "deviation_hz = [0.1, 0.2, 0.3]", &["3 standard deviations for 2 numbers"]);
    assert_refused(deviation, "deviation_hz = 0.0", &["is 0 Hz", "more than 0"]);
    assert_refused(deviation, "deviation_relative = 0", &["a standard deviation is more than 0"]);
    assert_refused("deviation = 0.0003", "deviation = 3.0", &["`deviation` is 3"]);
    assert_refused("ratio = 0.003", "ratio = 0", &["a measured number is more than 0"]);
    assert_refused("mode = [1, 2]", "mode = [1, 2, 3]", &["3 modes for 2 numbers", "as many as in `hz`"]);
    assert_refused("mode = [1, 2]", "mode = []", &["the list is empty"]);
    assert_refused("hz = [17.2, 128.9]\n", "", &["`hz` is missing"]);
    let measured = "max_abs_displacement_m = 5.0e-3\nmax_contact_force_n = 100.0\n";
    assert_refused(
        "max_abs_displacement_m = 5.0e-3\n",
        "displacement_deviation_m = 1e-4\n",
        &["without `max_abs_displacement_m`"],
    );
    let good = GOOD.replace("displacement_deviation_m = 1.0e-4\n", "").replace(measured, "");
    let message = parse(&good).unwrap_err();
    assert!(message.contains("nothing was measured of this response"), "{message}");
}

#[test]
fn fewer_data_than_parameters_are_refused() {
    let two =
        "[[parameter]]\nkey = \"structure.length_m\"\n[[parameter]]\nkey = \"structure.density_kg_m3\"\n";
    let one = "[[eigenfrequency]]\nmode = 1\nhz = 17.0\ndeviation_hz = 0.1\n";
    let message = parse(&format!("{two}{one}")).unwrap_err();
    assert!(message.contains("fewer than the fit needs: 1 datum for 2 parameters"), "{message}");
    let both = "[[eigenfrequency]]\nmode = [1, 2]\nhz = [17.0, 130.0]\ndeviation_hz = 0.1\n";
    assert!(parse(&format!("{two}{both}")).is_ok());
    let message = parse(&format!("deviations = \"up-to-a-factor\"\n{two}{both}")).unwrap_err();
    assert!(message.contains("2 data for 2 parameters") && message.contains("3 data or more"), "{message}");
    let message = parse(one).unwrap_err();
    assert!(message.contains("there is no parameter to fit"), "{message}");
}

/// A fault that only the model shows is reported with its place in the data file, too.
#[test]
fn modes_that_the_study_does_not_have_are_refused() {
    let parameter = "[[parameter]]\nkey = \"structure.length_m\"\n";
    let failure = |rest: &str| {
        let data = parse(&format!("{parameter}{rest}")).unwrap();
        update(&study(), &data, &UpdateSettings::default()).expect_err("it was accepted").to_string()
    };
    let reduced =
        failure("[[eigenfrequency]]\ntable = \"reduced\"\nmode = 7\nhz = 17.0\ndeviation_hz = 0.1\n");
    assert!(reduced.contains("mode 7 was measured") && reduced.contains("allowed: 1 to 6"), "{reduced}");
    assert!(reduced.contains("data.toml:5:8"), "{reduced}");
    let fixed =
        failure("[[eigenfrequency]]\ntable = \"fixed-interface\"\nmode = 1\nhz = 17.0\ndeviation_hz = 0.1\n");
    assert!(fixed.contains("allowed: another `table`"), "{fixed}");
    let damping = failure("[[damping_ratio]]\nmode = 9\nratio = 0.1\ndeviation = 0.01\n");
    assert!(damping.contains("mode 9 was measured"), "{damping}");
}

#[test]
fn a_response_that_the_model_does_not_have_is_told() {
    let study =
        StudyFile::parse("study.toml", include_str!("../../../studies/two-masses.toml").to_owned()).unwrap();
    let data = "[[parameter]]\nkey = \"stop.1.gap_m\"\n[[periodic_response]]\nfrequency_hz = \
    3.0\nperiod_multiple = 7\nmax_abs_displacement_m = 0.001\ndeviation_relative = 0.1\n";
    let data = UpdateData::parse("data.toml", data.to_owned(), &study).unwrap();
    let message = update(&study, &data, &UpdateSettings::default()).expect_err("it was accepted").to_string();
    assert!(message.contains("no stable periodic response of 7 excitation periods at 3 Hz"), "{message}");
}

#[test]
fn a_file_that_is_not_there_is_told() {
    let error = UpdateData::read(Path::new("nowhere.toml"), &study()).unwrap_err();
    assert!(error.to_string().contains("cannot read the data nowhere.toml"), "{error}");
}

/// The paper's geometry from its printed frequencies, from a start some ten percent and more away.
#[test]
fn the_geometry_of_the_paper_comes_back_from_its_printed_frequencies() {
    let data = parse(PRINTED).unwrap();
    let found = update(&study(), &data, &UpdateSettings::default()).unwrap();
    assert!(found.end.converged(), "{:?}", found.end);
    for parameter in &found.parameters {
        let interval = parameter.interval.unwrap();
        // The study has the values of an earlier fit with other weights, which lie within the intervals.
        assert!((interval.low..=interval.high).contains(&parameter.in_study), "{parameter:?}");
    }
    let relative =
        |index: usize| found.parameters[index].standard_error.unwrap() / found.parameters[index].value;
    // Lengths to some 1e-5, the rotary inertia to less than a tenth.
    assert!(relative(0) < 5e-5 && relative(1) < 5e-5 && relative(2) < 0.1);
    // The printed digits are kept: 1e-4, but for 30.51 with its four digits and the sixth reduced frequency.
    for (index, datum) in found.data.iter().enumerate() {
        let allowed = match index {
            6 => 1.6e-4,
            15 => 1.2e-3,
            _ => 1e-4,
        };
        assert!((datum.fitted / datum.datum.value - 1.0).abs() < allowed, "{datum:?}");
    }
    assert!(found.findings.is_empty(), "{:?}", found.findings);
}

/// Two of the three measured frequencies would do for two parameters; the third is left to test them.
#[test]
fn three_measured_frequencies_determine_modulus_and_mass_but_no_rotary_inertia() {
    let two = update(&study(), &parse(MEASURED).unwrap(), &UpdateSettings::default()).unwrap();
    assert!(two.end.converged() && two.findings.is_empty(), "{:?}", two.findings);
    let third = "\n[[parameter]]\nkey = \"structure.point.contact.rotary_inertia_kg_m2\"\nstart = 3e-6\n";
    let three =
        update(&study(), &parse(&format!("{MEASURED}{third}")).unwrap(), &UpdateSettings::default()).unwrap();
    assert!(three.end.converged(), "{:?}", three.end);
    let told: Vec<String> = three.findings.iter().map(ToString::to_string).collect();
    assert!(
        told[0].starts_with("the data do not determine structure.point.contact.rotary_inertia_kg_m2"),
        "{told:?}"
    );
    assert!(told[1].contains("as many parameters as data"), "{told:?}");
}
