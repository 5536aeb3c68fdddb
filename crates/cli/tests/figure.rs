//! The command that draws: everything that a folder holds, always the same bytes, and clear refusals.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

use crate::common::{
    RUN, Workshop, assert_bad_input, assert_success, files, reported, short_run, short_run_with, stderr,
    stdout,
};
use serde_json::Value;

const DUFFING: &str = include_str!("../../../studies/duffing.toml");

/// One that comes twice is drawn once.
const FORMATS: &str = "--format=svg,png,pdf,svg";

/// A folder with two sweeps, exponents and basins, without branches.
fn motions() -> Workshop {
    let workshop = Workshop::with(DUFFING);
    let sweep = ["--from", "0.2", "--to", "0.3", "--step", "0.02", "--down"];
    let basins = ["--frequency", "0.25", "--x", "q1=-4..4", "--y", "v1=-5..5", "--grid", "6"];
    let commands: [&[&str]; 3] = [
        &[&["sweep"][..], &sweep].concat(),
        &["lyapunov", "--frequency", "0.24", "--to", "0.26", "--step", "0.01", "--periods", "60"],
        &[&["basins"][..], &basins].concat(),
    ];
    for command in commands {
        let arguments = [&command[..1], &["study.toml"], &command[1..], &["--out", "results"]].concat();
        assert_success(&workshop.hammerbeam(&arguments));
    }
    workshop
}

#[track_caller]
fn assert_same(workshop: &Workshop, names: &[String], folders: [&str; 2]) {
    for name in names {
        let [one, other] = folders.map(|folder| fs::read(workshop.path(folder).join(name)).unwrap());
        assert!(one == other, "{name} differs");
    }
}

#[test]
fn everything_in_a_folder_is_drawn_and_the_same_on_any_number_of_threads() {
    let workshop = motions();
    let first = files(&workshop, &["--out", "first", "--jobs", "1", FORMATS]);
    for name in ["sweep-1.svg", "exponents-2.png", "convergence-2-1.pdf", "section-2-3.png", "basins-3.svg"] {
        assert!(first.iter().any(|file| file == name), "{name} is not among {first:?}");
    }
    assert!(!first.iter().any(|file| file.starts_with("response") || file.starts_with("multipliers")));
    assert_eq!(files(&workshop, &["--out", "second", "--jobs", "3", FORMATS]), first);
    assert_same(&workshop, &first, ["first", "second"]);
    let map = fs::read_to_string(workshop.path("first/basins-3.svg")).unwrap();
    assert!(map.contains("1: period 1, ") && map.contains("2: period 1, "), "both motions of the oscillator");
    assert_eq!(files(&workshop, &["--kind", "basins", "--out", "third"]), ["basins-3.svg", "basins-3.png"]);
}

#[test]
fn what_is_not_there_is_refused_with_a_sentence() {
    let workshop = motions();
    for kind in ["multipliers", "response", "vary", "curves", "orbits"] {
        let output = workshop.hammerbeam(&["figure", "results", "--kind", kind]);
        assert_eq!(output.status.code(), Some(1));
        let said = stderr(&output);
        assert!(said.contains("results holds nothing of what was asked for to draw"), "{kind}: {said}");
    }
    fs::create_dir(workshop.path("begun")).unwrap();
    fs::write(workshop.path("begun/results.db"), "").unwrap();
    assert_bad_input(&workshop.hammerbeam(&["figure", "begun"]), &["there are no results in begun"]);
    fs::write(workshop.path("begun/results.db"), "something else").unwrap();
    assert_bad_input(&workshop.hammerbeam(&["figure", "begun"]), &["was not written by hammerbeam"]);
    assert_bad_input(&workshop.hammerbeam(&["figure", "nowhere"]), &["there are no results in nowhere"]);
}

