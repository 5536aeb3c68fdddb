//! `compare` and `rig`: results, documents, refusals.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{f64::consts::PI, fmt::Write, fs};

use crate::common::{TWO_MASSES, Workshop, assert_bad_input, assert_success, stderr, stdout};
use serde_json::Value;

/// A linear oscillator of 1 kg, eigenfrequency 0.5 Hz, damping 5 %: its one branch is known in closed form.
const OSCILLATOR: &str = r#"
title = "Oscillator"
[structure]
kind = "lumped"
[[structure.mass]]
name = "mass"
mass_kg = 1.0
[[structure.spring]]
between = ["mass", "ground"]
stiffness_n_m = 9.869604401089358
[damping]
modal_ratio = 0.05
[excitation]
kind = "force"
at = "mass"
amplitude_n = 0.1
frequency_hz = [0.3, 0.8]
[[stop]]
at = "mass"
law = "linear"
stiffness_n_m = 1.0
side = "above"
gap_m = 1.0e3
[continuation]
max_step_hz = 0.002
[search]
frequencies = 2
starts = 1
trials = 0
"#;

/// Largest displacement of the oscillator [m].
fn answer(f: f64) -> f64 {
    let (w, w0) = (2.0 * PI * f, PI);
    0.1 / ((w0 * w0 - w * w).powi(2) + (2.0 * 0.05 * w0 * w).powi(2)).sqrt()
}

/// Measured amplitude of the excitation [N].
fn force(f: f64) -> f64 {
    0.1 - 0.021 * f
}

/// A run of the oscillator, and `points.csv`: frequencies 5 % too low, displacements half of what they are,
/// in millimetres.
fn measured() -> Workshop {
    let workshop = Workshop::with(OSCILLATOR);
    assert_success(&workshop.compute(&[]));
    let mut table = "frequency [Hz],tip [mm],kind,period,shaker force [N]\n".to_owned();
    for k in 0..30 {
        let f = 0.35 + 0.01 * f64::from(k);
        writeln!(table, "{},{},periodic,1,{}", f / 1.05, 500.0 * answer(f), force(f / 1.05)).unwrap();
    }
    for (f, rest) in [(0.45, "3,chaotic,"), (0.6, "1000,periodic,1"), (0.5, "1,periodic,2")] {
        writeln!(table, "{f},{rest},{}", force(f)).unwrap();
    }
    fs::write(workshop.path("points.csv"), table).unwrap();
    workshop
}

