//! What the commands refuse.

use serde_json::Value;

use super::{IMPACT_OSCILLATOR, document, remembering};
use crate::common::{BEAM, TWO_MASSES, Workshop, assert_bad_input, assert_success, stderr, stdout};

#[test]
fn options_that_make_no_sense_are_refused() {
    let workshop = Workshop::with(TWO_MASSES);
    let simulate = ["simulate", "study.toml", "--frequency", "5"];
    let lyapunov = ["lyapunov", "study.toml", "--frequency", "5"];
    let sweep = ["sweep", "study.toml"];
    let basins = ["basins", "study.toml", "--frequency", "5", "--x"];
    let before = workshop.listing();
    for (command, options, part) in [
        (&simulate[..3], &["-5"][..], "must be a number of hertz"),
        (&simulate[..3], &["1e-300"], "must be a number of hertz from 1e-10 to 1e10"),
        (&sweep, &["--from", "9e-11"], "must be a number of hertz from 1e-10 to 1e10"),
        (&simulate, &["--periods", "0"], "0 is not in 1..="),
        (&simulate, &["--periods", "-1"], "-1 is not in 1..="),
        (&simulate, &["--periods", "2.5"], "must be a whole number from 1 to 100000000"),
        (&simulate, &["--transient-periods", "-1"], "-1 is not in 0..="),
        (&lyapunov, &["--transient-periods", "-1"], "-1 is not in 0..="),
        (&sweep, &["--transient-periods", "-1"], "-1 is not in 0..="),
        (&sweep, &["--starts", "-1"], "-1 is not in 1..="),
        (&simulate, &["--samples-per-period", "0"], "0 is not in 1..="),
        (
            &simulate,
            &["--periods", "20000", "--samples-per-period", "1000000", "--out", "out"],
            "is 100000120000 numbers, must be 5000000000 at most with --out; allowed: 1 to 999 periods",
        ),
        (&simulate, &["--section-phase", "1.5"], "must be a number of cycles from 0 to 1"),
        (&simulate, &["--initial", "1,2"], "found 2 numbers; allowed: rest, linear, branch:N"),
        (&simulate[..3], &["0"], "must be a number of hertz from 1e-10 to 1e10"),
        (&simulate[..3], &["1e300"], "must be a number of hertz from 1e-10 to 1e10"),
        (&sweep, &["--to", "1e300"], "must be a number of hertz from 1e-10 to 1e10"),
        (&simulate, &["--initial", "1,2,x,4"], "found \"x\""),
        (&simulate, &["--initial", "1e308,0,0,0"], "found \"1e308\"; allowed: rest"),
        (&simulate, &["--initial", "1e308,0,0,0"], "each from -1e100 to 1e100"),
        (&simulate, &["--initial", "-1,2,nan,4"], "found \"nan\""),
        (&simulate, &["--initial", "branch:1"], "needs --results DIR"),
        (&simulate, &["--initial", "branch:1", "--results", "nowhere"], "there are no results in nowhere"),
        (&simulate, &["--results", "nowhere"], "there are no results in nowhere"),
        (&lyapunov, &["--results", "nowhere"], "there are no results in nowhere"),
        (&lyapunov, &["--to", "4"], "--to is 4 Hz, which is below --frequency, 5 Hz"),
        (&lyapunov, &["--step", "1"], "--to"),
        (&lyapunov, &["--periods", "19"], "19 is not in 20..="),
        (&lyapunov, &["--sections-per-period", "0"], "0 is not in 1..=1024"),
        (&lyapunov, &["--initial", "somewhere"], "found \"somewhere\""),
        (&sweep, &["--from", "8", "--to", "6"], "--to is 6 Hz, which is below --from, 8 Hz"),
        (&sweep, &["--step", "0"], "must be a number of hertz"),
        (&sweep, &["--step", "1e-7"], "the number of steps is"),
        (&sweep, &["--starts", "0"], "0 is not in 1..="),
        (&sweep, &["--starts", "3", "--down"], "cannot be used with"),
        (&sweep, &["--averaged-periods", "100"], "100 is not in 240..="),
        (&sweep, &["--longest-period", "0"], "0 is not in 1..="),
        (&sweep, &["--results", "nowhere"], "there are no results in nowhere"),
        (&basins, &["q1=0..1"], "--y"),
        (&basins, &["q1", "--y", "v1=0..1"], "must be NAME=LOW..HIGH"),
        (&basins, &["q1=0..1e308", "--y", "v1=0..1"], "with numbers from -1e100 to 1e100"),
        (&basins, &["q1=2..1", "--y", "v1=0..1"], "the range 2..1 is empty"),
        (&basins, &["q3=0..1", "--y", "v1=0..1"], "found the coordinate \"q3\"; allowed: q1 to q2, v1 to v2"),
        (&basins, &["q1=0..1", "--y", "q1=0..1"], "two different ones are needed"),
        (&basins, &["displacement=0..1", "--y", "q1=0..1"], "are the same coordinate"),
        (&basins, &["q1=0..1", "--y", "v1=0..1", "--grid", "0"], "0 is not in 1..="),
        (&basins, &["q1=0..1", "--y", "v1=0..1", "--results", "nowhere"], "there are no results in nowhere"),
    ] {
        assert_bad_input(&workshop.hammerbeam(&[command, options].concat()), &[part]);
    }
    assert_eq!(workshop.listing(), before, "something was written");
}