#[test]
fn the_linear_structure_is_drawn_and_an_error_of_the_reduction_where_there_is_one() {
    let beam = Workshop::with(crate::common::BEAM);
    assert_success(&beam.hammerbeam(&["modes", "study.toml", "--out", "drawn"]));
    let read = |name: &str| fs::read_to_string(beam.path("drawn").join(name)).unwrap();
    for (name, words) in [
        ("structure.svg", ">243.2 mm<"),
        ("structure.svg", "Hertz contact 4.5\u{2009}×\u{2009}10⁹ N/m¹·⁵"),
        ("modes.svg", "Mode 1: 17.495 Hz (unreduced 17.495 Hz)"),
        ("excitation.svg", "Acceleration of the support (m/s²)"),
    ] {
        assert!(read(name).contains(words), "{words} is not in {name}");
    }
    let svg = fs::read_to_string(beam.path("drawn/reduction.svg")).unwrap();
    assert!(svg.contains("up to the cut-off") && svg.contains("above the cut-off"));
    let lumped = Workshop::with(DUFFING);
    let output = lumped.hammerbeam(&["modes", "study.toml", "--out", "drawn"]);
    assert_success(&output);
    assert_eq!(reported(&output), "", "what is not reduced has no error to draw, which is no fault");
    assert!(!lumped.path("drawn/reduction.svg").exists() && lumped.path("drawn/structure.svg").exists());
}

#[test]
fn an_orbit_is_drawn_with_the_force_of_its_stop() {
    let workshop = Workshop::with(crate::common::BEAM);
    let filter = ["--low-pass", "400"];
    let command = ["orbit", "study.toml", "--frequency", "30", "--out", "drawn", "--json"];
    let output = workshop.hammerbeam(&[&command[..], &filter].concat());
    assert_success(&output);
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(document["figures"].as_array().unwrap().len() % 6, 0);
    let history = fs::read_to_string(workshop.path("drawn/orbit-1-history.svg")).unwrap();
    for label in [
        "Displ. (mm)",
        "Accel. (m/s²)",
        "Local force (N)",
        "Support (mm)",
        "30 Hz, period 1, stable",
        "low-pass filter of 400 Hz",
    ] {
        assert!(history.contains(label), "{label}");
    }
    assert!(workshop.path("drawn/orbit-1-spectrum.png").is_file());
}

/// The path reaches as far as the displacement that is observed, one of the two across the hole, and less
/// than the square root of two as far: the load across is smaller, so the tube swings less that way. Of a
/// flat load there is contact for a part of the period only. With this much damping, well below the
/// resonance, the search ends after one solution.
#[test]
fn an_orbit_in_a_round_hole_is_drawn_along_its_axis() {
    let workshop = Workshop::with(include_str!("../../../studies/tube-in-hole.toml"));
    let settings = ["--set", "excitation.force.2.amplitude_n=0.1", "--set", "damping.modal_ratio=0.1"];
    let command = ["orbit", "study.toml", "--frequency", "12", "--out", "drawn", "--json"];
    let output = workshop.hammerbeam(&[&command[..], &settings].concat());
    assert_success(&output);
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let orbits = document["solutions"].as_array().unwrap();
    assert!(!orbits.is_empty());
    assert_eq!(document["figures"].as_array().unwrap().len(), 8 * orbits.len());
    for (number, orbit) in (1..).zip(orbits) {
        let hole = fs::read_to_string(workshop.path(&format!("drawn/orbit-{number}-hole.svg"))).unwrap();
        for label in
            [">hole: Tube in a round hole, 12 Hz", ">baffle.y (mm)<", ">baffle.z (mm)<", ">clearance<"]
        {
            assert!(hole.contains(label), "{label}");
        }
        let largest = hole.split_once("largest displacement ").unwrap().1.split_once(" mm").unwrap().0;
        let largest: f64 = largest.parse().unwrap();
        let observed = 1e3 * orbit["max_abs_displacement_m"].as_f64().unwrap();
        assert!(largest > 0.999 * observed && largest < 1.42 * observed, "{largest} {observed}");
        for label in [">path in contact<", ">path without contact<", ">contact begins<"] {
            assert!(hole.contains(label), "{label}");
        }
    }
}

