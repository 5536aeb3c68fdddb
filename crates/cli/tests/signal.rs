//! The `signal` commands: results, documents, refusals.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{f64::consts::PI, fmt::Write, fs};

use crate::common::{TWO_MASSES, Workshop, assert_bad_input, assert_success, reported, stderr, stdout};
use serde_json::Value;

const RATE: f64 = 1000.0;

/// A folder with `signal.csv`: a time column and two channels, [m/s²] and [mm].
fn workshop(samples: usize, channels: impl Fn(f64) -> [f64; 2]) -> Workshop {
    let workshop = Workshop::with("");
    let mut text = "time [s],a [m/s^2],x / mm\n".to_owned();
    for k in 0..samples {
        let time = k as f64 / RATE;
        let [a, x] = channels(time);
        writeln!(text, "{time},{a},{x}").unwrap();
    }
    fs::write(workshop.path("signal.csv"), text).unwrap();
    workshop
}

fn harmonic(time: f64) -> [f64; 2] {
    let turn = 2.0 * PI * time;
    [3.0 * (20.0 * turn).sin() + 0.5 * (200.0 * turn).sin(), 2.0 * (20.0 * turn).cos()]
}

#[track_caller]
fn document(workshop: &Workshop, arguments: &[&str]) -> Value {
    let output = workshop.hammerbeam(&[&["signal"], arguments, &["--json"]].concat());
    assert_success(&output);
    assert_eq!(reported(&output), "", "quiet where no one looks");
    serde_json::from_str(&stdout(&output)).expect("one JSON document")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn filter_takes_the_upper_line_away_and_writes_what_can_be_read_again() {
    let workshop = workshop(2000, harmonic);
    let found = document(&workshop, &["filter", "signal.csv", "--low-pass", "60", "--out", "out"]);
    assert_eq!(found["sampling_rate_hz"], 1000.0);
    assert_eq!(
        (&found["channels"][1]["quantity"], &found["channels"][1]["unit"]),
        (&"displacement".into(), &"m".into())
    );
    // The upper line is weakened by (60/200)^8 and more, the lower one by 1e-4.
    let largest = number(&found["filtered"][0]["max_abs_after"]);
    assert!((largest - 3.0).abs() < 0.01, "{largest}");
    assert!((number(&found["filtered"][1]["max_abs_before"]) - 2e-3).abs() < 1e-12);
    let again = document(&workshop, &["spectrum", "out/filtered.csv", "--channel", "a"]);
    assert_eq!(again["value_unit"], "m/s^2");
    assert!((number(&again["lines"][0]["frequency_hz"]) - 20.0).abs() < 1e-6);
    assert!((number(&again["lines"][0]["value"]) - 3.0).abs() < 0.01);
}

#[test]
fn filter_resamples() {
    let workshop = workshop(2000, harmonic);
    let arguments =
        ["filter", "signal.csv", "--low-pass", "60", "--causal", "--resample", "400", "--channel", "x"];
    let found = document(&workshop, &arguments);
    assert!((number(&found["filtered_sampling_rate_hz"]) - 400.0).abs() < 1e-9);
    assert_eq!(found["filtered"].as_array().unwrap().len(), 1);
}

#[test]
fn density_integrates_to_the_mean_square() {
    let workshop = workshop(4000, harmonic);
    let arguments = ["spectrum", "signal.csv", "--kind", "density", "--segment", "1000", "--out", "out"];
    let found = document(&workshop, &arguments);
    let table = fs::read_to_string(workshop.path("out/spectrum.csv")).unwrap();
    let sum: f64 =
        table.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().parse::<f64>().unwrap()).sum();
    let integral = sum * number(&found["frequency_step_hz"]);
    // (3² + 0.5²)/2; both lines lie on values of the spectrum.
    assert!((integral - 4.625).abs() < 1e-6, "{integral}");
    assert!((number(&found["root_mean_square"]).powi(2) - 4.625).abs() < 1e-6);
}

