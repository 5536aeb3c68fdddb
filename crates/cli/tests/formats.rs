//! `export` by columns, as JSON and NPZ, and of orbits that are chosen; `orbit --json` with all motions.

use std::{fs, process::Output};

use serde_json::Value;

use crate::common::{Workshop, assert_success, number, stdout};

/// A run of the Duffing oscillator around 0.25 Hz, where three solutions coexist.
fn run() -> Workshop {
    let study = include_str!("../../../studies/duffing.toml");
    let workshop = Workshop::changed(study, "[0.08, 0.5]", "[0.2, 0.3]");
    assert_success(&workshop.compute(&[]));
    workshop
}

fn export(workshop: &Workshop, format: &str, more: &[&str]) -> Output {
    let arguments = ["export", "results", "--out", "export", "--format", format];
    workshop.hammerbeam(&[&arguments[..], more].concat())
}

fn numbers(values: &Value) -> Vec<f64> {
    values.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
}

#[test]
fn json_and_npz_hold_the_tables_of_the_csv() {
    let workshop = run();
    for format in ["csv", "json", "npz"] {
        assert_success(&export(&workshop, format, &["--states"]));
    }
    let document: Value =
        serde_json::from_str(&fs::read_to_string(workshop.path("export/results.json")).unwrap()).unwrap();
    let rows = workshop.table("export/branches.csv");
    for column in ["frequency_hz", "max_abs_displacement_m", "leading_multiplier_re", "residual"] {
        let expected: Vec<f64> = rows.iter().map(|row| number(row, column)).collect();
        let found = numbers(&document["branches"][column]);
        assert_eq!(found.len(), expected.len());
        // As far as the reader of JSON has all digits: a number may be off by its last one.
        let is_same = |(a, b): (&f64, &f64)| (a - b).abs() <= 2.0 * f64::EPSILON * b.abs();
        assert!(found.iter().zip(&expected).all(is_same), "{column}");
    }
    let events = document["events"]["event"].as_array().unwrap();
    assert_eq!(events.iter().filter(|event| **event == "fold").count(), 2);
    let states = document["states"]["state"].as_array().unwrap();
    assert!(states.len() == rows.len() && states.iter().all(|state| numbers(state).len() == 2));
    let npz = fs::read(workshop.path("export/results.npz")).unwrap();
    assert!(npz.starts_with(b"PK") && npz.windows(12).any(|name| name == b"branches.npy"));
}

/// Tables hold all branches: a branch and samples are chosen of orbits, and without those refused.
#[test]
fn a_branch_and_samples_are_of_orbits() {
    let workshop = run();
    for alone in [["--branch", "1"], ["--samples", "64"]] {
        let output = export(&workshop, "csv", &alone);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            output.status.code() == Some(2) && message.contains("--frequency <HZ>|--event <NAME>"),
            "{message}"
        );
    }
    assert_success(&export(&workshop, "csv", &["--event", "fold", "--branch", "1"]));
    assert!(workshop.table("export/orbits.csv").iter().all(|orbit| orbit["branch"] == "1"));
}

#[test]
fn orbits_are_chosen_by_frequency_and_event_and_come_with_their_motion() {
    let workshop = run();
    assert_success(&export(&workshop, "csv", &["--frequency", "0.25", "--event", "fold", "--samples", "64"]));
    let orbits = workshop.table("export/orbits.csv");
    let events: Vec<&str> = orbits.iter().map(|orbit| orbit["event"].as_str()).collect();
    assert_eq!(events, ["", "", "", "fold", "fold"]);
    let waveforms = workshop.table("export/waveforms.csv");
    assert_eq!(waveforms.len(), 5 * 64);
    for (place, orbit) in orbits.iter().enumerate() {
        let motion = &waveforms[64 * place..64 * (place + 1)];
        let largest = motion.iter().map(|row| number(row, "mass_displacement_m").abs()).fold(0.0, f64::max);
        // A maximum between two samples of a period is higher by 2 (pi / 64)^2 / 4 at most.
        let whole = number(orbit, "max_abs_displacement_m");
        assert!(largest <= whole * (1.0 + 1e-9) && largest > 0.98 * whole, "{largest} of {whole}");
        // m x'' = -c x' - x - x^3 + 0.3 cos(2 pi f t), the cubic spring among the forces.
        for row in motion {
            let [x, v, a, force] = [
                "mass_displacement_m",
                "mass_velocity_m_s",
                "mass_acceleration_m_s2",
                "cubic spring_force_n",
            ]
            .map(|column| number(row, column));
            let load = 0.3 * (std::f64::consts::TAU * number(row, "phase_cycles")).cos();
            assert!((a + 0.1 * v + x - force - load).abs() < 1e-9);
            assert!((force + x.powi(3)).abs() < 1e-6 * (1.0 + force.abs()), "{force} at {x}");
        }
    }
    // Both ends of the one branch, which are the ends of the range.
    assert_success(&export(&workshop, "csv", &["--event", "start", "--event", "end", "--samples", "8"]));
    let ends = workshop.table("export/orbits.csv");
    let ends: Vec<_> =
        ends.iter().map(|orbit| (orbit["event"].as_str(), number(orbit, "frequency_hz"))).collect();
    assert_eq!(ends, [("start", 0.2), ("end", 0.3)]);
    let nothing = export(&workshop, "json", &["--event", "grazing"]);
    assert_eq!(nothing.status.code(), Some(1));
    let unknown = export(&workshop, "json", &["--event", "jump"]);
    assert_eq!(unknown.status.code(), Some(2));
}

#[test]
fn orbit_has_all_solutions_in_one_list_with_their_motion() {
    let workshop = Workshop::with(include_str!("../../../studies/duffing.toml"));
    let output = workshop.hammerbeam(&["orbit", "study.toml", "--frequency", "0.25", "--json"]);
    assert_success(&output);
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let solutions = document["solutions"].as_array().unwrap();
    assert_eq!(solutions.len(), 1 + document["others"].as_array().unwrap().len());
    assert_eq!(solutions[0]["state"], document["state"]);
    for solution in solutions {
        let waveform = &solution["waveform"];
        let motion = numbers(&waveform["points"]["mass"]["displacement_m"]);
        assert_eq!((motion.len(), waveform["states"].as_array().unwrap().len()), (256, 256));
        assert_eq!(numbers(&waveform["states"][0]).len(), 2);
        assert!(waveform["forces_n"]["cubic spring"].is_array());
    }
}
