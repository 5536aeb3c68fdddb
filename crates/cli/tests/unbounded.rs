//! An undamped resonance in a whole run: both pieces of the branch, and why they end.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::{Workshop, assert_success, number, stderr, stdout};

/// A mass of 1 kg on 1 N/m without damping, driven by 1 N at these frequencies.
fn undamped(frequency_hz: [f64; 2]) -> Workshop {
    Workshop::with(&format!(
        r#"
[structure]
kind = "lumped"
mass = [{{ name = "mass", mass_kg = 1.0 }}]
spring = [{{ between = ["mass", "ground"], stiffness_n_m = 1.0 }}]
[excitation]
kind = "force"
at = "mass"
amplitude_n = 1.0
frequency_hz = {frequency_hz:?}
[search]
frequencies = 0
[continuation]
max_step_hz = 1e-3
"#
    ))
}

/// Amplitude `1 / |1 - w^2|` m on both sides of 1 rad/s.
#[test]
fn a_run_over_an_undamped_resonance_has_both_sides_of_it_and_ends() {
    let workshop = undamped([0.13, 0.19]);
    let run = workshop.compute(&[]);
    assert_success(&run);
    let reported = "the amplitude has no bound: mode 1 (0.159155 Hz) has no damping";
    assert_eq!(stdout(&run).matches(reported).count(), 2, "{}", stdout(&run));
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
    let rows = workshop.table("results/export/branches.csv");
    let sides = [0.13, 0.19].map(|end| rows.iter().filter(|row| number(row, "frequency_hz") == end).count());
    assert_eq!(sides, [1, 1]);
    for row in &rows {
        let w = std::f64::consts::TAU * number(row, "frequency_hz");
        let share = number(row, "max_abs_displacement_m") * (1.0 - w * w).abs();
        // A point is within 1e-10 of a hundredth of the range from the path: 6e-14 Hz, twice that relative to
        // 0.159 Hz in w^2.
        assert!((share - 1.0).abs() < 1e-8 + 1e-12 / (1.0 - w * w).abs(), "{share} at {w} rad/s");
    }
    let ends = std::fs::read_to_string(workshop.path("results/export/ends.csv")).unwrap();
    assert_eq!(ends.matches(",unbounded,").count(), 2, "{ends}");
}

/// An impact gives back all: two branches go to infinity at the eigenfrequency, and searches beside it meet
/// orbits of a thousand metres, which belong to them.
#[test]
fn orbits_beyond_an_end_at_infinity_make_no_branches() {
    let workshop = Workshop::with(
        r#"
[structure]
kind = "lumped"
mass = [{ name = "m", mass_kg = 0.95 }]
spring = [{ between = ["m", "ground"], stiffness_n_m = 370.0 }]
[excitation]
kind = "force"
at = "m"
amplitude_n = 1.7
frequency_hz = [3.0, 3.3]
[[stop]]
name = "s"
at = "m"
law = "rigid"
restitution = 1.0
side = "below"
gap_m = 0.013
"#,
    );
    let run = workshop.compute(&["--json"]);
    assert_success(&run);
    let report: serde_json::Value = serde_json::from_str(&stdout(&run)).unwrap();
    assert_eq!(report["branches"].as_array().unwrap().len(), 2, "{report}");
}

/// Half the eigenfrequency, where its free vibration repeats with the motion.
#[test]
fn free_vibrations_that_repeat_with_the_motion_are_one_solution_and_no_branch() {
    let half_hz = 0.25 / std::f64::consts::PI;
    let workshop = undamped([half_hz, 0.12]);
    let reason = "mode 1 (0.159155 Hz) has no damping and vibrates freely at a multiple of 0.079577 Hz";
    let frequency = half_hz.to_string();
    let orbit = workshop.hammerbeam(&["orbit", "study.toml", "--frequency", &frequency, "--json"]);
    assert_success(&orbit);
    let document: serde_json::Value = serde_json::from_str(&stdout(&orbit)).unwrap();
    assert_eq!(document["solutions"].as_array().unwrap().len(), 1, "{document}");
    assert!(stderr(&orbit).contains(reason), "{}", stderr(&orbit));
    let run = workshop.compute(&[]);
    assert_success(&run);
    assert!(stdout(&run).contains(reason), "{}", stdout(&run));
    let again = workshop.compute(&["--json"]);
    let document: serde_json::Value = serde_json::from_str(&stdout(&again)).unwrap();
    assert_eq!(document["branches"].as_array().unwrap().len(), 1, "{document}");
    assert_success(&workshop.hammerbeam(&["export", "results", "--format", "csv"]));
    let ends = workshop.table("results/export/ends.csv");
    let words: Vec<&str> = ends.iter().map(|end| end["end"].as_str()).collect();
    assert!(words.contains(&"free-vibration") && !words.contains(&"unbounded"), "{words:?}");
}

/// At the eigenfrequency there is no periodic motion, and `orbit` says why.
#[test]
fn at_the_resonance_of_an_undamped_mode_there_is_no_orbit() {
    let resonance_hz = 0.5 / std::f64::consts::PI;
    let workshop = undamped([0.12, 0.2]);
    let orbit =
        workshop.hammerbeam(&["orbit", "study.toml", "--frequency", &resonance_hz.to_string(), "--json"]);
    assert!(!orbit.status.success());
    let reason = "mode 1 (0.159155 Hz) has no damping and is driven at its frequency";
    assert!(stderr(&orbit).contains(reason), "{}", stderr(&orbit));
}