fn document(workshop: &Workshop, arguments: &[&str]) -> Value {
    let output = workshop.hammerbeam(&[&["compare", "results"], arguments, &["--json"]].concat());
    assert_success(&output);
    serde_json::from_str(&stdout(&output)).expect("one JSON document")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn points_over_branches() {
    let workshop = measured();
    let found = document(&workshop, &["points.csv"]);
    let one = &found["comparisons"][0];
    assert_eq!((&one["quantity"], &one["frequency_shift"]), (&"displacement".into(), &"factor".into()));
    // The branch is interpolated between rows 0.002 Hz apart about a peak 0.05 Hz wide.
    assert!((number(&one["frequency_factor"]["value"]) - 1.05).abs() < 2e-4, "{one}");
    assert!((number(&one["amplitude_factor"]["value"]) - 2.0).abs() < 2e-3, "{one}");
    assert_eq!(
        (&one["explained"], &one["too_far"], &one["no_branch"], &one["aperiodic"]),
        (&30.into(), &1.into(), &1.into(), &1.into())
    );
    assert_eq!(one["unexplained"].as_array().unwrap().len(), 2);
    for file in
        ["points_displacement.csv", "compare_displacement.svg", "compare_displacement.png", "excitation.toml"]
    {
        assert!(workshop.path("results/compare").join(file).is_file(), "{file}");
    }
    let rows = fs::read_to_string(workshop.path("results/compare/points_displacement.csv")).unwrap();
    assert_eq!(rows.lines().count(), 34);
    // What is written of the excitation is what a study file takes.
    let table = fs::read_to_string(workshop.path("results/compare/excitation.toml")).unwrap();
    let driven = OSCILLATOR.replace("amplitude_n = 0.1", &table).replace("[0.3, 0.8]", "[0.34, 0.6]");
    fs::write(workshop.path("driven.toml"), driven).unwrap();
    assert_success(&workshop.hammerbeam(&["check", "driven.toml"]));
    assert_success(&workshop.hammerbeam(&["run", "driven.toml", "--out", "driven"]));
    let mut rows = 0;
    for row in workshop.csv("driven").lines().skip(1) {
        let fields: Vec<&str> = row.split(',').collect();
        let (f, displacement): (f64, f64) = (fields[2].parse().unwrap(), fields[3].parse().unwrap());
        // The table falls along a line, which the cubic keeps; it is written with seven digits.
        let expected = answer(f) * force(f) / 0.1;
        assert!((displacement / expected - 1.0).abs() < 1e-6, "{f} Hz: {displacement} {expected}");
        rows += 1;
    }
    assert!(rows > 100, "{rows}");

    let given = ["points.csv", "--frequency-factor", "1.05", "--amplitude-factor", "2", "--out", "given"];
    let given = &document(&workshop, &given)["comparisons"][0];
    assert_eq!(given["frequency_factor"]["given"], true);
    assert!(
        number(&given["residual_before"]["log_rms_within_reach"])
            > number(&given["residual_after"]["log_rms_within_reach"])
    );
    // What was not measured is not compared; what was, behind a filter at the eigenfrequency, is smaller by a
    // root of two there.
    assert_bad_input(
        &workshop.hammerbeam(&["compare", "results", "points.csv", "--quantity", "acceleration"]),
        &["no acceleration was measured", "displacement"],
    );
    let filtered =
        ["points.csv", "--low-pass", "0.5", "--order", "1", "--frequency-factor", "1.05", "--out", "low"];
    let low = &document(&workshop, &filtered)["comparisons"][0];
    let of_peak = low["points"].as_array().unwrap().iter().min_by(|a, b| {
        let off = |p: &Value| (number(&p["shifted_frequency_hz"]) - 0.5).abs();
        off(a).total_cmp(&off(b))
    });
    let expected = answer(0.5) / 2.0_f64.sqrt();
    assert!((number(&of_peak.unwrap()["nearest"]["value"]) / expected - 1.0).abs() < 1e-3, "{of_peak:?}");
}

/// Points 30 % too low in frequency: beyond the factors that are tried.
#[test]
fn factor_at_an_end_of_what_is_tried_is_told_in_words_and_in_the_document() {
    let workshop = measured();
    let mut table = "frequency [Hz],tip [mm],kind,period\n".to_owned();
    for k in 0..30 {
        let f = 0.35 + 0.005 * f64::from(k);
        writeln!(table, "{},{},periodic,1", f / 1.3, 1e3 * answer(f)).unwrap();
    }
    fs::write(workshop.path("far.csv"), table).unwrap();
    let arguments = ["far.csv", "--amplitude-factor", "1", "--reach", "3"];
    let factor = &document(&workshop, &arguments)["comparisons"][0]["frequency_factor"];
    assert_eq!((number(&factor["value"]), &factor["standard_error"]), (1.18, &Value::Null));
    assert_eq!((&factor["given"], &factor["at_end_of"]), (&false.into(), &serde_json::json!([0.85, 1.18])));
    let text = stdout(&workshop.hammerbeam(&[&["compare", "results"], &arguments[..]].concat()));
    assert!(text.contains("1.180000 (at an end of what is tried)"), "{text}");
    assert!(
        text.contains("note: the frequency factor is at an end of what is tried, 0.85 to 1.18"),
        "{text}"
    );
}

/// The range is 0.3 to 0.8 Hz: points exactly at its ends meet the branch, those beyond are reported in
/// words, in the document and in the figure.
#[test]
fn points_at_the_ends_of_the_range_meet_the_branch_and_those_beyond_are_told() {
    let workshop = measured();
    let table = |name: &str, frequencies: &[f64], factor: f64| {
        let mut table = "frequency [Hz],tip [m],kind,period\n".to_owned();
        for f in frequencies {
            writeln!(table, "{f},{},periodic,1", factor * answer(*f)).unwrap();
        }
        fs::write(workshop.path(name), table).unwrap();
    };
    let given = |name: &'static str| [name, "--frequency-factor", "1", "--amplitude-factor", "1"];
    table("ends.csv", &[0.3, 0.5, 0.8], 1.0);
    let one = &document(&workshop, &given("ends.csv"))["comparisons"][0];
    assert_eq!((&one["explained"], &one["beyond_the_range"]), (&3.into(), &0.into()), "{one}");
    table("beyond.csv", &[0.3, 0.5, 0.8, 0.81, 0.9], 1.0);
    let one = &document(&workshop, &given("beyond.csv"))["comparisons"][0];
    assert_eq!(
        (&one["explained"], &one["no_branch"], &one["beyond_the_range"]),
        (&3.into(), &2.into(), &2.into())
    );
    let text = stdout(&workshop.hammerbeam(&[&["compare", "results"], &given("beyond.csv")[..]].concat()));
    assert!(text.contains("note: 2 points shifted beyond the range of the study, 0.3 to 0.8 Hz"), "{text}");
    let figure = fs::read_to_string(workshop.path("results/compare/compare_displacement.svg")).unwrap();
    assert!(figure.contains("measured, periodic (2 beyond the axes)"), "{figure}");
    // Metres that are millimetres: each point meets the branch, none is near.
    table("units.csv", &[0.4, 0.45, 0.5, 0.55], 1e3);
    let far = workshop.hammerbeam(&["compare", "results", "units.csv", "--frequency-factor", "1"]);
    assert_eq!(far.status.code(), Some(1));
    let reported = "a fit of 1 number to displacement was asked for, but of 4 periodic points, at the best \
    shift and factor that were tried, 4 meet a stable branch of their period and only 0 of them lie within \
    a factor of 2.25 of it";
    assert!(stderr(&far).contains(reported), "{}", stderr(&far));
}

/// Two masses on their own springs that never meet: displacement over displacement of the support, in closed
/// form.
#[test]
fn points_of_another_point_are_held_against_orbits_that_are_gone_over_again() {
    let study = TWO_MASSES.replace("gap_m = 1.0e-3", "gap_m = 1.0e3").replace("[3.0, 14.0]", "[4.0, 6.0]")
        + "\n[continuation]\nmax_step_hz = 0.01\n[search]\nfrequencies = 2\nstarts = 1\ntrials = 0\n";
    let workshop = Workshop::with(&study);
    assert_success(&workshop.compute(&[]));
    // The second mass: w0^2 = 4000 1/s^2, damping ratio 0.02 of its motion relative to the frame.
    let second = |f: f64| {
        let (w, square) = (2.0 * PI * f, 4000.0_f64);
        let (real, imaginary) = (square - w * w, 2.0 * 0.02 * square.sqrt() * w);
        let size = w * w / (real * real + imaginary * imaginary);
        0.5e-3 * (1.0 + size * real).hypot(size * imaginary)
    };
    let mut table = "frequency [Hz],x [mm],kind,period\n".to_owned();
    for k in 0..12 {
        let f = 4.2 + 0.13 * f64::from(k);
        writeln!(table, "{f},{},periodic,1", 1e3 * second(f)).unwrap();
    }
    fs::write(workshop.path("points.csv"), table).unwrap();
    let given = ["points.csv", "--frequency-factor", "1", "--amplitude-factor", "1"];
    let at = |more: &[&str]| document(&workshop, &[&given[..], more].concat());
    let found = at(&["--point", "second", "--out", "second"]);
    assert_eq!(found["point"], "second");
    // Orbits 0.005 Hz apart on a curve that bends little, maxima between 4096 samples.
    assert!(number(&found["comparisons"][0]["residual_after"]["log_rms"]) < 2e-5, "{found}");
    // The response point moves otherwise.
    let response = at(&[]);
    assert_eq!(response["point"], "first");
    assert!(number(&response["comparisons"][0]["residual_after"]["log_rms"]) > 0.1, "{response}");
    let refused = |more: &[&str], part: &str| {
        assert_bad_input(
            &workshop.hammerbeam(&[&["compare", "results", "points.csv"], more].concat()),
            &[part],
        );
    };
    // A hundred thousandth of the excitation frequency, order 4: 1e-20 of the motion is left.
    refused(&["--low-pass", "4e-5"], "there is nothing to compare with");
    // The masses never meet: their force is 0, which is not that there is no branch.
    fs::write(workshop.path("forces.csv"), "frequency [Hz],force [N],period\n5,1,1\n5,1,2\n").unwrap();
    let forces = ["forces.csv", "--frequency-factor", "1", "--amplitude-factor", "1", "--out", "forces"];
    let forces = [&forces[..], &["--point", "second"]].concat();
    let force = &document(&workshop, &forces)["comparisons"][0];
    assert_eq!((&force["no_contact"], &force["no_branch"]), (&1.into(), &1.into()), "{force}");
    assert_eq!(force["points"][0]["nearest_stable_hz"], Value::Null);
    let text = stdout(&workshop.hammerbeam(&[&["compare", "results"], &forces[..]].concat()));
    assert!(text.contains("without contact there") && text.contains("force [N] of the contacts"), "{text}");
    assert!(!text.contains("at second"), "{text}");
    refused(&["--point", "second"], "--out");
    refused(&["--point", "third", "--out", "third"], "no point third");
}

#[test]
fn records_are_reduced_to_points() {
    let workshop = measured();
    fs::create_dir(workshop.path("records")).unwrap();
    for f in [0.4, 0.45, 0.5, 0.55, 0.6] {
        let mut text = "time [s],x [mm],force [N]\n".to_owned();
        for k in 0..1000 {
            let t = 0.1 * f64::from(k);
            let (x, force) = (1e3 * answer(f) * (2.0 * PI * f * t).cos(), 0.1 * (2.0 * PI * f * t).cos());
            writeln!(text, "{t},{x},{force}").unwrap();
        }
        fs::write(workshop.path(&format!("records/run_{f}Hz.csv")), text).unwrap();
    }
    let found = document(&workshop, &["records", "--reference", "force"]);
    let one = &found["comparisons"][0];
    assert_eq!((&one["quantity"], &one["explained"]), (&"displacement".into(), &5.into()));
    assert!((number(&one["frequency_factor"]["value"]) - 1.0).abs() < 2e-3, "{one}");
    assert!((number(&one["amplitude_factor"]["value"]) - 1.0).abs() < 1e-2, "{one}");
    // Without a reference the frequency stands in the names.
    let named = &document(&workshop, &["records", "--quantity", "displacement"])["comparisons"][0];
    assert!(named["points"].as_array().unwrap().iter().all(|p| p["period_multiple"] == 1), "{named}");
    fs::rename(workshop.path("records/run_0.4Hz.csv"), workshop.path("records/first.csv")).unwrap();
    assert_bad_input(
        &workshop.hammerbeam(&["compare", "results", "records"]),
        &["first.csv: the excitation frequency is not known", "--reference"],
    );
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let workshop = measured();
    let refused = |arguments: &[&str], parts: &[&str]| {
        assert_bad_input(&workshop.hammerbeam(&[&["compare"], arguments].concat()), parts);
    };
    refused(&["nowhere", "points.csv"], &["nowhere"]);
    refused(&["results", "missing.csv"], &["cannot read missing.csv"]);
    fs::write(workshop.path("bad.csv"), "frequency [Hz],acc\n1,2\n").unwrap();
    refused(&["results", "bad.csv"], &["bad.csv", "\"acc\" names no unit"]);
    fs::write(workshop.path("none.csv"), "a [m],b [m]\n1,2\n").unwrap();
    refused(&["results", "none.csv"], &["none.csv", "no column is the excitation frequency"]);
    fs::create_dir(workshop.path("empty")).unwrap();
    refused(&["results", "empty"], &["the folder holds no file"]);
    refused(&["results", "points.csv", "--out", "./results/"], &["--out is the results folder itself"]);
    refused(&["results", "points.csv", "--reach", "1"], &["more than 1"]);
    refused(&["results", "points.csv", "--frequency-factor", "-1"], &["more than 0"]);
    fs::write(workshop.path("few.csv"), "frequency [Hz],tip [mm]\n0.5,50\n").unwrap();
    let few = workshop.hammerbeam(&["compare", "results", "few.csv"]);
    assert_eq!(few.status.code(), Some(1), "{few:?}");
    let plain = Workshop::with(TWO_MASSES);
    assert_bad_input(&plain.hammerbeam(&["rig", "study.toml", "--out", "rig"]), &["no table [rig]"]);
    assert!(!plain.path("rig").exists());
}

/// The oscillator with a rig of its own: 4 % softer in frequency, a weaker shaker.
const RIG: &str = r#"
[rig]
sweep_hz = [0.36, 0.6]
step_hz = 0.02
settling_periods = 60
recorded_periods = 12
sampling_hz = 20.0
low_pass_hz = 4.0
other_low_pass_hz = [8.0]
noise_m_s2 = 1e-4
noise_m = 1e-5
signals = [[0.46, 1], [0.46, 2]]
[rig.changes.excitation]
amplitude_n = [[0.3, 0.1], [0.5, 0.09], [0.8, 0.08]]
"#;

#[test]
fn a_virtual_rig_goes_through_the_whole_comparison() {
    // The stop is far away, so the one thing that shifts frequencies is the spring.
    let changed = "[[rig.changes.structure.spring]]\nbetween = [\"mass\", \"ground\"]\nstiffness_n_m = \
    9.09602741604395\n";
    let workshop = Workshop::with(&format!("{OSCILLATOR}{RIG}{changed}"));
    let run = |folder: &str, jobs: &str| {
        let output = workshop.hammerbeam(&["rig", "study.toml", "--out", folder, "--jobs", jobs, "--json"]);
        assert_success(&output);
        serde_json::from_str::<Value>(&stdout(&output)).unwrap()
    };
    let found = run("one", "1");
    // sqrt(9.096/9.8696) = 0.96.
    let displacement = &found["comparisons"][2];
    assert_eq!(displacement["name"], "displacement");
    assert!((number(&displacement["frequency_factor"]["value"]) * 0.96 - 1.0).abs() < 5e-3, "{displacement}");
    assert_eq!(found["sweep"]["points"], 26);
    assert_eq!(displacement["explained"], 26);
    assert!(
        number(&displacement["residual_after"]["log_rms"])
            < 0.5 * number(&displacement["residual_before"]["log_rms"])
    );
    let signal = &found["signals"][0];
    assert_eq!(signal["measured_as"], "periodic, 1");
    assert!(number(&signal["computed"]["correlation"]) > 0.99, "{signal}");
    // What `overlay` reports is here, too: a harmonic is the same at every frequency, and there is no branch
    // of period 2.
    let report = fs::read_to_string(workshop.path("one/report.md")).unwrap();
    for (index, file, part) in [
        (0, "figure_07.csv", "are as alike as the scatter"),
        (1, "figure_08.csv", "no stable orbit of this period"),
    ] {
        let notes = found["signals"][index]["notes"].as_array().unwrap();
        let note = notes.iter().filter_map(Value::as_str).find(|note| note.contains(part));
        let note = note.unwrap_or_else(|| panic!("{notes:?}"));
        assert!(report.contains(&format!("\nNote, {file}: {note}.\n")), "{report}");
    }
    assert_eq!(found["signals"][1]["computed"], Value::Null);
    // A harmonic of 0.5 Hz loses next to nothing at 4 Hz: 1 + (f/f_c)^8/2.
    assert!((number(&found["filters"][0]["acceleration_all"]["median"]) - 1.0).abs() < 1e-4);
    let mode = &found["eigenfrequencies"][0];
    assert!((number(&mode["measured_hz"]) - 0.48).abs() < 5e-3, "{mode}");
    // The same again, and on two threads.
    run("two", "2");
    for file in [
        "report.md",
        "measured.csv",
        "figure_02.csv",
        "figure_06_points.csv",
        "figure_06_branches.csv",
        "figure_07.csv",
    ] {
        let read = |folder: &str| fs::read(workshop.path(folder).join(file)).unwrap();
        assert!(read("one") == read("two"), "{file} differs");
    }
}

/// What the page is given, from its file.
fn page(workshop: &Workshop) -> (Value, String) {
    let drawn = workshop.hammerbeam(&["figure", "results", "--kind", "page"]);
    assert_success(&drawn);
    let html = fs::read_to_string(workshop.path("results/page.html")).unwrap();
    let meta = html.split_once("<script id=\"meta\" type=\"application/json\">").unwrap().1;
    let meta = meta.split_once("</script>").unwrap().0;
    (serde_json::from_str(meta).unwrap(), stderr(&drawn))
}

#[test]
fn the_page_has_the_points_of_a_comparison_with_their_kinds_and_what_filter_they_were_behind() {
    let workshop = measured();
    let found = document(&workshop, &["points.csv"]);
    let compared = found["comparisons"][0]["points"].as_array().unwrap();
    let (meta, complaints) = page(&workshop);
    assert!(complaints.is_empty(), "{complaints}");
    let series = &meta["measured"][0];
    assert_eq!((&series["quantity"], &series["note"]), (&"displacement".into(), &"".into()));
    let points = series["points"].as_array().unwrap();
    assert_eq!(points.len(), compared.len());
    for (point, outcome) in points.iter().zip(compared) {
        let near = |place: usize, of: &str, key: &str| {
            let (found, meant) = (number(&point[of][place]), number(&outcome[key]));
            assert!((found / meant - 1.0).abs() < 1e-12, "{point} {outcome}");
        };
        near(0, "measured", "frequency_hz");
        near(1, "measured", "value");
        near(0, "shifted", "shifted_frequency_hz");
        near(1, "shifted", "shifted_value");
        let kind = match outcome["kind"].as_str().unwrap() {
            kind @ ("periodic" | "aperiodic") => kind,
            _ => "unknown",
        };
        assert_eq!((&point["motion"], &point["verdict"]), (&kind.into(), &outcome["verdict"]));
    }
    assert!(points.iter().any(|point| point["motion"] == "aperiodic"));

    document(&workshop, &["points.csv", "--low-pass", "0.5"]);
    let (meta, _) = page(&workshop);
    assert!(meta["measured"][0]["note"].as_str().unwrap().contains("a low-pass filter of 0.5 Hz"));

    // A table that is none is named; the rest of the page is there.
    fs::write(workshop.path("results/compare/points_displacement.csv"), "origin,kind\nx,periodic\n").unwrap();
    let (meta, complaints) = page(&workshop);
    assert_eq!(meta["measured"], Value::Array(Vec::new()));
    assert!(complaints.contains("points_displacement.csv has no column frequency_hz"), "{complaints}");
    assert_eq!(meta["branches"].as_array().map(Vec::len), Some(1));
}