#[test]
fn a_run_draws_what_figure_draws_of_its_folder_byte_for_byte() {
    let orbit = "[figures]\nlow_pass_hz = 30.0\n[[figures.orbit]]\nfrequency_hz = 13.7\n";
    let workshop = short_run_with(orbit);
    assert!(!workshop.path("results/structure.svg").exists(), "a run with --no-figures draws none");
    assert_success(&workshop.hammerbeam(&RUN));
    let drawn = files(&workshop, &["--out", "again", "--jobs", "1"]);
    for name in [
        "structure.svg",
        "modes.svg",
        "excitation.svg",
        "response_displacement.svg",
        "response_acceleration.svg",
        "multipliers-1.svg",
        "multipliers-1-unit-circle.svg",
        "orbit_13.7Hz_period1-history.svg",
        "orbit_13.7Hz_period1-phase.png",
        "orbit_13.7Hz_period1-spectrum.svg",
    ] {
        assert!(drawn.iter().any(|file| file == name), "{name} is not among {drawn:?}");
    }
    for name in &drawn {
        // These the run leaves to the command.
        if name.starts_with("multipliers") {
            assert!(!workshop.path("results").join(name).exists());
            continue;
        }
        let read = |folder: &str| fs::read(workshop.path(folder).join(name)).unwrap();
        assert!(read("results") == read("again"), "{name} differs");
    }
    for jobs in ["2", "3"] {
        assert_eq!(files(&workshop, &["--out", jobs, "--jobs", jobs]), drawn);
        assert_same(&workshop, &drawn, ["again", jobs]);
    }
    let all = files(&workshop, &["--out", "pdf", "--jobs", "1", FORMATS]);
    assert_eq!(2 * (all.len() - 1), 3 * (drawn.len() - 1), "a PDF of every figure, and none of the page");
    assert_eq!(files(&workshop, &["--out", "pdf again", "--jobs", "3", FORMATS]), all);
    assert_same(&workshop, &all, ["pdf", "pdf again"]);
    let history = fs::read_to_string(workshop.path("again/orbit_13.7Hz_period1-history.svg")).unwrap();
    assert!(history.contains("low-pass filter of 30 Hz") && history.contains("13.7 Hz, period 1"));
}

/// Figures are no part of a study's identity: another orbit is drawn by the same command, and nothing is
/// computed again.
#[test]
fn an_orbit_that_is_added_to_the_study_is_drawn_by_the_next_run() {
    let workshop = short_run();
    let study = fs::read_to_string(workshop.path("study.toml")).unwrap();
    fs::write(workshop.path("study.toml"), format!("{study}\n[[figures.orbit]]\nfrequency_hz = 13.6\n"))
        .unwrap();
    assert_success(&workshop.hammerbeam(&RUN));
    assert!(workshop.path("results/orbit_13.6Hz_period1-history.svg").is_file());
}

#[test]
fn an_orbit_that_no_branch_has_is_bad_input() {
    let workshop = short_run();
    for (orbit, sentence) in [
        ("20", "no stored branch of 1 excitation period crosses 20 Hz; they lie between 13.5 and 14 Hz"),
        ("13.7:3", "no stored branch of 3 excitation periods crosses 13.7 Hz; there is no such branch"),
    ] {
        let arguments = ["figure", "results", "--orbit", "13.7", "--orbit", orbit, "--out", "drawn"];
        assert_bad_input(&workshop.hammerbeam(&arguments), &[sentence]);
        assert!(!workshop.path("drawn").exists(), "nothing is drawn");
    }
    assert_success(&workshop.hammerbeam(&["figure", "results", "--orbit", "13.7"]));
    assert!(workshop.path("results/orbit_13.7Hz_period1-spectrum.svg").is_file());
    let refused = workshop.hammerbeam(&["figure", "results", "--orbit", "13.7:0"]);
    assert_bad_input(&refused, &["a whole number from 1 to 64"]);
}