#[test]
fn decrement_gives_frequency_and_damping_with_intervals() {
    let (w, d) = (2.0 * PI * 17.2, 0.015);
    let workshop =
        workshop(4000, |t| [(-d * w * t).exp() * (w * t).cos() + 1e-3 * (1e4 * t).sin().sin(), 0.0]);
    let found = document(&workshop, &["decrement", "signal.csv", "--modes", "1"]);
    let mode = &found["modes"][0];
    assert!((number(&mode["damping_ratio"]) / d - 1.0).abs() < 0.01, "{mode}");
    assert!(number(&mode["damping_ratio_half_width"]) > 0.0);
    assert!((number(&mode["logarithmic_decrement"]) / (2.0 * PI * d) - 1.0).abs() < 0.01);
    assert!(number(&found["maxima"]["maxima"]) > 10.0);
    assert_eq!(found["maxima"]["changes_over_the_decay"], false);
}

#[test]
fn envelope_of_a_beat_and_of_its_upper_line_alone() {
    // 20 Hz of 3 and 200 Hz of 0.5.
    let workshop = workshop(2000, harmonic);
    let whole = document(&workshop, &["envelope", "signal.csv"]);
    assert!((number(&whole["max_envelope"]) - 3.5).abs() < 0.01, "{whole}");
    let upper = document(&workshop, &["envelope", "signal.csv", "--high-pass", "100", "--out", "out"]);
    // In the middle of the record, away from its ends.
    let table = fs::read_to_string(workshop.path("out/envelope.csv")).unwrap();
    let row = table.lines().nth(1001).unwrap();
    let value: f64 = row.split(',').nth(1).unwrap().parse().unwrap();
    assert!(table.starts_with("time_s,a_m_s2\n") && (value - 0.5).abs() < 1e-3, "{row}");
    assert_eq!(upper["channel"], "a");
}

#[test]
fn time_column_can_be_named() {
    let workshop = Workshop::with("");
    let rows: String = (0..100).map(|k| format!("{},{}\n", 2 * k, f64::from(k).sin())).collect();
    fs::write(workshop.path("counter.csv"), format!("tick [ms],a [g]\n{rows}")).unwrap();
    let found = document(&workshop, &["spectrum", "counter.csv", "--time", "tick"]);
    assert!((number(&found["sampling_rate_hz"]) - 500.0).abs() < 1e-9);
    fs::write(workshop.path("counter.csv"), format!("tick,a [g]\n{rows}")).unwrap();
    assert_bad_input(&workshop.hammerbeam(&["signal", "spectrum", "counter.csv"]), &["--rate", "--time"]);
    let found = document(&workshop, &["spectrum", "counter.csv", "--time", "1"]);
    assert!((number(&found["sampling_rate_hz"]) - 0.5).abs() < 1e-12);
    assert_eq!(
        (&found["channel"], &found["findings"][0]["kind"]),
        (&"a".into(), &"time-unit-assumed".into())
    );
}

/// The chain knows what it clips and what it folds down.
#[test]
fn chain_tells_what_it_clips_and_folds() {
    let workshop = workshop(2000, harmonic);
    let arguments = ["chain", "signal.csv", "--sampling", "300", "--range", "1", "--bits", "12"];
    let found = document(&workshop, &arguments);
    let kinds: Vec<&str> =
        found["measured_findings"].as_array().unwrap().iter().map(|f| f["kind"].as_str().unwrap()).collect();
    // A harmonic of more than the range, at both ends of it.
    assert_eq!(kinds, ["folded", "clipped", "clipped"]);
    assert!(stdout(&workshop.hammerbeam(&[&["signal"][..], &arguments].concat())).contains("is clipped"));
}

