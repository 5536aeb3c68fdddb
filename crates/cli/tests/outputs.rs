//! `[[output]]`: tables, figures and comparisons; and that outputs may be added to a finished folder.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{fmt::Write, fs, sync::LazyLock};

use serde_json::Value;

use crate::common::{
    RUN, Row, Workshop, assert_bad_input, assert_success, mass_against_a_stop, number, stdout,
};

const STIFFNESS: f64 = 2.0e4;
const GAP: f64 = 0.02;

/// A mass against a stop, over the frequency and over the gap.
fn study() -> String {
    mass_against_a_stop(&format!("law = \"linear\"\nstiffness_n_m = {STIFFNESS:e}\n"))
}

const OUTPUTS: &str = r#"
[[output]]
name = "travel"
at = "mass"
figures = ["maximum", "phase"]
[[output]]
name = "mass, acceleration"
at = "mass"
quantity = "acceleration"
harmonics = 2
[[output]]
name = "press"
stop = "wall"
"#;

/// A run with outputs from the start, exported.
static WITH_OUTPUTS: LazyLock<Workshop> =
    LazyLock::new(|| Workshop::exported(&format!("{}{OUTPUTS}", study())));

/// The rows of one output.
fn of(workshop: &Workshop, table: &str, output: &str) -> Vec<Row> {
    let mut rows = workshop.table(table);
    rows.retain(|row| row["output"] == output);
    rows
}

#[track_caller]
fn assert_equal(found: f64, exact: f64, tolerance: f64) {
    assert!((found - exact).abs() <= tolerance * exact.abs(), "{found} instead of {exact}");
}

/// The certified maxima of the rows are a second method for the largest magnitudes; the force follows from
/// the displacement by its law, and the phase lags by the balance of a linear oscillator where nothing
/// touches.
#[test]
fn tables_hold_what_the_rows_and_the_law_say() {
    let workshop = &*WITH_OUTPUTS;
    let rows = workshop.table("results/export/branches.csv");
    let [travel, acceleration, press] = ["travel", "mass, acceleration", "press"]
        .map(|name| of(workshop, "results/export/outputs.csv", name));
    assert!(rows.len() > 100 && press.len() == rows.len());
    let mut touching = 0;
    for (((row, travel), acceleration), press) in rows.iter().zip(&travel).zip(&acceleration).zip(&press) {
        assert_eq!((&row["branch"], &row["frequency_hz"]), (&travel["branch"], &travel["frequency_hz"]));
        assert_equal(number(travel, "max_abs"), number(row, "max_abs_displacement_m"), 1e-9);
        assert_equal(number(acceleration, "max_abs"), number(row, "max_abs_acceleration_m_s2"), 1e-9);
        let force = STIFFNESS * (number(travel, "maximum") - GAP).max(0.0);
        // A difference of two lengths, known as well as these.
        let close = |other: f64| (number(press, "maximum") - other).abs() < 1e-12 * STIFFNESS * GAP;
        assert!(close(force) && close(number(row, "max_contact_force_n")), "{force}: {press:?}");
        let (maximum, minimum) = (number(travel, "maximum"), number(travel, "minimum"));
        assert_equal(number(travel, "peak_to_peak"), maximum - minimum, 1e-15);
        // The spring carries the mean force: 1000 N/m times the mean displacement.
        let mean = number(travel, "mean");
        assert!((1000.0 * mean + number(press, "mean")).abs() < 1e-7, "{mean}");
        touching += u32::from(force > 0.0);
    }
    assert!(touching > 50 && touching < rows.len() as u32, "{touching}");
    assert_eq!((travel[0]["unit"].as_str(), press[0]["unit"].as_str()), ("m", "N"));
    assert_eq!(travel[0]["amplitudes"].split(' ').count(), 3);
    assert_eq!(acceleration[0]["phases_rad"].split(' ').count(), 2);
}