#[test]
fn branches_over_another_parameter_are_drawn_over_it() {
    let study = include_str!("../../../studies/duffing-in-two-parameters.toml")
        .replace("frequency_hz = 0.25\n\n", "frequency_hz = 0.25\nsteps = 200\n\n");
    let quick = "[search]\nfrequencies = 4\ntrials = 0\n[continuation]\nmax_step_hz = 0.0005\n";
    let workshop = Workshop::with(&format!("{study}{quick}"));
    assert_success(&workshop.hammerbeam(&RUN));
    let svg = fs::read_to_string(workshop.path("results/vary_1_excitation_amplitude_n_displacement.svg"));
    let svg = svg.unwrap();
    assert!(svg.contains(">Excitation amplitude (N)<") && svg.contains(">fold<"), "an S between two folds");
    assert!(svg.contains("0.25 Hz") && svg.contains(">unstable<"));
    assert!(workshop.path("results/curves_excitation_amplitude_n.svg").is_file());
    let drawn = files(&workshop, &["--kind", "vary,curves", "--out", "first", "--jobs", "1", FORMATS]);
    assert!(drawn.iter().any(|name| name == "curves_excitation_amplitude_n.pdf"));
    assert_eq!(
        files(&workshop, &["--kind", "vary,curves", "--out", "second", "--jobs", "2", FORMATS]),
        drawn
    );
    assert_same(&workshop, &drawn, ["first", "second"]);
}

/// While a run writes its folder, it can be drawn as far as it has come; before there is anything, a sentence
/// says so.
#[test]
fn a_folder_that_is_being_written_is_drawn_as_far_as_it_has_come() {
    let workshop = Workshop::with(crate::common::TWO_MASSES);
    let mut run = std::process::Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
        .args(RUN)
        .current_dir(workshop.path(""))
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let mut meanwhile = 0;
    while run.try_wait().unwrap().is_none() {
        let output = workshop.hammerbeam(&["figure", "results", "--kind", "response", "--out", "drawn"]);
        match output.status.code() {
            Some(0) => meanwhile += 1,
            Some(1) => assert!(stderr(&output).contains("holds nothing of what was asked for")),
            _ => assert!(stderr(&output).contains("there are no results in results"), "{}", stderr(&output)),
        }
    }
    assert!(run.wait().unwrap().success());
    assert!(meanwhile > 0, "nothing was drawn while the run went on");
    assert!(workshop.path("drawn/response_displacement.svg").is_file());
}

/// What is there when drawing is interrupted is whole, and what was there before and was not come to is as it
/// was.
#[cfg(unix)]
#[test]
fn ctrl_c_while_drawing_leaves_whole_files_and_exits_with_130() {
    // Large figures, so that there is time to interrupt.
    const LARGE: [&str; 4] = ["--resolution", "1200", "--jobs", "2"];
    let workshop = short_run();
    let complete = files(&workshop, &[&["--out", "complete"][..], &LARGE].concat());
    fs::create_dir(workshop.path("cut")).unwrap();
    for name in &complete {
        fs::write(workshop.path("cut").join(name), "before").unwrap();
    }
    let first = workshop.path("cut").join("structure.png");
    let child = std::process::Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
        .args(["figure", "results", "--out", "cut"])
        .args(LARGE)
        .current_dir(workshop.path(""))
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    while fs::read(&first).unwrap() == b"before" {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    let interrupt = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(interrupt.unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    assert!(stderr(&output).contains("interrupted while drawing; "), "{}", stderr(&output));
    assert_eq!(stdout(&output), "");
    let mut left = 0;
    for name in &complete {
        let read = |folder: &str| fs::read(workshop.path(folder).join(name)).unwrap();
        let found = read("cut");
        left += usize::from(found == b"before");
        assert!(found == b"before" || found == read("complete"), "{name} is not whole");
    }
    assert!(left > 0, "all was drawn before the interruption came");
    assert_eq!(
        fs::read_dir(workshop.path("cut")).unwrap().count(),
        complete.len(),
        "nothing unfinished is left"
    );
}