#[test]
fn classification_with_frequency_and_with_reference() {
    let workshop = workshop(8000, |t| {
        let turn = 2.0 * PI * 31.0 * t;
        [turn.cos() + 0.5 * (0.5 * turn).cos(), turn.sin()]
    });
    for source in [&["--frequency", "31"][..], &["--reference", "x"], &["--reference", "2", "--channel", "1"]]
    {
        let found = document(&workshop, &[&["classify", "signal.csv"], source].concat());
        assert_eq!(found["channel"], "a");
        assert_eq!((&found["motion"], &found["period_multiple"]), (&"periodic".into(), &2.into()));
        assert!((number(&found["excitation_frequency_hz"]) - 31.0).abs() < 1e-6);
    }
    let other = document(&workshop, &["classify", "signal.csv", "--frequency", "27"]);
    assert_eq!((&other["motion"], &other["period_multiple"]), (&"aperiodic".into(), &Value::Null));
}

#[test]
fn exponent_of_a_map_by_all_methods() {
    let workshop = Workshop::with("");
    let mut state = (0.1, 0.1);
    let mut text = "x\n".to_owned();
    for k in 0..2200 {
        state = (1.0 - 1.4 * state.0 * state.0 + state.1, 0.3 * state.0);
        if k >= 200 {
            writeln!(text, "{}", state.0).unwrap();
        }
    }
    fs::write(workshop.path("henon.csv"), text).unwrap();
    let found = document(&workshop, &["lyapunov", "henon.csv", "--rate", "1", "--out", "out"]);
    assert_eq!((&found["delay_samples"], &found["dimension"]), (&1.into(), &2.into()));
    for method in ["wolf", "rosenstein", "kantz"] {
        // The exponent is 0.418; a record of 2000 scatters by up to 8 %.
        let exponent = number(&found[method]["exponent_per_s"]);
        assert!((exponent / 0.418 - 1.0).abs() < 0.10, "{method}: {exponent}");
    }
    let table = fs::read_to_string(workshop.path("out/divergence.csv")).unwrap();
    assert!(table.starts_with("time_s,rosenstein,kantz\n"));
    // A map has no period to fit over.
    let refused = |fit: &str, part: &str| {
        let arguments =
            ["signal", "lyapunov", "henon.csv", "--rate", "1", "--method", "rosenstein", "--fit", fit];
        assert_bad_input(&workshop.hammerbeam(&arguments), &[part]);
    };
    refused("period", "the mean period is");
    // 25 samples of a map, 0 to 24: the last one is allowed, and the message names it.
    refused("1:25", "and at most 24");
    refused("9:3", "two numbers of samples");
    refused("periods", "or the word period");
    let whole = ["lyapunov", "henon.csv", "--rate", "1", "--method", "rosenstein", "--fit", "1:24"];
    assert_eq!(document(&workshop, &whole)["rosenstein"]["fit_samples"], serde_json::json!([1, 24]));
    // What a method does not look at is refused.
    let ignored = ["signal", "lyapunov", "henon.csv", "--rate", "1", "--method", "wolf", "--fit", "1:5"];
    assert_bad_input(&workshop.hammerbeam(&ignored), &["--fit", "Wolf"]);
}