/// Below the gap `x'' + 2 D w0 x' + w0^2 x = 5 cos(w t - 2.2)`, so the phase is that of the receptance less
/// 2.2, and every number follows from the amplitude.
#[test]
fn where_nothing_touches_the_numbers_are_those_of_the_linear_oscillator() {
    let workshop = &*WITH_OUTPUTS;
    let (mut found, w0) = (0, 1000.0_f64.sqrt());
    for row in of(workshop, "results/export/outputs.csv", "travel") {
        if number(&row, "maximum") > GAP {
            continue;
        }
        found += 1;
        let w = std::f64::consts::TAU * number(&row, "frequency_hz");
        let (re, im) = (w0 * w0 - w * w, 2.0 * 0.02 * w0 * w);
        let amplitude = 5.0 / re.hypot(im);
        let first = |key: &str| row[key].split(' ').next().unwrap().parse::<f64>().unwrap();
        assert_equal(first("amplitudes"), amplitude, 1e-8);
        assert_equal(number(&row, "rms"), amplitude / 2.0_f64.sqrt(), 1e-8);
        assert_equal(-number(&row, "minimum"), amplitude, 1e-8);
        let turns = (first("phases_rad") - (-2.2 - im.atan2(re))) / std::f64::consts::TAU;
        assert!((turns - turns.round()).abs() < 1e-9, "{turns}");
    }
    assert!(found > 10, "{found}");
}

/// Over the gap the law has that of each row.
#[test]
fn outputs_over_another_parameter_are_those_of_its_system() {
    let rows = of(&WITH_OUTPUTS, "results/export/parameter_outputs.csv", "travel");
    let forces = of(&WITH_OUTPUTS, "results/export/parameter_outputs.csv", "press");
    assert!(rows.len() > 50);
    for (row, force) in rows.iter().zip(&forces) {
        let penetration = number(row, "maximum") - number(row, "parameter");
        assert_equal(number(force, "maximum"), STIFFNESS * penetration.max(0.0), 1e-8);
    }
}

/// Bytes of everything exported.
fn exported(workshop: &Workshop) -> Vec<(String, Vec<u8>)> {
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv", "--out", "again"]));
    let names = ["branches", "events", "parameter_branches", "outputs", "parameter_outputs"];
    let read = |name: &str| fs::read(workshop.path(&format!("again/{name}.csv"))).unwrap_or_default();
    names.iter().map(|name| ((*name).to_owned(), read(name))).collect()
}

/// Computes what is left, and how many solutions got their outputs.
fn run_again(workshop: &Workshop, study: &str, jobs: &str) -> u64 {
    fs::write(workshop.path("study.toml"), study).unwrap();
    let run = workshop.compute(&["--json", "--jobs", jobs]);
    assert_success(&run);
    let document: Value = serde_json::from_str(&stdout(&run)).unwrap();
    assert_eq!(document["outputs"]["failed"], 0);
    document["outputs"]["computed"].as_u64().unwrap()
}

#[test]
fn outputs_added_to_a_finished_folder_are_the_same_bytes_and_nothing_else_is_computed() {
    let workshop = Workshop::exported(&study());
    let plain = exported(&workshop);
    assert!(plain[3].1.is_empty(), "no outputs, no table");
    let all = WITH_OUTPUTS.copied();
    let with_outputs = exported(&all);
    let rows =
        (all.table("again/branches.csv").len() + all.table("again/parameter_branches.csv").len()) as u64;
    // One of them first, then all, then once more.
    let one = format!("{}\n[[output]]\nname = \"press\"\nstop = \"wall\"\n", study());
    assert_eq!(run_again(&workshop, &one, "1"), rows);
    assert_eq!(exported(&workshop)[..3], plain[..3]);
    let study_with = format!("{}{OUTPUTS}", study());
    assert_eq!(run_again(&workshop, &study_with, "3"), rows);
    assert!(exported(&workshop) == with_outputs, "other bytes");
    assert_eq!(run_again(&workshop, &study_with, "1"), 0);
    // Which numbers figures show changes nothing that is stored.
    let other = study_with.replace("figures = [\"maximum\", \"phase\"]", "figures = [\"rms\"]");
    assert_eq!(run_again(&workshop, &other, "1"), 0);
    // Without them their table goes.
    assert_eq!(run_again(&workshop, &study(), "1"), 0);
    assert!(exported(&workshop) == plain, "other bytes");
}

