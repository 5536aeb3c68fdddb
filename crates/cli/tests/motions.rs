//! The commands that follow motions: documents, tables, refusals, kills.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use std::{
    fs,
    process::{Command, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};

use common::{BEAM, TWO_MASSES, Workshop, assert_bad_input, assert_success, stderr, stdout};
use serde_json::Value;

const DUFFING: &str = include_str!("../../../studies/duffing.toml");

#[track_caller]
fn document(workshop: &Workshop, arguments: &[&str]) -> Value {
    let output = workshop.hammerbeam(arguments);
    assert_success(&output);
    assert_eq!(stderr(&output), "", "nothing is told without a terminal");
    serde_json::from_str(&stdout(&output)).expect("one JSON document")
}

fn table(workshop: &Workshop, path: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(workshop.path(path)).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn column(table: &[Vec<String>], name: &str) -> Vec<f64> {
    let index = table[0].iter().position(|column| column == name).unwrap();
    table[1..].iter().map(|row| row[index].parse().unwrap()).collect()
}

#[test]
fn simulate_writes_samples_contacts_and_a_section() {
    let workshop = Workshop::with(BEAM);
    let arguments =
        ["simulate", "study.toml", "--frequency", "36", "--periods", "5", "--transient-periods", "300"];
    let more = ["--samples-per-period", "100", "--section-phase", "0.33", "--out", "motion", "--json"];
    let document = document(&workshop, &[&arguments[..], &more].concat());
    assert_eq!(document["samples"], 500);
    let contacts = document["contacts"].as_u64().unwrap();
    assert_eq!(document["contact_list"].as_array().unwrap().len() as u64, contacts);
    assert!((document["time_s"].as_f64().unwrap() - 5.0 / 36.0).abs() < 1e-12);
    let samples = table(&workshop, "motion/samples.csv");
    assert_eq!(samples.len(), 501);
    let times = column(&samples, "time_s");
    assert!((times[100] - 1.0 / 36.0).abs() < 1e-12);
    // The motion has settled to a harmonic one: the first and the last period agree.
    let displacements = column(&samples, "displacement_m");
    assert!((displacements[3] - displacements[403]).abs() < 1e-8 * displacements[3].abs());
    let rows = table(&workshop, "motion/contacts.csv");
    assert_eq!(rows.len() as u64, contacts + 1);
    let peak = column(&rows, "peak_force_n").into_iter().fold(0.0, f64::max);
    assert_eq!(document["max_contact_force_n"].as_f64().unwrap(), peak);
    let section = table(&workshop, "motion/stroboscopic.csv");
    assert_eq!(section.len(), 6);
    assert!(column(&section, "phase_cycles").iter().all(|phase| *phase == 0.33));
    assert_eq!(section[0].len(), 4 + 12);
}

/// A given state, and the same state as the orbit of a stored branch, which repeats.
#[test]
fn simulate_begins_where_it_is_told() {
    let workshop = Workshop::changed(DUFFING, "[0.08, 0.5]", "[0.08, 0.3]");
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
    let start = ["simulate", "study.toml", "--frequency", "0.2", "--periods", "3", "--json", "--initial"];
    let of = |initial: &[&str]| document(&workshop, &[&start[..], initial].concat());
    let orbit = of(&["branch:1", "--results", "results"]);
    let state: Vec<f64> =
        orbit["final_modal_state"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    let again = of(&[&format!("{:e},{:e}", state[0], state[1])]);
    for (k, entry) in state.iter().enumerate() {
        let other = again["final_modal_state"][k].as_f64().unwrap();
        assert!((entry - other).abs() < 1e-7, "after three more periods: {entry} {other}");
    }
    // Both ends of the branch, which are those of the range, belong to it.
    for end_hz in ["0.08", "0.3"] {
        let at_end = ["simulate", "study.toml", "--frequency", end_hz, "--periods", "1", "--json"];
        let found =
            document(&workshop, &[&at_end[..], &["--initial", "branch:1", "--results", "results"]].concat());
        assert!(found["max_abs_sampled_displacement_m"].as_f64().unwrap() > 0.0);
    }
    let linear = of(&["linear"]);
    assert!(linear["max_abs_sampled_displacement_m"].as_f64().unwrap() > 0.0);
}

#[test]
fn lyapunov_tells_exponents_their_sum_and_their_convergence() {
    let workshop = Workshop::with(BEAM);
    let arguments =
        ["lyapunov", "study.toml", "--frequency", "53", "--periods", "300", "--out", "out", "--json"];
    let document = document(&workshop, &arguments);
    let exponents = document["exponents_per_s"].as_array().unwrap();
    assert_eq!(exponents.len(), 12);
    assert_eq!(document["half_widths_per_s"].as_array().unwrap().len(), 12);
    assert_eq!(document["largest_exponent"], "positive");
    let number = |key: &str| document[key].as_f64().unwrap();
    assert!((number("sum_per_s") / number("divergence_per_s") - 1.0).abs() < 1e-6);
    assert!(number("zero_one_k") > 0.8);
    assert!(number("kaplan_yorke_dimension") > 1.0);
    assert_eq!(table(&workshop, "out/exponents.csv").len(), 13);
    assert_eq!(table(&workshop, "out/spectra.csv").len(), 2);
    assert_eq!(table(&workshop, "out/section.csv").len(), 301);
    let convergence = table(&workshop, "out/convergence.csv");
    assert_eq!(convergence.len() - 1, document["convergence"].as_array().unwrap().len());
    let last = *column(&convergence, "exponent_1_per_s").last().unwrap();
    assert!((last / exponents[0].as_f64().unwrap() - 1.0).abs() < 1e-12, "summed in another order");
}

/// The hardening spring between its folds: two motions, each of which is found on its branch.
#[test]
fn sweep_shows_hysteresis_and_names_the_branch() {
    let workshop = Workshop::with(DUFFING);
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
    let range = ["sweep", "study.toml", "--from", "0.15", "--to", "0.35", "--step", "0.02"];
    let more = ["--down", "--results", "results", "--out", "out", "--json"];
    let document = document(&workshop, &[&range[..], &more].concat());
    let motions = document["motions"].as_array().unwrap();
    assert_eq!(motions.len(), 22);
    let at = |from: &str| {
        let found = motions.iter().find(|motion| {
            motion["from"] == from && (motion["frequency_hz"].as_f64().unwrap() - 0.25).abs() < 1e-9
        });
        found.unwrap()["max_abs_displacement_m"].as_f64().unwrap()
    };
    assert!(at("up") > 2.0 * at("down"), "{} {}", at("up"), at("down"));
    assert!(motions.iter().all(|motion| motion["class"] == "periodic" && motion["branch"] == 1));
    assert_eq!(table(&workshop, "out/sweep.csv").len(), 23);
    assert_eq!(table(&workshop, "out/sweep_samples.csv").len(), 23);
}

#[test]
fn diagram_from_many_starts_finds_both_motions_whatever_the_threads() {
    let workshop = Workshop::with(DUFFING);
    let range = [
        "sweep",
        "study.toml",
        "--from",
        "0.25",
        "--to",
        "0.26",
        "--step",
        "0.01",
        "--starts",
        "8",
        "--json",
    ];
    let of = |jobs| document(&workshop, &[&range[..], &["--jobs", jobs]].concat());
    let (one, three) = (of("1"), of("3"));
    assert_eq!(one, three);
    let motions = one["motions"].as_array().unwrap();
    assert_eq!(motions.len(), 16);
    let displacement = |motion: &Value| motion["max_abs_displacement_m"].as_f64().unwrap();
    let largest = motions.iter().map(displacement).fold(0.0, f64::max);
    let smallest = motions.iter().map(displacement).fold(f64::INFINITY, f64::min);
    assert!(largest > 2.0 * smallest);
}

const BASINS: [&str; 11] = [
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
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
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

/// Basins that were killed three times have the bytes of those that were not, on another number of threads.
#[test]
fn basins_go_on_after_a_kill_with_the_same_bytes() {
    let whole = Workshop::with(DUFFING);
    let begun = Instant::now();
    assert_success(&whole.hammerbeam(&[&BASINS[..], &["out", "--jobs", "1"]].concat()));
    let duration = begun.elapsed();
    let workshop = Workshop::with(DUFFING);
    for _ in 0..3 {
        kill_after(&workshop, duration.mul_f64(0.2));
    }
    assert_success(&workshop.hammerbeam(&[&BASINS[..], &["out", "--jobs", "3"]].concat()));
    for name in ["out/basins.csv", "out/attractors.csv"] {
        assert!(fs::read(whole.path(name)).unwrap() == fs::read(workshop.path(name)).unwrap(), "{name}");
    }
}

fn start(workshop: &Workshop) -> std::process::Child {
    spawn(workshop, &[&BASINS[..], &["out", "--jobs", "1"]].concat())
}

fn spawn(workshop: &Workshop, arguments: &[&str]) -> std::process::Child {
    Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
        .args(arguments)
        .current_dir(workshop.path(""))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn kill_after(workshop: &Workshop, wait: Duration) {
    let mut child = start(workshop);
    sleep(wait);
    child.kill().unwrap();
    child.wait().unwrap();
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_finished_cells_and_exits_with_130() {
    let workshop = Workshop::with(DUFFING);
    let child = start(&workshop);
    while !workshop.path("out/results.db").exists() {
        sleep(Duration::from_millis(2));
    }
    sleep(Duration::from_millis(150));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    assert!(stderr(&output).contains("cells are kept in out"), "{}", stderr(&output));
}

/// A long motion of any kind ends with what is finished, too.
#[cfg(unix)]
#[test]
fn ctrl_c_ends_every_command_with_130() {
    for (arguments, table) in [
        (
            &["simulate", "study.toml", "--frequency", "0.2", "--periods", "100000000"][..],
            Some("samples.csv"),
        ),
        (&["lyapunov", "study.toml", "--frequency", "0.2", "--periods", "10000000"], None),
        (&["sweep", "study.toml", "--step", "0.00001"], Some("sweep.csv")),
        (&["sweep", "study.toml", "--step", "0.0001", "--starts", "5"], Some("sweep.csv")),
    ] {
        let workshop = Workshop::with(DUFFING);
        let child = Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
            .args(arguments)
            .args(["--out", "out"])
            .current_dir(workshop.path(""))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // Long enough for the command to listen; the work takes hours.
        sleep(Duration::from_millis(1500));
        assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130), "{arguments:?} {}", stderr(&output));
        assert!(stderr(&output).contains("interrupted"), "{}", stderr(&output));
        if let Some(name) = table {
            let rows = fs::read_to_string(workshop.path("out").join(name)).unwrap();
            assert!(rows.lines().count() > 1, "{arguments:?}");
        }
    }
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

/// Sweeps, diagrams and series of exponents that were killed have the bytes of those that were not.
#[test]
fn sweeps_and_exponents_go_on_after_a_kill_with_the_same_bytes() {
    let sweep = ["sweep", "study.toml", "--step", "0.001", "--down", "--out", "out"];
    let starts = ["sweep", "study.toml", "--step", "0.005", "--starts", "3", "--out", "out"];
    let series =
        ["lyapunov", "study.toml", "--frequency", "0.1", "--to", "0.4", "--step", "0.05", "--out", "out"];
    for (arguments, names) in [
        (&sweep[..], &["sweep.csv", "sweep_samples.csv"][..]),
        (&starts, &["sweep.csv", "sweep_samples.csv"]),
        (&series, &["spectra.csv", "exponents.csv", "convergence.csv", "section.csv"]),
    ] {
        let whole = Workshop::with(DUFFING);
        let begun = Instant::now();
        assert_success(&whole.hammerbeam(arguments));
        let duration = begun.elapsed();
        let workshop = Workshop::with(DUFFING);
        for _ in 0..3 {
            let mut child = spawn(&workshop, arguments);
            sleep(duration.mul_f64(0.3));
            child.kill().unwrap();
            child.wait().unwrap();
        }
        assert_success(&workshop.hammerbeam(arguments));
        for name in names {
            let of = |workshop: &Workshop| fs::read(workshop.path("out").join(name)).unwrap();
            assert!(of(&whole) == of(&workshop), "{arguments:?} {name}");
        }
    }
}

#[test]
fn exponents_over_a_series_of_frequencies_are_those_of_each() {
    let workshop = Workshop::with(DUFFING);
    let of = |more: &[&str]| {
        let words = ["lyapunov", "study.toml", "--periods", "100", "--json", "--frequency"];
        document(&workshop, &[&words[..], more].concat())
    };
    let series = of(&["0.1", "--to", "0.3", "--step", "0.1"]);
    let spectra = series["spectra"].as_array().unwrap();
    assert_eq!(spectra.len(), 3);
    for (spectrum, frequency_hz) in spectra.iter().zip(["0.1", "0.2", "0.3"]) {
        assert_eq!(spectrum["exponents_per_s"], of(&[frequency_hz])["exponents_per_s"], "{frequency_hz}");
    }
}

/// What the help says of `--to`: above the first frequency, or the same.
#[test]
fn a_series_may_be_of_one_frequency_and_the_help_says_so() {
    let workshop = Workshop::with(DUFFING);
    for (command, options) in [
        ("lyapunov", &["--frequency", "0.1", "--to", "0.1", "--periods", "20"][..]),
        ("sweep", &["--from", "0.1", "--to", "0.1"]),
    ] {
        let help = workshop.hammerbeam(&[command, "--help"]);
        let words = stdout(&help).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains("above the first, or the same for that one alone"), "{words}");
        let document = document(&workshop, &[&[command, "study.toml", "--json"], options].concat());
        let rows = document.get("motions").or(document.get("spectra")).unwrap();
        assert_eq!(rows.as_array().unwrap().len(), 1);
        assert_eq!(rows[0]["frequency_hz"], 0.1);
    }
}

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
        (&simulate, &["--periods", "0"], "0 is not in 1..="),
        (&simulate, &["--samples-per-period", "0"], "0 is not in 1..="),
        (&simulate, &["--section-phase", "1.5"], "must be a number of cycles from 0 to 1"),
        (&simulate, &["--initial", "1,2"], "found 2 number(s); allowed: rest, linear, branch:N"),
        (&simulate[..3], &["0"], "must be a number of hertz, more than 0 and at most 1e10"),
        (&simulate[..3], &["1e300"], "must be a number of hertz, more than 0 and at most 1e10"),
        (&sweep, &["--to", "1e300"], "must be a number of hertz, more than 0 and at most 1e10"),
        (&simulate, &["--initial", "1,2,x,4"], "found \"x\""),
        (&simulate, &["--initial", "1e308,0,0,0"], "found \"1e308\"; allowed: rest"),
        (&simulate, &["--initial", "1e308,0,0,0"], "each from -1e100 to 1e100"),
        (&simulate, &["--initial", "-1,2,nan,4"], "found \"nan\""),
        (&simulate, &["--initial", "branch:1"], "needs --results DIR"),
        (&simulate, &["--initial", "branch:1", "--results", "nowhere"], "there are no results in nowhere"),
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

const IMPACT_OSCILLATOR: &str = include_str!("../../../studies/impact-oscillator.toml");
/// The same with a stop that remembers its impacts and has no gap.
fn remembering() -> String {
    let law = "law = \"flores\"\nstiffness_n_m15 = 1e3\nrestitution = 0.8\ngap_m = 0.0";
    IMPACT_OSCILLATOR.replace("law = \"rigid\"\nrestitution = 0.8\ngap_m = 1.0", law)
}

#[test]
fn states_in_which_no_motion_begins_are_refused_by_name() {
    let rigid = Workshop::with(IMPACT_OSCILLATOR);
    let memory = Workshop::with(&remembering());
    for (workshop, initial, code, part) in [
        (&rigid, "1.5,0", 2, "the state lies 5.000e-1 m behind the rigid stop \"stop\""),
        (&memory, "0.1,0", 1, "its law needs to know how fast it closed"),
        // The force pushes the mass against the stop at which it rests.
        (&memory, "rest", 1, "stop is pressed on without an impact"),
    ] {
        let arguments = ["simulate", "study.toml", "--frequency", "0.3", "--initial", initial];
        let output = workshop.hammerbeam(&arguments);
        assert_eq!(output.status.code(), Some(code), "{initial}: {}", stderr(&output));
        assert!(stderr(&output).contains(part), "{initial}: {}", stderr(&output));
    }
}

/// At rest the mass is pressed against a stop whose law needs the speed of an impact, and some states about it lie in the contact: the search begins beside, and its orbit is the motion that
/// settles from a state that a motion can begin at.
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

/// Above its first grazing the linear motion of the impact oscillator goes beyond the stop: at phase 0 by `Re F/(1 - W^2 + i c W) - g`.
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

/// A sweep whose motions are in contact at phase 0, which their states do not tell all of: killed and taken up again it has the same bytes.
#[test]
fn a_sweep_within_contacts_that_remember_goes_on_with_the_same_bytes() {
    let study = remembering();
    let whole = Workshop::with(&study);
    let sweep =
        ["sweep", "study.toml", "--from", "0.3", "--to", "0.5", "--step", "0.001", "--initial", "-0.1,0"];
    let sweep = [&sweep[..], &["--down", "--out", "out"]].concat();
    let begun = Instant::now();
    assert_success(&whole.hammerbeam(&sweep));
    let duration = begun.elapsed();
    let samples = column(&table(&whole, "out/sweep_samples.csv"), "displacement_m");
    assert!(samples.iter().filter(|displacement| **displacement > 0.0).count() > 10, "some are in contact");
    let workshop = Workshop::with(&study);
    for _ in 0..3 {
        let mut child = spawn(&workshop, &sweep);
        sleep(duration.mul_f64(0.3));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert_success(&workshop.hammerbeam(&sweep));
    for name in ["sweep.csv", "sweep_samples.csv"] {
        let of = |workshop: &Workshop| fs::read(workshop.path("out").join(name)).unwrap();
        assert!(of(&whole) == of(&workshop), "{name}");
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
