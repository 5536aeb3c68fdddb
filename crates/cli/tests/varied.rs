//! Branches in other parameters and curves of bifurcations, with the real command.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{collections::BTreeMap, fs, sync::LazyLock};

use crate::common::{Row, Workshop, assert_bad_input, assert_success, number, stdout};

const STUDY: &str = include_str!("../../../studies/duffing-in-two-parameters.toml");
/// The example with longer steps and a shorter search: some hundred rows of each piece.
static EXAMPLE: LazyLock<String> = LazyLock::new(|| {
    let quick = "[search]\nfrequencies = 4\ntrials = 0\n[continuation]\nmax_step_hz = 0.0005\n\n";
    STUDY
        .replacen("[[vary]]", &format!("{quick}[[vary]]"), 1)
        .replace("frequency_hz = 0.25\n\n", "frequency_hz = 0.25\nsteps = 200\n\n")
});

/// Results of it from one thread, exported, and what was reported.
static ONE_THREAD: LazyLock<(Workshop, String)> = LazyLock::new(|| {
    assert_eq!(EXAMPLE.matches("steps = 200").count(), 2);
    let workshop = Workshop::with(&EXAMPLE);
    let run = workshop.compute(&["--jobs", "1"]);
    assert_success(&run);
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv", "--states"]));
    (workshop, stdout(&run))
});

/// Two masses, three stops of different laws.
const THREE_STOPS: &str = r#"
title = "Two masses, two stops of different gap"
[structure]
kind = "lumped"
[[structure.mass]]
name = "a"
mass_kg = 1.0
[[structure.mass]]
name = "b"
mass_kg = 0.7
[[structure.spring]]
between = ["a","ground"]
stiffness_n_m = 900.0
[[structure.spring]]
between = ["a","b"]
stiffness_n_m = 700.0
[damping]
modal_ratio = 0.03
[excitation]
kind = "force"
at = "a"
amplitude_n = 1.0
frequency_hz = [3.5, 4.5]
[[stop]]
name = "left stop"
at = "b"
law = "linear"
stiffness_n_m = 1.0e4
gap_m = 2.0e-3
side = "below"
[[stop]]
name = "right stop"
at = "b"
law = "hertz"
stiffness_n_m15 = 3.0e5
gap_m = 3.0e-3
side = "above"
[[stop]]
name = "middle"
at = "a"
law = "linear"
stiffness_n_m = 5000.0
damping_n_s_m = 3.0
gap_m = 1.5e-3
side = "above"
[response]
point = "b"
period_multiples = [1]
period_doubling_depth = 0
[continuation]
max_step_hz = 0.02
[search]
frequencies = 2
trials = 0
"#;

/// An exported table.
fn table(workshop: &Workshop, name: &str) -> Vec<Row> {
    workshop.table(&format!("results/export/{name}"))
}

/// Places of the folds of a table in two columns, where a word stands in a third.
fn places(rows: &[Row], key: &str, filter: impl Fn(&Row) -> bool) -> Vec<f64> {
    rows.iter().filter(|row| filter(row)).map(|row| number(row, key)).collect()
}

/// The states are those of the rows, one to one, with the leading multiplier first, and those of the ends
/// among them.
fn assert_states_belong(rows: &[Row], states: &[Row], ends: &[Row]) {
    assert_eq!(rows.len(), states.len());
    let mut next = BTreeMap::new();
    for (row, state) in rows.iter().zip(states) {
        for (key, value) in state.iter().filter(|(key, _)| row.contains_key(*key)) {
            assert_eq!(&row[key], value, "{key}");
        }
        let number = next.entry((&row["piece"], &row["branch"])).or_insert(0);
        assert_eq!(state["row"], number.to_string());
        *number += 1;
        let leading = &row["leading_multiplier_re"];
        assert!(state["multipliers"].starts_with(leading), "{leading} leads, not {}", state["multipliers"]);
        assert_eq!(state["state"].split(' ').count(), state["multipliers"].split(' ').count());
    }
    for end in ends {
        let is_there =
            |state: &&Row| state.iter().all(|(key, value)| end.get(key).is_none_or(|one| one == value));
        assert_eq!(states.iter().filter(is_there).count(), 1, "{end:?}");
    }
}