#[test]
fn states_in_which_no_motion_begins_are_refused_by_name() {
    let rigid = Workshop::with(IMPACT_OSCILLATOR);
    let memory = Workshop::with(&remembering());
    for (workshop, initial, code, part) in [
        (&rigid, "1.5,0", 2, "the state lies 5.000e-1 m behind the rigid stop \"stop\""),
        (
            &memory,
            "0.1,0",
            2,
            "the state lies 1.000e-1 m within the contact of \"stop\", and its law needs to know how fast \
            it closed",
        ),
        // The force pushes the mass against the stop at which it rests.
        (&memory, "rest", 1, "stop is pressed on without an impact"),
    ] {
        let arguments = ["simulate", "study.toml", "--frequency", "0.3", "--initial", initial];
        let output = workshop.hammerbeam(&arguments);
        assert_eq!(output.status.code(), Some(code), "{initial}: {}", stderr(&output));
        assert!(stderr(&output).contains(part), "{initial}: {}", stderr(&output));
    }
}

/// All cells of this grid lie behind the stop: there is nothing to give, and it is reported.
#[test]
fn basins_without_an_attractor_are_exit_code_1() {
    let workshop = Workshop::with(IMPACT_OSCILLATOR);
    let cells = ["--x", "q1=2..3", "--y", "v1=0..1", "--grid", "2", "--json"];
    let output = workshop.hammerbeam(&[&["basins", "study.toml", "--frequency", "0.3"][..], &cells].concat());
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(stderr(&output).contains("no motion from any of the 4 cells"), "{}", stderr(&output));
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(document["error"]["exit_code"], 1);
}

/// At rest the mass is pressed against a stop whose law needs the speed of an impact, and some states about
/// it lie in the contact: the search begins beside, and its orbit is the motion that settles from a state
/// that a motion can begin at.
#[test]
fn a_search_does_not_miss_what_no_motion_can_begin_at() {
    let workshop = Workshop::with(&remembering());
    let orbit = document(&workshop, &["orbit", "study.toml", "--frequency", "0.3", "--json"]);
    assert_eq!(orbit["search_complete"], true);
    let sweep = ["sweep", "study.toml", "--from", "0.3", "--to", "0.3", "--initial", "-0.1,0", "--json"];
    let settled = document(&workshop, &sweep);
    let largest = |of: &Value| of["max_abs_displacement_m"].as_f64().unwrap();
    // Motions have settled when they repeat within 1e-8.
    let (orbit, settled) = (largest(&orbit), largest(&settled["motions"][0]));
    assert!((orbit / settled - 1.0).abs() < 1e-7, "{orbit} {settled}");
}

/// Above its first grazing the linear motion of the impact oscillator goes beyond the stop: at phase 0 by `Re
/// F/(1 - W^2 + i c W) - g`.
#[test]
fn the_motion_without_contacts_is_refused_where_it_lies_behind_the_stop() {
    let workshop = Workshop::with(IMPACT_OSCILLATOR);
    let frequency = "0.14";
    let w = std::f64::consts::TAU * 0.14;
    let real = 1.0 - w * w;
    let depth = 0.4 * real / (real * real + (0.04 * w).powi(2)) - 1.0;
    let part = format!("--initial linear, at 0.14 Hz: the state lies {depth:.3e} m behind the rigid stop");
    let before = workshop.listing();
    for command in [
        &["simulate", "study.toml", "--frequency", frequency][..],
        &["lyapunov", "study.toml", "--frequency", frequency],
        &["sweep", "study.toml", "--from", frequency, "--to", frequency],
    ] {
        let arguments = [command, &["--initial", "linear", "--out", "out"]].concat();
        assert_bad_input(&workshop.hammerbeam(&arguments), &[&part]);
    }
    assert_eq!(workshop.listing(), before, "something was written");
    // A diagram leaves it out, and has states in front of the stop for all others.
    let diagram = ["sweep", "study.toml", "--from", frequency, "--to", frequency, "--starts", "6", "--json"];
    let output = workshop.hammerbeam(&diagram);
    assert_success(&output);
    assert_eq!(stderr(&output).lines().count(), 1, "{}", stderr(&output));
    assert!(
        stderr(&output).contains(&format!("start 2: the state lies {depth:.3e} m behind the rigid stop"))
    );
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(document["motions"].as_array().unwrap().len(), 5);
}