/// From a study to what an instrument would have shown: simulate writes, chain reads.
#[test]
fn chain_takes_what_simulate_writes() {
    let workshop = Workshop::with(TWO_MASSES);
    let simulate = [
        "simulate",
        "study.toml",
        "--frequency",
        "13.8",
        "--periods",
        "20",
        "--transient-periods",
        "200",
        "--samples-per-period",
        "400",
        "--out",
        "motion",
    ];
    assert_success(&workshop.hammerbeam(&simulate));
    let arguments = [
        "chain",
        "motion/samples.csv",
        "--periodic",
        "--low-pass",
        "850",
        "--sampling",
        "2000",
        "--noise",
        "0.01",
        "--seed",
        "3",
        "--out",
        "out",
    ];
    let found = document(&workshop, &arguments);
    assert_eq!((&found["sensor"], &found["source"]), (&"acceleration".into(), &"acceleration".into()));
    assert!((number(&found["sampling_rate_hz"]) - 13.8 * 400.0).abs() < 1e-6);
    assert!(number(&found["max_abs_measured"]) < 1.05 * number(&found["max_abs_before"]));
    let table = fs::read_to_string(workshop.path("out/measured.csv")).unwrap();
    assert!(table.starts_with("time_s,acceleration_m_s2\n"));
    assert_eq!(document(&workshop, &arguments), found, "the same seed is the same noise");
    // Without --channel the phase in periods, which stands first, is passed over.
    let spectrum = document(&workshop, &["spectrum", "motion/samples.csv"]);
    assert_eq!(spectrum["channel"], "displacement");
    // A motion that repeats has no exponent.
    let repeats = workshop.hammerbeam(&["signal", "lyapunov", "motion/samples.csv"]);
    assert_eq!(repeats.status.code(), Some(1), "{}", stderr(&repeats));
    assert!(stderr(&repeats).contains("the motion is periodic"), "{}", stderr(&repeats));
    // What was computed has the period that the measurement shows.
    let classified =
        document(&workshop, &["classify", "out/measured.csv", "--frequency", "13.8", "--multiples", "4"]);
    assert_eq!(classified["motion"], "periodic");
}

/// Each refusal says what is wrong and which option helps.
#[test]
fn bad_files_are_refused_with_help() {
    let workshop = Workshop::with("");
    for (name, text, parts) in [
        (
            "gap.csv",
            "t [s],a\n0,1\n1,2\n2,1\n3,2\n4,1\n5,2\n6,1\n7,2\n8,1\n9,2\n20,1\n",
            ["there are 1 gaps", "--repair gaps"],
        ),
        ("missing.csv", "t [s],a\n0,1\n1,\n2,1\n3,2\n", ["\"a\" misses 1 of 4", "--repair missing"]),
        ("back.csv", "t [s],a\n0,1\n2,2\n1,1\n3,2\n", ["time runs back 1 times", "--repair order"]),
        ("twice.csv", "t [s],a\n0,1\n1,2\n1,1\n2,2\n", ["the time of the one before", "--repair duplicates"]),
        ("uneven.csv", "t [s],a\n0,1\n1,2\n2.3,1\n3,2\n", ["sampling is uneven", "--repair uneven"]),
        ("lengths.csv", "t [s],a,b\n0,1,1\n1,2,\n2,3,\n", ["unequal lengths", "--repair lengths"]),
        ("norate.csv", "a\n1\n2\n3\n", ["does not say the sampling rate", "--rate"]),
        ("notime.csv", "t [s],a\n0,1\n,2\n2,3\n", ["1 times are missing", "--rate"]),
        (
            "text.csv",
            "t [s],a\n0,1\n1,2\n2,over\n",
            ["text.csv: line 4, column 2", "\"over\" is not a number"],
        ),
        ("ragged.csv", "t [s],a\n0,1\n1,2\n2\n", ["line 4 has 1 values", "have 2"]),
        ("words.csv", "nothing to see\n", ["words.csv", "no rows of numbers"]),
        ("empty.csv", "", ["empty.csv", "the file is empty"]),
    ] {
        fs::write(workshop.path(name), text).unwrap();
        assert_bad_input(&workshop.hammerbeam(&["signal", "spectrum", name]), &parts);
    }
    fs::write(workshop.path("hdf.mat"), "MATLAB 7.3 MAT-file").unwrap();
    assert_bad_input(
        &workshop.hammerbeam(&["signal", "spectrum", "hdf.mat"]),
        &["MATLAB 7.3 (HDF5) is not read", "-v7"],
    );
    assert_bad_input(
        &workshop.hammerbeam(&["signal", "spectrum", "nowhere.csv"]),
        &["cannot read nowhere.csv"],
    );
}

