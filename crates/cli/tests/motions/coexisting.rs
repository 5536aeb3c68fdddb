//! `basins` where two attractors lie on two branches: each is matched with its own.

use std::f64::consts::TAU;

use serde_json::Value;

use crate::{
    DUFFING,
    common::{Workshop, assert_success},
    document,
};

/// Attractors of a grid over the state of a mass, with the branches of a run beside it.
fn attractors(workshop: &Workshop, frequency: &str, [x, y]: [&str; 2]) -> Vec<Value> {
    assert_success(&workshop.hammerbeam(&["run", "study.toml", "--out", "results"]));
    let basins = ["basins", "study.toml", "--frequency", frequency, "--x", x, "--y", y, "--grid", "10"];
    let found = document(workshop, &[&basins[..], &["--results", "results", "--json"]].concat());
    assert_eq!(found["cells_not_computed"], 0);
    found["attractors"].as_array().unwrap().clone()
}

/// Columns of the stored solution of each branch that is nearest to a frequency, by the number of the branch.
fn nearest(workshop: &Workshop, frequency_hz: f64, columns: [&str; 3]) -> Vec<(u64, [f64; 3])> {
    let text = workshop.csv("results");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let index = |name: &str| rows[0].iter().position(|column| *column == name).unwrap();
    let number = |row: &Vec<&str>, name: &str| row[index(name)].parse::<f64>().unwrap();
    let distance = |row: &Vec<&str>| (number(row, "frequency_hz") - frequency_hz).abs();
    let last = rows[1..].iter().map(|row| number(row, "branch") as u64).max().unwrap();
    let of_branch = |branch: u64| {
        let of = rows[1..].iter().filter(|row| number(row, "branch") as u64 == branch);
        let row = of.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
        (branch, columns.map(|name| number(row, name)))
    };
    (1..=last).map(of_branch).collect()
}

/// Displacement and velocity of a mass of 1 kg at phase 0.
fn state(attractor: &Value) -> [f64; 2] {
    [0, 1].map(|i| attractor["modal_state"][i].as_f64().unwrap())
}

/// Between the folds of the hardening spring, which lie beyond the range of this study: three branches of one period, the small and the large motion and the unstable one between them. A motion
/// that is nearly a harmonic one has the amplitude `|q - i v/W|`, which is that of its branch and far from those of the others.
#[test]
fn two_motions_of_one_period_are_on_the_branches_of_their_amplitudes() {
    let study = DUFFING.replace("frequency_hz = [0.08, 0.5]", "frequency_hz = [0.24, 0.26]");
    let workshop = Workshop::with(&format!("{study}\n[continuation]\nmax_step_hz = 0.002\n"));
    let found = attractors(&workshop, "0.25", ["q1=-2..2", "v1=-3..3"]);
    let branches = nearest(&workshop, 0.25, ["max_abs_displacement_m", "frequency_hz", "contacts"]);
    assert_eq!((found.len(), branches.len()), (2, 3), "{found:?} {branches:?}");
    for attractor in &found {
        let [q, v] = state(attractor);
        let amplitude = q.hypot(v / (TAU * 0.25));
        let far = |(_, [displacement, ..]): &&(u64, [f64; 3])| (displacement / amplitude).ln().abs();
        let own = branches.iter().min_by(|a, b| far(a).total_cmp(&far(b))).unwrap();
        assert_eq!(attractor["branch"], own.0, "{attractor} {branches:?}");
        assert!(far(&own) < 0.2, "{attractor} {branches:?}");
    }
    assert_ne!(found[0]["branch"], found[1]["branch"]);
}

/// Above its resonance the mass may stay away from its rigid stop, and then moves as `Re F/(1 - W^2 + i c W) exp(i W t)`, or strike it in every second period: branches of one and of two periods.
#[test]
fn a_motion_that_strikes_and_one_that_does_not_are_on_their_branches() {
    let workshop = Workshop::driven_mass(
        r#"
        frequency_hz = [0.41, 0.43]
        [[stop]]
        at = "m"
        side = "above"
        gap_m = 0.2
        law = "rigid"
        restitution = 0.9
        [response]
        period_multiples = [1, 2]
        [search]
        frequencies = 3
        [continuation]
        max_step_hz = 0.002
        "#,
    );
    let found = attractors(&workshop, "0.42", ["q1=-1..0.2", "v1=-1..1"]);
    let branches = nearest(&workshop, 0.42, ["period_multiple", "contacts", "max_abs_displacement_m"]);
    assert_eq!((found.len(), branches.len()), (2, 2), "{found:?} {branches:?}");
    let w = TAU * 0.42;
    let (real, imaginary) = (1.0 - w * w, 0.04 * w);
    let square = real * real + imaginary * imaginary;
    for attractor in &found {
        let branch = attractor["branch"].as_u64().unwrap();
        let [period, contacts, displacement] = branches.iter().find(|known| known.0 == branch).unwrap().1;
        assert_eq!(attractor["period"].as_f64(), Some(period), "{attractor} {branches:?}");
        let [q, v] = state(attractor);
        let linear = [0.4 * real / square, 0.4 * w * imaginary / square];
        let away = (q - linear[0]).hypot(v - linear[1]);
        if period == 1.0 {
            // A motion has come to an attractor, or repeats, within 1e-8 of its size, and comes closer by 5 % in a period.
            assert!(away < 1e-6 && contacts == 0.0, "{attractor} {branches:?}");
            assert!((displacement - 0.4 / square.sqrt()).abs() < 1e-9);
        } else {
            assert!(away > 0.1 && contacts > 0.0, "{attractor} {branches:?}");
        }
    }
    assert_ne!(found[0]["branch"], found[1]["branch"]);
}