#[test]
fn documents_figures_and_the_page_show_outputs() {
    let workshop = WITH_OUTPUTS.copied();
    assert_success(&workshop.hammerbeam(&RUN));
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "json", "--out", "again"]));
    let text = fs::read_to_string(workshop.path("again/results.json")).unwrap();
    let document: Value = serde_json::from_str(&text).unwrap();
    let table = &document["outputs"];
    let rows = workshop.table("results/export/outputs.csv");
    assert_eq!(table["output"].as_array().unwrap().len(), rows.len());
    assert_eq!(table["rms"][5].as_f64().unwrap(), number(&rows[5], "rms"));
    assert_eq!(table["amplitudes"][0].as_array().unwrap().len(), 3);
    for name in [
        "response_output_1_travel_maximum.svg",
        "response_output_1_travel_phase.svg",
        "response_output_2_mass__acceleration_minimum.svg",
        "response_output_3_press_maximum.svg",
        "vary_1_stop_wall_gap_m_output_3_press_maximum.svg",
    ] {
        assert!(workshop.path(&format!("results/{name}")).is_file(), "{name} is missing");
    }
    let page = fs::read_to_string(workshop.path("results/page.html")).unwrap();
    for title in
        ["travel, maximum displacement", "travel, phase at the excitation frequency", "press, maximum"]
    {
        assert!(page.contains(&format!("\"title\":\"{title}")), "{title} is missing");
    }
}

/// Points that lie on the computed forces, half as large and 5 % too low in frequency, are found so.
#[test]
fn measured_points_are_compared_with_an_output() {
    let workshop = WITH_OUTPUTS.copied();
    let mut table = "frequency [Hz],force [N]\n".to_owned();
    for row in of(&workshop, "results/export/outputs.csv", "press").iter().step_by(12) {
        let (frequency, force) = (number(row, "frequency_hz"), number(row, "max_abs"));
        // More than the unstable branch reaches.
        if force > 80.0 {
            writeln!(table, "{},{}", frequency / 1.05, 0.5 * force).unwrap();
        }
    }
    fs::write(workshop.path("points.csv"), table).unwrap();
    let compare = |output: &str, more: &[&str]| {
        let arguments = ["compare", "results", "points.csv", "--output", output, "--out", "held"];
        workshop.hammerbeam(&[&arguments[..], more].concat())
    };
    let found = compare("press", &["--json"]);
    assert_success(&found);
    let document: Value = serde_json::from_str(&stdout(&found)).unwrap();
    let fit = &document["comparisons"][0];
    assert_eq!(document["point"], "press");
    let value = |key: &str| fit[key]["value"].as_f64().unwrap();
    assert!((value("frequency_factor") - 1.05).abs() < 1e-3, "{fit}");
    assert!((value("amplitude_factor") - 2.0).abs() < 1e-2, "{fit}");
    assert_bad_input(
        &compare("nothing", &[]),
        &["no output \"nothing\"", "travel, mass, acceleration, press"],
    );
}

#[test]
fn what_does_not_fit_is_refused_with_its_place() {
    let refused = |outputs: &str, parts: &[&str]| {
        let workshop = Workshop::with(&format!("{}{outputs}", study()));
        assert_bad_input(&workshop.hammerbeam(&["check", "study.toml"]), parts);
    };
    let output = |keys: &str| format!("[[output]]\n{keys}\n");
    refused(&output("at = \"mas\""), &["output", "mas", "did you mean"]);
    refused(&output("stop = \"wal\""), &["a stop of this study", "wall"]);
    refused(&output("name = \"x\""), &["of `at`, `between` and `stop` there is none"]);
    refused(&output("at = \"mass\"\nstop = \"wall\""), &["there is at and stop"]);
    refused(&output("at = \"mass\"\nquantity = \"force\""), &["a point moves", "displacement, velocity"]);
    refused(&output("stop = \"wall\"\nquantity = \"velocity\""), &["a stop has a force"]);
    refused(&output("between = [\"mass\", \"mass\"]"), &["names one place twice"]);
    refused(&output("at = \"mass\"\nharmonics = 51"), &["0 to 50"]);
    refused(&output("at = \"mass\"\nfigures = [\"median\"]"), &["median", "peak-to-peak"]);
    let twice = output("name = \"a\"\nat = \"mass\"").repeat(2);
    refused(&twice, &["`name` is \"a\", which is taken"]);
}