#[test]
fn repairs_are_made_and_told() {
    let workshop = Workshop::with("");
    fs::write(workshop.path("m.csv"), "t [s],a\n0,1\n1,\n2,3\n3,2\n4,5\n").unwrap();
    let found = document(&workshop, &["spectrum", "m.csv", "--repair", "missing"]);
    assert_eq!(
        (&found["findings"][0]["kind"], &found["findings"][0]["channel"]),
        (&"missing-interpolated".into(), &"a".into())
    );
    let text = workshop.hammerbeam(&["signal", "spectrum", "m.csv", "--repair", "missing"]);
    assert!(stdout(&text).contains("note: channel \"a\": 1 missing samples were interpolated"));
}

#[test]
fn options_that_make_no_sense_are_refused() {
    let workshop = workshop(500, harmonic);
    for (arguments, parts) in [
        (&["filter", "signal.csv"][..], ["there is nothing to do", "--low-pass"]),
        (&["filter", "signal.csv", "--low-pass", "850"], ["850", "half the sampling rate, 500 Hz"]),
        (&["filter", "signal.csv", "--low-pass", "20", "--high-pass", "30"], ["upper cut-off", "30"]),
        (&["spectrum", "signal.csv", "--channel", "b"], ["no channel", "channel"]),
        (&["spectrum", "signal.csv", "--from", "3"], ["fewer than two samples", "3"]),
        (
            &["spectrum", "signal.csv", "--kind", "power", "--segment", "9999"],
            ["at least 9999 samples", "there are 500"],
        ),
        (&["classify", "signal.csv", "--frequency", "400"], ["excitation frequency", "an eighth"]),
        (&["classify", "signal.csv"], ["--frequency", "--reference"]),
        (&["chain", "signal.csv", "--sensor", "velocity"], ["no velocity", "acceleration"]),
    ] {
        assert_bad_input(&workshop.hammerbeam(&[&["signal"], arguments].concat()), &parts);
    }
}

#[test]
fn nothing_found_is_exit_code_1() {
    let workshop = workshop(500, |t| [(1e5 * t).sin().powi(3) * (7.7e6 * t * t).cos(), 0.0]);
    let output = workshop.hammerbeam(&["signal", "decrement", "signal.csv", "--json"]);
    assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(document["error"]["exit_code"], 1);
}

/// Numbers that ask for more samples than there is room for, and samples whose squares are not finite, are
/// refused in a sentence.
#[test]
fn what_is_beyond_all_bounds_is_refused() {
    let rows = |factor: &str| -> String {
        (0..1000)
            .map(|k| format!("{:.4},{:.6}{factor}\n", 1e-3 * f64::from(k), (0.1 * f64::from(k)).sin()))
            .collect()
    };
    let title = "time (s),displacement (m)\n";
    let workshop = Workshop::with("");
    let write = |name: &str, text: String| fs::write(workshop.path(name), text).unwrap();
    write("usual.csv", format!("{title}{}", rows("")));
    write("gap.csv", format!("{title}{}1.7e9,0.5\n", rows("")));
    write("huge.csv", format!("{title}{}", rows("e300")));
    write("tiny.csv", format!("{title}{}", rows("e-300")));
    let chain = ["signal", "chain", "usual.csv", "--sensor", "displacement", "--sampling", "1e12"];
    for (arguments, sentence) in [
        (&["signal", "spectrum", "gap.csv", "--repair", "gaps"][..], "at most 33554432 are worked with"),
        (&chain[..], "must be at most 33554432"),
        (&["signal", "filter", "usual.csv", "--resample", "5e8"][..], "the new sampling rate"),
        (&["signal", "classify", "usual.csv", "--frequency", "1e-18"][..], "needs at least"),
        (&["signal", "spectrum", "huge.csv"][..], "must be 0 or from 1e-60 to 1e60"),
        (&["signal", "classify", "tiny.csv", "--frequency", "15.9"][..], "must be 0 or from 1e-60 to 1e60"),
    ] {
        assert_bad_input(&workshop.hammerbeam(arguments), &[sentence]);
    }
}