/// The folds of the branch over the force at 0.25 Hz lie on the curve of folds, found another way; the curve
/// passes both folds of the response and has one cusp.
#[test]
fn branches_and_curves_of_the_example_meet() {
    let (workshop, reported) = &*ONE_THREAD;
    assert!(reported.contains("fold curve over excitation.amplitude_n"), "{reported}");
    let (branches, curves) = (table(workshop, "parameter_branches.csv"), table(workshop, "curves.csv"));
    let of = |name: &str| table(workshop, name);
    assert_states_belong(&branches, &of("parameter_states.csv"), &of("parameter_ends.csv"));
    assert_states_belong(&curves, &of("curve_states.csv"), &of("curve_ends.csv"));
    let force = |row: &Row| row["parameter_name"] == "excitation.amplitude_n";
    let folds = places(&branches, "parameter", |row| force(row) && row["event"].contains("fold"));
    assert_eq!(folds.len(), 2, "{folds:?}");
    let ends = places(&branches, "parameter", |row| force(row) && row["event"].contains("end"));
    assert!(ends.iter().all(|end| [0.02, 0.8].contains(end)), "{ends:?}");
    let events = table(workshop, "parameter_events.csv");
    let of_force: Vec<_> = events.iter().filter(|row| force(row)).collect();
    assert_eq!(of_force.iter().map(|row| number(row, "parameter")).collect::<Vec<_>>(), folds);
    for fold in of_force {
        assert_eq!((&fold["status"][..], &fold["symmetry_breaking"][..]), ("located", "false"));
        assert!((number(fold, "multiplier_re") - 1.0).abs() < 1e-6 && number(fold, "uncertainty") < 1e-8);
        assert_eq!(fold["multipliers"].split(' ').count(), 2);
        assert_eq!(fold["direction"].split(' ').count(), 3);
    }
    assert!(branches.iter().all(|row| number(row, "frequency_hz") == 0.25));
    assert_eq!(curves.iter().filter(|row| row["event"].contains("cusp")).count(), 1);
    // Where the curve passes 0.25 Hz, by the parabola through three of its rows.
    for fold in folds {
        let off = curves.windows(3).filter_map(|rows| {
            let at: Vec<(f64, f64)> =
                rows.iter().map(|row| (number(row, "frequency_hz"), number(row, "parameter"))).collect();
            let within = (at[0].0 - 0.25) * (at[2].0 - 0.25) <= 0.0;
            within.then(|| {
                let part = |i: usize, j: usize, k: usize| {
                    at[i].1 * (0.25 - at[j].0) * (0.25 - at[k].0)
                        / ((at[i].0 - at[j].0) * (at[i].0 - at[k].0))
                };
                (part(0, 1, 2) + part(1, 0, 2) + part(2, 0, 1) - fold).abs()
            })
        });
        let off = off.fold(f64::INFINITY, f64::min);
        assert!(off < 1e-5, "the fold at {fold} N is {off:e} N off the curve");
    }
}

/// A linear oscillator beside a stop: the curve of grazing orbits is that of the linear amplitude.
#[test]
fn a_grazing_curve_is_that_of_the_linear_amplitude() {
    let stop = "[[stop]]\nname = \"spring\"\nat = \"mass\"\nlaw = \"linear\"\nstiffness_n_m = 3.0\ngap_m = \
    1.0\nside = \"above\"\n";
    let curve =
        "[[curve]]\nof = \"grazing\"\nnear_hz = 0.13\nparameter = \"stop.1.gap_m\"\nrange = [0.4, 2.0]\n";
    let (structure, _) = STUDY.split_once("[[stop]]").unwrap();
    let workshop = Workshop::with(&format!("{structure}{stop}{curve}"));
    assert_success(&workshop.compute(&[]));
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
    let rows = table(&workshop, "curves.csv");
    assert!(rows.len() > 50, "{}", rows.len());
    for row in &rows {
        let w = std::f64::consts::TAU * number(row, "frequency_hz");
        let amplitude = 0.3 / (1.0 - w * w).hypot(0.1 * w);
        let gap = number(row, "parameter");
        assert!((amplitude / gap - 1.0).abs() < 1e-8, "{gap} m at {w} rad/s: {amplitude}");
    }
    assert!(!workshop.path("results/export/parameter_branches.csv").exists());
}

/// Two masses between three stops, one of them with a damper, whose contact closes at phase 0 at one
/// amplitude on the way: the curve of Neimark-Sacker points goes on, and ends at that of the diagram at twice
/// the force.
#[test]
fn a_curve_passes_where_a_damped_stop_closes_at_the_phase_of_its_start() {
    let curve = "[[curve]]\nof = \"neimark-sacker\"\nnear_hz = 4.0167\nparameter \
    = \"excitation.amplitude_n\"\nrange = [0.9, 2.0]\n";
    let last = |study: &str, name: &str| {
        let workshop = Workshop::with(study);
        assert_success(&workshop.compute(&[]));
        assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
        table(&workshop, name)
    };
    let rows = last(&format!("{THREE_STOPS}{curve}"), "curves.csv");
    assert!((100..400).contains(&rows.len()), "{} rows", rows.len());
    let ends = [rows.first().unwrap(), rows.last().unwrap()].map(|row| number(row, "parameter"));
    assert_eq!(ends, [0.9, 2.0]);
    let hz = number(rows.last().unwrap(), "frequency_hz");
    let twice = THREE_STOPS.replace("amplitude_n = 1.0", "amplitude_n = 2.0");
    let events = last(&twice, "events.csv");
    let off = events
        .iter()
        .filter(|row| row["event"].contains("neimark-sacker"))
        .map(|row| (number(row, "frequency_hz") / hz - 1.0).abs())
        .fold(f64::INFINITY, f64::min);
    assert!(off < 1e-8, "{hz} Hz, off by {off:e}");
}