/// A support that is 3 mm beyond its middle at phase 0, and a stop in space 1 mm away.
#[test]
fn rest_is_refused_where_the_support_lies_beyond_the_stop() {
    let study = r#"
title = "Moving support"
[structure]
kind = "beam"
length_m = 0.4
elements = 10
section = { width_m = 0.02, height_m = 0.002 }
youngs_modulus_pa = 7.0e10
density_kg_m3 = 2700.0
left = "clamped"
right = "free"
[reduction]
method = "truncation"
cut_off_hz = 100.0
[damping]
modal_ratio = 0.05
[excitation]
kind = "support-motion"
at = "left"
amplitude_m = 3e-3
frequency_hz = [0.5, 2.0]
[[stop]]
name = "wall"
at = "right"
law = "rigid"
restitution = 0.8
gap_m = 1e-3
side = "above"
fixed_to = "space"
[response]
point = "right"
"#;
    let workshop = Workshop::with(study);
    for command in [
        &["simulate", "study.toml", "--frequency", "1"][..],
        &["lyapunov", "study.toml", "--frequency", "1"],
        &["sweep", "study.toml"],
    ] {
        assert_bad_input(
            &workshop.hammerbeam(command),
            &["--initial rest, at", "the state lies 2.000e-3 m behind the rigid stop \"wall\""],
        );
    }
}

/// Faults of a study are refused in the same words by every command, see `bad_input.rs`.
#[test]
fn faulty_studies_are_refused() {
    let workshop = Workshop::changed(BEAM, "gap_m = 0.0", "gap_m = -1e-3");
    let before = workshop.listing();
    for arguments in [
        &["simulate", "study.toml", "--frequency", "30", "--out", "out"][..],
        &["lyapunov", "study.toml", "--frequency", "30", "--out", "out"],
        &["sweep", "study.toml", "--out", "out"],
        &["basins", "study.toml", "--frequency", "30", "--x", "q1=0..1", "--y", "v1=0..1", "--out", "out"],
    ] {
        assert_bad_input(&workshop.hammerbeam(arguments), &["`gap_m` is -0.001 m", "stop[0].gap_m"]);
    }
    assert_eq!(workshop.listing(), before);
}

/// One beyond each end of what an option allows, and options that exclude one another.
#[test]
fn options_beyond_their_limits_are_refused() {
    let workshop = Workshop::with(TWO_MASSES);
    let sweep = ["sweep", "study.toml"];
    let basins = ["basins", "study.toml", "--frequency", "5", "--x", "q1=0..1", "--y", "v1=0..1"];
    let before = workshop.listing();
    for (command, options, part) in [
        (
            &sweep[..],
            &["--starts", "3", "--initial", "rest"][..],
            "'--starts <N>' cannot be used with '--initial",
        ),
        (&sweep, &["--starts", "100001"], "100001 is not in 1..=100000"),
        (&sweep, &["--samples", "0"], "'0' for '--samples <N>': 0 is not in 1..=100000"),
        (&sweep, &["--samples", "100001"], "100001 is not in 1..=100000"),
        (&sweep, &["--patience-periods", "0"], "'0' for '--patience-periods <N>': 0 is not in 1..=100000000"),
        (&sweep, &["--longest-period", "1025"], "1025 is not in 1..=1024"),
        (&sweep, &["--jobs", "0"], "'0' for '--jobs <N>': 0 is not in 1..="),
        (&basins, &["--grid", "10001"], "10001 is not in 1..=10000"),
        (&basins, &["--patience-periods", "0"], "0 is not in 1..=100000000"),
        (
            &basins,
            &["--longest-period", "1025"],
            "'1025' for '--longest-period <N>': 1025 is not in 1..=1024",
        ),
        (&basins, &["--jobs", "0"], "'0' for '--jobs <N>': 0 is not in 1..="),
    ] {
        assert_bad_input(&workshop.hammerbeam(&[command, options].concat()), &[part]);
    }
    assert_eq!(workshop.listing(), before, "something was written");
}

/// Two masses of their own: the response is that of the second, and the first mode is that of the first.
#[test]
fn displacement_is_refused_as_a_coordinate_where_the_first_mode_does_not_move_the_response_point() {
    let workshop = Workshop::driven_mass("frequency_hz = [0.1, 0.2]\n[response]\npoint = \"other\"");
    let study = std::fs::read_to_string(workshop.path("study.toml")).unwrap();
    let other = "mass = [{ name = \"other\", mass_kg = 1.0 }, ";
    let held = "spring = [{ between = [\"other\", \"ground\"], stiffness_n_m = 9.0 }, ";
    let study = study.replace("mass = [", other).replace("spring = [", held);
    std::fs::write(workshop.path("study.toml"), study).unwrap();
    let basins = |x: &str, y: &str| {
        workshop.hammerbeam(&[
            "basins",
            "study.toml",
            "--frequency",
            "0.1",
            "--grid",
            "1",
            "--x",
            x,
            "--y",
            y,
        ])
    };
    for (x, y, flag) in [("displacement=0..1", "q2=0..1", "--x"), ("q1=0..1", "velocity=0..1", "--y")] {
        let part =
            format!("{flag}: the first mode does not move the response point; allowed: q1 to q2, v1 to v2");
        assert_bad_input(&basins(x, y), &[&part]);
    }
    // The coordinates that are allowed are.
    assert_success(&basins("q2=0..1", "v2=0..1"));
}