/// What is stored is not computed again; a piece more goes into the same folder, and the branches stay as
/// they are.
#[test]
fn pieces_are_added_to_a_folder_and_taken_out_of_it() {
    let (without, pieces) = EXAMPLE.split_once("[[vary]]").unwrap();
    let workshop = Workshop::with(without);
    assert_success(&workshop.compute(&[]));
    let branches = workshop.csv("results");
    let (first, _) = pieces.split_once("[[curve]]").unwrap();
    let pieces_of = |study: String| {
        fs::write(workshop.path("study.toml"), study).unwrap();
        let run = workshop.compute(&["--json"]);
        assert_success(&run);
        let document: serde_json::Value = serde_json::from_str(&stdout(&run)).unwrap();
        let pieces = document["varied"].as_array().unwrap();
        pieces.iter().map(|piece| piece["piece"].as_u64().unwrap()).collect::<Vec<_>>()
    };
    assert_eq!(pieces_of(format!("{without}[[vary]]{first}")), [1, 2]);
    assert_eq!(pieces_of(EXAMPLE.clone()), [1, 2, 3]);
    assert_eq!(workshop.csv("results"), branches);
    assert_eq!(pieces_of(without.to_owned()), [0; 0]);
}

/// A piece has the number of its place in the study, whenever it was computed.
#[test]
fn pieces_lie_in_the_order_of_the_study() {
    let tables = |workshop: &Workshop| {
        ["parameter_branches.csv", "curves.csv", "parameter_ends.csv"]
            .map(|name| fs::read_to_string(workshop.path(&format!("results/export/{name}"))).unwrap())
    };
    let exported = |workshop: &Workshop| {
        assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
        tables(workshop)
    };
    let (without, _) = EXAMPLE.split_once("[[vary]]").unwrap();
    let (_, later) = EXAMPLE.rsplit_once("[[vary]]").unwrap();
    let workshop = Workshop::with(&format!("{without}[[vary]]{later}"));
    assert_success(&workshop.compute(&[]));
    let first = exported(&workshop);
    fs::write(workshop.path("study.toml"), &*EXAMPLE).unwrap();
    assert_success(&workshop.compute(&[]));
    let both = exported(&workshop);
    assert_ne!(first, both);
    assert!(both == tables(&ONE_THREAD.0), "the first piece, computed last, does not come first");
}

/// The pieces of the example are computed by as many threads, and stored as if by one.
#[test]
fn pieces_are_the_same_for_any_number_of_threads() {
    let tables = |workshop: &Workshop| {
        [
            "parameter_branches.csv",
            "parameter_events.csv",
            "curves.csv",
            "parameter_ends.csv",
            "curve_ends.csv",
        ]
        .map(|name| fs::read_to_string(workshop.path(&format!("results/export/{name}"))).unwrap())
    };
    let one = tables(&ONE_THREAD.0);
    let lines = one.each_ref().map(|text| text.lines().count());
    assert!(lines[0] > 50 && lines[1] > 2 && lines[2] > 50, "{lines:?}");
    assert!(lines[3] > 2 && lines[4] > 2, "{lines:?}");
    let workshop = Workshop::with(&EXAMPLE);
    assert_success(&workshop.compute(&["--jobs", "3"]));
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
    assert!(one == tables(&workshop), "three threads give other rows");
}

#[test]
fn wrong_parameters_and_ranges_are_refused_with_what_is_allowed() {
    let refused = |old: &str, new: &str, parts: &[&str]| {
        let workshop = Workshop::changed(STUDY, old, new);
        assert_bad_input(&workshop.hammerbeam(&["check", "study.toml"]), parts);
    };
    let amplitude = "parameter = \"excitation.amplitude_n\"";
    refused(
        amplitude,
        "parameter = \"excitation.amplitude_m\"",
        &[
            "not a parameter of this study",
            "did you mean \"excitation.amplitude_n\"?",
            "stop.1.stiffness_n_m3",
        ],
    );
    refused("stop.spring.stiffness_n_m3", "stop.spring.gap_m", &["not a parameter of this study"]);
    refused("range = [0.02, 0.8]", "range = [0.8, 0.02]", &["reversed", "low < high"]);
    refused("range = [0.02, 0.8]", "range = [0.3, 0.3]", &["empty"]);
    refused("range = [0.02, 0.8]", "range = [0.4, 0.8]", &["`range` is [0.4, 0.8]", "0.3"]);
    refused("range = [0.02, 0.8]", "range = [0.0, 0.8]", &["allowed"]);
    refused("range = [0.1, 2.0]", "range = [-0.1, 2.0]", &["holds zero"]);
    let place = "frequency_hz = 0.25\n\n[[curve]]";
    refused(place, "frequency_hz = 0.25\nsteps = 0\n[[curve]]", &["`steps` is 0", "from 1 to 1000000"]);
    refused("of = \"fold\"", "of = \"folds\"", &["did you mean \"fold\"?"]);
    refused("near_hz = 0.25", "near = 0.25", &["unknown key `near`", "`near_hz` is missing"]);
}
